# SPDX-License-Identifier: Apache-2.0
"""Paths of a radar as a trace of ASAM OSI 3.8.0: one SensorView per frame with a RadarSensorView, whose reflections are the
paths. The numbers of fields are those of osi_sensorview.proto and osi_common.proto."""
from __future__ import annotations

import math
import pathlib
import struct
from collections.abc import Iterable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import ConfigError
from .paths import Paths

_VERSION = (3, 8, 0)
_VIEW_VERSION, _VIEW_TIMESTAMP, _VIEW_RADAR = 1, 2, 1001
_RADAR_REFLECTION = 2


def _varint(value: int) -> bytes:
    out = bytearray()
    while value > 127:
        out.append(value & 127 | 128)
        value >>= 7
    return bytes([*out, value])


def _whole(field: int, value: int) -> bytes:
    return _varint(field << 3) + _varint(value & (1 << 64) - 1)


def _message(field: int, content: bytes) -> bytes:
    return _varint(field << 3 | 2) + _varint(len(content)) + content


def _reflection(values: Iterable[float]) -> bytes:
    """Signal strength (dB), time of flight (s), Doppler shift (Hz), horizontal and vertical angle of the source (rad)."""
    return b"".join(_varint(field << 3 | 1) + struct.pack("<d", value) for field, value in enumerate(values, 1))


def _view(time_s: float, paths: Paths, turn: NDArray[np.float64]) -> bytes:
    theta, phi = np.asarray(paths.aoa_theta_rad), np.asarray(paths.aoa_phi_rad)
    arrival = np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)], axis=1) @ turn
    columns = (paths.gain_db, paths.delay_s, paths.doppler_hz, np.arctan2(arrival[:, 1], arrival[:, 0]),
               np.arcsin(np.clip(arrival[:, 2], -1, 1)))
    heard = np.isfinite(paths.gain_db)  # a path that an antenna is blind for is no reflection
    reflections = b"".join(_message(_RADAR_REFLECTION, _reflection(map(float, row))) for row in
                           np.stack(columns, axis=1)[heard])
    seconds = math.floor(time_s)
    nanos = min(round((time_s - seconds) * 1e9), 999999999)
    return (_message(_VIEW_VERSION, b"".join(_whole(i, part) for i, part in enumerate(_VERSION, 1)))
            + _message(_VIEW_TIMESTAMP, _whole(1, seconds) + _whole(2, nanos)) + _message(_VIEW_RADAR, reflections))


def write_osi(file: str | pathlib.Path, frames: Iterable[tuple[float, Paths]], turn: ArrayLike | None = None) -> None:
    """Writes a binary trace: each message after its length in four bytes, the lowest first.

    frames: times in seconds and the paths of the radar's link. signal_strength is the gain of a path in dB, with both
    antennas. turn: matrix (3, 3) whose columns are the sensor's axes in the scene; angles of sources are in these axes,
    and without it in those of the scene."""
    axes = np.eye(3) if turn is None else np.asarray(turn, float)
    if axes.shape != (3, 3) or not np.allclose(axes.T @ axes, np.eye(3), atol=1e-6):
        raise ConfigError("turn of write_osi is no rotation: give a matrix (3, 3) with the sensor's axes as columns")
    with open(file, "wb") as out:
        for time_s, paths in frames:
            if len(paths.transmitters) != 1 or len(paths.receivers) != 1:
                raise ConfigError("write_osi takes the paths of one link: choose them by paths.select(tx=..., rx=...)")
            message = _view(float(time_s), paths, axes)
            out.write(struct.pack("<L", len(message)) + message)
