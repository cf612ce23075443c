# SPDX-License-Identifier: Apache-2.0
"""The charts of a link: values lie where the file says, the frame is marked. Arguments: browser.py."""
import sys

import numpy as np
from browser import ActionChains, Page

page = Page(sys.argv[1], "drive")
paths = page.file["paths"]
tx, rx = 0, 1
page.choose("transmitter", tx)
page.choose("receiver", rx)
page.js("wavetracer.setFrame(3)")
rows = [row for row in page.frame_rows(3) if paths["tx"][row] == tx and paths["rx"][row] == rx]
low, high = page.js("return [lowest_db, highest_db]")
legend = np.array(page.js("const c = document.querySelector('#legend canvas');"
                          "return Array.from(c.getContext('2d').getImageData(0, 0, c.width, 1).data)"), float)
legend = legend.reshape(-1, 4)[:, :3]


def colour(gain_db):
    return legend[int(round((gain_db - low) / (high - low) * (len(legend) - 1)))]


def pixel(chart, x, y):
    return np.array(page.js(
        "const c = document.getElementById(arguments[0] + '_chart');"
        "return Array.from(c.getContext('2d').getImageData(Math.round(arguments[1]), Math.round(arguments[2]), 1, 1).data)",
        chart, x, y)[:3], float)


# Power delay profile: straight scales, and a dot of its colour for every path.
delay_ns, gain_db = paths["delay_s"][rows] * 1e9, paths["gain_db"][rows]
place = np.array(page.js("return arguments[0].map(([x, y]) => [wavetracer.charts.delay.x(x), wavetracer.charts.delay.y(y)])",
                         np.stack([delay_ns, gain_db], axis=1).tolist()))
for values, pixels, sign in ((delay_ns, place[:, 0], 1), (gain_db, place[:, 1], -1)):
    slope = np.diff(pixels) / np.diff(values)
    assert np.allclose(slope, slope[0]) and np.sign(slope[0]) == sign, slope
for (x, y), gain in zip(place, gain_db):
    assert np.linalg.norm(pixel("delay", x, y) - colour(gain)) < 40, (x, y, gain, pixel("delay", x, y), colour(gain))
assert page.js("return document.getElementById('delay_chart').getAttribute('aria-label')").startswith("6 paths")

# Angles: dots in the direction of the azimuth, counter-clockwise from the right.
for chart, name in (("departure", "aod_phi_rad"), ("arrival", "aoa_phi_rad")):
    width, height = page.js("const c = document.getElementById(arguments[0] + '_chart'); return [c.width, c.height]", chart)
    places = {row: np.array(page.js("return wavetracer.charts[arguments[0]].place(arguments[1])", chart, page.index(row)))
              for row in rows}
    for row, (x, y) in places.items():
        angle = np.arctan2(height / 2 - y, x - width / 2)
        assert abs(np.angle(np.exp(1j * (angle - paths[name][row])))) < 0.001, (chart, angle, paths[name][row])
    strongest = max(rows, key=lambda row: paths["gain_db"][row])  # lies on top of all others
    assert np.linalg.norm(pixel(chart, *places[strongest]) - colour(paths["gain_db"][strongest])) < 40, chart

# Gain over time: the power sum of all paths of the link, in every frame, and a line at the current one.
series = page.js("const s = wavetracer.charts.gains(arguments[0], arguments[1]); return [s.rows, s.gains]", tx, rx)
assert series[0] == list(range(11))
for frame, gain in zip(*series):
    own = [row for row in page.frame_rows(frame) if paths["tx"][row] == tx and paths["rx"][row] == rx]
    assert abs(gain - 10 * np.log10(np.sum(10 ** (paths["gain_db"][own] / 10)))) < 1e-4
x, y = page.js("return [wavetracer.charts.gain.x(0.3), wavetracer.charts.gain.y(arguments[0])]", series[1][3])
assert np.linalg.norm(pixel("gain", x, y) - [0x5a, 0xd1, 0xff]) < 60, pixel("gain", x, y)

# A click on the chart goes to that frame.
x = page.js("return wavetracer.charts.gain.x(0.8)")
canvas = page.find("gain_chart")
page.js("document.getElementById('gain_chart').scrollIntoView()")
ActionChains(page.driver).move_to_element_with_offset(canvas, round(x - canvas.size["width"] / 2), 0).click().perform()
assert page.js("return wavetracer.player.row") == 8
page.screenshot("charts")
page.check_clean()
print("charts: values lie where the file says")
