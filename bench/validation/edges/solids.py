#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Cases of solid bodies, by integral equations: writes metal_exact.csv, concrete_block.csv, corners.csv and
corners_front.csv into a folder, in some minutes.

Usage: solids.py FOLDER [metal_exact] [concrete_block] [corners] [corners_front]

Walls go down, and a corner's faces go away, for ever: nothing but the roof and its edges, or the one corner, is there. Lossy
bodies are so lossy that what passes through them is 50 dB or more below the field in free space.
"""
import sys

import numpy as np

import cases
import truth
from boundary import Boundary, conductor_fields, fields

EPSILON_0 = 8.8541878128e-12
# The permittivity and the conductivity of ITU-R P.2040-3, table 3: a f^b and c f^d, f in GHz.
P2040 = {"concrete": (5.24, 0, 0.0462, 0.7822), "brick": (3.91, 0, 0.0238, 0.16), "wet_ground": (30, -0.4, 0.15, 1.30)}
BLOCKS = [  # material, f_hz, width, the gaps from the walls to the ends, heights of the ends over the roof
    ("concrete", 1e9, 4.5, 15, 15, ((0.3, 0.3), (0.05, 0.05), (-0.3, -0.3), (-1, -1), (-2, -2), (0.3, -1), (0, 0))),
    ("concrete", 1e9, 9.0, 15, 15, ((-1, -1), (-0.1, -0.1), (0.1, 0.1), (-1, 0.2), (0.6, 0.6))),
    ("concrete", 2e9, 2.5, 10, 6, ((-0.5, -0.5), (-0.05, -0.05), (0.15, 0.15), (0.6, 0.6), (-1, 0.1))),
    ("concrete", 0.5e9, 6.0, 30, 20, ((-2, -2), (-0.5, -0.5), (0.05, 0.05), (0.6, 0.6), (0.6, -2))),
    ("brick", 1e9, 4.0, 10, 10, ((-1.5, -1.5), (-0.5, -0.5), (0.05, 0.05), (0.3, 0.3), (0.6, -1))),
    ("brick", 2e9, 4.0, 5, 12, ((-1, -1), (-0.3, -0.3), (0, 0), (0.3, 0.3), (0.2, -0.8))),
    ("brick", 0.8e9, 8.0, 20, 20, ((-2, -2), (-0.5, -0.5), (0.1, 0.1), (0.6, 0.6))),
    ("wet_ground", 0.5e9, 3.0, 10, 10, ((-2, -2), (-0.5, -0.5), (0.05, 0.05), (0.6, 0.6), (0.5, -1))),
    ("wet_ground", 0.7e9, 2.0, 8, 15, ((-1, -1), (-0.2, -0.2), (0.2, 0.2), (0, -1.5))),
    ("6.31:0.03", 1e9, 5.0, 12, 12, ((-1.5, -1.5), (-0.4, -0.4), (0.05, 0.05), (0.4, 0.4), (0.3, -1))),
    ("8:0.5", 1e9, 0.3, 10, 10, ((-2, -2), (-1, -1), (-0.3, -0.3), (0.05, 0.05), (0.3, 0.3), (0.3, -1))),
    ("8:0.5", 1e9, 1.0, 5, 10, ((-2, -1), (-0.5, -0.5), (0.05, 0.05), (0.4, 0.4))),
]
METAL = ((0.9e9, 0.1), (0.9e9, 1.0), (0.9e9, 10.0), (2e9, 0.05), (2e9, 0.3), (2e9, 4.5), (5.9e9, 0.01), (5.9e9, 0.1),
         (5.9e9, 0.3), (5.9e9, 1.8))  # f_hz, width
METAL_GAPS = ((5.0, 5.0), (5.0, 12.0))
METAL_HEIGHTS = ((0, 0), (-0.05, -0.05), (-0.5, -0.5), (-2, -2), (0, -2), (0.05, 0.05), (0.3, 0.3), (0.3, -0.5), (0.6, -2))
CORNERS = (("concrete", 1e9), ("wet_ground", 1e9))
SOURCES = [(s, a) for s in (5.0, 8.06, 12.0) for a in (1.0, 3.0, 7.125, 15.0, 30.0, 45.0)] + [(8.0, 60.0), (8.0, 80.0)]
FRONT_SOURCES = [(s, a) for s in (4.0, 9.0) for a in (95.0, 115.0, 140.0, 165.0)]
FRONT_AZIMUTHS = (95.0, 110.0, 135.0, 160.0)  # degrees off the roof
SHADOWS = (-20.0, 2.0, 8.0, 20.0, 38.0, 48.0, 55.0, 60.0)  # degrees beyond the boundary of the shadow


def epsilon(material, f_hz):
    """The relative permittivity, complex, of a name of P.2040 or of "permittivity:conductivity"."""
    g = f_hz / 1e9
    if material in P2040:
        a, b, c, d = P2040[material]
        real, conductivity = a * g**b, c * g**d
    else:
        real, conductivity = map(float, material.split(":"))
    return real - 1j * conductivity / (2 * np.pi * f_hz * EPSILON_0)


def spacing(material, f_hz):
    return cases.SPEED_OF_LIGHT / f_hz / abs(np.sqrt(epsilon(material, f_hz))) / 7


def roof_profile(f_hz, width, first, last, heights, step):
    """The ends and the boundary of a block whose walls go down for ever: they are whole for 4.5 Fresnel zones below the
    ends, and then fade out, which leaves errors of 1e-4 of the free field and less."""
    ends = [((0.0, low), (first + width + last, high)) for low, high in heights]
    zone = np.sqrt(cases.SPEED_OF_LIGHT / f_hz * first * last / (first + last))
    leg = -min(0, min(min(pair) for pair in heights)) + 9 * zone
    profile = [(first + width, -leg), (first + width, 0), (first, 0), (first, -leg)]
    return ends, Boundary(profile, step, 4.5 * zone)


def metal():
    rows = []
    for f_hz, width in METAL:
        for first, last in METAL_GAPS:
            step = min(cases.SPEED_OF_LIGHT / f_hz / 10, width / 1.5)
            ends, boundary = roof_profile(f_hz, width, first, last, METAL_HEIGHTS, step)
            for wave in "VH":
                got = conductor_fields(boundary, cases.wave_number(f_hz), wave, *zip(*ends))
                rows += [cases.case("metal_exact", f_hz, wave, "block", (first, first + width), (0.0, 0.0), pair, field)
                         for pair, field in zip(ends, got)]
        print(f"metal, {width:g} m wide: {len(boundary.weight)} points", flush=True)
    return rows


def blocks():
    rows = []
    for material, f_hz, width, first, last, heights in BLOCKS:
        ends, boundary = roof_profile(f_hz, width, first, last, heights, spacing(material, f_hz))
        for wave in "VH":
            got = fields(boundary, cases.wave_number(f_hz), epsilon(material, f_hz), wave, *zip(*ends))
            rows += [cases.case("concrete_block", f_hz, wave, "block", (first, first + width), (0.0, 0.0), pair, field, material)
                     for pair, field in zip(ends, got)]
        print(f"{material}, {width:g} m wide: {len(boundary.weight)} points", flush=True)
    return rows


def off_wall(s, a):
    """The body of a corner is x > 0, z < 0. The place s m from the corner, a degrees off the wall."""
    return -s * np.sin(np.radians(a)), -s * np.cos(np.radians(a))


def off_roof(a):
    return 9 * np.cos(np.radians(a)), 9 * np.sin(np.radians(a))


def corner_cases(name, pairs):
    rows = []
    for material, f_hz in CORNERS:
        boundary = Boundary([(18, 0), (0, 0), (0, -21)], spacing(material, f_hz) * (1 if material == "concrete" else 1.25), 6.0)
        for wave in "VH":
            got = fields(boundary, cases.wave_number(f_hz), epsilon(material, f_hz), wave, *zip(*pairs))
            rows += [cases.case(name, f_hz, wave, "corner", (0.0,), (0.0,), pair, field, material)
                     for pair, field in zip(pairs, got)]
        print(f"corner of {material}: {len(boundary.weight)} points", flush=True)
    return rows


def corners():
    """Sources stand beside the wall, ends 9 m from the corner, most of them in the shadow."""
    return corner_cases("corners", [(off_wall(s, a), off_roof(90 - a - shadow)) for s, a in SOURCES for shadow in SHADOWS
                                    if 90 - a - shadow > 1])


def corners_front():
    """Both ends are in front of both faces: nothing is reflected, and the edge diffracts backwards."""
    return corner_cases("corners_front", [(off_wall(s, a), off_roof(b)) for s, a in FRONT_SOURCES for b in FRONT_AZIMUTHS])


if __name__ == "__main__":
    for name, make in (("metal_exact", metal), ("concrete_block", blocks), ("corners", corners), ("corners_front", corners_front)):
        if name in sys.argv[2:] or len(sys.argv) == 2:
            truth.write(sys.argv[1], make())
