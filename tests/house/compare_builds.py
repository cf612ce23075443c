#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that two builds of wavetracer write the same files: for changes of structure, which change no result.

usage: compare_builds.py BEFORE AFTER [--only TEXT] [--exports-of-all]

BEFORE and AFTER are the two programs. Every case, one of the files in configs/ with some keys set, is run by both; then
paths.h5, waypoints.h5, links.csv and the exports of the run must be the same bytes. Prints a line per case; the exit code
is 1 where a file differs. Run it from the project's folder.
"""
import argparse
import filecmp
import pathlib
import subprocess
import sys
import tempfile

FEW = ["trace.rays=20000"]
ALL = ["trace.diffraction=true", "trace.transmission=true", "trace.scattering=true"]
CASES = {
    **{name: (name, FEW) for name in ("demo", "city", "drive", "edges", "cache", "coverage")},
    "munich": ("munich", FEW),
    "all kinds": ("demo", FEW + ALL + ["time.end_s=0.2"]),
    "two diffractions": ("edges", FEW + ["trace.max_diffractions=2"]),
    "auto": ("demo", ["trace.rays=auto", "time.end_s=0.2"]),
    "auto, all kinds": ("city", ["trace.rays=auto"] + ALL),
    "no reuse": ("demo", FEW + ["trace.reuse=false", "time.end_s=0.2"]),
    "batches": ("demo", FEW + ["trace.batch_rays=3000", "time.end_s=0.1"]),
    "spheres": ("city", FEW + ["trace.reception=sphere"]),
    "spheres, cache": ("city", FEW + ["trace.reception=sphere", "cache.kind=open", "cache.division=500"]),
    "waypoints": ("demo", FEW + ["output.waypoints=100", "time.end_s=0.2"]),
    "chained cache": ("city", FEW + ["cache.kind=chained"]),
    "concurrent cache": ("city", FEW + ["cache.kind=concurrent"]),
    "each depth sorted": ("city", FEW + ["order.method=hilbert3d-histogram", "order.each_depth=true"]),
    "random directions": ("city", FEW + ["trace.directions=random"]),
    "fibonacci directions": ("city", FEW + ["trace.directions=fibonacci"]),
    "hilbert directions": ("city", FEW + ["trace.directions=hilbert"]),
    "few paths per link": ("demo", FEW + ["output.max_paths_per_link=3", "time.end_s=0.2"]),
    "no reflection": ("edges", FEW + ["trace.reflection=false"]),
}
FILES = ("paths.h5", "waypoints.h5", "links.csv")


def run(program, *arguments):
    done = subprocess.run([program, *arguments], capture_output=True, text=True)
    return done.returncode, done.stderr.strip().splitlines()[-1:] or [""]


def exports_of(program):
    """Returns the names of the formats that the program exports to."""
    done = subprocess.run([program, "convert", "--list"], capture_output=True, text=True, check=True)
    return [line.split()[0] for line in done.stdout.splitlines()]


def files_of(path):
    return {f.relative_to(path): f for f in path.rglob("*") if f.is_file()} if path.is_dir() else {path.name: path}


def different(before, after):
    a, b = files_of(before), files_of(after)
    if a.keys() != b.keys():
        return [f"{before.name}: files {sorted(map(str, a.keys() ^ b.keys()))} are in one of the two alone"]
    return [f"{before.name}/{name}" for name in a if not filecmp.cmp(a[name], b[name], shallow=False)]


def compare(before, after, config, sets, work, exports):
    options = [word for each in sets for word in ("--set", each)]
    codes, folders = [], []
    for side, program in (("before", before), ("after", after)):
        # Both use one name, since a few exports write the name of their run.
        folder = work / side / "run"
        codes.append(run(program, "run", "-c", f"configs/{config}.toml", "-o", folder, *options))
        folders.append(folder)
    if codes[0][0] != codes[1][0]:
        return [f"exit codes {codes[0]} and {codes[1]}"], 0
    if codes[0][0] != 0:
        return [], 0
    faults, count = [], 0
    for name in FILES:
        if any((folder / name).exists() for folder in folders):
            count += 1
            faults += different(folders[0] / name, folders[1] / name)
    for format in exports:
        targets = []
        for side, program in (("before", before), ("after", after)):
            target = work / side / format
            run(program, "convert", "--to", format, work / side / "run", "-o", target)
            targets.append(target)
        if any(target.exists() for target in targets):
            count += 1
            faults += different(*targets)
    return faults, count


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("before", type=pathlib.Path)
    parser.add_argument("after", type=pathlib.Path)
    parser.add_argument("--only", default="", help="cases whose name has this text")
    parser.add_argument("--exports-of-all", action="store_true", help="of every case, not of the demo and 'all kinds' alone")
    options = parser.parse_args()
    before, after = options.before.resolve(), options.after.resolve()
    failed = False
    formats = exports_of(before)
    for name, (config, sets) in CASES.items():
        if options.only not in name:
            continue
        exports = formats if options.exports_of_all or name in ("demo", "all kinds") else ()
        with tempfile.TemporaryDirectory() as work:
            faults, count = compare(before, after, config, sets, pathlib.Path(work), exports)
        verdict = "DIFFERENT: " + "; ".join(faults) if faults else f"{count} files and folders, the same bytes"
        print(f"{name}: {verdict if faults or count else 'REFUSED by both'}", flush=True)
        failed = failed or bool(faults) or not count
    sys.exit(1 if failed else 0)


main()
