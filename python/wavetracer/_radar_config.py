# SPDX-License-Identifier: Apache-2.0
"""The [[radar]] tables of a run's configuration, which runs write with every key and one value a line."""
from __future__ import annotations

import ast
from typing import Any

from .errors import ConfigError

_WORDS = {"true": True, "false": False}


def tables(config: str) -> list[dict[str, Any]]:
    """One dict for each [[radar]] of the text."""
    out: list[dict[str, Any]] = []
    inside = False
    for line in config.splitlines():
        if line.startswith("["):
            inside = line.strip() == "[[radar]]"
            if inside:
                out.append({})
        elif inside and "=" in line and not line.startswith("#"):
            key, value = (part.strip() for part in line.split("=", 1))
            out[-1][key] = _WORDS[value] if value in _WORDS else ast.literal_eval(value)
    return out


def power_dbm(config: str, table: dict[str, Any]) -> float:
    """The power that a radar sends: its own, or that of [radio], or else 10 dBm."""
    if "power_dbm" in table:
        return float(table["power_dbm"])
    inside = False
    for line in config.splitlines():
        if line.startswith("["):
            inside = line.strip() == "[radio]"
        elif inside and line.startswith("transmit_power_dbm"):
            return float(line.split("=", 1)[1])
    return 10.0


def chosen(config: str, name: str | None) -> dict[str, Any] | None:
    """The [[radar]] of this name, or the only one; None if the run has none."""
    known = {table["name"]: table for table in tables(config)}
    if name is None and len(known) < 2:
        return next(iter(known.values()), None)
    if name not in known:
        raise ConfigError(f"the run has the radars {', '.join(known)}: name one of them" if known else
                          f"the run has no [[radar]], and so none that is called {name!r}")
    return known[name]
