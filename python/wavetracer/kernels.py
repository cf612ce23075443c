# SPDX-License-Identifier: Apache-2.0
"""The kernel suite on arrays of pyopencl, in the queue of the array and without a copy.

    import pyopencl.array
    import wavetracer.kernels

    keys = pyopencl.array.to_device(queue, numbers)     # numpy.uint32 or numpy.uint64
    wavetracer.kernels.sort(keys)                       # in place
    order = pyopencl.array.empty(queue, len(keys), numpy.uint32)
    event = wavetracer.kernels.argsort(keys, order, wait_for=[event])

Functions enqueue their commands and return a pyopencl.Event of their end; nothing waits for the device. Queues are in
order. The kernels of the last queues are kept (see Suite). It needs pyopencl and no other part of this package."""
from __future__ import annotations

import ctypes
import functools
import os
import pathlib
import threading
from typing import Any, Sequence

from .errors import DeviceError

SONAME = "libwavetracer_kernels.so.0.3"
NOTHING = 0xFFFFFFFF
"""The word that compact() leaves out."""

_Handle, _Size, _Unsigned = ctypes.c_void_p, ctypes.c_size_t, ctypes.c_uint
_ERROR, _FLOATS = ctypes.POINTER(_Handle), ctypes.POINTER(ctypes.c_float)
_EVENTS = [_Unsigned, ctypes.POINTER(_Handle), ctypes.POINTER(_Handle), _ERROR]
_FUNCTIONS: tuple[tuple[str, Any, list[Any]], ...] = (
    ("error_code", ctypes.c_int, [_Handle]), ("error_message", ctypes.c_char_p, [_Handle]),
    ("error_kernel", ctypes.c_char_p, [_Handle]), ("error_free", None, [_Handle]),
    ("open", _Handle, [_Handle, _Handle, _Handle, _ERROR]), ("close", None, [_Handle]),
    ("sort_make", _Handle, [_Handle, _Unsigned, ctypes.c_int, ctypes.c_int, _ERROR]), ("sort_free", None, [_Handle]),
    ("sort_run", ctypes.c_int, [_Handle, _Handle, _Handle, _Size, _Unsigned, _Unsigned, *_EVENTS]),
    ("scan_make", _Handle, [_Handle, _ERROR]), ("scan_free", None, [_Handle]),
    ("scan_run", ctypes.c_int, [_Handle, _Handle, _Size, _Handle, *_EVENTS]),
    ("compact_make", _Handle, [_Handle, _ERROR]), ("compact_free", None, [_Handle]),
    ("compact_run", ctypes.c_int, [_Handle, _Handle, _Size, _Handle, _Handle, *_EVENTS]),
    ("curve_keys_make", _Handle, [_Handle, ctypes.c_int, _Unsigned, _ERROR]), ("curve_keys_free", None, [_Handle]),
    ("curve_keys_run", ctypes.c_int, [_Handle, _Handle, _Size, _Size, _FLOATS, _FLOATS, ctypes.c_uint64, _Handle, *_EVENTS]))
_CURVES = {"morton2": 2, "morton3": 3, "morton5": 5, "hilbert2": 2, "hilbert3": 3}  # by their numbers; dimensions
_PAYLOADS = {"none": 0, "words": 1, "index": 2}
_METHODS = {"automatic": 0, "radix": 1, "bitonic": 2}


class KernelError(DeviceError):
    """A call of the kernel suite failed. opencl_code: what OpenCL returned, 0 if the suite itself refused an argument;
    kernel: "program/kernel" if one could not be launched."""

    opencl_code: int = 0
    kernel: str = ""


def _candidates() -> list[str]:
    """The places where the library may be: the one that the user names, the wheel's own, an installation that this file
    is part of (PREFIX/lib/python3/dist-packages/wavetracer), the system's."""
    here = pathlib.Path(__file__).resolve().parent
    files = [here / "lib/libwavetracer_kernels.so"]
    if len(here.parents) > 2:
        files += [here.parents[2] / SONAME] + sorted(here.parents[2].glob(f"*-linux-gnu/{SONAME}"))
    named = os.environ.get("WAVETRACER_KERNELS_LIBRARY")
    return [named] if named else [str(file) for file in files if file.exists()] + [SONAME]


@functools.lru_cache(maxsize=None)
def _library() -> Any:
    try:
        loaded = ctypes.CDLL(_candidates()[0])
        for name, result, arguments in _FUNCTIONS:
            entry = getattr(loaded, "wavetracer_kernels_" + name)
            entry.restype, entry.argtypes = result, arguments
    except (OSError, AttributeError) as error:
        raise ImportError(f"wavetracer.kernels: the library cannot be used: {error}. The wheel of ./dev wheel brings one; "
                          "WAVETRACER_KERNELS_LIBRARY names another file, which must be of the same version as this "
                          "package") from error
    return loaded


def _call(name: str, *arguments: Any) -> Any:
    """The result of a function that takes an error last; raises the error."""
    library, error = _library(), _Handle()
    result = getattr(library, "wavetracer_kernels_" + name)(*arguments, ctypes.byref(error))
    if error:
        raised = KernelError(library.wavetracer_kernels_error_message(error).decode())
        raised.opencl_code = library.wavetracer_kernels_error_code(error)
        raised.kernel = library.wavetracer_kernels_error_kernel(error).decode()
        library.wavetracer_kernels_error_free(error)
        raise raised
    return result


def _memory(array: Any, argument: str, types: Sequence[str]) -> int:
    """The cl_mem of an array, whose elements follow each other from the first byte on."""
    if str(array.dtype) not in types:
        raise ValueError(f"{argument}: elements are {array.dtype}, and must be {' or '.join(types)}")
    if array.offset != 0 or not array.flags.forc:
        raise ValueError(f"{argument}: the array is a view or not contiguous: give a copy of it (array.copy())")
    if array.size == 0:
        raise ValueError(f"{argument}: the array is empty")
    return int(array.base_data.int_ptr)


class Suite:
    """The kernels for one queue. The functions of this module keep one for each of the last 8 queues that they were
    given; whoever has more queues keeps Suites."""

    def __init__(self, queue: Any):
        """queue: a pyopencl.CommandQueue, in order."""
        self._queue = queue
        self._lock = threading.Lock()  # the library takes one thread at a time for each queue
        self._passes: dict[tuple[Any, ...], tuple[str, int]] = {}
        self._handle: int | None = None
        self._handle = _call("open", queue.context.int_ptr, queue.device.int_ptr, queue.int_ptr)

    def __del__(self) -> None:
        if self._handle is None:
            return
        for kind, handle in self._passes.values():
            getattr(_library(), f"wavetracer_kernels_{kind}_free")(handle)
        _library().wavetracer_kernels_close(self._handle)

    def _run(self, kind: str, options: tuple[Any, ...], arguments: tuple[Any, ...], wait_for: Sequence[Any] | None) -> Any:
        import pyopencl

        events = [event.int_ptr for event in wait_for or ()]
        listed, done = (_Handle * len(events))(*events), _Handle()
        with self._lock:
            if (kind, *options) not in self._passes:
                self._passes[(kind, *options)] = (kind, _call(kind + "_make", self._handle, *options))
            _, handle = self._passes[(kind, *options)]
            _call(kind + "_run", handle, *arguments, len(events), listed, ctypes.byref(done))
        return pyopencl.Event.from_int_ptr(done.value or 0, retain=False)

    def _sort(self, keys: Any, values: Any, payload: str, first_bit: int, end_bit: int, method: str,
              wait_for: Sequence[Any] | None) -> Any:
        if method not in _METHODS:
            raise ValueError(f"method: {method!r} is none of {', '.join(_METHODS)}")
        memory = _memory(keys, "keys", ("uint32", "uint64"))
        words = None if values is None else _memory(values, "values", ("uint32", "int32", "float32"))
        if values is not None and values.size < keys.size:
            raise ValueError(f"values: {values.size} elements for {keys.size} keys")
        options = (8 * keys.dtype.itemsize, _PAYLOADS[payload], _METHODS[method])
        return self._run("sort", options, (memory, words, keys.size, first_bit, end_bit), wait_for)

    def sort(self, keys: Any, values: Any = None, *, first_bit: int = 0, end_bit: int = 0, method: str = "automatic",
             wait_for: Sequence[Any] | None = None) -> Any:
        return self._sort(keys, values, "none" if values is None else "words", first_bit, end_bit, method, wait_for)

    def argsort(self, keys: Any, order: Any, *, first_bit: int = 0, end_bit: int = 0, method: str = "automatic",
                wait_for: Sequence[Any] | None = None) -> Any:
        return self._sort(keys, order, "index", first_bit, end_bit, method, wait_for)

    def scan(self, words: Any, total: Any = None, *, wait_for: Sequence[Any] | None = None) -> Any:
        memory = _memory(words, "words", ("uint32",))
        total_memory = None if total is None else _memory(total, "total", ("uint32",))
        return self._run("scan", (), (memory, words.size, total_memory), wait_for)

    def compact(self, words: Any, indices: Any, total: Any, *, wait_for: Sequence[Any] | None = None) -> Any:
        memory, places = _memory(words, "words", ("uint32", "int32", "float32")), _memory(indices, "indices", ("uint32",))
        return self._run("compact", (), (memory, words.size, places, _memory(total, "total", ("uint32",))), wait_for)

    def curve_keys(self, points: Any, keys: Any, curve: str, lower: Sequence[float], upper: Sequence[float], cells: int, *,
                   wait_for: Sequence[Any] | None = None) -> Any:
        dimensions = _dimensions(curve)
        if points.ndim != 2 or points.shape[1] != dimensions or not points.flags.c_contiguous:
            raise ValueError(f"points: the shape is {points.shape}, and must be (n, {dimensions}) for {curve}, row by row")
        if keys.size < points.shape[0]:
            raise ValueError(f"keys: {keys.size} elements for {points.shape[0]} points")
        if not len(lower) == len(upper) == dimensions:
            raise ValueError(f"lower and upper: {len(lower)} and {len(upper)} numbers, {curve} takes {dimensions} each")
        if cells < 1:
            raise ValueError(f"cells: {cells} is no number of cells")
        corners = ((ctypes.c_float * dimensions)(*lower), (ctypes.c_float * dimensions)(*upper))
        memory, to = _memory(points, "points", ("float32",)), _memory(keys, "keys", ("uint32", "uint64"))
        return self._run("curve_keys", (list(_CURVES).index(curve), 8 * keys.dtype.itemsize),
                         (memory, points.shape[0], dimensions, *corners, cells, to), wait_for)


def _dimensions(curve: str) -> int:
    if curve not in _CURVES:
        raise ValueError(f"curve: {curve!r} is none of {', '.join(_CURVES)}")
    return _CURVES[curve]


@functools.lru_cache(maxsize=8)
def _suite(queue: Any) -> Suite:
    return Suite(queue)


def _suite_of(array: Any) -> Suite:
    if array.queue is None:
        raise ValueError("the array has no queue: give one by array.with_queue(queue)")
    return _suite(array.queue)


def sort(keys: Any, values: Any = None, *, first_bit: int = 0, end_bit: int = 0, method: str = "automatic",
         wait_for: Sequence[Any] | None = None) -> Any:
    """Sorts an array in place, ascending and stable, and values (32-bit elements) with it.

    Keys are compared by bits first_bit to end_bit - 1; end_bit = 0 stands for all bits above. method: "automatic",
    "radix" or "bitonic" (all bits). The commands start after the events of wait_for."""
    return _suite_of(keys).sort(keys, values, first_bit=first_bit, end_bit=end_bit, method=method, wait_for=wait_for)


def argsort(keys: Any, order: Any, *, first_bit: int = 0, end_bit: int = 0, method: str = "automatic",
            wait_for: Sequence[Any] | None = None) -> Any:
    """Does the same, and order[i] (uint32) becomes the place that the i-th smallest key had."""
    return _suite_of(keys).argsort(keys, order, first_bit=first_bit, end_bit=end_bit, method=method, wait_for=wait_for)


def scan(words: Any, total: Any = None, *, wait_for: Sequence[Any] | None = None) -> Any:
    """Makes exclusive prefix sums of uint32 words in place, modulo 2^32; total[0] becomes the sum of all."""
    return _suite_of(words).scan(words, total, wait_for=wait_for)


def compact(words: Any, indices: Any, total: Any, *, wait_for: Sequence[Any] | None = None) -> Any:
    """Writes the indices of words that are not NOTHING to indices, ascending, and their number to total[0]. indices has
    room for as many as there are words."""
    return _suite_of(words).compact(words, indices, total, wait_for=wait_for)


def curve_keys(points: Any, keys: Any, curve: str, lower: Sequence[float], upper: Sequence[float], cells: int, *,
               wait_for: Sequence[Any] | None = None) -> Any:
    """Writes the keys of points (float32, shape (n, d)) along a space-filling curve to keys (n of uint32 or uint64).

    curve: "morton2", "morton3", "morton5", "hilbert2" or "hilbert3", whose number is d. A key is the code of the cell of
    the box from lower to upper (d numbers each) in which the point lies; there are `cells` of them in each dimension.
    Points outside go to the nearest cell. A sort by curve_bits(curve, cells) bits puts near points side by side."""
    return _suite_of(points).curve_keys(points, keys, curve, lower, upper, cells, wait_for=wait_for)


def curve_bits(curve: str, cells: int) -> int:
    """The number of the lowest bits of keys that count in a box of so many cells in each dimension."""
    return _dimensions(curve) * max(cells - 1, 0).bit_length()
