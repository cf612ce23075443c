"""Propagation paths by ray tracing, through the C interface of libwavetracer. Needs numpy.

    import wavetracer
    with wavetracer.Simulation(open("demo.toml").read(), sets=["trace.rays=100000"]) as simulation:
        for frame in simulation.frames():
            print(frame.number, frame["delay_s"], frame["a"])

Columns are those of wavetracer.h. They are views of the library's own memory, read-only, and keep it alive.
The library is the one that WAVETRACER_LIBRARY names, else the system's.
"""
import ctypes
import os
import weakref

import numpy as np

_SONAME = "libwavetracer.so.0.2"
_TYPES = {1: np.uint8, 2: np.uint32, 3: np.uint64, 4: np.float64, 5: np.complex128, 6: np.complex64}
_Handle, _Text = ctypes.c_void_p, ctypes.c_char_p


class Error(Exception):
    """code is what the program `wavetracer` would exit with: 1 runtime, 2 usage, 3 input, 4 device."""

    def __init__(self, code, message):
        super().__init__(message)
        self.code = code


class Counts(ctypes.Structure):
    _fields_ = [(name, ctypes.c_uint64)
                for name in ("rays", "segments", "hits", "sequences", "candidates", "solved", "paths")]


class _Missed(ctypes.Structure):
    _fields_ = [(what + bound, ctypes.c_double) for what in ("paths", "power_share") for bound in ("", "_low", "_high")]


class _Column(ctypes.Structure):
    _fields_ = [("data", ctypes.c_void_p), ("rows", ctypes.c_size_t), ("width", ctypes.c_size_t),
                ("type", ctypes.c_int)]


def _load():
    library = ctypes.CDLL(os.environ.get("WAVETRACER_LIBRARY", _SONAME))
    error = ctypes.POINTER(_Handle)
    for name, result, arguments in (
            ("error_code", ctypes.c_int, [_Handle]), ("error_message", _Text, [_Handle]), ("error_free", None, [_Handle]),
            ("version", _Text, []),
            ("open", _Handle, [_Text, _Text, ctypes.POINTER(_Text), ctypes.c_size_t, _Text, error]),
            ("close", None, [_Handle]), ("frame_count", ctypes.c_uint32, [_Handle]),
            ("time_s", ctypes.c_double, [_Handle, ctypes.c_uint32]),
            ("transmitter_count", ctypes.c_size_t, [_Handle]), ("receiver_count", ctypes.c_size_t, [_Handle]),
            ("transmitter_name", _Text, [_Handle, ctypes.c_size_t]), ("receiver_name", _Text, [_Handle, ctypes.c_size_t]),
            ("device_name", _Text, [_Handle]), ("config_text", _Text, [_Handle]), ("warnings", _Text, [_Handle]),
            ("run_frame", _Handle, [_Handle, ctypes.c_uint32, error]), ("frame_free", None, [_Handle]),
            ("forget", None, [_Handle]), ("frame_number", ctypes.c_uint32, [_Handle]),
            ("frame_rx_ports", ctypes.c_uint32, [_Handle]), ("frame_tx_ports", ctypes.c_uint32, [_Handle]),
            ("frame_counts", Counts, [_Handle]), ("frame_missed", _Missed, [_Handle]),
            ("frame_warnings", _Text, [_Handle]),
            ("frame_column", ctypes.c_int, [_Handle, _Text, ctypes.POINTER(_Column), error]),
            ("column_count", ctypes.c_size_t, []), ("column_name", _Text, [ctypes.c_size_t]),
            ("write", ctypes.c_int, [_Handle, _Text, ctypes.POINTER(_Handle), ctypes.c_size_t, error])):
        function = getattr(library, "wavetracer_" + name)
        function.restype, function.argtypes = result, arguments
    return library


_library = _load()


def _call(function, *arguments):
    """The result of a function that takes an error last; raises the error."""
    error = _Handle()
    result = function(*arguments, ctypes.byref(error))
    if error:
        raised = Error(_library.wavetracer_error_code(error), _library.wavetracer_error_message(error).decode())
        _library.wavetracer_error_free(error)
        raise raised
    return result


def version():
    return _library.wavetracer_version().decode()


def columns():
    """The names that Frame answers to."""
    return [_library.wavetracer_column_name(i).decode() for i in range(_library.wavetracer_column_count())]


def _missed(of):
    """As `missed` in summary.json; None where that is not known."""
    if np.isnan(of.paths):
        return None
    return {what: {"estimate": getattr(of, what), "low": getattr(of, what + "_low"), "high": getattr(of, what + "_high")}
            for what in ("paths", "power_share")}


class Frame:
    """The results of one frame: frame["delay_s"] is a column, one row per path. See wavetracer.h for all of them.

    missed["paths"] and missed["power_share"] say what the rays of the frame may have missed ("estimate", and "low" to
    "high", where the truth is in 95 cases of 100); it is None where that is not known. The column "link_missed_power_share"
    says it of each link.
    """

    def __init__(self, handle):
        self._handle = handle
        weakref.finalize(self, _library.wavetracer_frame_free, handle)
        self.number = _library.wavetracer_frame_number(handle)
        self.counts = _library.wavetracer_frame_counts(handle)
        self.missed = _missed(_library.wavetracer_frame_missed(handle))
        self.warnings = _library.wavetracer_frame_warnings(handle).decode().splitlines()

    def __len__(self):
        return self.counts.paths

    def __getitem__(self, name):
        column = _Column()
        _call(_library.wavetracer_frame_column, self._handle, name.encode(), ctypes.byref(column))
        dtype = np.dtype(_TYPES[column.type])
        memory = (ctypes.c_uint8 * (column.rows * column.width * dtype.itemsize)).from_address(column.data)
        memory.frame = self  # the view keeps its memory, and that keeps the frame
        values = np.frombuffer(memory, dtype)
        values.flags.writeable = False
        if name == "a":
            return values.reshape(column.rows, _library.wavetracer_frame_rx_ports(self._handle),
                                  _library.wavetracer_frame_tx_ports(self._handle))
        return values if column.width == 1 else values.reshape(column.rows, column.width)


class Simulation:
    """A scene on a device. config: TOML text; folder: where its relative paths start; sets: "key=value" texts."""

    def __init__(self, config, folder=None, sets=(), device=None):
        texts = (_Text * len(sets))(*(text.encode() for text in sets))
        self._handle = _call(_library.wavetracer_open, config.encode(), os.fsencode(folder) if folder else None, texts,
                             len(sets), device.encode() if device else None)
        self._close = weakref.finalize(self, _library.wavetracer_close, self._handle)
        library = _library
        self.transmitters = [library.wavetracer_transmitter_name(self._handle, i).decode()
                             for i in range(library.wavetracer_transmitter_count(self._handle))]
        self.receivers = [library.wavetracer_receiver_name(self._handle, i).decode()
                          for i in range(library.wavetracer_receiver_count(self._handle))]
        self.device = library.wavetracer_device_name(self._handle).decode()
        self.config = library.wavetracer_config_text(self._handle).decode()
        self.warnings = library.wavetracer_warnings(self._handle).decode().splitlines()
        self.times_s = [library.wavetracer_time_s(self._handle, i)
                        for i in range(library.wavetracer_frame_count(self._handle))]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        """Gives the device back; frames stay."""
        self._close()
        self._handle = None

    def __len__(self):
        return len(self.times_s)

    def run_frame(self, number):
        return Frame(_call(_library.wavetracer_run_frame, self._handle, number))

    def frames(self):
        """All frames in their order, each solved when it is asked for."""
        return (self.run_frame(number) for number in range(len(self)))

    def forget(self):
        """The next frame is cold: it reuses nothing of earlier ones."""
        _library.wavetracer_forget(self._handle)

    def write(self, folder, frames):
        """paths.h5, links.csv and summary.json of these frames, sorted by their number, as the program writes them."""
        handles = (_Handle * len(frames))(*(frame._handle for frame in frames))
        _call(_library.wavetracer_write, self._handle, os.fsencode(folder), handles, len(frames))
