# SPDX-License-Identifier: Apache-2.0
"""Columns of wavetracer.h and gradient.h as NumPy arrays."""
from __future__ import annotations

import ctypes
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._library import Column

_TYPES = {1: np.uint8, 2: np.uint32, 3: np.uint64, 4: np.float64, 5: np.complex128, 6: np.complex64}


def read_only(column: Column, keeper: Any) -> NDArray[Any]:
    """A view of a column in the library's memory, shape (rows, width), or (rows,) where the width is 1. keeper: the owner
    of the memory, which the view keeps."""
    dtype: np.dtype[Any] = np.dtype(_TYPES[column.type])
    memory: Any = (ctypes.c_uint8 * (column.rows * column.width * dtype.itemsize)).from_address(column.data)
    memory.keeper = keeper
    values = np.frombuffer(memory, dtype)
    values.flags.writeable = False
    return values if column.width == 1 else values.reshape(column.rows, column.width)
