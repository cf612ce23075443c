# SPDX-License-Identifier: Apache-2.0
"""Maps of a run's receiver grid as arrays with coordinates: those that `wavetracer coverage` makes."""
from __future__ import annotations

import json
import os
import pathlib
import tempfile
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any, Union

import numpy as np

from . import _program
from ._arguments import each, integer, path, shown
from .runs import Run
from .simulation import Simulation

if TYPE_CHECKING:
    import xarray

Source = Union[Run, Simulation, str, "os.PathLike[str]", Mapping[str, Any]]


def _xarray() -> Any:
    try:
        import xarray
    except ImportError:
        raise ImportError('wt.coverage returns an xarray.Dataset, and xarray is not installed: `pip install xarray`, or '
                          '`pip install "wavetracer[notebook]"`') from None
    return xarray


def _folder_of(source: Source) -> pathlib.Path | None:
    """The folder of a saved run; None for what has to be computed first."""
    if isinstance(source, Run):
        return source.folder
    if isinstance(source, (Simulation, Mapping)):
        return None
    if not isinstance(source, (str, os.PathLike)):
        raise TypeError(f"a run, its folder, a simulation or a configuration is wanted, not {shown(source)}")
    if isinstance(source, str) and ("\n" in source or "=" in source):
        return None
    place = pathlib.Path(path(source, "the folder of a run"))
    return place if place.is_dir() or place.suffix == ".h5" or not place.exists() else None


def _options(grid: str | None, tx: str | None, layers: Iterable[str] | None) -> list[str]:
    out: list[str] = []
    for name, value in (("grid", grid), ("tx", tx)):
        if value is not None:
            if not isinstance(value, str):
                raise TypeError(f"{name} is a name, not {shown(value)}")
            out += [f"--{name}", value]
    if layers is not None:
        out += ["--layers", ",".join(each(layers, 'layers are names in a list, such as ["sinr_db"]'))]
    return out


def _dataset(folder: pathlib.Path) -> xarray.Dataset:
    about = json.loads((folder / "coverage.json").read_text(encoding="utf-8"))
    coordinates: dict[str, Any] = {}
    for file, name, axes, long_name, units in (
            ("x_m", "x", ("x",), "x in the coordinates of the scene, middle of the cell", "m"),
            ("y_m", "y", ("y",), "y in the coordinates of the scene, middle of the cell", "m"),
            ("z_m", "z", ("y", "x"), "height of the receivers", "m"),
            ("lon_deg", "lon", ("y", "x"), "longitude, WGS84", "degrees_east"),
            ("lat_deg", "lat", ("y", "x"), "latitude, WGS84", "degrees_north")):
        if (folder / f"{file}.npy").exists():
            coordinates[name] = (axes, np.load(folder / f"{file}.npy"), {"units": units, "long_name": long_name})
    values = {name: (("y", "x"), np.load(folder / f"{name}.npy"), {"units": layer["unit"] or "1", "long_name": layer["about"]})
              for name, layer in about["layers"].items()}
    names = ("grid", "frame", "time_s", "tx", "transmitters", "projection", "offset_m")
    out: xarray.Dataset = _xarray().Dataset(values, coords=coordinates,
                                            attrs={name: about[name] for name in names if about.get(name) is not None})
    return out


def coverage(run: Source, *, grid: str | None = None, tx: str | None = None, frame: int | None = None,
             layers: Iterable[str] | None = None) -> xarray.Dataset:
    """The map of a [[receiver_grid]] in one frame as an xarray.Dataset: variables of shape (y, x), NaN where a cell has
    no value, with units and long_name as attributes, over coordinates x, y and z in metres, and lon and lat in degrees
    if the scene has a georeference.

    run: a Run, its folder, a Simulation, or a configuration, of which one frame is computed. grid: its name, needed if
    there are several. tx: the transmitter that serves all cells; the strongest of each cell if not given. frame: its
    number; the first one if not given. layers: names, such as "path_gain_db", "sinr_db" and "best_server" (a place in
    the attribute `transmitters`); all that the run can tell if not given. docs/formats.md has their formulas. Raises
    ImportError without xarray.
    """
    _xarray()
    options, folder = _options(grid, tx, layers), _folder_of(run)
    number = None if frame is None else integer(frame, "the number of a frame")
    with tempfile.TemporaryDirectory(prefix="wavetracer-") as work:
        if folder is None:
            simulation = run if isinstance(run, Simulation) else Simulation(run)  # type: ignore[arg-type]
            folder = pathlib.Path(work) / "run"
            simulation.run(folder, [0 if number is None else number], progress=False).close()
            if simulation is not run:
                simulation.close()
        if number is not None:
            options += ["--frame", str(number)]
        _program.call("coverage", folder, "-o", pathlib.Path(work) / "maps", "--format", "npy", *options)
        return _dataset(pathlib.Path(work) / "maps")
