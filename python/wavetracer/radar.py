# SPDX-License-Identifier: Apache-2.0
"""FMCW radar: beat signals of paths, range-Doppler-angle cubes, detections, and spectrograms (docs/radar.md).

`python3 -m wavetracer.radar RUN ...` makes the cubes of a saved run.
"""
from __future__ import annotations

import csv
import os
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _channel, _program, _radar_config
from ._arguments import integer, number
from ._cube import Cube, windowed
from ._radar_file import load, names, save
from ._radar_osi import write_osi
from .errors import ConfigError
from .paths import Paths

__all__ = ["Cube", "Motion", "Waveform", "beat", "beat_of_echoes", "beat_of_points", "cube", "cube_of", "echoes", "load", "names", "save", "spectrogram",
           "waveform_of", "wheel", "write_osi"]

Array = NDArray[Any]
SPEED_OF_LIGHT_M_S = 299792458.0
_BOLTZMANN_J_K, _ROOM_K = 1.380649e-23, 290.0
# Positions of points at a time in seconds, shape (points, 3), metres.
Motion = Callable[[float], Array]


@dataclass(frozen=True)
class Waveform:
    """Linear chirps: the frequency rises by bandwidth_hz in chirp_s, about the carrier as its middle, and a chirp begins
    every interval_s (None: at the end of the one before). Each has `samples` complex samples.

    turns: the antennas of the transmitter send chirps in turns, each `chirps` of them; else all are told apart by codes
    and send at a time. noise_figure_db: None is a receiver without noise; else noise of 290 K at this figure, drawn from
    `seed`.
    """

    bandwidth_hz: float
    chirp_s: float
    chirps: int = 128
    samples: int = 256
    interval_s: float | None = None
    power_dbm: float = 10.0
    noise_figure_db: float | None = None
    seed: int = 0
    turns: bool = False

    def __post_init__(self) -> None:
        for name in ("bandwidth_hz", "chirp_s"):
            if not number(getattr(self, name), name) > 0:
                raise ConfigError(f"{name} of a radar is {getattr(self, name)}: give a number above 0")
        for name in ("chirps", "samples"):
            if integer(getattr(self, name), name) < 2:
                raise ConfigError(f"{name} of a radar is {getattr(self, name)}: give 2 or more")
        if self.interval_s is not None and not number(self.interval_s, "interval_s") >= self.chirp_s:
            raise ConfigError(f"interval_s of a radar is {self.interval_s}, shorter than a chirp of {self.chirp_s} s: give "
                              "at least chirp_s")
        if self.longest_delay_s > self.chirp_s:
            raise ConfigError(f"samples of a radar are {self.samples} and bandwidth_hz is {self.bandwidth_hz:g}, so it would "
                              f"hear echoes up to {self.longest_delay_s:g} s late, longer than its chirp, chirp_s = "
                              f"{self.chirp_s:g}: give fewer samples, a larger bandwidth_hz, or a longer chirp_s")
        number(self.power_dbm, "power_dbm")
        if self.noise_figure_db is not None:
            number(self.noise_figure_db, "noise_figure_db")

    @property
    def spacing_s(self) -> float:
        """The time from a chirp to the next one."""
        return self.chirp_s if self.interval_s is None else self.interval_s

    @property
    def longest_delay_s(self) -> float:
        """The receiver's filter keeps paths that are shorter: later ones would beat faster than it samples."""
        return self.samples / self.bandwidth_hz

    def repetition_s(self, tx_antennas: int) -> float:
        """The time from a chirp of an antenna to its next one."""
        return self.spacing_s * (tx_antennas if self.turns else 1)


def waveform_of(config: str, name: str | None = None) -> Waveform:
    """The waveform of a [[radar]] in the text of a run's configuration (run.config): that of this name, or the only one.
    Noise is drawn otherwise than in the run, so that it has the same power and other values."""
    table = _radar_config.chosen(config, name)
    if table is None:
        raise ConfigError("the run has no [[radar]]: make a Waveform, or add the table to the configuration")
    keys = ("bandwidth_hz", "chirp_s", "chirps", "samples", "interval_s", "noise_figure_db", "seed", "turns")
    return Waveform(power_dbm=_radar_config.power_dbm(config, table), **{key: table[key] for key in keys if key in table})


def _phases(waveform: Waveform, carrier_hz: float, delay_s: Array, rate: Array) -> Array:
    """exp(j phase) of the beat signal, shape (..., samples), for delays at the beginnings of chirps and their changes in
    seconds per second. The received chirp, mixed with the one that is sent, has the phase -2 pi f tau + pi slope tau^2, f
    the frequency that is sent at the time of the sample."""
    time_s = np.arange(waveform.samples) * (waveform.chirp_s / waveform.samples)
    slope = waveform.bandwidth_hz / waveform.chirp_s
    sent_hz = carrier_hz - waveform.bandwidth_hz / 2 + slope * time_s
    tau = delay_s[..., None] + rate[..., None] * time_s
    return _channel.turns(-(sent_hz - 0.5 * slope * tau) * tau)


def _chirp_times(waveform: Waveform, tx_antennas: int) -> Array:
    """The beginnings of the chirps of each antenna, shape (tx antennas, chirps)."""
    turn = np.arange(tx_antennas) * (waveform.spacing_s if waveform.turns else 0.0)
    return turn[:, None] + waveform.repetition_s(tx_antennas) * np.arange(waveform.chirps)


def _add_noise(signal: Array, waveform: Waveform) -> Array:
    if waveform.noise_figure_db is None:
        return signal
    power = _BOLTZMANN_J_K * _ROOM_K * 10 ** (waveform.noise_figure_db / 10) * waveform.samples / waveform.chirp_s
    random = np.random.default_rng(waveform.seed)
    parts = random.normal(scale=np.sqrt(power / 2), size=(*signal.shape, 2))
    return np.asarray(signal + parts[..., 0] + 1j * parts[..., 1])


def _one_link(paths: Paths, tx: Any, rx: Any) -> Paths:
    chosen = paths if tx is None and rx is None else paths.select(tx=tx, rx=rx)
    for names, what in ((chosen.transmitters, "transmitter"), (chosen.receivers, "receiver")):
        if len(names) != 1:
            raise ConfigError(f"a radar has one {what}, and these paths have {len(names)}: {', '.join(names[:8])}; choose "
                              f"one with {'tx' if what == 'transmitter' else 'rx'}=")
    return chosen


def beat(paths: Paths, waveform: Waveform, tx: Any = None, rx: Any = None) -> Array:
    """The beat signal of a link, in roots of watts: complex128 of shape (rx antennas, tx antennas, chirps, samples).

    paths: those of a frame; tx, rx: the radar's ends, names or places, where there are several. A path has at each time
    the delay that its Doppler shift gives it (the shift is that of the carrier), so ranges migrate and chirps are
    stretched; its amplitude and its angles stay those of the frame. Paths later than waveform.longest_delay_s are left
    out. Antennas are port * elements + element, as in paths.cir().
    """
    link = _one_link(paths, tx, rx)
    antennas = _channel.Antennas(link, _channel.dense(link), normalize_delays=False)
    near = antennas.delay < waveform.longest_delay_s
    carrier = link.frequency_hz
    # Antennas gives coefficients with the carrier's phase, which is a part of the beat signal's phase.
    a = (antennas.a * _channel.turns(carrier * antennas.delay)[:, None, None])[near]
    delay, rate = antennas.delay[near], -np.asarray(link.doppler_hz)[near] / carrier
    rx_count, tx_count = a.shape[1:]
    times = _chirp_times(waveform, tx_count)
    out = _channel.zeros((rx_count, tx_count, waveform.chirps, waveform.samples), "the beat signal")
    offset_hz = (np.arange(waveform.samples) / waveform.samples - 0.5) * waveform.bandwidth_hz
    step = max(1, 2**22 // (waveform.chirps * waveform.samples))
    for t in range(tx_count):
        if t > 0 and not waveform.turns:  # all antennas send the same chirps, so the first one's loop has done them
            break
        columns = slice(t, t + 1) if waveform.turns else slice(None)
        for first in range(0, len(delay), step):
            some = slice(first, first + step)
            phases = _phases(waveform, carrier, delay[some, None] + rate[some, None] * times[t], rate[some, None])
            weights = np.broadcast_to(a[some, :, columns, None], (*a[some, :, columns].shape, waveform.samples))
            if antennas.later is not None:
                weights = weights * _channel.turns(-antennas.later[near][some, :, columns, None] * offset_hz)
            out[:, columns] += np.einsum("prts,pns->rtns", weights, phases)
    return _add_noise(out * np.sqrt(1e-3 * 10 ** (waveform.power_dbm / 10)), waveform)


def beat_of_points(motion: Motion, cross_section_m2: ArrayLike, waveform: Waveform, carrier_hz: float,
                   tx_m: ArrayLike = (0, 0, 0), rx_m: ArrayLike | None = None) -> Array:
    """The beat signal of points that move, with isotropic antennas in free space: shape (1, 1, chirps, samples), without
    noise. motion(t) gives positions of shape (points, 3), metres, at t seconds; each chirp has the exact delays of its
    beginning and end. cross_section_m2: one number, or one for each point. rx_m: None is at tx_m."""
    ends = [np.asarray(tx_m, float), np.asarray(tx_m if rx_m is None else rx_m, float)]
    root = np.sqrt(np.asarray(cross_section_m2, float))
    wavelength = SPEED_OF_LIGHT_M_S / number(carrier_hz, "carrier_hz")
    out = _channel.zeros((1, 1, waveform.chirps, waveform.samples), "the beat signal")

    def ways(time_s: float) -> tuple[Array, Array]:
        legs = [np.linalg.norm(np.asarray(motion(time_s), float) - end, axis=-1) for end in ends]
        return (legs[0] + legs[1]) / SPEED_OF_LIGHT_M_S, legs[0] * legs[1]

    for n, time_s in enumerate(_chirp_times(waveform, 1)[0]):
        (begin, product), (end, _) = ways(time_s), ways(time_s + waveform.chirp_s)
        amplitude = root * wavelength / ((4 * np.pi) ** 1.5 * product)
        amplitude = np.where(begin < waveform.longest_delay_s, amplitude, 0.0)
        out[0, 0, n] = amplitude @ _phases(waveform, carrier_hz, begin, (end - begin) / waveform.chirp_s)
    return np.asarray(out * np.sqrt(1e-3 * 10 ** (waveform.power_dbm / 10)))


def echoes(scene: str | os.PathLike[str], frequency_hz: float, tx_m: ArrayLike, rx_m: ArrayLike, *options: str
           ) -> dict[str, Array]:
    """The echoes of a body in a scene file by physical optics, from `wavetracer scene radar`: columns bounces, delay_s,
    first_m and last_m (where the wave meets the body first and last), and a, shape (echoes, 2, 2), the coefficient from
    theta and phi of the transmitter (last axis) to those of the receiver, as in paths.a. options: more of the command's,
    such as "--echo-size=0.5"."""
    places = [",".join(repr(float(x)) for x in np.asarray(end, float)) for end in (tx_m, rx_m)]
    text = _program.call("scene", "radar", scene, f"--frequency={frequency_hz!r}", f"--transmitter={places[0]}",
                         f"--receiver={places[1]}", *options)
    rows = list(csv.DictReader(text.splitlines()))

    def column(name: str) -> Array:
        return np.array([float(row[name]) for row in rows])

    pairs = [column(f"{heard}_{sent}_re") + 1j * column(f"{heard}_{sent}_im")
             for heard in ("theta", "phi") for sent in ("theta", "phi")]
    return {"bounces": column("bounces").astype(int), "delay_s": column("delay_s"),
            "a": np.stack(pairs, axis=1).reshape(-1, 2, 2),
            **{f"{end}_m": np.stack([column(f"{end}_{axis}_m") for axis in "xyz"], axis=1) for end in ("first", "last")}}


def beat_of_echoes(delay_s: ArrayLike, a: ArrayLike, waveform: Waveform, carrier_hz: float, doppler_hz: ArrayLike = 0.0
                   ) -> Array:
    """The beat signal of echoes with these delays, coefficients and Doppler shifts, one number or one of each echo: shape
    (1, 1, chirps, samples), without noise, for a radar of one antenna on each side."""
    delay = np.atleast_1d(np.asarray(delay_s, float))
    amplitude = np.broadcast_to(np.asarray(a, complex), delay.shape) * (delay < waveform.longest_delay_s)
    rate = np.broadcast_to(-np.asarray(doppler_hz, float) / number(carrier_hz, "carrier_hz"), delay.shape)
    out = _channel.zeros((1, 1, waveform.chirps, waveform.samples), "the beat signal")
    for n, time_s in enumerate(_chirp_times(waveform, 1)[0]):
        out[0, 0, n] = amplitude @ _phases(waveform, carrier_hz, delay + rate * time_s, rate)
    return np.asarray(out * np.sqrt(1e-3 * 10 ** (waveform.power_dbm / 10)))


def wheel(centre_m: ArrayLike, heading_rad: float, radius_m: float, speed_m_s: float, count: int = 40) -> Motion:
    """Points on the rim of a wheel that rolls on level ground: its centre is at centre_m at time 0 and moves at
    speed_m_s. The points at the top move at twice that speed, and those on the ground stand still."""
    if not number(radius_m, "radius_m") > 0 or integer(count, "count") < 1:
        raise ConfigError(f"a wheel of radius {radius_m} m and {count} points: give a radius above 0 and a point or more")
    ahead = np.array([np.cos(heading_rad), np.sin(heading_rad), 0.0])
    start = 2 * np.pi * np.arange(count) / count

    def motion(time_s: float) -> Array:
        turn = start - speed_m_s / radius_m * time_s  # seen from the right, a wheel that rolls ahead turns clockwise
        rim = np.cos(turn)[:, None] * ahead + np.sin(turn)[:, None] * np.array([0.0, 0.0, 1.0])
        return np.asarray(np.asarray(centre_m, float) + ahead * (speed_m_s * time_s) + radius_m * rim)

    return motion


def cube_of(signal: Array, waveform: Waveform, carrier_hz: float, range_window: str = "hann",
            doppler_window: str = "hann") -> Cube:
    """The cube of a beat signal of shape (rx antennas, tx antennas, chirps, samples)."""
    shape = (waveform.chirps, waveform.samples)
    if signal.ndim != 4 or signal.shape[2:] != shape:
        raise ConfigError(f"a beat signal of shape {signal.shape} is not one of this waveform: give one of shape (rx "
                          f"antennas, tx antennas, {shape[0]}, {shape[1]})")
    profiles = np.fft.ifft(windowed(signal, range_window, 3), axis=3) * waveform.samples
    values = np.fft.fftshift(np.fft.fft(windowed(profiles, doppler_window, 2), axis=2), axes=2)
    repetition = waveform.repetition_s(signal.shape[1])
    doppler_hz = np.fft.fftshift(np.fft.fftfreq(waveform.chirps, repetition))
    if waveform.turns:  # an antenna that sends later sees a phase that has turned by then
        later = _chirp_times(waveform, signal.shape[1])[:, 0]
        values *= _channel.turns(-np.outer(later, doppler_hz))[None, :, :, None]
    return Cube(values, np.arange(waveform.samples) / waveform.bandwidth_hz, doppler_hz, carrier_hz)


def cube(paths: Paths, waveform: Waveform, tx: Any = None, rx: Any = None, range_window: str = "hann",
         doppler_window: str = "hann") -> Cube:
    """The range-Doppler cube of a radar: beat(), and transforms with windows over samples and chirps. Windows: "hann",
    "hamming", "blackman", "none"."""
    link = _one_link(paths, tx, rx)
    out = cube_of(beat(link, waveform), waveform, link.frequency_hz, range_window, doppler_window)
    out.left_out = int((np.asarray(link.delay_s) >= waveform.longest_delay_s).sum())
    return out


def spectrogram(signal: Array, waveform: Waveform, length: int = 64, step: int = 16,
                range_m: tuple[float, float] = (0.0, np.inf)) -> tuple[Array, Array, Array]:
    """Doppler spectra of `length` chirps, every `step` chirps, of ranges between these: times of their middles (s),
    Doppler shifts (Hz), and powers in dBm, shape (times, shifts), the mean over antennas. signal: of any number of
    chirps, such as that of several frames that follow each other, joined along axis 2."""
    length, step = integer(length, "length"), integer(step, "step")
    if not 2 <= length <= signal.shape[2] or step < 1:
        raise ConfigError(f"spectra of {length} chirps every {step} of {signal.shape[2]}: give a length from 2 to "
                          f"{signal.shape[2]} and a step of 1 or more")
    profiles = np.fft.ifft(windowed(signal, "hann", 3), axis=3) * signal.shape[3]
    ranges = np.arange(signal.shape[3]) / waveform.bandwidth_hz * SPEED_OF_LIGHT_M_S / 2
    profiles = profiles[..., (ranges >= range_m[0]) & (ranges <= range_m[1])]
    starts = np.arange(0, signal.shape[2] - length + 1, step)
    repetition = waveform.repetition_s(signal.shape[1])
    rows = []
    for start in starts:
        spectra = np.fft.fft(windowed(profiles[:, :, start:start + length], "hann", 2), axis=2)
        rows.append((np.abs(np.fft.fftshift(spectra, axes=2)) ** 2).sum(axis=3).mean(axis=(0, 1)))
    with np.errstate(divide="ignore"):
        power_dbm = 10 * np.log10(np.array(rows)) + 30
    return (starts + length / 2) * repetition, np.fft.fftshift(np.fft.fftfreq(length, repetition)), power_dbm


if __name__ == "__main__":
    import sys

    from ._radar_command import main

    sys.exit(main())
