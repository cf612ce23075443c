# SPDX-License-Identifier: Apache-2.0
"""Checks a .glb against the rules of glTF 2.0 byte by byte, and its nodes and animation against paths.h5.
Run as glb_check.py FOLDER, which holds run/, one.glb and drive.glb; answers 77, "skipped", without NumPy or h5py."""
import json
import os
import struct
import sys

try:
    import h5py
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing} (Debian: python3-h5py)")
    sys.exit(77)

TYPES = {5121: np.uint8, 5125: np.uint32, 5126: np.float32}
WIDTH = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}


def chunks(path):
    data = open(path, "rb").read()
    magic, version, length = struct.unpack_from("<4sII", data)
    assert (magic, version, length) == (b"glTF", 2, len(data))
    at, out = 12, []
    while at < len(data):
        size, kind = struct.unpack_from("<I4s", data, at)
        assert size % 4 == 0 and at + 8 + size <= len(data)
        out.append((kind, data[at + 8:at + 8 + size]))
        at += 8 + size
    assert [kind for kind, _ in out] == [b"JSON", b"BIN\0"]
    return json.loads(out[0][1].decode("utf-8"), parse_constant=lambda word: sys.exit(f"{word} in JSON")), out[1][1]


def accessors(root, body):
    """The arrays, each checked: inside its view, aligned, with true bounds."""
    length = root["buffers"][0]["byteLength"]
    assert len(root["buffers"]) == 1 and length <= len(body) < length + 4
    out, used = [], np.zeros(len(body), bool)
    for accessor in root["accessors"]:
        view, kind = root["bufferViews"][accessor["bufferView"]], np.dtype(TYPES[accessor["componentType"]])
        start, size = view["byteOffset"], accessor["count"] * WIDTH[accessor["type"]] * kind.itemsize
        assert accessor["count"] > 0 and size == view["byteLength"] and start + size <= len(body)
        assert start % 4 == 0 and not used[start:start + size].any()
        used[start:start + size] = True
        values = np.frombuffer(body, kind, accessor["count"] * WIDTH[accessor["type"]], start)
        values = values.reshape(-1, WIDTH[accessor["type"]])
        assert np.all(np.isfinite(values))
        if "min" in accessor:
            assert np.array_equal(np.float32(accessor["min"]), values.min(axis=0))
            assert np.array_equal(np.float32(accessor["max"]), values.max(axis=0))
        out.append(values)
    assert used[:length].all()
    return out


def check_references(root, arrays):
    parents = np.zeros(len(root["nodes"]), int)
    for node in root["nodes"]:
        assert "children" not in node or node["children"]
        parents[node.get("children", [])] += 1
        assert "mesh" not in node or node["mesh"] < len(root["meshes"])
        assert abs(np.linalg.norm(node.get("rotation", [0, 0, 0, 1])) - 1) < 1e-6
    assert list(parents) == [0] + [1] * (len(parents) - 1) and root["scenes"][root["scene"]] == {"nodes": [0]}
    for mesh in root["meshes"]:
        for primitive in mesh["primitives"]:
            corners, mode = arrays[primitive["indices"]], primitive.get("mode", 4)
            count = {a: len(arrays[i]) for a, i in primitive["attributes"].items()}
            assert len(set(count.values())) == 1 and corners.max() == count["POSITION"] - 1
            assert "min" in root["accessors"][primitive["attributes"]["POSITION"]]
            assert mode in (1, 4) and len(corners) % (3 if mode == 4 else 2) == 0
            assert primitive["material"] < len(root["materials"])


def children(root, name):
    group = next((n for n in root["nodes"] if n["name"] == name), {})
    return {root["nodes"][i]["name"]: (i, root["nodes"][i]) for i in group.get("children", [])}


def rotate(q, v):
    u = np.array(q[:3])
    return v + 2 * np.cross(u, np.cross(u, v) + q[3] * v)


def check(folder, name, rows):
    root, body = chunks(os.path.join(folder, name))
    arrays = accessors(root, body)
    check_references(root, arrays)
    assert root["asset"]["version"] == "2.0" and root["extensionsUsed"] == ["KHR_materials_unlit"]
    matrix = np.array(root["nodes"][0]["matrix"]).reshape(4, 4).T
    assert np.array_equal(matrix[:3, :3] @ [1, 2, 3], [1, 3, -2])  # z up to y up
    origin_m = np.array([matrix[0, 3], -matrix[2, 3], matrix[1, 3]])

    def at(index):  # the channels of a node, by their path
        return {c["target"]["path"]: root["animations"][0]["samplers"][c["sampler"]]
                for c in root.get("animations", [{"channels": []}])[0]["channels"] if c["target"]["node"] == index}

    with h5py.File(os.path.join(folder, "run/paths.h5"), "r") as file:
        time_s = file["frames/time_s"][...][rows]
        tracks = {}  # (group, name): [(row, position, rotation)]
        numbers, ids = file["frames/frame"][...][rows], file["instances/id"].asstr()[...]
        poses = (file["poses"][c][...] for c in ("frame", "instance", "position_m", "rotation"))
        for frame, instance, p, r in zip(*poses):
            if frame in numbers:
                tracks.setdefault(("vehicles", ids[instance]), []).append((list(numbers).index(frame), p, r))
        for group in ("transmitters", "receivers"):
            positions = file[f"frames/{group[:-1]}_position_m"][...][rows]
            for i, end in enumerate(file[group]["name"].asstr()):
                tracks[group, end] = [(k, p[i], np.eye(3)) for k, p in enumerate(positions) if np.isfinite(p[i, 0])]
        for (group, end), keys in tracks.items():
            index, node = children(root, group)[end]
            assert np.allclose(node["translation"], keys[0][1] - origin_m, atol=1e-9)
            for axis in np.eye(3):
                assert np.allclose(rotate(node["rotation"], axis), keys[0][2] @ axis, atol=1e-6)
            assert (node.get("scale") == [0, 0, 0]) == (keys[0][0] != 0)
            channels = at(index)
            assert ("scale" in channels) == (len(keys) < len(rows))
            if "scale" in channels:
                there = arrays[channels["scale"]["output"]][:, 0]
                assert channels["scale"]["interpolation"] == "STEP"
                assert np.array_equal(np.nonzero(there)[0], [k for k, _, _ in keys]) and set(there) <= {0, 1}
            moves = np.ptp([p for _, p, _ in keys], axis=0).max() > 0
            assert ("translation" in channels) == moves
            if moves:
                times = arrays[channels["translation"]["input"]][:, 0]
                assert np.allclose(times, [time_s[k] - time_s[0] for k, _, _ in keys]) and np.all(np.diff(times) > 0)
                positions = arrays[channels["translation"]["output"]]
                assert np.allclose(positions, [p - origin_m for _, p, _ in keys], atol=1e-5)
        assert set(children(root, "vehicles")) == {end for group, end in tracks if group == "vehicles"}

        first = int(file["frames/path_offset"][rows[0]])
        count = int(file["frames/path_offset"][rows[0] + 1]) - first
        depth = file["paths/depth"][first:first + count].astype(int)
        node = next(n for n in root["nodes"] if n["name"] == "paths")
        assert node["extras"]["frame"] == numbers[0] and node["extras"]["paths"] == count
        primitive = root["meshes"][node["mesh"]]["primitives"][0]
        points, legs = arrays[primitive["attributes"]["POSITION"]], arrays[primitive["indices"]].reshape(-1, 2)
        assert len(points) == np.sum(depth + 2) and len(legs) == np.sum(depth + 1) and np.all(np.diff(legs) == 1)
        gain_db = file["paths/gain_db"][first:first + count]
        colour = arrays[primitive["attributes"]["COLOR_0"]][np.cumsum(depth + 2) - 1].astype(int)
        order = np.argsort(gain_db)
        assert np.all(np.diff(colour[order][:, 1]) >= 0)  # the stronger, the greener, in this map
        if count > 1:
            assert node["extras"]["brightest_db"] == gain_db.max() and colour[order][-1, 1] > 100
        start = file["frames/transmitter_position_m"][rows[0], 0] - origin_m
        assert np.allclose(points[np.cumsum(depth + 2) - depth - 2], start, atol=1e-5)

    # Sampled rays: a leg to every reflection, from the point of the ray before it.
    with h5py.File(os.path.join(folder, "run/waypoints.h5"), "r") as file:
        mine = (file["waypoints/frame"][...] == numbers[0]) & ~np.isin(file["waypoints/kind"][...], (3, 4))
        kind, position = file["waypoints/kind"][...][mine], file["waypoints/position_m"][...][mine]
    node = next(n for n in root["nodes"] if n["name"] == "rays")
    primitive = root["meshes"][node["mesh"]]["primitives"][0]
    points, legs = arrays[primitive["attributes"]["POSITION"]], arrays[primitive["indices"]].reshape(-1, 2)
    assert node["extras"]["segments"] == len(legs) == np.sum(kind == 1) == 2
    drawn = (kind != 0) | (np.append(kind[1:], 0) != 0)  # no launch that is followed by no segment
    kind, position = kind[drawn], position[drawn]
    ends = np.nonzero(kind == 1)[0]
    assert np.array_equal(legs, np.stack([ends - 1, ends], axis=1))
    assert np.allclose(points, position - origin_m, atol=1e-5)
    colour = arrays[primitive["attributes"]["COLOR_0"]].astype(int)
    assert colour[legs[0, 1], 1] > colour[legs[1, 1], 1]  # the first segment is the brighter


# Vegetation alone is transparent.
root, _ = chunks(os.path.join(sys.argv[1], "one.glb"))
green = {material["name"]: material["extras"] for material in root["materials"] if material.get("alphaMode") == "BLEND"}
assert green == {"vegetation": {"vegetation": "mixed", "in_leaf": True},
                 "hedge": {"vegetation": "deciduous", "in_leaf": True, "attenuation_db_m": 1.5}}, green
assert set(children(root, "vegetation")) == set(green)
check(sys.argv[1], "one.glb", [2])
check(sys.argv[1], "drive.glb", [0, 1, 2, 3])
print("glb: as glTF 2.0 asks, and as in paths.h5")
