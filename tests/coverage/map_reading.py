# SPDX-License-Identifier: Apache-2.0
"""Helpers of the scripts of this folder: a scene of two antennas in free space, and readers of tables. A script ends with
main(TEST, PROGRAMS...), which calls TEST(program, folder) with its two arguments and an empty folder; it answers 77 where
a program or an OpenCL device is missing."""
import csv
import shutil
import subprocess
import sys
from pathlib import Path

try:
    import h5py  # noqa: F401
    import numpy as np
except ImportError as missing:
    print(missing)
    sys.exit(77)

FREE_SPACE = """
scene.file = "{scene}"
scene.default_material = "concrete"
trace.max_depth = 0
[radio]
frequency_hz = 3.5e9
transmit_power_dbm = 43
bandwidth_hz = 20e6
noise_figure_db = 6
[[transmitter]]
name = "west"
position_m = [10, 30, 25]
[[transmitter]]
name = "east, far"
position_m = [100, 40, 25]
[[receiver_grid]]
name = "g"
x_min_m = 0
x_max_m = 120
y_min_m = 0
y_max_m = 60
step_m = 4
"""
PLANE = "v -200 -200 0\nv 300 -200 0\nv 300 300 0\nv -200 300 0\nf 1 2 3 4\n"
LIGHT_M_S = 299792458



def run(*arguments, code=0, text=None):
    done = subprocess.run([str(a) for a in arguments], capture_output=True, text=True, input=text)
    assert done.returncode == code, (arguments, done.returncode, done.stdout, done.stderr)
    return done


def table(file):
    with open(file, newline="") as lines:
        return list(csv.DictReader(lines))


def column(rows, name):
    return np.array([float(row[name]) for row in rows])


def same(a, b, digits=1e-9):
    assert np.allclose(a, b, rtol=digits, atol=digits, equal_nan=True), np.nanmax(np.abs(a - b))


def db(power):
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(power > 0, 10 * np.log10(power), np.nan)


def pixels(file):
    """Value of each pixel by its place, as GDAL reads both."""
    lines = run("gdal_translate", "-q", "-of", "XYZ", file, "/vsistdout/").stdout.split("\n")
    return {(round(float(x), 3), round(float(y), 3)): float(value) for x, y, value in (line.split() for line in lines if line)}


def free_run(program, folder, config):
    """Runs a configuration over a plane in a new folder "free", and returns that folder; the run is "out" in it."""
    place = folder / "free"
    place.mkdir()
    (place / "plane.obj").write_text(PLANE)
    (place / "run.toml").write_text(config.format(scene=place / "plane.obj"))
    run(program, "run", "-c", place / "run.toml", "-o", place / "out")
    return place


def main(test, *programs):
    missing = [name for name in programs if not shutil.which(name)]
    if missing:
        print(f"no {', '.join(missing)}")
        sys.exit(77)
    program, folder = sys.argv[1], Path(sys.argv[2]).absolute()
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    if subprocess.run([program, "devices"], capture_output=True).returncode != 0:
        print("no OpenCL device")
        sys.exit(77)
    test(program, folder)
