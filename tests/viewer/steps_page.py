# SPDX-License-Identifier: Apache-2.0
"""Ways through a drive: a link comes into view, the wheel zooms to the pointer, a chosen path and a followed vehicle stay
through frames, a loop, Escape; and what rays have missed, against the files. Arguments: browser.py."""
import csv
import json
import os
import sys
import time

import numpy as np
from browser import ActionChains, By, Page
from selenium.webdriver.common.keys import Keys

page = Page(sys.argv[1], "drive")
body = page.driver.find_element(By.TAG_NAME, "body")
with open(os.path.join(sys.argv[1], "drive", "summary.json")) as file:
    missed = json.load(file)["missed"]
with open(os.path.join(sys.argv[1], "drive", "links.csv")) as file:
    links = list(csv.DictReader(file))


def row():
    return page.js("return wavetracer.player.row")


def camera():
    return np.array(page.js("const o = wavetracer.orbit, t = o.target; return [t.x, t.y, t.z, o.distance]"))


def pixels_of(link):
    return np.array(page.js(
        "const {frame} = wavetracer.state, p = wavetracer.projector();"
        "return [p.point(frame.transmitter_m, arguments[0]), p.point(frame.receiver_m, arguments[1])]", *link), float)


# The missed power is shown for the run, and for a link.
said = page.text("missed")
assert f"missed about {missed['paths']['estimate']:.0f} of 264 paths" in said, said
assert f"({missed['paths']['low']:.0f} to {np.ceil(missed['paths']['high']):.0f})" in said, said
assert "of the power (" in said and "e-" not in said, said
page.choose("transmitter", 0)
page.choose("receiver", 1)
page.js("wavetracer.setFrame(3)")
wanted = [link for link in links if link["tx"] == "rsu" and link["rx"] == "veh1/roof" and abs(float(link["time_s"]) - 0.3) < 1e-9]
share = float(wanted[0]["missed_power_share"])
assert len(wanted) == 1 and share > 0.001, wanted
assert f"Missed about {float(f'{100 * share:.2g}'):g} % of the power" in page.text("link_figures"), page.text("link_figures")
assert f"{float(wanted[0]['path_gain_db']):.2f} dB, {wanted[0]['paths']} paths" in page.text("link_figures")
narrowband = f"Narrowband gain {float(wanted[0]['narrowband_gain_db']):.2f} dB"
assert narrowband in page.text("link_figures"), page.text("link_figures")
budget = f"Received {float(wanted[0]['received_dbm']):.2f} dBm, SNR {float(wanted[0]['snr_db']):.2f} dB"
assert budget.replace("-", "\u2212") in page.text("link_figures").replace("-", "\u2212"), (budget, page.text("link_figures"))
assert f"{1e9 * float(wanted[0]['rms_delay_spread_s']):.2f} ns" in page.text("link_figures")

# Choosing a link brings it into view; one that is in view already leaves the camera alone.
size = page.find("world").size
inside = lambda at: np.all(at > 0) and np.all(at < [size["width"], size["height"]])
page.find("reset").click()
page.js("const o = wavetracer.orbit; o.target.set(3000, 3000, 0); o.distance = 50; o.apply();")
page.choose("transmitter", 0)
page.choose("receiver", 1)
assert inside(pixels_of((0, 1))), pixels_of((0, 1))
page.js("wavetracer.orbit.turn(0.1, 0)")
before = camera()
page.choose("receiver", -1)
page.choose("receiver", 1)
assert inside(pixels_of((0, 1))) and np.allclose(camera(), before), (camera(), before)
page.choose("transmitter", 1)  # 12 m apart: a speck, from so far
assert inside(pixels_of((1, 1))) and camera()[3] < before[3]
page.js("const o = wavetracer.orbit; o.distance = 20000; o.apply();")
page.choose("transmitter", 0)
assert np.linalg.norm(np.diff(pixels_of((0, 1)), axis=0)) > 100, "the link is a speck"
page.screenshot("link")

# The wheel keeps the place under the pointer where it is.
page.find("reset").click()
page.find("top").click()
page.js("wavetracer.orbit.turn(0, -0.5)")
x, y = size["width"] * 0.3, size["height"] * 0.4
under = page.js("const p = wavetracer.orbit.level_point(arguments[0], arguments[1]); return [p.x, p.y, p.z]", x, y)
page.js("document.getElementById('world').dispatchEvent(new WheelEvent('wheel', {deltaY: -300, clientX: arguments[0],"
        "clientY: arguments[1], bubbles: true, cancelable: true}))", x, y)
after = page.js("return wavetracer.projector().point(arguments[0], 0)", under)
assert np.allclose(after, [x, y], atol=0.5), (after, (x, y))
assert camera()[3] < before[3] or camera()[3] > 0

# A double click goes to what is there.
place = page.js("const hit = surface_under(wavetracer.world, wavetracer.orbit.raycaster(arguments[0], arguments[1]));"
                "return [hit.point.x, hit.point.y, hit.point.z]", x, y)
distance = camera()[3]
ActionChains(page.driver).move_to_element_with_offset(
    page.find("world"), round(x - size["width"] // 2), round(y - size["height"] // 2)).double_click().perform()
assert np.allclose(camera()[:3], place, atol=0.5) and camera()[3] < 0.5 * distance, (camera(), place)

# The whole view holds the whole scene and all frames, whatever the frame; from above, all frames.
page.find("home").click()
corners = page.js("const [a, b] = box_of_run(true), p = wavetracer.projector();"
                  "return [[a[0], a[1]], [b[0], b[1]], [a[0], b[1]], [b[0], a[1]]].map(([x, y]) => p.point([x, y, a[2]], 0))")
assert all(inside(np.array(corner)) for corner in corners), corners
low, high = np.array(page.js("return box_of_run(true)"))
city = np.array(page.js("return Array.from(city.vertices)")).reshape(-1, 3)
assert np.allclose(low[:2], city.min(axis=0)[:2]) and np.allclose(high[:2], city.max(axis=0)[:2])
views = []
for frame in (0, 10):
    page.js("wavetracer.setFrame(arguments[0])", frame)
    page.find("top").click()
    views.append(camera())
assert np.allclose(*views), views

# A chosen path stays chosen through frames, by its link and surfaces.
paths, offsets = page.file["paths"], page.file["paths/vertex_offset"][...]
surfaces = lambda i: page.file["vertices/surface"][offsets[i]:offsets[i + 1]].tolist()
page.js("wavetracer.setFrame(0)")
own = next(i for i in page.frame_rows(0) if paths["depth"][i] == 3 and paths["tx"][i] == 1)
page.js("wavetracer.select(arguments[0])", page.index(own))
body.send_keys(Keys.ARROW_RIGHT)
body.send_keys(Keys.ARROW_RIGHT)
same = [i for i in page.frame_rows(2) if (paths["tx"][i], paths["rx"][i]) == (paths["tx"][own], paths["rx"][own])
        and surfaces(i) == surfaces(own)]
assert row() == 2 and len(same) == 1
assert page.js("return wavetracer.state.selected") == page.index(same[0])
assert f"{paths['delay_s'][same[0]] * 1e9:.1f}"[:-1] in page.text("details"), page.text("details")
page.js("wavetracer.chosen.frame = {...wavetracer.chosen.frame, vertex_surface: wavetracer.chosen.frame.vertex_surface.map((s) => s + 1000)}")
body.send_keys(Keys.ARROW_RIGHT)
assert page.js("return wavetracer.state.selected") == -1 and "does not exist in this frame" in page.text("details")
assert page.find("charts").is_displayed()

# Escape shows all again.
page.choose("transmitter", 1)
page.type("power", -70)
body.send_keys(Keys.ESCAPE)
assert page.visible() == 24 and not page.find("charts").is_displayed() and "Click a path" in page.text("details")
assert page.find("transmitter").get_attribute("value") == "-1"

# A followed vehicle stays at its place in the picture.
page.js("wavetracer.setFrame(0)")
page.choose("follow", 1)
at = lambda: np.array(page.js("const {frame} = wavetracer.state; const k = frame.pose_instance.indexOf(1);"
                              "return wavetracer.projector().point(frame.pose_m, k)"))
first, target = at(), camera()
page.js("wavetracer.setFrame(10)")
assert np.allclose(at(), first, atol=0.5) and np.allclose(camera()[:3] - target[:3], [5, 0, 0], atol=1e-3), (camera(), target)
body.send_keys(Keys.ESCAPE)
before = camera()
page.js("wavetracer.setFrame(0)")
assert np.allclose(camera(), before)

# A loop begins again after the last frame.
page.check("loop", True)
page.choose("speed", "5")
page.js("wavetracer.setFrame(9)")
page.find("play").click()
seen, start = [], time.monotonic()
while time.monotonic() - start < 20 and not (10 in seen and seen[-1] < 9):
    seen.append(row())
assert 10 in seen and seen[-1] < 9 and page.text("play") == "Pause", seen[-5:]
page.find("play").click()

# Clutter, 60 dB below the strongest that is shown, is faded until it is asked for.
page.js("const {frame} = wavetracer.state, all = [...frame.gain_db].filter(Number.isFinite);"
        "const strong = Math.max(...all); for (let i = 0; i < 5; ++i) frame.gain_db[i] = strong - 61; wavetracer.refilter();")
assert page.js("return wavetracer.lines.faded") == 5 and "5 of them faded" in page.text("count")
page.check("fade_clutter", False)
assert page.js("return wavetracer.lines.faded") == 0

# Tests flat roofs: that of a house that shares no vertex with its walls is one; the ground, a pitched roof and the
# floor below are none.
roofs = page.js("""
const vertices = [], triangles = [], triangle_surface = [];
const quad = (corners, surface) => {
  const first = vertices.length / 3;
  corners.forEach((corner) => vertices.push(...corner));
  triangles.push(first, first + 1, first + 2, first, first + 2, first + 3);
  triangle_surface.push(surface, surface);
};
const box = (x, top, surface) => {
  const at = (k) => [[x, 0], [x + 9, 0], [x + 9, 9], [x, 9]][k % 4];
  for (let k = 0; k < 4; ++k) quad([[...at(k), 0], [...at(k + 1), 0], [...at(k + 1), top(...at(k + 1))], [...at(k), top(...at(k))]], surface);
  quad([0, 1, 2, 3].map((k) => [...at(k), 0]), surface + 1);
  quad([0, 1, 2, 3].map((k) => [...at(k), top(...at(k))]), surface + 2);
};
quad([[-50, -50, 0], [50, -50, 0], [50, 50, 0], [-50, 50, 0]], 0);
box(0, () => 8, 10);
box(20, (x) => 8 + (x - 20) / 2, 20);
const scene = {vertices: new Float32Array(vertices), triangles: new Uint32Array(triangles), triangle_surface: new Uint32Array(triangle_surface)};
const roofs = roof_triangles(scene);
return [...new Set(triangle_surface.filter((_, t) => roofs[t]))];
""")
assert roofs == [12], roofs
heights = page.js("const roofs = roof_triangles(city), z = [[], []];"
                  "for (let t = 0; t < roofs.length; ++t) z[roofs[t]].push(city.vertices[3 * city.triangles[3 * t] + 2]);"
                  "return [z[0].length, z[1].length, Math.min(...z[1]) - Math.min(...z[0])]")
assert heights[0] > 10 and heights[1] > 10 and heights[2] > 2, heights

# Names in the order of their numbers.
order = page.js("const select = document.createElement('select');"
                "fill_select(select, ['rx10', 'rx2', 'rx1'].map((name) => [name]), [0, 1, 2]);"
                "return [...select.options].map((option) => option.text)")
assert order == ["all", "rx1", "rx2", "rx10"], order
page.check_clean()
print("steps: links, zoom, steps, following, loop and Escape are right")
