# SPDX-License-Identifier: Apache-2.0
"""The echoes that a radar receives on one link in a frame, computed here or by `wavetracer serve`."""
from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._cube import Cube

Array = NDArray[Any]


class Radar:
    """A link of a radar and its echoes. `name` is that of its [[radar]], `tx` and `rx` are the names of its ends, `left_out`
    says how many paths were too long for its waveform. detections: a dict of columns, by falling power, as
    Cube.detections() has them, and `azimuth_rad` and `elevation_rad`, NaN where the array cannot tell them. cube: a
    wavetracer.radar.Cube, or None where it was not asked for."""

    def __init__(self, name: str, tx: str, rx: str, left_out: int, detections: dict[str, Array], cube: Cube | None):
        self.name, self.tx, self.rx, self.left_out = name, tx, rx, left_out
        self.detections, self.cube = detections, cube

    def __repr__(self) -> str:
        return f"<wavetracer Radar {self.name}, {self.tx} to {self.rx}: {len(self.detections['range_m'])} detections>"


def radar_of_answer(radar: dict[str, Any]) -> Radar:
    """The same of an answer of a server, whose columns are there."""
    left_out, cube = int(radar["left_out"][0]), None
    if "cube" in radar:
        shape = (*(int(count) for count in radar["antennas"]), len(radar["doppler_hz"]), len(radar["delay_s"]))
        values = np.ascontiguousarray(radar["cube"]).view(np.complex128).reshape(shape)
        cube = Cube(values, radar["delay_s"], radar["doppler_hz"], float(radar["frequency_hz"][0]), left_out)
    return Radar(str(radar["radar"]), str(radar["tx"]), str(radar["rx"]), left_out, dict(radar["detections"]), cube)
