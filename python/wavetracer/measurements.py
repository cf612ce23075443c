# SPDX-License-Identifier: Apache-2.0
"""Compares measurement campaigns with gains that are computed for the same places: `python3 -m
wavetracer.measurements`.

The configuration describes the place: the map, the carrier, antennas and their heights. The files have the positions of
receivers and the levels that they measured. Levels are compared up to a constant, the offset, because powers, cables
and antennas are not known.
"""
from __future__ import annotations

import argparse
import csv
import pathlib
import sys
import tempfile
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ._campaigns import CAMPAIGNS, Route
from .errors import Error, InputError
from .simulation import Simulation

Array = NDArray[np.float64]


@dataclass
class Agreement:
    """The agreement on one route. Measured minus computed gain: offset_db is its mean, sigma_db its deviation."""

    points: int
    with_a_path: int
    offset_db: float
    sigma_db: float
    spearman: float


def ranks(values: Array) -> Array:
    """1 for the smallest; equal values have the mean of their ranks."""
    _, place, count = np.unique(values, return_inverse=True, return_counts=True)
    last = np.cumsum(count)
    out: Array = (last - (count - 1) / 2)[place]
    return out


def agreement(measured_db: Sequence[float] | Array, computed_db: Sequence[float] | Array) -> Agreement:
    """The statistics of one route; points without a path are counted and left out of the rest."""
    measured, computed = np.asarray(measured_db, float), np.asarray(computed_db, float)
    heard = np.isfinite(computed)
    off = (measured - computed)[heard]
    if len(off) < 2:
        return Agreement(len(measured), len(off), float("nan"), float("nan"), float("nan"))
    one, other = ranks(measured[heard]), ranks(computed[heard])
    spread = one.std() * other.std()
    rank = float(((one - one.mean()) * (other - other.mean())).mean() / spread) if spread > 0 else float("nan")
    return Agreement(len(measured), len(off), float(off.mean()), float(off.std(ddof=1)), rank)


def thinned(route: Route, every: int) -> Route:
    return Route(route.name, route.senders[::every], route.receivers[::every], route.gain_db[::every], route.left_out)


def shifted(route: Route, by: Sequence[float]) -> Route:
    """The route with `by` = (X, Y) metres added to its places, which are x, y, z in metres."""
    if route.senders:
        raise InputError(f"{route.name}: --shift moves places in metres, and this campaign has degrees: leave it out")
    moved = [(place[0] + by[0], place[1] + by[1], *place[2:]) for place in route.receivers]
    return Route(route.name, route.senders, moved, route.gain_db, route.left_out)


def computed_gains(config: pathlib.Path, routes: Sequence[Route], device: str | None = None) -> list[Array]:
    """The path gain (dB, the sum of powers) of every point, -inf without a path."""
    if all(route.senders for route in routes if route.receivers):
        return gains_of_pairs(config, routes, device)
    return gains_of_points(config, routes, device)


def split(gains: Array, routes: Iterable[Route]) -> list[Array]:
    ends = np.cumsum([len(route.receivers) for route in routes])
    return np.split(gains, ends[:-1])


def gains_of_points(config: pathlib.Path, routes: Sequence[Route], device: str | None) -> list[Array]:
    """One transmitter, that of the configuration, and a receiver at each point: one frame."""
    places = [place for route in routes for place in route.receivers]
    text = read_text(config) + "".join(f'\n[[receiver]]\nname = "p{i}"\nposition_m = [{x!r}, {y!r}, {z!r}]\n'
                                       for i, (x, y, z) in enumerate(places))
    with Simulation(text, folder=config.parent, device=device) as simulation:
        if len(simulation.transmitters) != 1 or len(simulation.receivers) != len(places):
            raise InputError(f"{config}: this campaign has one transmitter, which must be the only end in the configuration")
        links = simulation.run_frame().links
        gains = np.full(len(places), -np.inf)
        gains[links["rx"]] = links["path_gain_db"]
    return split(gains, routes)


def gains_of_pairs(config: pathlib.Path, routes: Sequence[Route], device: str | None) -> list[Array]:
    """Both ends move: a frame per point, of a vehicle of the type "sender" and one of the type "receiver"."""
    pairs = [pair for route in routes for pair in zip(route.senders, route.receivers)]
    gains = np.full(len(pairs), -np.inf)
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "pairs.csv"
        with open(file, "w", encoding="utf-8") as out:
            out.write("time,id,lat,lon,yaw,speed,type\n")
            for i, ends in enumerate([*pairs, pairs[-1]] if len(pairs) == 1 else pairs):
                for name, (latitude, longitude) in zip(("sender", "receiver"), ends):
                    out.write(f"{i},{name},{latitude!r},{longitude!r},0,0,{name}\n")
        sets = {"trajectories": {"file": str(file)}, "time": {"step_s": 1.0}, "trace": {"reuse": False}}
        with Simulation(read_text(config), folder=config.parent, device=device, **sets) as simulation:
            for i, frame in zip(range(len(pairs)), simulation.frames()):
                links = frame.links
                if len(links) != 1:
                    raise InputError(f"{config}: {len(links)} links instead of one: a [[mount]] on \"sender\" with the role "
                                     "\"transmitter\" and one on \"receiver\" with the role \"receiver\" are needed")
                gains[i] = links["path_gain_db"][0]
    return split(gains, routes)


def read_text(config: pathlib.Path) -> str:
    try:
        return config.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{config}: the configuration cannot be read: {getattr(error, 'strerror', None) or error}"
                         ) from None


def write_points(file: pathlib.Path, routes: Sequence[Route], computed: Sequence[Array]) -> None:
    with open(file, "w", encoding="utf-8", newline="") as out:
        table = csv.writer(out, lineterminator="\n")
        table.writerow(("route", "point", "measured_db", "computed_db"))
        for route, gains in zip(routes, computed):
            for i, (measured, gain) in enumerate(zip(route.gain_db, gains)):
                table.writerow((route.name, i, f"{measured:g}", f"{gain:.3f}"))


def report(routes: Sequence[Route], computed: Sequence[Array]) -> str:
    width = max(len("all"), *(len(route.name) for route in routes))
    lines = [f"{'route':{width}}  points  with a path  offset dB  sigma dB  Spearman"]
    parts = [(route.name, route.gain_db, gains, route.left_out) for route, gains in zip(routes, computed)]
    if len(parts) > 1:
        parts.append(("all", [gain for route in routes for gain in route.gain_db], np.concatenate(computed),
                      sum(route.left_out for route in routes)))
    for name, measured, gains, left_out in parts:
        found = agreement(measured, gains)
        lines.append(f"{name:{width}}  {found.points:6}  {found.with_a_path:11}  {found.offset_db:9.2f}  "
                     f"{found.sigma_db:8.2f}  {found.spearman:8.3f}" + (f"  ({left_out} rows left out)" if left_out else ""))
    return "\n".join(lines)


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(prog="python3 -m wavetracer.measurements", description=__doc__)
    parser.add_argument("campaign", choices=sorted(CAMPAIGNS))
    parser.add_argument("files", nargs="+", type=pathlib.Path, metavar="FILE")
    parser.add_argument("-c", "--config", type=pathlib.Path, required=True, help="the map, the carrier and the antennas")
    parser.add_argument("--level", help="the column of the received level, where there are several: RSRP, RSSI, SNR")
    parser.add_argument("--every", type=int, default=1, metavar="N", help="only every Nth point of each route")
    parser.add_argument("--shift", type=float, nargs=2, metavar=("X", "Y"),
                        help="metres to add to the places of the files, if the map has other coordinates")
    parser.add_argument("--points", type=pathlib.Path, metavar="FILE", help="write measured and computed gains as CSV")
    parser.add_argument("--device", help="part of the name of an OpenCL device")
    options = parser.parse_args(arguments)
    read, level = CAMPAIGNS[options.campaign]
    try:
        if options.every < 1:
            raise InputError(f"--every {options.every}: give 1 or more")
        routes = [thinned(route, options.every) for file in options.files for route in read(file, options.level or level)]
        if options.shift:
            if not np.all(np.isfinite(options.shift)):
                raise InputError(f"--shift {options.shift[0]} {options.shift[1]}: give two numbers of metres")
            routes = [shifted(route, options.shift) for route in routes]
        if not any(route.receivers for route in routes):
            raise InputError(f"{', '.join(map(str, options.files))}: no point with a position and a level")
        computed = computed_gains(options.config, routes, options.device)
        print(report(routes, computed))
        if options.points:
            write_points(options.points, routes, computed)
    except Error as error:
        print(f"wavetracer: {error}", file=sys.stderr)
        return error.code
    return 0


if __name__ == "__main__":
    sys.exit(main())
