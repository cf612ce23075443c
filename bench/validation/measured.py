# SPDX-License-Identifier: Apache-2.0
"""Measured levels of two public sets beside the levels of the program, as configured and with fitted materials, and beside
Sionna RT. The data are in a folder that the command line names; the results have statistics of them alone."""
import pathlib
import tempfile
import time
from dataclasses import asdict

import numpy as np
import wavetracer as wt
from wavetracer.measurements import agreement

import links
import measured_sets

BOULDER_TRACE = {"trace.rays": 100_000, "trace.max_depth": 4, "trace.diffraction_rays": 2_000}
HALLWAY_TRACE = {"trace.rays": 30_000, "trace.max_depth": 4, "trace.diffraction_rays": 1_000}
FOLDS = 2
# Partitions of the hallway: TOML that follows the configuration, and the parameters that are fitted. The scene file has
# slabs of 0.1 m, a guess, so their thickness is fitted, too.
BOARDS = """
[scene.material_alias]
"mat-itu_plasterboard" = "partition"

[[material]]
name = "partition"
layers = [{ material = "plasterboard", thickness_m = 0.0125 }, { material = "vacuum", thickness_m = 0.075 }, { material = "plasterboard", thickness_m = 0.0125 }]
"""
PARTITIONS = {"slabs": ("", "*,*.thickness"), "two boards": (BOARDS, "*")}
FOUND = ("before", "fitted", "held_out")  # columns of calibration.csv


def agrees(measured_db, computed_db):
    """Points, points with a path, and the offset, sigma (dB) and rank correlation of measured minus computed levels."""
    return asdict(agreement(measured_db, computed_db))


def write_levels(file, position_m, level_db):
    """A table of measured values for `wavetracer calibrate`."""
    lines = ["x_m,y_m,z_m,path_gain_db"] + [",".join(map(repr, map(float, row))) for row in np.column_stack([position_m, level_db])]
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")


def calibrated(config, position_m, level_db, trace, fit="*"):
    """`wavetracer calibrate --folds 2` of these levels: ({agreement: of each of FOUND with the measured levels, seconds,
    parameters}, those columns of levels)."""
    with tempfile.TemporaryDirectory() as folder:
        table = pathlib.Path(folder) / "levels.csv"
        write_levels(table, position_m, level_db)
        begin = time.monotonic()
        found = wt.calibrate(config, table, pathlib.Path(folder) / "out", fit=fit, folds=FOLDS, sets=trace)
        seconds = time.monotonic() - begin
    columns = {name: found.points[f"{name}_db"] for name in FOUND}
    parameters = {name: {"before": each.before, "fitted": each.fitted, "unit": each.unit, "told_share": each.told_share}
                  for name, each in found.parameters.items()}
    return {**{name: agrees(level_db, column) for name, column in columns.items()}, "seconds": seconds,
            "parameters": parameters}, columns


# --- Boulder ---

def street_paths(config, position_m):
    """The figures of links.py and the sight of each place, in arrays, from one frame."""
    text = config.read_text(encoding="utf-8") + "".join(
        f'\n[[receiver]]\nname = "p{i:04}"\nposition_m = {list(map(float, at))}\n' for i, at in enumerate(position_m))
    with wt.Simulation(text, folder=config.parent, **BOULDER_TRACE) as simulation:
        paths = simulation.run_frame().paths
    return {**links.figures(paths, 1, len(position_m)), "los": links.line_of_sight(paths, 1, len(position_m))}


def streets(folder, sionna):
    """Rows of classes of places in Boulder, and the points of the figure. sionna: the file of sionna_levels.py."""
    places = measured_sets.boulder(folder, links.WINDOW_DB)
    config = folder / "boulder.toml"
    ours = street_paths(config, places.position_m)
    level = {name: np.full(len(places.gain_db), np.nan) for name in FOUND}
    fits = {}
    for kind in ("LOS", "NLOS"):
        part = places.kind == kind
        fits[kind], columns = calibrated(config, places.position_m[part], places.gain_db[part], BOULDER_TRACE)
        for name, column in columns.items():
            level[name][part] = column
    program, theirs_db = measured_sets.gains_of_sionna(sionna, len(places.gain_db))
    classes = []
    for name, part in (("in sight", places.kind == "LOS"), ("hidden", places.kind == "NLOS"),
                       ("hidden in the map, too", (places.kind == "NLOS") & ~ours["los"])):
        classes.append({"class": name, **{column: agrees(places.gain_db[part], level[column][part]) for column in FOUND},
                        "sionna": agrees(places.gain_db[part], theirs_db[part]),
                        **{key: spreads(ours[key][part], theirs[part]) for key, theirs in (("ds", places.ds), ("asa", places.asa))}})
    points = {name: np.column_stack([level["before"], places.gain_db])[places.kind == kind]
              for name, kind in (("in sight", "LOS"), ("hidden", "NLOS"))}
    return {"trace": BOULDER_TRACE, "window_db": links.WINDOW_DB, "sionna": program, "classes": classes, "fits": fits}, points


def spreads(ours, theirs):
    """Medians, and how the logarithms of both go together, of places where the program has a spread; None without two."""
    both = np.isfinite(ours) & (ours > 0) & (theirs > 0)
    if both.sum() < 2:
        return None
    found = agreement(np.log10(theirs[both]), np.log10(ours[both]))
    return {"points": int(both.sum()), "measured": float(np.median(theirs[both])), "ours": float(np.median(ours[both])),
            "sigma_of_log10": found.sigma_db, "spearman": found.spearman}


# --- DICHASUS ---

def hallway_config(folder, array, partitions):
    """The configuration of an array with a dipole as the receiver, and these partitions."""
    text = (folder / f"dc01_array{array}.toml").read_text(encoding="utf-8").replace('file = "', f'file = "{folder.resolve()}/')
    return text + '\n[[receiver]]\nname = "place"\nposition_m = [0, 0, 0]\nantenna = "dipole"\n' + partitions


def hallway(folder):
    """Rows of each array."""
    out = {"trace": HALLWAY_TRACE, "arrays": []}
    for array in (1, 2):
        position, level = measured_sets.hallway(folder, array)
        measured = level["measured"]
        fits, columns = {}, {}
        for name, (partitions, fit) in PARTITIONS.items():
            with tempfile.TemporaryDirectory() as work:
                config = pathlib.Path(work) / "hallway.toml"
                config.write_text(hallway_config(folder, array, partitions), encoding="utf-8")
                fits[name], columns[name] = calibrated(config, position, measured, HALLWAY_TRACE, fit)
        clipped = level["sionna_itu"] <= level["sionna_itu"].min()
        out["arrays"].append({
            "array": array, "partitions": fits, **{name: agrees(measured, level[name]) for name in measured_sets.PEERS},
            "clipped": {"places": int(clipped.sum()), "level_db": float(level["sionna_itu"].min()),
                        **{name: agrees(measured[~clipped], levels[~clipped]) for name, levels in (
                            ("before", columns["slabs"]["before"]), ("sionna_itu", level["sionna_itu"]))}}})
    return out


def all_sets(data, sionna):
    """The results of both sets, and the points of the figure of the streets. data: the folder with boulder and dichasus;
    sionna: the file of sionna_levels.py."""
    street, points = streets(data / "boulder", sionna)
    return {"folds": FOLDS, "boulder": street, "dichasus": hallway(data / "dichasus")}, points
