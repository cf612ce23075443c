# SPDX-License-Identifier: Apache-2.0
"""Runs `wavetracer coverage --format kml`, parses the documents by XML's rules, and compares their corners with the place of
the map by GDAL's gdaltransform, and with the degrees of the cells in coverage.csv.

    read_kml.py PROGRAM FOLDER

Needs numpy, h5py, GDAL's programs and an OpenCL device; answers 77 where one is missing.
"""
import json
import xml.etree.ElementTree as ET

import numpy as np
from map_reading import FREE_SPACE, column, free_run, main, run, same, table

KML, GX = "{http://www.opengis.net/kml/2.2}", "{http://www.google.com/kml/ext/2.2}"
UTM = "+proj=utm +zone=32 +ellps=WGS84 +datum=WGS84 +units=m +no_defs"
OFFSET_M = (-690000, -5330000)


def corners_of(overlay):
    text = overlay.find(f"{GX}LatLonQuad/{KML}coordinates").text
    return np.array([place.split(",") for place in text.split()], dtype=float)


def read(folder, name="coverage.kml", ending=""):
    """The corners of the document's overlays, which are all the same, once everything else of it is checked."""
    root = ET.parse(folder / name).getroot()
    assert root.tag == f"{KML}kml" and [child.tag for child in root] == [f"{KML}Document"], root
    overlays = root.findall(f"{KML}Document/{KML}GroundOverlay")
    layers = json.loads((folder / "coverage.json").read_text())["layers"]
    assert [overlay.find(f"{KML}name").text for overlay in overlays] == list(layers)
    for overlay, (layer, about) in zip(overlays, layers.items()):
        # This is the order of the schema of KML, AbstractFeature first.
        assert [child.tag for child in overlay] == [f"{KML}name", f"{KML}visibility", f"{KML}description", f"{KML}Icon",
                                                    f"{KML}altitudeMode", f"{GX}LatLonQuad"], layer
        assert overlay.find(f"{KML}altitudeMode").text == "clampToGround"
        assert overlay.find(f"{KML}visibility").text == ("1" if layer == next(iter(layers)) else "0")
        picture = folder / overlay.find(f"{KML}Icon/{KML}href").text
        assert picture.name == f"{layer}{ending}.png" and picture.read_bytes()[:4] == b"\x89PNG"
        words = overlay.find(f"{KML}description").text
        assert about["about"] in words, words
        if "dark_to_bright" in about:
            unit = f" {about['unit']}" if about["unit"] else ""
            for value, shade in zip(about["dark_to_bright"], ("dark", "bright")):
                assert f"{value:g}{unit} is {shade}" in words, words
        else:
            assert about["colours"][0] in words, words
    corners = corners_of(overlays[0])
    for overlay in overlays[1:]:
        same(corners_of(overlay), corners, 0)
    return corners


def check_places(corners, rows):
    """The map spans 0 to 120 m and 0 to 60 m of the scene. Corners are half a cell beyond its outer cells, to the
    nanodegrees that the grid's curvature takes."""
    asked = "".join(f"{x - OFFSET_M[0]} {y - OFFSET_M[1]}\n" for x, y in ((0, 0), (120, 0), (120, 60), (0, 60)))
    said = run("gdaltransform", "-s_srs", UTM, "-t_srs", "+proj=longlat +datum=WGS84 +no_defs", text=asked).stdout
    same(corners, np.array([line.split()[:2] for line in said.splitlines()], dtype=float), 2e-9)
    degrees = np.stack([column(rows, "lon_deg"), column(rows, "lat_deg")], axis=-1).reshape(15, 30, 2)
    for corner, (iy, ix, sy, sx) in zip(corners, ((0, 0, 1, 1), (0, -1, 1, -1), (-1, -1, -1, -1), (-1, 0, -1, 1))):
        cell, beside, above = (degrees[place] for place in ((iy, ix), (iy, ix + sx), (iy + sy, ix)))
        same(corner, cell + (cell - beside) / 2 + (cell - above) / 2, 1e-9)


def documents(program, folder):
    place = free_run(program, folder, FREE_SPACE)
    refused = run(program, "coverage", place / "out", "--format", "csv,kml", code=3).stderr
    assert f"put a georeference.json beside {place / 'plane.obj'}, or choose geotiff or png" in refused, refused
    assert not (place / "out/coverage").exists()
    (place / "georeference.json").write_text(
        json.dumps({"projection": UTM, "offset_m": OFFSET_M, "attribution": "(c) <A & B>"}))
    done = run(program, "coverage", place / "out", "--format", "csv,kml")
    maps = place / "out/coverage"
    assert set(done.stdout.split()) == {str(file) for file in maps.iterdir()} and not list(maps.glob("*.pgw"))
    assert len(list(maps.glob("*.png"))) == 14
    check_places(read(maps), table(maps / "coverage.csv"))
    words = ET.parse(maps / "coverage.kml").getroot().find(f"{KML}Document/{KML}description").text
    assert words == "(c) <A & B>", words
    run(program, "coverage", place / "out", "--format", "kml", "--frames", "all", "-o", place / "frames", "--layers",
        "best_server,path_gain_db")
    same(read(place / "frames", "coverage_0.kml", "_0"), read(maps), 0)
    generated = place / "generated.toml"
    generated.write_text(FREE_SPACE.replace('scene.file = "{scene}"', 'scene.generate = "--seed 1 --blocks 1x1"')
                         .replace("step_m = 4", "step_m = 30"))
    run(program, "run", "-c", generated, "-o", place / "generated")
    refused = run(program, "coverage", place / "generated", "--format", "kml", code=3).stderr
    assert "a generated scene has no place" in refused, refused


main(documents, "gdaltransform")
