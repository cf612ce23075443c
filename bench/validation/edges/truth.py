#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the cases and their references as CSV files, one per set: FOLDER/SET.csv."""
import csv
import pathlib
import sys

import numpy as np

import cases

COLUMNS = ("set", "number", "f_hz", "wave", "shape", "material", "places", "tops", "tx_x", "tx_z", "rx_x", "rx_z", "bend_deg",
           "db", "re", "im")


def line(number, row):
    field = row["field"]
    lists = {key: ";".join(repr(float(x)) for x in row[key]) for key in ("places", "tops")}
    values = {**row, **lists, "number": number, "db": f"{20 * np.log10(abs(field)):.3f}", "re": repr(field.real),
              "im": repr(field.imag), "bend_deg": f"{row['bend_deg']:.3f}"}
    return [values[key] for key in COLUMNS]


def write(folder, rows):
    by_set = {}
    for row in rows:
        by_set.setdefault(row["set"], []).append(row)
    for name, members in by_set.items():
        with open(pathlib.Path(folder) / f"{name}.csv", "w", newline="", encoding="utf-8") as file:
            out = csv.writer(file, lineterminator="\n")
            out.writerow(COLUMNS)
            out.writerows(line(i, row) for i, row in enumerate(members))


def read(path):
    """The rows of one file, as cases.known() gives them."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        for key in ("places", "tops"):
            row[key] = [float(x) for x in row[key].split(";")]
        for key in ("f_hz", "tx_x", "tx_z", "rx_x", "rx_z", "bend_deg"):
            row[key] = float(row[key])
        row["field"] = complex(float(row.pop("re")), float(row.pop("im")))
    return rows


if __name__ == "__main__":
    write(sys.argv[1], cases.known())
