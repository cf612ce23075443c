"""Draws the street canyon of tests/reference with the paths of its reference list, and counts what was drawn.
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
        paths = case["paths"]
        file["paths/frame"] = np.zeros(len(paths), np.uint32)
        file["paths/tx"] = np.array([p["tx"] for p in paths], np.uint32)
        file["paths/rx"] = np.array([p["rx"] for p in paths], np.uint32)
        power = [np.sum(np.square(p["a_re"]) + np.square(p["a_im"])) for p in paths]
        file["paths/gain_db"] = 10 * np.log10(power)
        file["paths/vertex_offset"] = np.concatenate([[0], np.cumsum([len(p["interactions"]) for p in paths])])
        file["vertices/position_m"] = np.vstack([np.reshape(p["vertices_m"], (-1, 3)) for p in paths])
        file["vertices/interaction"] = np.concatenate([p["interactions"] for p in paths]).astype(np.uint8)


source, output = sys.argv[1:3]
reference = os.path.join(source, "tests", "reference")
case = json.load(open(os.path.join(reference, "oracle", "street_canyon_cars_specular.json")))
scene = os.path.join(reference, "scenes", case["scene"], case["scene"] + ".xml")
paths, picture = os.path.join(output, "canyon.h5"), os.path.join(output, "canyon.svg")
write_paths_h5(case, paths)
attribution = "street & canyon"
subprocess.run([sys.executable, os.path.join(source, "docs", "draw_paths.py"), scene, paths, "-o", picture,
                "--attribution", attribution], check=True)

svg = ET.parse(picture).getroot()
name = "{http://www.w3.org/2000/svg}"
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
print(f"{len(lines)} paths drawn")
