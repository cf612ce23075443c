# SPDX-License-Identifier: Apache-2.0
"""The two figures of docs/rays_studied.md: ray orders, and frames with ray caches, on an H200.

Usage: study_figures.py FOLDER, the folder of `wavetracer thesis figure-6.1 figure-6.8 --device NVIDIA -o FOLDER`, writes
their rows, bench/results/orders_h200.csv and caches_h200.csv; report.py draws them. Where an order
has several sizes of histograms, the size counts whose device time is the least with its sort.
"""
import argparse
import csv
import pathlib
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
            lines += [f"set lmargin at screen {0.09 + 0.47 * panel:g}", f"set rmargin at screen {0.48 + 0.49 * panel:g}",
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
    yield "orders_h200", draw("Ray orders and launch shapes, NVIDIA H200, 2026-11-30", "device time a ray (ns)",
                              ["sort not paid", "sort paid"], ORDERS, read(results / "orders_h200.csv"))
    yield "caches_h200", draw("Frames with the open table, NVIDIA H200, 2026-11-30", "seconds a frame",
                              ["table warm", "table empty before"], CACHES, read(results / "caches_h200.csv"))


def table(folder, figure):
    with open(folder / f"{figure}.csv", newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def write(path, heads, series):
    """series: {(name, rays): (left value, right value)}"""
    with open(path, "w", newline="", encoding="utf-8") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(heads)
        for (name, rays), (left, right) in series.items():
            out.writerow([rays, name, f"{left:.4g}", f"{right:.4g}"])


def write_orders(folder, results):
    """Device times a ray in nanoseconds."""
    wanted = {name for _, names in ORDERS for name in names}
    series = {}
    for row in table(folder, "figure-6.1"):
        rays, name = int(row["rays"]), row["mnemonic"]
        own_shape = "2DH" in name or name == "H3DH3DH"
        if not own_shape and row["shape"] != "1d":
            name = f"{name} {row['shape']}"
        times = tuple(1e9 * float(row[column]) / rays for column in ("unpaid_s", "paid_s"))
        if name in wanted and times[1] <= series.get((name, rays), times)[1]:
            series[name, rays] = times
    write(results / "orders_h200.csv", ["rays", "series", "unpaid_ns", "paid_ns"], dict(sorted(series.items())))


def write_caches(folder, results):
    """Device times of a frame in seconds."""
    wanted = {name for _, names in CACHES for name in names}
    series = {(row["setting"], int(row["rays"])): (float(row["warm_s"]), float(row["cold_s"]))
              for row in table(folder, "figure-6.8") if row["setting"] in wanted}
    write(results / "caches_h200.csv", ["rays", "series", "warm_s", "empty_s"], series)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("folder", type=pathlib.Path, help="results of wavetracer thesis")
    folder = parser.parse_args().folder
    results = pathlib.Path(__file__).resolve().parent / "results"
    write_orders(folder, results)
    write_caches(folder, results)


if __name__ == "__main__":
    main()
