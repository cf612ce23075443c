# SPDX-License-Identifier: Apache-2.0
"""A small town in CityGML 2.0, held to the official schemas and turned into CityJSON 1.1 by CitySmith and into 2.0 by
cjio, reprojected by cjio, imported by `wavetracer convert`: every scene must be the same town, its meshes closed
(trimesh), its volumes those of closed forms, its place that of pyproj.

Usage: city_models_check.py WAVETRACER OUTPUT_FOLDER. Exit code 77: a package is missing.
"""

import json
import pathlib
import subprocess
import sys

try:
    import cjio  # noqa: F401
    import citysmith  # noqa: F401
    import numpy as np
    import pyproj
    import trimesh
except ImportError as problem:
    print("skipped:", problem)
    sys.exit(77)

WAVETRACER = sys.argv[1]
FOLDER = pathlib.Path(sys.argv[2])
EAST, NORTH, BASE = 691400.0, 5334700.0, 512.25  # Munich, EPSG:25832, a height above the sea
FOUNDATION = 1.0

# --- the town, in metres about its corner: names of surfaces with their rings ---


def box(x0, y0, z0, x1, y1, z1):
    a, b, c, d = (x0, y0), (x1, y0), (x1, y1), (x0, y1)
    low, high = [p + (z0,) for p in (a, b, c, d)], [p + (z1,) for p in (a, b, c, d)]
    out = [("Ground", [low[::-1]]), ("Roof", [high])]
    return out + [("Wall", [[low[i], low[(i + 1) % 4], high[(i + 1) % 4], high[i]]]) for i in range(4)]


def gable(x0, y0, x1, y1, eaves, ridge):
    """A house with its ridge along x: volume (eaves + (ridge - eaves) / 2) * area."""
    m = (y0 + y1) / 2
    return [
        ("Ground", [[(x0, y0, 0), (x0, y1, 0), (x1, y1, 0), (x1, y0, 0)]]),
        ("Wall", [[(x0, y0, 0), (x1, y0, 0), (x1, y0, eaves), (x0, y0, eaves)]]),
        ("Wall", [[(x1, y1, 0), (x0, y1, 0), (x0, y1, eaves), (x1, y1, eaves)]]),
        ("Wall", [[(x0, y1, 0), (x0, y0, 0), (x0, y0, eaves), (x0, m, ridge), (x0, y1, eaves)]]),
        ("Wall", [[(x1, y0, 0), (x1, y1, 0), (x1, y1, eaves), (x1, m, ridge), (x1, y0, eaves)]]),
        ("Roof", [[(x0, y0, eaves), (x1, y0, eaves), (x1, m, ridge), (x0, m, ridge)]]),
        ("Roof", [[(x1, y1, eaves), (x0, y1, eaves), (x0, m, ridge), (x1, m, ridge)]]),
    ]


def court(x0, y0, x1, y1, margin, height):
    """A block round a courtyard: floor and roof have holes."""
    outer = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
    inner = [(x0 + margin, y0 + margin), (x0 + margin, y1 - margin), (x1 - margin, y1 - margin), (x1 - margin, y0 + margin)]
    at = lambda ring, z: [p + (z,) for p in ring]  # noqa: E731
    out = [("Roof", [at(outer, height), at(inner, height)]), ("Ground", [at(outer, 0)[::-1], at(inner, 0)[::-1]])]
    for ring in (outer, inner):
        for i in range(4):
            p, q = ring[i], ring[(i + 1) % 4]
            out.append(("Wall", [[p + (0,), q + (0,), q + (height,), p + (height,)]]))
    return out


def shifted(surfaces, dz):
    return [(kind, [[(x, y, z + dz) for x, y, z in ring] for ring in rings]) for kind, rings in surfaces]


HOUSE, COURT, TOWER, HALL = gable(0, 0, 12, 8, 6, 10), court(30, 0, 60, 30, 8, 15), box(80, 0, 0, 90, 10, 40), box(90, 0, 0, 120, 10, 8)
VOLUMES = {"house": 12 * 8 * (6 + 2), "court": (900 - 14 * 14) * 15, "tower": 100 * 40, "hall": 300 * 8}
FLOORS = {"house": 96, "court": 900 - 14 * 14, "tower": 100, "hall": 300}
BASES = {"house": 0, "court": 1.5, "tower": -0.5, "hall": -0.5}

# --- CityGML ---


def pos_list(ring):
    points = ring + ring[:1]
    return " ".join(f"{EAST + x:.3f} {NORTH + y:.3f} {BASE + z:.3f}" for x, y, z in points)


def polygon(name, rings):
    parts = [f"<gml:exterior><gml:LinearRing><gml:posList srsDimension=\"3\">{pos_list(rings[0])}</gml:posList></gml:LinearRing></gml:exterior>"]
    for hole in rings[1:]:
        parts.append(f"<gml:interior><gml:LinearRing><gml:posList>{pos_list(hole)}</gml:posList></gml:LinearRing></gml:interior>")
    return f"<gml:Polygon gml:id=\"{name}\">{''.join(parts)}</gml:Polygon>"


def thematic(name, surfaces):
    """boundedBy with all polygons, after a solid that links to them."""
    links = "".join(f"<gml:surfaceMember xlink:href=\"#{name}_{i}\"/>" for i in range(len(surfaces)))
    out = f"<bldg:lod2Solid><gml:Solid><gml:exterior><gml:CompositeSurface>{links}</gml:CompositeSurface></gml:exterior></gml:Solid></bldg:lod2Solid>"
    for i, (kind, rings) in enumerate(surfaces):
        out += (f"<bldg:boundedBy><bldg:{kind}Surface gml:id=\"{name}_s{i}\"><bldg:lod2MultiSurface><gml:MultiSurface><gml:surfaceMember>"
                f"{polygon(f'{name}_{i}', rings)}</gml:surfaceMember></gml:MultiSurface></bldg:lod2MultiSurface>"
                f"</bldg:{kind}Surface></bldg:boundedBy>")
    return out


def block(name, surfaces):
    members = "".join(f"<gml:surfaceMember>{polygon(f'{name}_b{i}', rings)}</gml:surfaceMember>" for i, (_, rings) in enumerate(surfaces))
    return f"<bldg:lod1Solid><gml:Solid><gml:exterior><gml:CompositeSurface>{members}</gml:CompositeSurface></gml:exterior></gml:Solid></bldg:lod1Solid>"


def city_gml():
    house, court_ = shifted(HOUSE, BASES["house"]), shifted(COURT, BASES["court"])
    tower, hall = shifted(TOWER, BASES["tower"]), shifted(HALL, BASES["hall"])
    whole = shifted(box(80, 0, 0, 120, 10, 12), -0.5)
    return f"""<?xml version="1.0" encoding="UTF-8"?>
<core:CityModel xmlns:core="http://www.opengis.net/citygml/2.0" xmlns:bldg="http://www.opengis.net/citygml/building/2.0"
    xmlns:gml="http://www.opengis.net/gml" xmlns:xlink="http://www.w3.org/1999/xlink">
<gml:boundedBy><gml:Envelope srsName="urn:ogc:def:crs:EPSG::25832" srsDimension="3">
<gml:lowerCorner>{EAST} {NORTH} {BASE - 0.5}</gml:lowerCorner><gml:upperCorner>{EAST + 120} {NORTH + 30} {BASE + 40}</gml:upperCorner>
</gml:Envelope></gml:boundedBy>
<core:cityObjectMember><bldg:Building gml:id="house">{block('house', shifted(box(0, 0, 0, 12, 8, 9), 0))}{thematic('house', house)}</bldg:Building></core:cityObjectMember>
<core:cityObjectMember><bldg:Building gml:id="court">{thematic('court', court_)}</bldg:Building></core:cityObjectMember>
<core:cityObjectMember><bldg:Building gml:id="pair">{block('pair', whole)}
<bldg:consistsOfBuildingPart><bldg:BuildingPart gml:id="tower">{thematic('tower', tower)}</bldg:BuildingPart></bldg:consistsOfBuildingPart>
<bldg:consistsOfBuildingPart><bldg:BuildingPart gml:id="hall">{thematic('hall', hall)}</bldg:BuildingPart></bldg:consistsOfBuildingPart>
</bldg:Building></core:cityObjectMember>
</core:CityModel>
"""


# --- the scenes ---


def run(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    assert done.returncode == 0, f"{' '.join(map(str, command))}:\n{done.stdout}{done.stderr}"
    return done.stdout + done.stderr


def city_smith(*words):
    return run(sys.executable, "-m", "citysmith.cli", *words)


def cj(*words):
    return run(sys.executable, "-c", "from cjio.cjio import cli; cli()", "--suppress_msg", *words)


def meshes_of(folder):
    names = {}
    for shape in (folder / "city.xml").read_text().split("<shape ")[1:]:
        name = shape.split('id="mesh-')[1].split('"')[0]
        names[name] = trimesh.load(folder / shape.split('name="filename" value="')[1].split('"')[0])
    return names


def imported(source, *options):
    folder = FOLDER / ("scene_" + source.name.replace(".", "_") + "_".join(options))
    said = run(WAVETRACER, "convert", source, "-o", folder, *options)
    return said, meshes_of(folder), json.loads((folder / "georeference.json").read_text())


def check_meshes(meshes, scale, what):
    found = {name.split(" ")[1]: mesh for name, mesh in meshes.items() if name != "ground"}
    assert set(found) == set(VOLUMES), (what, sorted(found))
    for name, mesh in found.items():
        assert mesh.is_watertight and mesh.is_winding_consistent, (what, name)
        expected = (VOLUMES[name] + FLOORS[name] * FOUNDATION) * scale
        assert abs(mesh.volume - expected) < 0.002 * expected, (what, name, mesh.volume, expected)


def check_place(meshes, reference):
    """The corner of the house, by pyproj."""
    house = next(mesh for name, mesh in meshes.items() if name.endswith("house"))
    corner = np.array(house.vertices)[:, :2]
    to_degrees = pyproj.Transformer.from_crs("EPSG:25832", "EPSG:4326", always_xy=True)
    to_scene = pyproj.Transformer.from_crs("EPSG:4326", reference["projection"], always_xy=True)
    for x, y in ((0, 0), (12, 0), (12, 8), (0, 8)):
        place = np.array(to_scene.transform(*to_degrees.transform(EAST + x, NORTH + y))) + reference["offset_m"]
        assert np.min(np.hypot(*(corner - place).T)) < 0.02, (x, y, place, corner)


def in_degrees(source, latitude_first):
    """Writes the model in degrees of EPSG:4979, whose order is latitude first; there are files of either order. Not
    done with cjio, which rounds away their scale."""
    city = json.loads(source.read_text())
    to_degrees = pyproj.Transformer.from_crs("EPSG:25832", "EPSG:4326", always_xy=True)
    scale, translate = (np.array(city["transform"][key]) for key in ("scale", "translate"))
    for vertex in city["vertices"]:
        x, y, z = translate + scale * vertex
        place = [round(degrees * 1e9) for degrees in to_degrees.transform(x, y)]
        vertex[:] = (place[::-1] if latitude_first else place) + [round(z * 1e3)]
    city["transform"] = {"scale": [1e-9, 1e-9, 1e-3], "translate": [0, 0, 0]}
    city["metadata"] = {"referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/4979"}
    file = source.with_name(f"town_{'lat_lon' if latitude_first else 'lon_lat'}.city.json")
    file.write_text(json.dumps(city))
    return file


def check_terrain(source):
    """On a plane that rises to the east, heights stay those of the file, and feet reach below the lowest ground."""
    rows, cell, rise = 30, 10, 0.05
    raster = FOLDER / "plane.asc"
    line = " ".join(f"{BASE - 4 + rise * (cell * (i + 0.5) - 90):.4f}" for i in range(rows))
    raster.write_text(f"ncols {rows}\nnrows {rows}\nxllcorner {EAST - 90}\nyllcorner {NORTH - 90}\ncellsize {cell}\n" + f"{line}\n" * rows)
    raster.with_suffix(".prj").write_text(pyproj.CRS("EPSG:25832").to_wkt("WKT1_ESRI"))
    done = subprocess.run([WAVETRACER, "convert", source, "--terrain", raster, "-o", FOLDER / "hill"], capture_output=True, text=True)
    if "read by GDAL" in done.stderr:
        return print("without terrain:", done.stderr)
    assert done.returncode == 0, done.stderr
    meshes = meshes_of(FOLDER / "hill")
    for name, mesh in meshes.items():
        if name == "ground":
            continue
        key = name.split(" ")[1]
        west = {"house": 0, "court": 30, "tower": 80, "hall": 80}[key]  # tower and hall stand together
        foot = min(BASE + BASES[key], BASE - 4 + rise * west) - FOUNDATION
        assert abs(mesh.bounds[0][2] - foot) < 0.02, (name, mesh.bounds, foot)
        top = BASE + BASES[key] + {"house": 10, "court": 15, "tower": 40, "hall": 8}[key]
        assert abs(mesh.bounds[1][2] - top) < 0.002, (name, mesh.bounds, top)
        assert mesh.is_watertight, name
    assert "and stay there, +" in done.stdout, done.stdout
    return None


def main():
    FOLDER.mkdir(parents=True, exist_ok=True)
    gml, first, second = FOLDER / "town.gml", FOLDER / "town11.city.json", FOLDER / "town20.city.json"
    gml.write_text(city_gml())
    city_smith("validate", "--schema-only", gml)
    city_smith("convert", gml, "-o", first)
    assert json.loads(first.read_text())["version"] == "1.1"
    cj(first, "upgrade", "save", second)
    assert json.loads(second.read_text())["version"] == "2.0"
    files = [gml, first, second]
    for code in (25833, 3035):  # another zone; north before east
        files.append(FOLDER / f"town_{code}.city.json")
        cj(second, "crs_reproject", code, "save", files[-1])
    files += [in_degrees(second, True), in_degrees(second, False)]
    scale = 1.0  # factor of areas: the scene's projection is true to scale in its middle, UTM's is not
    x = pyproj.Proj("EPSG:25832").get_factors(*pyproj.Proj("EPSG:25832")(EAST, NORTH, inverse=True))
    scale /= x.areal_scale
    for file in files:
        said, meshes, reference = imported(file)
        print(file.name, said)
        check_meshes(meshes, scale, file.name)
        check_place(meshes, reference)
    for file in (gml, first, second):
        said, meshes, _ = imported(file, "--lod", "1")
        names = sorted(name.split(" ")[1] for name in meshes if name != "ground")
        assert names == ["house", "pair"], (file.name, names, said)
    check_terrain(gml)
    print(f"{len(files)} files are one town")


main()
