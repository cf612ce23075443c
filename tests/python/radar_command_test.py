#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The example of docs/radar.md: a run of configs/radar.toml, its radar.h5, and the figures of `wavetracer plot`.

Usage: radar_command_test.py PROGRAM CONFIGS FOLDER. Exits with 77 without numpy or h5py.
"""
import pathlib
import subprocess
import sys

try:
    import h5py
    import numpy as np
except ImportError:
    sys.exit(77)
from wavetracer import radar

PROGRAM, CONFIGS, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
RUN = FOLDER / "run"


def said(*command):
    done = subprocess.run([str(word) for word in command], check=False, capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


FOLDER.mkdir(parents=True, exist_ok=True)
code, text = said(PROGRAM, "run", "-c", CONFIGS / "radar.toml", "-o", RUN, "--set", "trace.rays=20000", "--frames", "0:4")
assert code == 0, text
(RUN / "radar.h5").unlink(missing_ok=True)
code, text = said(PROGRAM, "plot", RUN, "--what", "range-doppler", "-o", FOLDER / "plots")
assert code == 2 and "python3 -m wavetracer.radar" in text, text
command = [sys.executable, "-m", "wavetracer.radar", RUN]
code, text = said(*command, "--frames", "70:80")
assert code == 2 and "frames 0 to 4" in text, text
code, text = said(*command, "--window", "kaiser")
assert code == 2 and "there is no window" in text, text
code, text = said(*command, "--samples", 64)
assert code == 0 and "are later than 6.4e-08 s and left out" in text, text
code, text = said(*command, "--no-direct", "--noise-figure", "12", "--osi", FOLDER / "radar.osi")
assert code == 0 and "5 frames without direct paths" in text, text

# The car ahead: its rear is 20.3 m from the bumper at first, and it goes away at 19.9 - 13.9 = 6 m/s.
with h5py.File(RUN / "radar.h5") as file:
    found = {name: column[...] for name, column in file["detections"].items()}
    times = file["frames/time_s"][...]
ranges = []
for frame in range(5):
    moving = np.flatnonzero((found["frame"] == frame) & (np.abs(found["speed_m_s"]) > 2))
    assert len(moving) == 1, (frame, found)
    assert abs(found["speed_m_s"][moving[0]] + 6) < 0.2
    ranges.append(found["range_m"][moving[0]])
assert abs(ranges[0] - 20.3) < 0.3, ranges
assert abs(np.polyfit(times, ranges, 1)[0] - 6) < 0.15, ranges
cubes = radar.load(RUN / "radar.h5")
assert list(cubes) == [0, 1, 2, 3, 4] and cubes[0].values.shape == (1, 1, 128, 256)

code, text = said(PROGRAM, "plot", RUN, "--what", "range-doppler,micro-doppler", "--frame", 3, "-o", FOLDER / "plots")
assert code == 0, text
rows = (FOLDER / "plots/range_doppler.csv").read_text().splitlines()
assert rows[0] == "speed_m_s,range_m,power_dbm" and len(rows) == 1 + 128 * 256
table = np.array([[float(cell) for cell in row.split(",")] for row in rows[1:]])
np.testing.assert_allclose(table[:, 2].reshape(128, 256), np.maximum(cubes[3].power_dbm, -999), atol=1e-3)
rows = (FOLDER / "plots/micro_doppler.csv").read_text().splitlines()
assert rows[0] == "time_s,speed_m_s,power_dbm" and len(rows) == 1 + 5 * 128
if "gnuplot" not in text:
    assert b"<svg" in (FOLDER / "plots/range_doppler.svg").read_bytes()[:2000]
# Echoes of a plate of 0.3 m x 0.3 m at 8 m are one detection with the power of the radar equation, 4 pi A^2 / lambda^2 at
# normal incidence, less what the near field costs: 8 m is less than 2 D^2 / lambda = 46 m.
(FOLDER / "plate.obj").write_text("v 8 -0.15 -0.15\nv 8 0.15 -0.15\nv 8 0.15 0.15\nv 8 -0.15 0.15\nf 1 2 3\nf 1 3 4\n")
carrier, wave = 77e9, radar.Waveform(1e9, 20e-6, chirps=32, samples=128)
found = radar.echoes(FOLDER / "plate.obj", carrier, [0, 0, 0], [0, 0, 0], "--up=z", "--echo-size=0.1")
assert found["a"].shape == (len(found["delay_s"]), 2, 2) and (found["bounces"] == 1).all()
assert np.allclose(found["first_m"][:, 0], 8) and np.array_equal(found["first_m"], found["last_m"])
cube = radar.cube_of(radar.beat_of_echoes(found["delay_s"], found["a"][:, 0, 0], wave, carrier, 2000.0), wave, carrier)
peak = cube.detections()
assert abs(peak["range_m"][0] - 8) < 0.05 and abs(peak["doppler_hz"][0] - 2000) < 250
# The field of a plate at this distance by Fresnel integrals, over that of the far field.
wavelength = 299792458.0 / carrier
x = (np.arange(20000) + 0.5) / 20000 * 0.15
near = abs(np.mean(np.exp(-2j * np.pi / wavelength * x**2 / 8))) ** 2
far = wavelength / (4 * np.pi) * (0.09 / wavelength) / 64
expected = 10 + 20 * np.log10(far * near)
assert abs(20 * np.log10(abs((found["a"][:, 0, 0] * np.exp(-2j * np.pi * carrier * found["delay_s"])).sum())) + 10
           - expected) < 0.2
assert abs(peak["power_dbm"][0] - expected) < 2

with h5py.File(RUN / "radar.h5", "r+") as file:
    file["frames/frame"][...] = 7
code, text = said(PROGRAM, "plot", RUN, "--what", "range-doppler", "-o", FOLDER / "plots")
assert code == 3 and "/frames/frame" in text, (code, text)
print("radar of a run ok")
