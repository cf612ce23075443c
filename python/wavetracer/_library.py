# SPDX-License-Identifier: Apache-2.0
"""libwavetracer.so through ctypes: finds it, declares the arguments of its functions, and turns its errors into
exceptions.

It needs no compiled module of Python, so one wheel serves every version of Python."""
from __future__ import annotations

import ctypes
import os
import pathlib
from typing import Any

from . import _drivers
from .errors import RunError, error_of

SONAME = "libwavetracer.so.0.3"
Handle, Text = ctypes.c_void_p, ctypes.c_char_p
Doubles, Sizes = ctypes.POINTER(ctypes.c_double), ctypes.POINTER(ctypes.c_size_t)
Observer = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.c_char_p, ctypes.c_uint64, ctypes.c_uint64)


class Counts(ctypes.Structure):
    """Counts of the work for a frame. rays: rays launched; segments: rays traced or answered by the cache, at all
    depths; hits: rays that met a surface; sequences: distinct sequences of surfaces; candidates: pairs of a sequence
    and a receiver that may be a path; solved: those with all points in their surfaces; paths: those that are visible,
    each once."""

    _fields_ = [(name, ctypes.c_uint64)
                for name in ("rays", "segments", "hits", "sequences", "candidates", "solved", "paths")]

    def __repr__(self) -> str:
        return "Counts(" + ", ".join(f"{field[0]}={getattr(self, field[0]):,}" for field in self._fields_) + ")"


class Missed(ctypes.Structure):
    _fields_ = [(what + bound, ctypes.c_double) for what in ("paths", "power_share") for bound in ("", "_low", "_high")]


class Certificate(ctypes.Structure):
    _fields_ = [("depth", ctypes.c_uint32), ("any_depth", ctypes.c_uint32)] + [
        (name, ctypes.c_double)
        for name in ("left_out_sr", "left_out_share", "left_out_power", "floor_db", "weak_share")] + [
        ("edges", ctypes.c_uint32)]


class Column(ctypes.Structure):
    _fields_ = [("data", ctypes.c_void_p), ("rows", ctypes.c_size_t), ("width", ctypes.c_size_t),
                ("type", ctypes.c_int)]


_ERROR = ctypes.POINTER(Handle)
_FUNCTIONS: tuple[tuple[str, Any, list[Any]], ...] = (
    ("error_code", ctypes.c_int, [Handle]), ("error_message", Text, [Handle]), ("error_free", None, [Handle]),
    ("version", Text, []), ("devices", Text, [_ERROR]),
    ("open", Handle, [Text, Text, ctypes.POINTER(Text), ctypes.c_size_t, Text, _ERROR]), ("close", None, [Handle]),
    ("frame_count", ctypes.c_uint32, [Handle]), ("time_s", ctypes.c_double, [Handle, ctypes.c_uint32]),
    ("transmitter_count", ctypes.c_size_t, [Handle]), ("receiver_count", ctypes.c_size_t, [Handle]),
    ("transmitter_name", Text, [Handle, ctypes.c_size_t]), ("receiver_name", Text, [Handle, ctypes.c_size_t]),
    ("carrier_count", ctypes.c_size_t, [Handle]), ("carrier_hz", ctypes.c_double, [Handle, ctypes.c_size_t]),
    ("device_name", Text, [Handle]), ("config_text", Text, [Handle]),
    ("warnings", Text, [Handle]), ("run_frame", Handle, [Handle, ctypes.c_uint32, _ERROR]),
    ("frame_free", None, [Handle]), ("forget", None, [Handle]), ("observe", None, [Handle, Observer, Handle]),
    ("frame_number", ctypes.c_uint32, [Handle]), ("frame_time_s", ctypes.c_double, [Handle]),
    ("frame_rx_ports", ctypes.c_uint32, [Handle]), ("frame_tx_ports", ctypes.c_uint32, [Handle]),
    ("frame_counts", Counts, [Handle]), ("frame_missed", Missed, [Handle]),
    ("frame_certificate", Certificate, [Handle]), ("frame_warnings", Text, [Handle]),
    ("frame_column", ctypes.c_int, [Handle, Text, ctypes.POINTER(Column), _ERROR]),
    ("radar_count", ctypes.c_size_t, [Handle]), ("radar_name", Text, [Handle, ctypes.c_size_t]),
    ("frame_radar_cube", ctypes.c_int, [Handle, ctypes.c_size_t, Sizes, ctypes.POINTER(Column), _ERROR]),
    ("frame_radar_axis", ctypes.c_int, [Handle, ctypes.c_size_t, Text, ctypes.POINTER(Column), _ERROR]),
    ("transmitter_elements", ctypes.c_size_t, [Handle, ctypes.c_size_t]),
    ("receiver_elements", ctypes.c_size_t, [Handle, ctypes.c_size_t]),
    ("transmitter_element_positions", ctypes.c_int, [Handle, ctypes.c_size_t, Doubles, ctypes.c_size_t, _ERROR]),
    ("receiver_element_positions", ctypes.c_int, [Handle, ctypes.c_size_t, Doubles, ctypes.c_size_t, _ERROR]),
    ("element_paths", ctypes.c_int, [Handle, Handle, Sizes, ctypes.c_size_t, ctypes.c_size_t, ctypes.c_size_t, Doubles,
                                     Doubles, _ERROR]),
    ("frame_gradient", Handle, [Handle, Handle, ctypes.c_uint, Sizes, ctypes.c_size_t, _ERROR]),
    ("gradient_free", None, [Handle]), ("gradient_column", ctypes.c_int, [Handle, Text, ctypes.POINTER(Column), _ERROR]),
    ("gradient_material_count", ctypes.c_size_t, [Handle]),
    ("gradient_material_name", Text, [Handle, ctypes.c_size_t]),
    ("column_count", ctypes.c_size_t, []), ("column_name", Text, [ctypes.c_size_t]),
    ("write", ctypes.c_int, [Handle, Text, ctypes.POINTER(Handle), ctypes.c_size_t, _ERROR]))


def _candidates() -> list[str]:
    """The places where the library may be, the first to be tried first: the one that the user names, the wheel's own,
    an installation that this file is part of (PREFIX/lib/python3/dist-packages/wavetracer), the system's."""
    here = pathlib.Path(__file__).resolve().parent
    files = [here / "lib/libwavetracer.so"]
    if len(here.parents) > 2:
        files += [here.parents[2] / SONAME] + sorted(here.parents[2].glob(f"*-linux-gnu/{SONAME}"))
    named = os.environ.get("WAVETRACER_LIBRARY")
    return [named] if named else [str(file) for file in files if file.exists()] + [SONAME]


def _load() -> ctypes.CDLL:
    os.environ.update(_drivers.environment())
    name = _candidates()[0]
    try:
        loaded = ctypes.CDLL(name)
        for function, result, arguments in _FUNCTIONS:
            entry = getattr(loaded, "wavetracer_" + function)
            entry.restype, entry.argtypes = result, arguments
    except (OSError, AttributeError) as error:
        raise ImportError(f"wavetracer: the library cannot be used: {error}. The wheel of ./dev wheel brings one; "
                          "WAVETRACER_LIBRARY names another file, which must be of the same version as this package"
                          ) from error
    return loaded


library: Any = _load()


def call(function: Any, *arguments: Any) -> Any:
    """The result of a function that takes an error last; raises the error."""
    error = Handle()
    result = function(*arguments, ctypes.byref(error))
    if error:
        raised = error_of(library.wavetracer_error_code(error), library.wavetracer_error_message(error).decode())
        library.wavetracer_error_free(error)
        raise raised
    return result


def text(value: bytes | None) -> str:
    """A text of the library, which must be there."""
    if value is None:
        raise RunError("the simulation was closed")
    return value.decode()


def version() -> str:
    """The version of the library, such as "0.3.0"."""
    return text(library.wavetracer_version())


def columns() -> list[str]:
    """The names of all columns of a frame, which wavetracer.h describes."""
    return [text(library.wavetracer_column_name(i)) for i in range(library.wavetracer_column_count())]


def devices() -> list[dict[str, str]]:
    """The OpenCL devices: `name`, `platform` and `kind` ("GPU", "CPU" or "other") of each. A simulation takes the first
    GPU, else the first CPU, unless its argument `device` has a part of a name or an index of this list."""
    lines = text(call(library.wavetracer_devices)).splitlines()
    return [dict(zip(("name", "platform", "kind"), line.split("\t"))) for line in lines]
