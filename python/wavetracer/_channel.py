# SPDX-License-Identifier: Apache-2.0
"""Impulse responses, frequency responses and taps of the links of a frame, in the shapes of sionna.rt.Paths."""
from __future__ import annotations

import os
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arguments import integer, number, numbers
from .errors import ConfigError

if TYPE_CHECKING:
    from .paths import Paths

Array = NDArray[Any]


def zeros(shape: tuple[int, ...], what: str) -> Array:
    """An array of complex zeros; if it exceeds the machine's memory, an error says how to ask for less."""
    size, memory = 16 * int(np.prod(shape, dtype=object)), os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    if size > memory // 2:
        raise MemoryError(f"{what} of shape {shape} takes {size / 1e9:.1f} GB: take some links alone, with "
                          "paths.select(tx=..., rx=...), or fewer times or frequencies")
    return np.zeros(shape, np.complex128)


class dense:
    """The place of each path in arrays with an axis for receivers, transmitters, and the paths of a link."""

    def __init__(self, paths: Paths):
        place = [np.zeros(len(all_ends), np.intp) for all_ends in (paths._ends.transmitters, paths._ends.receivers)]
        place[0][paths._tx], place[1][paths._rx] = np.arange(len(paths._tx)), np.arange(len(paths._rx))
        self.tx, self.rx = place[0][paths.tx], place[1][paths.rx]
        link = self.tx * len(paths._rx) + self.rx
        starts = np.flatnonzero(np.diff(link, prepend=-1))  # rows are sorted by link
        counts = np.diff(starts, append=len(link))
        self.begin, self.end = starts, starts + counts
        self.path = np.arange(len(link)) - np.repeat(starts, counts)
        self.shape = (len(paths._rx), len(paths._tx), int(counts.max(initial=0)))

    def of_links(self, column: Array, fill: float) -> Array:
        """An array (rx, tx, path), with `fill` where a link has fewer paths."""
        out = np.full(self.shape, fill, np.float64)
        out[self.rx, self.tx, self.path] = column
        return out

    def of_ports(self, column: Array, extra: tuple[int, ...] = ()) -> Array:
        """An array (rx, rx port, tx, tx port, path, ...) from a column (path, rx port, tx port, ...); 0 where there are
        fewer."""
        rx, tx, path = self.shape
        out = zeros((rx, column.shape[1], tx, column.shape[2], path, *extra), "the impulse response")
        # Indices that are not adjacent come first: (row, rx port, tx port, ...).
        out[self.rx, :, self.tx, :, self.path] = column
        return out


def _times(time_s: ArrayLike | None) -> Array:
    return np.zeros(1) if time_s is None else numbers(time_s, "time_s, in seconds within the frame")


def turns(cycles: Array) -> Array:
    """exp(j 2 pi cycles); whole turns are left out before the sine is taken."""
    return np.exp(2j * np.pi * (cycles - np.floor(cycles)))


def _delays(paths: Paths, places: dense, normalize_delays: bool) -> Array:
    delay = np.array(paths.delay_s)
    if normalize_delays and len(delay):
        first = np.minimum.reduceat(delay, places.begin)
        delay -= np.repeat(first, places.end - places.begin)
    return delay


class Antennas:
    """Coefficients and delays of paths between antennas: ports, and the elements of arrays where there are any."""

    def __init__(self, paths: Paths, places: dense, normalize_delays: bool):
        self.delay = _delays(paths, places, normalize_delays)  # between the centres, (path,)
        self.a = paths.a * turns(-paths.frequency_hz * self.delay)[:, None, None]  # (path, rx antenna, tx antenna)
        self.later: Array | None = None  # by how much a path is longer between antennas, seconds; of the same shape
        if paths._elements is None:
            return
        delay, amplitude = paths.elements()
        later = delay - paths.delay_s[:, None, None]
        moved = amplitude * turns(-paths.frequency_hz * later)
        rx, tx = self.a.shape[1:]
        # The antenna number is port * elements + element, as in Sionna RT.
        self.a = np.einsum("npq,nrt->nprqt", self.a, moved).reshape(len(moved), rx * moved.shape[1], tx * moved.shape[2])
        self.later = np.tile(later, (1, rx, tx))

    def at(self, paths: Paths, time_s: ArrayLike | None) -> Array:
        """(path, rx antenna, tx antenna, time): phases turn with the Doppler shifts."""
        return np.asarray(self.a[..., None] * turns(np.outer(paths.doppler_hz, _times(time_s)))[:, None, None, :])


def _reversed(h: Array, wanted: bool) -> Array:
    """Transmitters and receivers change places: (tx, tx port, rx, rx port, ...)."""
    return h.transpose(2, 3, 0, 1, *range(4, h.ndim)) if wanted else h


def _normalized(h: Array, energy: Array) -> Array:
    """Each link divided by the root of its energy (rx, tx); a link without any stays 0."""
    scale = np.divide(1, np.sqrt(energy), out=np.zeros_like(energy), where=energy > 0)
    return h * scale[:, None, :, None, None, None]


def cir(paths: Paths, time_s: ArrayLike | None, normalize_delays: bool, reverse: bool) -> tuple[Array, Array]:
    places = dense(paths)
    antennas = Antennas(paths, places, normalize_delays)
    turned = antennas.at(paths, time_s)
    a, tau = places.of_ports(turned, turned.shape[3:]), places.of_links(antennas.delay, -1)
    return _reversed(a, reverse), tau.transpose(1, 0, 2) if reverse else tau


def _summed(places: dense, antennas: Antennas, turned: Array, weights: Callable[[Array, Array], Array], values: Array,
            what: str) -> Array:
    """(rx, rx antenna, tx, tx antenna, time, value): the sum over the paths of each link of coefficients times
    weights(delays, values), which add an axis for values to the delays."""
    rx, tx, _ = places.shape
    shape = turned.shape[1:]
    out = zeros((rx, shape[0], tx, *shape[1:], len(values)), what)
    for begin, end in zip(places.begin, places.end):
        rows, delay = turned[begin:end], antennas.delay[begin:end]
        into = out[places.rx[begin], :, places.tx[begin]]
        if antennas.later is None:
            into[...] = (rows.reshape(end - begin, -1).T @ weights(delay, values)).reshape(*shape, len(values))
            continue
        between = delay[:, None, None] + antennas.later[begin:end]
        step = max(1, 2**22 // between.size)  # values at a time: the weights take 64 MB
        for first in range(0, len(values), step):
            w = weights(between, values[first:first + step])
            into[..., first:first + step] = np.einsum("nrtk,nrtv->rtkv", rows, w)
    return out


def cfr(paths: Paths, frequencies_hz: ArrayLike, time_s: ArrayLike | None, normalize_delays: bool, normalize: bool,
        reverse: bool) -> Array:
    frequencies = numbers(frequencies_hz, "frequencies_hz, in hertz relative to the carrier")
    places = dense(paths)
    antennas = Antennas(paths, places, normalize_delays)
    h = _summed(places, antennas, antennas.at(paths, time_s), lambda delay, f: turns(-delay[..., None] * f), frequencies,
                "the frequency response")
    if normalize:
        h = _normalized(h, (np.abs(h) ** 2).mean(axis=(1, 3, 4, 5)))
    return _reversed(h, reverse)


def taps(paths: Paths, bandwidth_hz: float, window: tuple[int, int], time_s: ArrayLike | None, normalize_delays: bool,
         normalize: bool, reverse: bool) -> Array:
    first, count = integer(window[0], "first"), integer(window[1], "count")
    bandwidth_hz = number(bandwidth_hz, "bandwidth_hz")
    if not bandwidth_hz > 0:
        raise ConfigError(f"bandwidth_hz is {bandwidth_hz}: give a number of hertz above 0")
    if count < 1:
        raise ConfigError(f"count is {count}: give at least one tap")
    places = dense(paths)
    antennas = Antennas(paths, places, normalize_delays)
    h = _summed(places, antennas, antennas.at(paths, time_s),
                lambda delay, tap: np.sinc(tap - bandwidth_hz * delay[..., None]),
                np.arange(first, first + count, dtype=float), "the taps")
    if normalize:
        h = _normalized(h, (np.abs(h) ** 2).sum(axis=-1).mean(axis=(1, 3, 4)))
    return _reversed(h, reverse)
