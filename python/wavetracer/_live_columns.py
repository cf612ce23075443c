# SPDX-License-Identifier: Apache-2.0
"""The channels of one instant from `wavetracer serve`, as columns of NumPy, from answers in either encoding."""
from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._radar_row import Radar, radar_of_answer
from .errors import ConfigError
from .links import Links

Array = NDArray[Any]

_STATIC = 0xFFFFFFFF  # the vehicle of a point on the static scene, as in the columns of the server
_LINK_COLUMNS = {"tx": np.uint32, "rx": np.uint32, "paths": np.uint32, "los": np.bool_}
_PATH_COLUMNS = ("delay_s", "gain_db", "doppler_hz", "aod_theta_rad", "aod_phi_rad", "aoa_theta_rad", "aoa_phi_rad")
_TYPED_ARRAYS: dict[int, Any] = {64: np.dtype("u1"), 70: np.dtype("<u4"), 86: np.dtype("<f8")}


def read_cbor(data: bytes | bytearray) -> dict[str, Any]:
    """Decodes the columns after an answer: a dict, whose arrays are views of `data`. It reads only the parts of CBOR that
    the server writes: maps, arrays, texts, and typed arrays of uint8, uint32 and float64. Raises ValueError if the data
    are anything else, or end too early."""
    view, place = memoryview(data), 0

    def taken(size: int) -> memoryview:
        nonlocal place
        if size > len(view) - place:
            raise ValueError(f"the columns end after {len(view)} bytes, in the middle of a value")
        place += size
        return view[place - size:place]

    def head() -> tuple[int, int]:
        first = taken(1)[0]
        short = first & 31
        if short > 27:
            raise ValueError(f"byte {place - 1} of the columns begins nothing that the server writes")
        return first >> 5, short if short < 24 else int.from_bytes(taken(1 << short - 24), "big")

    def item() -> Any:
        kind, value = head()
        if kind == 3:
            return str(taken(value), "utf-8")
        if kind == 4:
            return [item() for _ in range(value)]
        if kind == 5:
            return {item(): item() for _ in range(value)}
        if kind != 6 or value not in _TYPED_ARRAYS:
            raise ValueError(f"the value before byte {place} of the columns has a type that the server does not write")
        kind, size = head()
        return np.frombuffer(taken(size), _TYPED_ARRAYS[value])

    out = item()
    if not isinstance(out, dict) or place != len(view):
        raise ValueError("the columns are not one map")
    return out


def _numbers(values: Iterable[Any]) -> Array:
    """A column of numbers, in which null has become NaN."""
    return np.array([np.nan if value is None else value for value in values], float)


def _chain(lists: Iterable[list[Any]]) -> list[Any]:
    return [value for each in lists for value in each]


def columns_of(answer: dict[str, Any]) -> dict[str, Any]:
    """The links of an answer in JSON, as the map that an answer in CBOR has."""
    links = answer["links"]
    names: dict[str, dict[str, int]] = {"tx": {}, "rx": {}}
    places = {end: [known.setdefault(link[end], len(known)) for link in links] for end, known in names.items()}
    out: dict[str, Any] = {"transmitters": list(names["tx"]), "receivers": list(names["rx"])}
    out["links"] = {key: np.array(places[key], np.uint32) if key in places else _numbers(link[key] for link in links)
                    for key in Links.columns}
    if links and "delay_s" in links[0]:
        out["paths"] = {key: _numbers(_chain(link[key] for link in links)) for key in _PATH_COLUMNS}
        parts = [_numbers(_chain(_chain(link[key] for link in links))) for key in ("a_re", "a_im")]
        out["paths"]["a"] = np.stack(parts, -1).reshape(-1)
    if links and "vertices_m" in links[0]:
        per_path = {key: _chain(link[key] for link in links)
                    for key in ("vertices_m", "interactions", "surfaces", "vehicles")}
        ids: dict[str, int] = {}
        vehicles = [_STATIC if name is None else ids.setdefault(name, len(ids)) for name in _chain(per_path["vehicles"])]
        out["ids"] = list(ids)
        out["vertices"] = {"depth": np.array([len(row) for row in per_path["interactions"]], np.uint32),
                           "position_m": _numbers(_chain(_chain(per_path["vertices_m"]))),
                           "interaction": np.array(_chain(per_path["interactions"]), np.uint8),
                           "surface": np.array(_chain(per_path["surfaces"]), np.uint32),
                           "vehicle": np.array(vehicles, np.uint32)}
    if "radars" in answer:
        out["radars"] = [_radar_of(each) for each in answer["radars"]]
    return out


def _radar_of(radar: dict[str, Any]) -> dict[str, Any]:
    """A radar of an answer in JSON, as the map that an answer in CBOR has."""
    out = {key: _numbers(value) if isinstance(value, list) else value for key, value in radar.items()}
    out["detections"] = {key: _numbers(values) for key, values in radar["detections"].items()}
    if "cube_re" in out:
        out["cube"] = np.stack([out.pop("cube_re"), out.pop("cube_im")], -1).reshape(-1)
    return out


class Channels:
    """The channels of one instant. `links`, `paths` and `vertices` are dicts of columns.

    links: one row per link: `tx`, `rx` (places in `transmitters` and `receivers`), `paths` (how many), `los`,
    `path_gain_db` and the other figures of links.csv. A gain is -inf or NaN, and delays and spreads are NaN, where no
    path arrives.
    paths: with detail="paths" one row per path, the paths of the first link first: `delay_s`, `gain_db`, `doppler_hz`,
    `aod_theta_rad`, `aod_phi_rad`, `aoa_theta_rad`, `aoa_phi_rad`, and the coefficients `a`, complex, of shape
    (paths, rx_ports, tx_ports). Else it is empty.
    vertices: with detail="vertices": `depth` (one row per path), then one row per interaction: `position_m` of shape
    (interactions, 3), `interaction`, `surface`, `vehicle` (a place in `ids`; 4294967295 for the static scene).
    radars: with radar="detections" or "cubes" a Radar for each link of each [[radar]]. Else it is empty.
    answer: the keys of the answer's line, as docs/live.md lists them, such as `seconds` and `warnings`.
    """

    def __init__(self, answer: dict[str, Any], columns: dict[str, Any]):
        self.answer = answer
        self.frame: int = answer["frame"]
        self.time_s: float = answer["time_s"]
        self.transmitters: list[str] = columns["transmitters"]
        self.receivers: list[str] = columns["receivers"]
        self.links: dict[str, Array] = {key: np.asarray(values, _LINK_COLUMNS.get(key))
                                        for key, values in columns["links"].items()}
        self.paths: dict[str, Array] = dict(columns.get("paths", {}))
        if self.paths:
            coefficients = np.ascontiguousarray(self.paths["a"]).view(np.complex128)
            self.paths["a"] = coefficients.reshape(-1, answer["rx_ports"], answer["tx_ports"])
        self.ids: list[str] = columns.get("ids", [])
        self.vertices: dict[str, Array] = dict(columns.get("vertices", {}))
        if self.vertices:
            self.vertices["position_m"] = self.vertices["position_m"].reshape(-1, 3)

        self.radars: list[Radar] = [radar_of_answer(radar) for radar in columns.get("radars", [])]

    def __len__(self) -> int:
        """The number of links."""
        return len(self.links.get("tx", ()))

    def names(self, row: int) -> tuple[str, str]:
        """The names of the transmitter and the receiver of a link."""
        return self.transmitters[self.links["tx"][row]], self.receivers[self.links["rx"][row]]

    def row(self, tx: str, rx: str) -> int:
        """The row of the link between these ends. Raises ConfigError if the answer has no such link."""
        for row in range(len(self)):
            if self.names(row) == (tx, rx):
                return row
        raise ConfigError(f"the answer has no link from {tx!r} to {rx!r}: it has those that [links] of the server's "
                          f"configuration asks for, between {', '.join(sorted({*self.transmitters, *self.receivers})[:8])}")

    def rows_of(self, row: int) -> slice:
        """The rows of `paths` that belong to a link."""
        first = int(self.links["paths"][:row].sum())
        return slice(first, first + int(self.links["paths"][row]))

    def __repr__(self) -> str:
        heard = int(np.count_nonzero(self.links["paths"])) if len(self) else 0
        return f"<wavetracer.live.Channels at {self.time_s:.15g} s: {len(self):,} links, {heard:,} with a path>"
