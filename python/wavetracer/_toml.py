# SPDX-License-Identifier: Apache-2.0
"""Configurations as TOML text: a dict becomes a file that the program reads, and a value becomes the text after "key
="."""
from __future__ import annotations

import math
import os
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from .errors import ConfigError

_CONTROL = re.compile(r"[\x00-\x1f\x7f\"\\]")


def _string(text: str) -> str:
    return '"' + _CONTROL.sub(lambda found: f"\\u{ord(found[0]):04x}", text) + '"'


def _key(name: object) -> str:
    if not isinstance(name, str):
        raise ConfigError(f"configuration: a key is a text, not {name!r}")
    return name if re.fullmatch(r"[A-Za-z0-9_-]+(\.[A-Za-z0-9_-]+)*", name) else _string(name)


def _float(value: float) -> str:
    return repr(value) if math.isfinite(value) else str(value)  # TOML has inf, -inf and nan, too


def text_of(value: Any, where: str) -> str:
    """One value in TOML. `where` is the key that it belongs to, for messages."""
    if type(value).__module__ == "numpy" and hasattr(value, "tolist"):
        value = value.tolist()  # an array becomes a list, a number one of Python's; NumPy itself is not needed here
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return _float(value)
    if isinstance(value, (str, os.PathLike)):
        return _string(os.fspath(value))
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_key(k)} = {text_of(v, f'{where}.{k}')}" for k, v in value.items()) + "}"
    if isinstance(value, Sequence) and not isinstance(value, (bytes, bytearray)):
        return "[" + ", ".join(text_of(each, f"{where}[{i}]") for i, each in enumerate(value)) + "]"
    raise ConfigError(f"configuration: {where} is {value!r}; give a number, a text, True or False, a list or a dict")


def _is_tables(value: Any) -> bool:
    return (isinstance(value, Sequence) and not isinstance(value, (str, bytes)) and len(value) > 0
            and all(isinstance(each, Mapping) for each in value))


def _rows(table: Mapping[str, Any], where: str) -> str:
    return "".join(f"{_key(key)} = {text_of(value, f'{where}.{key}')}\n" for key, value in table.items()
                   if value is not None)


def document(config: Mapping[str, Any]) -> str:
    """A configuration as TOML text; a key whose value is None is left out."""
    plain = {key: value for key, value in config.items() if not isinstance(value, Mapping) and not _is_tables(value)
             and not (isinstance(value, list) and not value)}
    out = _rows(plain, "") if plain else ""
    for key, value in config.items():
        if isinstance(value, Mapping):
            out += f"[{_key(key)}]\n{_rows(value, key)}"
        elif _is_tables(value):
            for i, row in enumerate(value):
                out += f"[[{_key(key)}]]\n{_rows(row, f'{key}[{i}]')}"
    return out


def sets(keys: Mapping[str, Any], where: str = "") -> Iterator[str]:
    """The texts "key=value" of --set: {"trace": {"rays": 5}} and {"trace.rays": 5} are the same."""
    for key, value in keys.items():
        _key(key)
        name = f"{where}.{key}" if where else key
        if isinstance(value, Mapping):
            yield from sets(value, name)
        else:
            yield f"{name}={text_of(value, name)}"
