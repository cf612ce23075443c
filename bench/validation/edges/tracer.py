# SPDX-License-Identifier: Apache-2.0
"""The field that wavetracer computes for the cases of cases.py: every profile is drawn out to 800 m along the axis.

Screens and blocks lie: their axis is y, and the ways over them are those over roofs. A corner stands: its axis is z, and its
profile is in the plane z = 0, with its z along our y. Seen from an end, theta is then along the axis and phi across it in all
directions, so the fields of all paths have their signs in common where ways go steeply up as well.

Paths are added in phase. A point source spreads otherwise than a line source, which the references have: along the plane of
a profile, the field of a path of length s over that of free space is sqrt(direct / s) times that of a line source, exactly,
so every path is multiplied by the inverse.
"""
import itertools
import multiprocessing
import pathlib
import tempfile

import numpy as np
import wavetracer as wt

import solids

SPEED_OF_LIGHT = 299792458.0
HALF_M = 400.0  # along the axis, on both sides of the plane of the profile
DEEP_M = 800.0
BOX = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))


def profile(row):
    """The key of cases that can be solved in one scene."""
    return row["f_hz"], row["shape"], row["material"], tuple(row["places"]), tuple(row["tops"])


def placed(shape, x, height, along):
    """A point of a profile, and how far along the axis it is, in the coordinates of the scene."""
    return (x, height, along) if shape == "corner" else (x, along, height)


def write_scene(path, shape, places, tops):
    lines, count = [], 0
    if shape == "screens":
        bodies = [([(x, y, z) for y, z in ((top - DEEP_M, -HALF_M), (top, -HALF_M), (top, HALF_M), (top - DEEP_M, HALF_M))],
                   ((0, 1, 2, 3),)) for x, top in zip(places, tops)]
    else:
        walls = places if shape == "block" else (places[0], places[0] + DEEP_M)
        bodies = [([*itertools.product(walls, (-DEEP_M, 0.0), (-HALF_M, HALF_M))], BOX)]
    for i, (corners, faces) in enumerate(bodies):
        lines += ["v " + " ".join(repr(float(c)) for c in placed(shape, *corner)) for corner in corners]
        lines += [f"o body{i}", "usemtl body"]
        lines += ["f " + " ".join(str(count + j + 1) for j in face) for face in faces]
        count += len(corners)
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def configuration(f_hz, shape, material, edges, tx, rx, trace):
    epsilon = 1 - 1j * 1e7 / (2 * np.pi * f_hz * solids.EPSILON_0) if material == "metal" else solids.epsilon(material, f_hz)
    ends = [[{"name": f"{side}{i}", "position_m": list(placed(shape, x, z, 0.0)), "polarization": "VH"} for i, (x, z) in enumerate(places)]
            for side, places in (("tx", tx), ("rx", rx))]
    return {"scene": {"file": "scene.obj"}, "radio": {"frequency_hz": f_hz}, "transmitter": ends[0], "receiver": ends[1],
            "material": [{"name": "body", "permittivity": epsilon.real,
                          "conductivity_s_m": -epsilon.imag * 2 * np.pi * f_hz * solids.EPSILON_0,
                          "thickness_m": float("inf")}],
            "trace": {"rays": 20_000, "diffraction_rays": 20_000, "diffraction": True, "free_edges": True,
                      "reflection": shape != "screens", "max_diffractions": edges,
                      "max_depth": edges if shape == "screens" else edges + 1, **trace}}


def sums(paths, shape, tx, rx, f_hz):
    """The fields over free space by pair of ends, {(tx, rx): complex array (2,)}. If the profile lies flat, wave V is
    the theta component; if it stands upright, it is the phi component, which the two ends of a straight path see with
    opposite signs."""
    out = {}
    height, along = (1, 2) if shape == "corner" else (2, 1)
    offset, position = paths.vertex_offset, paths.vertex_position_m
    for i in range(len(paths.tx)):
        at = position[offset[i]:offset[i + 1]]
        if len(at) and (np.abs(at[:, along]).max() > 1 or at[:, height].min() < -0.5 * DEEP_M or
                        at[:, 0].max() > 0.5 * DEEP_M):
            continue  # over what the profile does not have
        pair = int(paths.tx[i]), int(paths.rx[i])
        direct = np.hypot(*np.subtract(rx[pair[1]], tx[pair[0]]))
        length = paths.delay_s[i] * SPEED_OF_LIGHT
        phase = np.exp(-2j * np.pi * f_hz * (length - direct) / SPEED_OF_LIGHT)
        scale = phase * np.sqrt(length / direct) * 4 * np.pi * direct * f_hz / SPEED_OF_LIGHT
        waves = np.array([-paths.a[i, 1, 1], paths.a[i, 0, 0]]) if shape == "corner" else np.diagonal(paths.a[i])
        out[pair] = out.get(pair, 0) + scale * waves
    return out


def solve_profile(group):
    """The fields of the ends [((x, z), (x, z))] of one profile, by pair: {(source, end): complex array (2,)}."""
    (f_hz, shape, material, places, tops), pairs, edges, trace = group
    tx, rx = (sorted(set(side)) for side in zip(*pairs))
    with tempfile.TemporaryDirectory() as folder:
        write_scene(pathlib.Path(folder) / "scene.obj", shape, places, tops)
        config = configuration(f_hz, shape, material, min(edges, len(places)), tx, rx, trace)
        with wt.Simulation(config, folder=folder) as simulation:
            found = sums(simulation.run_frame().paths, shape, tx, rx, f_hz)
    return {(tx[i], rx[j]): field for (i, j), field in found.items()}


def solve(rows, edges, processes=2, **trace):
    """The field of every row over free space, 0 where no path was found; at most `edges` diffractions in one path."""
    ends = [((row["tx_x"], row["tx_z"]), (row["rx_x"], row["rx_z"])) for row in rows]
    groups = {}
    for row, pair in zip(rows, ends):
        groups.setdefault(profile(row), []).append(pair)
    with multiprocessing.get_context("spawn").Pool(processes) as pool:
        work = [(key, pairs, edges, trace) for key, pairs in groups.items()]
        found = dict(zip(groups, pool.map(solve_profile, work, chunksize=1)))
    return np.array([found[profile(row)].get(pair, np.zeros(2))["VH".index(row["wave"])] for row, pair in zip(rows, ends)])
