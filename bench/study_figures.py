# SPDX-License-Identifier: Apache-2.0
"""The two figures of docs/rays_studied.md: ray orders, and frames with ray caches, on an H200.

Their rows, bench/results/orders_h200.csv and caches_h200.csv, were read off the figures of 2026-11-21 and 2026-11-22,
whose tables were not kept; a position in them is 0.01 pixels, 0.03 % of a value, and they have three digits. To measure
anew, run `wavetracer thesis figure-6.1` and `figure-6.8` with `--device NVIDIA`, and write their times in this form.
"""
import csv
import shutil

import gnuplot_svg

# Block by block, the lines that are drawn together: at most eight can be told apart.
ORDERS = [("orders, in the shape of launch that each has", ["WS", "Z", "H3DH", "HZ", "H3DH2DH", "H3DH3DH", "direction-origin", "born ordered"]),
          ("launches in two and three dimensions", ["WS", "WS 2d", "WS 3d", "H3DH", "H3DH 2d", "H3DH 3d"])]
CACHES = [("", ["no cache", "no cache along hilbert", "readers uniform", "readers Morton", "readers mixed", "concurrent"])]
COLOURS = ["#000000", "#d55e00", "#0072b2", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#888888"]
HEAD_PX, BLOCK_PX = 35, 430


def read(path):
    """{series: [(rays, left value, right value)]}"""
    series = {}
    with open(path, newline="", encoding="utf-8") as file:
        for rays, name, left, right in list(csv.reader(file))[1:]:
            series.setdefault(name, []).append((float(rays), float(left), float(right)))
    return series


def draw(title, y, panels, blocks, series):
    """The SVG: a row of two panels for each block, with their titles above and one key below."""
    height = HEAD_PX + BLOCK_PX * len(blocks)
    points = [point for curve in series.values() for point in curve]
    lines = [f"set multiplot title '{title}' noenhanced", "set xlabel 'rays'"]
    lines += gnuplot_svg.log_axis("x", [rays for rays, *_ in points])
    lines += gnuplot_svg.log_axis("y", [value for _, *values in points for value in values])
    for i, (name, curve) in enumerate(series.items()):
        lines += [f"$c{i} << END"] + [" ".join(f"{number:g}" for number in point) for point in curve] + ["END"]
    place = {name: i for i, name in enumerate(series)}
    for block, (words, names) in enumerate(blocks):
        top, bottom = 1 - (HEAD_PX + 30 + BLOCK_PX * block) / height, 1 - (HEAD_PX + BLOCK_PX * (block + 1) - 105) / height
        for panel, what in enumerate(panels):
            lines += [f"set lmargin at screen {0.09 + 0.47 * panel:g}", f"set rmargin at screen {0.50 + 0.47 * panel:g}",
                      f"set bmargin at screen {bottom:.3f}", f"set tmargin at screen {top:.3f}",
                      f"set title '{what}{': ' if words else ''}{words}' noenhanced",
                      f"set ylabel '{y}'" if panel == 0 else "unset ylabel",
                      f"set key at screen 0.5, {bottom - 52 / height:.3f} center top vertical Left reverse maxrows 2 samplen 2 width 1" if panel else "unset key",
                      "plot " + ", ".join(f"$c{place[name]} using 1:{panel + 2} with linespoints lw 1.5 pt 7 ps 0.5 "
                                          f"lc rgb '{COLOURS[i]}' title '{name}' noenhanced" for i, name in enumerate(names))]
    return gnuplot_svg.svg(lines, f"860,{height}")


def drawn(results):
    """(name, SVG) of both figures. results: the folder of their rows. Without gnuplot there are none."""
    if not shutil.which("gnuplot"):
        return
    yield "orders_h200", draw("Ray orders and launch shapes, NVIDIA H200, 2026-11-21", "device time a ray (ns)",
                              ["sort not paid", "sort paid"], ORDERS, read(results / "orders_h200.csv"))
    yield "caches_h200", draw("Frames with the open table, NVIDIA H200, 2026-11-22", "seconds a frame",
                              ["table warm", "table empty before"], CACHES, read(results / "caches_h200.csv"))
