#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Parts of bench/validation in small, on a device: one edge against the Fresnel integral, the energy of a closed room,
links of a generated city against free space, and swapped ends.

Usage: laws_test.py FOLDER; FOLDER is bench/validation. Exits with 77 without numpy and scipy.
"""
import sys

sys.path.insert(0, sys.argv[1])
try:
    import numpy as np

    import compare
    import room
    import screens
    import streets
except ImportError as error:
    if error.name in ("numpy", "scipy"):
        sys.exit(77)
    raise


def check_edge():
    rows = screens.single(frequencies=(5.9e9,), distances=((200, 300),), nus=(-2.0, -0.5, 0.0, 0.5, 2.0, 5.0))
    for row in rows:
        mean = (row["v_db"] + row["h_db"]) / 2
        assert abs(mean - row["exact_db"]) < 0.02, row
        assert abs(row["v_db"] - row["h_db"]) < 0.7, row


def check_energy():
    rows = room.energy(room.MATERIALS["concrete, half space"], orders=3, points=9)
    assert abs(rows[0]["arrives_w"] - 1) < 0.01, rows[0]
    for row in rows[:-1]:  # the program's reflection is what Fresnel's formula gives for the arriving wave
        assert abs(row["program_returns_w"] / row["returns_w"] - 1) < 0.01, row
    for row, later in zip(rows, rows[1:]):  # and what leaves one wall arrives at the others
        assert abs(later["arrives_w"] / row["program_returns_w"] - 1) < 0.02, (row, later)
    assert abs(rows[-1]["taken_w"] + rows[-1]["returns_w"] - 1) < 0.01, rows[-1]
    assert rows[-1]["taken_w"] < 1.01 and rows[1]["arrives_w"] > 0.05, rows


def check_streets():
    # By hand: a mast at (120, 3) in the street y = 0 and three terminals: in the street x = 200, 50 m beyond the crossing;
    # in a parallel street; in the crossing.
    mast = np.array([[120.0, 3.0, 10.0]]), np.array([0]), np.array([0.0])
    terminals = (np.array([[205.0, 50.0, 1.5], [10.0, 100.0, 1.5], [200.0, 4.0, 1.5]]), np.array([1, 0, 1]),
                 np.array([200.0, 100.0, 200.0]))
    x1, x2 = streets.around_corner(mast, terminals)
    assert (x1[0, 0], x2[0, 0]) == (80, 50) and np.isnan(x1[0, 1:]).all() and np.isnan(x2[0, 1:]).all(), (x1, x2)
    roof = np.array([[[0, 0, 7.0], [4, 0, 7.0], [0, 4, 7.0]]])
    assert streets.heights_over(roof, [1, 1, 0]).tolist() == [7] and len(streets.heights_over(roof, [3, 3, 0])) == 0
    trace = {**streets.TRACE, "rays": 20_000, "max_depth": 2}
    for hz, rows in zip(streets.CARRIERS_HZ, streets.city_masts(3, masts=2, terminals=40, trace=trace)):
        free = 20 * np.log10(4 * np.pi * rows["d_m"] * hz / screens.SPEED_OF_LIGHT)
        sight = rows["los"]
        assert 5 <= sight.sum() < len(sight), sight
        gain = (free - rows["loss_db_without"])[sight]  # the direct wave and what ground and walls add
        assert gain.min() > -1e-6 and gain.max() < 10 * np.log10(8), gain
        assert (free - rows["loss_db_with"])[~sight].max() < 3, "hidden links are weaker than free space"
        assert (rows["loss_db_with"] <= rows["loss_db_without"] + 1e-9).all(), "edges add power"
        row = compare.beside("mast", "los", hz / 1e9, {key: column[sight] for key, column in rows.items()}, "with")
        assert row["heard"] == row["links"] == sight.sum() and abs(row["loss"][0]["median_db"]) < 12, row


def check_reciprocity():
    back = room.reciprocity(transmitters=1, receivers=4)
    assert back["common"] > 100 and back["common"] > 0.9 * back["paths"], back
    assert back["worst_of_amplitude"] < 1e-9 and back["worst_delay_s"] < 1e-17 and back["lost_share"] < 0.01, back


def main():
    check_edge()
    check_energy()
    check_streets()
    check_reciprocity()
    print("edges, energy, streets and reciprocity hold")


if __name__ == "__main__":
    main()
