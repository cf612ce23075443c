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
from .errors import ArgumentError, ConfigError
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
                          'the extra `notebook` of the wheel') from None
    return xarray


def _folder_of(source: Source) -> pathlib.Path | None:
    """The folder of a saved run; None for what has to be computed first."""
    if isinstance(source, Run):
        return source.folder
    if isinstance(source, (Simulation, Mapping)):
        return None
    if not isinstance(source, (str, os.PathLike)):
        raise ArgumentError(f"a run, its folder, a simulation or a configuration is wanted, not {shown(source)}")
    if isinstance(source, str) and ("\n" in source or "=" in source):
        return None
    place = pathlib.Path(path(source, "the folder of a run"))
    return place if place.is_dir() or place.suffix == ".h5" or not place.exists() else None


def _options(grid: str | None, tx: str | None, layers: Iterable[str] | None) -> list[str]:
    out: list[str] = []
    for name, value in (("grid", grid), ("tx", tx)):
        if value is not None:
            if not isinstance(value, str):
                raise ArgumentError(f"{name} is a name, not {shown(value)}")
            out += [f"--{name}", value]
    if layers is not None:
        out += ["--layers", ",".join(each(layers, 'layers are names in a list, such as ["sinr_db"]'))]
    return out


def _chosen(frame: int | None, frames: Iterable[int] | str | None) -> tuple[list[int] | None, list[str]]:
    """Numbers of frames, or None for the first frame or for all, and the options that name them to the program."""
    if frame is not None and frames is not None:
        raise ConfigError("give frame, the number of one frame, or frames, those of several, and not both")
    if frame is not None:
        number = integer(frame, "the number of a frame")
        return [number], ["--frame", str(number)]
    if frames is None:
        return None, []
    if isinstance(frames, str) and frames == "all":
        return None, ["--frames=all"]
    numbers = [integer(item, "the number of a frame")
               for item in each(frames, 'frames is "all", or numbers of frames, such as [0, 2] or range(0, 10)')]
    if not numbers:
        raise ConfigError('frames is empty: give at least one number, or "all"')
    return numbers, [f"--frames={min(numbers)}:{max(numbers)}"]


def _of_frames(maps: xarray.Dataset, numbers: list[int]) -> xarray.Dataset:
    """The maps of these frames, in this order, out of those of all frames between them."""
    row = {number: k for k, number in enumerate(maps.frame.values.tolist())}
    for number in numbers:
        if number not in row:
            raise ConfigError(f"frames: the run has no frame {number}, and those beside it are {shown(list(row))}")
    return maps.isel(time=[row[number] for number in numbers])


def _dataset(folder: pathlib.Path) -> xarray.Dataset:
    about = json.loads((folder / "coverage.json").read_text(encoding="utf-8"))
    upright = about["vertical"] is not None
    cells: tuple[str, ...] = ("z", "along") if upright else ("y", "x")
    axes_of_layers = ("time", *cells) if "frames" in about else cells
    places = ("along",) if upright else cells  # the axes along which places on the ground differ
    coordinates: dict[str, Any] = {}
    if "frames" in about:
        coordinates["frame"] = ("time", [item["frame"] for item in about["frames"]], {"long_name": "number of the frame"})
    for file, name, axes, long_name, units in (
            ("time_s", "time", ("time",), "time of the frame", "s"),
            ("along_m", "along", ("along",), "distance along the vertical plane, middle of the cell", "m"),
            ("x_m", "x", places[-1:], "x in the coordinates of the scene, middle of the cell", "m"),
            ("y_m", "y", places[:1], "y in the coordinates of the scene, middle of the cell", "m"),
            ("z_m", "z", ("z",) if upright else cells, "height of the receivers", "m"),
            ("lon_deg", "lon", places, "longitude, WGS84", "degrees_east"),
            ("lat_deg", "lat", places, "latitude, WGS84", "degrees_north")):
        if (folder / f"{file}.npy").exists():
            coordinates[name] = (axes, np.load(folder / f"{file}.npy"), {"units": units, "long_name": long_name})
    values = {name: (axes_of_layers, np.load(folder / f"{name}.npy"),
                     {"units": layer["unit"] or "1", "long_name": layer["about"]})
              for name, layer in about["layers"].items()}
    names = ("grid", "frame", "time_s", "tx", "transmitters", "projection", "offset_m")
    ends = {name: about["vertical"][name] for name in ("from_m", "to_m")} if upright else {}
    out: xarray.Dataset = _xarray().Dataset(values, coords=coordinates,
                                            attrs={**{name: about[name] for name in names if about.get(name) is not None},
                                                   **ends})
    return out


def coverage(run: Source, *, grid: str | None = None, tx: str | None = None, frame: int | None = None,
             frames: Iterable[int] | str | None = None, layers: Iterable[str] | None = None,
             on_streets: bool = False) -> xarray.Dataset:
    """The map of a [[receiver_grid]] in one frame as an xarray.Dataset: variables of shape (y, x), NaN where a cell has
    no value, with units and long_name as attributes, over coordinates x, y and z in metres, and lon and lat in degrees
    if the scene has a georeference. On a vertical plane variables have the shape (z, along), where along is the distance
    from from_m, and x and y are coordinates over it. With `frames` it has the maps of several frames: variables of shape (time, y, x),
    over the coordinates time in seconds and frame, too.

    run: a Run, its folder, a Simulation, or a configuration, of which these frames are computed. grid: its name, needed if
    there are several. tx: the transmitter that serves all cells; the strongest of each cell if not given. frame: its
    number; the first one if not given. frames: instead of it, numbers of frames, such as range(0, 10), or "all".
    layers: names, such as "path_gain_db", "sinr_db" and "best_server" (a place in the attribute `transmitters`); all
    that the run can tell if not given; docs/formats.md has their formulas. on_streets: cells that are on no street of
    scene.streets, or of the generated city, have no values. Raises ImportError without xarray.
    """
    _xarray()
    options, folder = _options(grid, tx, layers), _folder_of(run)
    numbers, named = _chosen(frame, frames)
    with tempfile.TemporaryDirectory(prefix="wavetracer-") as work:
        if folder is None:
            simulation = run if isinstance(run, Simulation) else Simulation(run)  # type: ignore[arg-type]
            folder = pathlib.Path(work) / "run"
            first = range(len(simulation)) if named == ["--frames=all"] else [0]
            wanted = first if numbers is None else sorted(set(numbers))
            simulation.run(folder, wanted, progress=False).close()
            if simulation is not run:
                simulation.close()
        options += named + (["--on-streets"] if on_streets else [])
        _program.call("coverage", folder, "-o", pathlib.Path(work) / "maps", "--format", "npy", *options)
        maps = _dataset(pathlib.Path(work) / "maps")
    return maps if frames is None or numbers is None else _of_frames(maps, numbers)
