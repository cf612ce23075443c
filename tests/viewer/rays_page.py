# SPDX-License-Identifier: Apache-2.0
"""Sampled rays on the page: segments, who found their ends, centroids and how far they move. Arguments: browser.py."""
import sys

from browser import Page

folder = sys.argv[1]
page = Page(folder, "rays")
assert page.find("rays").is_displayed()
assert page.js("return wavetracer.rays.object.visible") is False  # not before they are asked for
page.js("wavetracer.setFrame(0)")

# By segment: five of them, from places that stand in the run.
page.js("const by = document.getElementById('rays_by'); by.value = 'depth'; by.dispatchEvent(new Event('change'))")
assert page.js("return wavetracer.rays.segments") == 5
centre = page.js("return wavetracer.meta.centre_m")
positions = page.js("return Array.from(wavetracer.rays.lines.geometry.attributes.position.array)")
points = [[round(positions[3 * i + axis] + centre[axis], 3) for axis in range(3)] for i in range(len(positions) // 3)]
assert points == [[0, 0, 10], [10, 0, 0], [10, 0, 0], [10, 10, 5], [10, 10, 5], [10, 10, 6],
                  [0, 0, 10], [20, 0, 0], [20, 0, 0], [20, 0, 1]], points
colours = page.js("return Array.from(wavetracer.rays.lines.geometry.attributes.color.array)")
first, second, last = colours[0:3], colours[6:9], colours[18:21]
assert first != second and first == last  # segments 1, 2 and 1 of the other ray
assert "Sampled rays: segment" in page.text("legend")

# Centroids by hand: (15, 0, 0) and (10, 10, 5); half of the first hits were answered, all of the second.
rows = page.text("centroids").splitlines()
assert rows[0].split() == ["Segment", "Hits", "Answered", "Centroid", "(m)", "Moved", "(m)"], rows
assert rows[1] == "1 2 50% 15.0, 0.0, 0.0", rows
assert rows[2] == "2 1 100% 10.0, 10.0, 5.0", rows
page.js("wavetracer.setFrame(1)")
rows = page.text("centroids").splitlines()
assert rows[1] == "1 2 50% 16.0, 0.0, 0.0 1.00" and rows[2] == "2 1 100% 11.0, 10.0, 5.0 1.00", rows

# By source: two colours, that of the cache for the second segment and the first of the other ray.
page.js("const by = document.getElementById('rays_by'); by.value = 'source'; by.dispatchEvent(new Event('change'))")
colours = page.js("return Array.from(wavetracer.rays.lines.geometry.attributes.color.array)")
of_segment = [colours[6 * i:6 * i + 3] for i in range(5)]
assert of_segment[0] == of_segment[2] == of_segment[4] and of_segment[1] == of_segment[3]
assert of_segment[0] != of_segment[1]
assert "answered by the cache" in page.text("legend")
page.screenshot("rays")
page.js("const by = document.getElementById('rays_by'); by.value = 'none'; by.dispatchEvent(new Event('change'))")
assert page.js("return wavetracer.rays.object.visible") is False and page.text("centroids") == ""
page.check_clean()

# A run without rays has no such part.
page = Page(folder, "single")
assert not page.find("rays").is_displayed()
page.check_clean()
