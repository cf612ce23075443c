#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A coverage map of a city of 2 km x 2 km with diffraction, in cells of 5 m: its seconds, and its error.

    coverage_2km.py                          # 160,000 cells, on the default device
    coverage_2km.py --device H200 --rays 1000000
    coverage_2km.py --side 200 --step 10     # a small one, to try

The configuration is configs/coverage_2km.toml, which comes with the package. Every cell has every path of up to `--depth`
interactions, of which one may be a diffraction. The error is measured against the same map with ten times the rays, of
the transmitter and of the edges: the share of cells that hear less than 0.1 dB right, or nothing where the other map
hears something. The last line is JSON.
"""
import argparse
import json
import math
import sys
import time

import numpy as np
import wavetracer as wt

CONFIGURATION = wt.configs / "coverage_2km.toml"
WRONG_DB = 0.1


def keys(options, times):
    """The keys that replace those of the configuration. A smaller map has a smaller city."""
    half, blocks = options.side / 2, max(2, math.ceil(options.side / 100))
    grid = {"x_min_m": -half, "x_max_m": half, "y_min_m": -half, "y_max_m": half, "step_m": options.step}
    return {"scene.generate": f"--seed 1 --blocks {blocks}x{blocks}",
            "trace": {"rays": options.rays * times, "max_depth": options.depth,
                      "edge_rays": options.edge_rays * times},
            **{f"receiver_grid.0.{key}": value for key, value in grid.items()}}


def solve(options, times=1):
    """The path gain of every cell, shape (cells,), and the seconds of loading, of the first frame, and of a second one,
    for which the kernels and buffers exist."""
    start = time.perf_counter()
    with wt.Simulation(CONFIGURATION, device=options.device, **keys(options, times)) as simulation:
        ready = time.perf_counter()
        frame = simulation.run_frame()
        first = time.perf_counter()
        paths, missed = len(frame), frame.missed
        gain_db = frame.links["path_gain_db"].copy()
        del frame
        simulation.forget()
        again = time.perf_counter()
        if times == 1:
            simulation.run_frame()
        seconds = {"load": ready - start, "first_frame": first - ready, "frame": time.perf_counter() - again}
        return gain_db, {"device": simulation.device, "paths": paths, "seconds": seconds, "missed": missed}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--side", type=float, default=2000, help="of the map, metres")
    parser.add_argument("--step", type=float, default=5, help="side of a cell, metres")
    parser.add_argument("--rays", type=int, default=1_000_000, help="of the transmitter")
    parser.add_argument("--edge-rays", type=int, default=1000, help="of each edge that the transmitter sees")
    parser.add_argument("--depth", type=int, default=3, help="interactions of a path")
    parser.add_argument("--device", help="part of its name")
    parser.add_argument("--no-reference", action="store_true", help="do not measure the error")
    options = parser.parse_args()
    gain_db, told = solve(options)
    heard = int(np.isfinite(gain_db).sum())
    told |= {"cells": len(gain_db), "heard": heard, "options": vars(options)}
    seconds = told["seconds"]
    print(f"{len(gain_db):,} cells, {heard:,} of them hear {told['paths']:,} paths; {seconds['frame']:.2f} s a map, "
          f"{seconds['first_frame']:.2f} s the first one, on {told['device']}", file=sys.stderr, flush=True)
    if not options.no_reference:
        reference_db, other = solve(options, 10)
        known = np.isfinite(reference_db)
        off_db = np.abs(gain_db[known] - reference_db[known])  # inf where nothing is heard
        told["error"] = {"share_of_cells_off_by_0.1_db": float((off_db > WRONG_DB).mean()),
                         "share_of_cells_lost": float(np.isinf(off_db).mean()),
                         "mean_off_db": float(off_db[np.isfinite(off_db)].mean()), "reference_paths": other["paths"]}
        wrong, lost = told["error"]["share_of_cells_off_by_0.1_db"], told["error"]["share_of_cells_lost"]
        print(f"against ten times the rays: {wrong:.2%} of the cells are off by more than {WRONG_DB} dB, {lost:.2%} hear "
              "nothing", file=sys.stderr)
    print(json.dumps(told))


if __name__ == "__main__":
    main()
