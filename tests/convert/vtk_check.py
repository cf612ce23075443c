# SPDX-License-Identifier: Apache-2.0
"""Reads the folder of `convert --to vtk` with VTK's own readers, and compares it with paths.h5 as h5py reads it.
Run as vtk_check.py FOLDER, which holds run/ and vtk/; answers 77, "skipped", where VTK or h5py is not installed."""
import os
import sys
import xml.etree.ElementTree as ET

try:
    import h5py
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
except ImportError as missing:
    print(f"skipped: {missing} (Debian: python3-vtk9, python3-h5py)")
    sys.exit(77)

base = os.path.join(sys.argv[1], "vtk")


def read(name):
    reader = vtkXMLPolyDataReader()
    errors = []
    reader.AddObserver("ErrorEvent", lambda *_: errors.append(name))
    reader.SetFileName(os.path.join(base, name))
    reader.Update()
    assert not errors, name
    return reader.GetOutput()


def array(attributes, name):
    found = attributes.GetArray(name)
    assert found is not None, name
    return vtk_to_numpy(found)


def texts(attributes, name):
    found = attributes.GetAbstractArray(name)
    return [found.GetValue(i) for i in range(found.GetNumberOfValues())]


def points(data):
    return vtk_to_numpy(data.GetPoints().GetData()) if data.GetNumberOfPoints() else np.zeros((0, 3))


def area(data):
    corner = points(data)[vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
    return np.linalg.norm(np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]), axis=1) / 2


scene = read("scene.vtp")
material, names = array(scene.GetCellData(), "material"), texts(scene.GetFieldData(), "material_names")
assert scene.GetNumberOfPolys() == len(material) > 100 and material.max() < len(names), names
assert array(scene.GetCellData(), "object").max() == len(texts(scene.GetFieldData(), "object_names")) - 1
assert "brick" in names and np.all(area(scene) > 0)
low, high = points(scene).min(axis=0), points(scene).max(axis=0)
assert np.allclose(low[:2], -high[:2]), (low, high)  # the built-in city stands about its origin

# Every triangle of a surface must lie in one plane.
surface = array(scene.GetCellData(), "surface")
corner = points(scene)[vtk_to_numpy(scene.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
for s in range(surface.max() + 1):
    part = corner[surface == s].reshape(-1, 3)
    assert np.linalg.svd(part - part.mean(axis=0), compute_uv=False)[2] < 1e-3, s

# Vegetation: closed volumes, here a spheroid, a box and a cylinder.
green = read("vegetation.vtp")
names = texts(green.GetFieldData(), "material_names")
of, number = array(green.GetCellData(), "material"), array(green.GetCellData(), "volume")
corner = points(green)[vtk_to_numpy(green.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
volume_m3 = np.einsum("ij,ij->i", corner[:, 0] - [0, 10, 0], np.cross(corner[:, 1] - [0, 10, 0], corner[:, 2] - [0, 10, 0])) / 6
assert [names[of[number == k][0]] for k in range(3)] == ["vegetation", "hedge", "hedge"], names
for k, wanted in enumerate([np.pi / 6 * 4 * 5 * 6, 8 * 1 * 2, np.pi * 4]):
    assert 0.92 * wanted < volume_m3[number == k].sum() <= wanted * (1 + 1e-9), (k, volume_m3[number == k].sum(), wanted)

edges = read("edges.vtp")
length = np.linalg.norm(np.diff(points(edges).reshape(-1, 2, 3), axis=1), axis=2)
assert edges.GetNumberOfLines() == len(length) > 10 and np.all(length > 0)
assert np.all(np.abs(array(edges.GetCellData(), "exterior_rad") - np.pi) > 1e-9)  # no wave diffracts at what is flat
assert array(edges.GetCellData(), "surfaces").shape == (len(length), 2)

collection = ET.parse(os.path.join(base, "run.pvd")).getroot()
assert collection.tag == "VTKFile" and collection.get("type") == "Collection"
steps = {}
for row in collection.iter("DataSet"):
    assert os.path.exists(os.path.join(base, row.get("file")))
    steps.setdefault(float(row.get("timestep")), []).append(row.get("file"))
named = {file for files in steps.values() for file in files} | {"run.pvd"}
assert named == set(os.listdir(base)), named ^ set(os.listdir(base))

with h5py.File(os.path.join(sys.argv[1], "run/paths.h5"), "r") as file:
    number, time_s = file["frames/frame"][...], file["frames/time_s"][...]
    assert sorted(steps) == list(time_s)
    columns = {name: file["paths"][name][...] for name in ("gain_db", "delay_s", "doppler_hz", "depth", "tx", "rx")}
    interaction, position = file["vertices/interaction"][...], file["vertices/position_m"][...]
    offset, first = file["paths/vertex_offset"][...].astype(int), file["frames/path_offset"][...].astype(int)
    for row, frame in enumerate(number):
        assert steps[time_s[row]] == ["scene.vtp", "vegetation.vtp", "edges.vtp"] + [f"{kind}_{frame:05}.vtp"
                                                                   for kind in ("vehicles", "ends", "paths", "rays")]
        paths = read(f"paths_{frame:05}.vtp")
        assert array(paths.GetFieldData(), "TimeValue")[0] == time_s[row]
        assert texts(paths.GetFieldData(), "tx_names") == list(file["transmitters/name"].asstr())
        kinds = texts(paths.GetFieldData(), "kind_names")
        mine = slice(first[row], first[row + 1])
        assert paths.GetNumberOfLines() == first[row + 1] - first[row] == paths.GetNumberOfCells()
        for name, column in columns.items():
            assert np.array_equal(array(paths.GetCellData(), name), column[mine]), name
        ends = vtk_to_numpy(paths.GetLines().GetOffsetsArray())
        got, met = points(paths), array(paths.GetPointData(), "interaction")
        kind = array(paths.GetCellData(), "kind")
        for i in range(first[row], first[row + 1]):
            part = slice(ends[i - first[row]], ends[i - first[row] + 1])
            inside = slice(offset[i], offset[i + 1])
            expected = np.vstack([file["frames/transmitter_position_m"][row, columns["tx"][i]], position[inside],
                                  file["frames/receiver_position_m"][row, columns["rx"][i]]])
            assert np.array_equal(got[part], expected)
            assert list(met[part]) == [0, *interaction[inside], 0]
            word = kinds[kind[i - first[row]]]
            assert word == ("diffracted" if 8 in interaction[inside] else "reflected" if len(expected) > 2
                            else "line_of_sight"), word

        poses = np.nonzero(file["poses/frame"][...] == frame)[0]
        vehicles = read(f"vehicles_{frame:05}.vtp")
        which = array(vehicles.GetCellData(), "vehicle")
        assert set(which) == set(file["poses/instance"][poses])
        assert texts(vehicles.GetFieldData(), "vehicle_names") == list(file["instances/id"].asstr())
        assert texts(vehicles.GetFieldData(), "material_names")[0] == "metal"
        corner = points(vehicles)[vtk_to_numpy(vehicles.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
        for pose in poses:  # bodies are symmetric about their pose, stand above the ground and are longer than wide
            body = corner[which == file["poses/instance"][pose]].reshape(-1, 3)
            low, high = body.min(axis=0), body.max(axis=0)
            assert np.allclose((low + high)[:2] / 2, file["poses/position_m"][pose][:2], atol=1e-6)
            ahead = file["poses/rotation"][pose] @ [1, 0, 0]
            assert abs((high - low)[:2] @ ahead[:2]) > 3.5 and low[2] > 0 and high[2] < 5

        radio = read(f"ends_{frame:05}.vtp")
        for kind, flag in (("transmitter", 0), ("receiver", 1)):
            where = file[f"frames/{kind}_position_m"][row]
            there = np.isfinite(where[:, 0])
            rows = array(radio.GetPointData(), "is_receiver") == flag
            assert np.array_equal(points(radio)[rows], where[there])
            names = file[f"{kind}s/name"].asstr()[...][there]
            assert list(np.array(texts(radio.GetPointData(), "name"))[rows]) == list(names)

# Rays have every waypoint except receivers that rays pass, and a line from each launch to the point before the next.
none = 2**32 - 1
with h5py.File(os.path.join(sys.argv[1], "run/waypoints.h5"), "r") as file:
    column = {name: file["waypoints"][name][...] for name in file["waypoints"]}
    for frame in number:
        rows = np.nonzero((column["frame"] == frame) & (column["kind"] != 3))[0]
        rays = read(f"rays_{frame:05}.vtp")
        assert np.array_equal(points(rays), column["position_m"][rows]) and len(rows) == 5
        for name in ("depth", "kind", "source"):
            assert np.array_equal(array(rays.GetPointData(), name), column[name][rows]), name
        for name, of in (("surface", "surface"), ("vehicle", "instance")):
            expected = [-1 if value == none else value for value in column[of][rows]]
            assert list(array(rays.GetPointData(), name)) == expected, name
        launches = rows[column["kind"][rows] == 0]
        assert list(array(rays.GetCellData(), "tx")) == list(column["tx"][launches])
        assert list(array(rays.GetCellData(), "sample")) == list(column["sample"][launches])
        assert list(vtk_to_numpy(rays.GetLines().GetOffsetsArray())) == [0, 3, 5]
print(f"vtk: {len(number)} frames as in paths.h5")
