# SPDX-License-Identifier: Apache-2.0
"""Saved runs: the folder that `wavetracer run` or Simulation.write() has made, opened."""
from __future__ import annotations

import csv
import json
import os
import pathlib
import re
from collections.abc import Iterator
from types import TracebackType
from typing import Any, Union

import numpy as np
from numpy.typing import NDArray

from ._arguments import integer, path
from .errors import ArgumentError, ConfigError, InputError
from .links import Ends, Links
from .paths import Paths
from .responses import Responses

Array = NDArray[Any]
Folder = Union[str, "os.PathLike[str]"]


def _not_saved(rows: Array, shape: tuple[int, int]) -> tuple[Array, Array]:
    raise ConfigError("a saved run has paths between the centres of arrays: take frame.response(tx, rx), which "
                      "response.bandwidth_hz writes, or compute the frame with wavetracer.Simulation(run.config)")


class SavedFrame:
    """A frame of a saved run: `number`, `time_s`, `paths`, `links`, positions of the ends. Columns are read from
    paths.h5 when they are asked for, and kept."""

    def __init__(self, run: Run, row: int):
        self._run, self._row = run, row
        self.number = int(run._file["frames/frame"][row])
        self.time_s = float(run._file["frames/time_s"][row])
        offset = run._path_offset
        self._first, self._last = int(offset[row]), int(offset[row + 1])
        self._known: dict[str, Array] = {}

    def __reduce__(self) -> Any:
        return _frame_of, (self._run, self._row)

    def __len__(self) -> int:
        """The number of paths in the file."""
        return self._last - self._first

    def __repr__(self) -> str:
        return f"<wavetracer.SavedFrame {self.number} at {self.time_s:g} s of {self._run.folder}: {len(self):,} paths>"

    def _read(self, name: str) -> Array:
        group, rows = self._run._group("paths"), slice(self._first, self._last)
        if name == "a":
            return np.asarray(group["a_re"][rows] + 1j * group["a_im"][rows])
        if name == "vertex_offset":
            offset = group[name][self._first:self._last + 1]
            return np.asarray(offset - offset[0])
        if name.startswith("vertex_"):
            offset = group["vertex_offset"]
            begin, end = int(offset[self._first]), int(offset[self._last])
            return np.asarray(self._run._group("vertices")[name.removeprefix("vertex_")][begin:end])
        if name == "target" and name not in group:  # no targets, or a version that had none
            return np.zeros(0, np.uint32)
        if name in ("group", "group_weight") and name not in group:  # of a version that had none
            return np.zeros((0, 4), np.uint32 if name == "group" else np.float64)
        if name == "lifetime_m" and name not in group:  # of a run without output.lifetimes
            return np.zeros(0, np.float64)
        if name not in group:
            raise ConfigError(f'there is no column "{name}" in /paths of {self._run.folder}/paths.h5')
        return np.asarray(group[name][rows])

    def __getitem__(self, name: str) -> Array:
        """A column of /paths, of /vertices ("vertex_position_m"), or the complex "a"; rows of this frame."""
        if not isinstance(name, str):
            raise ArgumentError(f"a column has a name, such as \"delay_s\", and is not {name!r}")
        if name not in self._known:
            self._known[name] = self._read(name)
            self._known[name].flags.writeable = False
        return self._known[name]

    @property
    def paths(self) -> Paths:
        """The paths of this frame that the file has: limits of [output] may have left some out."""
        return Paths(self.__getitem__, self._run._ends, links=self.links, elements=self._run._elements)

    def response(self, tx: str | int = 0, rx: str | int = 0) -> Array:
        """The channel of a link as [response] asked for it, complex64 of shape (rx antennas, tx antennas, times,
        frequencies), with absolute delays and phases; run.responses has the axes. tx, rx: names, or places in the lists
        of all."""
        of = [names.index(end) if isinstance(end, str) and end in names else end
              for end, names in ((tx, self._run.transmitters), (rx, self._run.receivers))]
        for end, what in zip(of, ("transmitter", "receiver")):
            if isinstance(end, str):
                raise ConfigError(f"there is no {what} {end!r}")
        tx_place, rx_place = (integer(end, f"a {what} is a name or a place in the list, which")
                              for end, what in zip(of, ("transmitter", "receiver")))
        return self._run.responses.of(self.number, tx_place, rx_place)

    @property
    def links(self) -> Links:
        """One row per link that was asked for, of all paths, as links.csv has them."""
        return self._run._links_of(self.number)

    @property
    def transmitter_position_m(self) -> Array:
        """Shape (transmitters, 3), metres in the coordinates of the scene file; NaN while one is absent."""
        return np.asarray(self._run._file["frames/transmitter_position_m"][self._row])

    @property
    def receiver_position_m(self) -> Array:
        """Shape (receivers, 3), metres in the coordinates of the scene file; NaN while one is absent."""
        return np.asarray(self._run._file["frames/receiver_position_m"][self._row])


def _frame_of(run: Run, row: int) -> SavedFrame:
    return run[row]


class Run:
    """A saved run. run[0] is its first frame, len(run) their number, `for frame in run` goes through them.

    `transmitters`, `receivers` (names), `times_s` (of the frames), `frequency_hz`, `config` (TOML text), `summary` (of
    summary.json). It holds paths.h5 open until close(), or the end of a `with`.
    """

    def __init__(self, folder: Folder):
        import h5py

        self.folder = pathlib.Path(path(folder, "the folder of a run"))
        name = self.folder / "paths.h5"
        if not name.exists():
            unfinished = " The run is not complete: `wavetracer run --resume` continues it." \
                if (self.folder / "shards").exists() else ""
            raise InputError(f"{name}: there is no such file; give the folder that `wavetracer run` has written."
                             + unfinished)
        try:
            self._file = h5py.File(name)
            if self._file.attrs.get("format") != "wavetracer paths":
                raise InputError(f"{name}: this is no paths.h5 of wavetracer")
            self._ends = Ends(tuple(self._group("transmitters")["name"].asstr()[:]),
                              tuple(self._group("receivers")["name"].asstr()[:]),
                              float(np.ravel(self._file.attrs["frequency_hz"])[0]))
            self.times_s: list[float] = self._group("frames")["time_s"][:].tolist()
            self._path_offset = self._group("frames")["path_offset"][:]
            self.config = str(self._file.attrs["config"])
        except (OSError, KeyError) as error:
            raise InputError(f"{name}: it cannot be read: {error}") from None
        self.transmitters, self.receivers = list(self._ends.transmitters), list(self._ends.receivers)
        self.frequency_hz = self._ends.frequency_hz
        self._table: dict[str, Array] | None = None
        self._responses: Responses | None = None
        self._elements = _not_saved if re.search(r"^\[\[array\]\]", self.config, re.M) else None

    def _group(self, name: str) -> Any:
        return self._file[name]

    def __reduce__(self) -> Any:
        return Run, (self.folder.absolute(),)  # is opened again

    def __enter__(self) -> Run:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        self.close()

    def close(self) -> None:
        """Closes paths.h5; columns that were read stay."""
        self._file.close()
        if self._responses is not None:
            self._responses.close()

    @property
    def responses(self) -> Responses:
        """responses.h5, with its axes `frequencies_hz` and `times_s`; run[3].response(tx, rx) is a channel of it."""
        if self._responses is None:
            self._responses = Responses(self.folder)
        return self._responses

    def __len__(self) -> int:
        return len(self.times_s)

    def __getitem__(self, row: int) -> SavedFrame:
        """A frame, counted from 0; negative ones from the end."""
        row = integer(row, "the place of a frame")
        if not -len(self) <= row < len(self):
            raise IndexError(f"there is no frame {row} in {self.folder}, which has {len(self)}")
        return SavedFrame(self, row % len(self))

    def __iter__(self) -> Iterator[SavedFrame]:
        return (self[row] for row in range(len(self)))

    def __repr__(self) -> str:
        return (f"<wavetracer.Run {self.folder}: {len(self)} frames, {int(self._path_offset[-1]):,} paths, "
                f"{len(self.transmitters)} transmitters, {len(self.receivers)} receivers>")

    @property
    def summary(self) -> dict[str, Any]:
        """summary.json: version, device, counts, seconds of each stage, what was missed, warnings."""
        return dict(json.loads((self.folder / "summary.json").read_text(encoding="utf-8")))

    @property
    def links(self) -> dict[str, Array]:
        """The columns of links.csv for all frames, with `frame`, `tx` and `rx` as numbers: of a drive in one table."""
        if self._table is None:
            with open(self.folder / "links.csv", newline="", encoding="utf-8-sig") as file:
                rows = list(csv.reader(file))
            names, group = rows[0], self._group("links")
            if len(rows) - 1 != len(group["frame"]):
                raise InputError(f"{self.folder}/links.csv: it has {len(rows) - 1:,} links and paths.h5 has "
                                 f"{len(group['frame']):,}: they are of two runs")
            table = {name: np.array([row[i] for row in rows[1:]], float) for i, name in enumerate(names)
                     if name not in ("tx", "rx")}
            self._table = {name: np.asarray(group[name][:]) for name in ("frame", "tx", "rx")} | table
            self._table["los"] = self._table["los"] != 0
            self._table["paths"] = self._table["paths"].astype(np.uint32)
        return self._table

    def links_to_pandas(self) -> Any:
        """The columns of links.csv for all frames as a pandas.DataFrame, with the names of the ends. Needs pandas."""
        import pandas

        table = pandas.DataFrame(self.links)
        table["tx"] = np.asarray(self.transmitters, object)[self.links["tx"]]
        table["rx"] = np.asarray(self.receivers, object)[self.links["rx"]]
        return table

    def _links_of(self, frame: int) -> Links:
        rows = self.links["frame"] == frame
        unknown = np.full(int(rows.sum()), np.nan)  # values of a version that did not have the column
        return Links({name: self.links[name][rows] if name in self.links else unknown for name in Links.columns},
                     self._ends)
