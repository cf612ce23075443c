#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares the path gains of runs with those of a reference, link by link: the error of a coverage map with fewer rays.

usage: compare_maps.py REFERENCE RUN...

All are folders of runs with the same ends. A row per run and range of the reference's path gain shows the links in
that range, those that the run does not have, and the error of the others, in dB, at the median and at nine of ten.
"""
import csv
import math
import pathlib
import statistics
import sys

RANGES_DB = [(-110, 0), (-130, -110), (-150, -130), (-math.inf, -150)]


def gains(folder):
    with open(pathlib.Path(folder, "links.csv"), newline="") as file:
        rows = [((row["time_s"], row["tx"], row["rx"]), row["path_gain_db"]) for row in csv.DictReader(file)]
    return {link: float(gain) for link, gain in rows if gain not in ("", "-inf", "nan")}


def main():
    if len(sys.argv) < 3:
        sys.exit((__doc__ or "").split("\n\n")[1])
    reference = gains(sys.argv[1])
    print(f"{'run':<24} {'path gain, dB':>16} {'links':>7} {'lost':>6} {'median, dB':>11} {'9 of 10, dB':>12}")
    for folder in sys.argv[2:]:
        found = gains(folder)
        for low, high in RANGES_DB:
            links = [link for link, gain in reference.items() if low <= gain < high]
            errors = sorted(abs(found[link] - reference[link]) for link in links if link in found)
            numbers = (f"{statistics.median(errors):>11.2f} {errors[math.ceil(0.9 * len(errors)) - 1]:>12.2f}" if errors
                       else f"{'-':>11} {'-':>12}")
            print(f"{pathlib.Path(folder).name:<24} {f'{low:g} to {high:g}':>16} {len(links):>7} "
                  f"{len(links) - len(errors):>6} {numbers}")


if __name__ == "__main__":
    main()
