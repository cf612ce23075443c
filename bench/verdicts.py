#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Verdicts on the claims of A. Zhdanov's thesis on each device.

Usage: verdicts.py THESIS_MD...; each file is the thesis.md that `wavetracer thesis all` has written. Its verdicts replace
those of the same device in bench/results/verdicts.csv; report.py makes docs/thesis_verdicts.md of that file.
"""
import csv
import pathlib
import re
import sys

COLUMNS = ("device", "date", "command", "figure", "claim", "origin", "verdict", "measured")
ORIGINS = ("thesis", "other author", "repetition")
WORDS = ("exceeded", "reproduced", "in part", "refuted", "undecided", "not measured there", "not judged")
FILE = pathlib.Path(__file__).parent / "results" / "verdicts.csv"


def read(path):
    """All rows of verdicts.csv, as dicts."""
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def of_run(text):
    """Rows of the table of verdicts of one thesis.md."""
    head = {key: re.search(rf"^- {key}: `?([^`\n]*)", text, re.M)[1] for key in ("device", "date", "command")}
    head["device"] = head["device"].split(" (")[0]
    head["date"] = head["date"].split(",")[0]
    section = re.search(r"^## Verdicts\n(.*?)^## ", text, re.M | re.S)[1]
    for line in section.splitlines():
        cells = [cell.strip() for cell in line.strip("| ").split(" | ")]
        if len(cells) == 5 and cells[2] in ORIGINS and cells[3] in WORDS:
            yield head | dict(zip(("figure", "claim", "origin", "verdict", "measured"), cells))


def of_devices(rows):
    """{name of the device: its rows}, two cores first."""
    devices = {}
    for row in rows:
        name = "two cores" if row["device"].startswith("pthread") else row["device"]
        devices.setdefault(name, []).append(row)
    return dict(sorted(devices.items(), key=lambda item: item[0] != "two cores"))


def counts(rows):
    """Markdown lines: how many claims of which origin have which verdict on each device."""
    lines = ["| device | origin | claims | " + " | ".join(WORDS) + " | command, date |",
             "| --- | --- |" + " ---: |" * (1 + len(WORDS)) + " --- |"]
    for name, own in of_devices(rows).items():
        for origin in ORIGINS:
            found = [row["verdict"] for row in own if row["origin"] == origin]
            numbers = " | ".join(str(number) for number in [len(found)] + [found.count(word) for word in WORDS])
            lines.append(f"| {name} | {origin} | {numbers} | `{own[0]['command']}`, {own[0]['date']} |")
    return lines


def page(rows):
    """docs/thesis_verdicts.md: each claim beside what was measured."""
    devices = of_devices(rows)
    lines = ["# The thesis, claim by claim", "",
             "This page lists every claim of the thesis with its verdict and the measurement behind it. `bench/report.py` generates it from "
             "`bench/results/verdicts.csv`, so do not edit it. [thesis.md](thesis.md#figures) explains the figures and the verdicts.", "",
             "\"Sort paid\" means that the time of the sort is a part of the measured time. Names in quotation marks are the settings "
             "of the figure; those with \"printed\" are the tables as the thesis prints them, with their faults. A repetition is a claim of "
             "another figure, or the same claim about other tables; repetitions and claims of other authors are counted apart.", ""] + counts(rows)
    for figure in dict.fromkeys(row["figure"] for row in rows):
        lines += ["", f"## {figure}", "", "| claim | " + " | ".join(devices) + " |", "| --- |" + " --- |" * len(devices)]
        for claim in dict.fromkeys(row["claim"] for row in rows if row["figure"] == figure):
            cells = [next((f"**{row['verdict']}**: {row['measured']}" for row in own
                           if (row["figure"], row["claim"]) == (figure, claim)), "") for own in devices.values()]
            origin = next(row["origin"] for row in rows if (row["figure"], row["claim"]) == (figure, claim))
            lines.append(f"| {claim}{'' if origin == 'thesis' else f' ({origin})'} | " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    rows = read(FILE) if FILE.exists() else []
    for name in sys.argv[1:]:
        new = list(of_run(pathlib.Path(name).read_text(encoding="utf-8")))
        if not new:
            sys.exit(f"{name}: it has no table of verdicts")
        rows = [row for row in rows if row["device"] != new[0]["device"]] + new
    with open(FILE, "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


if __name__ == "__main__":
    main()
