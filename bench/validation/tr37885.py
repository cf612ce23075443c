# SPDX-License-Identifier: Apache-2.0
"""3GPP TR 37.885 V15, links between vehicles in a city: path loss (Table 6.2.1-1), what a vehicle in between adds (6.2.1),
delay and angular spreads (Table 6.2.3-1), as ns-3 has them (three-gpp-v2v-propagation-loss-model,
three-gpp-channel-model). GHz, metres, dB; spreads as (mean, sigma) of log10 of seconds or degrees."""
import numpy as np

SIGMA_DB = {"los": 3.0, "nlosv": 3.0, "nlos": 4.0}


def path_loss(frequency_ghz, distance_m, kind):
    """Table 6.2.1-1, urban. "nlosv": in the line of sight but for vehicles; without what these add."""
    f, d = np.log10(frequency_ghz), np.log10(distance_m)
    return 36.85 + 30 * d + 18.9 * f if kind == "nlos" else 38.77 + 16.7 * d + 18.2 * f


def blockage(distance_m, blocker_higher_than_both=True):
    """Section 6.2.1: (mean, sigma) in dB of what a vehicle in between adds, higher than both antennas or than one."""
    more = np.maximum(0, 15 * np.log10(distance_m) - 41)
    return (9 + more, 4.5) if blocker_higher_than_both else (5 + more, 4.0)


def spreads(frequency_ghz, kind):
    f = np.log10(1 + frequency_ghz)
    ds = {"los": (-0.2 * f - 7.5, 0.1), "nlosv": (-0.4 * f - 7, 0.1), "nlos": (-0.3 * f - 7, 0.28)}[kind]
    angle = {"los": (-0.1 * f + 1.6, 0.1), "nlosv": (-0.1 * f + 1.7, 0.1), "nlos": (-0.08 * f + 1.81, 0.05 * f + 0.3)}[kind]
    return {"ds": ds, "asa": angle, "asd": angle}
