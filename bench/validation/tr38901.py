# SPDX-License-Identifier: Apache-2.0
"""3GPP TR 38.901 V17, scenario UMi - street canyon: path loss (Table 7.4.1-1), delay and angular spreads (Table 7.5-6), as
ns-3 has them (three-gpp-propagation-loss-model, three-gpp-channel-model). Frequencies in GHz, metres, dB; spreads as
(mean, sigma) of log10 of seconds or degrees."""
import numpy as np

SIGMA_DB = {"los": 4.0, "nlos": 7.82}


def path_loss(frequency_ghz, distance_2d_m, base_m, terminal_m, kind):
    """Table 7.4.1-1, from 10 m to 5 km; the base station is 10 m high."""
    distance = np.asarray(distance_2d_m, float)
    spatial = np.hypot(distance, base_m - terminal_m)
    breakpoint_m = 4 * (base_m - 1) * (terminal_m - 1) * frequency_ghz / 0.3
    near = 32.4 + 21 * np.log10(spatial) + 20 * np.log10(frequency_ghz)
    far = (32.4 + 40 * np.log10(spatial) + 20 * np.log10(frequency_ghz)
           - 9.5 * np.log10(breakpoint_m**2 + (base_m - terminal_m) ** 2))
    los = np.where(distance <= breakpoint_m, near, far)
    if kind == "los":
        return los
    return np.maximum(los, 35.3 * np.log10(spatial) + 22.4 + 21.3 * np.log10(frequency_ghz) - 0.3 * (terminal_m - 1.5))


def spreads(frequency_ghz, kind):
    """Table 7.5-6, part 1: delay spread, azimuth spreads of arrival (terminal) and departure (base station)."""
    f = np.log10(1 + max(frequency_ghz, 2))
    if kind == "los":
        return {"ds": (-0.24 * f - 7.14, 0.38), "asa": (-0.08 * f + 1.73, 0.014 * f + 0.28), "asd": (-0.05 * f + 1.21, 0.41)}
    return {"ds": (-0.24 * f - 6.83, 0.16 * f + 0.28), "asa": (-0.08 * f + 1.81, 0.05 * f + 0.3),
            "asd": (-0.23 * f + 1.53, 0.11 * f + 0.33)}
