# SPDX-License-Identifier: Apache-2.0
"""Runs `wavetracer coverage` on a run with a codebook, and compares the layers of beams with the closed form of orthogonal
beams and with beams.h5.

    read_beams.py PROGRAM FOLDER

Needs numpy, h5py and an OpenCL device; answers 77 where one is missing.
"""
import json

import h5py
import numpy as np
from map_reading import FREE_SPACE, column, db, free_run, main, run, same, table

PANEL = """
[[array]]
name = "row"
columns = 8
codebook = "dft"
"""


def beams(program, folder):
    """One antenna sends by the beams of a row of eight elements along y: the best of these orthogonal beams has
    max over k of |sum over n of exp(j n (psi - 2 pi k / 8))|^2 / 8, psi = pi dy / distance."""
    config = FREE_SPACE.replace("[radio]", PANEL + "[radio]\nwavefront = \"plane\"")
    out = free_run(program, folder, config.replace('name = "west"', 'name = "west"\narray = "row"')) / "out"
    done = run(program, "coverage", out, "--tx", "west", "--layers", "path_gain_db,beam_gain_db,tx_beam,rx_beam",
               "--format", "csv,png")
    assert done.stderr == "", done.stderr
    rows = table(out / "coverage/coverage.csv")
    x, y = column(rows, "x_m"), column(rows, "y_m")
    psi = np.pi * (y - 30) / np.sqrt((x - 10) ** 2 + (y - 30) ** 2 + 23.5 ** 2)
    n, k = np.arange(8), np.arange(8)
    gains = np.abs(np.exp(1j * n[:, None, None] * (psi - 2 * np.pi * k[:, None] / 8)).sum(axis=0)) ** 2 / 8
    same(column(rows, "beam_gain_db"), column(rows, "path_gain_db") + db(gains.max(axis=0)), 1e-4)
    assert len(set(column(rows, "tx_beam"))) > 4 and not column(rows, "rx_beam").any()
    with h5py.File(out / "beams.h5") as h5:
        group = {name: h5[f"beams/{name}"][...] for name in ("tx", "rx", "tx_beam", "gain_db")}
        names = list(h5["receivers/name"].asstr()[...])
    for row in rows[::11]:
        own = (group["tx"] == 0) & (group["rx"] == names.index(f"g/{row['ix']},{row['iy']}"))
        assert group["tx_beam"][own][np.argmax(group["gain_db"][own])] == float(row["tx_beam"]), row
    layers = json.loads((out / "coverage/coverage.json").read_text())["layers"]
    assert len(layers["tx_beam"]["colours"]) == 12 and "dark_to_bright" not in layers["tx_beam"], layers["tx_beam"]
    run(program, "coverage", out, "--tx", "east, far", "-o", out / "east")
    # Nobody has beams on the way from the other antenna, so none of its cells knows any.
    assert np.isnan(column(table(out / "east/coverage.csv"), "tx_beam")).all()


main(beams)
