# SPDX-License-Identifier: Apache-2.0
"""The ends of links, and the figures of each link: gain, delay, spreads."""
from __future__ import annotations

import fnmatch
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Union

import numpy as np
from numpy.typing import NDArray

from ._arguments import each as listed, integer
from .errors import ConfigError

if TYPE_CHECKING:
    import pandas

Array = NDArray[Any]
Chosen = Union[str, int, Iterable[Union[str, int]], None]


@dataclass(frozen=True)
class Ends:
    """The radio ends of a frame, and its carrier. Rows of `tx` and `rx` are places in these lists."""

    transmitters: tuple[str, ...]
    receivers: tuple[str, ...]
    frequency_hz: float
    tx_elements: tuple[int, ...] = ()  # elements of each array; empty: one each
    rx_elements: tuple[int, ...] = ()
    carriers_hz: tuple[float, ...] = ()


def places_of(names: Sequence[str], wanted: Chosen, what: str) -> list[int]:
    """The places of names, of patterns with * and ?, or of numbers, in the order in which they are given, and each once;
    those of one pattern are in the order of `names`."""
    if wanted is None:
        return list(range(len(names)))
    out: list[int] = []
    asked = f"{what}s: give names, patterns or places in the list, one or several"
    for each in [wanted] if isinstance(wanted, (str, int, np.integer)) else listed(wanted, asked):
        if isinstance(each, str):
            found = [i for i, name in enumerate(names) if name == each or fnmatch.fnmatchcase(name, each)]
        else:
            place = integer(each, f"a {what} is a name or a place in the list, which")
            found = [place] if 0 <= place < len(names) else []
        if not found:
            some = ", ".join(names[:8]) + (", ..." if len(names) > 8 else "")
            raise ConfigError(f"there is no {what} {each!r}; there are {len(names)}: {some}")
        out += found
    return list(dict.fromkeys(out))


class Links:
    """Figures of each link, computed from its paths: one row per pair of a transmitter and a receiver that was asked
    for.

    links["path_gain_db"] is a column, shape (links,). Columns: `tx`, `rx` (places in `transmitters` and `receivers`),
    `paths` (how many), `los` (True where one of them has no interaction), `path_gain_db` (fields of one wave added, then
    powers), `sum_of_powers_db` (of all paths), `narrowband_gain_db` (the sum of fields at the carrier), `mean_delay_s`,
    `rms_delay_spread_s`, `doppler_spread_hz`, `missed_power_share`. Gains are -inf, and delays and spreads NaN, where no path arrives. docs/formats.md has the
    formulas.
    """

    columns = ("tx", "rx", "paths", "los", "path_gain_db", "sum_of_powers_db", "narrowband_gain_db", "mean_delay_s",
               "rms_delay_spread_s", "doppler_spread_hz", "missed_power_share")

    def __init__(self, values: dict[str, Array], ends: Ends):
        self._values, self.transmitters, self.receivers = values, ends.transmitters, ends.receivers

    def __len__(self) -> int:
        return len(self._values["tx"])

    def __getitem__(self, name: str) -> Array:
        try:
            return self._values[name]
        except (KeyError, TypeError):
            raise ConfigError(f'there is no column "{name}" of links; there are {", ".join(self._values)}') from None

    def __repr__(self) -> str:
        reached = int(np.count_nonzero(self["paths"]))
        return f"<wavetracer.Links: {len(self):,} links, {reached:,} with a path>"

    def to_pandas(self) -> pandas.DataFrame:
        """A DataFrame with the names of the ends as `tx` and `rx`, one row per link. Needs pandas."""
        import pandas

        table = pandas.DataFrame({name: np.asarray(column) for name, column in self._values.items()})
        table["tx"] = np.asarray(self.transmitters, object)[self["tx"]]
        table["rx"] = np.asarray(self.receivers, object)[self["rx"]]
        return table

    def _repr_html_(self) -> str | None:
        try:
            return str(self.to_pandas()._repr_html_())
        except ImportError:
            return None
