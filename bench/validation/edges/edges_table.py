#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Errors of wavetracer's fields behind edges: solves every case, and prints a table of errors in dB.

Usage: edges_table.py [--edges N] [--sets NAME...] [--rays N] [--csv FILE], or edges_table.py --lines [NAME...]; --edges is the largest number of diffractions in
one path. Two minutes on two cores. References: cases.py, and for solid bodies the CSV files beside this one, which
`solids.py bench/validation/edges` makes anew in some minutes.

Errors are those of the level, ours less the reference. For screens, whose reference has no polarisation, our level is
the mean of the levels of V and H. Where a path bends by more than STEEP_DEG, the references other than those of solid
bodies no longer hold to a fraction of a dB, so those cases have rows of their own.
"""
import argparse
import csv
import pathlib
import sys

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import cases  # noqa: E402
import lines  # noqa: E402
import tracer  # noqa: E402
import truth  # noqa: E402

STEEP_DEG = 10.0
EXACT = ("metal_exact", "concrete_block", "corners", "corners_front")  # the sets of solids.py
DEEP_DB = -60.0
MISSING_DB = -400.0  # a level that says: no path


def levels(rows, fields):
    """(set, wave, bend, reference in dB, ours in dB), with V and H of screens as one."""
    db = 20 * np.log10(np.maximum(np.abs(fields), 10 ** (MISSING_DB / 20)))
    out = []
    for i, row in enumerate(rows):
        reference = 20 * np.log10(abs(row["field"]))
        if row["shape"] != "screens":
            out.append((row["set"], row["wave"], row["bend_deg"], reference, db[i]))
        elif row["wave"] == "V":
            out.append((row["set"], "mean", row["bend_deg"], reference, (db[i] + db[i + 1]) / 2))
    return out


def cell(errors):
    if not len(errors):
        return "|  |  |  |  "
    found = errors[errors > MISSING_DB / 2]
    worst = f"{found[np.argmax(np.abs(found))]:+.2f}" if len(found) else ""
    share = 100 * np.mean(np.abs(errors) < 1)
    return f"| {len(errors)} | {np.median(np.abs(errors)):.2f} | {worst} | {share:.0f}% " + (
        f"({len(errors) - len(found)} without a path) " if len(found) < len(errors) else "")


def table(rows):
    lines = ["| set | wave | cases | median | worst | within 1 dB | below -60 dB: cases | median | worst | within 1 dB |",
             "| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |"]
    groups = {}
    for name, wave, bend, reference, ours in rows:
        steep = bend > STEEP_DEG and name not in EXACT
        groups.setdefault((name + (", steep" if steep else ""), wave), []).append((reference, ours - reference))
    for (name, wave), values in groups.items():
        reference, error = np.array(values).T
        lines.append(f"| {name} | {wave} " + cell(error[reference >= DEEP_DB]) + cell(error[reference < DEEP_DB]) + "|")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--edges", type=int, default=2)
    parser.add_argument("--rays", type=int, default=20_000)
    parser.add_argument("--sets", nargs="*", metavar="NAME")
    parser.add_argument("--lines", nargs="*", metavar="NAME",
                        help="largest steps of total fields along lines across boundaries instead (lines.py)")
    parser.add_argument("--csv", type=pathlib.Path, help="every case, with its reference and ours in dB")
    options = parser.parse_args()
    if options.lines is not None:
        print(lines.table(options.lines))
        return
    rows = cases.known() + [row for name in EXACT for row in truth.read(HERE / f"{name}.csv")]
    rows = [row for row in rows if not options.sets or row["set"] in options.sets]
    fields = tracer.solve(rows, options.edges, rays=options.rays, diffraction_rays=options.rays)
    print(table(levels(rows, fields)))
    if options.csv:
        with open(options.csv, "w", newline="", encoding="utf-8") as file:
            out = csv.writer(file, lineterminator="\n")
            out.writerow((*truth.COLUMNS, "ours_db"))
            for i, (row, field) in enumerate(zip(rows, fields)):
                ours = 20 * np.log10(abs(field)) if field else MISSING_DB
                out.writerow((*truth.line(row.get("number", i), row), f"{ours:.3f}"))


if __name__ == "__main__":
    main()
