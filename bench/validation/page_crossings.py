# SPDX-License-Identifier: Apache-2.0
"""The part of docs/validation.md about links of vehicles around one corner."""
from page_parts import measured, table
from page_streets import span
from virtualsource11p import SIGMA_DB

AMONG = {"with": "no vehicles", "traffic": "among 200 vehicles", "without": "no vehicles, no diffraction"}
MODELS = ("VirtualSource11p", "TR 37.885", "P.1411-12, 4.3.2")


def cell(off):
    return f"{off[0]:+.1f} ({off[1]:.1f})" if off else ""


def crossing_table(result):
    rows = [[f"{AMONG[variant]}, {row['from_m']} to {row['to_m']} m", row["links"], f"{row['heard'] / max(1, row['links']):.0%}",
             f"{row['loss'][0]:.1f}" if row["loss"] else "", *(cell(row["models"][name]["off"]) for name in MODELS)]
            for variant in AMONG for row in result["bins"] if row["variant"] == variant]
    return table(["links, receiver from the crossing", "number", "with a path", "loss, dB", *(f"minus {name}, dB" for name in MODELS)],
                 rows)


def medians(result, variant, name):
    return [row["models"][name]["off"][0] for row in result["bins"] if row["variant"] == variant and row["models"][name]["off"]]


def section(result):
    with_, among = (medians(result, variant, "VirtualSource11p") for variant in ("with", "traffic"))
    others = medians(result, "with", "TR 37.885") + medians(result, "with", "P.1411-12, 4.3.2")
    return f"""## Vehicles at crossings
This section compares links of vehicles around one corner with a model that was fitted to such links: VirtualSource11p (T. Mangel, O. Klemp, H. Hartenstein, EURASIP Journal on Wireless Communications and Networking 2011:182). Its authors measured at crossings of Munich, at {result["frequency_hz"] / 1e9:g} GHz and down to -92 dBm, and state a fading of {SIGMA_DB:g} dB about it. It takes the distances of both vehicles from the crossing, the width of the receiver's street, and the distance from the transmitter to the wall. Two other models know less of the place. TR 37.885, NLOS, takes the direct distance alone. P.1411-12, 4.3.2 (one turn, terminals 1.5 to 4 m high), takes both distances from the crossing; the recommendation states it for 0.43 to 4.86 GHz and up to 1 km, so here it is used beyond its range.

The links are the hidden ones between vehicles in the ten cities above whose streets cross: {result["links"]:,} links, each in both directions, because VirtualSource11p is not the same both ways. The antennas are 1.6 m high, the streets 20 m wide. The distance to the wall is that to the wall on the other vehicle's side, 7 or 13 m, as the lanes are. The rows differ by the distance of the receiver from the crossing. Each cell has the median of the program's loss minus the model's loss, and in brackets half of the range between the 16th and the 84th of 100 links. Links without any path are left out of the medians {measured(result)}.

{crossing_table(result)}

Program minus VirtualSource11p is {span(with_)} in empty streets, and {span(among)} among vehicles; program minus the other two models is {span(others)} in empty streets. So the model that was fitted to crossings, and that knows the streets, is the nearest one. Beyond some 40 m from the crossing the program still has more loss. The sign is that of [the other hidden links](#where-they-disagree-and-why), and the probable cause is the same: the map is bare, and only sharp corners and flat walls turn the wave. Vehicles, which also turn it, take away {min(a - b for a, b in zip(with_, among)):.0f} to {max(a - b for a, b in zip(with_, among)):.0f} dB of the difference. Links differ much more from one another than the model's fading, because a reflection off a wall around the corner is there or is not. Without diffraction few links have a path, and these lose less than the model.

The article's ranges of distances and street widths were not at hand. Where the loss is so large that a radio would not hear it, the model extrapolates its own measurements. The equation comes from transcriptions, which `bench/validation/virtualsource11p.py` names. Munich has no such table: its map has walls and no streets, so its crossings cannot be found simply.
"""
