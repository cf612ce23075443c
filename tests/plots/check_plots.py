#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs `wavetracer run` and `wavetracer plot` as a user does, and compares what comes out with paths.h5.

    check_plots.py PROGRAM FOLDER

Needs numpy, h5py and gnuplot, VTK to look at the pictures, and an OpenCL device; answers 77 where one is missing.
"""
import csv
import math
import shutil
import subprocess
import sys
from pathlib import Path

CONFIG = """
scene.generate = "--seed 1 --blocks 2x2"
trace.rays = 50000
trace.max_depth = 2
[[transmitter]]
name = "rsu, north"
position_m = [8, 8, 6]
[[receiver]]
name = "car"
position_m = [60, -3, 1.5]
velocity_m_s = [14, 0, 0]
[[receiver_grid]]
name = "street"
x_min_m = -60
x_max_m = 60
y_min_m = -40
y_max_m = 40
step_m = 4
"""


def run(*arguments, code=0):
    done = subprocess.run([str(a) for a in arguments], capture_output=True, text=True)
    assert done.returncode == code, (arguments, done.returncode, done.stdout, done.stderr)
    return done


def rows(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def check_coverage(h5, folder):
    names = [n.decode() if isinstance(n, bytes) else n for n in h5["receivers/name"][...]]
    power = dict.fromkeys(range(len(names)), 0.0)
    a = h5["paths/a_re"][...] ** 2 + h5["paths/a_im"][...] ** 2
    for rx, value in zip(h5["paths/rx"][...], a.sum(axis=(1, 2))):
        power[int(rx)] += value
    cells = rows(folder / "coverage.csv")
    assert len(cells) == 30 * 20 == len(names) - 1
    empty = 0
    for k, cell in enumerate(cells):
        ix, iy = int(cell["ix"]), int(cell["iy"])
        assert (ix, iy) == (k % 30, k // 30)
        assert float(cell["x_m"]) == -58 + 4 * ix and float(cell["y_m"]) == -38 + 4 * iy and cell["z_m"] == "1.5"
        heard, drawn = power[names.index(f"street/{ix},{iy}")], float(cell["path_gain_db"])
        if heard > 0:
            assert abs(drawn - 10 * math.log10(heard)) < 1e-9 and cell["tx"] == "rsu, north"
        else:
            assert math.isnan(drawn) and cell["tx"] == ""
            empty += 1
    assert 0 < empty < len(cells)  # buildings stand there, and streets lead through


def check_profile(h5, folder, receiver):
    mine = h5["paths/rx"][...] == receiver
    drawn = sorted((float(r["delay_s"]), float(r["gain_db"]), float(r["doppler_hz"])) for r in rows(folder / "pdp.csv"))
    saved = sorted(zip(*(h5[f"paths/{name}"][...][mine] for name in ("delay_s", "gain_db", "doppler_hz"))))
    assert len(drawn) > 2 and [tuple(map(float, s)) for s in saved] == drawn  # to the last bit


def colours(path, reader):
    reader.SetFileName(str(path))
    reader.Update()
    image = reader.GetOutput()
    scalars = image.GetPointData().GetScalars()
    assert image.GetDimensions()[0] >= 1000
    return {scalars.GetTuple(i) for i in range(0, scalars.GetNumberOfTuples(), 7)}


def main():
    try:
        import h5py
        from vtkmodules.vtkIOImage import vtkPNGReader
    except ImportError as missing:
        print(missing)
        return 77
    if not shutil.which("gnuplot"):
        print("no gnuplot")
        return 77
    program, folder = sys.argv[1], Path(sys.argv[2])
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    if subprocess.run([program, "devices"], capture_output=True).returncode != 0:
        print("no OpenCL device")
        return 77
    (folder / "coverage.toml").write_text(CONFIG)
    run(program, "run", "-c", folder / "coverage.toml", "-o", folder / "out")
    said = run(program, "plot", folder / "out", "--format", "png").stdout.split()
    plots = folder / "out/plots"
    assert {Path(s).name for s in said} == {p.name for p in plots.iterdir()}
    with h5py.File(folder / "out/paths.h5") as h5:
        check_coverage(h5, plots)
        check_profile(h5, plots, 0)
    for name, least in (("coverage", 100), ("pdp", 20), ("angles", 50), ("doppler", 50)):
        found = colours(plots / f"{name}.png", vtkPNGReader())
        assert len(found) > least, (name, len(found))
    # The script alone draws the same again.
    (plots / "coverage.png").unlink()
    subprocess.run(["gnuplot", "coverage.gp"], cwd=plots, check=True)
    assert (plots / "coverage.png").stat().st_size > 10000
    # A receiver of the grid by its name.
    run(program, "plot", folder / "out", "--rx", "street/15,10", "--what", "pdp,angles", "-o", folder / "one")  # SVG and PNG
    assert sorted(p.suffix for p in (folder / "one").iterdir()) == [".csv", ".csv", ".gp", ".gp", ".png", ".png", ".svg", ".svg"]
    refused = run(program, "plot", folder / "out", "--rx", "street/15,100", code=2).stderr
    assert "the nearest are" in refused, refused
    run(program, "plot", folder / "nothing", code=3)
    return 0


sys.exit(main())
