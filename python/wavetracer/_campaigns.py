# SPDX-License-Identifier: Apache-2.0
"""Readers of measurement campaigns: they take files as they are published, and return rows with line numbers."""
from __future__ import annotations

import csv
import math
import pathlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

from .errors import InputError

Place = tuple[float, ...]  # x, y, z in metres, or latitude and longitude in degrees


@dataclass
class Route:
    """Points of one drive. gain_db: measured, up to a constant; a path loss with its sign changed."""

    name: str
    senders: list[Place] = field(default_factory=list)  # empty: the transmitter of the configuration
    receivers: list[Place] = field(default_factory=list)
    gain_db: list[float] = field(default_factory=list)
    left_out: int = 0  # rows that say that they have no position or no level


def lines_of(file: pathlib.Path) -> Iterator[tuple[int, str]]:
    """Numbered lines that are not empty."""
    try:
        with open(file, encoding="utf-8-sig", errors="strict", newline=None) as text:
            for number, line in enumerate(text, 1):
                if line.strip():
                    yield number, line.rstrip("\n")
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{file}: cannot be read: {getattr(error, 'strerror', None) or error}") from None


def number_in(file: pathlib.Path, line: int, what: str, text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise InputError(f"{file}:{line}: {what} is {text.strip()!r}, which is no number")
    return value


def degrees_in(file: pathlib.Path, line: int, latitude: float, longitude: float) -> Place:
    if abs(latitude) > 90 or abs(longitude) > 180:
        raise InputError(f"{file}:{line}: latitude {latitude:g} and longitude {longitude:g} are no place on the earth")
    return latitude, longitude


# --- COST 231, Munich ---

def read_cost231(file: pathlib.Path, level: str) -> list[Route]:
    """A file per route (METRO 200, 201, 202): X, Y, Z in metres and the path loss in dB, separated by commas, semicolons or
    spaces, with a line of names above or without."""
    del level
    route, first = Route(file.stem), True
    for number, line in lines_of(file):
        cells = line.replace(";", ",").split(",") if any(mark in line for mark in ",;") else line.split()
        named, first = first and not is_number(cells[0]), False
        if named:
            continue  # the names of the columns
        if len(cells) != 4:
            raise InputError(f"{file}:{number}: {len(cells)} columns instead of X, Y, Z and the path loss")
        x, y, z, loss = (number_in(file, number, what, cell) for what, cell in zip(("X", "Y", "Z", "the path loss"), cells))
        route.receivers.append((x, y, z))
        route.gain_db.append(-loss)
    return [route]


def is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


# --- Berlin V2X, sidelink ---

BERLIN = ("Latitude_source", "Longitude_source", "Latitude_destination", "Longitude_destination", "Source", "Destination",
          "Scenario")


def read_berlin(file: pathlib.Path, level: str) -> list[Route]:
    """sidelink_dataframe as CSV; a route per scenario and pair of cars. level: the column of the received level."""
    routes: dict[str, Route] = {}
    names: list[str] | None = None
    for number, line in lines_of(file):
        cells = next(csv.reader([line]))
        if names is None:
            names = [cell.strip() for cell in cells]
            missing = [name for name in (*BERLIN, level) if name not in names]
            if missing:
                raise InputError(f"{file}:{number}: no column {', '.join(missing)}; the first line must name the columns of "
                                 "sidelink_dataframe")
            continue
        if len(cells) != len(names):
            raise InputError(f"{file}:{number}: {len(cells)} columns, but {len(names)} names in the first line")
        row = dict(zip(names, cells))
        route = routes.setdefault(key := f"{row['Scenario']} {row['Source']}->{row['Destination']}", Route(key))
        wanted = [row[name] for name in (*BERLIN[:4], level)]
        if not all(cell.strip() for cell in wanted):
            route.left_out += 1
            continue
        values = [number_in(file, number, name, cell) for name, cell in zip((*BERLIN[:4], level), wanted)]
        route.senders.append(degrees_in(file, number, *values[:2]))
        route.receivers.append(degrees_in(file, number, *values[2:4]))
        route.gain_db.append(values[4])
    return list(routes.values())


# --- FLOURISH ---

# Fields of the logs by their places, counted from 0, as the authors' scripts take them (v2x-dev/ITS-G5_trials,
# importfileRX.m and importfileTCPDumpHP.m): RX-REQ-CAM lines separated by ";", tcpdump's by blanks, ";" and ":".
RX_MAC, RX_SEQUENCE, RX_LONGITUDE, RX_LATITUDE = 1, 13, 15, 17
DUMP_LEVEL, DUMP_MAC, DUMP_SEQUENCE, DUMP_LATITUDE, DUMP_LONGITUDE = 8, slice(16, 22), 42, 44, 46


def read_flourish(file: pathlib.Path, level: str) -> list[Route]:
    """NAME_RxCAM_HP.log with NAME_tcpDump_HP.log beside it: places of the receiver, and levels with their senders,
    joined by the sender's address and the number of the message. A route per sender."""
    del level
    if "RxCAM" not in file.name:
        raise InputError(f"{file}: give the log of the received messages, NAME_RxCAM_HP.log or NAME_RxCAM_LP.log")
    heard = read_dump(file.with_name(file.name.replace("RxCAM", "tcpDump")))
    routes: dict[str, Route] = {}
    for number, line in lines_of(file):
        cells = [cell.strip() for cell in line.split(";")]
        if len(cells) <= RX_LATITUDE:
            raise InputError(f"{file}:{number}: {len(cells)} fields, at least {RX_LATITUDE + 1} are needed")
        address, sequence = cells[RX_MAC].lower(), number_in(file, number, "the sequence number", cells[RX_SEQUENCE])
        route = routes.setdefault(address, Route(f"{file.stem} {address}"))
        longitude, latitude = (number_in(file, number, what, labelled(cells[place]))
                               for what, place in (("the longitude", RX_LONGITUDE), ("the latitude", RX_LATITUDE)))
        message = heard.get((address, sequence))
        if message is None or abs(longitude) > 180 or abs(latitude) > 90:  # no fix, or no level
            route.left_out += 1
            continue
        route.senders.append(message[1])
        route.receivers.append((latitude, longitude))
        route.gain_db.append(message[0])
    return list(routes.values())


def labelled(text: str) -> str:
    """A number that may stand behind a name, as in "Lat=51.4"."""
    return text.rsplit("=", 1)[-1].rsplit(":", 1)[-1]


def read_dump(file: pathlib.Path) -> dict[tuple[str, float], tuple[float, Place]]:
    """Returns {(address, number of the message): (its level in dBm, and the place that its sender reports)}."""
    out = {}
    for number, line in lines_of(file):
        cells = line.replace(";", " ").replace(":", " ").split(" ")
        if len(cells) <= DUMP_LONGITUDE:
            raise InputError(f"{file}:{number}: {len(cells)} fields, at least {DUMP_LONGITUDE + 1} are needed")
        level = number_in(file, number, "the level", cells[DUMP_LEVEL].removesuffix("dBm").removesuffix("dB"))
        sequence = number_in(file, number, "the sequence number", cells[DUMP_SEQUENCE].rstrip(","))
        latitude, longitude = (number_in(file, number, what, cells[place].rstrip(",")) / 1e7 for what, place in
                               (("the latitude", DUMP_LATITUDE), ("the longitude", DUMP_LONGITUDE)))
        address = ":".join(cells[DUMP_MAC]).lower()
        out[address, sequence] = level, degrees_in(file, number, latitude, longitude)
    return out


# For each campaign: the reader, and the column of the level if there are several.
CAMPAIGNS: dict[str, tuple[Callable[[pathlib.Path, str], list[Route]], str]] = {
    "cost231": (read_cost231, ""), "berlin": (read_berlin, "RSRP"), "flourish": (read_flourish, "")}
