#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Steps of the field past the upper corners of a house, single edges, with trace.edge_ends and without: prints a table.

Usage: block_corner.py, with PYTHONPATH and the WAVETRACER variables as `./dev edges` sets them; needs numpy. A block of 6 x 8 x
6 m stands between both ends; 1201 receivers are on a line. A jump is how much more the field changes between two
neighbours than it does, on the mean, before and after them, in parts of the field in free space.
"""
import pathlib
import tempfile

import numpy as np
import wavetracer as wt

SPEED_OF_LIGHT = 299792458.0
RECEIVERS = 1201
LINES = {"past a corner of the roof, from behind": ((-20, 1, 5), (25, 2, 4), (25, 12, 9)),
         "beside the house, upwards": ((-20, 1, 5), (15, 9, 3), (15, 9, 10)),
         "over a corner of the roof": ((-15, -3, 7), (12, 4, 5), (16, 12, 8)),
         "into the street behind": ((-20, 1, 5), (6, 20, 2), (20, 6, 9))}
VERTICES = [(x, y, z) for z in (0, 6) for x, y in ((-3, -4), (3, -4), (3, 4), (-3, 4))]
FACES = ("1 4 3 2", "5 6 7 8", "1 2 6 5", "2 3 7 6", "3 4 8 7", "4 1 5 8")


def traced(material, f_hz, tx, receivers, edge_ends):
    """Returns the fields of V and H at the receivers, and the number of paths."""
    text = "".join("v {} {} {}\n".format(*p) for p in VERTICES) + f"o block\nusemtl {material}\n"
    text += "".join(f"f {face}\n" for face in FACES)
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "scene.obj").write_text(text, encoding="utf-8")
        config = {"scene": {"file": "scene.obj"}, "radio": {"frequency_hz": f_hz},
                  "transmitter": [{"name": "tx", "position_m": [float(x) for x in tx], "polarization": "VH"}],
                  "receiver": [{"name": f"rx{i}", "position_m": [float(x) for x in r], "polarization": "VH"}
                               for i, r in enumerate(receivers)],
                  "trace": {"rays": 20_000, "diffraction_rays": 5000, "diffraction": True, "edge_ends": edge_ends,
                            "max_diffractions": 1, "max_depth": 2}}
        with wt.Simulation(config, folder=folder) as simulation:
            paths = simulation.run_frame().paths
    out = np.zeros((len(receivers), 2), complex)
    for i, rx in enumerate(map(int, paths.rx)):
        direct = np.linalg.norm(receivers[rx] - np.array(tx))
        phase = np.exp(-2j * np.pi * f_hz * (paths.delay_s[i] - direct / SPEED_OF_LIGHT))
        out[rx] += np.diagonal(paths.a[i]) * phase * 4 * np.pi * direct * f_hz / SPEED_OF_LIGHT
    return out, len(paths.rx)


def cells(material, f_hz, line, edge_ends):
    tx, first, last = (np.array(p, float) for p in line)
    receivers = [first + (last - first) * t for t in np.linspace(0, 1, RECEIVERS)]
    fields, paths = traced(material, f_hz, tx, receivers, edge_ends)
    change = np.diff(fields, axis=0)
    jumps = np.abs(change[1:-1] - (change[:-2] + change[2:]) / 2).max(axis=0)
    return [f"{paths / RECEIVERS:.2f}"] + [f"{jump:.4f}" for jump in jumps]


if __name__ == "__main__":
    print("| walls, carrier, line | paths of a link | jump, V | H | with `trace.edge_ends`: paths | jump, V | H |")
    print("| --- |" + " ---: |" * 6)
    for walls in ("metal", "concrete"):
        for frequency_hz in (1e9, 5.9e9):
            for name, ends in LINES.items():
                both = cells(walls, frequency_hz, ends, False) + cells(walls, frequency_hz, ends, True)
                print(f"| {walls}, {frequency_hz / 1e9:g} GHz, {name} | " + " | ".join(both) + " |", flush=True)
