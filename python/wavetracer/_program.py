# SPDX-License-Identifier: Apache-2.0
"""The command `wavetracer` of this package: finds the program and starts it with the same drivers."""
from __future__ import annotations

import os
import pathlib
import shutil
import subprocess
import sys

from . import _drivers
from .errors import RunError, error_of


_HERE = pathlib.Path(__file__).resolve().parent


def environment() -> dict[str, str]:
    """The variables to add to the program's environment: those for drivers, and for the data of its own PROJ, which the
    PROJ of other packages in this process must not use."""
    out = _drivers.environment()
    if (_HERE / "share/proj/proj.db").exists():
        out["PROJ_DATA"] = str(_HERE / "share/proj")
    return out


def find() -> str:
    """Returns the program: the one that WAVETRACER_PROGRAM names, else the one of this package, else the one in the
    PATH."""
    own = _HERE / "bin/wavetracer"
    found = os.environ.get("WAVETRACER_PROGRAM") or (str(own) if own.exists() else shutil.which("wavetracer"))
    if not found:
        raise RunError("the program wavetracer is not there: the wheel of ./dev wheel brings it, and WAVETRACER_PROGRAM "
                       "names another file")
    return found


def call(*arguments: str | os.PathLike[str]) -> str:
    """Runs a command of the program and returns its output. If it fails, raises an exception with the program's own
    message."""
    command = [find(), *(os.fspath(each) for each in arguments)]
    done = subprocess.run(command, env=os.environ | environment(), check=False, capture_output=True, text=True)
    if done.returncode != 0:
        raise error_of(done.returncode, done.stderr.strip().removeprefix("wavetracer: "))
    return done.stdout


def main() -> None:
    """The entry point of the command: this process becomes the program."""
    os.environ.update(environment())
    program = find()
    os.execv(program, [program, *sys.argv[1:]])
