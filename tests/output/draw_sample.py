# SPDX-License-Identifier: Apache-2.0
"""Draws the street canyon of tests/reference with the paths of its reference lists, and counts what was drawn.
Run as draw_sample.py SOURCE_FOLDER OUTPUT_FOLDER; answers 77, "skipped", where numpy or h5py are not installed."""
import json
import os
import subprocess
import sys
import xml.etree.ElementTree as ET

try:
    import h5py
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing} (Debian: python3-h5py)")
    sys.exit(77)


def write_paths_h5(case, path):
    """A paths.h5 with what draw_paths.py reads, from a reference list."""
    with h5py.File(path, "w") as file:
        file.attrs["frequency_hz"] = [case["frequency_hz"]]
        for group, key, letter in (("transmitters", "tx_m", "t"), ("receivers", "rx_m", "r")):
            file[f"{group}/name"] = [f"{letter}x{i}" for i in range(len(case[key]))]
            file[f"{group}/position_m"] = np.array(case[key])
            file[f"frames/{group[:-1]}_position_m"] = np.array(case[key])[None]
        file["frames/frame"] = np.zeros(1, np.uint32)
        paths = case["paths"]
        file["paths/frame"] = np.zeros(len(paths), np.uint32)
        file["paths/tx"] = np.array([p["tx"] for p in paths], np.uint32)
        file["paths/rx"] = np.array([p["rx"] for p in paths], np.uint32)
        power = [np.sum(np.square(p["a_re"]) + np.square(p["a_im"])) for p in paths]
        file["paths/gain_db"] = 10 * np.log10(power)
        file["paths/vertex_offset"] = np.concatenate([[0], np.cumsum([len(p["interactions"]) for p in paths])])
        file["vertices/position_m"] = np.vstack([np.reshape(p["vertices_m"], (-1, 3)) for p in paths])
        file["vertices/interaction"] = np.concatenate([p["interactions"] for p in paths]).astype(np.uint8)


def draw(case, *options):
    """The picture of a case, and what the program said."""
    scene = os.path.join(reference, "scenes", case["scene"], case["scene"] + ".xml")
    paths, picture = (os.path.join(output, case["case"] + suffix) for suffix in (".h5", ".svg"))
    write_paths_h5(case, paths)
    done = subprocess.run([sys.executable, os.path.join(source, "docs", "draw_paths.py"), scene, paths, "-o", picture,
                           *options], capture_output=True, text=True)
    return (ET.parse(picture).getroot() if done.returncode == 0 else None), done.stderr


def marks(svg, kind):
    """Counts a mark or an edge in the picture, without the legend."""
    return sum(path.get("d").count("M") for path in svg.findall(f"{name}path[@class='{kind}']"))


source, output = sys.argv[1:3]
reference = os.path.join(source, "tests", "reference")
name = "{http://www.w3.org/2000/svg}"
case = json.load(open(os.path.join(reference, "oracle", "street_canyon_cars_specular.json")))
attribution = "street & canyon"
svg, said = draw(case, "--attribution", attribution)
assert svg is not None, said
width, height = float(svg.get("width")), float(svg.get("height"))
lines = svg.findall(f"{name}polyline")
assert len(lines) == len(case["paths"]), (len(lines), len(case["paths"]))
for line, path in zip(lines, sorted(case["paths"], key=lambda p: np.sum(np.square(p["a_re"]) + np.square(p["a_im"])))):
    points = [tuple(map(float, p.split(","))) for p in line.get("points").split()]
    assert len(points) == len(path["interactions"]) + 2
    assert all(0 <= x <= width and 0 <= y <= height for x, y in points), "a path leaves the picture"
labels = [text.text for text in svg.findall(f"{name}text")]
assert attribution in labels and "path gain, dB" in labels and any(label.endswith(" m") for label in labels)
assert all(f"rx{i}" in labels for i in range(len(case["rx_m"])))
assert not svg.findall(f"{name}g[@class='legend']"), "reflections need no legend"
assert all(marks(svg, kind) == 0 for kind in ("diffraction", "transmission", "scattering", "edges"))

# All interactions, one of them made a tile; and two edges, of which one lies outside of the picture.
case = json.load(open(os.path.join(reference, "oracle", "street_canyon_cars_all.json")))
next(p for p in case["paths"] if p["interactions"] == [1])["interactions"] = [2]
edges = os.path.join(output, "edges.txt")
with open(edges, "w", encoding="utf-8") as file:
    file.write("   edge   start x, m            y         z\n"
               "      0  -10.0 0.0 0.0  10.0 0.0 0.0  20.0  90.00  0 brick, 1 brick\n"
               "      1  9000.0 0.0 0.0  9000.0 5.0 0.0  5.0  0.00  0 brick\n")
svg, said = draw(case, "--edges", edges, "--window", "-100", "-80", "100", "80")
assert svg is not None, said
assert len(svg.findall(f"{name}polyline")) == len(case["paths"])
for kind, bit in (("diffraction", 8), ("transmission", 4), ("scattering", 2)):
    listed = sum(p["interactions"].count(bit) for p in case["paths"])
    assert 0 < marks(svg, kind) <= listed, (kind, marks(svg, kind), listed)  # those of one place are one
assert marks(svg, "scattering") == 1 and marks(svg, "edges") == 1
legend = [text.text for text in svg.findall(f"{name}g[@class='legend']/{name}text")]
assert legend == ["diffraction", "transmission", "scattering", "edge that diffracts"], legend
with open(edges, "w", encoding="utf-8") as file:
    file.write("0 no number here\n")
svg, said = draw(case, "--edges", edges)
assert svg is None and "scene info --edges" in said, said
print(f"{len(lines)} and {len(case['paths'])} paths drawn")
