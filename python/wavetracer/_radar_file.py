# SPDX-License-Identifier: Apache-2.0
"""radar.h5: the cubes, maps, detections and spectra of radars, as [[radar]] of a configuration and save() write it.
docs/formats.md has its datasets."""
from __future__ import annotations

import pathlib
import re
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._cube import Cube
from .errors import ConfigError, InputError

Array = NDArray[Any]
_FORMAT, _VERSION = "wavetracer radar", 2
_UNITS = {"delay_s": "s", "range_m": "m", "doppler_hz": "Hz", "spectrogram_doppler_hz": "Hz", "speed_m_s": "m/s",
          "power_dbm": "dBm", "time_s": "s", "threshold_dbm": "dBm", "re": "sqrt(W)", "im": "sqrt(W)"}


def _columns(cubes: Sequence[Cube], frames: Sequence[int], times_s: Sequence[float],
             spectrogram: tuple[Array, Array, Array] | None, found: list[dict[str, Array]], ends: tuple[int, int]) -> dict[str, Array]:
    first = cubes[0]
    columns: dict[str, Array] = {"frames/frame": np.asarray(frames, np.uint32), "frames/time_s": np.asarray(times_s, float),
                                 "frames/left_out": np.asarray([cube.left_out for cube in cubes], np.uint32)}
    for name in ("delay_s", "range_m", "doppler_hz", "speed_m_s"):
        columns[name] = getattr(first, name)
    columns["maps/power_dbm"] = np.stack([cube.power_dbm for cube in cubes])
    columns["cube/re"] = np.stack([cube.values.real for cube in cubes]).astype(np.float32)
    columns["cube/im"] = np.stack([cube.values.imag for cube in cubes]).astype(np.float32)
    columns["detections/frame"] = np.repeat(columns["frames/frame"], [len(each["range_m"]) for each in found])
    for name in found[0]:
        columns["detections/" + name] = np.concatenate([each[name] for each in found])
    for table in ("frames", "detections"):
        for side, end in zip(("tx", "rx"), ends):
            columns[f"{table}/{side}"] = np.full(len(columns[table + "/frame"]), end, np.uint32)
    if spectrogram is not None:
        columns["spectrogram/time_s"], columns["spectrogram_doppler_hz"], columns["spectrogram/power_dbm"] = spectrogram
    return columns


def save(file: str | pathlib.Path, cubes: Sequence[Cube], frames: Sequence[int] = (0,), times_s: Sequence[float] = (0.0,),
         spectrogram: tuple[Array, Array, Array] | None = None, false_alarm: float = 1e-6, name: str = "radar",
         ends: tuple[int, int] = (0, 0), guard: int = 2, training: int = 6) -> None:
    """Writes HDF5: the cubes of frames with these numbers and times, all of one waveform, in single precision; their maps;
    their detections at this probability of a false alarm, with these cells around; and times, shifts and powers of
    spectrogram(). name: of the radar; ends: the places of its transmitter and receiver in the lists of the run."""
    import h5py

    if not cubes or not len(cubes) == len(frames) == len(times_s):
        raise ConfigError(f"{len(cubes)} cubes, {len(frames)} numbers and {len(times_s)} times of frames: give one of each "
                          "for every frame, and a frame or more")
    if not re.fullmatch("[A-Za-z0-9_-]+", name):
        raise ConfigError(f"name of a radar is {name!r}: give letters, digits, - and _, since it names a group of the file")
    first = cubes[0]
    if any(cube.values.shape != first.values.shape or not np.array_equal(cube.delay_s, first.delay_s)
           or not np.array_equal(cube.doppler_hz, first.doppler_hz) for cube in cubes):
        raise ConfigError(f"{file}: the cubes have other axes than the first one: give cubes of one waveform")
    found = [cube.detections(false_alarm, guard, training) for cube in cubes]
    with h5py.File(file, "w") as out:
        out.attrs["format"], out.attrs["format_version"], out.attrs["radars"] = _FORMAT, _VERSION, name
        group = out.create_group(name)
        group.attrs["frequency_hz"], group.attrs["false_alarm"] = first.frequency_hz, false_alarm
        for path, column in _columns(cubes, frames, times_s, spectrogram, found, ends).items():
            group[path] = column
            if unit := _UNITS.get(path.split("/")[-1]):
                group[path].attrs["units"] = unit


def of_run(file: str | pathlib.Path) -> bool:
    """Did a run write this file? Then it has the text of the configuration, which files of save() do not have."""
    import h5py

    try:
        with h5py.File(file) as stored:
            return "config" in stored.attrs
    except OSError:  # there is none, or one that cannot be read
        return False


def names(file: str | pathlib.Path) -> list[str]:
    """The radars of a radar.h5."""
    found: list[str] = _read(file, lambda stored: _names(file, stored))
    return found


def _text(value: Any) -> str:
    return value.decode() if isinstance(value, bytes) else str(value)


def _names(file: str | pathlib.Path, stored: Any) -> list[str]:
    if _text(stored.attrs.get("format", "")) != _FORMAT:
        raise InputError(f"{file}: this is no radar.h5 of wavetracer; give a file of [[radar]] or of wavetracer.radar")
    if (version := int(stored.attrs["format_version"])) != _VERSION:
        raise InputError(f"{file}: it has version {version} of the format, and this version of wavetracer reads {_VERSION}: "
                         "make it again")
    return _text(stored.attrs["radars"]).split(",")


def _read(file: str | pathlib.Path, action: Callable[[Any], Any]) -> Any:
    import h5py

    try:
        with h5py.File(file) as stored:
            return action(stored)
    except (OSError, KeyError) as error:
        raise InputError(f"{file}: it cannot be read: {error}") from None


def _chosen(file: str | pathlib.Path, stored: Any, name: str | None) -> Any:
    known = _names(file, stored)
    if name is None and len(known) > 1:
        raise ConfigError(f"{file} has the radars {', '.join(known)}: choose one with radar=")
    if name is not None and name not in known:
        raise ConfigError(f"{file} has no radar {name!r}, only {', '.join(known)}")
    return stored[name or known[0]]


def _rows_of(file: str | pathlib.Path, group: Any, tx: int | None, rx: int | None) -> Array:
    """Rows of a link, which must be one."""
    links = np.stack([group["frames/tx"][...], group["frames/rx"][...]], axis=1)
    wanted = np.ones(len(links), bool)
    for side, end in ((0, tx), (1, rx)):
        if end is not None:
            wanted &= links[:, side] == end
    if len(chosen := np.unique(links[wanted], axis=0)) > 1:
        pairs = ", ".join(f"{int(t)} to {int(r)}" for t, r in chosen[:8])
        raise ConfigError(f"{file}: the radar has {len(chosen)} links, {pairs}: choose one with tx= and rx=, the places of its "
                          "ends in the lists of the run")
    return np.flatnonzero(wanted)


def load(file: str | pathlib.Path, radar: str | None = None, tx: int | None = None, rx: int | None = None) -> dict[int, Cube]:
    """The cubes of a radar.h5 by the numbers of their frames. radar: its name, where there are several; tx, rx: the places
    of its ends in the lists of the run, where it has several links."""

    def cubes(stored: Any) -> dict[int, Cube]:
        group = _chosen(file, stored, radar)
        if "cube" not in group:
            raise InputError(f"{file}: it has maps, but no cubes: compute the run with radar.cube = true")
        delay, doppler, carrier = group["delay_s"][...], group["doppler_hz"][...], float(np.ravel(group.attrs["frequency_hz"])[0])

        def offsets(side: str, i: int) -> Array | None:  # files of Python have none
            name = f"frames/{side}_offset_m"
            return np.asarray(group[name][i]) if name in group else None

        return {int(group["frames/frame"][i]): Cube(group["cube/re"][i] + np.complex64(1j) * group["cube/im"][i], delay, doppler,
                                                    carrier, int(group["frames/left_out"][i]), offsets("rx", i), offsets("tx", i))
                for i in _rows_of(file, group, tx, rx)}

    return dict(_read(file, cubes))
