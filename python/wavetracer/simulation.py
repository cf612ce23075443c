# SPDX-License-Identifier: Apache-2.0
"""A scene on a device: a configuration in, frames of propagation paths out."""
from __future__ import annotations

import os
import pathlib
import re
import weakref
from collections.abc import Iterable, Iterator, Mapping
from types import TracebackType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _progress, _toml
from ._arguments import Unique, each, encoded, integer, path, shown
from ._library import Doubles, Observer, Sizes, Text, call, library, text
from ._session import Session
from .errors import ArgumentError, ConfigError, FrameStopped, InputError
from .frame import Frame, handles
from .gradients import Raw, raw_gradient
from .links import Ends
from .runs import Run

_NOBODY = Observer()
Array = NDArray[Any]


def read_config(config: str | os.PathLike[str] | Mapping[str, Any], folder: str | os.PathLike[str] | None
                ) -> tuple[str, str | None]:
    """The TOML text of a configuration, and the folder where its relative paths start."""
    where = path(folder, "folder") if folder is not None else None
    if isinstance(config, Mapping):
        return _toml.document(config), where
    if not isinstance(config, (str, os.PathLike)):
        raise ArgumentError(f"config is the path of a TOML file, TOML text or a dict, not {shown(config)}")
    if isinstance(config, str) and ("\n" in config or "=" in config or not config.strip()):
        return config, where
    file = pathlib.Path(path(config, "config"))
    try:
        return file.read_text(encoding="utf-8-sig"), where if where is not None else str(file.parent)
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{file}: the configuration cannot be read: {getattr(error, 'strerror', None) or error}"
                         ) from None


def _as_given(error: ConfigError, place: str, where: str | None, sets: list[str]) -> ConfigError:
    """The error with the places that the caller knows. The library has the text of the configuration under the name
    "config". place: its name for the caller, or "" for a dict, which has no lines; keywords name their keys."""
    name = re.escape(os.path.join(where or "", "config"))
    lines = []
    for line in str(error).splitlines():
        line = re.sub(rf"^{name}:(\d+:\d+: )", lambda found: place and f"{place}:{found[1]}", line)
        lines.append(next((line.removeprefix(f"--set {one}: ") for one in sets if line.startswith(f"--set {one}: ")), line))
    return ConfigError("\n".join(lines))


class Simulation(Unique):
    """A scene on an OpenCL device.

    config: the path of a TOML file, TOML text, or a dict of the same form, such as
    {"scene": {"generate": "--blocks 4"}, "transmitter": [{"name": "rsu", "position_m": [8, 8, 6]}]}.
    docs/configuration.md has every key. folder: where relative paths in it start; the folder of the file, else the
    current one. device: part of a device's or platform's name, or its index; see wavetracer.devices().
    sets: keys that are set over the configuration: trace={"rays": 100_000}, **{"radio.frequency_hz": 28e9}.

    Threads that use one simulation take turns: each waits until the frame of the one before is there. Processes that
    are forked cannot use it (multiprocessing: "spawn"), nor can it be pickled or copied. It holds memory of its device
    until close(), or the end of a `with`.
    """

    _instead = "pickle what it was made of (its attribute `config` is TOML text), and open it again"

    def __init__(self, config: str | os.PathLike[str] | Mapping[str, Any], *,
                 folder: str | os.PathLike[str] | None = None, device: str | int | None = None, **sets: Any):
        content, where = read_config(config, folder)
        lines = [encoded(line, line.split("=")[0]) for line in _toml.sets(sets)]
        texts = (Text * len(lines))(*lines)
        if device is not None and (isinstance(device, bool) or not isinstance(device, (str, int, np.integer))):
            raise ArgumentError(f"device is a part of a device's name, or its index, not {shown(device)}")
        try:
            handle = call(library.wavetracer_open, encoded(content, "config"), os.fsencode(where) if where else None, texts,
                          len(lines), encoded(str(device), "device") if device is not None else None)
        except ConfigError as error:
            place = "" if isinstance(config, Mapping) else "config" if config is content else str(config)
            raise _as_given(error, place, where, [line.decode() for line in lines]) from None
        self._session = Session(handle)
        weakref.finalize(self, self._session.close)
        self.transmitters: list[str] = [text(library.wavetracer_transmitter_name(handle, i))
                                        for i in range(library.wavetracer_transmitter_count(handle))]
        self.receivers: list[str] = [text(library.wavetracer_receiver_name(handle, i))
                                     for i in range(library.wavetracer_receiver_count(handle))]
        self.carriers_hz: list[float] = [library.wavetracer_carrier_hz(handle, i)
                                         for i in range(library.wavetracer_carrier_count(handle))]
        self.radars: list[str] = [text(library.wavetracer_radar_name(handle, i))
                                  for i in range(library.wavetracer_radar_count(handle))]
        self.frequency_hz = self.carriers_hz[0]
        self.device: str = text(library.wavetracer_device_name(handle))
        self.config: str = text(library.wavetracer_config_text(handle))
        self.warnings: list[str] = text(library.wavetracer_warnings(handle)).splitlines()
        self.times_s: list[float] = [library.wavetracer_time_s(handle, i)
                                     for i in range(library.wavetracer_frame_count(handle))]
        tx_elements = [library.wavetracer_transmitter_elements(handle, i) for i in range(len(self.transmitters))]
        rx_elements = [library.wavetracer_receiver_elements(handle, i) for i in range(len(self.receivers))]
        self._arrays = max(tx_elements + rx_elements, default=1) > 1
        self._ends = Ends(tuple(self.transmitters), tuple(self.receivers), self.frequency_hz, tuple(tx_elements),
                          tuple(rx_elements), tuple(self.carriers_hz))

    def __enter__(self) -> Simulation:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        self.close()

    def close(self) -> None:
        """Gives the device back; frames stay. Another thread's frame is waited for."""
        self._session.close()

    def __len__(self) -> int:
        """The number of frames."""
        return len(self.times_s)

    def __repr__(self) -> str:
        return (f"<wavetracer.Simulation on {self.device}: {len(self.transmitters)} transmitters, "
                f"{len(self.receivers)} receivers, {len(self)} frames>")

    def run_frame(self, number: int = 0) -> Frame:
        """Computes a frame, 0 to len(simulation) - 1. Ctrl-C gives it up, and the simulation can go on with any frame,
        the next one cold. With trace.reuse, what a frame finds depends on the frames since the last forget()."""
        return self._solve(number, None)

    def _solve(self, number: int, bar: Any) -> Frame:
        number = integer(number, "the number of a frame")
        if not 0 <= number < len(self):
            raise ConfigError(f"there is no frame {number}, only {len(self)} counted from 0")
        failed: list[BaseException] = []
        with self._session.use("run_frame") as handle, _progress.interruptible() as stopped:
            watch = _progress.watcher(bar, stopped)

            def observe(_: Any, stage: bytes, done: int, total: int) -> int:
                try:
                    return int(watch(stage.decode(), done, total))
                except BaseException as error:  # cannot pass through the library
                    failed.append(error)
                    return 0

            observer = Observer(observe)
            library.wavetracer_observe(handle, observer, None)
            try:
                return Frame(call(library.wavetracer_run_frame, handle, number), self._ends,
                             self._between_elements if self._arrays else None, self._gradient, tuple(self.radars))
            except FrameStopped:
                if failed:
                    raise failed[0] from None
                raise
            finally:
                library.wavetracer_observe(handle, _NOBODY, None)

    def frames(self, numbers: Iterable[int] | None = None, *, progress: _progress.Wanted = None) -> Iterator[Frame]:
        """Yields frames in their order; each is computed when it is asked for. numbers: some of them, such as range(0,
        10).

        progress: True shows a bar of tqdm; a class of tqdm's interface shows that; None shows one in a notebook or a
        terminal if tqdm is installed.
        """
        chosen = each(range(len(self)) if numbers is None else numbers,
                      "numbers are those of frames, such as [0, 2] or range(0, 10)")
        bar = _progress.bar(progress, len(chosen))
        try:
            for number in chosen:
                frame = self._solve(number, bar)
                if bar is not None:
                    bar.update(1)
                yield frame
        finally:
            if bar is not None:
                bar.close()

    def run(self, folder: str | os.PathLike[str], numbers: Iterable[int] | None = None, *,
            progress: _progress.Wanted = None) -> Run:
        """Computes frames, all of them or some, writes them into a folder, and opens it. All of them are in memory at
        a time: for drives that are larger than that, use the command `wavetracer run`."""
        where = path(folder, "folder")
        return self.write(where, list(self.frames(numbers, progress=progress)))

    def element_positions_m(self, name: str) -> Array:
        """Positions of the elements of a transmitter's or receiver's [[array]]: metres from its position in the axes of
        its antenna (boresight +x), shape (elements, 3)."""
        for side, names, counts in (("transmitter", self.transmitters, self._ends.tx_elements),
                                    ("receiver", self.receivers, self._ends.rx_elements)):
            if name in names:
                out = np.zeros((counts[names.index(name)], 3))
                with self._session.use("element_positions_m") as handle:
                    call(getattr(library, f"wavetracer_{side}_element_positions"), handle, names.index(name),
                         out.ctypes.data_as(Doubles), out.size)
                return out
        raise ConfigError(f"there is no transmitter or receiver {name!r}")

    def _between_elements(self, frame: int, rows: Array, shape: tuple[int, int]) -> tuple[Array, Array]:
        """Delays (s) and amplitudes of these rows of a frame between all pairs of elements, each of shape
        (rows, rx elements, tx elements); amplitudes are 0 where an end has fewer elements than shape says."""
        wanted = np.ascontiguousarray(rows, np.uintp)
        delay_s, amplitude = np.zeros((2, len(wanted), *shape))
        with self._session.use("paths between the elements of arrays") as handle:
            call(library.wavetracer_element_paths, handle, frame, wanted.ctypes.data_as(Sizes), len(wanted), *shape,
                 delay_s.ctypes.data_as(Doubles), amplitude.ctypes.data_as(Doubles))
        return delay_s, amplitude

    def _gradient(self, frame: int, rows: Array | None, wrt: int) -> Raw:
        """Derivatives of rows of a frame (None: all), by a sum of enum wavetracer_wrt."""
        with self._session.use("derivatives of paths") as handle:
            return raw_gradient(handle, frame, rows, wrt)

    def forget(self) -> None:
        """The next frame is cold: it reuses nothing of earlier ones."""
        with self._session.use("forget") as handle:
            library.wavetracer_forget(handle)

    def write(self, folder: str | os.PathLike[str], frames: Iterable[Frame]) -> Run:
        """Writes paths.h5, links.csv and summary.json of these frames, sorted by their number, as the program writes
        them, and opens the folder."""
        where = path(folder, "folder")
        chosen = each(frames, "write: give frames that this simulation has computed, in a list")
        with self._session.use("write") as handle:
            call(library.wavetracer_write, handle, os.fsencode(where), handles(chosen), len(chosen))
        return Run(where)
