# SPDX-License-Identifier: Apache-2.0
"""Basic transmission losses within street canyons: Recommendation ITU-R P.1411-12, section 4.1, after the transcription in
crc-covlib (crc_covlib.helper.itur_p1411). Frequencies in GHz, lengths in metres, losses in dB."""
import numpy as np

# Section 4.1.1, Table 4: alpha, beta, gamma, sigma; both ends below the roofs.
SITE_GENERAL = {"los": (2.12, 29.2, 2.11, 5.06), "nlos_high_rise": (4.00, 10.2, 2.36, 7.60),
                "nlos_low_rise": (5.06, -4.68, 2.02, 9.33)}
CORNER_M = 30.0  # section 4.1.3.2: how far the corner region reaches into the other street
CORNER_DB = 20.0  # urban


def site_general(frequency_ghz, distance_m, kind):
    """Section 4.1.1, equation 1: the median; `kind` is a key of SITE_GENERAL."""
    alpha, beta, gamma, _ = SITE_GENERAL[kind]
    return 10 * alpha * np.log10(distance_m) + beta + 10 * gamma * np.log10(frequency_ghz)


def los_bounds(frequency_ghz, distance_m, h1_m, h2_m, road_m=0.0):
    """Section 4.1.2, UHF and, up to 15 GHz, SHF with an effective height of the road (traffic): lower bound, median, upper
    bound of the two slopes about the breakpoint 4 h1 h2 / wavelength."""
    wavelength = 0.2998 / frequency_ghz
    heights = (h1_m - road_m) * (h2_m - road_m)
    breakpoint_m = 4 * heights / wavelength
    at_breakpoint = np.abs(20 * np.log10(wavelength**2 / (8 * np.pi * heights)))
    decades = np.log10(np.asarray(distance_m, float) / breakpoint_m)
    lower = at_breakpoint + np.where(decades <= 0, 20, 40) * decades
    upper = at_breakpoint + 20 + np.where(decades <= 0, 25, 40) * decades
    return lower, lower + 6, upper


def los_millimetre(frequency_ghz, distance_m, exponent=2.0):
    """Section 4.1.2, millimetre waves from 10 GHz on, without gases; Table 7 has exponents from 1.9 to 2.21."""
    return 20 * np.log10(frequency_ghz * 1000) - 28 + 10 * exponent * np.log10(distance_m)


def corner(frequency_ghz, x1_m, x2_m, street_m, h1_m, h2_m):
    """Section 4.1.3.2, 2 to 38 GHz: the ends in two streets that cross at right angles, x1 > 20 m and x2 from the crossing,
    the first street street_m wide; corners shaped as wedges, urban."""
    x1, x2 = np.asarray(x1_m, float), np.asarray(x2_m, float)
    los = los_bounds(frequency_ghz, x1, h1_m, h2_m)[1] if frequency_ghz < 10 else los_millimetre(frequency_ghz, x1)
    beyond = x2 - street_m / 2
    turning = CORNER_DB / np.log10(1 + CORNER_M) * np.log10(np.maximum(beyond, 1))
    far = 60 * np.log10((x1 + x2) / (x1 + street_m / 2 + CORNER_M))
    return los + np.where(beyond > 1 + CORNER_M, CORNER_DB + far, np.where(beyond > 1, turning, 0.0))


def one_turn(frequency_ghz, x1_m, x2_m, h1_m, h2_m, road_m=0.0):
    """Section 4.3.2.2, one turn, 0.43 to 4.86 GHz: terminals 1.5 to 4 m high in two streets that cross, x1 and x2 from the
    crossing, up to 1 km apart. Up to 30 m behind the crossing, powers go over linearly from those of sight."""
    x1, x2 = np.asarray(x1_m, float), np.asarray(x2_m, float)
    share = 3.45e4 * (frequency_ghz * 1e9) ** -0.46
    border = max(share**2, 30.0)
    beyond = np.maximum(x2, border)
    turn = x1 * beyond / (x1 + beyond) / share**2
    weight = np.minimum(x2 / border, 1)
    return los_bounds(frequency_ghz, x1 + x2, h1_m, h2_m, road_m)[1] + 10 * np.log10(1 - weight + weight * turn)
