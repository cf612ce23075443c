# SPDX-License-Identifier: Apache-2.0
"""Losses by diffraction over knife edges: Recommendation ITU-R P.526-15, and what it approximates.

Lengths in metres, losses in dB relative to free space. Edges are infinite, thin and across the path.
"""
import numpy as np
from scipy.special import fresnel, wofz


def nu_of(height_m, d1_m, d2_m, wavelength_m):
    """The parameter of section 4.1: an edge height_m above the straight line between its ends (negative: below)."""
    return height_m * np.sqrt(2 / wavelength_m * (1 / d1_m + 1 / d2_m))


def single_exact_db(nu):
    """Section 4.1, the loss J by the complex Fresnel integral."""
    s, c = fresnel(nu)
    return -20 * np.log10(np.hypot(1 - c - s, c - s) / 2)


def single_db(nu):
    """Section 4.1, the approximation of J for nu above -0.78; 0 below."""
    nu = np.asarray(nu, float)
    x = nu - 0.1
    return np.where(nu > -0.78, 6.9 + 20 * np.log10(np.sqrt(x * x + 1) + x), 0.0)


def double_db(a, b, c, h1, h2, wavelength_m):
    """Section 4.3: edges h1 and h2 above the straight line between the ends, at a and a + b of a + b + c.

    Where both losses over one edge exceed 15 dB, the edges count alike, with the correction Lc for their distance; else
    the edge of the larger h / r is the main one, with Tc.
    """
    if h1 < 0 or h2 < 0:
        raise ValueError("section 4.3 speaks of two edges that both stand above the path")
    over_1 = single_db(nu_of(h1 - h2 * a / (a + b), a, b, wavelength_m))
    over_2 = single_db(nu_of(h2 - h1 * c / (b + c), b, c, wavelength_m))
    if over_1 > 15 and over_2 > 15:
        return over_1 + over_2 + 10 * np.log10((a + b) * (b + c) / (b * (a + b + c)))
    if h2 * np.sqrt((a + b + c) / ((a + b) * c)) > h1 * np.sqrt((a + b + c) / (a * (b + c))):
        a, c, h1, h2 = c, a, h2, h1  # seen from the other end
    main = single_db(nu_of(h1, a, b + c, wavelength_m))
    second = single_db(nu_of(h2 - h1 * c / (b + c), b, c, wavelength_m))
    p = np.sqrt(2 / wavelength_m * (a + b + c) / ((b + c) * a)) * h1
    q = np.sqrt(2 / wavelength_m * (a + b + c) / ((a + b) * c)) * h2
    alpha = np.arctan(np.sqrt(b * (a + b + c) / (a * c)))
    share = (q / p) ** (2 * p) if p > 0 else 1.0  # the limit for edges on the straight line
    return main + second - (12 - 20 * np.log10(2 / (1 - alpha / np.pi))) * share


def double_exact_db(a, b, c, h1, h2, wavelength_m):
    """The Fresnel integral over both half planes above the edges (L. E. Vogler, Radio Science 17, 1982, for two edges).

    A = C / pi * integral over x1, x2 > 0 of exp(2 s x1 x2 - x1^2 - x2^2 - 2 b1 x1 - 2 b2 x2); the one over x2 is a
    complementary error function. For edges on the straight line A = 1/4 + arcsin(s) / (2 pi).
    """
    k = 2 * np.pi / wavelength_m
    s = np.sqrt(a * c / ((a + b) * (b + c)))
    turn_1, turn_2 = h1 / a - (h2 - h1) / b, h2 / c + (h2 - h1) / b  # angles by which the path turns down at each edge
    b1 = turn_1 * np.sqrt(1j * k * a * b / (2 * (a + b)))
    b2 = turn_2 * np.sqrt(1j * k * b * c / (2 * (b + c)))
    if min(b1.real, b2.real) < -1e-9:
        raise ValueError("the integral is evaluated for paths that turn down at both edges")
    # It falls off as exp(-(1 - s^2) x^2), and oscillates where it is still large: pieces grow with x.
    nodes, weights = np.polynomial.legendre.leggauss(32)
    borders = np.concatenate([[0], np.geomspace(1e-4, 7, 100)]) / np.sqrt(1 - s * s)
    low, size = borders[:-1, None], np.diff(borders)[:, None]
    x, w = (low + size * (nodes + 1) / 2).ravel(), (size * weights / 2).ravel()
    # exp(-x^2 - 2 b1 x) w(i z) with z = b2 - s x. Where Re z < 0 the function of Faddeeva grows as exp(z^2), so it is
    # taken from the other side: w(i z) = 2 exp(z^2) - w(-i z), and all exponents are summed up before they are raised.
    z = b2 - s * x
    near = z.real >= 0
    exponent = -x * x - 2 * b1 * x
    ahead = np.exp(exponent) * wofz(1j * np.where(near, z, 1))
    behind = 2 * np.exp(np.where(near, -1, exponent + z * z)) - np.exp(exponent) * wofz(-1j * np.where(near, -1, z))
    values = np.where(near, ahead, behind)
    field = np.sqrt((1 - s * s) / np.pi) / 2 * (w * values).sum()
    return -20 * np.log10(abs(field))
