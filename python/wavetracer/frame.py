# SPDX-License-Identifier: Apache-2.0
"""The results of one frame, as the library has just computed them."""
from __future__ import annotations

import ctypes
import weakref
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._arguments import Unique, encoded, shown
from ._columns import read_only
from ._cube import Cube
from ._library import Column, Counts, Handle, call, library
from ._radar_row import Radar
from .errors import ArgumentError, ConfigError
from .gradients import Raw
from .links import Ends, Links
from .paths import Paths

Array = NDArray[Any]

_DETECTION_COLUMNS = ("range_m", "delay_s", "speed_m_s", "doppler_hz", "power_dbm", "threshold_dbm", "azimuth_rad",
                      "elevation_rad")

# Delays and amplitudes of rows of a frame between all pairs of elements; see Simulation._between_elements.
Elements = Callable[[int, Array, tuple[int, int]], tuple[Array, Array]]
# Derivatives of rows of a frame; see Simulation._gradient.
Gradient = Callable[["int", "Array | None", int], Raw]


class _Columns(Unique):
    """The columns of wavetracer.h by their names: views of the library's memory, which they keep."""

    _instead = "pickle the paths, or columns as arrays"

    def __init__(self, handle: int):
        self.handle = handle
        self.rx_ports: int = library.wavetracer_frame_rx_ports(handle)
        self.tx_ports: int = library.wavetracer_frame_tx_ports(handle)
        weakref.finalize(self, library.wavetracer_frame_free, handle)

    def __call__(self, name: str) -> Array:
        if not isinstance(name, str):
            raise ArgumentError(f"a column has a name, such as \"delay_s\", and is not {shown(name)}; wavetracer.columns() "
                            "lists them")
        column = Column()
        call(library.wavetracer_frame_column, self.handle, encoded(name, "the name of a column"), ctypes.byref(column))
        values = read_only(column, self)  # the view keeps these columns, and they keep the frame
        return values.reshape(column.rows, self.rx_ports, self.tx_ports) if name == "a" else values

    def cube(self, row: int) -> tuple[tuple[int, int, int, int], Array]:
        """The shape of the cube of a row of radars, and its values, none with cube = false."""
        column, shape = Column(), (ctypes.c_size_t * 4)()
        call(library.wavetracer_frame_radar_cube, self.handle, row, shape, ctypes.byref(column))
        return (shape[0], shape[1], shape[2], shape[3]), read_only(column, self)

    def axis(self, row: int, name: str) -> Array:
        """An axis of the same cube."""
        column = Column()
        call(library.wavetracer_frame_radar_axis, self.handle, row, name.encode(), ctypes.byref(column))
        return read_only(column, self)


class Frame(Unique):
    """The results of one frame: `paths`, `links`, `radars`, `counts`, `missed`, `warnings`. frame["delay_s"] is any column of
    wavetracer.h. A frame may outlive its simulation. It cannot be pickled or copied; its paths, links and columns can.
    """

    _instead = ("pickle frame.paths, frame.links or columns such as frame[\"delay_s\"], or write the frame with "
                "Simulation.write() and open the folder")
    __iter__ = None  # it has columns by name, and no order

    def __init__(self, handle: int, ends: Ends, elements: Elements | None, gradient: Gradient,
                 radar_names: tuple[str, ...] = ()):
        self._columns = _Columns(handle)
        self._radar_names = radar_names
        self._ends, self._elements, self._gradient = ends, elements, gradient
        self.number: int = library.wavetracer_frame_number(handle)
        self.time_s: float = library.wavetracer_frame_time_s(handle)
        self.counts: Counts = library.wavetracer_frame_counts(handle)
        self.warnings: list[str] = library.wavetracer_frame_warnings(handle).decode().splitlines()

    @property
    def _handle(self) -> Any:
        return Handle(self._columns.handle)

    def __len__(self) -> int:
        """The number of paths."""
        return int(self.counts.paths)

    def __getitem__(self, name: str) -> Array:
        """A column of wavetracer.h, read-only, without a copy; wavetracer.columns() lists them."""
        return self._columns(name)

    @property
    def paths(self) -> Paths:
        """All paths of the frame; their columns are views of the library's memory."""
        elements, gradient = self._elements, self._gradient
        between = None if elements is None else lambda rows, shape: elements(self._columns.handle, rows, shape)
        return Paths(self._columns, self._ends, links=self.links, elements=between,
                     gradient=lambda rows, wrt: gradient(self._columns.handle, rows, wrt))

    @property
    def links(self) -> Links:
        """One row per link that was asked for, with a path or without."""
        pairs = self["link"]
        values = {"tx": pairs[:, 0], "rx": pairs[:, 1], "paths": self["link_paths"], "los": self["link_los"] != 0}
        values |= {name: self["link_" + name] for name in Links.columns[4:]}
        return Links(values, self._ends)

    @property
    def radars(self) -> list[Radar]:
        """The echoes that each [[radar]] receives: a Radar for each of its links in the frame. `detections` is a dict of columns, by
        falling power; `cube` is a wavetracer.radar.Cube, or None with cube = false. Empty without [[radar]]."""
        out = []
        offset = self["detection_offset"]
        for row, radar in enumerate(self["radar"]):
            part = slice(int(offset[row]), int(offset[row + 1]))
            shape, values = self._columns.cube(row)
            left_out = int(self["radar_left_out"][row])
            cube = Cube(values.reshape(shape), self._columns.axis(row, "delay_s"), self._columns.axis(row, "doppler_hz"),
                        self._ends.frequency_hz, left_out) if len(values) else None
            out.append(Radar(self._radar_names[radar], self._ends.transmitters[self["radar_tx"][row]],
                             self._ends.receivers[self["radar_rx"][row]], left_out,
                             {name: self["detection_" + name][part] for name in _DETECTION_COLUMNS}, cube))
        return out

    @property
    def transmitter_position_m(self) -> Array:
        """Shape (transmitters, 3), metres in the coordinates of the scene file; NaN while one is absent."""
        return self["transmitter_position_m"]

    @property
    def receiver_position_m(self) -> Array:
        """Shape (receivers, 3), metres in the coordinates of the scene file; NaN while one is absent."""
        return self["receiver_position_m"]

    @property
    def missed(self) -> dict[str, dict[str, float]] | None:
        """Estimates of the paths that the rays of the frame have missed: missed["paths"] and missed["power_share"],
        each with "estimate", and "low" to "high", the interval that contains the true value in 95 cases of 100. None
        with beams, and where the rays do not show it; then `warnings` says why, unless the configuration does."""
        of = library.wavetracer_frame_missed(self._handle)
        if np.isnan(of.paths):
            return None
        return {what: {"estimate": getattr(of, what), "low": getattr(of, what + "_low"),
                       "high": getattr(of, what + "_high")} for what in ("paths", "power_share")}

    @property
    def certificate(self) -> dict[str, float] | None:
        """With trace.discovery = "beams": the frame has every path of at most certificate["depth"] interactions, of which
        at most certificate["edges"] are at edges, unless a point of the path lies in one of the beams that were too thin
        to follow. certificate["any_depth"] is true if no path has more of them. certificate["left_out_sr"] is a bound of
        the solid angle of these beams, over all ends, and certificate["left_out_share"] is the same of all directions of
        all ends. certificate["left_out_power"] is a bound of the power in them, where an isotropic antenna sends 1 W: a
        link misses no more by reflections in them, but for the gain of its transmitter's antenna. With trace.floor_db all
        this is about the paths whose gain between isotropic antennas is certificate["floor_db"] or more; weaker beams
        were not followed, and certificate["weak_share"] is a bound of their share of the power. None without beams."""
        of = library.wavetracer_frame_certificate(self._handle)
        if np.isnan(of.left_out_sr):
            return None
        out = {"depth": of.depth, "any_depth": bool(of.any_depth), "edges": of.edges,
               "left_out_sr": of.left_out_sr, "left_out_share": of.left_out_share, "left_out_power": of.left_out_power}
        if np.isinf(of.floor_db):
            return out
        return out | {"floor_db": of.floor_db, "weak_share": of.weak_share}

    def __repr__(self) -> str:
        return f"<wavetracer.Frame {self.number} at {self.time_s:.15g} s: {len(self):,} paths of {len(self.links):,} links>"


def handles(frames: list[Frame]) -> Any:
    """The frames as an array of the library's."""
    if not all(isinstance(frame, Frame) for frame in frames):
        raise ConfigError("write: give frames that this simulation has computed, in a list")
    return (Handle * len(frames))(*(frame._columns.handle for frame in frames))
