#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Maps of vertical planes and of several heights in free space, against Friis' formula at the places of their cells.

    read_planes.py PROGRAM FOLDER

Needs numpy, h5py, GDAL's programs (Debian's gdal-bin) and an OpenCL device; answers 77 where one is missing.
"""
import json

import h5py
import numpy as np
from map_reading import FREE_SPACE, LIGHT_M_S, column, free_run, main, pixels, run, same, table

# 20 m in the direction (0.6, -0.8), of which nine cells of 2.1 m leave .55 m at each end.
PLANE = FREE_SPACE[:FREE_SPACE.index("[[receiver_grid]]")] + """
[[receiver_grid]]
name = "facade"
from_m = [20, 30]
to_m = [32, 14]
z_min_m = 1
z_max_m = 14
step_m = 2.1
"""
FLOORS = FREE_SPACE.replace("step_m = 4", "step_m = 20\nheights_m = [1.5, 4.5, 7.5]")


def friis_db(x, y, z):
    return np.array([20 * np.log10(LIGHT_M_S / 3.5e9 / (4 * np.pi) / np.sqrt((x - tx) ** 2 + (y - ty) ** 2 + (z - 25) ** 2))
                     for tx, ty in ((10, 30), (100, 40))])


def places():
    along = np.tile(.55 + 2.1 * (np.arange(9) + .5), 6)
    return along, 20 + .6 * along, 30 - .8 * along, np.repeat(1 + .2 + 2.1 * (np.arange(6) + .5), 9)


def check_plane_files(maps, rows):
    along, x, y, z = places()
    assert [(row["ix"], row["iy"]) for row in rows] == [(str(k % 9), str(k // 9)) for k in range(54)]
    for name, wanted in (("along_m", along), ("x_m", x), ("y_m", y), ("z_m", z), ("path_gain_db", friis_db(x, y, z).max(axis=0))):
        same(column(rows, name), wanted, 1e-6)
    for name, wanted in (("along_m", along[:9]), ("x_m", x[:9]), ("y_m", y[:9]), ("z_m", z[::9])):
        same(np.load(maps / f"{name}.npy"), wanted)
    gain = np.load(maps / "path_gain_db.npy")
    assert gain.shape == (6, 9)
    same(gain.ravel(), column(rows, "path_gain_db"))
    about = json.loads((maps / "coverage.json").read_text())
    assert about["columns"] == 9 and about["rows"] == 6, about
    same(about["step_m"], [2.1, 2.1])
    same(about["first_m"], [x[0], y[0]])
    same([about["vertical"][name] for name in ("first_along_m", "first_z_m")], [along[0], z[0]])
    assert about["vertical"]["from_m"] == [20, 30] and about["vertical"]["to_m"] == [32, 14], about
    # The picture has the highest row on top, where the antenna at 25 m is nearer, so colours are brighter.
    assert not (maps / "path_gain_db.pgw").exists()
    seen = pixels(maps / "path_gain_db.png")
    index = np.array([[seen[i + .5, j + .5] for i in range(9)] for j in range(6)])
    low, high = about["layers"]["path_gain_db"]["dark_to_bright"]
    same(index, 1 + np.round(np.clip((gain[::-1] - low) / (high - low), 0, 1) * 254), 1e-9)
    assert (index[0] > index[-1]).all(), index


def plane(program, folder):
    place = free_run(program, folder, PLANE)
    out, maps = place / "out", place / "out/coverage"
    run(program, "coverage", out, "--format", "csv,npy,png")
    rows = table(maps / "coverage.csv")
    check_plane_files(maps, rows)
    with h5py.File(out / "paths.h5") as h5:
        names = list(h5["receivers/name"].asstr()[...])
        same(h5["frames/receiver_position_m"][0][names.index("facade/3,5")], [column(rows, axis)[48] for axis in ("x_m", "y_m", "z_m")])
    for kind, reason in (("geotiff", "place in x and y alone"), ("kml", "on the ground")):
        refused = run(program, "coverage", out, "-o", place / "none", "--format", f"csv,{kind}", code=2).stderr
        assert f'--format {kind}: the grid "facade" stands on a vertical plane' in refused and reason in refused, refused
        assert not (place / "none").exists()
    (place / "georeference.json").write_text(json.dumps({"projection": "+proj=utm +zone=32 +ellps=WGS84 +units=m",
                                                         "offset_m": [-690000, -5330000]}))
    run(program, "coverage", out, "-o", place / "placed", "--layers", "paths", "--format", "csv,npy", "--frames", "all")
    placed = table(place / "placed/coverage.csv")
    for name in ("lon_deg", "lat_deg"):
        same(np.tile(np.load(place / f"placed/{name}.npy"), 6), column(placed, name))
    assert np.load(place / "placed/paths.npy").shape == (1, 6, 9)
    drawn = run(program, "plot", out, "--what", "coverage", "-o", place / "plots")
    assert "Skipping" not in drawn.stderr, drawn.stderr  # gnuplot's warning of tables without a row
    commands = "".join(file.read_text() for file in (place / "plots").rglob("*.gp"))
    assert "set xlabel 'along (m)'" in commands and "set ylabel 'z (m)'" in commands, commands
    assert "using 6:5:(" in commands and "set xrange [0.55" in commands, commands
    drawn = table(next((place / "plots").rglob("coverage.csv")))
    same(column(drawn, "along_m"), places()[0])
    walls = table(next((place / "plots").rglob("coverage_walls.csv")))
    assert {0.0} == {float(row[z]) for row in walls for z in ("z0_m", "z1_m")}, walls  # the plane on the ground
    marks = table(next((place / "plots").rglob("coverage_transmitters.csv")))
    assert marks == [], marks  # none stands in the plane


def floors(program, folder):
    (folder / "floors").mkdir()
    place = free_run(program, folder / "floors", FLOORS)
    refused = run(program, "coverage", place / "out", code=2).stderr
    assert "the run has 3 grids: name one with --grid, of g@1.5, g@4.5, g@7.5" in refused, refused
    for height_m in (1.5, 4.5, 7.5):
        run(program, "coverage", place / "out", "--grid", f"g@{height_m}", "-o", place / str(height_m))
        rows = table(place / str(height_m) / "coverage.csv")
        assert len(rows) == 6 * 3 and {row["z_m"] for row in rows} == {str(height_m)}
        x, y = column(rows, "x_m"), column(rows, "y_m")
        same(column(rows, "path_gain_db"), friis_db(x, y, height_m).max(axis=0), 1e-6)


def planes(program, folder):
    plane(program, folder)
    floors(program, folder)


main(planes, "gdal_translate")
