#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measurement campaigns: statistics against scipy, files of the published forms against free space, and broken rows.

Usage: measurements_test.py FOLDER, which is made anew. Exits with 77 without numpy or scipy.
"""
import contextlib
import io
import json
import math
import pathlib
import re
import shutil
import sys

try:
    import numpy as np
    import scipy.stats
except ImportError:
    sys.exit(77)
from wavetracer import _campaigns, errors, measurements

LATITUDE, LONGITUDE = 52.5, 13.3
# Air all around: a ground that reflects nothing. Coordinates are those of a projection about the first point.
SCENE = "v -9000 -9000 0\nv 9000 -9000 0\nv 9000 9000 0\nv -9000 9000 0\no ground\nusemtl air\nf 1 2 3 4\n"
CONFIG = """
[scene]
file = "ground.obj"
[radio]
frequency_hz = 5.9e9
[trace]
rays = 1000
max_depth = 1
[[material]]
name = "air"
permittivity = 1
conductivity_s_m = 0
thickness_m = inf
"""
PAIRS = CONFIG + """
[[vehicle_type]]
name = "sender"
model = "none"
[[vehicle_type]]
name = "receiver"
model = "none"
[[mount]]
name = "sending"
on = "sender"
role = "transmitter"
offset_m = [0, 0, 1.6]
[[mount]]
name = "receiving"
on = "receiver"
role = "receiver"
offset_m = [0, 0, 1.6]
"""
LAMBDA = 299792458 / 5.9e9
ODD = np.frombuffer(b"0,;:-.eE \n\"x\xff\x00", np.uint8)


def check_statistics():
    random = np.random.default_rng(3)
    measured, computed = np.round(random.normal(-90, 12, 200)), np.round(random.normal(-95, 12, 200))
    computed += measured / 2
    computed[::17] = -np.inf
    found, heard = measurements.agreement(measured, computed), np.isfinite(computed)
    assert (found.points, found.with_a_path) == (200, heard.sum())
    assert abs(found.offset_db - np.mean((measured - computed)[heard])) < 1e-9
    assert abs(found.sigma_db - np.std((measured - computed)[heard], ddof=1)) < 1e-9
    assert abs(found.spearman - scipy.stats.spearmanr(measured[heard], computed[heard])[0]) < 1e-12
    assert math.isnan(measurements.agreement([1, 2], [-math.inf, 3]).offset_db)
    assert math.isnan(measurements.agreement([1, 2], [3, 3]).spearman)


def friis_db(distance_m):
    return 20 * math.log10(LAMBDA / (4 * math.pi * distance_m))


def on_the_earth_m(one, other):
    """Between two near places, on the ellipsoid of WGS84."""
    e2, a = 0.00669437999014, 6378137.0
    root = math.sqrt(1 - e2 * math.sin(math.radians(LATITUDE)) ** 2)
    north = math.radians(one[0] - other[0]) * a * (1 - e2) / root**3
    return math.hypot(north, math.radians(one[1] - other[1]) * a / root * math.cos(math.radians(LATITUDE)))


def run(*arguments):
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = measurements.main([str(argument) for argument in arguments])
    return code, out.getvalue(), err.getvalue()


def rows(report):
    """route -> (points, with a path, offset, sigma, Spearman)."""
    out = {}
    for line in report.splitlines()[1:]:
        words = re.split(r"\s{2,}", line.strip())
        out[words[0]] = tuple(map(float, words[1:6]))
    return out


def expect(found, points, offset, sigma):
    assert found[:2] == (points, points) and abs(found[2] - offset) < 0.06 and abs(found[3] - sigma) < 0.06, found
    assert found[4] > 0.99, found


def check_cost231(folder):
    (folder / "cost.toml").write_text(CONFIG + '[[transmitter]]\nname = "base"\nposition_m = [10, 20, 13]\n')
    places = [(30.0 + 40 * i, 20.0 - 15 * i, 1.5) for i in range(20)]
    losses = [-friis_db(math.dist(place, (10, 20, 13))) + 6 for place in places]
    lines = [f"{x},{y},{z},{loss:.4f}" for (x, y, z), loss in zip(places, losses)]
    (folder / "METRO200.csv").write_text("X,Y,Z,Path Loss\n" + "\n".join(lines) + "\n")
    (folder / "METRO201.csv").write_text("\n".join(line.replace(",", ";") for line in lines[:7]) + "\n")
    code, out, err = run("cost231", "-c", folder / "cost.toml", folder / "METRO200.csv", folder / "METRO201.csv",
                         "--points", folder / "points.csv")
    assert code == 0, err
    found = rows(out)
    expect(found["METRO200"], 20, -6, 0)
    expect(found["METRO201"], 7, -6, 0)
    expect(found["all"], 27, -6, 0)
    points = (folder / "points.csv").read_text().splitlines()
    assert len(points) == 28 and points[21].startswith("METRO201,0,"), points[:2]
    code, out, err = run("cost231", "-c", folder / "cost.toml", folder / "METRO200.csv", "--every", 4)
    assert code == 0 and rows(out)["METRO200"][0] == 5, (out, err)
    moved = [f"{x - 1200},{y - 1699.25},{z},{loss:.4f}" for (x, y, z), loss in zip(places, losses)]
    (folder / "moved.csv").write_text("\n".join(moved) + "\n")
    code, out, err = run("cost231", "-c", folder / "cost.toml", folder / "moved.csv", "--shift", 1200, 1699.25)
    assert code == 0, err
    expect(rows(out)["moved"], 20, -6, 0)
    code, out, err = run("cost231", "-c", folder / "cost.toml", folder / "moved.csv")
    assert code == 0 and rows(out)["moved"][3] > 1, (out, err)  # elsewhere, other levels
    code, out, err = run("cost231", "-c", folder / "cost.toml", folder / "moved.csv", "--shift", "nan", 0)
    assert code == 3 and "--shift nan 0.0: give two numbers" in err, err
    for text, wanted in (("1,2,3\n", ":1: 3 columns instead"), ("1,2,3,4\n5,6,x,7\n", ":2: Z is 'x'"),
                         ("\nX,Y,Z,L\n1,2,3,nan\n", ":3: the path loss is 'nan'"), ("X,Y,Z,L\n", "no point with a position")):
        (folder / "broken.csv").write_text(text)
        code, out, err = run("cost231", "-c", folder / "cost.toml", folder / "broken.csv")
        assert code == 3 and wanted in err and "broken.csv" in err, (text, err)


def check_berlin(folder):
    names = ["timestamp", "Source", "Destination", "Scenario", "RSRP", "SNR", *_campaigns.BERLIN[:4]]
    ends = [((LATITUDE + 1e-4 * i, LONGITUDE), (LATITUDE, LONGITUDE + 2e-4 * (1 + i))) for i in range(12)]
    wobble = [0.5 if i % 2 else -0.5 for i in range(12)]
    lines = [",".join(names)]
    for i, ends_of in enumerate(ends):
        level = friis_db(on_the_earth_m(*ends_of)) + 20 + wobble[i]
        lines.append(f'"2021-06-22 09:51:{i:02}+02:00",{1 + i % 2},3,S1,{level:.4f},{i},' +
                     ",".join(f"{value:.7f}" for place in ends_of for value in place))
    lines.append('"2021-06-22 10:00:00+02:00",1,3,S1,,4,52.5,13.3,52.5,13.31')
    (folder / "sidelink.csv").write_text("\n".join(lines) + "\n")
    code, out, err = run("berlin", "-c", folder / "pairs.toml", folder / "sidelink.csv")
    assert code == 0 and "(1 rows left out)" in out, (out, err)
    found = rows(out)
    expect(found["S1 1->3"], 6, 19.5, 0)
    expect(found["S1 2->3"], 6, 20.5, 0)
    assert abs(found["all"][2] - 20) < 0.06 and abs(found["all"][3] - np.std(wobble, ddof=1)) < 0.06, found
    for change, wanted in ((("Latitude_source", "Lat"), "no column Latitude_source"),
                           ((",S1,", ",S1,7,"), ":2: 11 columns, but 10"),
                           (("52.5", "152.5"), "no place on the earth"), ((",3,S1,-", ",3,S1,minus"), ":2: RSRP is 'minus")):
        (folder / "broken.csv").write_text("\n".join(lines[:3]).replace(*change) + "\n")
        code, out, err = run("berlin", "-c", folder / "pairs.toml", folder / "broken.csv")
        assert code == 3 and wanted in err, (change, err)
    (folder / "one.csv").write_text("\n".join(lines[:2]) + "\n")
    code, out, err = run("berlin", "-c", folder / "pairs.toml", folder / "one.csv")
    assert code == 0 and rows(out)["S1 1->3"][:2] == (1, 1) and "nan" in out, (out, err)  # one point has no deviation
    code, out, err = run("berlin", "-c", folder / "pairs.toml", folder / "sidelink.csv", "--shift", 1, 2)
    assert code == 3 and "has degrees" in err and "S1 1->3" in err, err
    code, out, err = run("berlin", "-c", folder / "pairs.toml", folder / "sidelink.csv", "--level", "RSSI")
    assert code == 3 and "no column RSSI" in err, err


def check_flourish(folder):
    unit, cars = (LATITUDE, LONGITUDE), [(LATITUDE + 1e-4 * (1 + i), LONGITUDE + 1e-4) for i in range(9)]
    heard, dumped = [], []
    for i, car in enumerate(cars):
        fields = ["x"] * 31
        fields[1], fields[13], fields[15], fields[17] = "04:E5:48:00:00:0A", f"SeqNum={i}", f"{car[1]:.7f}", f"{car[0]:.7f}"
        fields[13] = str(i)
        heard.append(";".join(fields))
        words = ["y"] * 50
        words[8], words[42] = f"{friis_db(on_the_earth_m(unit, car)) + 30:.3f}dBm", str(i)
        words[44], words[46] = str(round(unit[0] * 1e7)), str(round(unit[1] * 1e7))
        words[16:22] = ["04", "e5", "48", "00", "00", "0a"]
        dumped.append(" ".join(words))
    lost = heard[0].split(";")
    lost[13], lost[17] = "0", "900.0"  # no fix
    (folder / "vehNo_01_RxCAM_HP.log").write_text("\n".join([*heard, ";".join(lost)]) + "\n")
    (folder / "vehNo_01_tcpDump_HP.log").write_text("\n".join(dumped) + "\n")
    code, out, err = run("flourish", "-c", folder / "pairs.toml", folder / "vehNo_01_RxCAM_HP.log")
    assert code == 0 and "(1 rows left out)" in out, (out, err)
    expect(rows(out)["vehNo_01_RxCAM_HP 04:e5:48:00:00:0a"], 9, 30, 0)
    code, out, err = run("flourish", "-c", folder / "pairs.toml", folder / "vehNo_01_tcpDump_HP.log")
    assert code == 3 and "give the log of the received messages" in err, err
    for name, lines, wanted in (("RxCAM", [*heard, "a;b"], "RxCAM_LP.log:10: 2 fields, at least 18"),
                                ("tcpDump", [*dumped[:2], "a b"], "tcpDump_LP.log:3: 2 fields"),
                                ("tcpDump", [dumped[0].replace("dBm", "?")], "tcpDump_LP.log:1: the level is")):
        for part, good in (("RxCAM", heard), ("tcpDump", dumped)):
            (folder / f"vehNo_02_{part}_LP.log").write_text("\n".join(lines if part == name else good) + "\n")
        code, out, err = run("flourish", "-c", folder / "pairs.toml", folder / "vehNo_02_RxCAM_LP.log")
        assert code == 3 and wanted in err, (name, err)


def check_broken_bytes(folder, per_file=150):
    """Readers read a file of any bytes, or report what is wrong with it."""
    random = np.random.default_rng(11)
    for campaign, name in (("cost231", "METRO200.csv"), ("berlin", "sidelink.csv"), ("flourish", "vehNo_01_RxCAM_HP.log"),
                           ("flourish", "vehNo_01_tcpDump_HP.log")):
        read, level = _campaigns.CAMPAIGNS[campaign]
        good, refused = (folder / name).read_bytes(), 0
        (folder / "vehNo_03_RxCAM_HP.log").write_bytes((folder / "vehNo_01_RxCAM_HP.log").read_bytes())
        file = folder / name.replace("_01_", "_03_").replace("sidelink", "odd").replace("METRO200", "odd")
        opened = folder / "vehNo_03_RxCAM_HP.log" if campaign == "flourish" else file
        if campaign == "flourish":
            (folder / "vehNo_03_tcpDump_HP.log").write_bytes((folder / "vehNo_01_tcpDump_HP.log").read_bytes())
        for _ in range(per_file):
            bad = bytearray(good)
            for _ in range(random.integers(1, 4)):
                at = random.integers(0, len(bad))
                bad[at:at + random.integers(0, 9)] = bytes(random.choice(ODD, random.integers(0, 4)))
            file.write_bytes(bad)
            try:
                routes = read(opened, level)
            except errors.InputError as error:
                assert "_HP.log" in str(error) or "odd.csv" in str(error), error
                refused += 1
            else:
                assert all(len(route.receivers) == len(route.gain_db) for route in routes)
        assert per_file / 20 < refused < per_file, (name, refused)


def check_errors(folder):
    code, out, err = run("cost231", "-c", folder / "none.toml", folder / "METRO201.csv")
    assert code == 3 and "none.toml" in err, err
    code, out, err = run("cost231", "-c", folder / "cost.toml", folder / "none.csv")
    assert code == 3 and "none.csv: cannot be read" in err, err
    code, out, err = run("cost231", "-c", folder / "pairs.toml", folder / "METRO201.csv")
    assert code == 2 and "needs vehicles" in err, err
    code, out, err = run("berlin", "-c", folder / "cost.toml", folder / "sidelink.csv")
    assert code != 0 and err, err
    try:
        _campaigns.degrees_in(pathlib.Path("f"), 3, 91, 0)
    except errors.InputError as error:
        assert str(error).startswith("f:3: latitude 91"), error
    else:
        raise AssertionError("91 degrees were taken")


def main():
    folder = pathlib.Path(sys.argv[1])
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "ground.obj").write_text(SCENE)
    (folder / "georeference.json").write_text(json.dumps({
        "projection": f"+proj=tmerc +lat_0={LATITUDE} +lon_0={LONGITUDE} +ellps=WGS84 +units=m", "offset_m": [0, 0]}))
    (folder / "pairs.toml").write_text(PAIRS)
    check_statistics()
    check_cost231(folder)
    check_berlin(folder)
    check_flourish(folder)
    check_errors(folder)
    check_broken_bytes(folder)
    print("campaigns: all checks passed")


if __name__ == "__main__":
    main()
