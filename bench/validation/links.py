# SPDX-License-Identifier: Apache-2.0
"""Gains, delays and spreads of many links from their paths, in arrays with one entry per pair of a transmitter and a
receiver."""
import numpy as np

WINDOW_DB = 25.0  # weaker paths than this below the strongest of a link do not count for spreads: TR 38.901, 7.5, step 6


def figures(paths, transmitters, receivers, diffraction=True):
    """Path loss (the sum of powers, between vertically polarised isotropic antennas), the same of the sum of fields, delay
    spread and azimuth spreads of arrival and departure, shape (transmitters * receivers,); inf and NaN where no path
    arrives. Without diffraction the paths over edges are left out."""
    keep = np.ones(len(paths), bool) if diffraction else paths.kind != "diffracted"
    link = (paths.tx.astype(int) * receivers + paths.rx)[keep]
    count = transmitters * receivers
    power = np.abs(paths.a[keep, 0, 0]) ** 2
    total = np.bincount(link, power, count)
    field = paths.a[keep, 0, 0] * np.exp(-2j * np.pi * (paths.frequency_hz * paths.delay_s[keep] % 1))
    field = np.bincount(link, field.real, count) + 1j * np.bincount(link, field.imag, count)
    strongest = np.zeros(count)
    np.maximum.at(strongest, link, power)
    heard = power > strongest[link] * 10 ** (-WINDOW_DB / 10)
    link, power, delay = link[heard], power[heard], paths.delay_s[keep][heard]
    weight = np.bincount(link, power, count)
    with np.errstate(divide="ignore", invalid="ignore"):
        loss, fading = -10 * np.log10(total), -20 * np.log10(np.abs(field))
        mean = np.bincount(link, power * delay, count) / weight
        spread = np.sqrt(np.bincount(link, power * (delay - mean[link]) ** 2, count) / weight)
        angular = {name: azimuth_spread(link, power, phi[keep][heard], count, weight)
                   for name, phi in (("asa", paths.aoa_phi_rad), ("asd", paths.aod_phi_rad))}
    return {"loss_db": loss, "fading_db": fading, "ds": spread, **angular}


def azimuth_spread(link, power, phi, count, weight):
    """Degrees, by equation A-1 of TR 38.901, Annex A."""
    mean = (np.bincount(link, power * np.cos(phi), count) + 1j * np.bincount(link, power * np.sin(phi), count)) / weight
    length = np.abs(mean)
    # A single path has a spread of 0, not its rounding.
    return np.degrees(np.sqrt(-2 * np.log(np.where(length > 1 - 1e-12, 1, length))))


def line_of_sight(paths, transmitters, receivers):
    out = np.zeros(transmitters * receivers, bool)
    straight = paths.depth == 0
    out[paths.tx[straight].astype(int) * receivers + paths.rx[straight]] = True
    return out
