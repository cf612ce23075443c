# SPDX-License-Identifier: Apache-2.0
"""Checks arguments of the package's functions at the entry: a message about a wrong type names the function that the
user has called, not one that it calls."""
from __future__ import annotations

import math
import operator
import os
from collections.abc import Iterable
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import ArgumentError, ConfigError

T = TypeVar("T")


def shown(value: Any) -> str:
    """A value in a message, which should not be a page long."""
    text = repr(value)
    return text if len(text) <= 80 else f"{text[:77]}..."


def integer(value: Any, what: str) -> int:
    """An integer of Python or NumPy. what: its name in messages, such as "the number of a frame"."""
    try:
        return operator.index(value)
    except TypeError:
        raise ArgumentError(f"{what} is an integer, not {shown(value)}") from None


def number(value: Any, what: str) -> float:
    """A finite number."""
    try:
        out = float(value) if not isinstance(value, (str, bytes)) else math.nan
    except (TypeError, ValueError):
        raise ArgumentError(f"{what} is a number, not {shown(value)}") from None
    if not math.isfinite(out):
        if isinstance(value, (str, bytes)):
            raise ArgumentError(f"{what} is a number, not {shown(value)}")
        raise ConfigError(f"{what} is {out}, but must be finite")
    return out


def numbers(value: ArrayLike, what: str) -> NDArray[Any]:
    """A number or one row of them, all finite, as a row."""
    try:
        out = np.asarray(value)
        if out.dtype.kind not in "iufb" and out.size:
            raise TypeError
        row = np.atleast_1d(out.astype(float))
    except (TypeError, ValueError):
        raise ArgumentError(f"{what}: give a number or one row of numbers, not {shown(value)}") from None
    if row.ndim != 1 or not np.isfinite(row).all():
        raise ConfigError(f"{what}: give a number or one row of numbers, all finite")
    return row


def path(value: Any, what: str) -> str:
    """The path of a file or folder."""
    try:
        out = os.fsdecode(value)
    except TypeError:
        raise ArgumentError(f"{what} is a path, not {shown(value)}") from None
    if "\0" in out:
        raise ConfigError(f"{what} has a null character, which no path can have: {shown(out)}")
    return out


def encoded(text: str, what: str) -> bytes:
    """A text for the library, which ends at the first null character."""
    if "\0" in text:
        raise ConfigError(f"{what} has a null character at place {text.index(chr(0))}: leave it out")
    try:
        return text.encode()
    except UnicodeEncodeError as error:
        raise ConfigError(f"{what} has a character that is no text, at place {error.start}: {text[error.start]!r}"
                          ) from None


def each(values: Iterable[T], what: str) -> list[T]:
    """A list of the items of an iterable; a text is refused."""
    if isinstance(values, (str, bytes)):
        raise ArgumentError(f"{what}, not the text {shown(values)}")
    try:
        return list(values)
    except TypeError:
        raise ArgumentError(f"{what}, not {shown(values)}") from None


class Unique:
    """Something of this process that cannot be copied or pickled. `_instead` says what can."""

    _instead = ""

    def __reduce_ex__(self, protocol: Any) -> Any:
        raise TypeError(f"a wavetracer.{type(self).__name__} can neither be pickled nor copied, since it belongs to the "
                        f"library of this process: {self._instead}")

    def __copy__(self) -> Any:
        return self.__reduce_ex__(4)

    def __deepcopy__(self, known: Any) -> Any:
        return self.__reduce_ex__(4)
