#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""cell_mean_db and fading_db of cells in a street, against the program's own gains at 400 places in each cell.

    read_areas.py PROGRAM FOLDER

Needs numpy, h5py and an OpenCL device; answers 77 where one is missing.
"""
import json

import numpy as np
from map_reading import column, main, run, table

# A street of two walls of 60 x 12 m over the ground, and a gap between houses behind one of them.
WALLS = """v -60 -60 0
v 60 -60 0
v 60 60 0
v -60 60 0
v -30 -8 0
v 30 -8 0
v 30 -8 12
v -30 -8 12
v -30 9 0
v 30 9 0
v 30 9 12
v -30 9 12
f 1 2 3 4
f 5 6 7 8
f 9 10 11 12
"""
STREET = """
scene.file = "{scene}"
scene.default_material = "concrete"
radio.frequency_hz = {frequency_hz}
[trace]
rays = 200000
max_depth = 3
{limits}
[[transmitter]]
name = "t"
position_m = [-27, 1, 7]
polarization = "{ports}"
"""
GRID = """
[[receiver_grid]]
name = "{name}"
x_min_m = {x}
x_max_m = {x_end}
y_min_m = {y}
y_max_m = {y_end}
step_m = {step}
polarization = "{ports}"
"""
PLANE = """
[[receiver_grid]]
name = "{name}"
from_m = [{x}, {y}]
to_m = [{x_end}, {y_end}]
z_min_m = 2
z_max_m = {z_end}
step_m = {step}
polarization = "{ports}"
"""


def places(side, ports):
    """Grids of one cell, and of 20 x 20 points in each of them."""
    text, cells = "", []
    for k, (x, y) in enumerate(((12, -3), (20.3, 4.1), (5, 6))):
        for name, step in ((f"cell{k}", side), (f"points{k}", side / 20)):
            text += GRID.format(name=name, x=x, x_end=x + side, y=y, y_end=y + side, step=step, ports=ports)
        cells.append((f"cell{k}", f"points{k}"))
    for name, step in (("wall", side), ("points_of_wall", side / 20)):
        text += PLANE.format(name=name, x=10, y=-2, x_end=10 + .6 * side, y_end=-2 + .8 * side, z_end=2 + side, step=step, ports=ports)
    return text, cells + [("wall", "points_of_wall")]


def layers(program, out, folder, grid, names):
    done = run(program, "coverage", out, "--grid", grid, "-o", folder / grid, "--layers", ",".join(names))
    rows = table(folder / grid / "coverage.csv")
    return done.stderr, [column(rows, name) for name in names]


def check(program, folder, frequency_hz, side, ports, tolerance_db):
    folder.mkdir()
    text, cells = places(side, ports)
    (folder / "street.obj").write_text(WALLS)
    street = STREET.format(scene=folder / "street.obj", frequency_hz=frequency_hz, limits="", ports=ports)
    (folder / "run.toml").write_text(street + text)
    run(program, "run", "-c", folder / "run.toml", "-o", folder / "out")
    for cell, points in cells:
        said, ((mean_db,), (fading_db,), (count,)) = layers(program, folder / "out", folder, cell, ("cell_mean_db", "fading_db", "paths"))
        _, (gain_db, paths) = layers(program, folder / "out", folder, points, ("narrowband_gain_db", "paths"))
        assert said == "" and len(gain_db) == 400 and (paths == count).all() and count > 4, (said, count, paths)
        power = 10 ** (gain_db / 10)
        exact_db = 10 * np.log10(power.mean()), 10 * np.log10(power.var() / power.mean() ** 2)
        print(f"{side} m at {frequency_hz / 1e9} GHz, {ports}, {cell}, {count:.0f} paths: mean {mean_db:.2f} dB, of points "
              f"{exact_db[0]:.2f}; fading {fading_db:.2f} dB, of points {exact_db[1]:.2f}")
        assert abs(mean_db - exact_db[0]) < tolerance_db[0] and abs(fading_db - exact_db[1]) < tolerance_db[1]
    return street, text
    return street, text


def areas(program, folder):
    check(program, folder / "large", 1e9, 2, "V", (.3, .6))
    street, text = check(program, folder / "small", 5.9e9, .2, "VH", (.1, .3))
    # A limit of output: a warning says what is missing, and the cell has what is left.
    place = folder / "small"
    limited = street.replace("[[transmitter]]", "[output]\nmax_paths_per_link = 1\n[[transmitter]]", 1)
    (place / "limited.toml").write_text(limited + text)
    run(program, "run", "-c", place / "limited.toml", "-o", place / "limited")
    said, ((mean_db,), (fading_db,)) = layers(program, place / "limited", place, "cell0", ("cell_mean_db", "fading_db"))
    assert "max_paths_per_link) have left out up to " in said and "% of the power of a cell" in said, said
    assert fading_db == -np.inf and np.isfinite(mean_db), fading_db
    assert json.loads((place / "cell0/coverage.json").read_text())["notes"], said
    said, _ = layers(program, place / "limited", place, "cell0", ("path_gain_db",))
    assert said == "", said


main(areas)
