# SPDX-License-Identifier: Apache-2.0
"""Vegetation on the page: a crown can be looked through, hides no path, and can be switched off. Arguments: browser.py."""
import sys

import numpy as np
from browser import Page

folder = sys.argv[1]
page = Page(folder, "green", dark=False)
assert page.find("show_vegetation").is_displayed() and page.find("show_vegetation").is_selected()
assert "vegetation" in page.text("materials") and "deciduous_vegetation" in page.text("materials")
project = page.from_above()
x, y = project([-26, 2, 4])


def looks(vegetation, paths, name=None):
    page.check("show_vegetation", vegetation)
    page.check("show_paths", paths)
    if name:
        page.screenshot(name)
    return page.pixels(x, y, 12)


def greenness(pixels):
    return (pixels[..., 1] - (pixels[..., 0] + pixels[..., 2]) / 2).mean()


# The places of the street are greener now, and the street shines through in part.
page.check("show_labels", False)
bare, crown = looks(False, False), looks(True, False)
assert greenness(crown) > greenness(bare) + 5, (greenness(crown), greenness(bare))
far = page.pixels(*project([-26, -7, 0]), 3)
page.check("show_vegetation", False)
assert np.array_equal(far, page.pixels(*project([-26, -7, 0]), 3))  # beside it nothing changes

# The paths in front of the vegetation and in it must be as visible as without it, whether or not houses hide them.
for hidden in (True, False):
    page.check("show_hidden", hidden)
    drawn = [np.abs(looks(v, True, f"vegetation_{v}") - looks(v, False)).max(axis=2) > 20 for v in (True, False)]
    assert drawn[1].sum() > 20, drawn[1].sum()
    assert np.mean(drawn[0][drawn[1]]) > 0.9, (hidden, np.mean(drawn[0][drawn[1]]))
page.find("home").click()
looks(True, True, "vegetation")
page.check_clean()

page = Page(folder, "drive")
assert not page.find("show_vegetation").is_displayed()
page.check_clean()
