# SPDX-License-Identifier: Apache-2.0
"""A map over several frames: one scale of colours for all of them, the slider and the player, the value under the pointer;
and the layers of the coherent power and of beams, against paths.h5. Arguments: browser.py."""
import sys

import numpy as np
from browser import Page

COLUMNS, ROWS, CELLS, FRAMES = 30, 12, 361, 4
carrier_hz, light_m_s = 5.9e9, 299792458
page = Page(sys.argv[1], "film", width=1440, height=900, dark=False)
paths = page.file["paths"]
frame, tx, rx = (paths[name][...] for name in ("frame", "tx", "rx"))
powers = np.zeros((FRAMES, 2, CELLS))
np.add.at(powers, (frame, tx, rx), 10 ** (paths["gain_db"][...] / 10))
fields = np.zeros((FRAMES, 2, CELLS), complex)
waves = (paths["a_re"][:, 0, 0] + 1j * paths["a_im"][:, 0, 0]) * np.exp(-2j * np.pi * ((carrier_hz * paths["delay_s"][...]) % 1))
np.add.at(fields, (frame, tx, rx), waves)
best = powers.argmax(axis=1)
with np.errstate(divide="ignore"):
    gain_db = 10 * np.log10(powers)
    narrowband_db = 20 * np.log10(np.abs(fields))
strongest = lambda values: np.take_along_axis(values, best[:, None], axis=1)[:, 0]
positions = page.file["frames/receiver_position_m"][0]
cell = lambda ix, iy: 1 + COLUMNS * iy + ix
probes = [cell(ix, iy) for ix in (0, 1, 6, 13, 16, 21, 27) for iy in (1, 5, 10)]


def scale_of(values):
    """The rule of the page: multiples of 5 dB around all values but the lowest and the highest percent."""
    known = np.sort(values[np.isfinite(values)])
    at = lambda share: known[int(np.floor(share * (len(known) - 1) + .5))]
    high = 5 * np.ceil(at(.99) / 5)
    return [min(max(5 * np.floor(at(.01) / 5), high - 100), high - 5), high]


def colours():
    """Colours of the legend, the weakest first."""
    row = page.js("const c = document.querySelector('#legend canvas');"
                  "return Array.from(c.getContext('2d').getImageData(0, 0, c.width, 1).data)")
    return np.array(row, float).reshape(-1, 4)[:, :3]


def check_cells(values, scale):
    """The probed cells have the colours of these values, in the frame that the page shows."""
    legend = colours()
    for rx in probes:
        share = np.clip((values[rx] - scale[0]) / (scale[1] - scale[0]), 0, 1)
        seen = page.pixels(*(project(positions[rx]) - .5), 0)[0, 0]
        assert np.linalg.norm(seen - legend[int(round(share * 219))]) < 14, (rx, values[rx], seen, share)


def check_values(quantity, wanted, tolerance=1e-3):
    """The page has these values of a quantity in the probed cells."""
    found = np.array([float(text) for text in page.js(  # JSON has no infinite numbers
        "return arguments[1].map((rx) => String(Quantities[arguments[0]].value(wavetracer.coverage.cells, rx)))", quantity, probes)])
    assert np.allclose(found, wanted[probes] if len(wanted) == CELLS else wanted, atol=tolerance), (quantity, found, wanted)


page.screenshot("film_1440")
for what in ("city", "labels", "paths", "streets"):
    page.check(f"show_{what}", False)
project = page.from_above()

# One scale holds for all frames: that of the gains of all links, and of the strongest of each cell for other layers.
spread = [strongest(gain_db)[f][probes] for f in range(FRAMES)]
assert max(np.ptp(spread, axis=0)) > 3, "the transmitter that moves changes the map"
legends = set()
for quantity, values, scale in (("gain", strongest(gain_db), scale_of(gain_db[:, :, 1:])),
                                ("narrowband", strongest(narrowband_db), scale_of(narrowband_db[:, :, 1:]))):
    page.choose("quantity", quantity)
    assert page.js("return range_of(arguments[0])", quantity) == scale, (quantity, scale)
    for f in (0, 3, 1, 2):
        page.type("time", f)
        assert f"frame {f}" in page.text("clock"), page.text("clock")
        check_values(quantity, values[f])
        check_cells(values[f], scale)
        legends.add(page.text("legend"))
assert len(legends) == 2, legends  # the legend of a layer stays as it is

# The player goes through the maps, and the value under the pointer is that of the frame.
page.choose("quantity", "gain")
page.type("time", 0)
words = lambda f: f"{strongest(gain_db)[f][cell(21, 5)]:.1f} dB, {('east', 'west')[best[f][cell(21, 5)]]}"
page.hover(*(project(positions[cell(21, 5)]) - .5))
page.wait("the value of the cell", lambda: page.text("pointer") == words(0))
assert words(0) != words(3)
page.js("wavetracer.setFrame(3)")
assert page.text("pointer") == words(3), (page.text("pointer"), words(3))
page.js("wavetracer.setFrame(0)")
page.choose("speed", "0.5")  # a busy machine skips frames of a film that is faster than it paints
page.js("window.seen = []; const paint = wavetracer.coverage.paint; wavetracer.coverage.paint = function (row, ...others) {"
        "window.seen.push(row); paint.call(this, row, ...others); }")
page.find("play").click()
page.wait("the last frame", lambda: page.text("play") == "Play")
assert page.js("return window.seen") == [1, 2, 3], page.js("return window.seen")
check_cells(strongest(gain_db)[3], scale_of(gain_db[:, :, 1:]))
page.choose("transmitter", 0)
check_cells(gain_db[3][0], scale_of(gain_db[:, :, 1:]))
page.choose("transmitter", -1)

# The mean over a cell of 1 m is that of many places in it, where every path is a plane wave.
theta, phi = paths["aoa_theta_rad"][...], paths["aoa_phi_rad"][...]
wave_number = 2 * np.pi * carrier_hz / light_m_s
along = wave_number * np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi)])
nodes, weights = np.polynomial.legendre.leggauss(200)
for f in (0, 2):
    page.type("time", f)
    mean_db, fading_db = [], []
    for end in probes:
        own = (frame == f) & (rx == end) & (tx == best[f][end])
        x, y = (np.exp(.5j * nodes[:, None] * along[axis, own]) for axis in (0, 1))
        power = np.abs(np.einsum("ik,jk,k->ij", x, y, waves[own])) ** 2
        mean = weights @ power @ weights / 4
        mean_db.append(10 * np.log10(mean))
        with np.errstate(divide="ignore"):
            square = weights @ (power - mean) ** 2 @ weights / 4 / mean ** 2
            fading_db.append(10 * np.log10(square) if own.sum() > 1 else -np.inf)
    check_values("cell_mean", np.array(mean_db))
    check_values("fading", np.array(fading_db), 1)  # the page has the variance of 1,024 places, see cell_area.hpp
page.choose("quantity", "fading")
page.hover(*(project(positions[cell(1, 5)]) - .5))
page.wait("the words for a cell of one path", lambda: "the same power everywhere" in page.text("pointer"))

# Beams: their gains are those of links.csv, and colours of their numbers repeat.
column = np.array([(end - 1) % COLUMNS for end in probes])
for f in (0, 2):
    page.type("time", f)
    check_values("beam_gain", -70 - 3 * f - .5 * column)
    check_values("tx_beam", column % 15)
    check_values("rx_beam", 0 * column)
page.choose("quantity", "tx_beam")
assert "beam 11" in page.text("legend") and "beam 12" not in page.text("legend"), page.text("legend")
assert "colours repeat" in page.text("legend"), page.text("legend")
for ix in (13, 16):
    seen = page.pixels(*(project(positions[cell(ix, 5)]) - .5), 0)[0, 0]
    assert np.linalg.norm(seen - [0xe6, 0x9f, 0]) < 12, (ix, seen)  # beams 13 and 1
page.screenshot("film_beams")
page.click(*(project(positions[cell(13, 5)]) - .5))
assert "Best beams -82.50 dB, beam 13 to 0" in page.text("details"), page.text("details")
assert "Over the cell mean" in page.text("details"), page.text("details")
page.check_clean()

page = Page(sys.argv[1], "film", width=390, height=844, dark=True)
page.find("top").click()
page.type("time", 2)
page.choose("quantity", "narrowband")
assert page.find("time").is_displayed() and "frame 2" in page.text("clock")
width = page.js("return document.documentElement.scrollWidth")
assert width <= 390, width
page.js("document.getElementById('view').scrollIntoView()")
page.screenshot("film_390")
page.check_clean()
print("film: colours, values and the player are right in all frames")
