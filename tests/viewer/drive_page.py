# SPDX-License-Identifier: Apache-2.0
"""A drive in the browser: pixels, clicks, filters, time, keys; numbers against paths.h5. Arguments: browser.py."""
import re
import sys
import time

import numpy as np
from browser import ActionChains, By, Page
from selenium.webdriver.common.keys import Keys

page = Page(sys.argv[1], "drive")
column = {name: page.file["paths"][name][...] for name in ("tx", "rx", "depth", "gain_db", "delay_s", "doppler_hz")}
names = [n.decode() if isinstance(n, bytes) else n for n in page.file["transmitters/name"][...]]
rows = page.frame_rows(0)

# The page says what it shows.
assert page.text("title") == "drive"
assert "3 antennas" in page.text("summary"), page.text("summary")  # rsu, and a roof each of two vehicles
assert "264 paths" in page.text("summary") and "11 frames" in page.text("summary"), page.text("summary")
assert page.visible() == len(rows) == 24
assert page.text("count").startswith("24 of 24"), page.text("count")
assert set(page.js("return wavetracer.overlay.names")) == set(names), page.js("return wavetracer.overlay.names")

# The picture has a city and vehicles in it, and they can be hidden.
def picture():
    size = page.find("world").size
    return page.pixels(size["width"] / 2, size["height"] / 2, min(size["width"], size["height"]) // 2 - 2)

page.screenshot("drive")
full = picture()
assert len(np.unique(full.reshape(-1, 3), axis=0)) > 50, "the picture is blank"
page.check("show_vehicles", False)
without = picture()
assert np.any(without != full), "vehicles are not to be seen"
page.check("show_streets", False)
bare = picture()
assert np.any(bare != without), "streets are not to be seen"
page.check("show_city", False)
assert np.mean(np.any(picture() != bare, axis=2)) > 0.1, "the city is not to be seen"

# Each path has its colour of the legend where a pinhole camera sees it.
project = page.from_above()
page.check("show_labels", False)
sky = page.pixels(3, 3, 1)[1, 1]
low, high = page.js("return [lowest_db, highest_db]")
legend = np.array(page.js("const c = document.querySelector('#legend canvas');"
                          "return Array.from(c.getContext('2d').getImageData(0, 0, c.width, 1).data)"), float)
legend = legend.reshape(-1, 4)[:, :3]
assert low <= column["gain_db"].min() and high >= column["gain_db"].max() and high - low <= 60, (low, high)
segments = [(row, np.array([project(p) for p in page.points(row, 0)])) for row in rows]

def distance(at, polyline):
    a, b = polyline[:-1], polyline[1:]
    d = b - a
    t = np.clip(np.sum((at - a) * d, axis=1) / np.maximum(np.sum(d * d, axis=1), 1e-12), 0, 1)
    return np.min(np.linalg.norm(at - a - t[:, None] * d, axis=1))

seen = []
for row, polyline in segments:
    # Finds a place on the path that no other path comes near.
    for t in np.linspace(0.1, 0.9, 17):
        k = len(polyline) // 2 - 1
        at = polyline[k] * (1 - t) + polyline[k + 1] * t
        if min(distance(at, other) for r, other in segments if r != row) > 12 and \
           min(np.linalg.norm(at - p[end]) for _, p in segments for end in (0, -1)) > 14:
            seen.append((row, at))
            break
assert len(seen) >= 4, len(seen)
for row, at in seen:
    near = page.pixels(*at, 2).reshape(-1, 3) - sky
    brightest = near[np.argmax(np.linalg.norm(near, axis=1))]
    share = (column["gain_db"][row] - low) / (high - low)
    wanted = legend[int(round(share * (len(legend) - 1)))] - sky
    cosine = brightest @ wanted / (np.linalg.norm(brightest) * np.linalg.norm(wanted))
    assert np.linalg.norm(brightest) > 0.3 * np.linalg.norm(wanted) and cosine > 0.97, (row, brightest, wanted, cosine)
page.check("show_paths", False)
for row, at in seen:
    assert np.allclose(page.pixels(*at, 2), sky, atol=2), "paths are still to be seen"
page.check("show_paths", True)

# A click opens the path that is there, with the numbers of the file.
for row, at in seen:
    page.click(*at)
    said = page.text("details")
    for words in (f"Delay {column['delay_s'][row] * 1e9:.3f} ns", f"Gain {column['gain_db'][row]:.2f} dB",
                  f"Length {column['delay_s'][row] * 299792458:.3f} m", f"From {names[column['tx'][row]]}",
                  f"order {column['depth'][row]}", f"Doppler {column['doppler_hz'][row]:.2f} Hz"):
        number = words.split()[1]
        assert words in said or (number.replace(".", "").isdigit() and any(
            abs(float(word) - float(number)) < 2e-3 for word in said.split() if word.replace(".", "").isdigit())), \
            (words, said)
    assert len(page.find("details").find_elements(By.CSS_SELECTOR, "li")) == column["depth"][row]
    azimuth = np.degrees(page.file["paths/aod_phi_rad"][row])
    assert abs(float(said.split("Departure")[1].split("azimuth ")[1].split("\u00b0")[0]) - azimuth) < 0.011, said
    assert page.find("charts").is_displayed()
page.click(5, 300)
assert "Click a path" in page.text("details")
by_kind = page.js("const f = wavetracer.state.frame; return Array.from(f.kind)")

# Places name their surface, material and object.
reflected = next(i for i in range(24) if by_kind[i] == 1)
page.js("wavetracer.select(arguments[0])", reflected)
assert re.search(r"reflection at -?\d+\.\d\d, .* m; surface \d+, (concrete|brick|wood|metal|glass|marble) of \w+",
                 page.text("details")), page.text("details")

# Filters count what the file counts.
def count(wanted):
    return int(np.count_nonzero(wanted[rows]))

page.find("reset").click()
page.choose("transmitter", 1)
assert page.visible() == count(column["tx"] == 1) > 0
page.choose("receiver", 1)
assert page.visible() == count((column["tx"] == 1) & (column["rx"] == 1)) > 0
page.find("reset").click()
page.type("least_order", 1)
page.type("most_order", 2)
assert page.visible() == count((column["depth"] >= 1) & (column["depth"] <= 2)) > 0
page.find("reset").click()
threshold = round(np.median(column["gain_db"][rows]))
page.type("power", threshold)
assert page.visible() == count(column["gain_db"] >= threshold) > 0
assert page.text("power_text") == f"{threshold} dB"
page.find("reset").click()
offsets, met = page.file["paths/vertex_offset"][...], page.file["vertices/interaction"][...]
kind = np.array([max([0] + [{1: 1, 4: 2, 8: 3, 2: 4}[v] for v in met[offsets[i]:offsets[i + 1]]])
                 for i in range(len(offsets) - 1)])
for number, name in enumerate(("line_of_sight", "reflected", "transmitted", "diffracted", "scattered")):
    if name in ("transmitted", "scattered"):  # neither computed nor in the file
        assert np.all(kind != number) and not page.js("return document.getElementById('kind_' + arguments[0])", name)
        continue
    page.check("kind_" + name, False)
    assert page.visible() == count(kind != number), name
    page.check("kind_" + name, True)
assert page.visible() == 24

# Colours by order and kind have their legends.
page.choose("colour", "order")
assert page.text("legend").split("\n")[1:] == ["0", "1", "2", "3"] or "0" in page.text("legend"), page.text("legend")
page.choose("colour", "kind")
assert "diffracted" in page.text("legend") and "transmitted" not in page.text("legend")
page.choose("colour", "power")
assert "dB" in page.text("legend")

# A click on an end offers its links, and one of them is chosen by its button.
project = page.from_above()  # a link was chosen since, and came into view
page.click(*project(page.file["frames/transmitter_position_m"][0, 0]))
assert page.text("details").startswith("rsu"), page.text("details")
assert page.visible() == count(column["tx"] == 0)
buttons = page.find("details").find_elements(By.CSS_SELECTOR, ".links button")
power = {rx: 10 * np.log10(np.sum(10 ** (column["gain_db"][rows][(column["tx"][rows] == 0) & (column["rx"][rows] == rx)] / 10)))
         for rx in (0, 1)}
assert len(buttons) == 2 and f"{max(power.values()):.2f} dB" in buttons[0].text.replace("\u2212", "-"), buttons[0].text
buttons[0].click()
assert page.visible() == 6 and page.find("charts").is_displayed()
assert page.text("link_name").startswith("rsu")
page.find("reset").click()

# Time: slider, keys, play.
def row():
    return page.js("return wavetracer.player.row")

page.type("time", 7)
assert row() == 7 and "frame 7" in page.text("clock") and page.text("clock").startswith("0.70 s")
moved = page.js("return Array.from(wavetracer.state.frame.pose_m.slice(0, 3))")
expected = page.file["poses/position_m"][14] - page.js("return wavetracer.meta.centre_m")
assert np.allclose(moved, expected, atol=1e-4), (moved, expected)
body = page.driver.find_element(By.TAG_NAME, "body")
for key, wanted in ((Keys.ARROW_RIGHT, 8), (Keys.ARROW_LEFT, 7), (Keys.HOME, 0), (Keys.END, 10), (Keys.ARROW_RIGHT, 10)):
    body.send_keys(key)
    assert row() == wanted, (key, row())
page.js("wavetracer.setFrame(0)")
page.choose("speed", "1")
page.find("world").send_keys(" ")
assert page.text("play") == "Pause"
start = time.monotonic()
while row() < 10 and time.monotonic() - start < 30:
    time.sleep(0.05)
took = time.monotonic() - start
assert row() == 10 and took > 0.7, f"1 s of drive took {took:.1f} s"
assert page.text("play") == "Play"
page.find("play").click()
page.find("play").click()
assert page.text("play") == "Play" and row() < 10

# Drag turns, wheel and + zoom, and a drag selects nothing.
before = page.js("const o = wavetracer.orbit; return [o.azimuth, o.elevation, o.distance]")
page.find("home").click()
details = page.text("details")
ActionChains(page.driver).drag_and_drop_by_offset(page.find("world"), 60, 20).perform()
after = page.js("const o = wavetracer.orbit; return [o.azimuth, o.elevation, o.distance]")
assert after[0] != before[0] and page.text("details") == details
body.send_keys("+")
assert page.js("return wavetracer.orbit.distance") < after[2]

# Light and dark differ.
page.check("show_city", True)
dark = picture()
page.scheme("light")
page.wait("the light picture", lambda: np.mean(picture()) > np.mean(dark) + 20)
assert page.js("return getComputedStyle(document.body).backgroundColor") == "rgb(247, 246, 243)"
page.check_clean()
print("drive: pixels, clicks, filters, time and keys are right")
