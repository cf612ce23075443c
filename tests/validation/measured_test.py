#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measured levels of bench/validation: small made-up sets in the forms of the public ones, in free space, where levels, spreads
and statistics are known.

Usage: measured_test.py FOLDER; FOLDER is bench/validation. Exits with 77 without numpy.
"""
import math
import pathlib
import sys
import tempfile

try:
    import numpy as np
except ImportError:
    sys.exit(77)
sys.path.insert(0, sys.argv[1])
import measured
import measured_sets
import page_measured

# The ground is of a material like air, with nothing to see of it: levels are those of free space.
GROUND = "v -900 -900 0\nv 900 -900 0\nv 900 900 0\nv -900 900 0\no ground\nusemtl air\nf 1 2 3 4\n"
CONFIG = """[scene]
file = "ground.obj"
[radio]
frequency_hz = {hz}
[trace]
rays = 1000
max_depth = 1
[[material]]
name = "air"
permittivity = 1.000001
conductivity_s_m = 0
thickness_m = inf
[[transmitter]]
name = "tx"
position_m = [0, 0, 2.5]
"""
STREET_HZ, HALL_HZ = 28.5e9, 3.438e9


def near(got, wanted, tolerance, what):
    assert abs(got - wanted) <= tolerance, f"{what}: {got}, not {wanted}"


def friis_db(x, y, z, hz):
    return 20 * math.log10(299792458 / hz / (4 * math.pi * math.dist((x, y, z), (0, 0, 2.5))))


def refused(call, *words):
    try:
        call()
    except SystemExit as error:
        assert all(word in str(error.code) for word in words), error.code
        return
    raise AssertionError(f"no error with {words}")


def write_street(folder):
    """Ten places each in sight, with an offset of 2 dB, and hidden, with -9; every other level is 1 dB more or less. Two
    sectors of a place: one of two equal components 40 ns and 60 degrees apart, one of a single component."""
    folder.mkdir(parents=True)
    (folder / "ground.obj").write_text(GROUND)
    (folder / "boulder.toml").write_text(CONFIG.format(hz=STREET_HZ))
    places, parts = ["kind,id,x,y,mode,rxh,pg"], ["kind,id,sector,delay_ns,aoa_azimuth_deg,path_loss_db"]
    for kind, offset in (("LOS", 2), ("NLOS", -9)):
        for i in range(10):
            x, y = 10.0 + 7 * i, 3.0 * i
            places.append(f"{kind},{i},{x},{y},4,1.6,{friis_db(x, y, 1.6, STREET_HZ) + offset + (1 if i % 2 else -1)}")
            parts += [f"{kind},{i},1,100,350,80", f"{kind},{i},1,140,50,80", f"{kind},{i},1,900,180,120", f"{kind},{i},2,7,7,90"]
    places.append("LOS,99,1,1,2,1.6,-50")  # a position that is not known well
    (folder / "positions.csv").write_text("\n".join(places) + "\n")
    (folder / "components.csv").write_text("\n".join(parts) + "\n")


def check_readers(folder):
    street = measured_sets.boulder(folder, 25)
    assert street.position_m.shape == (20, 3) and (street.kind == "LOS").sum() == 10
    assert street.position_m[3].tolist() == [31, 9, 1.6]
    # Half of the spreads of the first sector, since the second has none: 20 ns, and 30 degrees to either side.
    near(street.ds[0] * 1e9, 10, 1e-9, "delay spread")
    near(street.asa[0], math.degrees(math.sqrt(-2 * math.log(math.cos(math.pi / 6)))) / 2, 1e-9, "azimuth spread")
    wide = measured_sets.boulder(folder, 50)
    assert wide.ds[0] > 10.1e-9, "the component 40 dB down counts in a wider window"
    good = (folder / "positions.csv").read_text()
    for text, words in ((good.replace("pg\n", "gain\n"), ("positions.csv", "no column pg")),
                        (good.replace("10.0,", "ten,", 1), ("positions.csv:2: x is 'ten'",)),
                        (good.replace("LOS,0,", "LOS,77,", 1), ("no components of LOS 77",)),
                        ("", ("no column",))):
        (folder / "positions.csv").write_text(text)
        refused(lambda: measured_sets.boulder(folder, 25), *words)
    (folder / "positions.csv").write_text(good)
    refused(lambda: measured_sets.boulder(folder / "none", 25), "positions.csv: cannot be read", "Measured levels")
    gains = folder / "sionna.csv"
    gains.write_text("program,place,gain_db\nPeer 1,0,-80.5\nPeer 1,2,-90\n")
    name, gain = measured_sets.gains_of_sionna(gains, 3)
    assert name == "Peer 1" and gain.tolist() == [-80.5, -math.inf, -90], (name, gain)
    refused(lambda: measured_sets.gains_of_sionna(gains, 2), "other places than the 2")


def check_street(folder):
    street = measured_sets.boulder(folder, 25)
    (folder / "sionna.csv").write_text("program,place,gain_db\n" + "".join(
        f"Peer 1,{i},{gain - 3}\n" for i, gain in enumerate(street.gain_db) if i != 4))
    result, points = measured.streets(folder, folder / "sionna.csv")
    sight, hidden, covered = result["classes"]
    wobble = np.std([-1, 1] * 5, ddof=1)
    for row, offset in ((sight, 2), (hidden, -9)):
        assert (row["before"]["points"], row["before"]["with_a_path"]) == (10, 10), row
        near(row["before"]["offset_db"], offset, 1e-3, "offset")
        near(row["before"]["sigma_db"], wobble, 1e-3, "sigma")
        near(row["fitted"]["offset_db"], 0, 0.2, "offset after the fit")
        assert row["ds"] is None, "one path has no spread"
    assert covered["before"]["points"] == 0, "all hidden places are in sight in free space"
    near(sight["sionna"]["offset_db"], 3, 1e-3, "offset of the peer")
    near(sight["sionna"]["sigma_db"], 0, 1e-3, "sigma of the peer")
    assert sight["sionna"]["with_a_path"] == 9 and points["hidden"].shape == (10, 2)
    near(points["hidden"][0, 0], friis_db(10, 0, 1.6, STREET_HZ), 1e-3, "computed level of the figure")


def check_hallway(folder):
    """Levels are 4 dB above those of a dipole's gain towards each place; one peer is clipped."""
    folder.mkdir()
    (folder / "ground.obj").write_text(GROUND)
    names = [f"array{array}_{name}" for array in (1, 2) for name in ("measured", *measured_sets.PEERS)]
    rows = ["x_m,y_m," + ",".join(names)]
    for i in range(12):
        x, y, z = 5.0 + 3 * i, 2.0 * i, measured_sets.RECEIVER_M
        elevation = math.atan2(2.5 - z, math.hypot(x, y))
        dipole_db = 10 * math.log10(1.640922) + 20 * math.log10(math.cos(math.pi / 2 * math.sin(elevation)) / math.cos(elevation))
        level = friis_db(x, y, z, HALL_HZ) + dipole_db + 4
        rows.append(f"{x},{y}," + ",".join([f"{level},{max(level - 6, -65)},{level + 1},{level + (1 if i % 2 else -1)}"] * 2))
    (folder / "dc01_hexagons.csv").write_text("\n".join(rows) + "\n")
    for array in (1, 2):
        (folder / f"dc01_array{array}.toml").write_text(CONFIG.format(hz=HALL_HZ))
    result = measured.hallway(folder)
    for row in result["arrays"]:
        for partitions in ("slabs", "two boards"):  # free space has none
            near(row["partitions"][partitions]["before"]["offset_db"], 4, 1e-3, "offset of the hallway")
            near(row["partitions"][partitions]["before"]["sigma_db"], 0, 1e-3, "sigma of the hallway")
        near(row["sionna_learned"]["offset_db"], -1, 1e-9, "offset of the peer")
        near(row["sionna_neural"]["sigma_db"], np.std([-1, 1] * 6, ddof=1), 1e-9, "sigma of the peer")
        assert 1 < row["clipped"]["places"] < 12 and row["clipped"]["level_db"] == -65, row["clipped"]
        near(row["clipped"]["sionna_itu"]["sigma_db"], 0, 1e-9, "sigma without the clipped places")
        assert row["sionna_itu"]["sigma_db"] > 0.1, "clipped places count in the whole"


def main():
    with tempfile.TemporaryDirectory() as work:
        folder = pathlib.Path(work)
        write_street(folder / "boulder")
        check_readers(folder / "boulder")
        check_street(folder / "boulder")
        check_hallway(folder / "dichasus")
        (folder / "figures").mkdir()
        page_measured.draw({"in sight": np.array([[-90.0, -88], [-80, -78], [-np.inf, -90]])}, folder / "figures")
        drawn = (folder / "figures" / page_measured.STREETS).read_text()
        assert "offset +2.0 dB" in drawn and "<svg" in drawn
    print("measured levels: all checks passed")


if __name__ == "__main__":
    main()
