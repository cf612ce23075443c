#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws docs/figures/beam_tree.svg: the beams of an antenna in a street of a generated city, to depth 2.

    build/release/bench/beam_apertures > apertures.json
    python3 bench/figures/beam_tree.py apertures.json docs/figures/beam_tree.svg

It is a horizontal cut at the height of the antenna. Walls stand upright, so the images of the antenna in them are at the
same height, and the cut of a beam is what one image sees through one aperture. Needs numpy.
"""
import json
import sys

import numpy as np

PIXELS_PER_M = 3.4
BORDER_M = 8  # shown around what the antenna and its image see
MARGIN = 0
HEAD = 72  # pixels for the legend
FIRST, SECOND, OTHER = "#2b6cb0", "#c05621", "#9aa5b5"
FONT = "DejaVu Sans, Liberation Sans, Arial, sans-serif"


def cut(corners, height_m):
    """The two points where a polygon crosses a height; None if it does not."""
    points = []
    for a, b in zip(corners, np.roll(corners, -1, axis=0)):
        if (a[2] > height_m) != (b[2] > height_m):
            points.append(a[:2] + (height_m - a[2]) / (b[2] - a[2]) * (b[:2] - a[:2]))
    return np.array(points) if len(points) == 2 and np.hypot(*(points[1] - points[0])) > 0.02 else None


def mirrored(point, wall):
    """The image of a point in the plane of a facet."""
    normal, corner = np.array(wall["normal"]), np.array(wall["corners_m"][0])
    return point - 2 * normal.dot(point - corner) * normal


def crossing(image, towards, line):
    """The point where the ray from an image meets a line, given by two points."""
    d, e = towards - image, line[1] - line[0]
    t = np.linalg.solve(np.array([d, -e]).T, line[0] - image)[0]
    return image + t * d


class Drawing:
    def __init__(self, low, high):
        self.low, self.high, self.parts = low, high, []
        self.width, self.height = (PIXELS_PER_M * (high - low) + 2 * MARGIN).round()

    def pixels(self, points):
        return " ".join(f"{MARGIN + PIXELS_PER_M * (x - self.low[0]):.1f},"
                        f"{HEAD + MARGIN + PIXELS_PER_M * (self.high[1] - y):.1f}" for x, y in points)

    def polygon(self, points, style):
        self.parts.append(f'<polygon points="{self.pixels(points)}" {style}/>')

    def line(self, points, style):
        self.parts.append(f'<polyline points="{self.pixels(points)}" fill="none" {style}/>')

    def dot(self, point, style):
        x, y = self.pixels([point]).split(",")
        self.parts.append(f'<circle cx="{x}" cy="{y}" r="5" {style}/>')

    def text(self, x, y, words, style=""):
        self.parts.append(f'<text x="{x}" y="{y}" {style}>{words}</text>')

    def svg(self, title):
        width, height = int(self.width), int(self.height) + HEAD
        return "\n".join([
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" '
            f'font-family="{FONT}" font-size="13">', f"<title>{title}</title>",
            f'<rect width="{width}" height="{height}" fill="#ffffff"/>', *self.parts, "</svg>", ""])


def beams(run, height_m):
    """The cuts of apertures by depth: (their mirror, their image before it, segment), and for depth 2 the segment's
    place on the first mirror."""
    walls = {}
    for facet in run["facets"]:
        if abs(facet["normal"][2]) < 1e-6:
            walls.setdefault(facet["surface"], facet)
    first, second = [], []
    for one in run["apertures"]:
        segment = cut(np.array(one["corners_m"]), height_m) if one["surface"] in walls else None
        if segment is None:
            continue
        image = np.array(one["image_m"])
        before = mirrored(image, walls[one["surface"]])
        (first if one["depth"] == 1 else second).append((one["surface"], before, image, segment))
    chains = []
    for surface, before, _, segment in second:
        for mirror, _, image, on_mirror in first:
            if np.hypot(*(image - before)[:2]) < 1e-6 and abs(before[2] - height_m) < 1e-6:
                entry = [crossing(before[:2], p, on_mirror) for p in segment]
                along = on_mirror[1] - on_mirror[0]
                place = [(p - on_mirror[0]).dot(along) / along.dot(along) for p in entry]
                if -1e-6 <= min(place) and max(place) <= 1 + 1e-6:
                    chains.append((mirror, before, entry, segment))
                    break
    return first, chains


def main(source, target):
    with open(source, encoding="utf-8") as file:
        run = json.load(file)
    antenna = np.array(run["antenna_m"])
    first, chains = beams(run, antenna[2])
    roofs = [np.array(f["corners_m"]) for f in run["facets"] if f["normal"][2] > 0.2]
    roofs = [r[:, :2] for r in roofs if r[:, 2].min() > antenna[2] - 3 and r[:, 2].max() > antenna[2]]
    spread = {}
    for mirror, image, _, segment in chains:
        spread[mirror] = spread.get(mirror, 0) + np.hypot(*(segment[1] - segment[0]))
    chosen = max(spread, key=spread.get)  # the mirror of which most is seen
    lit = np.concatenate([antenna[None, :2], *(s for _, _, _, s in first), *(c[3] for c in chains if c[0] == chosen)])
    drawing = Drawing(lit.min(axis=0) - BORDER_M, lit.max(axis=0) + BORDER_M)
    roofs = [r for r in roofs if (r.max(axis=0) > drawing.low).all() and (r.min(axis=0) < drawing.high).all()]
    for _, _, _, segment in first:
        drawing.polygon([antenna[:2], *segment], f'fill="{FIRST}" fill-opacity="0.13"')
    for mirror, _, entry, segment in chains:
        if mirror == chosen:
            drawing.polygon([entry[0], entry[1], segment[1], segment[0]], f'fill="{SECOND}" fill-opacity="0.22"')
    for roof in roofs:
        drawing.polygon(roof, 'fill="#e6e3dc" stroke="#b6b0a3" stroke-width="0.6"')
    for mirror, _, _, segment in chains:
        if mirror != chosen:
            drawing.line(segment, f'stroke="{OTHER}" stroke-width="2"')
    for _, _, _, segment in first:
        drawing.line(segment, f'stroke="{FIRST}" stroke-width="3.5"')
    for mirror, _, _, segment in chains:
        if mirror == chosen:
            drawing.line(segment, f'stroke="{SECOND}" stroke-width="3.5"')
    image = next(image for mirror, image, _, _ in chains if mirror == chosen)
    for mirror, _, _, segment in first:
        if mirror == chosen:
            for end in segment:
                drawing.line([image[:2], end], f'stroke="{SECOND}" stroke-width="1" stroke-dasharray="5 4"')
    drawing.dot(image[:2], f'fill="#ffffff" stroke="{SECOND}" stroke-width="2"')
    drawing.dot(antenna[:2], f'fill="{FIRST}" stroke="#ffffff" stroke-width="1.5"')
    drawing.parts.append(f'<rect width="{int(drawing.width)}" height="{HEAD}" fill="#ffffff"/>')
    legend(drawing, len(first), len(chains))
    with open(target, "w", encoding="utf-8") as file:
        file.write(drawing.svg("Beams of an antenna in a street: what it sees, and what its image sees in one mirror"))


def legend(drawing, first, second):
    """first, second: numbers of apertures in the cut."""
    rows = [(FIRST, f"what the antenna sees: {first} apertures of depth 1"),
            (SECOND, "what its image sees through one of these mirrors (depth 2)"),
            (OTHER, f"the apertures of depth 2 through the other mirrors ({second} in all)")]
    for k, (colour, words) in enumerate(rows):
        y = 20 + 20 * k
        drawing.parts.append(f'<path d="M14 {y - 4}h26" stroke="{colour}" stroke-width="3.5"/>')
        drawing.text(48, y, words, 'fill="#22262c"')


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
