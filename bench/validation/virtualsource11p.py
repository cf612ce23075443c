# SPDX-License-Identifier: Apache-2.0
"""VirtualSource11p: the path loss between two vehicles whose streets cross, fitted to levels at crossings of Munich that
off-the-shelf radios of IEEE 802.11p measured at 5.9 GHz down to -92 dBm (T. Mangel, O. Klemp, H. Hartenstein, EURASIP
Journal on Wireless Communications and Networking 2011:182).

The article's text was not at hand as a whole. The equation is that of T. Abbas et al., International Journal of Antennas and
Propagation 2015, equation 6, after two public transcriptions of it, one in Python and one in Rust. A third, which also has
the breakpoint of 180 m, agrees in all constants, but leaves the distance to the wall outside of the exponent 0.81; it stands
alone, so the equation of Abbas is taken. The model holds where houses hide the ends from each other; near the crossing the article goes over to line of
sight. Its ranges of distances and widths were not at hand. Metres, dB."""
import numpy as np

OFFSET_DB = 3.75
SUBURBAN_DB = 2.94
EXPONENT, TRANSMITTER_EXPONENT, STREET_EXPONENT = 2.69, 0.957, 0.81
BREAKPOINT_M = 180.0
SIGMA_DB = 4.1  # The fading about the model has this deviation.
FREQUENCY_GHZ = 5.9


def path_loss(transmitter_m, receiver_m, receiver_street_m, wall_m, suburban=False):
    """The loss at 5.9 GHz. transmitter_m, receiver_m: from the centre of the crossing; receiver_street_m: the width of the
    receiver's street; wall_m: from the transmitter to the wall of its street."""
    wavelength = 0.2998 / FREQUENCY_GHZ
    street = np.asarray(transmitter_m, float) ** TRANSMITTER_EXPONENT / (wall_m * receiver_street_m) ** STREET_EXPONENT
    receiver = np.asarray(receiver_m, float)
    far = np.where(receiver > BREAKPOINT_M, receiver / BREAKPOINT_M, 1.0)
    offset = OFFSET_DB + (SUBURBAN_DB if suburban else 0.0)
    return offset + 10 * EXPONENT * np.log10(street * 4 * np.pi * receiver * far / wavelength)
