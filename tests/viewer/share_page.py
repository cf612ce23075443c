# SPDX-License-Identifier: Apache-2.0
"""The page gives away: an address that shows the view again, a link as CSV, the picture; and that nothing
is cut off in narrow windows. Arguments: browser.py."""
import csv
import os
import sys

import numpy as np
from browser import Page

folder = sys.argv[1]
page = Page(folder, "drive")
# A link in all frames has the numbers of links.csv, whose columns have the same names.
text = page.js("return link_csv(0, 1)")
rows = list(csv.DictReader(text.splitlines()))
with open(os.path.join(folder, "drive", "links.csv"), newline="", encoding="utf-8") as file:
    ends = rows[0]["tx"], rows[0]["rx"]
    wanted = [row for row in csv.DictReader(file) if (row["tx"], row["rx"]) == ends]
assert ends == tuple(page.js("return [meta.transmitters[0][0], meta.receivers[1][0]]"))
assert len(rows) == len(wanted) == 11 and set(rows[0]) <= set(wanted[0]), (len(rows), len(wanted), rows[0])
for row, told in zip(rows, wanted):
    for name, value in row.items():
        if name not in ("tx", "rx"):
            assert np.isclose(float(value), float(told[name]), rtol=1e-5, equal_nan=True), (name, value, told[name])

# An address restores frame, link, path, camera, colours and filters in a new page.
page.js("wavetracer.setFrame(3)")
page.choose("transmitter", 0)
page.choose("receiver", 1)
page.choose("colour", "kind")
page.check("show_labels", False)
page.type("least_order", 1)
page.js("wavetracer.select(wavetracer.lines.visible[0]); wavetracer.orbit.turn(0.3, -0.2); wavetracer.orbit.zoom(0.7);")
VIEW = """const {orbit, player, filters, state} = wavetracer, {target, distance, azimuth, elevation} = orbit;
return [[...target.toArray(), distance, azimuth, elevation], player.row, filters.tx, filters.rx, state.selected, state.link,
        filters.least_order, document.getElementById("colour").value, state.labels, wavetracer.visibleCount()];"""
before = page.js(VIEW)
assert before[1:4] == [3, 0, 1] and before[4] >= 0, before
page.wait("the address", lambda: "camera=" in page.js("return location.hash") and
          page.js("return location.hash.slice(1) === view_address()"))
address = page.js("return location.href")
page.driver.get("about:blank")
page.driver.get(address)
page.wait("the page", lambda: page.js("return !!window.wavetracer"))
after = page.js(VIEW)
assert np.allclose(before[0], after[0], atol=1e-3) and before[1:] == after[1:], (before, after)
# One that says nothing of a view changes nothing; names that the run lacks choose all ends.
assert page.js("return show_address('#nonsense')") is False and page.js(VIEW) == after
assert page.js("return show_address('#camera=0,0,0,50,0,1&tx=nobody&frame=77')") is True
assert page.js(VIEW)[1:4] == [0, -1, -1]

# The picture has the scene, and the legend where the page has it.
size, legend, sky = page.js("""const made = picture(), pen = made.getContext("2d");
const box = document.querySelector("#legend canvas").getBoundingClientRect(), at = canvas.getBoundingClientRect();
const y = box.top - at.top + box.height / 2, ratio = made.width / at.width;
const pixel = (x) => Array.from(pen.getImageData(Math.round((box.left - at.left + x) * ratio), Math.round(y * ratio), 1, 1).data);
const bar = document.querySelector("#legend canvas").getContext("2d");
return [[made.width / at.width, made.height / at.height], [20, 110, 200].map(pixel),
        [20, 110, 200].map((x) => Array.from(bar.getImageData(x, 0, 1, 1).data))];""")
assert np.allclose(size, 1, atol=0.01), size
assert np.abs(np.array(legend) - np.array(sky)).max() <= 3, (legend, sky)
assert {"transmitter", "sends and receives", "vehicle"} & set(page.text("legend").split("\n")), page.text("legend")

# All controls are inside of the window, and all of the timeline inside of the view.
CUT = """const wide = document.documentElement.clientWidth, out = [];
for (const part of document.querySelectorAll("#player *, aside *, #legend, #help, #player")) {
  const box = part.getBoundingClientRect(), parent = part.closest("main, aside").getBoundingClientRect();
  if (box.width && (box.right > Math.min(wide, parent.right) + 0.5 || box.left < parent.left - 0.5)) out.push(part.id || part.textContent);
}
return [document.documentElement.scrollWidth - wide, out];"""
for width in (1440, 1000, 800, 761, 390):
    page.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", dict(width=width, height=900, deviceScaleFactor=1, mobile=False))
    page.wait(f"{width} pixels", lambda: page.js("return document.documentElement.clientWidth") == width)
    assert page.js(CUT) == [0, []], (width, page.js(CUT))
# In the narrowest window the legend is below the view, and the picture has it there.
BELOW = """const view = canvas.getBoundingClientRect(), legend = document.getElementById("legend").getBoundingClientRect(), made = picture();
const ratio = made.width / view.width, bar = document.querySelector("#legend canvas").getBoundingClientRect();
const at = [bar.left - view.left + 20, bar.top - view.top + bar.height / 2].map((x) => Math.round(x * ratio));
return [view.height, legend.top - view.bottom, made.height / ratio - view.height - legend.height,
        Array.from(made.getContext("2d").getImageData(...at, 1, 1).data),
        Array.from(document.querySelector("#legend canvas").getContext("2d").getImageData(20, 0, 1, 1).data)];"""
page.wait("the view", lambda: page.js("return canvas.width === Math.round(canvas.clientWidth * devicePixelRatio)"))
high, gap, more, pixel, bar = page.js(BELOW)
assert high > 300 and abs(gap) < 1 and abs(more) < 2, (high, gap, more)
assert np.abs(np.array(pixel) - np.array(bar)).max() <= 3, (pixel, bar)
page.check_clean()
print("share: the address, the file of a link, the picture and narrow windows are right")
