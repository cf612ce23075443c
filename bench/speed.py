# SPDX-License-Identifier: Apache-2.0
"""Tables of speed for README.md, docs/speed.md and RESULTS.md, of the newest row of each measurement and device.

This file has the names of the rows; each number, with its error, command and date, comes from bench/results. So one measurement
has one number in all pages. A row that no benchmark has printed is left out, and a cell stays empty.
"""
from rows import command, device_name, of_device

H100, H200, CPU, GPU = "NVIDIA H100", "NVIDIA H200", "pthread", "NVIDIA"


def digits(value):
    return f"{value:,.0f}" if abs(value) >= 100 else f"{value:.3g}"


def seconds(value):
    return f"{digits(value)} s" if value >= 1 else f"{digits(value * 1e3)} ms"


def share(value):
    """A small share as a reader writes it."""
    if value <= 0:
        return "nothing"
    return "less than 0.001%" if value < 1e-5 else f"{100 * value:.1g}%" if value < 0.01 else f"{100 * value:.2g}%"


def power_lost(row):
    """The share of the power that a row has not found; of a drive the mean over its compared frames. None: unknown."""
    found = row.get("mean_power_recall") or row.get("power_recall")
    return row["error"] if found is None else max(0.0, 1 - found)


def paths_lost(row):
    return f"{row['reference_paths'] - row['paths']:,} of {row['reference_paths']:,} paths"


def value_cell(row, value=seconds):
    return value(row["value"]) if row else ""


def peer_cell(row):
    """The time of the program beside which a row was measured, and how many times as fast the row is."""
    if not row or not row["baseline_value"] or "Sionna" not in row["baseline"]:
        return ""
    found = f"; finds {row['baseline_paths']:,}" if row.get("baseline_paths") else ""
    return f"{seconds(row['baseline_value'])} ({digits(row['ratio'])} times as long{found})"


def markdown(head, lines, right, left=1):
    """A table; `right` columns after the first `left` ones are aligned to the right."""
    rule = ["---"] * left + ["---:"] * right + ["---"] * (len(head) - right - left)
    return ["| " + " | ".join(row) + " |" for row in [head, rule] + lines]


def devices_and_dates(found):
    """One line that says on which devices and days the rows of a table were measured."""
    dates = sorted({row["date"][:10] for row in found})
    devices = sorted({device_name(row["device"]) for row in found if row["device"].startswith(GPU)})
    cores = sorted({device_name(row["device"]) for row in found if row["device"].startswith(CPU)})
    return ["", f"The CPU is {' or '.join(cores)} with PoCL 3.1, the GPU an {' or an '.join(devices)}. Measured from {dates[0]}"
            f" to {dates[-1]}."]


def sources(found):
    """One line that says by which commands, on which days the rows of a table were measured, device by device."""
    devices = {}
    for row in found:
        if row:
            devices.setdefault(device_name(row["device"]), []).append(row)
    texts = []
    for device, rows in sorted(devices.items()):
        dates = sorted({row["date"][:10] for row in rows})
        commands = sorted({f"`{command(row)}`" for row in rows})
        texts.append(f"{device}: {' and '.join(commands)}, {dates[0]}" + (f" to {dates[-1]}" if len(dates) > 1 else ""))
    return ["", "Measured on " + "; on ".join(texts) + "."]


# --- the tables ---

LINKS = [(f"{links.replace('x', ' x ')}, {words} rays", f"munich, {links} links, {rays} rays per transmitter")
         for links, rays, words in (("1x1", "3e+04", "30,000"), ("1x1", "1e+05", "100,000"), ("1x10", "1e+05", "100,000"),
                                    ("1x100", "3e+04", "30,000"), ("1x100", "5e+04", "50,000"), ("1x100", "1e+05", "100,000"),
                                    ("10x100", "1e+04", "10,000"), ("10x100", "3e+04", "30,000"), ("10x100", "1e+05", "100,000"))]
EDGES = [(f"{links.replace('x', ' x ')}, 100,000 and {words} rays",
          f"munich, {links} links, 1e+05 rays per transmitter, diffraction, {rays} rays per receiver")
         for links, rays, words in (("1x1", "1e+04", "10,000"), ("1x1", "1e+05", "100,000"), ("1x100", "3e+03", "3,000"),
                                    ("1x100", "1e+04", "10,000"), ("1x100", "1e+05", "100,000"))]
DRIVES = [(f"{n:,} vehicles, depth {depth}, {words}", f"{world}: {case}")
          for n, depth, world, cases in (
              (100, 3, "munich, 100 vehicles, depth 3",
               (("no reuse, 100,000 rays", "cold, 1e+05 rays"), ("no reuse, \"auto\"", "cold, auto rays"),
                ("10,000 new rays a frame after 10^5", "reuse, 1e+05 rays, 1e+04 anew"),
                ("3,000 new rays a frame after 10^5", "reuse, 1e+05 rays, 3e+03 anew"),
                ("1,000 new rays a frame after 10^5", "reuse, 1e+05 rays, 1e+03 anew"),
                ("30,000 new rays a frame after 10^6", "reuse, 1e+06 rays, 3e+04 anew"),
                ("10,000 new rays a frame after 10^6", "reuse, 1e+06 rays, 1e+04 anew"), ("reuse, \"auto\"", "reuse, auto rays"))),
              (100, 5, "munich, 100 vehicles, depth 5",
               (("no reuse, 100,000 rays", "cold, 1e+05 rays"), ("30,000 new rays a frame after 10^6", "reuse, 1e+06 rays, 3e+04 anew"),
                ("10,000 new rays a frame after 10^6", "reuse, 1e+06 rays, 1e+04 anew"), ("reuse, \"auto\"", "reuse, auto rays"))),
              (1000, 3, "city of 12 x 12 blocks, 1000 vehicles, links of at most 300 m",
               (("10,000 new rays a frame after 10^6", "reuse, 1e+06 rays, 1e+04 anew"),)))
          for words, case in cases]
LIVE = [(f"{count}{words}", f"city, {count}, 100000 rays, 3000 anew{case}")
        for count, every in (("1 vehicle and a road-side unit", True), ("10 vehicles", False), ("20 vehicles", True),
                             ("50 vehicles", False), ("100 vehicles", True))
        for words, case in (("", ""), (", answers in CBOR", ", columns in CBOR"),
                            (", all paths", ", paths"), (", all paths, in CBOR", ", paths, columns in CBOR"),
                            (", matrices of 2 x 2", ", matrices"),
                            (", matrices of 2 x 2, in CBOR", ", matrices, columns in CBOR"),
                            (", asked by VaN3Twin", ", VaN3Twin"))[:7 if every else 1]]
COVERAGE = [(words, f"{scene}, 22500 receivers, 1e+06 rays, depth 3, error against 10 times the rays")
            for words, scene in (("22,500 places in Munich", "munich"), ("22,500 places in a generated city", "city"))]
SCALING = [(f"{words}, {'one' if n == 1 else n} {device}{'' if n == 1 else 's'}",
            f"drive, 100 vehicles, {rays} rays, {n} {device}{'' if n == 1 else 's'}")
           for words, rays, device in (("10^7 rays", 10000000, "device"), ("10^6 rays", 1000000, "device"), ("50,000 rays", 50000, "core"))
           for n in (1, 2, 4)]
PARTS = [  # words, benchmark, device, case
    ("nearest hits, 1.6 10^7 rays in order", "trace", H200, "munich, 16000000 rays, hilbert: bvh2"),
    ("nearest hits, 10^6 rays in order", "trace", CPU, "munich, 1000000 rays, hilbert: packet16"),
    ("sorting 2^26 keys of 32 bits, as a permutation", "sort", H100, "u32 to permutation, n = 2^26: radix, against the fastest peer"),
    ("sorting 2^24 keys of 32 bits, as a permutation", "sort", CPU, "u32 to permutation, n = 2^24: radix, against the fastest peer"),
    ("rays born in order, all ray stages", "order", H200, "munich, 16777216 rays: born in order"),
    ("a start with compiled kernels at hand", "start", CPU, "second start, programs cached"),
]


def three_devices(groups, bench, table, extra, head, value=seconds, cores="two CPU cores"):
    """Rows of a table beside two cores, an H100 and an H200, with the cells that `extra` makes of the three rows."""
    lines, found = [], []
    for words, case in table:
        rows = [of_device(groups, bench, device, case) for device in (CPU, H100, H200)]
        if any(rows):
            lines.append([words] + [value_cell(row, value) for row in rows] + extra(rows))
            found += rows
    empty = [column for column in (3, 2, 1) if not any(line[column] for line in lines)]
    rows = [[head[0], cores, "H100", "H200"] + head[1:]] + lines
    for column in empty:
        rows = [row[:column] + row[column + 1:] for row in rows]
    return markdown(rows[0], rows[1:], 3 - len(empty)) + sources(found)


def newest_of(rows):
    return max((row for row in rows if row), key=lambda row: row["date"])


def links(groups):
    return three_devices(groups, "paths", LINKS, lambda rows: [peer_cell(rows[0]), peer_cell(rows[2]), paths_lost(newest_of(rows))],
                         ["transmitters x receivers, rays of each transmitter", "Sionna RT on the same cores", "Sionna RT on an H200",
                          "lost"])


def edges(groups):
    return three_devices(groups, "paths", EDGES, lambda rows: [peer_cell(rows[0]), f"{newest_of(rows)['paths']:,}",
                                                               share(power_lost(newest_of(rows)))],
                         ["transmitters x receivers, rays of a transmitter and of a receiver", "Sionna RT on the same cores",
                          "paths", "power lost"])


def drives(groups):
    return three_devices(groups, "drive", DRIVES, lambda rows: [f"{newest_of(rows)['links']:,}", share(power_lost(newest_of(rows)))],
                         ["drive", "links", "power lost"])


def live(groups):
    def tails(rows):
        lost = [row["error"] for row in rows if row and row["error"] is not None]
        return [", ".join(seconds(row["p99_s"]) for row in rows if row), share(max(lost)) if lost else ""]
    return three_devices(groups, "live", LIVE, tails, ["from pose to channel, median", "the slowest of a hundred, in the same order",
                                                       "power lost"])


def coverage(groups):
    return three_devices(groups, "coverage", COVERAGE, lambda rows: [share(newest_of(rows)["error"])],
                         ["coverage map, depth 3, 10^6 rays", "cells that err by more than 0.1 dB"],
                         lambda value: f"{digits(value / 1e3)} thousand places/s")


def maps(groups):
    """Maps of the same cells by both programs on one GPU, from fast to slow: time and cells that are off."""
    def case(rays, peer=""):
        return f"munich, 22500 receivers, {rays} rays, depth 3, error against 10 times the rays{peer}"

    own = [of_device(groups, "coverage", H200, case(rays)) for rays in ("1e+03", "3e+03", "1e+05")]
    lines = [[f"wavetracer, {row['rays']:,} rays", seconds(row["frame_s"]), share(row["error"]), ""] for row in own if row]
    found = [row for row in own if row]
    for row in (of_device(groups, "coverage", H200, case("1e+03", peer)) for peer in ("", " (2)", " (3)", " (4)")):
        if row and row["baseline"]:
            rays, error = row["baseline"].split(", ")[-1].split(" rays: ")
            lines.append([f"Sionna RT, {float(rays):,.0f} rays", seconds(row["receivers"] / row["baseline_value"]),
                          error.split(" of ")[0], digits(row["ratio"])])
            found.append(row)
    return markdown(["22,500 places in Munich, depth 3", "one map", "places that err by more than 0.1 dB",
                     "times as long as wavetracer with 1,000 rays"], lines, 3) + sources(found)


def scaling(groups):
    def efficiency(rows):
        row = newest_of(rows)
        return [f"{100 * row['efficiency_whole']:.0f}%", f"{100 * row['efficiency_solving']:.0f}%"]
    return three_devices(groups, "scaling", SCALING, efficiency, ["drive of 100 vehicles", "of the rate of one, whole command",
                                                                  "while solving"], lambda value: f"{digits(value)} frames/s", "CPU cores")


def parts(groups):
    lines, found = [], []
    for words, bench, device, case in PARTS:
        if row := of_device(groups, bench, device, case):
            value = seconds(row["value"]) if row["unit"] == "s" else f"{digits(row['value'])} {row['unit']}"
            peer = f"{digits(row['ratio'])} times as good as {row['baseline']}" if row["ratio"] else ""
            lines.append([words, value, device_name(row["device"]), peer])
            found.append(row)
    return markdown(["part", "value", "device", "beside"], lines, 1) + sources(found)


def visitor(groups):
    """The four rows of README.md: what is asked most, on two cores and on the GPU that was measured last."""
    def of_power(rows):
        return share(max(map(power_lost, rows))) + " of the power"

    def of_cells(rows):
        return share(max(row["error"] for row in rows)).replace("nothing", "none") + " of the cells are wrong by more than 0.1 dB"

    table = [("100 receivers and one transmitter, up to five reflections", "paths", LINKS[5][1], lambda rows: paths_lost(rows[0])),
             ("the same with diffraction at edges", "paths", EDGES[3][1], of_power),
             ("a drive of 100 vehicles, with all {} links between them", "drive", "munich, 100 vehicles, depth 3: reuse, {} rays, 1e+04 anew",
              of_power),
             ("a coverage map of 22,500 places", "coverage", COVERAGE[0][1], of_cells)]
    lines, found = [], []
    for words, bench, case, lost in table:
        rows = [of_device(groups, bench, CPU, case.format("1e+05")), of_device(groups, bench, GPU, case.format("1e+06"))]
        if not all(rows):
            continue
        value = (lambda rate: seconds(22500 / rate)) if bench == "coverage" else seconds
        lines.append([words.format(f"{rows[0].get('links', 0):,}" if "{}" in words else ""), value_cell(rows[0], value), peer_cell(rows[0]),
                      value_cell(rows[1], value), lost(rows)])
        found += rows
    return markdown(["one frame of", "two CPU cores", "Sionna RT 2.2 on the same cores", "one GPU", "error: what is lost"], lines, 3) + devices_and_dates(found)


CARS = [(f"{n} moving cars, {links} links, {words}", f"munich, {n} moving cars, {links} links: {way}, 1e+06 rays")
        for n in (20, 100) for links in ("1 x 10", "10 x 100") for words, way in (("no reuse", "cold"), ("reuse", "reuse"))]
STEPS = [("20 vehicles, rays each 0.1 s", "munich, 20 vehicles, depth 3: steps of 1 ms"),
         ("100 vehicles, rays each 0.1 s", "munich, 100 vehicles, depth 3: steps of 1 ms"),
         ("100 vehicles, rays each 0.03 s", "munich, 100 vehicles, depth 3: steps of 1 ms, rays every 30 ms")]
FEATURES = [(words, f"munich, 1x24, depth 5: {case}") for words, case in (
    ("reflection alone", "reflections"), ("transmission, one a path", "transmission, 1 a path"), ("two a path", "transmission, 2 a path"),
    ("diffraction at wedges", "diffraction, wedges"), ("scattering, tiles of 10 m", "scattering, tiles of 10 m"), ("all of them", "all"),
    ("transmission asked for, nothing lets waves through", "transmission, half spaces alone"),
    ("scattering asked for, nothing is rough", "scattering, no rough material"))]
PLACES = ("munich_street_0", "munich_street_1", "munich_street_2", "munich_street_deep", "munich_roof", "street_canyon_cars_specular")


def cars(groups):
    return three_devices(groups, "drive", CARS, lambda rows: [peer_cell(rows[0]), peer_cell(rows[1]) or peer_cell(rows[2]),
                                                              share(power_lost(newest_of(rows)))],
                         ["one frame", "Sionna RT on two cores", "Sionna RT on an H200", "power lost"])


def steps(groups):
    return three_devices(groups, "drive", STEPS, lambda rows: [seconds(newest_of(rows)["baseline_value"]), share(newest_of(rows)["error"]),
                                                               share(newest_of(rows)["late_largest_share"])],
                         ["steps of 1 ms, depth 3", "all frames with rays (newest device)", "power lost, mean", "the most that came late"])


def features(groups):
    return three_devices(groups, "features", FEATURES, lambda rows: [f"{newest_of(rows)['cost']:.3g}", f"{newest_of(rows)['paths']:,}"],
                         ["Munich, 1 x 24 links, depth 5", "times the frame of reflection alone", "paths"])


def recall(groups):
    """Shares of the reference paths that launches lose, with the time of a frame, on the H200."""
    settings = [("hilbert", "1e+05"), ("hilbert", "1e+06"), ("horizon", "1e+04"), ("horizon", "1e+05"), ("horizon", "1e+06")]
    lines, found = [], []
    for place in PLACES:
        rows = [of_device(groups, "recall", H200, f"{place}, {way}, {rays} rays") for way, rays in settings]
        lines.append([place] + [f"{share(row['error'])}, {seconds(row['value'])}" if row else "" for row in rows])
        found += rows
    return markdown(["place", "even, 10^5 rays", "even, 10^6", "horizon, 10^4", "horizon, 10^5", "horizon, 10^6"], lines, 5) + sources(found)


def checks(groups):
    """Counts of checks that hold, and of rays that slip through closed meshes."""
    lines, found = [], []
    for device in (CPU, H100, H200):
        hard = [row for (b, d), cases in groups.items() if b == "hard" and d.startswith(device) for row in cases.values()]
        leaks = [row for (b, d), cases in groups.items() if b == "leaks" and d.startswith(device) for row in cases.values()]
        if hard:
            lines.append(["numerically hard cases that hold", f"{sum(row['holds'] for row in hard)} of {len(hard)}", device_name(hard[0]["device"])])
        if leaks:
            rays = sum(row["rays"] for row in leaks)
            lines.append(["rays at edges and vertices that slip through", f"{sum(row['value'] for row in leaks):.0f} of {rays:,}",
                          device_name(leaks[0]["device"])])
        found += hard + leaks
    return markdown(["check", "result", "device"], lines, 1) + sources(found)


TABLES = {"cars": cars, "steps": steps, "features": features, "recall": recall, "checks": checks,
          "visitor": visitor, "links": links, "edges": edges, "drives": drives, "live": live, "coverage": coverage, "maps": maps,
          "scaling": scaling, "parts": parts}
