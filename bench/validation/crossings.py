# SPDX-License-Identifier: Apache-2.0
"""Links of vehicles around one corner, in the ten generated cities, beside models of such links."""
import numpy as np

import p1411
import streets
import tr37885
import virtualsource11p
from compare import WEAK_DB, middle

BINS_M = ((11, 40), (40, 80), (80, 180), (180, 400))  # distances of receivers from the crossing
VARIANTS = ("without", "with", "traffic")
GHZ = virtualsource11p.FREQUENCY_GHZ


def both_ways(rows):
    """Hidden links around one corner, each twice, from either end: the model is not the same both ways."""
    corner = ~rows["los"] & np.isfinite(rows["first_end_m"])
    ways = [{"transmitter_m": rows[f"{one}_end_m"], "receiver_m": rows[f"{other}_end_m"], "wall_m": rows[f"{one}_wall_m"],
             "d_m": rows["d_m"], **{f"loss_db_{name}": rows[f"loss_db_{name}"] for name in VARIANTS}}
            for one, other in (("first", "second"), ("second", "first"))]
    return streets.joined([{key: column[corner] for key, column in way.items()} for way in ways])


def models(rows):
    """{name: loss of each row in dB}."""
    return {"VirtualSource11p": virtualsource11p.path_loss(rows["transmitter_m"], rows["receiver_m"], streets.STREET_M,
                                                           rows["wall_m"]),
            "TR 37.885": tr37885.path_loss(GHZ, rows["d_m"], "nlos"),
            "P.1411-12, 4.3.2": p1411.one_turn(GHZ, rows["transmitter_m"], rows["receiver_m"], streets.ROOF_M, streets.ROOF_M)}


def beside(rows, low_m, high_m, variant):
    """One bin of distances: how many links have a path, and the differences of their losses from each model."""
    rows = {key: column[(rows["receiver_m"] >= low_m) & (rows["receiver_m"] < high_m)] for key, column in rows.items()}
    loss = rows[f"loss_db_{variant}"]
    heard = np.isfinite(loss)
    return {"from_m": low_m, "to_m": high_m, "variant": variant, "links": len(loss), "heard": int(heard.sum()),
            "weak": int((loss > WEAK_DB).sum()), "loss": middle(loss[heard]),
            "models": {name: {"median_db": float(np.median(theirs)), "off": middle((loss - theirs)[heard])}
                       for name, theirs in models(rows).items()}}


def all_links():
    rows = streets.joined([both_ways(streets.city_vehicles(seed)[streets.CARRIERS_HZ.index(GHZ * 1e9)])
                           for seed in streets.SEEDS])
    return {"trace": streets.TRACE, "frequency_hz": GHZ * 1e9, "links": len(rows["d_m"]) // 2,
            "bins": [beside(rows, *span, variant) for span in BINS_M for variant in VARIANTS]}
