# SPDX-License-Identifier: Apache-2.0
"""Loads a .glb with trimesh, as users do, and compares areas and extents with the scene that VTK's export holds.
Run as glb_trimesh.py FOLDER, which holds one.glb, drive.glb and vtk/; answers 77, "skipped", without trimesh."""
import os
import sys

try:
    import numpy as np
    import trimesh
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)


def triangles(name):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(os.path.join(sys.argv[1], "vtk", name))
    reader.Update()
    data = reader.GetOutput()
    names = data.GetFieldData().GetAbstractArray("material_names")
    corners = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    corner = vtk_to_numpy(data.GetPoints().GetData())[corners]
    return corner, np.array([names.GetValue(int(m)) for m in vtk_to_numpy(data.GetCellData().GetArray("material"))])


def area(corner):
    return np.linalg.norm(np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]), axis=1).sum() / 2


parts = [triangles(name) for name in ("scene.vtp", "vegetation.vtp", "vehicles_00004.vtp")]
expected, material = np.concatenate([p[0] for p in parts]), np.concatenate([p[1] for p in parts])
scene = trimesh.load(os.path.join(sys.argv[1], "one.glb"), process=False)
found = {}
lines = 0
for node in scene.graph.nodes_geometry:
    matrix, name = scene.graph[node]
    geometry = scene.geometry[name]
    if isinstance(geometry, trimesh.path.Path3D):
        lines += 1
        continue
    world = trimesh.transform_points(geometry.vertices, matrix)[geometry.faces]
    found.setdefault(geometry.visual.material.name, []).append(world[..., [0, 2, 1]] * [1, -1, 1])  # y up to z up
assert lines == 1 + 1 + 1 + 3, lines  # paths, rays, a transmitter, two receivers and the car's
assert set(found) == set(material), (set(found), set(material))
for name, corner in found.items():
    corner = np.concatenate(corner)
    wanted = expected[material == name]
    assert len(corner) == len(wanted), name
    assert abs(area(corner) / area(wanted) - 1) < 1e-5
    assert np.allclose(corner.min(axis=(0, 1)), wanted.min(axis=(0, 1)), atol=1e-4)
    assert np.allclose(corner.max(axis=(0, 1)), wanted.max(axis=(0, 1)), atol=1e-4)
trimesh.load(os.path.join(sys.argv[1], "drive.glb"))
print(f"trimesh: {len(expected)} triangles of {len(found)} materials as in the scene")
