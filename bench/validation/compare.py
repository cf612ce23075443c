# SPDX-License-Identifier: Apache-2.0
"""Compares links with the models: medians and spreads of each class of links, and by distance."""
import datetime

import numpy as np

import p1411
import streets
import tr37885
import tr38901

NLOS_FROM_M = 30.0  # the NLOS formulas of P.1411 begin here
WEAK_DB = 150.0  # losses above this are hard to measure
FLOOR_DB = -170.0  # below it a single path over a tile may be left out
ROUGH = ("brick", "concrete", "glass", "marble")  # walls and ground of generated cities


def models(kind, state, frequency_ghz, rows):
    """(name, loss in dB of each row, stated sigma) of what is published for these links; state: los, nlosv or nlos."""
    d, d2 = np.maximum(rows["d_m"], 1), rows["d2_m"]
    general = "los" if state != "nlos" else "nlos_high_rise"
    out = [("P.1411-12, 4.1.1", p1411.site_general(frequency_ghz, d, general), p1411.SITE_GENERAL[general][3])]
    if kind == "mast":
        name = "los" if state == "los" else "nlos"
        out.append(("TR 38.901, UMi", tr38901.path_loss(frequency_ghz, d2, streets.MAST_M, streets.PEDESTRIAN_M, name),
                    tr38901.SIGMA_DB[name]))
    else:
        out.append(("TR 37.885, urban", tr37885.path_loss(frequency_ghz, d, state), tr37885.SIGMA_DB[state]))
    return out


def middle(values):
    """Median and half of what is between the 16th and the 84th of 100: one sigma, if they are normal."""
    if len(values) < 5:
        return None
    low, median, high = np.quantile(values, (0.16, 0.5, 0.84), method="nearest")  # not between numbers and infinity
    return [float(median), float((high - low) / 2)] if np.isfinite([low, high]).all() else None


def log_middle(values):
    with np.errstate(divide="ignore"):
        return middle(np.log10(values))


def beside(kind, state, frequency_ghz, rows, variant):
    """One class of links, with `variant` of their figures: without, with (diffraction) or traffic (with vehicles, too)."""
    heard = np.isfinite(rows[f"loss_db_{variant}"])
    rows = {key: column[heard] for key, column in rows.items()}
    loss = rows[f"loss_db_{variant}"]
    spreads = (tr38901 if kind == "mast" else tr37885).spreads(frequency_ghz, state)
    return {"kind": kind, "state": state, "frequency_hz": frequency_ghz * 1e9, "variant": variant, "links": len(heard),
            "heard": int(heard.sum()), "weak": int((loss > WEAK_DB).sum() + (~heard).sum()), "loss": [
                {"model": name, "stated_sigma_db": sigma, "median_db": float(np.median(loss - model)),
                 "sigma_db": float(np.std(loss - model))} for name, model, sigma in
                models(kind, state, frequency_ghz, rows) if len(loss) > 4],
            "spreads": {name: {"ours": log_middle(rows[f"{name}_{variant}"]), "model": list(spreads[name])}
                        for name in ("ds", "asa", "asd")}}


def classes(rows, variant):
    """Yields the classes of links, each a name and a mask: with line of sight and without, and in traffic also links
    that only vehicles block."""
    near = rows["d_m"] >= NLOS_FROM_M
    yield "los", rows["los"] & rows["los_traffic"] if variant == "traffic" else rows["los"]
    if variant == "traffic":
        yield "nlosv", rows["los"] & ~rows["los_traffic"]
    yield "nlos", ~rows["los"] & near


def bounds(kind, frequency_ghz, rows):
    """Links in sight beside the bounds of P.1411, 4.1.2, which go up to 15 GHz: by the sum of powers and by that of fields,
    which beyond the breakpoint differ, because the ground's reflection takes from the direct wave."""
    if frequency_ghz > 15:
        return []
    heights = (streets.MAST_M, streets.PEDESTRIAN_M) if kind == "mast" else (streets.ROOF_M, streets.ROOF_M)
    breakpoint_m = 4 * heights[0] * heights[1] * frequency_ghz / 0.2998
    out = []
    for name, part in (("before", rows["d_m"] <= breakpoint_m), ("beyond", rows["d_m"] > breakpoint_m)):
        sight = rows["los"] & part
        if sight.sum() < 10:
            continue
        lower, median, upper = p1411.los_bounds(frequency_ghz, rows["d_m"][sight], *heights)
        for sums, column in (("powers", "loss_db_with"), ("fields", "fading_db_with")):
            loss = rows[column][sight]
            out.append({"kind": kind, "breakpoint_m": breakpoint_m, "side": name, "sum": sums, "links": int(sight.sum()),
                        "below": float(np.mean(loss < lower)), "above": float(np.mean(loss > upper)),
                        "from_median_db": float(np.median(loss - median))})
    return out


def corners(frequency_ghz, rows):
    """Links around one corner beside P.1411, 4.1.3.2, by how far beyond the crossing the receiver is."""
    hidden = ~rows["los"] & np.isfinite(rows["x1_m"])
    out = []
    for low, high in ((11, 40), (40, 80), (80, 160), (160, 300)):
        for variant in ("without", "with"):
            wanted = hidden & (rows["x2_m"] >= low) & (rows["x2_m"] < high)
            heard = wanted & np.isfinite(rows[f"loss_db_{variant}"])
            theirs = p1411.corner(frequency_ghz, rows["x1_m"][heard], rows["x2_m"][heard], streets.STREET_M, streets.MAST_M,
                                  streets.PEDESTRIAN_M)
            off = rows[f"loss_db_{variant}"][heard] - theirs
            out.append({"frequency_hz": frequency_ghz * 1e9, "from_m": low, "to_m": high, "variant": variant,
                        "links": int(wanted.sum()), "heard": int(heard.sum()), "off": middle(off)})
    return out


def by_distance(kind, frequency_ghz, rows):
    """Quantiles of the loss with diffraction in bins of distance, links without a path counting as infinite."""
    out = []
    edges = np.geomspace(10, streets.FAR_M, 11)
    for state in ("los", "nlos"):
        for low, high in zip(edges[:-1], edges[1:]):
            wanted = (rows["los"] == (state == "los")) & (rows["d_m"] >= low) & (rows["d_m"] < high)
            if wanted.sum() < 10:
                continue
            quantiles = np.quantile(rows["loss_db_with"][wanted], (0.1, 0.5, 0.9), method="nearest")
            if np.isfinite(quantiles[:2]).all():
                out.append({"kind": kind, "frequency_hz": frequency_ghz * 1e9, "state": state,
                            "d_m": float(np.median(rows["d_m"][wanted])), "low_db": float(quantiles[0]),
                            "median_db": float(quantiles[1]),
                            "high_db": float(quantiles[2]) if np.isfinite(quantiles[2]) else None})
    return out


def blocked(frequency_ghz, rows):
    """The loss that vehicles in between add to links that only they block."""
    hidden = rows["los"] & ~rows["los_traffic"] & np.isfinite(rows["loss_db_traffic"])
    return {"frequency_hz": frequency_ghz * 1e9, "links": int(hidden.sum()),
            "added": middle(rows["loss_db_traffic"][hidden] - rows["loss_db_with"][hidden]),
            "distance_m": float(np.median(rows["d_m"][hidden]))}


def causes():
    """The changes in dB that more physics makes to the losses of links without line of sight, from masts in one city.
    """
    few = {"seed": 1, "masts": 1, "terminals": 40}
    three = {**streets.TRACE, "max_depth": 3}
    plain, few_plain, short = streets.city_masts(1), streets.city_masts(**few), streets.city_masts(**few, trace=three)
    walls = {"material": [{"name": name, "scattering": 0.3} for name in ROUGH]}
    once = {**streets.TRACE, "scattering": True, "tile_m": 10.0}
    mirrored = {**once, "scattering_reflections": 1, "scattering_floor_db": FLOOR_DB}
    trials = (("six interactions instead of four", plain, streets.city_masts(1, trace={**streets.TRACE, "max_depth": 6})),
              ("rough walls, S = 0.3 (scattered once)", plain, streets.city_masts(1, trace=once, **walls)),
              ("rough walls, scattered once, fewer links", few_plain, streets.city_masts(**few, trace=once, **walls)),
              ("rough walls, reflected before and after a tile, too", few_plain, streets.city_masts(**few, trace=mirrored, **walls)),
              ("rough walls, also with an edge beside a tile", few_plain,
               streets.city_masts(**few, trace={**mirrored, "scattering_diffraction": True}, **walls)),
              ("two edges instead of one, of three interactions", short,
               streets.city_masts(**few, trace={**three, "max_diffractions": 2})))
    out = []
    for what, before, after in trials:
        for hz, one, other in zip(streets.CARRIERS_HZ, before, after):
            hidden = ~one["los"] & np.isfinite(one["loss_db_with"])
            change = other["loss_db_with"][hidden] - one["loss_db_with"][hidden]
            out.append({"what": what, "frequency_hz": hz, "links": int(hidden.sum()), "median_db": float(np.median(change)),
                        "mean_db": float(np.mean(change)), "date": datetime.date.today().isoformat()})
    return out


def all_links():
    groups = {("ten cities", kind): [streets.joined(each) for each in zip(*map(solve, streets.SEEDS))]
              for kind, solve in (("mast", streets.city_masts), ("vehicle", streets.city_vehicles))}
    groups |= {("Munich", kind): tables for kind in ("mast", "vehicle") if (tables := streets.munich(kind))}
    out = {"trace": streets.TRACE, "far_m": streets.FAR_M, "classes": [], "bounds": [], "corners": [], "by_distance": [],
           "blocked": [], "causes": causes()}
    for (where, kind), tables in groups.items():
        for hz, rows in zip(streets.CARRIERS_HZ, tables):
            ghz = hz / 1e9
            for variant in ("without", "with", "traffic"):
                if f"loss_db_{variant}" in rows:
                    for state, chosen in classes(rows, variant):
                        part = {key: column[chosen] for key, column in rows.items()}
                        out["classes"].append({"where": where, **beside(kind, state, ghz, part, variant)})
            out["bounds"] += [{"where": where, **each} for each in bounds(kind, ghz, rows)]
            out["by_distance"] += [{"where": where, **each} for each in by_distance(kind, ghz, rows)]
            if "x1_m" in rows:
                out["corners"] += corners(ghz, rows)
            if "los_traffic" in rows:
                out["blocked"].append(blocked(ghz, rows))
    return out
