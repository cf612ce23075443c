# SPDX-License-Identifier: Apache-2.0
"""Colours of the page by numbers: CIEDE2000 differences as people see them who lack the cones for red or for green
(simulated after Machado, Oliveira and Fernandes, 2009), and contrasts with the background. Arguments: browser.py."""
import itertools
import sys

import numpy as np
from browser import Page

# Severity 1.0 of their table, for linear sRGB.
SIGHT = {
    "everyone": np.eye(3),
    "deuteranopes": [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
    "protanopes": [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
}


def linear(rgb):
    c = np.asarray(rgb, float) / 255
    return np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)


def lab(light):
    xyz = np.array([[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750],
                    [0.0193339, 0.1191920, 0.9503041]]) @ light / [0.95047, 1, 1.08883]
    f = np.where(xyz > (6 / 29) ** 3, np.cbrt(np.maximum(xyz, 0)), xyz / (3 * (6 / 29) ** 2) + 4 / 29)
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


def ciede2000(one, other):
    """Sharma, Wu and Dalal (2005)."""
    (l1, a1, b1), (l2, a2, b2) = one, other
    c = (np.hypot(a1, b1) + np.hypot(a2, b2)) / 2
    g = 0.5 * (1 - np.sqrt(c ** 7 / (c ** 7 + 25.0 ** 7)))
    a1, a2 = (1 + g) * a1, (1 + g) * a2
    c1, c2 = np.hypot(a1, b1), np.hypot(a2, b2)
    h1, h2 = np.degrees(np.arctan2(b1, a1)) % 360, np.degrees(np.arctan2(b2, a2)) % 360
    dh = 0 if c1 * c2 == 0 else (h2 - h1 + 180) % 360 - 180
    dl, dc, dhh = l2 - l1, c2 - c1, 2 * np.sqrt(c1 * c2) * np.sin(np.radians(dh / 2))
    l, c = (l1 + l2) / 2, (c1 + c2) / 2
    h = h1 + h2 if c1 * c2 == 0 else (h1 + dh / 2) % 360
    t = (1 - 0.17 * np.cos(np.radians(h - 30)) + 0.24 * np.cos(np.radians(2 * h))
         + 0.32 * np.cos(np.radians(3 * h + 6)) - 0.20 * np.cos(np.radians(4 * h - 63)))
    sl, sc, sh = 1 + 0.015 * (l - 50) ** 2 / np.sqrt(20 + (l - 50) ** 2), 1 + 0.045 * c, 1 + 0.015 * c * t
    rt = (-2 * np.sqrt(c ** 7 / (c ** 7 + 25.0 ** 7)) * np.sin(np.radians(60 * np.exp(-(((h - 275) / 25) ** 2)))))
    return np.sqrt((dl / sl) ** 2 + (dc / sc) ** 2 + (dhh / sh) ** 2 + rt * dc / sc * dhh / sh)


# Pairs of their test data.
for one, other, wanted in (((50, 2.6772, -79.7751), (50, 0, -82.7485), 2.0425), ((50, 2.5, 0), (73, 25, -18), 27.1492),
                           ((2.0776, 0.0795, -1.1350), (0.9033, -0.0636, -0.5514), 0.9082),
                           ((22.7233, 20.0904, -46.6940), (23.0331, 14.9730, -42.5619), 2.0373)):
    assert abs(ciede2000(one, other) - wanted) < 1e-4, (one, other, ciede2000(one, other), wanted)


def difference(one, other, sight):
    see = lambda rgb: lab(np.clip(np.array(SIGHT[sight]) @ linear(rgb), 0, 1))
    return ciede2000(see(one), see(other))


def contrast(one, other):
    y = sorted(np.array([0.2126729, 0.7151522, 0.0721750]) @ linear(rgb) for rgb in (one, other))
    return (y[1] + 0.05) / (y[0] + 0.05)


page = Page(sys.argv[1], "drive")
colours = {}
for scheme in ("light", "dark"):
    page.scheme(scheme)
    page.wait(scheme, lambda: page.js("return matchMedia('(prefers-color-scheme: ' + arguments[0] + ')').matches", scheme))
    colours[scheme] = page.js("""
      const orders = [1, 3, 5, 9].map((most) => { meta.highest_order = most; return order_colours(); });
      return {kinds: theme().kinds.map(rgb), los: theme().los.map(rgb), orders, ramp: ramp_table(), sky: rgb(theme().sky),
              vehicle: rgb(theme().vehicle), grounds: Materials.map(([, hex]) => rgb(hex).map((c) => c * theme().city_light))};
    """)
for scheme, seen in colours.items():
    print(f"palette, {scheme}:", end="")
    for sight in SIGHT:
        kinds = min(difference(a, b, sight) for a, b in itertools.combinations(seen["kinds"], 2))
        orders = min(difference(a, b, sight) for row in seen["orders"] for a, b in itertools.combinations(row, 2))
        los = difference(*seen["los"], sight)
        vehicle = min(difference(seen["vehicle"], c, sight) for c in seen["ramp"][:128])
        print(f" {sight}: kinds {kinds:.1f}, orders {orders:.1f}, map of line of sight {los:.1f}, "
              f"vehicles and weak paths {vehicle:.1f};", end="")
        assert kinds > 20 and orders > 5 and los > 20 and vehicle > 8, (scheme, sight, kinds, orders, los, vehicle)
    print(f" contrast of the strongest {contrast(seen['ramp'][-1], seen['sky']):.1f}")
    assert contrast(seen["ramp"][-1], seen["sky"]) > 7
    # The lightness of a scale goes one way, so that it keeps its order in grey.
    for sight in SIGHT:
        lightness = [lab(np.clip(np.array(SIGHT[sight]) @ linear(c), 0, 1))[0] for c in seen["ramp"]]
        steps = np.diff(lightness[::16])
        assert np.all(steps > 0) or np.all(steps < 0), (scheme, sight, steps)
page.check_clean()
