# SPDX-License-Identifier: Apache-2.0
"""Figures of links from the columns of their paths, by the formulas of docs/formats.md, and rows picked from columns."""
from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from .paths import Paths

Array = NDArray[Any]
_NO_GROUP = 0xFFFFFFFF


def joined_bits(values: Array, offset: Array) -> Array:
    """The bits of values[offset[i]:offset[i + 1]], joined, for each i; 0 of an empty range."""
    out = np.zeros(len(offset) - 1, np.uint8)
    filled = offset[1:] > offset[:-1]
    if filled.any():
        out[filled] = np.bitwise_or.reduceat(values, offset[:-1][filled].astype(np.intp))
    return out


def rows_of(column: Callable[[str], Array], rows: Array) -> Callable[[str], Array]:
    """Columns of some rows alone, in their order."""
    known: dict[str, Array] = {}

    def vertices() -> tuple[Array, Array]:
        offset = column("vertex_offset").astype(np.int64)
        counts = (offset[1:] - offset[:-1])[rows]
        ends = np.concatenate([[0], np.cumsum(counts)]).astype(np.int64)
        return np.repeat(offset[:-1][rows] - ends[:-1], counts) + np.arange(ends[-1]), ends

    def pick(name: str) -> Array:
        if name not in known:
            if name == "vertex_offset":
                picked = vertices()[1].astype(np.uint64)
            elif name.startswith("vertex_"):
                picked = column(name)[vertices()[0]]
            else:
                whole = column(name)
                picked = whole[rows] if len(whole) else whole  # a column that is not known has no rows
            picked.flags.writeable = False
            known[name] = picked
        return known[name]

    return pick


def _grouped(paths: Paths, row: Array, fields: Array, count: int) -> Array:
    """The power of each of `count` links: fields of groups are added, then powers. row: the link of each path; fields:
    at the carrier, shape (paths, rx ports, tx ports)."""
    group, weight = paths.group, paths.group_weight
    if len(group) == 0:
        return np.bincount(row, (np.abs(fields) ** 2).sum(axis=(1, 2)), count)
    path, slot = np.nonzero(group != _NO_GROUP)
    key, place = np.unique(row[path].astype(np.int64) << 32 | group[path, slot], return_inverse=True)
    sums = np.zeros((len(key), *fields.shape[1:]), complex)
    np.add.at(sums, place, fields[path] * weight[path, slot][:, None, None])
    return np.bincount(key >> 32, (np.abs(sums) ** 2).sum(axis=(1, 2)), count)


def of_links(paths: Paths, tx: Array, rx: Array) -> dict[str, Array]:
    """The figures of the links (tx[i], rx[i]), sorted and each once, from these paths alone, each of which belongs to
    one of these links. There is no estimate of missed paths for a part of the paths."""
    row = np.searchsorted(tx.astype(np.int64) << 32 | rx, paths.tx.astype(np.int64) << 32 | paths.rx)
    count = len(tx)
    power = (np.abs(paths.a) ** 2).sum(axis=(1, 2))
    total = np.bincount(row, power, count)

    def moments(values: Array) -> tuple[Array, Array]:
        mean = np.bincount(row, power * values, count) / total
        square = np.bincount(row, power * (values - mean[row]) ** 2, count) / total
        return mean, np.sqrt(square)

    carrier = np.exp(-2j * np.pi * (paths.frequency_hz * paths.delay_s % 1))[:, None, None]
    h = np.zeros((count, *paths.a.shape[1:]), complex)
    fields = paths.a * carrier
    np.add.at(h, row, fields)
    with np.errstate(divide="ignore", invalid="ignore"):
        delay, spread = moments(paths.delay_s)
        return {"paths": np.bincount(row, minlength=count).astype(np.uint32),
                "los": np.bincount(row, paths.depth == 0, count) > 0,
                "path_gain_db": 10 * np.log10(_grouped(paths, row, fields, count)),
                "sum_of_powers_db": 10 * np.log10(total),
                "narrowband_gain_db": 10 * np.log10((np.abs(h) ** 2).sum(axis=(1, 2))),
                "mean_delay_s": delay, "rms_delay_spread_s": spread,
                "doppler_spread_hz": moments(paths.doppler_hz)[1],
                "missed_power_share": np.full(count, np.nan)}
