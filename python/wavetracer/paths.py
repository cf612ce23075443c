# SPDX-License-Identifier: Apache-2.0
"""Paths of one frame as NumPy columns, the figures of links, and the channels that paths make."""
from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _channel, _figures
from ._arguments import each, integer
from .errors import ConfigError
from .gradients import Compute, Gradients, gradients
from .links import Chosen, Ends, Links, places_of

if TYPE_CHECKING:
    import pandas
    import xarray

Array = NDArray[Any]
# Delays and amplitudes of rows of a frame between all pairs of elements, for (rx elements, tx elements).
Between = Callable[[Array, "tuple[int, int]"], "tuple[Array, Array]"]

# The word for a path, which depends on the most special of its interactions, and the bit of the interaction that
# decides it; the least special comes first, as in include/wavetracer/interaction_kinds.hpp.
KINDS = {"line_of_sight": 0, "reflected": 1, "transmitted": 4, "diffracted": 8, "scattered": 2,
         "echoed": 16}
_SPECIAL = tuple(KINDS.values())[:0:-1]
_COLUMNS = ("tx", "rx", "depth", "delay_s", "gain_db", "a", "aod_theta_rad", "aod_phi_rad", "aoa_theta_rad", "aoa_phi_rad",
            "doppler_hz", "target", "group", "group_weight", "lifetime_m", "vertex_offset", "vertex_position_m",
            "vertex_interaction", "vertex_surface", "vertex_instance")
_AT_CARRIERS = ("carrier_a", "carrier_gain_db", "carrier_doppler_hz")


class _Kept:
    """Columns, and delays and amplitudes between elements, as arrays."""

    def __init__(self, columns: dict[str, Array], between: tuple[Array, Array] | str | None):
        self.columns, self.between = columns, between  # a text: why it is not known

    def column(self, name: str) -> Array:
        self.columns[name].flags.writeable = False
        return self.columns[name]

    def elements(self, rows: Array, shape: tuple[int, int]) -> tuple[Array, Array]:
        if isinstance(self.between, str):
            raise ConfigError(self.between)
        assert self.between is not None
        delay_s, amplitude = (values[rows, :shape[0], :shape[1]] for values in self.between)
        return delay_s, amplitude


def _kept_paths(kept: _Kept, ends: Ends, places: tuple[list[int], list[int]], links: Links | None) -> Paths:
    return Paths(kept.column, ends, places, links, None if kept.between is None else kept.elements)


class Paths:
    """The propagation paths of one frame: one row per path, sorted by transmitter, receiver and delay.

    Every column is an attribute, a read-only NumPy array. Columns of a frame that was just computed are views of the
    library's memory, without a copy; they stay valid when the frame and the simulation are gone. Paths that are pickled
    or copied have columns of their own.
    """

    def __init__(self, column: Callable[[str], Array], ends: Ends, places: tuple[list[int], list[int]] | None = None,
                 links: Links | None = None, elements: Between | None = None, rows: Array | None = None,
                 gradient: Compute | None = None):
        self._column, self._ends, self._links = column, ends, links
        self._elements, self._rows = elements, rows  # rows: where these paths are in their frame, None: all of it
        self._gradient = gradient
        self._tx, self._rx = places or (list(range(len(ends.transmitters))), list(range(len(ends.receivers))))

    # --- columns ---

    @property
    def tx(self) -> Array:
        """Transmitters, shape (paths,), uint32: places in the simulation's list."""
        return self._column("tx")

    @property
    def rx(self) -> Array:
        """Receivers, shape (paths,), uint32: places in the simulation's list."""
        return self._column("rx")

    @property
    def depth(self) -> Array:
        """Numbers of interactions, shape (paths,), uint32; 0 is line of sight."""
        return self._column("depth")

    @property
    def delay_s(self) -> Array:
        """Absolute delays, shape (paths,), seconds from the transmitter to the receiver."""
        return self._column("delay_s")

    @property
    def gain_db(self) -> Array:
        """10 log10 of the sum of |a|^2 over pairs of ports, shape (paths,)."""
        return self._column("gain_db")

    @property
    def a(self) -> Array:
        """Passband coefficients without the carrier phase of the delay, shape (paths, rx ports, tx ports), complex128:
        h(f) = sum a exp(-j 2 pi f delay_s). In free space between isotropic antennas |a| = wavelength / (4 pi d)."""
        return self._column("a")

    @property
    def aod_theta_rad(self) -> Array:
        """Angles of departure from +z, shape (paths,), radians from 0 to pi, in the global frame."""
        return self._column("aod_theta_rad")

    @property
    def aod_phi_rad(self) -> Array:
        """Angles of departure from +x towards +y, shape (paths,), radians, in the global frame."""
        return self._column("aod_phi_rad")

    @property
    def aoa_theta_rad(self) -> Array:
        """Angles of arrival from +z, shape (paths,), radians: the direction that the path comes from."""
        return self._column("aoa_theta_rad")

    @property
    def aoa_phi_rad(self) -> Array:
        """Angles of arrival from +x towards +y, shape (paths,), radians: the direction that the path comes from."""
        return self._column("aoa_phi_rad")

    @property
    def doppler_hz(self) -> Array:
        """Doppler shifts, shape (paths,), hertz; positive while the path gets shorter."""
        return self._column("doppler_hz")

    @property
    def target(self) -> Array:
        """The target of sensing that each path goes by, a row of /targets of paths.h5, uint32; 4294967295 is none. No rows
        where there are no targets."""
        return self._column("target")

    @property
    def group(self) -> Array:
        """The groups of paths that are one wave: numbers of those of each path in its link, shape (paths, 4), uint32, the
        one with the largest weight first; 4294967295 is none. No rows where every path is a group of its own."""
        return self._column("group")

    @property
    def group_weight(self) -> Array:
        """The part of each path that is one wave with each of its groups, shape (paths, 4). The power of a link is the
        sum over groups and pairs of ports of |sum over paths of weight a exp(-j 2 pi f tau)|^2."""
        return self._column("group_weight")

    @property
    def lifetime_m(self) -> Array:
        """Lifetimes of paths in metres, shape (paths,): a path is there while both of its ends and all points of all
        vehicles are no farther than this from their places. A lower bound, 0 where none is known. No rows without
        output.lifetimes."""
        return self._column("lifetime_m")

    @property
    def vertex_offset(self) -> Array:
        """Rows vertex_offset[i] to vertex_offset[i + 1] of the columns vertex_... are the interactions of path i, from
        the transmitter on. Shape (paths + 1,), uint64."""
        return self._column("vertex_offset")

    @property
    def vertex_position_m(self) -> Array:
        """Positions of interactions, shape (interactions, 3), metres in the coordinates of the scene file."""
        return self._column("vertex_position_m")

    @property
    def vertex_interaction(self) -> Array:
        """Kinds of interactions, shape (interactions,), uint8: 1 reflection, 2 diffuse scattering, 4 transmission,
        8 diffraction, 16 target."""
        return self._column("vertex_interaction")

    @property
    def vertex_surface(self) -> Array:
        """Surfaces, or edges of diffractions, in their scene or model, shape (interactions,), uint32."""
        return self._column("vertex_surface")

    @property
    def vertex_instance(self) -> Array:
        """Vehicles, shape (interactions,), uint32; 4294967295 is the static scene."""
        return self._column("vertex_instance")

    @property
    def kind(self) -> Array:
        """The kind of each path: "line_of_sight", "reflected", "transmitted", "diffracted", "scattered" or "echoed", by
        its interactions: of the words that apply, the last in this list. Shape (paths,), texts."""
        bits = _figures.joined_bits(self.vertex_interaction, self.vertex_offset)
        words = {bit: word for word, bit in KINDS.items()}
        return np.select([(bits & bit) != 0 for bit in _SPECIAL], [words[bit] for bit in _SPECIAL], words[0])

    # --- shapes and names of the columns ---

    @property
    def transmitters(self) -> list[str]:
        """The names on the axis `tx` of channels: those that select() has kept, or all."""
        return [self._ends.transmitters[i] for i in self._tx]

    @property
    def receivers(self) -> list[str]:
        """The names on the axis `rx` of channels: those that select() has kept, or all."""
        return [self._ends.receivers[i] for i in self._rx]

    @property
    def frequency_hz(self) -> float:
        """The carrier."""
        return self._ends.frequency_hz

    @property
    def links(self) -> Links:
        """The figures of all links that were asked for. After select(kind=...) they are those of the paths left."""
        if self._links is None:
            raise ConfigError("these paths were made without their links")
        return self._links

    def __len__(self) -> int:
        return len(self.delay_s)

    def __reduce__(self) -> Any:
        names = _COLUMNS + (_AT_CARRIERS if len(self._ends.carriers_hz) > 1 else ())
        between: tuple[Array, Array] | str | None = None
        if self._elements is not None:
            try:
                between = self.elements()
            except ConfigError as error:
                between = str(error)
        kept = _Kept({name: np.array(self._column(name)) for name in names}, between)
        return _kept_paths, (kept, self._ends, (self._tx, self._rx), self._links)

    def __repr__(self) -> str:
        words, counts = np.unique(self.kind, return_counts=True)
        return (f"<wavetracer.Paths: {len(self):,} paths of {len(self.transmitters)} transmitters and "
                f"{len(self.receivers)} receivers"
                + "".join(f", {n:,} {word.replace('_', ' ')}" for word, n in zip(words, counts)) + ">")

    def points(self, path: int) -> Array:
        """The interactions of a path in their order, shape (depth, 3), metres; its ends are not among them."""
        path = integer(path, "the place of a path")
        if not 0 <= path < len(self):
            raise ConfigError(f"there is no path {path}, only {len(self)} counted from 0")
        first, last = self.vertex_offset[path:path + 2].astype(int)
        return self.vertex_position_m[first:last]

    def select(self, tx: Chosen = None, rx: Chosen = None, kind: str | Iterable[str] | None = None) -> Paths:
        """The paths of some transmitters, receivers and kinds, as Paths (a copy). None takes all.

        tx, rx: a name, a pattern with * and ?, a place in the list of all, or several of these. kind: one or several of
        "line_of_sight", "reflected", "transmitted", "diffracted", "scattered". Ends that are not selected are not on
        the axes of channels and of to_xarray(); those that are have the order in which they are given.
        """
        def chosen_of(own: list[int], names: Sequence[str], wanted: Chosen, what: str) -> list[int]:
            return own if wanted is None else [i for i in places_of(names, wanted, what) if i in set(own)]

        places = (chosen_of(self._tx, self._ends.transmitters, tx, "transmitter"),
                  chosen_of(self._rx, self._ends.receivers, rx, "receiver"))
        mask = np.isin(self.tx, places[0]) & np.isin(self.rx, places[1])
        kinds = None if kind is None else [kind] if isinstance(kind, str) else each(kind, f"kind: give {', '.join(KINDS)}")
        if kinds is not None:
            for word in kinds:
                if word not in KINDS:
                    raise ConfigError(f"there are no paths of kind {word!r}, only of {', '.join(KINDS)}")
            mask &= np.isin(self.kind, kinds)
        rows = np.flatnonzero(mask)
        chosen = Paths(_figures.rows_of(self._column, rows), self._ends, places, elements=self._elements,
                       rows=rows if self._rows is None else self._rows[rows], gradient=self._gradient)
        if self._links is not None:
            values = {name: self._links[name] for name in self._links.columns}
            wanted = np.isin(values["tx"], places[0]) & np.isin(values["rx"], places[1])
            values = {name: column[wanted] for name, column in values.items()}
            if kinds is not None:
                values |= _figures.of_links(chosen, values["tx"], values["rx"])
            chosen._links = Links(values, self._ends)
        return chosen

    def at_carrier(self, index: int) -> Paths:
        """The same paths at another of the run's carriers: 0 is radio.frequency_hz, others are those of
        radio.frequencies_hz in their order. Coefficients, gains, Doppler shifts, links and channels are those at that
        carrier."""
        index = integer(index, "the number of a carrier")
        if not 0 <= index < max(1, len(self._ends.carriers_hz)):
            raise ConfigError(f"there is no carrier {index}; there are {len(self._ends.carriers_hz)}: "
                              f"{', '.join(f'{f:g} Hz' for f in self._ends.carriers_hz)}")
        if index == 0:
            return self
        names = {"a": "carrier_a", "gain_db": "carrier_gain_db", "doppler_hz": "carrier_doppler_hz"}

        def column(name: str) -> Array:
            if name not in names:
                return self._column(name)
            whole = self._column(names[name])
            chosen = whole.reshape(len(whole), len(self._ends.carriers_hz), *(self.a.shape[1:] if name == "a" else ()))
            return chosen[:, index]

        ends = replace(self._ends, frequency_hz=self._ends.carriers_hz[index], carriers_hz=())
        there = Paths(column, ends, (self._tx, self._rx), elements=self._elements, rows=self._rows)
        if self._links is not None:
            values = {name: self._links[name] for name in Links.columns}
            there._links = Links(values | _figures.of_links(there, values["tx"], values["rx"]), ends)
        return there

    # --- derivatives ---

    def gradient(self, wrt: str | Iterable[str] = ("tx.position", "rx.position")) -> Gradients:
        """Exact derivatives of coefficients, delays and angles, while each path keeps its surfaces and edges.

        wrt: one or several of "tx.position", "rx.position" (m, in the axes of the scene; each path has the derivative by
        its own ends), "tx.orientation", "rx.orientation" (small right-handed turns of the antenna about these axes, rad),
        and "MATERIAL.PROPERTY" with * and ? as in shells: permittivity, conductivity (S/m), thickness (m), scattering, and
        for vegetation attenuation (dB/m) and most_attenuation (dB). "*" is all materials that paths depend on.

        gradient("rx.position")["rx.position"].delay_s has shape (paths, 3). The host computes them, at the first carrier,
        for a frame of a simulation that is open; paths of a file have none.
        """
        if self._gradient is None:
            raise ConfigError("these paths have no derivatives: they are of a file, copied, or at another carrier than the "
                              "first; compute their frame with wavetracer.Simulation, and ask its paths")
        return gradients(np.array(self.a), self._gradient, self._rows, wrt)

    # --- channels ---

    def elements(self) -> tuple[Array, Array]:
        """Each path between all pairs of elements of the arrays of its ends: delays, in seconds, and amplitudes
        relative to those between the centres. Each has shape (paths, rx elements, tx elements); where an end has fewer
        elements than others, amplitudes are 0."""
        shape = tuple(max((counts[i] for i in chosen), default=1) if counts else 1
                      for counts, chosen in ((self._ends.rx_elements, self._rx), (self._ends.tx_elements, self._tx)))
        if self._elements is None:
            return np.array(self.delay_s)[:, None, None], np.ones((len(self), 1, 1))
        rows = np.arange(len(self)) if self._rows is None else self._rows
        return self._elements(rows, (shape[0], shape[1]))

    def cir(self, time_s: ArrayLike | None = None, *, normalize_delays: bool = True,
            reverse_direction: bool = False) -> tuple[Array, Array]:
        """The baseband impulse response, in the shapes and conventions of sionna.rt.Paths.cir.

        time_s: times within the frame, seconds from its instant, for which the phases turn with the Doppler shifts;
        None is the instant itself, one time. normalize_delays: the first path of each link (between the centres of
        arrays) arrives at 0, for the phases as well. reverse_direction: transmitters and receivers change places.

        Antennas of an end are its ports times the elements of its array: antenna port * elements + element, the order
        of Sionna RT. Between elements, phases are those of the way between them; tau is that between the centres.

        Returns a, complex128 of shape (rx, rx antennas, tx, tx antennas, paths, times),
        a exp(-j 2 pi f tau + j 2 pi fd t) at the carrier f, 0 where a link has fewer paths; and tau, float64 of shape
        (rx, tx, paths), seconds, -1 there.
        """
        return _channel.cir(self, time_s, normalize_delays, reverse_direction)

    def cfr(self, frequencies_hz: ArrayLike, time_s: ArrayLike | None = None, *, normalize_delays: bool = True,
            normalize: bool = False, reverse_direction: bool = False) -> Array:
        """The frequency response, in the shapes and conventions of sionna.rt.Paths.cfr: complex128 of shape
        (rx, rx antennas, tx, tx antennas, times, frequencies).

        frequencies_hz: relative to the carrier. Between the elements of arrays, delays are exact at every frequency.
        normalize: the mean energy of each link over antennas, times and frequencies becomes 1. The other arguments are those of cir().
        """
        return _channel.cfr(self, frequencies_hz, time_s, normalize_delays, normalize, reverse_direction)

    def taps(self, bandwidth_hz: float, count: int, *, first: int = 0, time_s: ArrayLike | None = None,
             normalize_delays: bool = True, normalize: bool = False, reverse_direction: bool = False) -> Array:
        """The taps of a channel of this bandwidth, sampled at it with a sinc filter, in the shapes and conventions of
        sionna.rt.Paths.taps: complex128 of shape (rx, rx antennas, tx, tx antennas, times, count).

        count taps from tap number `first` on (l_min; first + count - 1 is l_max). normalize: the energy of all taps of
        each link, averaged over ports and times, becomes 1. The other arguments are those of cir().
        """
        return _channel.taps(self, bandwidth_hz, (first, count), time_s, normalize_delays, normalize, reverse_direction)

    # --- tables ---

    def to_pandas(self) -> pandas.DataFrame:
        """One row per path, with the names of its ends and its kind; of `a` the pair of first ports. Needs pandas."""
        import pandas

        names = ("depth", "delay_s", "gain_db", "aod_theta_rad", "aod_phi_rad", "aoa_theta_rad", "aoa_phi_rad",
                 "doppler_hz")
        return pandas.DataFrame({"tx": np.asarray(self._ends.transmitters, object)[self.tx],
                                 "rx": np.asarray(self._ends.receivers, object)[self.rx], "kind": self.kind,
                                 "a": np.array(self.a[:, 0, 0]),
                                 **{name: np.array(self._column(name)) for name in names}})

    def to_xarray(self) -> xarray.Dataset:
        """A Dataset of dimensions rx, rx_port, tx, tx_port, path: `a` (without the carrier phase), `delay_s`,
        `doppler_hz` and the angles, NaN where a link has fewer paths. Needs xarray."""
        import xarray

        dense = _channel.dense(self)
        link = ("rx", "tx", "path")
        data: dict[str, Any] = {"a": (("rx", "rx_port", "tx", "tx_port", "path"), dense.of_ports(self.a))}
        for name in ("delay_s", "doppler_hz", "aod_theta_rad", "aod_phi_rad", "aoa_theta_rad", "aoa_phi_rad"):
            data[name] = (link, dense.of_links(self._column(name), np.nan))
        return xarray.Dataset(data, coords={"rx": self.receivers, "tx": self.transmitters},
                              attrs={"frequency_hz": self.frequency_hz})
