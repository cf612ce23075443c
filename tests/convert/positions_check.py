# SPDX-License-Identifier: Apache-2.0
"""Positions in degrees of ends, tracks, grids and GPX files, through a run and back to the earth by pyproj, to a
millimetre. Run as positions_check.py PROGRAM FOLDER; answers 77, "skipped", without pyproj or h5py."""
import json
import os
import subprocess
import sys

try:
    import h5py
    import numpy as np
    import pyproj
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

program, folder = sys.argv[1:]
os.makedirs(folder, exist_ok=True)
os.chdir(folder)

STATION = [48.1371234567, 11.5754321, 6.0]
RECEIVER = [48.1381, 11.5769, 1.5]
TRACK = [[0, 48.1365, 11.5745, 0.0], [4, 48.1365, 11.5755, 0.0]]
CORNERS = [48.1366, 11.5741], [48.1380, 11.5767]
GPS = [(48.1369, 11.5740), (48.1370, 11.5742), (48.1371, 11.5744)]
to_utm = pyproj.Transformer.from_crs("EPSG:4326", "EPSG:32632", always_xy=True)
geodesic = pyproj.Geod(ellps="WGS84")
offset = [-691500.25, -5334700.5]
SLOPE, LEVEL = 0.05, 510.0  # the ground is z = LEVEL + SLOPE x

with open("ground.obj", "w") as obj:
    for x, y in ((-900, -900), (900, -900), (900, 900), (-900, 900)):
        obj.write(f"v {x} {y} {LEVEL + SLOPE * x}\n")
    obj.write("f 1 2 3\nf 1 3 4\n")
with open("georeference.json", "w") as reference:
    json.dump({"projection": "+proj=utm +zone=32 +ellps=WGS84 +units=m", "offset_m": offset}, reference)
with open("drive.gpx", "w") as gpx:
    points = "".join(f'<trkpt lat="{lat}" lon="{lon}"><time>2026-11-24T10:00:0{2 * k}Z</time></trkpt>'
                     for k, (lat, lon) in enumerate(GPS))
    gpx.write(f'<gpx version="1.1"><trk><name>gps</name><trkseg>{points}</trkseg></trk></gpx>')
with open("test.toml", "w") as config:
    config.write(f"""
scene.file = "ground.obj"
scene.default_material = "concrete"
trajectories.file = "drive.gpx"
time.step_s = 2
trace.rays = 1000
trace.max_depth = 1
output.directory = "out"
vehicle_type = [{{ name = "passenger", model = "none" }}]
station = [{{ name = "rsu", position_wgs84 = {STATION} }}]
receiver = [{{ name = "rx", position_wgs84 = {RECEIVER} }}]
track = [{{ id = "ego", waypoints_wgs84 = {TRACK} }}]
mount = [{{ name = "up", role = "transmitter", offset_m = [0, 0, 1.6], above = "ground" }}]
[[receiver_grid]]
name = "map"
south_west_wgs84 = {CORNERS[0]}
north_east_wgs84 = {CORNERS[1]}
step_m = 40
above = "ground"
""")
subprocess.run([program, "run", "-c", "test.toml"], check=True)

with h5py.File("out/paths.h5") as run:
    names = {end: [name.decode() if isinstance(name, bytes) else name for name in run[f"{end}/name"][:]]
             for end in ("transmitters", "receivers")}
    places = {end: run[f"frames/{end[:-1]}_position_m"][:] for end in names}


def check(end, name, frame, latitude, longitude, height):
    x, y, z = places[end][frame][names[end].index(name)]
    lon, lat = to_utm.transform(x - offset[0], y - offset[1], direction="INVERSE")
    _, _, distance_m = geodesic.inv(lon, lat, longitude, latitude)
    assert abs(distance_m) < 1e-3, (name, frame, distance_m)
    assert abs(z - (LEVEL + SLOPE * x + height)) < 1e-3, (name, frame, z)


check("transmitters", "rsu", 0, *STATION)
check("receivers", "rsu", 2, *STATION)
check("receivers", "rx", 0, *RECEIVER)
check("transmitters", "ego/up", 0, *TRACK[0][1:3], 1.6)
check("transmitters", "ego/up", 2, *TRACK[1][1:3], 1.6)
for frame, place in enumerate(GPS):
    check("transmitters", "gps/up", frame, *place, 1.6)

# Cells of a grid lie between its corners, as far from one as from the other.
borders = to_utm.transform(*np.flip(CORNERS, 1).T)
(x_min, x_max), (y_min, y_max) = (np.add(of_axis, by) for of_axis, by in zip(borders, offset))
cells = places["receivers"][0][[name.startswith("map/") for name in names["receivers"]]]
assert len(cells) == int((x_max - x_min) // 40) * int((y_max - y_min) // 40) > 1, len(cells)
assert np.abs(cells[[0, -1], :2].mean(axis=0) - [(x_min + x_max) / 2, (y_min + y_max) / 2]).max() < 1e-3, cells
assert np.abs(cells[:, 2] - (LEVEL + SLOPE * cells[:, 0] + 1.5)).max() < 1e-3, cells
with open("out/shards/run.json") as record:
    saved = json.load(record)["config"]
assert f"south_west_wgs84 = {CORNERS[0]}" in saved and f"north_east_wgs84 = {CORNERS[1]}" in saved, saved
print("8 places and a grid agree with pyproj to a millimetre")
