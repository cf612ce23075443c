"""Radio channels between moving vehicles by ray tracing on OpenCL.

    import wavetracer as wt

    simulation = wt.Simulation(wt.configs / "demo.toml", trace={"rays": 100_000})
    run = simulation.run("out/demo")
    paths = run[0].paths.select(tx="rsu")
    h = paths.cfr([-5e6, 0, 5e6])          # (rx, rx ports, tx, tx ports, times, frequencies)
    wt.view(run)

docs/python.md is its guide, docs/from-sionna.md is for those who know Sionna RT.
"""
from __future__ import annotations

import os as _os
import pathlib as _pathlib

from ._library import Counts, columns, devices, version
from .errors import ConfigError, DeviceError, Error, FrameStopped, InputError, RunError
from .frame import Frame
from .paths import Links, Paths
from .responses import Responses
from .runs import Run, SavedFrame
from .sionna import from_sionna
from .simulation import Simulation
from .view import Page, view

__all__ = ["ConfigError", "Counts", "DeviceError", "Error", "Frame", "FrameStopped", "InputError", "Links", "Page",
           "Paths", "Responses", "Run", "RunError", "SavedFrame", "Simulation", "columns", "configs", "devices",
           "from_sionna", "version", "view"]
__version__ = version()


def open(folder: str | _os.PathLike[str]) -> Run:  # not in __all__: `import *` keeps Python's own
    """Opens the folder that `wavetracer run` or Simulation.write() has written."""
    return Run(folder)


def _find_configs() -> _pathlib.Path:
    here = _pathlib.Path(__file__).resolve()
    places = [here.parent / "share/configs", *(folder / "share/wavetracer/configs" for folder in here.parents[3:5]),
              *(folder / "configs" for folder in here.parents[2:3])]
    return next((place for place in places if (place / "demo.toml").exists()), places[0])


configs: _pathlib.Path = _find_configs()
"""The folder of the configurations that come with the package: configs / "demo.toml" and others."""
