#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The references of bench/validation/edges against closed forms and values that others have computed.

Usage: edges_test.py FOLDER; FOLDER is bench/validation. Exits with 77 without numpy and scipy. No device is used.
"""
import pathlib
import sys

sys.path[:0] = [sys.argv[1], str(pathlib.Path(sys.argv[1]) / "edges")]
try:
    import numpy as np
    from scipy.special import h2vp, hankel2, jv, jvp

    import boundary
    import cascade
    import p526
    import roof
except ImportError as error:
    if error.name in ("numpy", "scipy"):
        sys.exit(77)
    raise

K = 2 * np.pi * 5.9e9 / 299792458.0


def loss_db(field):
    return -20 * np.log10(abs(field))


def check_screens():
    for count in range(1, 9):  # L. E. Vogler: edges on the line, evenly spaced
        field = cascade.screens(np.arange(1, count + 1) * 20.0, np.zeros(count), (0, 0, 20.0 * (count + 1)), K)
        assert abs(field * (count + 1) - 1) < 1e-9, (count, field)
    for nu in (-3.0, -0.1, 0.0, 0.5, 20.0):
        height = nu / p526.nu_of(1, 50, 30, 2 * np.pi / K)
        assert abs(loss_db(cascade.screens([50.0], [height], (0, 0, 80.0), K)) - p526.single_exact_db(nu)) < 1e-6, nu
    for heights in ((1.0, 1.05), (0.0, 0.0), (2.0, 2.01)):
        ours = loss_db(cascade.screens([100.0, 120.0], heights, (0, 0, 220.0), K))
        assert abs(ours - p526.double_exact_db(100, 20, 100, *heights, 2 * np.pi / K)) < 1e-6, heights
    places, heights = np.array([12.0, 30.0, 41.0, 77.0]), np.array([0.3, -0.8, 0.9, -0.2])
    four = cascade.screens(places, heights, (0.1, -0.4, 90.0), K)
    deep = cascade.screens(np.r_[places, 80.0], np.r_[heights, -300.0], (0.1, -0.4, 90.0), K)
    back = cascade.screens((90 - places)[::-1], heights[::-1], (-0.4, 0.1, 90.0), K)
    assert abs(deep - four) < 1e-3 * abs(four) and abs(back - four) < 1e-9, (four, deep, back)
    assert abs(four - summed(places, heights, (0.1, -0.4, 90.0))) < 2e-3, (four, summed(places, heights, (0.1, -0.4, 90.0)))


def summed(places, heights, ends):
    """The same integral by brute force: sums over heights with a soft end far above, along the real axis."""
    z = np.arange(-32, 32, 0.004)
    soft = np.where(z < 4, 1, np.cos(np.pi / 2 * np.clip((z - 4) / 4, 0, 1)) ** 2)
    spatial = 2 * np.pi * np.fft.fftfreq(len(z), 0.004)
    steps = np.diff(np.r_[0.0, places, ends[2]])
    wave = np.exp(-0.5j * K * (z - ends[0]) ** 2 / steps[0]) * np.sqrt(1j * K / (2 * np.pi * steps[0]))
    for i, height in enumerate(heights):
        wave = wave * soft * np.clip((z - height) / 0.004 + 0.5, 0, 1)
        if i + 1 < len(heights):
            wave = np.fft.ifft(np.fft.fft(wave) * np.exp(0.5j * spatial**2 * steps[i + 1] / K))
    last = np.exp(-0.5j * K * (z - ends[1]) ** 2 / steps[-1]) * np.sqrt(1j * K / (2 * np.pi * steps[-1]))
    free = np.exp(-0.5j * K * (ends[1] - ends[0]) ** 2 / ends[2]) * np.sqrt(1j * K / (2 * np.pi * ends[2]))
    return (wave * last).sum() * 0.004 / free


def check_roof():
    # Widths, half distances and depths of the ends, and the losses of a split-step solution of the paraxial equation.
    for width, half, depth, hard, soft in ((10, 20, 0, 6.0, 13.8), (10, 20, 0.5, 16.3, 29.4), (10, 20, 2, 34.5, 62.0),
                                           (0.1, 5, 0.5, 19.2, 22.9), (0.01, 5, 0.5, 19.0, 20.2)):
        for wave, known in ((True, hard), (False, soft)):
            ours = loss_db(roof.roof(half - width / 2, width, half - width / 2, (-depth, -depth), K, wave))
            assert abs(ours - known) < 0.06, (width, depth, wave, ours)
    for depths in ((-0.5, -1.0), (0.3, -0.2), (0.2, 0.2)):  # no roof to speak of: one screen
        field = [roof.roof(9.0, 1e-7, 14.0, depths, K, wave) for wave in (True, False)]
        one = cascade.screens([9.0], [0.0], (*depths, 23.0), K)
        assert max(abs(f - one) for f in field) < 1e-3, (depths, field, one)
    there, back = roof.roof(9.0, 2.0, 14.0, (0.3, -0.4), K, False), roof.roof(14.0, 2.0, 9.0, (-0.4, 0.3), K, False)
    assert abs(there - back) < 1e-9, (there, back)


def cylinder(k, epsilon, wave, radius, source, end):
    """The field over free space beside a cylinder around the origin: the series of its waves."""
    m = np.arange(-60, 61)
    if epsilon is None:  # a perfect conductor
        slope, value = (0, 1) if wave == "V" else (1, 0)
    else:
        inside, factor = k * np.sqrt(epsilon), epsilon if wave == "V" else 1
        slope, value = inside * jvp(m, inside * radius), factor * k * jv(m, inside * radius)
    scattered = -((slope * jv(m, k * radius) - value * jvp(m, k * radius)) /
                  (slope * hankel2(m, k * radius) - value * h2vp(m, k * radius)))
    turn = np.exp(1j * m * (np.arctan2(end[1], end[0]) - np.arctan2(source[1], source[0])))
    waves = scattered * hankel2(m, k * np.hypot(*source)) * hankel2(m, k * np.hypot(*end)) * turn
    return 1 + waves.sum() / hankel2(0, k * np.hypot(*np.subtract(end, source)))


def check_boundary():
    k, radius = 2 * np.pi, 1.5
    turn = np.linspace(0, 2 * np.pi, 300, endpoint=False)
    circle = boundary.Boundary.__new__(boundary.Boundary)
    circle.normal = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    circle.at, circle.weight, circle.bend = radius * circle.normal, np.full(300, 2 * np.pi * radius / 300), 1 / radius
    circle.side_of, circle.window = np.zeros(300, int), np.ones(300)
    source, ends = (6.0, 0.0), ((-6.0, 0.5), (0.0, 4.0), (3.0, 3.0))
    for epsilon in (5.24 - 0.8j, 6.3 + 0j, None):
        for wave in "VH":
            ours = boundary.fields(circle, k, epsilon, wave, [source] * 3, ends) if epsilon else (
                boundary.conductor_fields(circle, k, wave, [source] * 3, ends))
            known = [cylinder(k, epsilon, wave, radius, source, end) for end in ends]
            assert np.abs(ours - known).max() < 1e-3, (epsilon, wave, ours, known)
    # A wall without end is a mirror with the coefficient of Fresnel, and its window leaves that alone.
    wall = boundary.Boundary([(25, 0), (-25, 0)], 1 / 16, 12.0)
    for wave in "VH":
        ours = boundary.fields(wall, k, 5.24 - 0.8j, wave, [(-6.0, 6.0)], [(6.0, 6.0)])[0]
        sine, root = np.sqrt(0.5), np.sqrt(5.24 - 0.8j - 0.5)
        factor = 5.24 - 0.8j if wave == "V" else 1
        echo = (factor * sine - root) / (factor * sine + root) * hankel2(0, k * np.hypot(12, 12)) / hankel2(0, k * 12)
        assert abs(ours - 1 - echo) < 0.01, (wave, ours, 1 + echo)


check_screens()
check_roof()
check_boundary()
