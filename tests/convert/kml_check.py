# SPDX-License-Identifier: Apache-2.0
"""Parses drive.kml strictly and compares its places with paths.h5 by PROJ, to a millimetre on the ground.
Run as kml_check.py FOLDER, which holds run/ and drive.kml; answers 77, "skipped", without pyproj or h5py."""
import os
import sys
import xml.etree.ElementTree as ET
from datetime import datetime, timezone

try:
    import h5py
    import numpy as np
    import pyproj
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

NS = {"k": "http://www.opengis.net/kml/2.2"}
SCENE = "+proj=tmerc +lat_0=48.137 +lon_0=11.575 +k=1 +x_0=0 +y_0=0 +ellps=WGS84 +units=m"
to_earth = pyproj.Transformer.from_pipeline(
    f"+proj=pipeline +step +inv {SCENE} +step +proj=unitconvert +xy_in=rad +xy_out=deg")
geodesic = pyproj.Geod(ellps="WGS84")
START = datetime(2000, 1, 1, tzinfo=timezone.utc)


def places(placemark):
    assert placemark.find(".//k:altitudeMode", NS).text == "relativeToGround"
    return np.array([row.split(",") for row in placemark.find(".//k:coordinates", NS).text.split()], dtype=float)


def check_places(found, wanted):
    assert found.shape == wanted.shape
    lon, lat = to_earth.transform(wanted[:, 0], wanted[:, 1])
    _, _, distance_m = geodesic.inv(lon, lat, found[:, 0], found[:, 1])
    assert np.max(np.abs(distance_m)) < 1e-3 and np.allclose(found[:, 2], wanted[:, 2], atol=1e-4), distance_m


def span(placemark):
    texts = [placemark.find(f"k:TimeSpan/k:{name}", NS).text for name in ("begin", "end")]
    return [(datetime.fromisoformat(t.replace("Z", "+00:00")) - START).total_seconds() for t in texts]


# A fact that is not of PROJ's making: the origin of the projection is its own centre.
assert np.allclose(to_earth.transform(0, 0), (11.575, 48.137), atol=1e-12)
document = ET.parse(os.path.join(sys.argv[1], "drive.kml")).getroot().find("k:Document", NS)
folders = {f.find("k:name", NS).text: f for f in document.findall("k:Folder", NS)}
styles = {"#" + s.get("id") for s in document.findall("k:Style", NS)}
with h5py.File(os.path.join(sys.argv[1], "run/paths.h5"), "r") as file:
    frames, time_s = file["frames/frame"][...], file["frames/time_s"][...]
    assert set(folders) == {"ends that stay"} | {f"frame {n}" for n in frames}
    tx, rx = (file[f"{kind}/name"].asstr()[...] for kind in ("transmitters", "receivers"))
    assert "<rsu> & \"co\" \u00e9" in tx  # a name that XML must escape, and gives back
    stay = {p.find("k:name", NS).text: places(p) for p in folders["ends that stay"].iter(f"{{{NS['k']}}}Placemark")}
    assert set(stay) == {tx[0], "sign"}
    check_places(stay[tx[0]], np.array([[8.0, 7.5, 6.0]]))
    position, offset = file["vertices/position_m"][...], file["paths/vertex_offset"][...].astype(int)
    first, gain_db = file["frames/path_offset"][...].astype(int), file["paths/gain_db"][...]
    for row, number in enumerate(frames):
        parts = {f.find("k:name", NS).text: f.findall("k:Placemark", NS)
                 for f in folders[f"frame {number}"].iter(f"{{{NS['k']}}}Folder")}
        step = 0.1
        for placemark in parts["ends"] + parts["vehicles"] + parts["paths"]:
            assert np.allclose(span(placemark), [time_s[row], time_s[row] + step], atol=1e-3)
            assert placemark.find("k:styleUrl", NS).text in styles

        where = {"car<1>/roof": file["frames/receiver_position_m"][row, list(rx).index("car<1>/roof")]}
        assert [p.find("k:name", NS).text for p in parts["ends"]] == ["car<1>/roof"]  # once, as it sends and receives
        assert parts["ends"][0].find("k:styleUrl", NS).text == "#station"
        check_places(places(parts["ends"][0]), where["car<1>/roof"][None])

        poses = np.nonzero(file["poses/frame"][...] == number)[0]
        ids = file["instances/id"].asstr()[...]
        assert [p.find("k:name", NS).text for p in parts["vehicles"]] == list(ids[file["poses/instance"][poses]])
        for placemark, pose in zip(parts["vehicles"], poses):  # the middle of the box is the vehicle's
            box = places(placemark)
            assert len(box) == 5 and np.array_equal(box[0], box[4]) and 1 < box[0, 2] < 5
            middle = box[:4].mean(axis=0)
            lon, lat = to_earth.transform(*file["poses/position_m"][pose][:2])
            assert geodesic.inv(lon, lat, middle[0], middle[1])[2] < 1e-3
            _, _, length_m = geodesic.inv(*box[0, :2], *box[1, :2])
            assert 3.5 < length_m < 20

        mine = np.arange(first[row], first[row + 1])
        kept = mine if len(mine) <= 1000 else mine[np.argsort(-gain_db[mine], kind="stable")][:1000]
        assert len(parts["paths"]) == len(kept)
        for placemark, i in zip(parts["paths"], kept):
            assert placemark.find("k:name", NS).text == f"{tx[0]} to {rx[1]}"
            data = {d.get("name"): d.find("k:value", NS).text for d in placemark.iter(f"{{{NS['k']}}}Data")}
            gain = float(data["gain_db"])
            assert gain == gain_db[i] or abs(gain - gain_db[i]) <= 0.00501
            check_places(places(placemark), np.vstack([file["frames/transmitter_position_m"][row, 0],
                                                       position[offset[i]:offset[i + 1]],
                                                       file["frames/receiver_position_m"][row, 1]]))
            shade = int(placemark.find("k:styleUrl", NS).text.removeprefix("#gain_"))
            wanted = (gain_db[i] - (gain_db.max() - 60)) / 5
            assert shade == (0 if wanted < 0 else min(int(wanted), 11)), (shade, wanted)
print(f"kml: {len(frames)} frames within a millimetre of PROJ")
