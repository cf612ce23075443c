#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Channels of made-up paths: cir, cfr and taps against loops over the formulas of docs/python.md, and against closed
forms. No device is used.

Usage: channel_test.py. Exits with 77 without numpy.
"""
import sys

try:
    import numpy as np
except ImportError:
    sys.exit(77)
import wavetracer
from wavetracer.links import Ends
from wavetracer.paths import Paths

CARRIER, TX, RX = 5.9e9, ("t0", "t1", "t2"), ("r0", "r1")
PER_LINK = {(0, 0): 3, (0, 1): 1, (2, 1): 5}  # (tx, rx): paths; t1 reaches nobody


def made(ports=(2, 1), seed=1):
    """Paths with random columns, sorted as the library sorts them."""
    random = np.random.default_rng(seed)
    tx, rx = np.array([link for link, count in sorted(PER_LINK.items()) for _ in range(count)], np.uint32).T
    delay = np.concatenate([np.sort(random.uniform(1e-7, 3e-6, count)) for _, count in sorted(PER_LINK.items())])
    n = len(tx)
    a = random.normal(size=(n, *ports)) + 1j * random.normal(size=(n, *ports))
    columns = {"tx": tx, "rx": rx, "delay_s": delay, "a": a, "doppler_hz": random.uniform(-900, 900, n),
               "depth": np.zeros(n, np.uint32), "vertex_offset": np.zeros(n + 1, np.uint64),
               "vertex_interaction": np.zeros(0, np.uint8), "vertex_position_m": np.zeros((0, 3))}
    return Paths(columns.__getitem__, Ends(TX, RX, CARRIER))


def check_order_of_names():
    """Ends stand on the axes as they are given to select, not as in the list of all."""
    paths = made()
    whole, tau = paths.cir()
    turned = paths.select(tx=["t2", "t0"], rx=["r1", "r0"])
    assert turned.transmitters == ["t2", "t0"] and turned.receivers == ["r1", "r0"]
    a, delays = turned.cir()
    assert np.array_equal(a, whole[::-1][:, :, [2, 0]]) and np.array_equal(delays, tau[::-1][:, [2, 0]])
    again = turned.select(rx="r*")  # a pattern has the order of the list, and what is not named stays as it was
    assert again.transmitters == ["t2", "t0"] and again.receivers == ["r0", "r1"]
    assert turned.select(tx="t0").cir()[0].shape[0] == 2 and turned.select(tx="t0").receivers == ["r1", "r0"]


def loop(paths, time_s, normalize_delays):
    """(rx, rx port, tx, tx port) -> list of (a at each time, tau), path by path."""
    out = {}
    for i in range(len(paths)):
        same = (paths.tx == paths.tx[i]) & (paths.rx == paths.rx[i])
        tau = paths.delay_s[i] - (paths.delay_s[same].min() if normalize_delays else 0)
        for p in range(paths.a.shape[1]):
            for q in range(paths.a.shape[2]):
                a = [paths.a[i, p, q] * np.exp(-2j * np.pi * CARRIER * tau) * np.exp(2j * np.pi * paths.doppler_hz[i] * t)
                     for t in time_s]
                out.setdefault((paths.rx[i], p, paths.tx[i], q), []).append((np.array(a), tau))
    return out


def close(got, wanted):
    np.testing.assert_allclose(got, wanted, rtol=0, atol=1e-9 * max(1, np.abs(wanted).max(initial=0)))


def check_formulas(paths, normalize_delays):
    time_s, frequencies = np.array([0, 1e-3, 2.5e-3]), np.linspace(-10e6, 10e6, 7)
    expected = loop(paths, time_s, normalize_delays)
    a, tau = paths.cir(time_s, normalize_delays=normalize_delays)
    ports = paths.a.shape[1:]
    assert a.shape == (2, ports[0], 3, ports[1], 5, 3) and tau.shape == (2, 3, 5)
    h = paths.cfr(frequencies, time_s, normalize_delays=normalize_delays)
    assert h.shape == (2, ports[0], 3, ports[1], 3, 7)
    g = paths.taps(20e6, 9, first=-4, time_s=time_s, normalize_delays=normalize_delays)
    assert g.shape == (2, ports[0], 3, ports[1], 3, 9)
    for r in range(2):
        for t in range(3):
            for p in range(ports[0]):
                for q in range(ports[1]):
                    rows = expected.get((r, p, t, q), [])
                    for i in range(5):
                        close(a[r, p, t, q, i], rows[i][0] if i < len(rows) else np.zeros(3))
                        assert abs(tau[r, t, i] - (rows[i][1] if i < len(rows) else -1)) < 1e-18
                    close(h[r, p, t, q], sum((np.outer(c, np.exp(-2j * np.pi * frequencies * d)) for c, d in rows),
                                             np.zeros((3, 7))))
                    close(g[r, p, t, q], sum((np.outer(c, np.sinc(np.arange(-4, 5) - 20e6 * d)) for c, d in rows),
                                             np.zeros((3, 9))))


def check_options(paths):
    a, tau = paths.cir()
    back, back_tau = paths.cir(reverse_direction=True)
    assert np.array_equal(back, a.transpose(2, 3, 0, 1, 4, 5)) and np.array_equal(back_tau, tau.transpose(1, 0, 2))
    assert a.shape[-1] == 1 and np.array_equal(paths.cir(0.0)[0], a)
    h = paths.cfr([0, 1e6, 2e6], [0, 1e-3], normalize=True)
    g = paths.taps(10e6, 50, first=-10, normalize=True)
    for r in range(2):
        for t in range(3):
            there = (t, r) in PER_LINK
            assert abs((np.abs(h[r, :, t]) ** 2).mean() - there) < 1e-12
            assert abs((np.abs(g[r, :, t]) ** 2).sum(-1).mean() - there) < 1e-12
    assert np.array_equal(paths.cfr([0, 1e6], reverse_direction=True), paths.cfr([0, 1e6]).transpose(2, 3, 0, 1, 4, 5))
    some = paths.select(tx="t2", rx=1)
    assert np.array_equal(some.cir()[0], a[1:, :, 2:]) and some.cir()[1].shape == (1, 1, 5)
    none = paths.select(tx="t1")
    assert none.cir()[0].shape == (2, 2, 1, 1, 0, 1) and none.cir()[1].shape == (2, 1, 0)
    assert not none.cfr([0, 1]).any() and none.cfr([0, 1]).shape == (2, 2, 1, 1, 1, 2)
    assert none.taps(1e6, 3).shape == (2, 2, 1, 1, 1, 3)
    for wrong in (lambda: paths.taps(0, 3), lambda: paths.taps(1e6, 0), lambda: paths.cfr([np.nan]),
                  lambda: paths.cir([[0.0]])):
        try:
            wrong()
        except wavetracer.ConfigError as error:
            assert "give" in str(error)
        else:
            raise AssertionError("taken")
    try:
        paths.cfr(np.zeros(10**6), np.zeros(10**6))
    except MemoryError as error:
        assert "paths.select" in str(error)
    else:
        raise AssertionError("a response of terabytes")


def check_closed_forms():
    """One path: |H| is flat, its phase falls by 2 pi tau a hertz, and its taps at a whole delay are one tap."""
    tau = 5 / 20e6
    columns = {"tx": np.zeros(1, np.uint32), "rx": np.zeros(1, np.uint32), "delay_s": np.array([tau]),
               "a": np.full((1, 1, 1), 0.5 + 0j), "doppler_hz": np.array([100.0])}
    paths = Paths(columns.__getitem__, Ends(("t",), ("r",), CARRIER))
    frequencies = np.linspace(-10e6, 10e6, 21)
    h = paths.cfr(frequencies, normalize_delays=False)[0, 0, 0, 0, 0]
    close(h, 0.5 * np.exp(-2j * np.pi * (CARRIER + frequencies) * tau))
    close(np.abs(paths.taps(20e6, 10, normalize_delays=False)[0, 0, 0, 0, 0]), 0.5 * (np.arange(10) == 5))
    # A quarter of a turn of the Doppler shift after 2.5 ms.
    a = paths.cir([0, 2.5e-3])[0][0, 0, 0, 0, 0]
    close(a[1] / a[0], 1j)


for shape in ((1, 1), (2, 1), (1, 2), (2, 2), (4, 8)):
    for normalized in (True, False):
        check_formulas(made(shape), normalized)
check_options(made())
check_closed_forms()
check_order_of_names()
print("channels ok")
