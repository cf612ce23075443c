# SPDX-License-Identifier: Apache-2.0
"""Reads the background of draw_paths.py: the triangles of a scene, and its edges that diffract.
Scenes are Mitsuba XML with PLY meshes of triangles, ascii or binary little endian, and z up."""
import math
import os
import sys
import xml.etree.ElementTree as ET

import numpy as np

PLY_TYPES = {"char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1", "short": "i2", "int16": "i2", "ushort": "u2",
             "uint16": "u2", "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4", "float": "f4", "float32": "f4",
             "double": "f8", "float64": "f8"}


def read_ply(path):
    """Vertices (n, 3) and triangles (m, 3) of a PLY mesh of triangles."""
    data = open(path, "rb").read()
    end = data.find(b"end_header")
    if not data.startswith(b"ply") or end < 0:
        sys.exit(f"{path}: not a PLY file")
    body = data.index(b"\n", end) + 1
    elements, form = [], None
    for words in (line.split() for line in data[:end].decode("latin-1").splitlines()):
        if words[:1] == ["format"]:
            form = words[1]
        elif words[:1] == ["element"]:
            elements.append((words[1], int(words[2]), []))
        elif words[:1] == ["property"]:
            elements[-1][2].append(words[1:])
    tables = {}
    if form == "ascii":
        lines = data[body:].decode("latin-1").split("\n")
        for name, count, properties in elements:
            rows, lines = lines[:count], lines[count:]
            table = np.array([row.split() for row in rows], dtype=float)
            tables[name] = table[:, 1:4].astype(int) if properties[0][0] == "list" else table[:, :3]
    elif form == "binary_little_endian":
        for name, count, properties in elements:
            fields = []
            for i, words in enumerate(properties):
                if words[0] == "list":  # treated as triangles, which is checked below
                    fields += [(f"n{i}", "<" + PLY_TYPES[words[1]]), ("corners", "<" + PLY_TYPES[words[2]], 3)]
                else:
                    fields.append((words[1], "<" + PLY_TYPES[words[0]]))
            table = np.frombuffer(data, np.dtype(fields), count, body)
            body += table.nbytes
            if "corners" in table.dtype.names:
                if not np.all(table[table.dtype.names[0]] == 3):
                    sys.exit(f"{path}: a face is not a triangle; triangulate the mesh")
                tables[name] = table["corners"].astype(int)
            else:
                tables[name] = np.stack([table[axis].astype(float) for axis in "xyz"], axis=1)
    else:
        sys.exit(f"{path}: PLY format {form} is not read here; save it as ascii or binary_little_endian")
    return tables["vertex"], tables["face"]


def to_world(shape, path):
    """The 4 x 4 matrix of a shape's <transform name="to_world">, its steps applied in order."""
    matrix = np.eye(4)
    for step in shape.findall("transform[@name='to_world']/*"):
        triple = [float(v) for v in step.get("value", "").replace(",", " ").split()]
        x, y, z = triple if len(triple) == 3 else (
            triple * 3 if triple else (float(step.get(axis, 1 if step.tag == "scale" else 0)) for axis in "xyz"))
        m = np.eye(4)
        if step.tag == "translate":
            m[:3, 3] = x, y, z
        elif step.tag == "scale":
            m[:3, :3] = np.diag([x, y, z])
        elif step.tag == "rotate":  # Rodrigues' formula
            axis, angle = np.array([x, y, z]) / math.hypot(x, y, z), math.radians(float(step.get("angle")))
            cross = np.cross(np.eye(3), axis).T
            m[:3, :3] += math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross
        elif step.tag == "matrix":
            m = np.array([float(v) for v in step.get("value").split()]).reshape(4, 4)
        else:
            sys.exit(f"{path}: the transform <{step.tag}> is not read here")
        matrix = m @ matrix
    return matrix


def read_scene(path):
    """The corners (3, 3) of all triangles of a Mitsuba scene, as one array (n, 3, 3)."""
    meshes = []
    for shape in ET.parse(path).getroot().iter("shape"):
        if shape.get("type") != "ply":
            sys.exit(f"{path}: a shape of type {shape.get('type')} is not read here, only ply")
        name = shape.find("string[@name='filename']").get("value")
        vertices, faces = read_ply(os.path.join(os.path.dirname(path), name))
        matrix = to_world(shape, path)
        meshes.append((vertices @ matrix[:3, :3].T + matrix[:3, 3])[faces])
    return np.concatenate(meshes) if meshes else np.zeros((0, 3, 3))


def read_edges(path):
    """The ends (n, 2, 3) of the edges that `wavetracer scene info --edges SCENE` lists; path: its output."""
    rows = [line.split() for line in open(path, encoding="utf-8")]
    try:
        return np.array([row[1:7] for row in rows if row and row[0].isdigit()], dtype=float).reshape(-1, 2, 3)
    except ValueError:
        sys.exit(f"{path}: not a list of edges as `wavetracer scene info --edges SCENE` prints it")
