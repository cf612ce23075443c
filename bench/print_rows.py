#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Prints the rows of a benchmark, JSON objects on standard input (json_line.hpp), as a table while they come."""
import json
import sys

from report import number

HEAD = ("case", "value", "unit", "times the baseline", "error")
WIDTHS = (72, 10, 12, 18, 10)


def line(cells):
    """Cells side by side: the case to the left, numbers to the right. A long case is followed by the rest of the line."""
    case, *others = cells
    return f"{case:<{WIDTHS[0]}}" + "".join(f" {text:>{width}}" if i != 1 else f" {text:<{width}}"
                                            for i, (text, width) in enumerate(zip(others, WIDTHS[1:])))


def main():
    print(line(HEAD).rstrip())
    for text in sys.stdin:
        row = json.loads(text)
        cells = (row["case"], number(row["value"]), row["unit"], number(row["ratio"]), number(row["error"]))
        print(line(cells).rstrip())


if __name__ == "__main__":
    main()
