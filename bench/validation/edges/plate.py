#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fields past the corner of a metal plate, single edges, beside Kirchhoff's integral: prints a table.

Usage: plate.py, with PYTHONPATH and the WAVETRACER variables as `./dev edges` sets them; needs numpy. The plate hangs
upright between both ends; 241 receivers are on a line from deep shadow past the shadow of a corner, and edges have the waves
of their ends (trace.edge_ends) or not. Kirchhoff's integral over the space beside the plate is Rubinowicz' integral along
its rim, by Simpson's rule, which holds at any angle. It has no polarisation, so the mean of the fields of V and H is
compared. A step is the largest change of the difference from one receiver to the next.
"""
import pathlib
import tempfile

import numpy as np
import wavetracer as wt

SPEED_OF_LIGHT = 299792458.0
RECEIVERS = 241
TX = (0.3, 0.2)
POINTS = 12001  # along a side: 60 per wavelength for the longest side and the shortest wave


def corners_of(plate):
    w, h = plate
    return np.array([(0, -w / 2, -h / 2), (0, w / 2, -h / 2), (0, w / 2, h / 2), (0, -w / 2, h / 2)])


def from_rim(plate, f_hz, tx, rx):
    """Returns the wave of the plate's rim, in parts of the field in free space."""
    k, direct = 2 * np.pi * f_hz / SPEED_OF_LIGHT, np.linalg.norm(rx - tx)
    weights = np.where(np.arange(POINTS) % 2, 4.0, 2.0) / (3 * (POINTS - 1))
    weights[[0, -1]] /= 2
    total = 0j
    corners = corners_of(plate)
    for a, b in zip(corners, np.roll(corners, -1, axis=0)):
        points = a + np.linspace(0, 1, POINTS)[:, None] * (b - a)
        to, on = points - tx, rx - points
        there, back = np.linalg.norm(to, axis=1), np.linalg.norm(on, axis=1)
        product = there * back
        strength = np.cross(to, on) @ (b - a) / np.maximum(product - np.einsum("ij,ij->i", to, on), 1e-14 * product)
        total += np.sum(weights * strength / product * np.exp(-1j * k * (there + back - direct)))
    return -total * direct / (4 * np.pi)


def truth_at(plate, f_hz, legs, receiver):
    tx, rx = np.array([-legs[0], *TX]), np.array([legs[1], *receiver])
    through = (np.array(TX) * legs[1] + np.array(receiver) * legs[0]) / sum(legs)
    return from_rim(plate, f_hz, tx, rx) + (0 if np.all(np.abs(through) <= np.array(plate) / 2) else 1)


def traced(plate, f_hz, legs, receivers, edge_ends):
    with tempfile.TemporaryDirectory() as folder:
        text = "".join("v {!r} {!r} {!r}\n".format(*map(float, p)) for p in corners_of(plate)) + "o plate\nusemtl metal\nf 1 2 3 4\n"
        (pathlib.Path(folder) / "scene.obj").write_text(text, encoding="utf-8")
        config = {"scene": {"file": "scene.obj"}, "radio": {"frequency_hz": f_hz},
                  "transmitter": [{"name": "tx", "position_m": [-legs[0], *TX], "polarization": "VH"}],
                  "receiver": [{"name": f"rx{i}", "position_m": [legs[1], *map(float, r)], "polarization": "VH"}
                               for i, r in enumerate(receivers)],
                  "trace": {"rays": 20_000, "diffraction_rays": 20_000, "diffraction": True, "free_edges": True,
                            "edge_ends": edge_ends, "max_diffractions": 1, "max_depth": 2}}
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
    truth = np.array([truth_at(plate, f_hz, legs, receiver) for receiver in receivers])
    level = 20 * np.log10(np.abs(truth))
    cells = [f"{plate[0]:g} x {plate[1]:g} m, {f_hz / 1e9:g} GHz, {legs[0]:g} + {legs[1]:g} m"]
    for edge_ends in (False, True):
        ours = traced(plate, f_hz, legs, receivers, edge_ends).mean(axis=1)
        error = np.abs(20 * np.log10(np.maximum(np.abs(ours), 1e-9)) - level)[level > -40]
        cells += [f"{np.median(error):.2f}", f"{np.quantile(error, 0.9):.2f}", f"{error.max():.2f}",
                  f"{np.abs(ours - truth).max():.3f}", f"{np.abs(np.diff(ours - truth)).max():.4f}"]
    return "| " + " | ".join(cells) + " |"


if __name__ == "__main__":
    print("| plate, carrier, ends from it | median error, dB | 90%, dB | most, dB | largest error, of free space "
          "| largest step | with `trace.edge_ends`: median | 90%, dB | most, dB | error | step |")
    print("| --- |" + " ---: |" * 10)
    for size in ((3, 2), (10, 7)):
        for frequency_hz in (1e9, 2e9, 6e9):
            for both_legs in ((20.0, 20.0), (10.0, 50.0)):
                print(row(size, frequency_hz, both_legs), flush=True)
