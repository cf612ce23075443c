#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Verdicts on the claims of A. Zhdanov's thesis on each device.

Usage: verdicts.py [--add] [--instead-of DEVICE] [--apart TEXT] [--note TEXT] THESIS_MD...

Each file is a thesis.md that `wavetracer thesis` has written, for all experiments or for some. The files of one device
are put together, and replace all verdicts of that device in bench/results/verdicts.csv; report.py makes
docs/thesis_verdicts.md of that file. With --add they replace only those of their figures. --instead-of also removes the verdicts of another device, by the name that the page gives it. --apart is
for runs with other settings: they have a column of their own, whose name is that of the device and this text. The note is printed behind the
date: it says what else one must know of these runs.
"""
import argparse
import csv
import pathlib
import re
import sys

import rows as results

COLUMNS = ("device", "date", "command", "note", "figure", "claim", "origin", "verdict", "measured")
ORIGINS = ("thesis", "other author", "repetition")
WORDS = ("exceeded", "reproduced", "in part", "refuted", "undecided", "not measured there", "not judged")
FILE = pathlib.Path(__file__).parent / "results" / "verdicts.csv"


def read(path):
    """All rows of verdicts.csv, as dicts."""
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def shown(device):
    """A device as the pages call it. All processors that PoCL names are two cores of this project's machines."""
    return "two cores" if device.startswith("pthread") else results.device_name(device)


def place(row):
    """Sorts rows as `wavetracer thesis` lists experiments: the figures by number, then others by name."""
    number = re.fullmatch(r"figure-6\.(\d+)", row["figure"])
    return (0, int(number[1]), "") if number else (1, 0, row["figure"])


def of_run(text, note="", apart=""):
    """Rows of the table of verdicts of one thesis.md."""
    head = {key: re.search(rf"^- {key}: `?([^`\n]*)", text, re.M)[1] for key in ("device", "date", "command")}
    head["device"] = head["device"].split(" (")[0] + (f", {apart}" if apart else "")
    head["date"] = head["date"].split(",")[0]
    head["note"] = note
    section = re.search(r"^## Verdicts\n(.*?)^## ", text, re.M | re.S)[1]
    for line in section.splitlines():
        cells = [cell.strip() for cell in line.strip("| ").split(" | ")]
        if len(cells) == 5 and cells[2] in ORIGINS and cells[3] in WORDS:
            yield head | dict(zip(("figure", "claim", "origin", "verdict", "measured"), cells))


def of_devices(rows):
    """{name of the device: its rows}, two cores first."""
    devices = {}
    for row in rows:
        devices.setdefault(shown(row["device"]), []).append(row)
    return dict(sorted(devices.items(), key=lambda item: item[0] != "two cores"))


def origin_of(own):
    """The commands of a device's rows, with the date. Commands that differ in experiments and folders alone are one."""
    commands = dict.fromkeys(row["command"] for row in own)
    if len(commands) > 1:
        commands = dict.fromkeys(re.sub(r"( thesis)( (?!-)\S+)+", r"\1 NAME...", re.sub(r" -o \S+", "", one)) for one in commands)
    parts = [f"`{one}`" for one in commands] + sorted({row["date"] for row in own})
    return ", ".join(parts + sorted({row["note"] for row in own if row.get("note")}))


def counts(rows):
    """Markdown lines: how many claims of which origin have which verdict on each device."""
    lines = ["| device | origin | claims | " + " | ".join(WORDS) + " | command, date |",
             "| --- | --- |" + " ---: |" * (1 + len(WORDS)) + " --- |"]
    for name, own in of_devices(rows).items():
        for origin in ORIGINS:
            found = [row["verdict"] for row in own if row["origin"] == origin]
            if not found:
                continue
            numbers = " | ".join(str(number) for number in [len(found)] + [found.count(word) for word in WORDS])
            lines.append(f"| {name} | {origin} | {numbers} | {origin_of(own)} |")
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
        columns = {name: own for name, own in devices.items() if any(row["figure"] == figure for row in own)}
        lines += ["", f"## {figure}", "", "| claim | " + " | ".join(columns) + " |", "| --- |" + " --- |" * len(columns)]
        for claim in dict.fromkeys(row["claim"] for row in rows if row["figure"] == figure):
            cells = [next((f"**{row['verdict']}**: {row['measured']}" for row in own
                           if (row["figure"], row["claim"]) == (figure, claim)), "") for own in columns.values()]
            origin = next(row["origin"] for row in rows if (row["figure"], row["claim"]) == (figure, claim))
            lines.append(f"| {claim}{'' if origin == 'thesis' else f' ({origin})'} | " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def merged(rows, texts, note="", instead_of=None, apart="", add=False):
    """`rows` with those of new runs in place of all others of their devices, or with `add` of their figures there. Two runs of one device must not have the
    same figure. Files without a claim add nothing."""
    new = []
    for text in texts:
        run = list(of_run(text, note, apart))
        figures = {(row["device"], row["figure"]) for row in run}
        twice = figures & {(row["device"], row["figure"]) for row in new}
        if twice:
            sys.exit(f"{sorted(twice)}: two files have it")
        new += run
    if not new:
        sys.exit("no file has a table of verdicts with a claim")
    gone = {shown(row["device"]) for row in new} | {instead_of}
    figures = {row["figure"] for row in new}
    return sorted([row for row in rows if shown(row["device"]) not in gone or (add and row["figure"] not in figures)] + new,
                  key=lambda row: (shown(row["device"]) != "two cores", row["device"], place(row)))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+", type=pathlib.Path)
    parser.add_argument("--add", action="store_true")
    parser.add_argument("--instead-of")
    parser.add_argument("--apart", default="")
    parser.add_argument("--note", default="")
    options = parser.parse_args()
    rows = merged(read(FILE) if FILE.exists() else [], [path.read_text(encoding="utf-8") for path in options.files], options.note,
                  options.instead_of, options.apart, options.add)
    with open(FILE, "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n", restval="")
        writer.writeheader()
        writer.writerows(rows)


if __name__ == "__main__":
    main()
