#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Path gains that Sionna RT computes for the places of Boulder, as CSV: an argument of `validate.py measured --sionna`.

Usage: sionna_levels.py FOLDER FILE; FOLDER is boulder (docs/validation.md, "Measured levels"), FILE is written: a row for
each place with a path. It needs sionna-rt of PyPI and an LLVM from 16 on.
"""
import importlib.metadata
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "tests/python")]
import needs_sionna  # noqa: F401
import numpy as np
from sionna import rt

import measured_sets


def gains(folder):
    """Path gains in dB, one a place; nan without a path."""
    place = measured_sets.boulder(folder, window_db=0).position_m
    scene = rt.load_scene(str(folder / "scene/scene.xml"))
    scene.frequency = 28.5e9
    scene.tx_array = scene.rx_array = rt.PlanarArray(num_rows=1, num_cols=1, pattern="iso", polarization="V")
    scene.add(rt.Transmitter("tx", [0, 0, 2.5]))
    for i, at in enumerate(place):
        scene.add(rt.Receiver(f"p{i}", list(map(float, at))))
    paths = rt.PathSolver()(scene, max_depth=4, samples_per_src=10**6, max_num_paths_per_src=2 * 10**6, refraction=False,
                            diffraction=True, seed=1)
    a = np.abs(paths.cir(normalize_delays=False, out_type="numpy")[0]).reshape(len(place), -1)
    power = (a**2).sum(axis=1)
    return np.where(power > 0, 10 * np.log10(np.where(power > 0, power, 1)), np.nan)


def main():
    version = importlib.metadata.version("sionna-rt")
    rows = [f"Sionna RT {version},{i},{gain:.4f}" for i, gain in enumerate(gains(pathlib.Path(sys.argv[1]))) if np.isfinite(gain)]
    pathlib.Path(sys.argv[2]).write_text("\n".join(["program,place,gain_db", *rows]) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
