# SPDX-License-Identifier: Apache-2.0
"""Pages of runs that are unlike others: hostile names, no paths, one frame, thousands of frames, no scene, capped,
a narrow window. Arguments: browser.py."""
import sys

import numpy as np
from browser import Page

folder = sys.argv[1]

# Names are text, whatever they contain.
page = Page(folder, "hostile")
assert page.js("return window.hacked") is None
assert page.js("return document.images.length") == 0
attack = "</script><img src=x onerror=\"window.hacked=1\"> \"'&\u00fc\u6771\ufffd "
assert page.js("return wavetracer.meta.transmitters[0][0]") == attack + "rsu"
assert page.js("return document.getElementById('title').textContent") == attack
page.js("wavetracer.select(1)")
assert attack.strip() in page.text("details"), page.text("details")
page.choose("transmitter", 1)
page.js("const r = wavetracer.state.radios[0]; wavetracer.filters.reset(); wavetracer.select(0)")
for radio in range(3):
    at = page.js("return wavetracer.projector().point(wavetracer.state.radios[arguments[0]].m, 0)", radio)
    page.click(*at)
assert page.js("return window.hacked") is None and page.js("return document.images.length") == 0
page.check_clean()

# A run without paths: the page says so, and nothing fails.
page = Page(folder, "empty")
assert page.visible() == 0 and "no paths" in page.text("warnings"), page.text("warnings")
assert not page.find("player").is_displayed() and not page.find("charts").is_displayed()
page.click(200, 200)
page.screenshot("empty")
page.check_clean()

# A run of one frame: there is no time to play.
page = Page(folder, "single")
assert page.visible() == 3 and not page.find("player").is_displayed()
page.js("wavetracer.select(arguments[0])", page.index(2))
assert "order 2" in page.text("details") and "Delay 300.000 ns" in page.text("details"), page.text("details")
assert "Ports 0 to 1" in page.text("details")
assert page.find("charts").is_displayed() and not page.find("gain_figure").is_displayed()
page.check_clean()

# Thousands of frames: each can be chosen, and its counts are those of the file.
page = Page(folder, "long")
offsets = page.file["frames/path_offset"][...]
assert len(offsets) == 3001
for row in (0, 1, 1499, 2997, 2999):
    page.js("wavetracer.setFrame(arguments[0])", row)
    assert page.visible() == offsets[row + 1] - offsets[row], row
    assert f"frame {row}" in page.text("clock")
took = page.js("const start = performance.now(); for (let i = 0; i < 1000; ++i) wavetracer.setFrame(3 * i);"
               "return (performance.now() - start) / 1000")
print(f"long: {took:.2f} ms per frame of 3000")
page.check_clean()

# The scene file is missing: the page shows the rest and says why.
page = Page(folder, "missing")
assert "/nowhere/gone.xml" in page.text("warnings") and page.visible() == 24
vehicles = page.js("return wavetracer.world.vehicles.children.length")
assert vehicles == 2
page.check_clean()

# Capped: the strongest of all frames, and the page says so.
page = Page(folder, "capped")
gain = page.file["paths/gain_db"][...]
assert "50 strongest of 264" in page.text("warnings") and "50 strongest of 264" in page.text("summary")
kept = np.concatenate([page.js("wavetracer.setFrame(arguments[0]); return Array.from(wavetracer.state.frame.gain_db)", row)
                       for row in range(11)])
assert np.allclose(np.sort(kept), np.sort(gain)[-50:], atol=0.011), (np.sort(kept)[:3], np.sort(gain)[-50:][:3])
page.check_clean()

# The certificate of beams takes the place of what was missed; a page never says "probably none" of rays that do not show it.
page = Page(folder, "beams")
assert page.text("missed") == "", page.text("missed")
said = ("Beams have found every path of any number of interactions, up to 2 of them at edges with a gain of -120 dB or more between isotropic antennas, "
        "but for beams of 2\u00b710\u207b\u2079 sr in all, 2\u00b710\u207b\u00b9\u00b9 of the directions; a link misses at most -110 dB through them "
        "by paths without an edge. Weaker beams, with 1 % of the power, were not followed.")
assert page.text("certificate") == said, page.text("certificate")
page.choose("transmitter", 0)
page.choose("receiver", 1)
assert "Path gain" in page.text("link_figures") and "Missed" not in page.text("link_figures"), page.text("link_figures")
page.check_clean()
page = Page(folder, "sparse")
assert page.text("missed").startswith("It is not known what rays have missed: the rays do not show it"), page.text("missed")
assert page.text("certificate") == "" and "probably" not in page.text("missed")
page.choose("transmitter", 0)
page.choose("receiver", 1)
assert "Path gain" in page.text("link_figures") and "Missed" not in page.text("link_figures"), page.text("link_figures")
page.check_clean()

# A narrow window: nothing is wider than it, and the picture is still there.
page = Page(folder, "drive", width=390, height=844, dark=False)
assert page.js("return document.documentElement.scrollWidth") <= 390
size = page.find("world").size
assert size["width"] > 380 and size["height"] > 300, size
page.click(size["width"] / 2, size["height"] / 2)
page.screenshot("narrow")
page.check_clean()
print("hostile, empty, single, long, missing, capped, beams, sparse and narrow pages are right")
