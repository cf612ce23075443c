# SPDX-License-Identifier: Apache-2.0
"""The field around a lossy body in the plane, from integral equations over its boundary (Mueller's formulation, which no
resonance disturbs), by Nystroem's method: the trapezoidal rule with the correction of the zeta function for logarithms.

The body is a closed polygon, or a profile whose first and last legs go on for ever and are faded out where nothing comes
back from ("windowed Green functions", O. Bruno): then the other edges of a real body are not there to disturb.

Lengths are metres, k is the wave number in rad/m, epsilon the relative permittivity (negative imaginary part: losses), time
goes as exp(+j omega t). Wave H has the electric field along the axis, V the magnetic field.
"""
import numpy as np
from scipy.linalg import lu_factor, lu_solve
from scipy.special import hankel2, j0, j1, jv, y0, y1

EULER = 0.5772156649015329
ZETA_2 = -0.030448457058393  # the derivative of Riemann's zeta at -2
GRADED = 24  # points over which the spacing grows from a corner


class Boundary:
    """Points, normals (to the outside, for corners that run counter-clockwise), weights and the window of a profile."""

    def __init__(self, corners, spacing, fade=0.0):
        corners = np.asarray(corners, float)
        sides = list(zip(corners[:-1], corners[1:])) if fade else list(zip(corners, np.roll(corners, -1, axis=0)))
        parts = [self.side(a, b, spacing, fade > 0 and i == 0, fade > 0 and i == len(sides) - 1)
                 for i, (a, b) in enumerate(sides)]
        self.at = np.concatenate([p[0] for p in parts])
        self.normal = np.concatenate([p[1] for p in parts])
        self.weight = np.concatenate([p[2] for p in parts])
        self.side_of = np.repeat(np.arange(len(parts)), [len(p[2]) for p in parts])
        self.bend = 0.0  # bend of the boundary, in 1/m
        self.window = np.ones(len(self.weight))
        if fade:
            for end in (corners[0], corners[-1]):
                x = np.clip(np.linalg.norm(self.at - end, axis=1) / fade, 1e-9, 1)
                self.window *= np.where(x < 1, 1 / (1 + np.exp(np.clip(1 / x - 1 / (1 - x + 1e-12), -500, 500))), 1)

    @staticmethod
    def side(a, b, spacing, open_start, open_end):
        """Points of one side: their distances grow as a sine squared from each corner, and are even elsewhere."""
        length = np.linalg.norm(b - a)
        corners = (not open_start) + (not open_end)
        count = int(np.ceil(length / spacing + corners * GRADED / 2))
        count = max(count, 2 * GRADED)
        u = np.arange(count) + 0.5

        def from_corner(v):
            return np.where(v < GRADED, v / 2 - GRADED / (2 * np.pi) * np.sin(np.pi * v / GRADED), v - GRADED / 2)

        def speed(v):
            return np.where(v < GRADED, np.sin(np.pi * v / (2 * GRADED)) ** 2, 1.0)

        whole = count - corners * GRADED / 2
        low, high = (v if is_open else from_corner(v) for v, is_open in ((u, open_start), (count - u, open_end)))
        slow, fast = (np.ones(count) if is_open else speed(v) for v, is_open in ((u, open_start), (count - u, open_end)))
        from_start = u < count / 2
        place = np.where(from_start, low, whole - high) * length / whole
        weight = np.where(from_start, slow, fast) * length / whole
        along_side = (b - a) / length
        normal = np.tile([along_side[1], -along_side[0]], (count, 1))
        return a + place[:, None] * along_side, normal, weight


def hankels(z):
    """Both Hankel functions of the second kind, of orders 0 and 1."""
    if np.isrealobj(z):
        return j0(z) - 1j * y0(z), j1(z) - 1j * y1(z)
    far = -z.imag > 45
    safe = np.where(far, 1, z)
    return np.where(far, 0, hankel2(0, safe)), np.where(far, 0, hankel2(1, safe))


def kernels(b, k, rows):
    """G, dG/dn', dG/dn and d2G/dn dn' from all points to those of `rows`, without weights; 0 where they meet."""
    d = b.at[rows, None, :] - b.at[None, :, :]
    r = np.sqrt((d * d).sum(-1))
    meets = r == 0
    r[meets] = 1
    zero, one = hankels(k * r)
    g, slope = -0.25j * zero, 0.25j * k * one
    to = (d * b.normal[rows][:, None, :]).sum(-1) / r
    fro = (d * b.normal[None, :, :]).sum(-1) / r
    curve = -k * k * g - slope / r
    both = -(curve * to * fro + slope / r * (b.normal[rows] @ b.normal.T - to * fro))
    out = [g, -slope * fro, slope * to, both]
    for x in out:
        x[meets] = 0
    return out


def log_parts(k, r):
    """The factor of the logarithm of r in G and, on one straight side, in d2G/dn dn' less 1 / (2 pi r^2)."""
    half = np.where(r > 0, k * r / 2, 1)
    return -jv(0, k * r) / (2 * np.pi), -k * k / (4 * np.pi) * np.where(r > 0, jv(1, 2 * half) / half, 1)


def correct(matrix, b, log, rest):
    """Adds what the trapezoidal rule lacks at and beside a logarithm: log(r) times it, and `rest` beside it at r = 0."""
    n, w = len(b.weight), b.weight
    i = np.arange(n)
    matrix[i, i] += w * (rest + log(np.zeros(1)) * (np.log(w / (2 * np.pi)) - 2 * ZETA_2))
    for step in (-1, 1):
        j = i + step
        fits = (j >= 0) & (j < n)
        fits[fits] &= b.side_of[i[fits]] == b.side_of[j[fits]]
        row, column = i[fits], j[fits]
        matrix[row, column] += ZETA_2 * w[column] * log(np.linalg.norm(b.at[row] - b.at[column], axis=1))


def operators(b, k, batch=200):
    """The operators of the four kernels, with weights; of the last without 1 / (2 pi r^2), where points meet on a side."""
    n = len(b.weight)
    out = [np.empty((n, n), complex) for _ in range(4)]
    for start in range(0, n, batch):
        rows = np.arange(start, min(n, start + batch))
        for matrix, part in zip(out, kernels(b, k, rows)):
            matrix[rows] = part * b.weight
    common = np.log(k / 2) + EULER
    correct(out[0], b, lambda r: log_parts(k, r)[0], -common / (2 * np.pi) - 0.25j)
    correct(out[3], b, lambda r: log_parts(k, r)[1], -k * k / (4 * np.pi) * (common - 0.5) - 0.125j * k * k)
    for matrix in out[1:3]:
        matrix[np.arange(n), np.arange(n)] -= b.weight * b.bend / (4 * np.pi)
    return out


def fields(b, k, epsilon, wave, sources, ends):
    """The field over free space at ends[i] of sources[i], of a body with this permittivity."""
    n, w = len(b.weight), b.window
    f = epsilon if wave == "V" else 1.0
    s1, k1, d1, t1 = operators(b, k)
    s2, k2, d2, t2 = operators(b, k * np.sqrt(epsilon + 0j))
    system = np.block([[-(k1 - k2) * w, (s1 - f * s2) * w * k], [-(t1 - t2) * w / k, (d1 - f * d2) * w]])
    del s1, s2, k1, k2, d1, d2, t1, t2
    i = np.arange(n)
    system[i, i] += 1
    system[n + i, n + i] += (1 + f) / 2
    places, which = np.unique(np.asarray(sources, float), axis=0, return_inverse=True)
    right = np.stack([np.concatenate(incident(b, k, place)) for place in places], axis=1)
    found = lu_solve(lu_factor(system, overwrite_a=True, check_finite=False), right, check_finite=False)
    return np.array([seen(b, k, found[:n, i], found[n:, i], places[i], end) for i, end in zip(which.ravel(), ends)])


def conductor_fields(b, k, wave, sources, ends):
    """The same of a perfect conductor: two equations are added, so that no resonance disturbs, and for V the second one is
    smoothed by the operator S of an evanescent wave, whose product with T is K^2 - 1/4 (O. Bruno)."""
    n, w = len(b.weight), b.window
    i = np.arange(n)
    s1, k1, d1, t1 = operators(b, k)
    places, which = np.unique(np.asarray(sources, float), axis=0, return_inverse=True)
    waves, slopes = (np.stack(part, axis=1) for part in zip(*(incident(b, k, place) for place in places)))
    if wave == "H":
        system, right = (d1 / k + 1j * s1) * w * k, slopes + 1j * waves
        system[i, i] += 0.5
    else:
        s2, k2, _, t2 = operators(b, -1j * k)
        system, right = -k1 * w - 1j * (s2 @ ((t1 - t2) * w) + k2 @ (k2 * w)), waves + 1j * k * (s2 @ slopes)
        system[i, i] += 0.5 + 0.25j * w
    found = lu_solve(lu_factor(system), right)
    u, q = (found, 0 * found) if wave == "V" else (0 * found, found)
    return np.array([seen(b, k, u[:, i], q[:, i], places[i], end) for i, end in zip(which.ravel(), ends)])


def seen(b, k, u, q, place, end):
    """The field at `end` over that of the source alone, from the boundary's field u and slope k q."""
    d = np.asarray(end, float) - b.at
    r = np.sqrt((d * d).sum(-1))
    zero, one = hankels(k * r)
    double = -0.25j * k * one * (d * b.normal).sum(-1) / r * u
    scattered = ((double + 0.25j * k * zero * q) * b.window * b.weight).sum()
    return 1 + scattered / (-0.25j * hankels(k * np.linalg.norm(end - place))[0])


def incident(b, k, place):
    """The source's field on the boundary, and its slope along the normal over k."""
    d = b.at - place
    r = np.sqrt((d * d).sum(-1))
    zero, one = hankels(k * r)
    return -0.25j * zero, 0.25j * one * (d * b.normal).sum(-1) / r
