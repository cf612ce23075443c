#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fields past the corner of a metal plate, single edges, beside Kirchhoff's integral: prints a table.

Usage: plate.py, with PYTHONPATH and the WAVETRACER variables as `./dev edges` sets them; needs scipy. The plate hangs upright
between both ends; 241 receivers are on a line from deep shadow past the shadow of a corner. Kirchhoff's integral over the
plate is a product of two Fresnel integrals, with no polarisation, so the mean of the fields of V and H is compared. A step is
the largest change of the difference from one receiver to the next.
"""
import pathlib
import tempfile

import numpy as np
import wavetracer as wt
from scipy.special import fresnel

SPEED_OF_LIGHT = 299792458.0
RECEIVERS = 241
TX = (0.3, 0.2)


def covered(size, f_hz, legs, a, b):
    """Returns the part of a Fresnel zone that the plate covers along one axis, 1 for a plate without end."""
    scale = np.sqrt(2 * f_hz / SPEED_OF_LIGHT * sum(legs) / (legs[0] * legs[1]))
    middle = (a * legs[1] + b * legs[0]) / sum(legs)
    (s0, c0), (s1, c1) = (fresnel((edge - middle) * scale) for edge in (-size / 2, size / 2))
    return ((c1 - c0) - 1j * (s1 - s0)) / (1 - 1j)


def traced(plate, f_hz, legs, receivers):
    w, h = plate
    corners = ((0, -w / 2, -h / 2), (0, w / 2, -h / 2), (0, w / 2, h / 2), (0, -w / 2, h / 2))
    with tempfile.TemporaryDirectory() as folder:
        text = "".join("v {!r} {!r} {!r}\n".format(*map(float, p)) for p in corners) + "o plate\nusemtl metal\nf 1 2 3 4\n"
        (pathlib.Path(folder) / "scene.obj").write_text(text, encoding="utf-8")
        config = {"scene": {"file": "scene.obj"}, "radio": {"frequency_hz": f_hz},
                  "transmitter": [{"name": "tx", "position_m": [-legs[0], *TX], "polarization": "VH"}],
                  "receiver": [{"name": f"rx{i}", "position_m": [legs[1], *map(float, r)], "polarization": "VH"}
                               for i, r in enumerate(receivers)],
                  "trace": {"rays": 20_000, "diffraction_rays": 20_000, "diffraction": True, "free_edges": True,
                            "max_diffractions": 1, "max_depth": 2}}
        with wt.Simulation(config, folder=folder) as simulation:
            paths = simulation.run_frame().paths
    out = np.zeros((len(receivers), 2), complex)
    for i, rx in enumerate(map(int, paths.rx)):
        direct = np.sqrt(sum(legs)**2 + np.subtract(receivers[rx], TX)[0]**2 + np.subtract(receivers[rx], TX)[1]**2)
        phase = np.exp(-2j * np.pi * f_hz * (paths.delay_s[i] - direct / SPEED_OF_LIGHT))
        out[rx] += np.diagonal(paths.a[i]) * phase * 4 * np.pi * direct * f_hz / SPEED_OF_LIGHT
    return out * np.where(out[-1].real < 0, -1, 1)


def row(plate, f_hz, legs):
    reach = 0.65 * sum(legs) / legs[0] * np.array(plate)
    receivers = [(0.1 + t * reach[0], 0.15 + t * reach[1]) for t in np.linspace(0, 1, RECEIVERS)]
    ours = traced(plate, f_hz, legs, receivers).mean(axis=1)
    truth = np.array([1 - covered(plate[0], f_hz, legs, TX[0], y) * covered(plate[1], f_hz, legs, TX[1], z)
                      for y, z in receivers])
    level = 20 * np.log10(np.abs(truth))
    error = np.abs(20 * np.log10(np.maximum(np.abs(ours), 1e-9)) - level)[level > -40]
    return (f"| {plate[0]:g} x {plate[1]:g} m, {f_hz / 1e9:g} GHz, {legs[0]:g} + {legs[1]:g} m | {np.median(error):.2f} | "
            f"{np.quantile(error, 0.9):.2f} | {np.abs(ours - truth).max():.3f} | {np.abs(np.diff(ours - truth)).max():.3f} |")


if __name__ == "__main__":
    print("| plate, carrier, ends from it | median error, dB | 90%, dB | largest error, of free space | largest step |")
    print("| --- | ---: | ---: | ---: | ---: |")
    for plate in ((3, 2), (10, 7)):
        for f_hz in (1e9, 2e9, 6e9):
            for legs in ((20.0, 20.0), (10.0, 50.0)):
                print(row(plate, f_hz, legs))
