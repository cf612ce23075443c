# SPDX-License-Identifier: Apache-2.0
"""A map of 300 x 300 receivers: how fast it is there and drawn, its colours, and what a click on a cell says, against
paths.h5. Arguments: browser.py."""
import csv
import os
import sys

import numpy as np
from browser import By, Page

page = Page(sys.argv[1], "coverage", dark=False)
loaded_s = (page.js("return wavetracer.ready_ms")) / 1000
# Waits until the picture is drawn: reading a pixel waits for it. Chromium draws with the processor here.
drawn = page.js("""
const times = [], gl = wavetracer.renderer.getContext();
for (let i = 0; i < 9; ++i) {
  const start = performance.now();
  wavetracer.orbit.turn(0.05, 0);
  wavetracer.draw();
  const own = performance.now() - start;
  gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  times.push([own, performance.now() - start]);
}
return [0, 1].map((k) => times.map((t) => t[k]).sort((a, b) => a - b)[4]);
""")
refilter_ms = page.js("const start = performance.now(); wavetracer.refilter(); return performance.now() - start")
print(f"coverage: 90000 cells, 2 transmitters: loaded in {loaded_s:.2f} s, redrawn in {drawn[0]:.0f} ms and with its pixels "
      f"in {drawn[1]:.0f} ms, coloured anew in {refilter_ms:.0f} ms")
assert loaded_s < 10 and drawn[0] < 100 and refilter_ms < 1000, (loaded_s, drawn, refilter_ms)
assert len(page.find("receiver").find_elements(By.TAG_NAME, "option")) == 2  # all, and the car
assert page.visible() == 4 and "click the map" in page.text("count"), page.text("count")  # those of the car
assert "3 antennas, map map of 300 \u00d7 300 receivers" in page.text("summary"), page.text("summary")

# The file's value of each cell is that of the strongest transmitter, with powers added.
paths = page.file["paths"]
tx, rx = paths["tx"][...], paths["rx"][...]
power = np.zeros((2, 90001))
np.add.at(power, (tx, rx), 10 ** (paths["gain_db"][...] / 10))
mean = np.zeros((2, 90001))
np.add.at(mean, (tx, rx), 10 ** (paths["gain_db"][...] / 10) * paths["delay_s"][...])
square = np.zeros((2, 90001))
with np.errstate(invalid="ignore"):
    mean /= power
np.add.at(square, (tx, rx), 10 ** (paths["gain_db"][...] / 10) * (paths["delay_s"][...] - mean[tx, rx]) ** 2)
positions = page.file["frames/receiver_position_m"][0]
best = np.argmax(power, axis=0)
with np.errstate(invalid="ignore", divide="ignore"):
    gain_db = 10 * np.log10(power[best, np.arange(90001)])
    spread_ns = 1e9 * np.sqrt(square[best, np.arange(90001)] / power[best, np.arange(90001)])
with open(os.path.join(sys.argv[1], "coverage", "links.csv")) as file:
    shares = {(row["tx"], row["rx"]): float(row["missed_power_share"]) for row in csv.DictReader(file)}


def cell(ix, iy):
    return 1 + 300 * iy + ix


# Colours: those of the legend, near the middle of the view. City and names would hide some.
page.screenshot("coverage")
page.check("show_city", False)
page.check("show_labels", False)
page.check("show_paths", False)
page.check("show_streets", False)
project = page.from_above()
assert page.js("return document.querySelectorAll('#legend canvas:not(.mark)').length") == 1  # of paths and of the map
assert "Path gain of paths and of the map, dB" in page.text("legend"), page.text("legend")
assert "no colour: no path" in page.text("legend"), page.text("legend")
legend = np.array(page.js("const c = document.querySelector('#legend canvas');"
                          "return Array.from(c.getContext('2d').getImageData(0, 0, c.width, 1).data)"), float)
legend = legend.reshape(-1, 4)[:, :3]
assert np.allclose(legend[0], [0x44, 1, 0x54], atol=2) and np.allclose(legend[-1], [0xfd, 0xe7, 0x25], atol=2)  # weak is dark


def at(ix, iy):
    """The pixel that the middle of a cell is in: pixels are rounded to the nearest corner of theirs."""
    return project(positions[cell(ix, iy)]) - 0.5


def check_colours(quantity, values):
    page.choose("quantity", quantity)
    low, high = page.js("return range_of(arguments[0])", quantity)
    for ix in (30, 100, 151, 201, 240):
        for iy in (40, 160, 250):
            share = np.clip((values[cell(ix, iy)] - low) / (high - low), 0, 1)
            seen = page.pixels(*at(ix, iy), 0)[0, 0]
            assert np.linalg.norm(seen - legend[int(round(share * 219))]) < 12, (quantity, ix, iy, seen, share)


check_colours("gain", gain_db)
sky = page.pixels(3, 3, 0)[0, 0]
assert np.allclose(page.pixels(*at(152, 150), 0), sky)  # no path
page.choose("transmitter", 1)
with np.errstate(divide="ignore"):
    check_colours("gain", 10 * np.log10(power[1]))
page.choose("transmitter", -1)
check_colours("spread", spread_ns)
assert page.js("return document.querySelectorAll('#legend canvas:not(.mark)').length") == 2
with np.errstate(divide="ignore", invalid="ignore"):
    check_colours("margin", np.abs(10 * np.log10(power[0] / power[1])))
page.screenshot("coverage_margin")
page.choose("quantity", "server")
for ix, server in ((102, best[cell(102, 160)]), (240, best[cell(240, 160)])):
    seen = page.pixels(*at(ix, 160), 0)[0, 0]
    assert np.linalg.norm(seen - [[0, 0x72, 0xb2], [0xe6, 0x9f, 0]][server]) < 12, (ix, seen, server)
assert "east" in page.text("legend") and "west" in page.text("legend")
page.screenshot("coverage_server")
options = [option.text for option in page.find("quantity").find_elements(By.TAG_NAME, "option")]
assert options == ["path gain", "narrowband gain", "received power", "SNR", "SINR", "interference", "best transmitter",
                   "margin", "delay spread", "K factor", "line of sight", "number of paths", "cell mean", "fading",
                   "none"], options
sent, noise = 1000, 1.380649e-23 * 290 * 20e6 * 1e3  # mW
own, other = (power[k, np.arange(90001)] for k in (best, 1 - best))
with np.errstate(divide="ignore", invalid="ignore"):
    check_colours("received", 30 + gain_db)
    check_colours("sinr", 10 * np.log10(sent * own / (noise + sent * other)))
    check_colours("interference", 30 + 10 * np.log10(other))
    page.choose("transmitter", 1)
    check_colours("sinr", 10 * np.log10(sent * power[1] / (noise + sent * power[0])))
    check_colours("margin", 10 * np.log10(power[1] / power[0]))
    page.choose("transmitter", -1)
page.choose("quantity", "los")
direct, around = (page.pixels(*at(ix, 160), 0)[0, 0] for ix in (102, 100))
assert np.linalg.norm(direct - [0, 0x72, 0xb2]) < 12 and np.linalg.norm(around - [0xe6, 0x9f, 0]) < 12, (direct, around)
assert "line of sight" in page.text("legend")
page.choose("quantity", "none")
assert np.allclose(page.pixels(*at(102, 160), 0), sky)
page.choose("quantity", "gain")
page.check("show_city", True)
page.check("show_paths", True)

# The value under the pointer.
page.hover(*at(102, 160))
page.wait("the value of the cell", lambda: page.find("pointer").is_displayed())
assert page.text("pointer") == f"{gain_db[cell(102, 160)]:.1f} dB, {('east', 'west')[best[cell(102, 160)]]}", page.text("pointer")
page.screenshot("coverage_pointer")
page.hover(*at(152, 150))
page.wait("a cell without a path", lambda: page.text("pointer") == "no path")

# A click on a cell: its figures and its paths.
page.check("show_city", False)
for ix, iy, count in ((102, 100, 4), (220, 100, 2)):
    page.click(*at(ix, iy))
    said, end = page.text("details"), cell(ix, iy)
    name = ("east", "west")[best[end]]
    assert said.startswith(f"map/{ix},{iy}"), said
    assert f"Strongest {name}" in said and f"{gain_db[end]:.2f} dB" in said and f"{spread_ns[end]:.2f} ns" in said, said
    assert f"Line of sight {'yes' if ix % 3 == 0 else 'no'}" in said, said
    assert "of the power" in said and shares[name, f"map/{ix},{iy}"] > 0, said
    assert page.visible() == count and page.text("link_name") == f"{name} \u2192 map/{ix},{iy}", page.text("link_name")
page.click(*at(152, 150))
assert "Click a path" in page.text("details")

# Cells are found by their names, though no list has them.
page.type("find", "map/12,")
found = [button.text for button in page.find("found").find_elements(By.TAG_NAME, "button")]
assert found[:3] == ["map/12,0", "map/12,1", "map/12,2"] and len(found) == 8, found
page.type("find", "MAP/12,34")
page.find("found").find_elements(By.TAG_NAME, "button")[0].click()
assert page.text("details").startswith("map/12,34") and page.text("found") == ""
page.type("find", "nowhere")
assert page.text("found") == "No antenna has that name."
page.scheme("dark")
page.check("show_city", True)
page.screenshot("coverage_cell")
page.check_clean()
print("coverage: colours, clicks and names are right")
