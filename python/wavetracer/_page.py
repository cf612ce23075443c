# SPDX-License-Identifier: Apache-2.0
"""The page of a run in a notebook: the page that `wavetracer view` makes, shown below the cell."""
from __future__ import annotations

import html
import os
import pathlib
import tempfile
import webbrowser
from typing import Union

from . import _program
from ._arguments import each, integer, path
from .errors import ArgumentError
from .runs import Run

Shown = Union[Run, str, "os.PathLike[str]"]


class Page:
    """One page with the scene, the vehicles, the paths and the charts of a run; it needs no network. A notebook shows
    it below the cell. `html` is its text."""

    def __init__(self, text: str, height: int):
        self.html, self._height = text, height

    def _repr_html_(self) -> str:
        return (f'<iframe srcdoc="{html.escape(self.html)}" width="100%" height="{self._height}" '
                'style="border:0" allowfullscreen></iframe>')

    def __repr__(self) -> str:
        return f"<wavetracer.Page of {len(self.html) / 1e6:.1f} MB: save(FILE) writes it, browse() opens it>"

    def save(self, file: str | os.PathLike[str]) -> None:
        """Writes the page; a browser opens it from the disk."""
        pathlib.Path(path(file, "file")).write_text(self.html, encoding="utf-8")

    def browse(self) -> None:
        """Opens the page in the browser of this machine."""
        with tempfile.NamedTemporaryFile("w", suffix=".html", delete=False, encoding="utf-8") as file:
            file.write(self.html)
        webbrowser.open("file://" + file.name)


def view(run: Shown, *, height: int = 640, options: tuple[str, ...] = ()) -> Page:
    """The page of a saved run: a Run, or its folder. height: in pixels. options: those of the command, as
    `wavetracer help view` lists them, such as ("--frames", "0:10")."""
    folder = run.folder if isinstance(run, Run) else pathlib.Path(path(run, "the folder of a run"))
    height = integer(height, "height, in pixels,")
    options = tuple(each(options, 'options are words of the command in a list, such as ("--frames", "0:10")'))
    for option in options:
        if not isinstance(option, str):
            raise ArgumentError(f"options are words of the command, and {option!r} is none")
    with tempfile.TemporaryDirectory(prefix="wavetracer-") as work:
        file = pathlib.Path(work) / "view.html"
        _program.call("view", folder, "-o", file, *options)
        return Page(file.read_text(encoding="utf-8"), height)
