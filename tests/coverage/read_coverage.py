#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs `wavetracer coverage` as a user does, and reads what it writes with NumPy and GDAL. Layers are compared with
Friis' formula in free space, and with sums over the rows of paths.h5.

    read_coverage.py PROGRAM FOLDER

Needs numpy, h5py, GDAL's programs (Debian's gdal-bin) and an OpenCL device; answers 77 where one is missing.
"""
import json
from pathlib import Path

import h5py
import numpy as np
from map_reading import FREE_SPACE, LIGHT_M_S, column, db, free_run, main, pixels, run, same, table

CITY = """
scene.generate = "--seed 1 --blocks 2x2"
trace.rays = 20000
trace.max_depth = 2
trace.diffraction = true
trace.diffraction_rays = 500
[radio]
transmit_power_dbm = 23
[[transmitter]]
name = "a"
position_m = [8, 8, 6]
[[transmitter]]
name = "b"
position_m = [-40, 30, 30]
[[receiver]]
name = "alone"
position_m = [8, 20, 2]
[[receiver_grid]]
name = "street"
x_min_m = -60
x_max_m = 60
y_min_m = -40
y_max_m = 40
step_m = 8
[[receiver_grid]]
name = "row"
x_min_m = -20
x_max_m = 20
y_min_m = 5
y_max_m = 10
step_m = 5
"""


def check_free_space(rows):
    x, y = column(rows, "x_m"), column(rows, "y_m")
    gain = np.array([20 * np.log10(LIGHT_M_S / 3.5e9 / (4 * np.pi * np.sqrt((x - tx) ** 2 + (y - ty) ** 2 + 23.5 ** 2)))
                     for tx, ty in ((10, 30), (100, 40))])
    best = np.argmax(gain, axis=0)
    own, other = gain.max(axis=0), gain.min(axis=0)
    noise_mw = 1.380649e-23 * 290 * 20e6 * 1e3 * 10 ** .6
    same(column(rows, "best_server"), best)
    assert [row["tx"] for row in rows] == [("west", "east, far")[k] for k in best]
    same(column(rows, "path_gain_db"), own, 1e-6)
    same(column(rows, "received_dbm"), 43 + own, 1e-6)
    same(column(rows, "margin_db"), own - other, 1e-5)
    same(column(rows, "interference_dbm"), 43 + other, 1e-6)
    same(column(rows, "snr_db"), 43 + own - 10 * np.log10(noise_mw), 1e-5)
    same(column(rows, "sinr_db"), 43 + own - 10 * np.log10(noise_mw + 10 ** ((43 + other) / 10)), 1e-5)
    assert np.all(column(rows, "line_of_sight") == 1) and np.all(np.isinf(column(rows, "k_factor_db")))


def check_arrays(folder, rows, names, shape):
    for name in names:
        same(np.load(folder / f"{name}.npy"), column(rows, name).reshape(shape), 0)
    same(np.load(folder / "x_m.npy"), column(rows, "x_m").reshape(shape)[0], 0)
    same(np.load(folder / "y_m.npy"), column(rows, "y_m").reshape(shape)[:, 0], 0)


def check_tiff(folder, rows, name, unit, offset_m):
    read = pixels(folder / f"{name}.tif")
    assert len(read) == len(rows)
    for row in rows:
        x, y = (round(float(row[f"{axis}_m"]) - offset, 3) for axis, offset in zip("xy", offset_m))
        expected = np.float32(row[name])
        assert read[x, y] == expected or abs(read[x, y] - expected) < 1e-5 * abs(expected) or \
            np.isnan(read[x, y]) and np.isnan(expected), (name, x, y, read[x, y], expected)
    info = json.loads(run("gdalinfo", "-json", folder / f"{name}.tif").stdout)
    band = info["bands"][0]
    assert band["type"] == "Float32" and band["description"] == name and band.get("unit", "") == unit, band
    assert band["noDataValue"] == "NaN" and info["geoTransform"][5] < 0, info
    return info


def check_degrees(file, rows, name):
    """GDAL finds the value of a cell at the longitude and latitude of its middle."""
    some = rows[::7]
    said = run("gdallocationinfo", "-wgs84", "-valonly", file,
               text="".join(f"{row['lon_deg']} {row['lat_deg']}\n" for row in some)).stdout.split()
    same([float(value) for value in said], column(some, name), 1e-5)


def check_picture(folder, rows, name):
    read = pixels(folder / f"{name}.png")
    index = np.array([read[round(float(row["x_m"]), 3), round(float(row["y_m"]), 3)] for row in rows])
    values = column(rows, name)
    assert np.array_equal(index == 0, np.isnan(values))
    low, high = json.loads((folder / "coverage.json").read_text())["layers"][name]["dark_to_bright"]
    seen = ~np.isnan(values)
    same(index[seen], 1 + np.round(np.clip((values[seen] - low) / (high - low), 0, 1) * 254), 0)
    info = json.loads(run("gdalinfo", "-json", folder / f"{name}.png").stdout)
    entries = info["bands"][0]["colorTable"]["entries"]
    assert entries[0][3] == 0 and entries[1][:3] == [0x44, 1, 0x54] and entries[255][:3] == [0xfd, 0xe7, 0x25], entries
    layers = json.loads((folder / "coverage.json").read_text())["layers"]
    assert layers["line_of_sight"]["colours"] == ["#e69f00", "#0072b2"] and len(layers["best_server"]["colours"]) == 12
    assert f"{low:g} " in info["metadata"][""]["Description"], info["metadata"]


def powers(h5):
    """The power of each link as docs/formats.md defines it: fields of a group, then powers; shape (tx, rx)."""
    paths, out = h5["paths"], np.zeros((len(h5["transmitters/name"]), len(h5["receivers/name"])))
    a = paths["a_re"][...] + 1j * paths["a_im"][...]
    field = a * np.exp(-2j * np.pi * (h5.attrs["frequency_hz"] * paths["delay_s"][...] % 1))[:, None, None]
    sums = {}
    for tx, rx, groups, weights, own in zip(paths["tx"][...], paths["rx"][...], paths["group"][...],
                                            paths["group_weight"][...], field):
        for group, weight in zip(groups, weights):
            if group != 0xffffffff:
                key = (int(tx), int(rx), int(group))
                sums[key] = sums.get(key, 0) + weight * own
    for (tx, rx, _), value in sums.items():
        out[tx, rx] += (abs(value) ** 2).sum()
    return out


def narrowband_powers(h5):
    """|h|^2 of each link at the carrier: fields of all paths added up; shape (tx, rx)."""
    paths, h = h5["paths"], np.zeros((len(h5["transmitters/name"]), len(h5["receivers/name"]), 2, 2), complex)
    a = paths["a_re"][...] + 1j * paths["a_im"][...]
    field = a * np.exp(-2j * np.pi * (h5.attrs["frequency_hz"] * paths["delay_s"][...] % 1))[:, None, None]
    np.add.at(h[:, :, :field.shape[1], :field.shape[2]], (paths["tx"][...], paths["rx"][...]), field)
    return (abs(h) ** 2).sum(axis=(2, 3))


def check_city(h5, rows, power, tx=None):
    names = list(h5["receivers/name"].asstr()[...])
    of_row = [names.index(f"street/{row['ix']},{row['iy']}") for row in rows]
    power, narrow = power[:, of_row], narrowband_powers(h5)[:, of_row]
    best, cells = np.argmax(power, axis=0), np.arange(len(rows))
    server = best if tx is None else np.full(len(rows), tx)
    own, other = power[server, cells], power[1 - server, cells]
    empty = own == 0
    assert 0 < empty.sum() < len(rows)
    same(column(rows, "path_gain_db"), db(own), 1e-8)
    same(column(rows, "narrowband_gain_db"), db(narrow[server, cells]), 1e-6)
    same(column(rows, "best_server"), np.where(power.max(axis=0) > 0, best, np.nan))
    same(column(rows, "interference_dbm"), 23 + db(other), 1e-8)
    same(column(rows, "margin_db"), db(own) - db(other), 1e-7)
    assert np.array_equal(np.isnan(column(rows, "paths")), empty)


def free_space(program, folder):
    place = free_run(program, folder, FREE_SPACE)
    maps = place / "out/coverage"
    done = run(program, "coverage", place / "out", "--format", "csv,npy,geotiff,png")
    assert "georeference.json" in done.stderr, done.stderr
    assert {Path(line) for line in done.stdout.split()} == set(maps.iterdir())
    rows, names = table(maps / "coverage.csv"), list(json.loads((maps / "coverage.json").read_text())["layers"])
    assert len(rows) == 30 * 15 and len(names) == 14
    refused = run(program, "coverage", place / "out", "--on-streets", code=2).stderr
    assert "no streets are known; give the configuration of the run a SUMO network with scene.streets" in refused, refused
    check_free_space(rows)
    check_arrays(maps, rows, names, (15, 30))
    local = check_tiff(maps, rows, "sinr_db", "dB", (0, 0))["coordinateSystem"]["wkt"]
    assert local.startswith("ENGCRS") and 'LENGTHUNIT["metre",1,' in local, local
    check_picture(maps, rows, "sinr_db")
    for projection, offset_m, said in (
            ("+proj=utm +zone=32 +ellps=WGS84 +datum=WGS84 +units=m +no_defs", (-690000, -5330000), '"EPSG",32632'),
            ("+proj=tmerc +lat_0=48.1 +lon_0=11.5 +ellps=WGS84 +units=m", (0, 0), "Transverse Mercator")):
        (place / "georeference.json").write_text(json.dumps({"projection": projection, "offset_m": offset_m}))
        done = run(program, "coverage", place / "out", "-o", place / "maps", "--layers", "margin_db", "--format", "csv,geotiff")
        assert done.stderr == "", done.stderr
        rows = table(place / "maps/coverage.csv")
        info = check_tiff(place / "maps", rows, "margin_db", "dB", offset_m)
        assert said in info["coordinateSystem"]["wkt"], info["coordinateSystem"]
        check_degrees(place / "maps/margin_db.tif", rows, "margin_db")


def city(program, folder):
    (folder / "city.toml").write_text(CITY)
    out = folder / "city"
    run(program, "run", "-c", folder / "city.toml", "-o", out)
    refused = run(program, "coverage", out, code=2).stderr
    assert "name one with --grid, of street, row" in refused, refused
    refused = run(program, "coverage", out, "--grid", "row", "--layers", "tx_beam", code=2).stderr
    assert "--layers tx_beam needs the links.csv of a run where a transmitter or the grid has" in refused, refused
    refused = run(program, "coverage", out, "--grid", "row", "--layers", "snr_db", code=2).stderr
    assert "--layers snr_db needs radio.bandwidth_hz, which" in refused, refused
    run(program, "coverage", out, "--grid", "row", "--format", "geotiff,png", "--layers", "paths")
    assert json.loads(run("gdalinfo", "-json", out / "coverage/paths.tif").stdout)["size"] == [8, 1]
    run(program, "run", "-c", folder / "city.toml", "-o", folder / "far", "--set", "receiver_grid.0.height_m=-5", "--set",
        "trace.diffraction=false")
    empty = run(program, "coverage", folder / "far", "--grid", "street", "--layers", "path_gain_db", "--format", "csv,geotiff,png")
    assert 'no path to the grid "street" in frame 0: the map is empty' in empty.stderr, empty.stderr
    assert np.isnan(column(table(folder / "far/coverage/coverage.csv"), "path_gain_db")).all()
    with h5py.File(out / "paths.h5") as h5:
        power = powers(h5)
        for tx, options in ((None, ()), (0, ("--tx", "a")), (1, ("--tx", "b"))):
            done = run(program, "coverage", out, "--grid", "street", *options)
            assert "snr_db, sinr_db need radio.bandwidth_hz" in done.stderr, done.stderr
            check_city(h5, table(out / "coverage/coverage.csv"), power, tx)
    streets(program, out)


def streets(program, out):
    """The streets of this city are 20 m wide and cross at 0, 0; the next ones are 100 m away."""
    run(program, "coverage", out, "--grid", "street", "--layers", "path_gain_db,paths")
    whole = table(out / "coverage/coverage.csv")
    done = run(program, "coverage", out, "--grid", "street", "--layers", "path_gain_db,paths", "--on-streets")
    rows = table(out / "coverage/coverage.csv")
    on = (abs(column(rows, "x_m")) <= 10) | (abs(column(rows, "y_m")) <= 10)
    assert f"{on.sum()} of {len(rows)} cells are on streets" in done.stderr and 0 < on.sum() < len(rows), done.stderr
    assert json.loads((out / "coverage/coverage.json").read_text())["only_streets"] is True
    for name in ("path_gain_db", "paths"):
        same(column(rows, name), np.where(on, column(whole, name), np.nan))


def maps(program, folder):
    free_space(program, folder)
    city(program, folder)


main(maps, "gdalinfo", "gdal_translate", "gdallocationinfo")
