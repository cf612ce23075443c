# SPDX-License-Identifier: Apache-2.0
"""Radio channels between moving vehicles by ray tracing on OpenCL.

    import wavetracer as wt

    simulation = wt.Simulation(wt.configs / "demo.toml", trace={"rays": 100_000})
    run = simulation.run("out/demo")
    paths = run[0].paths.select(tx="rsu")
    h = paths.cfr([-5e6, 0, 5e6])          # (rx, rx antennas, tx, tx antennas, times, frequencies)
    wt.view(run)

docs/python.md is its guide, docs/from-sionna.md is for those who know Sionna RT.
"""
from __future__ import annotations

import importlib as _importlib
import os as _os
import pathlib as _pathlib
import typing as _typing

if _typing.TYPE_CHECKING:
    from ._calibration import Calibration, calibrate
    from ._coverage import coverage
    from ._library import Counts, columns, devices, version
    from ._page import Page, view
    from .errors import ArgumentError, ConfigError, DeviceError, Error, FrameStopped, InputError, RunError
    from .frame import Frame
    from .gradients import Derivative, Gradients
    from .links import Links
    from .paths import Paths
    from .responses import Responses
    from .runs import Run, SavedFrame
    from .simulation import Simulation
    from .sionna import from_sionna

    __version__: str

__all__ = ["ArgumentError", "Calibration", "ConfigError", "Counts", "Derivative", "DeviceError", "Error", "Frame", "FrameStopped",
           "Gradients", "InputError", "Links", "Page", "Paths", "Responses", "Run", "RunError", "SavedFrame", "Simulation", "calibrate", "columns", "configs",
           "coverage", "devices", "examples", "from_sionna", "version", "view"]

# The module of each name. Modules are imported when a name is asked for: the command `wavetracer` needs neither the
# library in this process nor NumPy, and does not wait for them.
_MODULES = {
    "_calibration": ("Calibration", "calibrate"), "_coverage": ("coverage",),
    "_library": ("Counts", "columns", "devices", "version"), "_page": ("Page", "view"),
    "errors": ("ArgumentError", "ConfigError", "DeviceError", "Error", "FrameStopped", "InputError", "RunError"), "frame": ("Frame",),
    "gradients": ("Derivative", "Gradients"),
    "links": ("Links",), "paths": ("Paths",), "responses": ("Responses",), "runs": ("Run", "SavedFrame"),
    "simulation": ("Simulation",), "sionna": ("from_sionna",)}
_MODULE_OF = {name: module for module, names in _MODULES.items() for name in names}


if not _typing.TYPE_CHECKING:  # a checker of types knows the names from above, and no others
    def __getattr__(name: str) -> _typing.Any:
        if name == "__version__":
            return _importlib.import_module("._library", __name__).version()
        if name not in _MODULE_OF:
            raise AttributeError(f"module 'wavetracer' has no attribute {name!r}")
        globals()[name] = value = getattr(_importlib.import_module("." + _MODULE_OF[name], __name__), name)
        return value


def __dir__() -> list[str]:
    return sorted([*__all__, "open", "__version__"])


def open(folder: str | _os.PathLike[str]) -> Run:  # not in __all__: `import *` keeps Python's own
    """Opens the folder that `wavetracer run` or Simulation.write() has written."""
    from .runs import Run

    return Run(folder)


def _find(in_wheel: str, installed: str, in_tree: str, file: str) -> _pathlib.Path:
    """The folder that has the file: in a wheel, below the prefix of an installation, or in the source tree."""
    here = _pathlib.Path(__file__).resolve()
    places = [here.parent / in_wheel, *(folder / installed for folder in here.parents[3:5]),
              *(folder / in_tree for folder in here.parents[2:3])]
    return next((place for place in places if (place / file).exists()), places[0])


configs: _pathlib.Path = _find("share/configs", "share/wavetracer/configs", "configs", "demo.toml")
"""The folder of the configurations that come with the package: configs / "demo.toml" and others."""

examples: _pathlib.Path = _find("share/examples", "share/doc/wavetracer/examples", "docs/examples", "live_client.py")
"""The folder of the examples that come with the package: a notebook, clients of the live server and others."""
