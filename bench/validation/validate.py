#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes docs/validation.md: solves the scenes of each part, keeps the numbers in bench/validation/results/PART.json, draws
the figures, and writes the page. `./dev validation` builds what it needs and starts it.

Usage: validate.py [PART...] [--page] [--data FOLDER --sionna FILE]; PART is edges, laws, streets, crossings or measured. By
default all parts are solved; measured only with its data: FOLDER has the measured levels that docs/validation.md names, and
sionna_levels.py writes FILE. --page only writes the page anew.
"""
import argparse
import datetime
import json
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
RESULTS = HERE / "results"
FIGURES = HERE.parents[1] / "docs/figures"


def rounded(value):
    """Numbers to six digits, so that a file of results is short and its changes can be read."""
    if isinstance(value, dict):
        return {key: rounded(inner) for key, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [rounded(inner) for inner in value]
    return float(f"{value:.6g}") if isinstance(value, float) else value


def edges():
    import screens
    return {"single": screens.single(), "double": screens.double()}


def laws():
    import room
    return {"energy": {name: room.energy(material) for name, material in room.MATERIALS.items()},
            "room_m": room.ROOM_M, "receivers": 6 * room.POINTS**2, "reciprocity": room.reciprocity()}


def streets():
    import compare
    return compare.all_links()


def crossings():
    import crossings as links_at_crossings
    return links_at_crossings.all_links()


def measured(data, sionna):
    import measured as levels
    import page_measured
    result, points = levels.all_sets(data, sionna)
    page_measured.draw(points, FIGURES)
    return result


PARTS = {"edges": edges, "laws": laws, "streets": streets, "crossings": crossings, "measured": measured}


def results():
    return {part: json.loads((RESULTS / f"{part}.json").read_text(encoding="utf-8")) for part in PARTS}


def solve(part, **inputs):
    import wavetracer as wt
    device = wt.Simulation({"scene": {"generate": "--blocks 2x2"}, "transmitter": [{"name": "a", "position_m": [0, 0, 2]}],
                            "receiver": [{"name": "b", "position_m": [9, 0, 2]}]}).device
    values = rounded(PARTS[part](**inputs))
    head = {"device": device, "date": datetime.date.today().isoformat(), "version": wt.__version__}
    RESULTS.mkdir(exist_ok=True)
    lines = [f"{json.dumps(key)}: " + ("[\n" + ",\n".join(map(json.dumps, value)) + "]" if isinstance(value, list)
                                       else json.dumps(value)) for key, value in {**head, **values}.items()]
    (RESULTS / f"{part}.json").write_text("{" + ",\n".join(lines) + "}\n", encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("parts", nargs="*", choices=[[], *PARTS], metavar="PART")
    parser.add_argument("--page", action="store_true")
    parser.add_argument("--data", type=pathlib.Path, metavar="FOLDER")
    parser.add_argument("--sionna", type=pathlib.Path, metavar="FILE")
    options = parser.parse_args()
    given = options.data is not None and options.sionna is not None
    if "measured" in options.parts and not given:
        parser.error("measured needs --data FOLDER and --sionna FILE: docs/validation.md, \"Measured levels\", says what they are")
    for part in [] if options.page else options.parts or [part for part in PARTS if given or part != "measured"]:
        print(f"solving: {part}", flush=True)
        solve(part, **({"data": options.data, "sionna": options.sionna} if part == "measured" else {}))
    import page
    page.draw(results(), FIGURES)
    (HERE.parents[1] / "docs/validation.md").write_text(page.text(results()), encoding="utf-8")


if __name__ == "__main__":
    main()
