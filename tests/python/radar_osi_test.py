#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads the reflections of a radar with ASAM's own bindings, and compares them with the paths that they were.

Usage: radar_osi_test.py FOLDER. Exits with 77 without numpy or osi3 (PyPI: osi-python).
"""
import pathlib
import struct
import sys

try:
    import numpy as np
    from osi3.osi_sensorview_pb2 import SensorView
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)
import wavetracer
from wavetracer import radar
from wavetracer.links import Ends
from wavetracer.paths import Paths

FOLDER = pathlib.Path(sys.argv[1])
FOLDER.mkdir(parents=True, exist_ok=True)


def made(count, seed):
    random = np.random.default_rng(seed)
    columns = {"tx": np.zeros(count, np.uint32), "rx": np.zeros(count, np.uint32), "delay_s": random.uniform(0, 1e-6, count),
               "gain_db": random.uniform(-150, -60, count), "doppler_hz": random.uniform(-1e4, 1e4, count),
               "aoa_theta_rad": random.uniform(0, np.pi, count), "aoa_phi_rad": random.uniform(-np.pi, np.pi, count)}
    return Paths(columns.__getitem__, Ends(("t",), ("r",), 77e9))


frames = [(0.25, made(3, 1)), (1234.000000007, made(0, 2)), (1235.9999999999, made(200, 3))]
angle = np.radians(30)
turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
for axes, yaw in ((None, 0.0), (turn, angle)):
    radar.write_osi(FOLDER / "radar.osi", frames, axes)
    data, at, views = (FOLDER / "radar.osi").read_bytes(), 0, []
    while at < len(data):
        (length,) = struct.unpack_from("<L", data, at)
        views.append(SensorView.FromString(data[at + 4:at + 4 + length]))
        at += 4 + length
    assert len(views) == 3
    for view, (time_s, paths) in zip(views, frames):
        assert view.version.version_major == 3 and view.version.version_minor == 8
        assert abs(view.timestamp.seconds + 1e-9 * view.timestamp.nanos - time_s) < 2e-9
        assert len(view.radar_sensor_view) == 1 and len(view.radar_sensor_view[0].reflection) == len(paths)
        for i, found in enumerate(view.radar_sensor_view[0].reflection):
            assert found.signal_strength == paths.gain_db[i] and found.time_of_flight == paths.delay_s[i]
            assert found.doppler_shift == paths.doppler_hz[i]
            off = found.source_horizontal_angle - (paths.aoa_phi_rad[i] - yaw)
            assert abs(np.angle(np.exp(1j * off))) < 1e-9
            assert abs(found.source_vertical_angle - (np.pi / 2 - paths.aoa_theta_rad[i])) < 1e-7
try:
    radar.write_osi(FOLDER / "wrong.osi", frames, np.ones((3, 3)))
except wavetracer.ConfigError as error:
    assert "no rotation" in str(error)
else:
    raise AssertionError("taken")
print("reflections ok")
