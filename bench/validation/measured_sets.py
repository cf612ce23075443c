# SPDX-License-Identifier: Apache-2.0
"""Readers of two public sets of measured levels, in the forms that docs/validation.md describes ("Measured levels"). The data
are not part of this project."""
import csv
import math
import sys
from dataclasses import dataclass

import numpy as np

RTK_FIXED = "4"  # the mode of a position that is known to centimetres


def columns(file, names):
    """The texts of these columns, {name: list}. A file that cannot be read or lacks one ends the program."""
    try:
        with open(file, encoding="utf-8-sig", newline="") as source:
            rows = list(csv.DictReader(source))
    except (OSError, UnicodeDecodeError) as error:
        sys.exit(f"{file}: cannot be read: {getattr(error, 'strerror', None) or error}; see \"Measured levels\" in "
                 "docs/validation.md for the files that are needed")
    missing = [name for name in names if not rows or name not in rows[0]]
    if missing:
        sys.exit(f"{file}: no column {', '.join(missing)}; see \"Measured levels\" in docs/validation.md")
    return {name: [row[name] for row in rows] for name in names}


def numbers(file, name, texts):
    """The numbers of a column; a text that is none ends the program and names the line."""
    out = np.empty(len(texts))
    for i, text in enumerate(texts):
        try:
            out[i] = float(text)
        except (TypeError, ValueError):
            out[i] = math.nan
        if not math.isfinite(out[i]):
            sys.exit(f"{file}:{i + 2}: {name} is {text!r}, which is no number: correct the line or remove it")
    return out


def table_of(file, texts, values):
    """The columns `texts` as arrays of text, and the columns `values` as numbers."""
    found = columns(file, (*texts, *values))
    return {**{name: np.array(found[name]) for name in texts},
            **{name: numbers(file, name, found[name]) for name in values}}


# --- Boulder, streets at 28.5 GHz ---

@dataclass
class Street:
    """Places with measured figures, an entry each: position (m), LOS or NLOS as the measurers say, path gain (dB), delay
    spread (s) and azimuth spread of arrival (degrees) of the components up to `window_db` below the strongest."""

    position_m: np.ndarray
    kind: np.ndarray
    gain_db: np.ndarray
    ds: np.ndarray
    asa: np.ndarray


def boulder(folder, window_db):
    """positions.csv: x and y (m) from the transmitter, the receiver's height rxh, the mode of the position and the path gain
    pg (dB). components.csv: delay, azimuth and path loss of each component in each sector of 16 horns; a place has up to
    eight sectors, and its spreads are the means over them."""
    places = table_of(folder / "positions.csv", ("kind", "id", "mode"), ("x", "y", "rxh", "pg"))
    parts = table_of(folder / "components.csv", ("kind", "id", "sector"), ("delay_ns", "aoa_azimuth_deg", "path_loss_db"))
    sectors = {}
    for i, key in enumerate(zip(parts["kind"], parts["id"], parts["sector"])):
        sectors.setdefault(key[:2], {}).setdefault(key[2], []).append(i)
    kept = [i for i, mode in enumerate(places["mode"]) if mode == RTK_FIXED]
    spreads = []
    for i in kept:
        own = sectors.get((places["kind"][i], places["id"][i]))
        if not own:
            sys.exit(f"{folder / 'components.csv'}: no components of {places['kind'][i]} {places['id'][i]}, a place of "
                     "positions.csv")
        spreads.append(np.mean([spread(*(parts[name][rows] for name in ("path_loss_db", "delay_ns", "aoa_azimuth_deg")),
                                       window_db) for rows in own.values()], axis=0))
    ds, asa = np.array(spreads).reshape(-1, 2).T
    position = np.stack([places["x"], places["y"], places["rxh"]], axis=1)[kept]
    return Street(position, places["kind"][kept], places["pg"][kept], ds * 1e-9, asa)


def spread(loss_db, delay_ns, azimuth_deg, window_db):
    """The rms delay spread (ns) and the azimuth spread (degrees; TR 38.901, equation A-1) of components."""
    keep = loss_db <= loss_db.min() + window_db
    weight = 10 ** (-loss_db[keep] / 10)
    weight /= weight.sum()
    delay = delay_ns[keep]
    length = abs((weight * np.exp(1j * np.radians(azimuth_deg[keep]))).sum())
    angle = math.degrees(math.sqrt(-2 * math.log(length))) if length < 1 - 1e-12 else 0.0
    return math.sqrt((weight * (delay - (weight * delay).sum()) ** 2).sum()), angle


def gains_of_sionna(file, places):
    """The name of the program and its path gains (dB, -inf without a path), as sionna_levels.py writes them."""
    found = table_of(file, ("program", "place"), ("gain_db",))
    place = numbers(file, "place", found["place"]).astype(int)
    if not np.isin(place, np.arange(places)).all():
        sys.exit(f"{file}: it has other places than the {places} of positions.csv: write it anew by sionna_levels.py")
    gain = np.full(places, -np.inf)
    gain[place] = found["gain_db"]
    return str(found["program"][0]), gain


# --- DICHASUS dc01, a hallway at 3.438 GHz ---

PEERS = ("sionna_itu", "sionna_learned", "sionna_neural")
RECEIVER_M = 1.04  # the height of the antenna


def hallway(folder, array):
    """dc01_hexagons.csv: x and y (m) of 684 places, and for array 1 and 2 the measured level and those of Sionna RT, in dB
    up to a constant. Returns positions (m) and {measured, sionna_...: levels}."""
    names = {name: f"array{array}_{name}" for name in ("measured", *PEERS)}
    found = table_of(folder / "dc01_hexagons.csv", (), ("x_m", "y_m", *names.values()))
    position = np.stack([found["x_m"], found["y_m"], np.full(len(found["x_m"]), RECEIVER_M)], axis=1)
    return position, {name: found[column] for name, column in names.items()}
