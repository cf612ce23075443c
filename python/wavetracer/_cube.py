# SPDX-License-Identifier: Apache-2.0
"""Range-Doppler cubes of a radar: beams and detections."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arguments import integer, number
from .errors import ConfigError

Array = NDArray[Any]
_SPEED_OF_LIGHT_M_S = 299792458.0


def _window(name: str, count: int) -> Array:
    """A window whose sum is 1, so that a wave keeps its amplitude."""
    cosines = {"none": (1.0, 0.0, 0.0), "hann": (0.5, 0.5, 0.0), "hamming": (0.54, 0.46, 0.0), "blackman": (0.42, 0.5, 0.08)}
    if name not in cosines:
        raise ConfigError(f"there is no window {name!r}; there are {', '.join(cosines)}")
    turn = 2 * np.pi * (np.arange(count) + 0.5) / count
    a, b, c = cosines[name]
    out = a - b * np.cos(turn) + c * np.cos(2 * turn)
    return np.asarray(out / out.sum())


def windowed(signal: Array, name: str, axis: int) -> Array:
    shape = [1] * signal.ndim
    shape[axis] = signal.shape[axis]
    return np.asarray(signal * _window(name, signal.shape[axis]).reshape(shape))


def _local_sum(values: Array, radius: tuple[int, int]) -> Array:
    """Sums over (2 r + 1) x (2 q + 1) cells about each: both axes are circles, as those of Fourier transforms."""
    out = values
    for axis, r in enumerate(radius):
        out = np.asarray(sum((np.roll(out, shift, axis) for shift in range(-r, r + 1)), np.zeros_like(out)))
    return out


@dataclass
class Cube:
    """values: roots of watts, complex of shape (rx antennas, tx antennas, Doppler shifts, delays). A path has its
    amplitude times the root of the power that is sent, in the cell of its delay and Doppler shift. left_out: how many
    paths were too long for the waveform. rx_offset_m, tx_offset_m: of each antenna from the position of its end, metres
    along the scene's axes, where the file has them."""

    values: Array
    delay_s: Array
    doppler_hz: Array
    frequency_hz: float
    left_out: int = 0
    rx_offset_m: Array | None = None
    tx_offset_m: Array | None = None

    @property
    def range_m(self) -> Array:
        """Half the length of a path of each delay: the distance of a target if both ends are in one place."""
        return self.delay_s * (_SPEED_OF_LIGHT_M_S / 2)

    @property
    def speed_m_s(self) -> Array:
        """The speed at which such a target comes nearer."""
        return self.doppler_hz * (_SPEED_OF_LIGHT_M_S / 2 / self.frequency_hz)

    @property
    def power_dbm(self) -> Array:
        """The range-Doppler map: the mean power over antennas, shape (Doppler shifts, delays)."""
        with np.errstate(divide="ignore"):
            return np.asarray(10 * np.log10((np.abs(self.values) ** 2).mean(axis=(0, 1))) + 30)

    def __repr__(self) -> str:
        rx, tx, shifts, delays = self.values.shape
        return (f"<wavetracer radar cube: {rx} x {tx} antennas, {shifts} Doppler shifts up to {self.doppler_hz[-1]:.0f} Hz, "
                f"{delays} ranges up to {self.range_m[-1]:.1f} m, {self.left_out} paths left out>")

    def beams(self, rx_offset_m: ArrayLike, tx_offset_m: ArrayLike, directions: ArrayLike) -> Array:
        """The range-Doppler-angle cube: complex of shape (directions, Doppler shifts, delays).

        Offsets: of each antenna from the centre of its array, shapes (rx antennas, 3) and (tx antennas, 3), metres along
        the scene's axes. directions: unit vectors towards targets, shape (directions, 3); both arrays look there."""
        look = np.atleast_2d(np.asarray(directions, float))
        wave_number = 2 * np.pi * self.frequency_hz / _SPEED_OF_LIGHT_M_S
        weights = []
        for offset, count, what in ((rx_offset_m, self.values.shape[0], "rx"), (tx_offset_m, self.values.shape[1], "tx")):
            places = np.asarray(offset, float)
            if places.shape != (count, 3) or look.shape[1] != 3:
                raise ConfigError(f"{what} offsets of shape {places.shape} and directions of shape {look.shape}: give "
                                  f"({count}, 3) and (directions, 3)")
            weights.append(np.exp(-1j * wave_number * look @ places.T) / count)
        return np.asarray(np.einsum("dr,dt,rtns->dns", *weights, self.values, optimize=True))

    def looking(self, directions: ArrayLike) -> Array:
        """beams() with the antennas of the file, so for cubes of a [[radar]]: the range-Doppler-angle cube."""
        if self.rx_offset_m is None or self.tx_offset_m is None:
            raise ConfigError("this cube does not know the places of its antennas, as those of a [[radar]] in radar.h5 do: "
                              "give them to beams()")
        return self.beams(self.rx_offset_m, self.tx_offset_m, directions)

    def detections(self, false_alarm: float = 1e-6, guard: int = 2, training: int = 6) -> dict[str, Array]:
        """Cells that are the largest of their neighbours and above the mean of the cells around them (cell-averaging
        CFAR): columns range_m, delay_s, speed_m_s, doppler_hz, power_dbm, threshold_dbm, by falling power.

        false_alarm: the probability for a cell of noise at one pair of antennas. The means are over a square of
        `training` cells to each side without those within `guard`. Ranges and shifts are those of a parabola through the
        peak and its neighbours in dB, and powers those of the cell."""
        guard, training = integer(guard, "guard"), integer(training, "training")
        shifts, delays = self.values.shape[2:]
        if not 0 <= guard < training or 2 * training + 1 > min(shifts, delays):
            raise ConfigError(f"guard {guard} and training {training}: give 0 or more, and more than that, within a map of "
                              f"{shifts} x {delays} cells")
        if not 0 < number(false_alarm, "false_alarm") < 1:
            raise ConfigError(f"false_alarm is {false_alarm}: give a probability between 0 and 1")
        power = (np.abs(self.values) ** 2).mean(axis=(0, 1))
        cells = (2 * training + 1) ** 2 - (2 * guard + 1) ** 2
        around = (_local_sum(power, (training, training)) - _local_sum(power, (guard, guard))) / cells
        threshold = np.maximum(around, 0) * cells * (false_alarm ** (-1 / cells) - 1)
        largest = np.ones_like(power, bool)
        for a in (-1, 0, 1):
            for b in (-1, 0, 1):
                if (a, b) != (0, 0):
                    largest &= power >= np.roll(power, (a, b), (0, 1))
        n, s = np.nonzero(largest & (power > threshold) & (power > 0))
        order = np.argsort(-power[n, s], kind="stable")
        n, s = n[order], s[order]
        delay = self.delay_s[s] + self._off_centre(power, n, s, 1) * (self.delay_s[1] - self.delay_s[0])
        doppler = self.doppler_hz[n] + self._off_centre(power, n, s, 0) * (self.doppler_hz[1] - self.doppler_hz[0])
        half_c = _SPEED_OF_LIGHT_M_S / 2
        return {"range_m": delay * half_c, "delay_s": delay, "speed_m_s": doppler * half_c / self.frequency_hz,
                "doppler_hz": doppler, "power_dbm": 10 * np.log10(power[n, s]) + 30,
                "threshold_dbm": 10 * np.log10(np.maximum(threshold[n, s], 1e-300)) + 30}

    @staticmethod
    def _off_centre(power: Array, n: Array, s: Array, axis: int) -> Array:
        """The place of the top of a parabola through a peak and both neighbours in dB, from -0.5 to 0.5 cells."""
        with np.errstate(divide="ignore"):
            level = np.log(np.maximum(power, 1e-300))
        before, here, after = (np.roll(level, shift, axis)[n, s] for shift in (1, 0, -1))
        bend = before - 2 * here + after
        return np.asarray(np.divide(0.5 * (before - after), bend, out=np.zeros(len(n)), where=bend < 0))
