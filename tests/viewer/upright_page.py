# SPDX-License-Identifier: Apache-2.0
"""A map on a vertical plane: cells are where their receivers are, a click on one chooses it, and colours are those of its
path gain. Arguments: browser.py."""
import sys

import numpy as np
from browser import Page

page = Page(sys.argv[1], "upright", dark=False)
for what in ("city", "labels", "paths", "streets"):
    page.check(f"show_{what}", False)
positions = page.file["frames/receiver_position_m"][0] - page.js("return wavetracer.meta.centre_m")
# Looks at the middle of the plane from its front, as the pinhole camera of the page does.
page.js("""
const {orbit} = wavetracer, [x, y, z] = arguments[0];
orbit.target.set(x, y, z); orbit.distance = 25; orbit.apply(); orbit.camera.updateMatrixWorld(); wavetracer.draw();
""", positions[1:].mean(axis=0).tolist())


def at(point):
    """The pixel of a point of the scene, by the matrices of the camera."""
    world, lens = (np.array(matrix).reshape(4, 4).T for matrix in page.js(
        "const {camera} = wavetracer.orbit; return [camera.matrixWorldInverse.elements, camera.projectionMatrix.elements]"))
    x, y, _, w = lens @ world @ np.append(point, 1)
    size = page.find("world").size
    return np.array([(1 + x / w) * size["width"] / 2, (1 - y / w) * size["height"] / 2])


def probed(point):
    return page.js("return wavetracer.coverage.probe(wavetracer.orbit.raycaster(...arguments), false)", *at(point))


along, up = np.array([.6, .8, 0]), np.array([0, 0, 1])
for ix, iy in ((0, 0), (11, 0), (0, 8), (11, 8), (5, 3), (7, 6)):
    rx = 1 + 12 * iy + ix
    for u, v in ((0, 0), (.45, .45), (-.45, .45), (.45, -.45), (-.45, -.45)):
        assert probed(positions[rx] + u * along + v * up) == rx, (ix, iy, u, v)
assert probed(positions[1] - .6 * up) == probed(positions[-1] + .6 * up) == probed(positions[1] - .6 * along) == -1

# Columns 2, 5, 8 ... have no path, so they have no colour; others have that of their gain.
legend = np.array(page.js("const c = document.querySelector('#legend canvas');"
                          "return Array.from(c.getContext('2d').getImageData(0, 0, c.width, 1).data)"), float)
legend = legend.reshape(-1, 4)[:, :3]
low, high = page.js("return range_of('gain')")
paths = page.file["paths"]
power = np.zeros((2, len(positions)))
np.add.at(power, (paths["tx"][...], paths["rx"][...]), 10 ** (paths["gain_db"][...] / 10))
sky = page.pixels(3, 3, 0)[0, 0]
for ix, iy in ((0, 8), (3, 1), (4, 5), (9, 8)):
    rx = 1 + 12 * iy + ix
    share = np.clip((10 * np.log10(power[:, rx].max()) - low) / (high - low), 0, 1)
    seen = page.pixels(*(at(positions[rx]) - .5), 0)[0, 0]
    assert np.linalg.norm(seen - legend[int(round(share * 219))]) < 12, (ix, iy, seen, share)
assert np.allclose(page.pixels(*(at(positions[1 + 12 * 4 + 5]) - .5), 0)[0, 0], sky)
page.click(*at(positions[1 + 12 * 5 + 4]))
assert page.text("details").startswith("map/4,5"), page.text("details")
page.screenshot("upright")
page.check_clean()
