#!/usr/bin/env python3
"""Parts of bench/validation in small, on a device: one edge against the Fresnel integral, the energy of a closed room.

Usage: laws_test.py FOLDER; FOLDER is bench/validation. Exits with 77 without numpy and scipy.
"""
import sys

sys.path.insert(0, sys.argv[1])
try:
    import room
    import screens
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
    for row in rows[:-1]:  # what the program reflects is what Fresnel says of what arrived
        assert abs(row["program_returns_w"] / row["returns_w"] - 1) < 0.01, row
    for row, later in zip(rows, rows[1:]):  # and what leaves one wall arrives at the others
        assert abs(later["arrives_w"] / row["program_returns_w"] - 1) < 0.02, (row, later)
    assert abs(rows[-1]["taken_w"] + rows[-1]["returns_w"] - 1) < 0.01, rows[-1]
    assert rows[-1]["taken_w"] < 1.01 and rows[1]["arrives_w"] > 0.05, rows


def main():
    check_edge()
    check_energy()
    print("edges and energy hold")


if __name__ == "__main__":
    main()
