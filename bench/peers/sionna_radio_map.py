#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Cells a second of Sionna RT's RadioMapSolver on the map of bench_coverage; one JSON line for each number of rays on standard output.

    bench_coverage --write-grid grid.json
    sionna_radio_map.py grid.json MUNICH.xml > peer.jsonl
    bench_coverage --peer peer.jsonl

Needs `pip install sionna-rt`; on CPUs LLVM, too, as sionna_rt.py says. The solver counts rays that pass a cell, so its
map has noise where ours has none: "error" is the share of the cells whose gain is off by more than 0.1 dB, or that are
empty, against ten times its own rays, or 4e9 if that is less.
"""
import argparse
import json
import pathlib
import statistics
import time

import mitsuba as mi
import numpy as np
from sionna.rt import PlanarArray, RadioMapSolver, Transmitter, load_scene


MOST_RAYS = 4_000_000_000  # the solver counts them in 32 bits


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("grid", type=pathlib.Path, help="written by bench_coverage --write-grid")
    parser.add_argument("scene", help="the Mitsuba XML file of the same scene")
    parser.add_argument("--rays", type=int, nargs="+", help="instead of those of the grid")
    parser.add_argument("--runs", type=int, default=3, help="warm solves of which the median counts")
    arguments = parser.parse_args()
    grid = json.loads(arguments.grid.read_text())
    scene = load_scene(arguments.scene)
    scene.frequency = grid["frequency_hz"]
    scene.tx_array = PlanarArray(num_rows=1, num_cols=1, pattern="iso", polarization="V")
    x, y, _ = grid["transmitter_m"]
    scene.add(Transmitter("tx", position=mi.Point3f(grid["transmitter_m"])))
    solver = RadioMapSolver()

    def solve(rays):
        start = time.perf_counter()
        gain = solver(scene, center=mi.Point3f(x, y, grid["height_m"]), orientation=mi.Point3f(0, 0, 0),
                      size=mi.Point2f(grid["side_m"], grid["side_m"]),
                      cell_size=mi.Point2f(grid["step_m"], grid["step_m"]), samples_per_tx=rays,
                      max_depth=grid["max_depth"], los=True, specular_reflection=True,
                      diffuse_reflection=False, refraction=False).path_gain.numpy()[0]
        return time.perf_counter() - start, gain

    for rays in arguments.rays or [grid["rays"]]:
        solve(rays)
        runs = [solve(rays) for _ in range(arguments.runs)]
        seconds, gain = statistics.median(s for s, _ in runs), runs[-1][1]
        reference = solve(min(10 * rays, MOST_RAYS))[1]
        heard = reference > 0
        with np.errstate(divide="ignore", invalid="ignore"):
            off_db = np.abs(10 * np.log10(gain[heard] / reference[heard]))
        print(json.dumps({"scene": grid["scene"], "rays": rays,
                          "device": f"Sionna RT RadioMapSolver, {mi.variant()}", "value": gain.size / seconds,
                          "unit": "receivers/s", "cells": gain.size, "frame_s": seconds,
                          "error": float(np.mean(~(off_db <= 0.1)))}), flush=True)


if __name__ == "__main__":
    main()
