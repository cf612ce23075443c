#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes car.glb with trimesh (PyPI: trimesh 5.2.0), for vehicle_bodies_test.cpp: a body of four materials with the
nodes of two antennas.

usage: make_car.py FILE

glTF has y up: a point that is x ahead, y to the left and z up is (x, z, -y) there.
"""
import sys

import numpy as np
import trimesh
from trimesh.visual.material import PBRMaterial


def box(lower, upper, material):
    """Returns a box of these sizes in metres: ahead, left and up."""
    lower, upper = np.array(lower), np.array(upper)
    mesh = trimesh.creation.box(extents=(upper - lower)[[0, 2, 1]])
    middle = (lower + upper) / 2
    mesh.apply_translation([middle[0], middle[2], -middle[1]])
    mesh.visual = trimesh.visual.TextureVisuals(material=PBRMaterial(name=material))
    return mesh


def place(x, y, z):
    out = np.eye(4)
    out[:3, 3] = (x, z, -y)
    return out


if len(sys.argv) != 2:
    sys.exit(__doc__)
car = trimesh.Scene()
car.add_geometry(box((-2.1, -0.9, 0.3), (2.1, 0.9, 0.9), "CarPaint"), node_name="body")
car.add_geometry(box((-1.2, -0.8, 0.95), (0.8, 0.8, 1.5), "vehicle_glass"), node_name="cabin")
car.add_geometry(box((2.15, -0.85, 0.3), (2.3, 0.85, 0.6), "plastic"), node_name="bumper")
for number, (x, y) in enumerate([(1.4, 0.75), (1.4, -0.75), (-1.4, 0.75), (-1.4, -0.75)]):
    car.add_geometry(box((x - 0.3, y - 0.1, 0.02), (x + 0.3, y + 0.1, 0.28), "Tyre"), node_name=f"tyre{number}")
# A node below another: its place is that of both.
car.graph.update(frame_from="world", frame_to="roof", matrix=place(-0.5, 0, 1.5))
car.graph.update(frame_from="roof", frame_to="roof_antenna", matrix=place(-0.25, 0.125, 0.0625))
car.graph.update(frame_from="world", frame_to="mirror", matrix=place(0.75, 1, 1))
with open(sys.argv[1], "wb") as out:
    out.write(trimesh.exchange.gltf.export_glb(car))
