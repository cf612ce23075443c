# SPDX-License-Identifier: Apache-2.0
"""Helpers that write and draw the parts of docs/validation.md."""
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1]))
import gnuplot_svg


def table(head, rows, left=1):
    """Markdown; the first `left` columns are texts."""
    lines = ["| " + " | ".join(head) + " |", "| " + " | ".join(["---"] * left + ["---:"] * (len(head) - left)) + " |"]
    return "\n".join(lines + ["| " + " | ".join(map(str, row)) + " |" for row in rows])


def measured(result):
    return f"(`./dev validation`, {result['device']}, {result['date']})"


def ghz(row):
    return f"{row['frequency_hz'] / 1e9:g}"


def gnuplot(path, lines, size="760,480"):
    path.write_text(gnuplot_svg.svg(lines, size), encoding="utf-8")
