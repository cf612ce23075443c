# SPDX-License-Identifier: Apache-2.0
"""Radars live: detections and cubes of an answer, in both encodings, are those that `wavetracer run` writes for a drive
with the same poses. Assumes an OpenCL device."""
import json
import os
import subprocess
import sys
import tempfile

from live_server import PROGRAM, SOURCE, Server, drive, expect, frame, vehicle

sys.path.insert(0, os.path.join(SOURCE, "python"))
try:
    import h5py
    import numpy as np
except ImportError:
    print("skipped: no NumPy or h5py (Debian: python3-numpy, python3-h5py)")
    sys.exit(77)
from wavetracer.live import LiveClient, LiveError

WORLD = """
[scene]
generate = "--seed 1 --blocks 2x2"
extrapolate_materials = true
[radio]
frequency_hz = 77e9
transmit_power_dbm = 12.0
[trace]
rays = 5000
max_depth = 2
[links]
same_vehicle = true
v2v = false
[[array]]
name = "row"
columns = 3
[[mount]]
name = "sends"
on = "passenger"
role = "transmitter"
offset_m = [2.6, 0.1, 0.6]
[[mount]]
name = "hears"
on = "passenger"
role = "receiver"
offset_m = [2.6, -0.1, 0.6]
array = "row"
[[target_model]]
name = "body"
on = "*"
kind = "vehicle-points"
"""
RADAR = """
[[radar]]
name = "front"
bandwidth_hz = 300e6
chirps = 32
samples = 64
direct = false
"""
LIVE = """
[[live_vehicle]]
type = "passenger"
count = 3
[[live_vehicle]]
type = "truck"
count = 1
"""
TRACKS = drive("[[0.0, 3.0, -40.0, 0.0], [1.0, 3.0, -32.0, 0.0]]")
POSES = [vehicle("ego", 3, -60, 90, velocity_m_s=[0, 10, 0], angular_velocity_rad_s=[0, 0, 0]),
         vehicle("other", -3, -30, -90, velocity_m_s=[0, -15, 0], angular_velocity_rad_s=[0, 0, 0]),
         vehicle("lorry", 3, -40, 90, "truck", velocity_m_s=[0, 8, 0], angular_velocity_rad_s=[0, 0, 0])]


def of_run(folder):
    """The detections and the cube of each radar by its vehicle, from radar.h5."""
    path = os.path.join(folder, "drive.toml")
    with open(path, "w", encoding="utf-8") as file:
        file.write(WORLD + RADAR + TRACKS)
    out = os.path.join(folder, "out")
    subprocess.run([PROGRAM, "run", "-c", path, "-o", out], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    with h5py.File(os.path.join(out, "paths.h5")) as file:
        names = [name.decode() for name in file["transmitters/name"][...]]
    found = {}
    with h5py.File(os.path.join(out, "radar.h5")) as file:
        group = file["front"]
        for row, tx in enumerate(group["frames/tx"][...]):
            mine = group["detections/tx"][...] == tx
            found[names[tx].split("/")[0]] = ({key: values[...][mine] for key, values in group["detections"].items()},
                                              group["cube/re"][row] + 1j * group["cube/im"][row])
    return found


def compare(radars, expected):
    expect({radar.tx for radar in radars} == {name + "/sends" for name in expected}, radars)
    for radar in radars:
        detections, cube = expected[radar.tx.split("/")[0]]
        expect(radar.name == "front" and radar.rx == radar.tx.replace("sends", "hears"), radar)
        for key, values in radar.detections.items():
            expect(len(values) == len(detections[key]) and np.allclose(values, detections[key], rtol=1e-9, atol=0, equal_nan=True),
                   (key, values, detections[key]))
        if radar.cube is not None:
            expect(radar.cube.values.shape == (3, 1, 32, 64), radar.cube)
            expect(np.abs(radar.cube.values - cube).max() < 1e-6 * np.abs(cube).max(), "the cube differs")


with tempfile.TemporaryDirectory() as folder:
    expected = of_run(folder)
expect(set(expected) == {"ego", "other"}, expected)
expect(all(len(detections["range_m"]) > 0 for detections, _ in expected.values()), expected)
with Server(config=WORLD + RADAR + LIVE) as server:
    for encoding in ("json", "cbor"):
        with LiveClient(server.name, encoding=encoding) as client:
            expect(client.world["radars"] == [{"radar": "front", "rx_antennas": 3, "tx_antennas": 1, "chirps": 32,
                                               "samples": 64}], client.world["radars"])
            expect(client.channels(0.0, POSES).radars == [], "radars were not asked for")
            found = client.channels(0.0, POSES, radar="detections").radars
            compare(found, expected)
            expect(all(radar.cube is None for radar in found), found)
            compare(client.channels(0.0, POSES, radar="cubes").radars, expected)
        with LiveClient(server.name, encoding=encoding, radar="cubes") as client:
            client.channels(0.0, POSES)
            moved = [{**pose, "position_m": [p + 0.1 * v for p, v in zip(pose["position_m"], pose["velocity_m_s"])]}
                     for pose in POSES]
            client.channels(0.1, moved)
            between = client.at(0.05).radars
            expect(len(between) == 2 and between[0].cube.values.shape == (3, 1, 32, 64), between)
            expect(client.channels(0.2, []).radars == [], "no vehicle has a radar")
    with LiveClient(server.name) as client:  # the client in C++ reads the same
        alone = client.channels(0.0, POSES[:1], radar="detections").radars
    said = subprocess.run([sys.argv[3], server.name, "30", "0", "detections"], input="frame 0\n", capture_output=True, text=True,
                          check=True).stdout.splitlines()
    expect(json.loads(said[1])["instants"][0]["ranges_m"] == {"ego/sends": list(alone[0].detections["range_m"])}, said[1])
    with server.connect() as client:
        client.hello()
        answer = client.ask(frame(0, 0.0, POSES, radar="maps"))
        expect(answer["code"] == "bad_value" and "must be one of none, detections, cubes" in answer["text"], answer)
# Two cubes of 3 x 32 x 64 cells have 16 bytes a cell as columns, and 48 as JSON.
for limit, encoding, size in ((196608, "cbor", None), (196607, "cbor", 196608), (196608, "json", 589824)):
    with Server(config=WORLD + RADAR + LIVE, sets=[f"live.max_queue_bytes={limit}"]) as server:
        with LiveClient(server.name, encoding=encoding) as client:
            try:
                found = client.channels(0.0, POSES, radar="cubes").radars
                expect(size is None and len(found) == 2 and found[0].cube is not None, "too large a cube was given")
            except LiveError as error:
                expect(size is not None and error.reason == "too_large" and 'ask for "detections"' in str(error)
                       and f"{size} bytes" in str(error), error)
            compare(client.channels(0.1, POSES, radar="detections").radars, expected)
with Server(config=WORLD + LIVE) as server:
    with LiveClient(server.name) as client:
        try:
            client.channels(0.0, POSES, radar="cubes")
            expect(False, "a radar that there is not")
        except LiveError as error:
            expect(error.reason == "no_radar" and "add one" in str(error), error)
        expect(len(client.channels(0.0, POSES)) == 2, "the connection goes on")
    with server.connect() as client:
        answer = client.hello(radar="detections")
        expect(answer["code"] == "no_radar" and answer["fatal"], answer)
print("radars live as `run` has them")
