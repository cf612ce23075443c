# SPDX-License-Identifier: Apache-2.0
"""Screens in free space: what our uniform theory of diffraction says of one edge and of two, beside ITU-R P.526.

Screens of metal, 6 km wide, hang down from z = 0 at one or two places along x. Ends at or below z = 0 move in height. Only
what goes over the upper edges counts, so borders and lower edges add nothing.
"""
import pathlib
import tempfile

import numpy as np
import wavetracer as wt

import p526

SPEED_OF_LIGHT = 299792458.0
CARRIERS_HZ = (5.9e9, 28e9)
SINGLE_M = ((10, 10), (50, 500), (100, 100), (1000, 1000))
DOUBLE_M = ((100, 100, 100), (100, 20, 100), (50, 10, 500), (500, 50, 500))
NUS = (-2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0, 3.0, 5.0, 10.0)
TURNS = (0.0, 0.5, 1.0, 2.0, 5.0)  # nu at each of two edges


def write_screens(path, places):
    """An OBJ file of screens at these x; z is up."""
    lines = []
    for i, x in enumerate(places):
        lines += [f"v {x} {y} {z}" for y, z in ((-3000, -1000), (3000, -1000), (3000, 0), (-3000, 0))]
        lines += [f"o screen{i}", "usemtl itu_metal", f"f {4 * i + 1} {4 * i + 2} {4 * i + 3} {4 * i + 4}"]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def fields(places, length_m, ends, frequency_hz, edges, polarization):
    """The field over free space of each pair of heights of the ends, which stand at x = 0 and length_m: paths over at most
    so many edges, and how many of them go over `edges`."""
    with tempfile.TemporaryDirectory() as folder:
        write_screens(pathlib.Path(folder) / "screens.obj", places)
        low, high = ([{"name": f"{side}{i}", "position_m": [x, 0, height], "polarization": polarization}
                      for i, height in enumerate(heights)] for side, x, heights in
                     (("tx", 0, [e[0] for e in ends]), ("rx", length_m, [e[1] for e in ends])))
        config = {"scene": {"file": "screens.obj"}, "radio": {"frequency_hz": frequency_hz}, "transmitter": low,
                  "receiver": high, "trace": {"rays": 20_000, "max_depth": edges, "reflection": False, "diffraction": True,
                                              "max_diffractions": edges, "diffraction_rays": 20_000}}
        with wt.Simulation(config, folder=folder) as simulation:
            paths = simulation.run_frame().paths
    out, over_all = np.zeros(len(ends), complex), np.zeros(len(ends), int)
    offset, position = paths.vertex_offset, paths.vertex_position_m
    for row in np.flatnonzero(paths.tx == paths.rx):
        at = position[offset[row]:offset[row + 1]]
        if len(at) and (np.abs(at[:, 2]).max() > 1e-3 or np.abs(at[:, 1]).max() > 1):
            continue  # over a border of a screen
        pair = paths.tx[row]
        over_all[pair] += len(at) == edges
        direct_m = np.hypot(length_m, ends[pair][0] - ends[pair][1])
        phase = np.exp(-2j * np.pi * frequency_hz * (paths.delay_s[row] - direct_m / SPEED_OF_LIGHT))
        out[pair] += paths.a[row, 0, 0] * phase / (SPEED_OF_LIGHT / frequency_hz / (4 * np.pi * direct_m))
    return out, over_all


def losses(places, length_m, ends, frequency_hz, edges):
    """The loss over free space in dB with vertical and horizontal waves, shape (ends, 2)."""
    both = []
    for polarization in "VH":
        field, over_all = fields(places, length_m, ends, frequency_hz, edges, polarization)
        if not over_all.all():
            raise RuntimeError(f"screens at {places}: ends {[ends[i] for i in np.flatnonzero(over_all == 0)]} got no path "
                               f"over {edges} edges")
        both.append(-20 * np.log10(np.abs(field)))
    return np.transpose(both)


def single(frequencies=CARRIERS_HZ, distances=SINGLE_M, nus=NUS):
    """Rows of one edge: f, d1, d2, nu, ours V and H, the exact integral and the approximation of P.526."""
    rows = []
    for f in frequencies:
        for d1, d2 in distances:
            heights = [nu / p526.nu_of(1, d1, d2, SPEED_OF_LIGHT / f) for nu in nus]
            got = losses([d1], d1 + d2, [(-h, -h) for h in heights], f, 1)
            rows += [{"frequency_hz": f, "d1_m": d1, "d2_m": d2, "nu": nu, "v_db": v, "h_db": h,
                      "exact_db": float(p526.single_exact_db(nu)), "p526_db": float(p526.single_db(nu))}
                     for nu, (v, h) in zip(nus, got.tolist())]
    return rows


def double(frequencies=CARRIERS_HZ, distances=DOUBLE_M, turns=TURNS):
    """Rows of two edges of one height. The ends are so far below that the way over both turns down by nu_1 and nu_2."""
    rows = []
    for f in frequencies:
        wavelength = SPEED_OF_LIGHT / f
        for a, b, c in distances:
            pairs = [(one, two) for one in turns for two in turns]
            # The drop of a half path at an edge is its height over the line from its end to the other edge, turn * a b
            # / (a + b).
            drop = [(one / p526.nu_of(b / (a + b), a, b, wavelength), two / p526.nu_of(b / (b + c), b, c, wavelength))
                    for one, two in pairs]
            got = losses([a, a + b], a + b + c, [(-low, -high) for low, high in drop], f, 2)
            for (one, two), (low, high), (v, h) in zip(pairs, drop, got.tolist()):
                above = [low + (high - low) * x / (a + b + c) for x in (a, a + b)]  # edges over the line of the ends
                rows.append({"frequency_hz": f, "a_m": a, "b_m": b, "c_m": c, "nu_1": one, "nu_2": two, "v_db": v,
                             "h_db": h, "exact_db": float(p526.double_exact_db(a, b, c, *above, wavelength)),
                             "p526_db": float(p526.double_db(a, b, c, *above, wavelength))})
    return rows
