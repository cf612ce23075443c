# SPDX-License-Identifier: Apache-2.0
"""responses.h5 of a saved run: channels between all antennas of a link, as [response] asked for them."""
from __future__ import annotations

import pathlib
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .errors import ConfigError, InputError

Array = NDArray[Any]


class Responses:
    """The file, opened. `frequencies_hz` (absolute) and `times_s` (from the instant of each frame) are its axes."""

    def __init__(self, folder: pathlib.Path):
        import h5py

        self.name = folder.absolute() / "responses.h5"
        if not self.name.exists():
            raise ConfigError(f"{self.name}: there is no such file: the run had no response.bandwidth_hz")
        try:
            self._file = h5py.File(self.name)
            self.frequencies_hz: Array = np.asarray(self._read("frequencies/frequency_hz"))
            self.times_s: Array = np.asarray(self._read("times/time_s"))
            links = [self._read("links/" + name).astype(np.int64) for name in ("frame", "tx", "rx")]
            self._links = np.stack(links, axis=1)
            self._offset = self._read("links/row_offset").astype(np.int64)
            self._shapes = [(np.diff(self._read(f"{side}/first_element").astype(np.int64)),
                             self._read(f"{side}/ports").astype(np.int64)) for side in ("receivers", "transmitters")]
        except (OSError, KeyError) as error:
            raise InputError(f"{self.name}: it cannot be read: {error}") from None

    def __reduce__(self) -> Any:
        return Responses, (self.name.parent,)  # is opened again

    def _read(self, name: str) -> Array:
        return np.asarray(self._file[name][:])

    def close(self) -> None:
        self._file.close()

    def of(self, frame: int, tx: int, rx: int) -> Array:
        """The channel of a link, complex64 of shape (rx antennas, tx antennas, times, frequencies); antenna port *
        elements + element. Not normalized: absolute delays and phases."""
        found = np.flatnonzero((self._links == (frame, tx, rx)).all(axis=1))
        if len(found) == 0:
            raise ConfigError(f"{self.name}: frame {frame} has no link from transmitter {tx} to receiver {rx}")
        rows = slice(int(self._offset[found[0]]), int(self._offset[found[0] + 1]))
        h = self._file["responses/h_re"][rows] + np.complex64(1j) * self._file["responses/h_im"][rows]
        (rx_elements, rx_ports), (tx_elements, tx_ports) = self._shapes
        shape = (len(self.times_s), rx_elements[rx], rx_ports[rx], tx_elements[tx], tx_ports[tx],
                 len(self.frequencies_hz))
        # In the file the antenna number is element * ports + port.
        turned = h.reshape(shape).transpose(2, 1, 4, 3, 0, 5)
        return np.asarray(turned.reshape(shape[1] * shape[2], shape[3] * shape[4], shape[0], shape[5]))
