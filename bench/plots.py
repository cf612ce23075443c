# SPDX-License-Identifier: Apache-2.0
"""The three plots of RESULTS.md, of the newest rows of bench/results. A curve whose rows are gone is left out."""
import re
import shutil
import statistics

import gnuplot_svg
import speed


def cases_of(groups, bench, device):
    """{case: result} of the newest device whose name begins so."""
    found = [cases for (b, d), cases in groups.items() if b == bench and d.startswith(device)]
    return max(found, key=lambda cases: max(r["date"] for r in cases.values()), default={})


def matches(cases, pattern):
    for case, result in cases.items():
        if match := re.fullmatch(pattern, case):
            yield match, result


def recall_curves(groups):
    """Share of paths lost against rays, the median and the worst of all cases of bench_recall."""
    curves = {}
    for launch in ("hilbert", "horizon"):
        lost = {}
        for match, result in matches(cases_of(groups, "recall", speed.H200), rf"(\S+), {launch}, (\S+) rays"):
            lost.setdefault(float(match[2]), []).append(result["error"])
        name = {"hilbert": "evenly spread", "horizon": "towards the horizon"}[launch]
        curves[f"{name}, median case"] = [(n, statistics.median(e)) for n, e in sorted(lost.items())]
        curves[f"{name}, worst case"] = [(n, max(e)) for n, e in sorted(lost.items())]
    return curves


def newest_day(points):
    """(day, points) of the newest day: times of different days were measured beside different loads."""
    day = max(day for day, *_ in points)
    return day, sorted(point[1:] for point in points if point[0] == day)


def receiver_curves(groups):
    """Seconds per frame against links, ours and the peer's as bench_paths names it. Each curve is of one day."""
    curves = {}
    for name, device in (("H200", speed.H200), ("two cores", speed.CPU)):
        for match, result in matches(cases_of(groups, "paths", device),
                                     r"munich, (\d+)x(\d+) links, 1e\+06 rays per transmitter"):
            links, day = int(match[1]) * int(match[2]), result["date"][:10]
            curves.setdefault(f"wavetracer, {name}", []).append((day, links, result["value"]))
            if result["baseline_value"] and "1e+07 rays" not in result["baseline"]:  # as many rays as ours
                measured = re.search(r"\d{4}-\d\d-\d\d", result["baseline"])
                curves.setdefault(f"Sionna RT, {name}", []).append((measured[0] if measured else day, links, result["baseline_value"]))
    days = {name: newest_day(points) for name, points in curves.items()}
    return {f"{name}, {day}": points for name, (day, points) in days.items()}


def vehicle_curves(groups):
    """Frames per second against vehicles, depth 3, sequences reused."""
    curves = {}
    for name, device in (("H200", speed.H200), ("two cores", speed.CPU)):
        for match, result in matches(cases_of(groups, "drive", device), r"munich, (\d+) vehicles, depth 3: reuse, auto rays"):
            curves.setdefault(name, []).append((int(match[1]), 1 / result["value"]))
    return {name: sorted(points) for name, points in curves.items()}


PLOTS = [
    ("recall", "Reflected paths in streets, a roof and a canyon: what rays miss", "rays per transmitter", "share of paths lost",
     recall_curves),
    ("receivers", "One frame in Munich, 10^6 rays per transmitter, five reflections", "links", "seconds per frame", receiver_curves),
    ("vehicles", "A drive in Munich: all links among the vehicles, three reflections", "vehicles", "frames per second",
     vehicle_curves),
]


NOTHING = 1e-4  # a share of 0 stands at the foot of the plot, where this is


def draw(title, x, y, curves):
    """The SVG of a plot with logarithmic axes, by gnuplot."""
    drawn = {name: [(px, max(py, NOTHING)) for px, py in points] for name, points in curves.items() if points}
    points = [point for curve in drawn.values() for point in curve]
    lines = [f"set title '{title}'", f"set xlabel '{x}'", f"set ylabel '{y}'", "set key outside right top Left reverse"]
    lines += gnuplot_svg.log_axis("x", [px for px, _ in points]) + gnuplot_svg.log_axis("y", [py for _, py in points])
    if y.startswith("share"):
        lines.append(f"set ytics add ('0' {NOTHING:g})")
    for i, curve in enumerate(drawn.values()):
        lines += [f"$c{i} << END"] + [f"{px:g} {py:.6g}" for px, py in curve] + ["END"]
    lines.append("plot " + ", ".join(f"$c{i} with linespoints lw 2 pt {i + 4} title '{name}'" for i, name in enumerate(drawn)))
    return gnuplot_svg.svg(lines, "860,440")


def drawn(groups):
    """(name, SVG) of each plot. Without gnuplot there are none, so the files are left as they are."""
    if not shutil.which("gnuplot"):
        return
    for name, title, x, y, curves_of in PLOTS:
        yield name, draw(title, x, y, curves_of(groups))
