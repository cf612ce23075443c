#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every kernel of kernels/ is measured by bench_kernels, and has a stored row on a CPU and on a GPU.

usage: kernel_rows_test.py [--write] SOURCE

The list of kernels is that of the sources. kernels_without_row.txt, beside this file, names the kernels that no row is
stored of yet; it may only become shorter, and --write removes the lines of rows that are there. `bench_kernels`, on the
device, prints the rows of bench/results/kernels.jsonl.
"""
import json
import pathlib
import re
import sys
import tempfile

KINDS = ("cpu", "gpu")


def kernels(root):
    """The names program/kernel of all kernels, from the sources."""
    return {f"{path.stem}/{kernel}" for path in (root / "kernels").rglob("*.cl") if path.parent.name != "lib"
            for kernel in re.findall(r"\bkernel void (\w+)\(", path.read_text(encoding="utf-8"))}


def measured(root):
    """The names that `bench_kernels --list` prints, from its tables."""
    tables = (root / "bench" / name for name in ("kernel_costs.cpp", "sort_kernels.cpp", "bench_kernels.cpp"))
    return {name for table in tables for name in re.findall(r'"(\w+/\w+)"', table.read_text(encoding="utf-8"))}


def unmeasured(names, listed):
    """Faults of the benchmark's own list."""
    return [f"{name}: bench_kernels does not measure it; see bench/kernel_costs.cpp" for name in sorted(names - listed)]


def without_row(names, rows, awaited):
    """Faults of the stored rows. awaited: lines KIND PROGRAM/KERNEL of those that no row is stored of yet."""
    stored = {f"{row['device_kind']} {row['kernel']}" for row in rows if "kernel" in row}
    wanted = {f"{kind} {name}" for kind in KINDS for name in names}
    faults = [f"{line}: bench/results/kernels.jsonl has no row of it" for line in sorted(wanted - stored - awaited)]
    return faults + [f"kernels_without_row.txt: {line} has a row or is gone: remove the line"
                     for line in sorted(awaited - (wanted - stored))]


def read_rows(path):
    return [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines() if line.strip()]


def try_the_checks():
    """The checks find what they are for."""
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        (root / "kernels/rays").mkdir(parents=True)
        (root / "kernels/lib").mkdir()
        (root / "kernels/rays/turn.cl").write_text("kernel void turn(global uint* a) {}\n  kernel void back(uint n) {}\n")
        (root / "kernels/lib/part.cl").write_text("kernel void no_program(uint n) {}\n")
        assert kernels(root) == {"turn/turn", "turn/back"}, kernels(root)
    assert len(unmeasured({"a/b", "a/c"}, {"a/b"})) == 1
    rows = [{"kernel": "a/b", "device_kind": "cpu"}, {"case": "a row of no kernel"}]
    assert without_row({"a/b"}, rows, {"gpu a/b"}) == []
    assert "gpu a/b" in without_row({"a/b"}, rows, set())[0]
    assert "remove the line" in without_row({"a/b"}, rows, {"gpu a/b", "cpu a/b"})[0]
    assert "remove the line" in without_row({"a/b"}, rows, {"gpu a/b", "gpu a/gone"})[0]


def main():
    try_the_checks()
    root = pathlib.Path(sys.argv[-1])
    names, rows = kernels(root), read_rows(root / "bench/results/kernels.jsonl")
    path = pathlib.Path(__file__).parent / "kernels_without_row.txt"
    lines = path.read_text(encoding="utf-8").splitlines()
    if "--write" in sys.argv:
        stored = {f"{row['device_kind']} {row['kernel']}" for row in rows if "kernel" in row}
        lines = [line for line in lines if line not in stored]
        path.write_text("".join(f"{line}\n" for line in lines), encoding="utf-8")
    faults = unmeasured(names, measured(root))
    faults += without_row(names, rows, {line for line in lines if line and line[0] != "#"})
    print("\n".join(faults))
    sys.exit(f"{len(faults)} faults" if faults else 0)


if __name__ == "__main__":
    main()
