# SPDX-License-Identifier: Apache-2.0
"""The field over a flat roof of a perfect conductor, by Kirchhoff's integral over the planes of its two walls: the paraxial
equation's own solution, so it holds for small angles.

u(end) = integral over y1, y2 > 0 of G(end, y2) (G(y2 - y1) +- G(y2 + y1)) G(y1, other end): + is the hard roof (the
electric field upright), - the soft one. Heights are above the roof, in metres; time goes as exp(+j omega t).
"""
import numpy as np
from scipy.special import wofz

from cascade import NODES, WEIGHTS


def half_line(a, b, exponent):
    """exp(exponent) times the integral over y > 0 of exp(-j (a y^2 - 2 b y))."""
    z = -np.sqrt(1j * a) * b / a
    near = z.real >= 0
    ahead = wofz(1j * np.where(near, z, -z)) * np.exp(exponent)
    return np.sqrt(np.pi / (1j * a)) / 2 * np.where(near, ahead, 2 * np.exp(exponent + z * z) - ahead)


def roof(first_m, roof_m, last_m, heights, k, hard):
    """The field over free space between ends at these two heights above the roof, first_m and last_m from its walls.

    y2 runs along exp(-j pi/4), where waves fall off. Between ends above the roof they rise first, to exp(k h^2 / 4 d).
    """
    whole, (h1, h2) = first_m + roof_m + last_m, heights
    if k * max(h1, h2, 0) ** 2 / 4 > 14 * min(first_m, last_m):
        raise ValueError("an end is too high above the roof for this path of integration")
    low = np.sqrt(min(first_m, roof_m, last_m) / k) / 1e4
    borders = np.concatenate([[0], np.geomspace(low, 12 * np.sqrt(whole / k) + 4 * max(h1, h2, 0), 200)])
    start, size = borders[:-1, None], np.diff(borders)[:, None]
    y, weight = (np.exp(-0.25j * np.pi) * part.ravel() for part in (start + size * (NODES + 1) / 2, size * WEIGHTS / 2))
    base = -0.5j * k * (h1 * h1 / first_m + y * y / roof_m + (h2 - y) ** 2 / last_m - (h1 - h2) ** 2 / whole)
    a = k / 2 * (1 / first_m + 1 / roof_m)
    both = [half_line(a, k / 2 * (h1 / first_m + sign * y / roof_m), base) for sign in (1, -1)]
    inner = both[0] + (1 if hard else -1) * both[1]
    return 1j * k / (2 * np.pi) * np.sqrt(whole / (first_m * roof_m * last_m)) * (weight * inner).sum()
