# SPDX-License-Identifier: Apache-2.0
"""Runs `wavetracer coverage --frames` on a drive in free space where two vehicles send, one of them only in the second
half, and compares every frame with Friis' formula at the places of the vehicles then.

    read_frames.py PROGRAM FOLDER

Needs numpy, h5py, GDAL's programs and an OpenCL device; answers 77 where one is missing.
"""
import json

import numpy as np
from map_reading import LIGHT_M_S, column, free_run, main, pixels, run, same, table

DRIVE = """
scene.file = "{scene}"
scene.default_material = "concrete"
trace.max_depth = 0
radio.frequency_hz = 3.5e9
time.step_s = 0.1
[[vehicle_type]]
name = "passenger"
model = "none"
[[track]]
id = "bus"
waypoints = [[0, 10, 20, 0], [1, 50, 20, 0]]
[[track]]
id = "late"
waypoints = [[0.55, 100, 20, 0], [1, 100, 65, 0]]
[[mount]]
name = "roof"
role = "transmitter"
offset_m = [0, 0, 4]
[[receiver_grid]]
name = "g"
x_min_m = 0
x_max_m = 120
y_min_m = 0
y_max_m = 60
step_m = 5
"""
SHAPE = (11, 12, 24)  # frames, rows, columns


def expected(rows, time_s):
    """Path gains in dB from both vehicles to the cells of a frame; that of one which is absent is -inf."""
    x, y = column(rows, "x_m"), column(rows, "y_m")
    places = [(10 + 40 * time_s, 20, True), (100, 20 + 100 * (time_s - 0.55), time_s > 0.55)]
    return np.array([20 * np.log10(LIGHT_M_S / 3.5e9 / (4 * np.pi) / np.sqrt((x - tx) ** 2 + (y - ty) ** 2 + 2.5 ** 2))
                     if there else np.full(len(x), -np.inf) for tx, ty, there in places])


def check_table(rows, transmitters):
    assert list(rows[0])[:4] == ["frame", "time_s", "ix", "iy"], list(rows[0])
    assert len(rows) == np.prod(SHAPE)
    for frame in range(SHAPE[0]):
        own = rows[frame * SHAPE[1] * SHAPE[2]:][:SHAPE[1] * SHAPE[2]]
        assert {row["frame"] for row in own} == {str(frame)}
        same(column(own, "time_s"), frame / 10)
        gains = expected(own, frame / 10)
        same(column(own, "path_gain_db"), gains.max(axis=0), 1e-5)
        best = np.argmax(gains, axis=0)
        assert [row["tx"] for row in own] == [("bus/roof", "late/roof")[k] for k in best], frame
        same(column(own, "best_server"), [transmitters.index(("bus/roof", "late/roof")[k]) for k in best])
        with np.errstate(invalid="ignore"):
            margin = gains.max(axis=0) - gains.min(axis=0)
        same(column(own, "margin_db"), np.where(np.isinf(margin), np.nan, margin), 1e-4)


def check_arrays(folder, rows):
    same(np.load(folder / "time_s.npy"), np.arange(SHAPE[0]) / 10)
    for name in ("path_gain_db", "best_server", "margin_db"):
        values = np.load(folder / f"{name}.npy")
        assert values.dtype == np.float64 and values.shape == SHAPE, (values.dtype, values.shape)
        same(values.ravel(), column(rows, name), 0)
    assert np.load(folder / "z_m.npy").shape == SHAPE[1:] and np.load(folder / "x_m.npy").shape == SHAPE[2:]


def check_pictures(folder, rows, low, high):
    """Each frame has its GeoTIFF and its picture, and a colour is one value in all frames."""
    for frame in (0, 5, 10):
        own = [row for row in rows if row["frame"] == str(frame)]
        values = column(own, "path_gain_db")
        tiff, picture = (pixels(folder / f"path_gain_db_{frame:02}.{end}") for end in ("tif", "png"))
        at = [(round(float(row["x_m"]), 3), round(float(row["y_m"]), 3)) for row in own]
        same([tiff[place] for place in at], values, 1e-5)
        same([picture[place] for place in at], 1 + np.round(np.clip((values - low) / (high - low), 0, 1) * 254), 0)
    gains = column(rows, "path_gain_db")
    assert low % 5 == 0 and high % 5 == 0 and low <= np.quantile(gains, 0.02) and high >= np.quantile(gains, 0.98)


def check_choices(program, out, place):
    """One frame of several is the map of that frame; ranges and refusals."""
    for text, frames in (("2:4", [2, 3, 4]), ("2-4", [2, 3, 4]), ("9:", [9, 10]), (":1", [0, 1]), ("7", [7])):
        run(program, "coverage", out, "-o", place / text, "--frames", text, "--format", "csv,png", "--layers", "margin_db")
        about = json.loads((place / text / "coverage.json").read_text())
        assert [each["frame"] for each in about["frames"]] == frames and "frame" not in about, about
        last = len(str(frames[-1]))
        assert sorted(file.name for file in (place / text).glob("*.png")) == [f"margin_db_{n:0{last}}.png" for n in frames]
    run(program, "coverage", out, "-o", place / "one", "--frame", "7", "--format", "csv,npy", "--layers", "margin_db")
    one = table(place / "one/coverage.csv")
    assert [{key: row[key] for key in one[0]} for row in table(place / "7/coverage.csv")] == one
    assert json.loads((place / "one/coverage.json").read_text())["frame"] == 7
    assert np.load(place / "one/margin_db.npy").shape == SHAPE[1:]
    for options, said in ((("--frames", "11"), "this run has 11 frames, 0 to 10"),
                          (("--frames", "4-2"), "did you mean 2:4?"),
                          (("--frames", "some"), "give the first and the last frame"),
                          (("--frames", "all", "--frame", "1"), "--frame")):
        refused = run(program, "coverage", out, *options, code=2).stderr
        assert said in refused, refused
    none = run(program, "coverage", out, "-o", place / "none", "--tx", "late/roof", "--frames", ":4")
    assert 'no path to the grid "g" in frames 0 to 4 from "late/roof": the maps are empty' in none.stderr, none.stderr


def frames(program, folder):
    place = free_run(program, folder, DRIVE)
    out = place / "out"
    done = run(program, "coverage", out, "--frames", "all", "--format", "csv,npy,geotiff,png", "--layers",
               "path_gain_db,best_server,margin_db")
    maps = out / "coverage"
    files = done.stdout.split()
    assert len(files) == 2 + 4 + 3 + 11 * 3 * 3 and {maps / file for file in files} == set(maps.iterdir()), files
    about = json.loads((maps / "coverage.json").read_text())
    assert [each["frame"] for each in about["frames"]] == list(range(11)) and "time_s" not in about
    same([each["time_s"] for each in about["frames"]], np.arange(11) / 10)
    rows = table(maps / "coverage.csv")
    check_table(rows, about["transmitters"])
    check_arrays(maps, rows)
    check_pictures(maps, rows, *about["layers"]["path_gain_db"]["dark_to_bright"])
    check_choices(program, out, place)


main(frames, "gdal_translate")
