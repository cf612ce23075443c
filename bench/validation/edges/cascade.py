# SPDX-License-Identifier: Apache-2.0
"""The field behind screens in a row: the Fresnel integral over the half planes above their edges (L. E. Vogler, Radio
Science 17, 1982), to about 1e-9 of the largest term.

Heights and distances are metres, k is the wave number in rad/m, time goes as exp(+j omega t). Fields are over free space.

The integral over one plane after the other is taken along y = edge + t exp(-j pi/4), where waves fall off instead of
oscillating. That holds where the taut string from end to end bends over the edge. Where the string passes a plane without
touching its edge, the half plane is the whole plane (which is free space) less the other half, and over that other half the
string bends. So the field is a sum over such choices, and no term of it is large.
"""
import numpy as np

NODES, WEIGHTS = np.polynomial.legendre.leggauss(16)


def contour(longest, finest):
    """Nodes and weights of 0 to `longest`: panels grow from a hundredth of `finest`, and are not larger than `finest`."""
    borders = [0.0, finest / 100]
    while borders[-1] < longest:
        borders.append(borders[-1] + min(finest, 0.7 * borders[-1]))
    low, size = np.array(borders[:-1])[:, None], np.diff(borders)[:, None]
    return (low + size * (NODES + 1) / 2).ravel(), (size * WEIGHTS / 2).ravel()


def taut(x, low, high):
    """Heights of the shortest string through the gates low..high at x; the first and the last gate are points."""
    y, at, last = np.full(len(x), low[0]), 0, len(x) - 1
    while at < last:
        least, most, floor, ceiling, to = -np.inf, np.inf, at, at, None
        for i in range(at + 1, last + 1):
            rise_low, rise_high = (low[i] - y[at]) / (x[i] - x[at]), (high[i] - y[at]) / (x[i] - x[at])
            if rise_low > most or rise_high < least:
                to, end = (ceiling, high[ceiling]) if rise_low > most else (floor, low[floor])
                break
            if rise_low >= least:
                least, floor = rise_low, i
            if rise_high <= most:
                most, ceiling = rise_high, i
        if to is None:
            to, end = last, low[last]
        y[at:to + 1] = y[at] + (end - y[at]) * (x[at:to + 1] - x[at]) / (x[to] - x[at])
        at = to
    return y


def over_touched(places, heights, sides, ends, k):
    """The integral where the taut string touches every edge, which is then the string itself."""
    x, y = np.concatenate([[0.0], places, [ends[2]]]), np.concatenate([[ends[0]], heights, [ends[1]]])
    step, rise = np.diff(x), np.diff(y)
    turn = sides * (rise[:-1] / step[:-1] - rise[1:] / step[1:])
    longest = 9.0 * np.sqrt(ends[2] / k)
    t, weight = contour(longest, 1.6 * np.sqrt(min(step) / k))
    falls = [np.exp(-k * max(b, 0.0) * t * (1 + 1j) / np.sqrt(2)) * weight for b in turn]
    field = np.exp(-k / 2 / step[0] * t * t)
    for i in range(len(places)):
        field = field * falls[i]
        if i + 1 < len(places):
            apart = sides[i] * t[None, :] - sides[i + 1] * t[:, None]
            field = np.exp(-k / 2 / step[i + 1] * apart * apart) @ field
    total = (field * np.exp(-k / 2 / step[-1] * t * t)).sum()
    longer = (rise * rise / step).sum() / 2 - (ends[1] - ends[0]) ** 2 / (2 * ends[2])
    return total * np.sqrt(ends[2] / step.prod() * (k / (2 * np.pi)) ** len(places)) * np.exp(-1j * k * longer)


def screens(places, heights, ends, k, sides=None):
    """The field over free space at (ends[2], ends[1]) of a source at (0, ends[0]), behind screens at `places`, which reach
    from below up to `heights`; `sides` of -1 are screens that reach down from above."""
    places, heights = np.asarray(places, float), np.asarray(heights, float)
    sides = np.ones(len(places)) if sides is None else np.asarray(sides, float)
    if not len(places):
        return 1.0 + 0j
    low, high = np.where(sides > 0, heights, -np.inf), np.where(sides > 0, np.inf, heights)
    string = taut(np.r_[0.0, places, ends[2]], np.r_[ends[0], low, ends[1]], np.r_[ends[0], high, ends[1]])[1:-1]
    passes = np.flatnonzero(np.abs(string - heights) > 1e-12 * (1 + np.abs(heights)))
    if not len(passes):
        return over_touched(places, heights, sides, ends, k)
    one = passes[np.argmax(np.abs(string - heights)[passes])]
    rest, other = np.arange(len(places)) != one, sides.copy()
    other[one] = -other[one]
    return screens(places[rest], heights[rest], ends, k, sides[rest]) - screens(places, heights, ends, k, other)
