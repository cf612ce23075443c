#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tells whether two devices have computed the same paths: all datasets of two paths.h5 must be the same bytes.

usage: same_paths.py PATHS_H5 PATHS_H5

Prints how much was compared, or a line per dataset that differs; the exit code is 1 where one does, or where no path is.
"""
import sys

import h5py
import numpy


def datasets(file):
    found = {}
    file.visititems(lambda name, item: found.update({name: item}) if isinstance(item, h5py.Dataset) else None)
    return found


def difference(a, b):
    if (a.shape, a.dtype) != (b.shape, b.dtype):
        return f"{a.shape} of {a.dtype} and {b.shape} of {b.dtype}"
    a, b = a[()], b[()]
    if numpy.asarray(a).dtype.hasobject:  # texts of any length: their handles differ
        return "" if numpy.array_equal(a, b) else "texts that differ"
    if a.tobytes() == b.tobytes():
        return ""
    if not a.shape:
        return f"{a} and {b}"
    rows = [i for i in range(len(a)) if a[i].tobytes() != b[i].tobytes()]
    return f"{len(rows)} of {len(a)} rows differ, the first is {rows[0]}"


def main():
    with h5py.File(sys.argv[1]) as first, h5py.File(sys.argv[2]) as second:
        one, other = datasets(first), datasets(second)
        faults = [f"{name}: in one of the two alone" for name in sorted(one.keys() ^ other.keys())]
        for name in sorted(one.keys() & other.keys()):
            fault = difference(one[name], other[name])
            faults += [f"{name}: {fault}"] if fault else []
        paths = len(one["paths/delay_s"]) if "paths/delay_s" in one else 0
    if not paths:
        faults.append("no path was compared")
    print("\n".join(faults) if faults else f"{paths} paths, {len(one)} datasets, the same bytes")
    sys.exit(1 if faults else 0)


main()
