#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws a scene from above with the paths of a paths.h5, coloured by their gain, as SVG or PNG.

    docs/draw_paths.py SCENE.xml out/paths.h5 -o picture.png
    docs/draw_paths.py munich.xml out/paths.h5 -o munich.png --attribution "(c) OpenStreetMap contributors (ODbL)"

    wavetracer scene info --edges SCENE.xml > edges.txt     and then --edges edges.txt: the edges that diffract, too

Needs numpy and h5py; PNG also needs rsvg-convert (Debian: python3-h5py, librsvg2-bin).
Reads Mitsuba XML scenes of PLY meshes (ascii or binary little endian), as Sionna RT and `wavetracer scene city` write
them, with z up. Roofs are areas, the taller the brighter; walls, seen from above, are the outlines. Points of
diffraction, of transmission, centres of scattering tiles and points of targets have marks of their own.
"""
import argparse
import math
import shutil
import subprocess
import sys
from xml.sax.saxutils import escape

import h5py
import numpy as np

from read_scene import read_edges, read_scene

FONT = "DejaVu Sans, Liberation Sans, Arial, sans-serif"
# Colour stops of paths run from weak to strong: those of matplotlib's plasma map (CC0), the visible part of it.
PLASMA = ["#0d0887", "#46039f", "#7201a8", "#9c179e", "#bd3786", "#d8576b", "#ed7953", "#fb9f3a", "#fdca26", "#f0f921"]
THEMES = {
    "dark": dict(ground="#11151c", low="#1f2630", high="#3a4556", wall="#566377", text="#e8ecf2", faint="#9aa5b5",
                 halo="#11151c", tx="#ff5d73", rx="#5ad1ff", diffraction="#3ee08f", transmission="#ffffff",
                 scattering="#8fb4d8", target="#e8825a", stops=PLASMA[2:]),
    "light": dict(ground="#f7f6f3", low="#e6e3dc", high="#c3beb2", wall="#8d877a", text="#22262c", faint="#5f666f",
                  halo="#ffffff", tx="#d4213d", rx="#0b6fa8", diffraction="#00804a", transmission="#000000",
                  scattering="#4a78a8", target="#b8502a", stops=PLASMA[:-1][::-1]),
}
# Values of /vertices/interaction. Each except reflection has a mark: an outline about the point, filled or as lines.
REFLECTION = 1
MARKS = {8: ("diffraction", "m0,-5l5,5l-5,5l-5,-5z", True),
         4: ("transmission", "m-3.5,-3.5l7,7m0,-7l-7,7", False),
         2: ("scattering", "m-2.6,-2.6h5.2v5.2h-5.2z", True),
         16: ("target", "m-3.5,2.6h7l-3.5,-6z", True)}


# ---- paths ----------------------------------------------------------------------------------------------------------

def read_paths(path, frame, tx_names, rx_names):
    """The ends and the paths (gain_db, points (k, 3), interactions) of one frame, strongest last."""
    with h5py.File(path, "r") as file:
        row = np.nonzero(file["frames/frame"][...] == frame)[0]
        if len(row) == 0:
            sys.exit(f"{path}: there is no frame {frame} in it")
        ends = {}
        for kind, wanted in (("transmitters", tx_names), ("receivers", rx_names)):
            names = [n.decode() if isinstance(n, bytes) else n for n in file[kind]["name"][...]]
            unknown = set(wanted or []) - set(names)
            if unknown:
                sys.exit(f"{path}: there is no {', '.join(sorted(unknown))} among its {kind}: {', '.join(names)}")
            position = file["frames"][kind[:-1] + "_position_m"][row[0]]  # NaN: absent
            ends[kind] = {i: (name, position[i]) for i, name in enumerate(names)
                          if (not wanted or name in wanted) and np.isfinite(position[i]).all()}
        column = {name: file["paths"][name][...] for name in ("frame", "tx", "rx", "gain_db", "vertex_offset")}
        position, interaction = file["vertices/position_m"][...], file["vertices/interaction"][...]
        frequency_hz = float(np.ravel(file.attrs["frequency_hz"])[0]) if "frequency_hz" in file.attrs else None
    rows = []
    for i in np.nonzero(column["frame"] == frame)[0]:
        tx, rx = ends["transmitters"].get(column["tx"][i]), ends["receivers"].get(column["rx"][i])
        if tx and rx and np.isfinite(column["gain_db"][i]):
            part = slice(int(column["vertex_offset"][i]), int(column["vertex_offset"][i + 1]))
            points = np.vstack([tx[1], position[part], rx[1]])
            rows.append((float(column["gain_db"][i]), points, interaction[part]))
    rows.sort(key=lambda row: row[0])
    return ends, rows, frequency_hz


# ---- drawing --------------------------------------------------------------------------------------------------------

def mix(a, b, t):
    """The colour between #a and #b."""
    parts = [(int(a[i:i + 2], 16), int(b[i:i + 2], 16)) for i in (1, 3, 5)]
    return "#" + "".join(f"{round(p + (q - p) * t):02x}" for p, q in parts)


def colour(stops, t):
    t = min(max(t, 0.0), 1.0) * (len(stops) - 1)
    i = min(int(t), len(stops) - 2)
    return mix(stops[i], stops[i + 1], t - i)


class View:
    """Turns metres into pixels: x to the right, y up."""

    def __init__(self, window, width):
        self.x0, self.y0, self.x1, self.y1 = window
        self.width, self.scale = width, width / (self.x1 - self.x0)
        self.height = round((self.y1 - self.y0) * self.scale)

    def __call__(self, points):
        points = np.asarray(points, dtype=float)
        return np.stack([(points[..., 0] - self.x0) * self.scale, (self.y1 - points[..., 1]) * self.scale], axis=-1)

    def sees(self, triangles):
        """A flag for each triangle (n, 3, 3): its bounding box meets the window."""
        low, high = triangles.min(axis=1), triangles.max(axis=1)
        return (high[:, 0] > self.x0) & (low[:, 0] < self.x1) & (high[:, 1] > self.y0) & (low[:, 1] < self.y1)


def fit_window(points, aspect, margin):
    """The smallest window of the aspect (width / height) around the points, with a margin (share of its size)."""
    low, high = points.min(axis=0)[:2], points.max(axis=0)[:2]
    centre, size = (low + high) / 2, np.maximum(high - low, 1.0) * (1 + 2 * margin)
    size = np.maximum(size, [size[1] * aspect, size[0] / aspect])
    return (*(centre - size / 2), *(centre + size / 2))


def text(x, y, words, theme, size=15, anchor="start", fill="text", weight="normal"):
    """A label with a halo, so that it reads on any ground."""
    return (f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" text-anchor="{anchor}" font-weight="{weight}" '
            f'fill="{theme[fill]}" stroke="{theme["halo"]}" stroke-width="3.5" stroke-linejoin="round" '
            f'paint-order="stroke">{escape(words)}</text>')


def draw_buildings(view, triangles, theme):
    triangles = triangles[view.sees(triangles)]
    if not len(triangles):
        return []
    normal = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    length = np.linalg.norm(normal, axis=1)
    steep = np.abs(normal[:, 2]) < 0.05 * length
    height = triangles[:, :, 2].max(axis=1)
    base, top = height.min(), np.percentile(height, 98)
    roofs = np.nonzero(~steep & (length > 0) & (height > base + 0.5))[0]  # the ground itself is the background
    out, steps = [], 12
    level = np.clip(np.ceil((height - base) / max(top - base, 1e-9) * steps), 1, steps).astype(int)
    for k in range(1, steps + 1):
        shape = "".join("M" + "L".join(f"{x:.1f},{y:.1f}" for x, y in view(triangles[i])) + "Z"
                        for i in roofs[level[roofs] == k])
        if shape:
            fill = mix(theme["low"], theme["high"], k / steps)
            out.append(f'<path d="{shape}" fill="{fill}" stroke="{fill}" stroke-width="0.7" stroke-linejoin="round"/>')
    # A wall from above is a line: the longest side of its triangle's projection. Each line is drawn once.
    lines = set()
    for corners in np.round(view(triangles[steep]), 1):
        a, b, c = map(tuple, corners)
        lines.add(tuple(sorted(max(((a, b), (b, c), (c, a)), key=lambda side: math.dist(*side)))))
    shape = "".join(f"M{a[0]:.1f},{a[1]:.1f}L{b[0]:.1f},{b[1]:.1f}" for a, b in sorted(lines) if a != b)
    return out + [f'<path d="{shape}" fill="none" stroke="{theme["wall"]}" stroke-width="1" stroke-linecap="round"/>']


def draw_edges(view, edges, theme):
    """Draws edges as lines; upright ones are dots from above. Each is drawn once."""
    near = (edges.max(axis=1)[:, :2] > [view.x0, view.y0]) & (edges.min(axis=1)[:, :2] < [view.x1, view.y1])
    lines = {tuple(np.round(ends, 1).ravel()) for ends in view(edges[near.all(axis=1)])}
    shape = "".join(f"M{x0:.1f},{y0:.1f}L{x1:.1f},{y1:.1f}" for x0, y0, x1, y1 in sorted(lines))
    return [f'<path class="edges" d="{shape}" fill="none" stroke="{theme["diffraction"]}" stroke-width="1.2" '
            f'stroke-opacity="0.5" stroke-linecap="round"/>']


def mark(kind, places, theme, opacity=1.0):
    """The mark of an interaction, at all its places in pixels."""
    name, outline, filled = MARKS[kind]
    shape = "".join(f"M{x:.1f},{y:.1f}{outline}" for x, y in places)
    ink = (f'fill="{theme[name]}" stroke="{theme["halo"]}" stroke-width="0.7"' if filled else
           f'fill="none" stroke="{theme[name]}" stroke-width="1.6" stroke-linecap="round"')
    return f'<path class="{name}" d="{shape}" {ink} opacity="{opacity:.2f}"/>'


def draw_paths(view, rows, low_db, high_db, theme):
    """Draws lines, points of reflection in their colour, and above all lines the other marks, each place once."""
    out, places = [], {kind: {} for kind in MARKS}
    crowd = min(1.0, (150 / max(len(rows), 1)) ** 0.35)  # many paths are drawn fainter: the strong ones stand out
    for gain_db, points, interactions in rows:
        t = min(max((gain_db - low_db) / (high_db - low_db), 0.0), 1.0)
        line, fill = " ".join(f"{x:.1f},{y:.1f}" for x, y in view(points)), colour(theme["stops"], t)
        opacity = 0.35 * crowd + (0.95 - 0.35 * crowd) * t ** (1 / crowd)
        out.append(f'<polyline points="{line}" fill="none" stroke="{fill}" stroke-width="{0.8 + 1.6 * t:.2f}" '
                   f'stroke-opacity="{opacity:.2f}" stroke-linejoin="round"/>')
        for (x, y), kind in zip(view(points[1:-1]), interactions):
            if kind == REFLECTION:
                out.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="1.8" fill="{fill}" '
                           f'fill-opacity="{crowd * (0.5 + 0.5 * t):.2f}"/>')
            else:
                places[kind][round(x, 1), round(y, 1)] = None
    return out + [mark(kind, found, theme, 0.4 + 0.6 * crowd) for kind, found in places.items() if found]


def draw_ends(view, ends, theme, labels):
    """Draws markers, then labels, each at the first of the eight places around its marker where it covers the least."""
    marks = [(kind, name, *view(position)) for kind in ("receivers", "transmitters")
             for name, position in ends[kind].values()]
    out, taken = [], [(x - 8, y - 8, x + 8, y + 8) for _, _, x, y in marks]
    for kind, _, x, y in marks:
        shape, fill = ((f'circle cx="{x:.1f}" cy="{y:.1f}" r="5.5"', theme["rx"]) if kind == "receivers" else
                       (f'path d="M{x:.1f},{y - 11:.1f}l10,18h-20z"', theme["tx"]))
        out.append(f'<{shape} fill="{fill}" stroke="{theme["halo"]}" stroke-width="2"/>')
    for kind, name, x, y in reversed(marks):
        if labels == "none" or (labels == "tx" and kind == "receivers"):
            continue
        size = 18 if kind == "transmitters" else 14
        w, h, places = 0.62 * size * len(name), size, []
        for dx, dy in ((1, 0), (1, -1), (1, 1), (-1, 0), (-1, -1), (-1, 1), (0, -1), (0, 1)):
            left = x + dx * 13 - (0 if dx > 0 else w if dx < 0 else w / 2)
            box = (left, y + dy * 17 - h / 2, left + w, y + dy * 17 + h / 2)
            covered = sum(max(0, min(box[2], b[2]) - max(box[0], b[0])) *
                          max(0, min(box[3], b[3]) - max(box[1], b[1])) for b in taken)
            outside = box[0] < 4 or box[2] > view.width - 4 or box[1] < 4 or box[3] > view.height - 4
            places.append((covered + 1e6 * outside, len(places), box))
        box = min(places)[2]
        taken.append(box)
        weight = "bold" if kind == "transmitters" else "normal"
        out.append(text(box[0], box[3] - 0.2 * h, name, theme, size, weight=weight))
    return out


def draw_legend(kinds, edges, theme, x, y):
    """Draws a row that explains the marks in the picture; kinds: the interactions that were drawn."""
    entries = [(MARKS[kind][0], mark(kind, [(x, y)], theme)) for kind in MARKS if kind in kinds]
    if edges:
        entries.append(("edge that diffracts", f'<path d="M{x - 7},{y}h14" stroke="{theme["diffraction"]}" '
                                               'stroke-width="1.2" stroke-opacity="0.7"/>'))
    out, right = [], 0
    for name, shape in entries:
        out.append(f'<g class="legend" transform="translate({right},0)">{shape}'
                   f'{text(x + 13, y + 5, name, theme, 14, fill="faint")}</g>')
        right += 9 * len(name) + 30
    return out


def draw_frame(view, theme, low_db, high_db, title, caption, attribution, kinds, edges):
    """Draws title, caption, legend, colour bar, scale bar and attribution on top of the picture, in its corners."""
    out, w, h = [], view.width, view.height
    if title:
        out.append(text(24, 40, title, theme, 24, weight="bold"))
    y = 66 if title else 36
    out += [text(24, y, caption, theme, 15, fill="faint"), *draw_legend(kinds, edges, theme, 31, y + 24)]
    bar, x, y = 260, w - 24 - 260, h - 52
    stops = "".join(f'<stop offset="{i / 20:.2f}" stop-color="{colour(theme["stops"], i / 20)}"/>' for i in range(21))
    out.append(f'<defs><linearGradient id="gain">{stops}</linearGradient></defs>'
               f'<rect x="{x}" y="{y}" width="{bar}" height="12" rx="2" fill="url(#gain)" stroke="{theme["halo"]}"/>')
    out.append(text(x + bar, y - 10, "path gain, dB", theme, 14, "end"))
    step = next(s for s in (1, 2, 5, 10, 20, 50, 100) if (high_db - low_db) / s <= 7)
    for db in range(math.ceil(low_db / step) * step, math.floor(high_db) + 1, step):
        out.append(text(x + bar * (db - low_db) / (high_db - low_db), y + 30, str(db), theme, 13, "middle"))
    metres = 180 / view.scale
    power = 10 ** math.floor(math.log10(metres))
    metres = max(m * power for m in (1, 2, 5) if m * power <= metres)
    out.append(f'<path d="M24,{h - 46}v8h{metres * view.scale:.1f}v-8" fill="none" stroke="{theme["text"]}" '
               f'stroke-width="2"/>')
    out.append(text(24 + metres * view.scale / 2, h - 50, f"{metres:g} m", theme, 14, "middle"))
    if attribution:
        out.append(text(24, h - 14, attribution, theme, 12, fill="faint"))
    return out


def draw(options):
    """The whole picture as SVG text."""
    theme = THEMES[options.theme]
    ends, rows, frequency_hz = read_paths(options.paths, options.frame, options.tx, options.rx)
    found = len(rows)
    rows = rows[-options.max_paths:]
    positions = [p for kind in ends.values() for _, p in kind.values()]
    if not positions:
        sys.exit(f"{options.paths}: no transmitter and no receiver to draw")
    points = np.vstack([np.array(positions)] + [row[1] for row in rows])
    view = View(options.window or fit_window(points, options.aspect, 0.08), options.width)
    high_db = 5 * math.ceil((rows[-1][0] if rows else -60) / 5)
    low_db = max(high_db - options.range_db, 5 * math.floor(rows[0][0] / 5) if rows else -math.inf)
    low_db = min(low_db, high_db - 5)
    caption = " \u00b7 ".join(
        [f"{found} paths" if found == len(rows) else f"the {len(rows)} strongest of {found} paths"]
        + [f"{len(ends[kind])} {kind if len(ends[kind]) != 1 else kind[:-1]}" for kind in ("transmitters", "receivers")]
        + ([f"{frequency_hz / 1e9:g} GHz"] if frequency_hz else []))
    body = [f'<rect width="{view.width}" height="{view.height}" fill="{theme["ground"]}"/>',
            *draw_buildings(view, read_scene(options.scene), theme),
            *(draw_edges(view, read_edges(options.edges), theme) if options.edges else []),
            *draw_paths(view, rows, low_db, high_db, theme),
            *draw_ends(view, ends, theme, options.labels),
            *draw_frame(view, theme, low_db, high_db, options.title, caption, options.attribution,
                        {kind for row in rows for kind in row[2]}, bool(options.edges))]
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{view.width}" height="{view.height}" '
            f'viewBox="0 0 {view.width} {view.height}" font-family="{FONT}">\n' + "\n".join(body) + "\n</svg>\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", help="Mitsuba XML file of the scene")
    parser.add_argument("paths", help="paths.h5 of a run")
    parser.add_argument("-o", "--output", required=True, help="picture to write, .svg or .png")
    parser.add_argument("--edges", metavar="FILE", help="what `wavetracer scene info --edges SCENE` printed, to draw")
    parser.add_argument("--frame", type=int, default=0, help="frame to draw (default 0)")
    parser.add_argument("--tx", nargs="+", metavar="NAME", help="only these transmitters")
    parser.add_argument("--rx", nargs="+", metavar="NAME", help="only these receivers")
    parser.add_argument("--max-paths", type=int, default=5000, help="draw only the strongest (default 5000)")
    parser.add_argument("--range-db", type=float, default=60, help="colours span at most so many dB (default 60)")
    parser.add_argument("--window", type=float, nargs=4, metavar=("X0", "Y0", "X1", "Y1"),
                        help="part of the scene to show, metres (default: around the paths)")
    parser.add_argument("--width", type=int, default=1600, help="pixels (default 1600)")
    parser.add_argument("--aspect", type=float, default=1.6, help="width / height without --window (default 1.6)")
    parser.add_argument("--theme", choices=THEMES, default="dark")
    parser.add_argument("--labels", choices=["all", "tx", "none"], default="all", help="which ends get their name")
    parser.add_argument("--title", default="", help="a line in the upper left corner")
    parser.add_argument("--attribution", default="", help="a line in the lower left corner, as the data asks for")
    options = parser.parse_args()
    svg = draw(options)
    if not options.output.endswith(".png"):
        open(options.output, "w", encoding="utf-8").write(svg)
    elif shutil.which("rsvg-convert"):
        subprocess.run(["rsvg-convert", "-o", options.output], input=svg.encode(), check=True)
    else:
        sys.exit("rsvg-convert is missing: install it (Debian: librsvg2-bin) or write an .svg")


if __name__ == "__main__":
    main()
