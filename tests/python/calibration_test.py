#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""wt.calibrate over a ground whose material is known, and in free space.

Usage: calibration_test.py FOLDER, which is made anew. Exits with 77 without numpy or a device.
"""
import pathlib
import shutil
import sys

try:
    import numpy as np
except ImportError:
    sys.exit(77)
import wavetracer as wt

GROUND = "v -900 -900 0\nv 900 -900 0\nv 900 900 0\nv -900 900 0\no ground\nusemtl {}\nf 1 2 3 4\n"
CONFIG = """
[scene]
file = "{}.obj"
[radio]
frequency_hz = 1e9
[trace]
rays = 20000
max_depth = 1
{}
[[transmitter]]
name = "mast"
position_m = [0, 0, 10]
"""


def levels(text, places):
    """The path gains at the places, dB."""
    text += "".join(f'[[receiver]]\nname = "p{i:03}"\nposition_m = [{x}, {y}, {z}]\n' for i, (x, y, z) in enumerate(places))
    with wt.Simulation(text, folder=FOLDER) as simulation:
        links = simulation.run_frame().links
    gains = np.full(len(places), np.nan)
    gains[links["rx"]] = links["path_gain_db"]
    return gains


def table(name, places, gains, more=""):
    file = FOLDER / name
    file.write_text("x,y,z,path_gain_db\n" + "".join(
        f"{x},{y},{z},{gain!r}\n" for (x, y, z), gain in zip(places, map(float, gains))) + more)
    return file


def main():
    places = [(5.0 * i, 3.0, 1.5) for i in range(1, 41)]
    (FOLDER / "concrete.obj").write_text(GROUND.format("concrete"))
    start = FOLDER / "start.toml"
    start.write_text(CONFIG.format("concrete", ""))
    truth = levels(CONFIG.format("concrete", '[[material]]\nname = "concrete"\npermittivity = 8\nthickness_m = inf'), places)
    assert np.isfinite(truth).all()
    measured = table("m.csv", places, truth - 4)
    found = wt.calibrate(start, measured, FOLDER / "out", fit=["concrete.permittivity"],
                         sets={"trace.seed": 3}, folds=2)
    # The start is a slab of the library, and so the truth is another law: only the half space fits exactly.
    assert set(found.parameters) == {"concrete.permittivity", "offset of all points"}, found.parameters
    half_space = FOLDER / "half_space.toml"
    half_space.write_text(CONFIG.format("concrete", '[[material]]\nname = "concrete"\nthickness_m = inf'))
    found = wt.calibrate(half_space, [measured], FOLDER / "out", fit="concrete.permittivity")
    permittivity = found.parameters["concrete.permittivity"]
    assert abs(permittivity.fitted - 8) < 0.01 and abs(permittivity.before - 5.24) < 1e-9, permittivity
    assert abs(found.parameters["offset of all points"].fitted + 4) < 1e-3
    assert found.points["x_m"].tolist() == [x for x, _, _ in places]
    assert np.abs(found.points["fitted_db"] - found.points["measured_db"]).max() < 1e-2
    assert np.abs(found.points["held_out_db"] - found.points["measured_db"]).max() < 1e-1
    assert "40 points, 80 paths found" in found.text and found.fitted.exists()

    levels_only = wt.calibrate(half_space, measured, FOLDER / "out", fit="none", offset="none", folds=0)
    assert levels_only.parameters == {} and np.isnan(levels_only.points["held_out_db"]).all()

    lifted = wt.calibrate(half_space, table("lifted.csv", [(x, y, z - 0.25) for x, y, z in places], levels(
        half_space.read_text(), places)), FOLDER / "out", fit="receivers.height", errors={"receivers.height": 1},
        offset="none", folds=0)
    rise = lifted.parameters["receivers.height"]
    assert rise.unit == "m" and rise.before == 0 and abs(rise.fitted - 0.25) < 1e-3, rise

    try:
        wt.calibrate(start, table("bad.csv", places, truth, "1,2,three,-80\n"), FOLDER / "no")
    except wt.InputError as error:
        assert "bad.csv:42: z = 'three' is not a finite number" in str(error), error
    else:
        raise AssertionError("a broken row was read")
    assert not (FOLDER / "no").exists()


if __name__ == "__main__":
    FOLDER = pathlib.Path(sys.argv[1])
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    try:
        wt.devices()
    except wt.DeviceError as error:
        print(f"skipped: {error}")
        sys.exit(77)
    main()
