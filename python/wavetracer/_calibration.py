# SPDX-License-Identifier: Apache-2.0
"""Measured levels beside computed ones, and materials and antennas that fit them: `wavetracer calibrate`."""
from __future__ import annotations

import csv
import os
import pathlib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Union

import numpy as np
from numpy.typing import NDArray

from . import _program, _toml

Path = Union[str, "os.PathLike[str]"]


@dataclass
class Parameter:
    """A fitted property of a material or an antenna, or an offset. told_share: the share of the prior variance that the
    data removed."""

    unit: str
    before: float
    fitted: float
    standard_error: float
    told_share: float


@dataclass
class Calibration:
    """The result of wt.calibrate: columns of calibration.csv by name, an entry for each measured point; parameters by
    name; the text that the program prints; and the folder, which has the fitted configuration and a page."""

    points: dict[str, NDArray[np.generic]]
    parameters: dict[str, Parameter]
    text: str
    folder: pathlib.Path

    @property
    def fitted(self) -> pathlib.Path:
        """The file of the fitted configuration."""
        return self.folder / "fitted.toml"


_TEXTS = ("file", "tx", "group")


def _columns(file: pathlib.Path) -> dict[str, NDArray[np.generic]]:
    with open(file, encoding="utf-8", newline="") as source:
        rows = list(csv.DictReader(source))
    names = list(rows[0]) if rows else []
    return {name: np.array([row[name] for row in rows]) if name in _TEXTS
            else np.array([float(row[name]) for row in rows]) for name in names}


def _parameters(file: pathlib.Path) -> dict[str, Parameter]:
    with open(file, encoding="utf-8", newline="") as source:
        return {row["parameter"]: Parameter(row["unit"], *(float(row[name]) for name in (
            "before", "fitted", "standard_error", "told_share"))) for row in csv.DictReader(source)}


def calibrate(config: Path, measured: Path | Iterable[Path], folder: Path, *, fit: str | Iterable[str] = "*",
              offset: str = "all", spreads: str = "none", profiles: float = 0.0, prior: float = 1.0,
              errors: Mapping[str, float] | None = None, folds: int = 4, level: str | None = None, crs: str | None = None,
              device: str | None = None, sets: Mapping[str, object] | None = None) -> Calibration:
    """Compares the levels of a configuration with those of tables of measured values, and fits its materials and antennas
    to them. The arguments are the options of `wavetracer calibrate`; docs/calibration.md describes them and the tables.
    folder: gets the files. fit: parameters in a list, or in a text with commas. errors: standard deviations of parameters
    by their names, instead of the usual ones. sets: keys of the configuration."""
    files = [measured] if isinstance(measured, (str, os.PathLike)) else list(measured)
    options = ["-c", os.fspath(config), "-o", os.fspath(folder), "--fit", fit if isinstance(fit, str) else ",".join(fit),
               "--offset", offset, "--folds", str(int(folds))]
    # The program refuses these where nothing is fitted, so they are given only if they say something.
    if spreads != "none":
        options += ["--spreads", spreads]
    if profiles != 0:
        options += ["--profiles", repr(float(profiles))]
    if prior != 1:
        options += ["--prior", repr(float(prior))]
    for file in files:
        options += ["--measured", os.fspath(file)]
    for name, error in (errors or {}).items():
        options += ["--error", f"{name}={float(error)!r}"]
    if level is not None:
        options += ["--level", level]
    if crs is not None:
        options += ["--crs", crs]
    if device is not None:
        options += ["--device", device]
    for pair in _toml.sets(sets or {}):
        options += ["--set", pair]
    text = _program.call("calibrate", *options)
    place = pathlib.Path(folder)
    return Calibration(_columns(place / "calibration.csv"), _parameters(place / "parameters.csv"), text, place)
