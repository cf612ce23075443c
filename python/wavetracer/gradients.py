# SPDX-License-Identifier: Apache-2.0
"""Derivatives of the columns of paths by what the paths depend on."""
from __future__ import annotations

import ctypes
import fnmatch
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._arguments import each, shown
from ._columns import read_only
from ._library import Column, Sizes, call, library, text
from .errors import ArgumentError, ConfigError

Array = NDArray[Any]

PROPERTIES = ("permittivity", "conductivity", "thickness", "scattering", "attenuation", "most_attenuation")
# Parameters of ends: the number of the first of three, and the bit of enum wavetracer_wrt.
_ENDS = {"tx.position": (6, 2), "rx.position": (9, 2), "tx.orientation": (12, 4), "rx.orientation": (15, 4)}
_MATERIALS = 1
_REAL = ("delay_s", "aod_theta_rad", "aod_phi_rad", "aoa_theta_rad", "aoa_phi_rad")
GAPS = ("", "not solved", "pole", "singular", "jump")
"""Words for the numbers in Derivative.gap: "" is a derivative that is there."""


@dataclass(frozen=True)
class Derivative:
    """Derivatives of all paths by one parameter, per unit of the parameter; by a position (m) or an orientation (rad about
    the axes of the scene) they have a last axis of 3: x, y, z. Derivatives of paths that do not depend on the parameter
    are 0; where none exists they are NaN, and `gap` says why."""

    a: Array
    """Of the coefficients, shape (paths, rx ports, tx ports), and 3 for positions and orientations; complex128."""
    delay_s: Array
    """Of the delays, shape (paths,), and 3."""
    aod_theta_rad: Array
    aod_phi_rad: Array
    aoa_theta_rad: Array
    aoa_phi_rad: Array
    gain_db: Array
    """Of 10 log10 of the sum of |a|^2 over pairs of ports, dB per unit, shape (paths,), and 3."""
    gap: Array
    """Places in wavetracer.gradients.GAPS, shape (paths,), uint8."""


class Raw:
    """The rows of the library's gradient, as arrays of their own. Rows of `path` are places in the paths that were asked
    for."""

    def __init__(self, handle: int, rows: Array | None):
        read = {name: self._column(handle, name) for name in ("first", "parameter", "material", "a", "gap", *_REAL)}
        first = read.pop("first").astype(np.int64)
        counts: Array = first[1:] - first[:-1]
        paths = np.repeat(np.arange(len(counts)), counts)
        if rows is not None:
            places = np.zeros(len(counts), np.int64)
            places[rows] = np.arange(len(rows))
            paths = places[paths]
        self.path: Array = paths
        self.columns = read
        self.materials = [text(library.wavetracer_gradient_material_name(handle, i))
                          for i in range(library.wavetracer_gradient_material_count(handle))]

    @staticmethod
    def _column(handle: int, name: str) -> Array:
        column = Column()
        call(library.wavetracer_gradient_column, handle, name.encode(), ctypes.byref(column))
        return read_only(column, None).copy()


# Computes the rows for some rows of a frame (None: all) and a sum of enum wavetracer_wrt.
Compute = Callable[["Array | None", int], Raw]


def raw_gradient(simulation: int, frame: int, rows: Array | None, wrt: int) -> Raw:
    """The gradient of rows of a frame. simulation, frame: handles of the library."""
    wanted = None if rows is None else np.ascontiguousarray(rows, np.uintp)
    handle = call(library.wavetracer_frame_gradient, simulation, frame, wrt,
                  None if wanted is None else wanted.ctypes.data_as(Sizes), 0 if wanted is None else len(wanted))
    try:
        return Raw(handle, rows)
    finally:
        library.wavetracer_gradient_free(handle)


class Gradients(Mapping[str, Derivative]):
    """Derivatives of paths by their names: gradients["rx.position"].delay_s. Names are those of parameters that at least
    one path depends on, and of all ends that were asked for."""

    def __init__(self, a: Array, raw: Raw, wrt: list[str]):
        self._a, self._raw = a, raw
        self._names = [name for name in wrt if name in _ENDS] + self._of_materials([n for n in wrt if n not in _ENDS])

    def _of_materials(self, wanted: list[str]) -> list[str]:
        there = self._raw.columns["material"] != 0xFFFFFFFF
        pairs = np.unique(np.stack([self._raw.columns["material"][there], self._raw.columns["parameter"][there]]), axis=1)
        names = [f"{self._raw.materials[material]}.{PROPERTIES[parameter]}" for material, parameter in pairs.T]
        chosen: list[str] = []
        for pattern in wanted:
            found = [name for name in names if name == pattern or fnmatch.fnmatchcase(name, pattern)]
            if not found and pattern != "*":
                raise ConfigError(f"gradient: no path depends on {shown(pattern)}; paths depend on: "
                                  f"{', '.join(sorted(names)) or 'no material'}")
            chosen += [name for name in found if name not in chosen]
        return chosen

    def __getitem__(self, name: str) -> Derivative:
        if name not in self._names:
            raise KeyError(f"{name}; there are: {', '.join(self._names) or 'none'}")
        if name in _ENDS:
            parts = [self._of_parameter(_ENDS[name][0] + axis, None) for axis in range(3)]
            whole = {key: np.stack([part[key] for part in parts], axis=-1) for key in parts[0]}
            return Derivative(**whole | {"gap": whole["gap"].max(axis=-1)})
        material, word = name.rsplit(".", 1)
        return Derivative(**self._of_parameter(PROPERTIES.index(word), self._raw.materials.index(material)))

    def _of_parameter(self, parameter: int, material: int | None) -> dict[str, Array]:
        columns = self._raw.columns
        chosen = columns["parameter"] == parameter
        if material is not None:
            chosen &= columns["material"] == material
        paths = self._raw.path[chosen]
        out: dict[str, Array] = {name: np.zeros(len(self._a)) for name in _REAL}
        for name in _REAL:
            out[name][paths] = columns[name][chosen]
        out["a"] = np.zeros(self._a.shape, np.complex128)
        out["a"][paths] = columns["a"][chosen].reshape(-1, *self._a.shape[1:])
        out["gap"] = np.zeros(len(self._a), np.uint8)
        out["gap"][paths] = columns["gap"][chosen]
        with np.errstate(divide="ignore", invalid="ignore"):
            growth = 2 * (self._a.conj() * out["a"]).real.sum(axis=(1, 2)) / (np.abs(self._a) ** 2).sum(axis=(1, 2))
        out["gain_db"] = 10 / np.log(10) * growth
        return out

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def __repr__(self) -> str:
        return f"<wavetracer.Gradients of {len(self._a):,} paths by {', '.join(self._names) or 'nothing'}>"


def gradients(a: Array, compute: Compute, rows: Array | None, wrt: str | Iterable[str]) -> Gradients:
    """Those of Paths.gradient(); a: the coefficients of the paths."""
    names = [wrt] if isinstance(wrt, str) else each(wrt, "wrt: give names, such as [\"rx.position\"]")
    if not names:
        raise ConfigError("gradient: wrt is empty; give names, such as [\"rx.position\"]")
    bits = 0
    for name in names:
        if not isinstance(name, str):
            raise ArgumentError(f"gradient: wrt has names, such as \"rx.position\", and not {shown(name)}")
        word = name.rsplit(".", 1)[-1]
        if name not in _ENDS and name != "*" and not fnmatch.filter(PROPERTIES, word):
            raise ConfigError(f"gradient: there is no parameter {shown(name)}; there are {', '.join(_ENDS)}, and "
                              f"MATERIAL.PROPERTY with one of {', '.join(PROPERTIES)}")
        bits |= _ENDS[name][1] if name in _ENDS else _MATERIALS
    return Gradients(a, compute(rows, bits), names)
