# SPDX-License-Identifier: Apache-2.0
"""radar.h5: the cubes of some frames, their maps and detections, and a spectrogram. docs/formats.md has its datasets."""
from __future__ import annotations

import pathlib
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._cube import Cube
from .errors import ConfigError, InputError

Array = NDArray[Any]
_FORMAT = "wavetracer radar"
_UNITS = {"delay_s": "s", "range_m": "m", "doppler_hz": "Hz", "speed_m_s": "m/s", "power_dbm": "dBm", "time_s": "s",
          "threshold_dbm": "dBm", "re": "sqrt(W)", "im": "sqrt(W)"}


def save(file: str | pathlib.Path, cubes: Sequence[Cube], frames: Sequence[int] = (0,), times_s: Sequence[float] = (0.0,),
         spectrogram: tuple[Array, Array, Array] | None = None, false_alarm: float = 1e-6) -> None:
    """Writes HDF5: the cubes of frames with these numbers and times, all of one waveform, in single precision; their maps;
    their detections at this probability of a false alarm; and times, shifts and powers of spectrogram()."""
    import h5py

    if not cubes or not len(cubes) == len(frames) == len(times_s):
        raise ConfigError(f"{len(cubes)} cubes, {len(frames)} numbers and {len(times_s)} times of frames: give one of each "
                          "for every frame, and a frame or more")
    first = cubes[0]
    if any(cube.values.shape != first.values.shape or not np.array_equal(cube.delay_s, first.delay_s)
           or not np.array_equal(cube.doppler_hz, first.doppler_hz) for cube in cubes):
        raise ConfigError(f"{file}: the cubes have other axes than the first one: give cubes of one waveform")
    columns: dict[str, Array] = {"frames/frame": np.asarray(frames, np.uint32), "frames/time_s": np.asarray(times_s, float),
                                 "frames/left_out": np.asarray([cube.left_out for cube in cubes], np.uint32)}
    for name in ("delay_s", "range_m", "doppler_hz", "speed_m_s"):
        columns[name] = getattr(first, name)
    columns["power_dbm"] = np.stack([cube.power_dbm for cube in cubes])
    columns["cube/re"] = np.stack([cube.values.real for cube in cubes]).astype(np.float32)
    columns["cube/im"] = np.stack([cube.values.imag for cube in cubes]).astype(np.float32)
    found = [cube.detections(false_alarm) for cube in cubes]
    columns["detections/frame"] = np.repeat(columns["frames/frame"], [len(each["range_m"]) for each in found])
    for name in found[0]:
        columns["detections/" + name] = np.concatenate([each[name] for each in found])
    for name, column in zip(("time_s", "doppler_hz", "power_dbm"), spectrogram or ()):
        columns["spectrogram/" + name] = column
    with h5py.File(file, "w") as out:
        out.attrs["format"], out.attrs["format_version"] = _FORMAT, 1
        out.attrs["frequency_hz"], out.attrs["false_alarm"] = first.frequency_hz, false_alarm
        for name, column in columns.items():
            out[name] = column
            if unit := _UNITS.get(name.split("/")[-1]):
                out[name].attrs["unit"] = unit


def load(file: str | pathlib.Path) -> dict[int, Cube]:
    """The cubes of a radar.h5 by the numbers of their frames."""
    import h5py

    try:
        with h5py.File(file) as stored:
            if stored.attrs.get("format") != _FORMAT:
                raise InputError(f"{file}: this is no radar.h5 of wavetracer; give a file of wavetracer.radar")
            delay, doppler, carrier = stored["delay_s"][...], stored["doppler_hz"][...], float(stored.attrs["frequency_hz"])
            return {int(number): Cube(stored["cube/re"][i] + np.complex64(1j) * stored["cube/im"][i], delay, doppler, carrier,
                                      int(stored["frames/left_out"][i]))
                    for i, number in enumerate(stored["frames/frame"][...])}
    except (OSError, KeyError) as error:
        raise InputError(f"{file}: it cannot be read: {error}") from None
