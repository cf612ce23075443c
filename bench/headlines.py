"""Writes the first page of RESULTS.md: the figures that most readers look for, and three plots.

The text of a figure is in this file; its number, peer, error, device and date are those of the newest line in
bench/results. If there is no such line, the figure is left out, so every number on the page was printed by a benchmark.
"""
import re
import statistics
import subprocess

GPU, CPU = "NVIDIA H200", "pthread"

# Each row has the text of the figure, the benchmark, the beginning of the device's name, and the case.
HEADLINES = [
    ("One link in Munich, five reflections", "paths", GPU, "munich, 1x1 links, 1e+05 rays per transmitter, error against 3e+07"),
    ("The same on two cores", "paths", CPU, "munich, 1x1 links, 1e+05 rays per transmitter, error against 3e+07"),
    ("100 receivers", "paths", GPU, "munich, 1x100 links, 1e+05 rays per transmitter, error against 3e+07"),
    ("The same on two cores", "paths", CPU, "munich, 1x100 links, 1e+05 rays per transmitter, error against 3e+07"),
    ("10 transmitters, 100 receivers", "paths", GPU, "munich, 10x100 links, 1e+05 rays per transmitter, error against 3e+07"),
    ("The same with few rays", "paths", GPU, "munich, 10x100 links, 1e+04 rays per transmitter, error against 3e+07"),
    ("100 receivers with diffraction, two cores", "paths", CPU,
     "munich, 1x100 links, 1e+05 rays per transmitter, diffraction, 1e+05 rays per receiver, error against 3e+07"),
    ("10 links among 100 moving cars", "drive", GPU, "munich, 100 moving cars, 1 x 10 links: reuse, 1e+06 rays"),
    ("1,000 links among 100 moving cars", "drive", GPU, "munich, 100 moving cars, 10 x 100 links: reuse, 1e+06 rays"),
    ("All links among 100 vehicles, three reflections", "drive", GPU, "munich, 100 vehicles, depth 3: reuse, 1e+06 rays, 1e+04 anew"),
    ("The same on two cores", "drive", CPU, "munich, 100 vehicles, depth 3: reuse, 1e+05 rays, 1e+04 anew"),
    ("From a pose to the channel, 100 vehicles", "live", GPU, "city, 100 vehicles, 100000 rays, 3000 anew"),
    ("A coverage map of 22,500 receivers", "coverage", GPU,
     "munich, 22500 receivers, 1e+06 rays, depth 3, error against 10 times the rays"),
    ("The same on two cores", "coverage", CPU,
     "munich, 22500 receivers, 1e+06 rays, depth 3, error against 10 times the rays (2)"),
    ("Nearest hits, rays in order", "trace", GPU, "munich, 16000000 rays, hilbert: bvh2"),
    ("The same on two cores", "trace", CPU, "munich, 1000000 rays, hilbert: packet16"),
    ("Sorting 2^26 keys of 32 bits, as a permutation", "sort", GPU, "u32 to permutation, n = 2^26: radix, against the fastest peer"),
    ("2^24 keys on two cores", "sort", CPU, "u32 to permutation, n = 2^24: radix, against the fastest peer"),
    ("Directions in order instead of at random", "order", GPU, "munich, 16777216 rays: born in order"),
    ("A start with compiled kernels at hand", "start", CPU, "second start, programs cached"),
]
WORDS = {"s per frame": ("ms per frame", 1e3), "s from pose to channel": ("ms from pose to channel", 1e3), "s": ("ms", 1e3)}


def short(value):
    if value is None:
        return ""
    return f"{value:,.0f}" if abs(value) >= 100 else f"{value:.3g}"


def headline_table(groups):
    rows = ["| what | value | beside | times as good | error | device | date |", "| --- | ---: | --- | ---: | ---: | --- | --- |"]
    for words, bench, device, case in HEADLINES:
        found = [cases[case] for (b, d), cases in groups.items() if b == bench and d.startswith(device) and case in cases]
        if not found:
            continue
        result = max(found, key=lambda r: r["date"])
        unit, factor = WORDS.get(result["unit"], (result["unit"], 1))
        rows.append(f"| {words} | {short(result['value'] * factor)} {unit} | {result['baseline'] or ''} | {short(result['ratio'])} |"
                    f" {short(result['error']) if result['error'] else 0} | {device_name(result['device'])} | {result['date'][:10]} |")
    return rows


def device_name(name):
    return re.sub(r"^pthread-[a-z0-9-]*?-(?=[A-Z])", "two cores of ", name)


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
        for match, result in matches(cases_of(groups, "recall", GPU), rf"(\S+), {launch}, (\S+) rays"):
            lost.setdefault(float(match[2]), []).append(result["error"])
        name = {"hilbert": "evenly spread", "horizon": "towards the horizon"}[launch]
        curves[f"{name}, median case"] = [(n, statistics.median(e)) for n, e in sorted(lost.items())]
        curves[f"{name}, worst case"] = [(n, max(e)) for n, e in sorted(lost.items())]
    return curves


def receiver_curves(groups):
    """Seconds per frame against links, ours and the peer's as bench_paths names it."""
    curves = {}
    for name, device in (("H200", GPU), ("two cores", CPU)):
        for match, result in matches(cases_of(groups, "paths", device),
                                     r"munich, (\d+)x(\d+) links, 1e\+06 rays per transmitter, error against 3e\+07"):
            links = int(match[1]) * int(match[2])
            curves.setdefault(f"wavetracer, {name}", []).append((links, result["value"]))
            if result["baseline_value"] and "1e+07 rays" not in result["baseline"]:  # as many rays as ours
                curves.setdefault(f"Sionna RT, {name}", []).append((links, result["baseline_value"]))
    return {name: sorted(points) for name, points in curves.items()}


def vehicle_curves(groups):
    """Frames per second against vehicles, depth 3, sequences reused."""
    curves = {}
    for name, device in (("H200", GPU), ("two cores", CPU)):
        for match, result in matches(cases_of(groups, "drive", device), r"munich, (\d+) vehicles, depth 3: reuse, auto rays"):
            curves.setdefault(name, []).append((int(match[1]), 1 / result["value"]))
    return {name: sorted(points) for name, points in curves.items()}


PLOTS = [
    ("recall", "Reflected paths in streets, a roof and a canyon: what rays miss", "rays per transmitter", "share of paths lost (on the axis: 0)",
     recall_curves),
    ("receivers", "One frame in Munich, 10^6 rays per transmitter, five reflections", "links", "seconds per frame", receiver_curves),
    ("vehicles", "A drive in Munich: all links among the vehicles, three reflections", "vehicles", "frames per second",
     vehicle_curves),
]


def draw(path, title, x, y, curves):
    """A plot with logarithmic axes by gnuplot. A share of 0 stands at the foot of the plot, where 1e-4 is."""
    lines = ["set terminal svg size 760,520 font 'sans-serif,13' background '#ffffff'", f"set output '{path}'",
             f"set title '{title}'", f"set xlabel '{x}'", f"set ylabel '{y}'", "set logscale xy", "set grid lc rgb '#dddddd'",
             "set key below", "set format x '10^{%T}'" if x.startswith("rays") else "set format x '%g'"]
    drawn = {name: points for name, points in curves.items() if points}
    for i, points in enumerate(drawn.values()):
        lines += [f"$c{i} << END"] + [f"{px:g} {max(py, 1e-4):.6g}" for px, py in points] + ["END"]
    lines.append("plot " + ", ".join(f"$c{i} with linespoints lw 2 pt {i + 4} title '{name}'" for i, name in enumerate(drawn)))
    subprocess.run(["gnuplot"], input="\n".join(lines), text=True, check=True)


def first_page(groups, folder):
    lines = ["", "## At a glance", ""] + headline_table(groups)
    (folder / "figures").mkdir(exist_ok=True)
    for name, title, x, y, curves_of in PLOTS:
        curves = curves_of(groups)
        if sum(len(points) > 1 for points in curves.values()) == 0:
            continue
        draw(folder / "figures" / f"{name}.svg", title, x, y, curves)
        lines += ["", f"![{title}](figures/{name}.svg)"]
    return lines
