# SPDX-License-Identifier: Apache-2.0
"""The cases whose field behind edges is known: screens in a row, blocks of metal, a car's roof between two other cars.

All are profiles across an axis that is endless: x runs from one end to the other, z is up, metres. A case is a dictionary:

set, number   the table's row that it counts for, and its place there
f_hz, wave    V: the magnetic field is along the axis (hard, for conductors); H: the electric field is (soft)
shape         screens (thin, from below up to `tops`), block (solid, from below up to z = 0, walls at `places`) or corner
material      a name of ITU-R P.2040, or "permittivity:conductivity in S/m"
tx_x .. rx_z  the ends
bend_deg      the largest angle by which the shortest way bends at an edge; the scalar and paraxial references hold where it
              is small, to about a dB at 20 degrees
field         the field over free space, complex, time as exp(+j omega t); phases relative to the straight way
"""
import numpy as np

import cascade
import roof

SPEED_OF_LIGHT = 299792458.0
CARRIERS_HZ = (0.9e9, 2.4e9, 5.9e9, 28e9)
TABLE = [(w, r, h) for w, r, heights in ((10.0, 20.0, (0, 0.5, 2)), (0.1, 5.0, (0.5,)), (0.01, 5.0, (0.5,)), (0.001, 5.0, (0.5,)))
         for h in heights]  # widths, half distances of the ends, depths below the top


def wave_number(f_hz):
    return 2 * np.pi * f_hz / SPEED_OF_LIGHT


def bend_deg(places, tops, ends):
    """The bends of the string that the tops hold up between the ends (x, z), (x, z)."""
    x, z = np.r_[ends[0][0], places, ends[1][0]], np.r_[ends[0][1], tops, ends[1][1]]
    string = cascade.taut(x, z, np.r_[z[0], np.full(len(places), np.inf), z[-1]])
    return float(np.degrees(np.abs(np.diff(np.arctan(np.diff(string) / np.diff(x)))).max()))


def case(name, f_hz, wave, shape, places, tops, ends, field, material="metal"):
    return {"set": name, "f_hz": f_hz, "wave": wave, "shape": shape, "places": list(places), "tops": list(tops),
            "material": material, "tx_x": ends[0][0], "tx_z": ends[0][1], "rx_x": ends[1][0], "rx_z": ends[1][1],
            "bend_deg": bend_deg(places, tops, ends), "field": complex(field)}


def over_block(name, f_hz, first, width, last, heights):
    """Both waves over a block of metal; heights are above its top."""
    ends = ((0.0, heights[0]), (first + width + last, heights[1]))
    return [case(name, f_hz, wave, "block", (first, first + width), (0.0, 0.0), ends,
                 roof.roof(first, width, last, heights, wave_number(f_hz), wave == "V")) for wave in "VH"]


def metal_block(random):
    rows = []
    for width, half, depth in TABLE:
        rows += over_block("metal_block", 5.9e9, half - width / 2, width, half - width / 2, (-depth, -depth))
    for f_hz in CARRIERS_HZ:
        for width in (0.001, 0.01, 0.1, 0.3, 1.0, 3.0, 10.0, 20.0):
            for i, depths in enumerate(((0, 0), (0.25, 0.25), (0.5, 1), (2, 2), (0, 2), (-0.3, 0.5), (-0.3, -0.3), (0.02, 0.02))):
                first, last = random.choice([5.0, 8.0, 12.0, 20.0, 35.0, 60.0], 2)
                last = first if i % 2 == 0 else last
                rows += over_block("metal_block", f_hz, first, width, last, (-depths[0], -depths[1]))
    return rows


def car_roof(random):
    rows = []
    for i in range(60):
        first, last, heights = random.uniform(3, 15), random.uniform(3, 15), random.uniform(0.05, 0.4, 2)
        if i % 3 == 0:
            last, heights[1] = first, heights[0]
        rows += over_block("car_roof", 5.9e9, first, random.uniform(1.5, 2.0), last, tuple(heights))
    return rows


def behind_screens(name, f_hz, steps, tops, ends_z):
    """Both waves behind screens, one step from each other and from the ends; the scalar integral knows no polarisation."""
    places = np.cumsum(steps)
    ends = ((0.0, float(ends_z[0])), (float(places[-1]), float(ends_z[1])))
    field = cascade.screens(places[:-1], tops, (ends[0][1], ends[1][1], ends[1][0]), wave_number(f_hz))
    return [case(name, f_hz, wave, "screens", places[:-1], tops, ends, field) for wave in "VH"]


def two_screens(random):
    """Screens of one height, bent by nu = 0 to 5 at each; then grazed ones, both below and above the line; then unequal ones."""
    rows = []
    for i in range(300):
        f_hz, steps = CARRIERS_HZ[2 + i % 2], np.exp(random.uniform(np.log(10), np.log(100), 3))
        first, last = (np.sqrt(SPEED_OF_LIGHT / f_hz * near * (near + steps[1]) / (2 * steps[1])) for near in steps[[0, 2]])
        nus = random.uniform(0, 5, 2) if i < 200 else random.uniform(-0.5, 0.5, 2)
        ends = -nus * (first, last) if i % 10 else (0.0, 0.0)
        second = 0.0 if i < 260 else random.uniform(-1.5, 1.5)
        name = "two_screens" if i < 200 else "two_screens_grazed" if i < 260 else "two_screens_unequal"
        rows += behind_screens(name, f_hz, steps, [0.0, second], ends)
    return rows


def more_screens(random, count):
    rows = []
    for i in range(20):
        f_hz = (0.9e9, 5.9e9)[i % 2]
        steps = np.full(count + 1, random.choice([10.0, 30.0, 50.0])) if i < 10 else random.uniform(8, 60, count + 1)
        tops = np.zeros(count) if i < 12 else random.uniform(-1.5, 1.5, count)
        ends = [(0, 0), (-0.1, -0.1), (-1, -1), (-5, -5), (-2, 0.5), (0.3, 0.3), (1, -3), (3, 3), (0, -10), (-0.5, -0.5)][i % 10]
        rows += behind_screens(f"screens_{count}", f_hz, steps, tops, ends)
    return rows


def known():
    """All cases of closed references, in a fixed order."""
    rows = metal_block(np.random.default_rng(1)) + two_screens(np.random.default_rng(2)) + car_roof(np.random.default_rng(3))
    for count in range(3, 9):
        rows += more_screens(np.random.default_rng(count), count)
    return rows
