#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Solves the links of bench_paths by Sionna RT and prints the same JSON lines, for `bench_paths --peer`.
# It needs `pip install sionna-rt`, and on CPUs LLVM: 15 is too old, libllvm19 works (DRJIT_LIBLLVM_PATH names its .so).
"""Usage: bench_paths --write-links links.json
       sionna_rt.py links.json munich.xml > peer.jsonl
       bench_paths --peer peer.jsonl

Line of sight and specular reflections, as bench_paths; --diffraction and --transmission add those, on the same links:
       sionna_rt.py links.json munich.xml --diffraction --only 1x1 --only 1x100 --rays 1e6
--paths FOLDER also writes the paths of each case there, for `bench_paths --peer-paths`.
"error" is the share of paths that are missed, among the distinct ones that the largest launch for the same links finds;
null for that launch itself.
Paths that Sionna RT reports twice count once; so do those of coplanar neighbours, which have one length.
"""
import argparse
import datetime
import importlib.metadata
import json
import pathlib
import platform
import statistics
import sys
import time

import mitsuba as mi
import numpy as np
import sionna.rt as rt
from sionna.rt.constants import InteractionType

# Transmitters, receivers, rays per transmitter, as in bench_paths.cpp. For each set of links the largest number of rays
# comes last.
CASES = [(1, 1, 10**5), (1, 1, 10**6), (1, 1, 10**7), (1, 10, 10**6),
         (1, 100, 10**6), (1, 100, 10**7), (10, 100, 10**6), (10, 100, 10**7)]
LARGE = 10**7  # cases of so many rays, those of all transmitters together, are for GPUs, and for --large
SAME_DELAY_S, SAME_DELAY = 30e-12, 2e-6  # float32 delays of one path agree to this, absolute or relative


def load(scene_file, links, tx_count, rx_count):
    scene = rt.load_scene(str(scene_file))
    scene.frequency = links["frequency_hz"]
    array = dict(num_rows=1, num_cols=1, vertical_spacing=0.5, horizontal_spacing=0.5, pattern="iso", polarization="V")
    scene.tx_array, scene.rx_array = rt.PlanarArray(**array), rt.PlanarArray(**array)
    for i, position in enumerate(links["transmitters_m"][:tx_count]):
        scene.add(rt.Transmitter(name=f"tx{i}", position=position))
    for i, position in enumerate(links["receivers_m"][:rx_count]):
        scene.add(rt.Receiver(name=f"rx{i}", position=position))
    return scene


def distinct(paths):
    """(receiver, transmitter, path) of every path, each once, sorted by link, interactions and delay."""
    kinds = np.moveaxis(paths.interactions.numpy(), 0, -1)  # rx, tx, path, depth: 0 where there is none
    delay = paths.tau.numpy()
    rows = sorted((rx, tx, tuple(kinds[rx, tx, path].tolist()), float(delay[rx, tx, path]), path)
                  for rx, tx, path in np.argwhere(paths.valid.numpy()).tolist())
    found = []
    for row in rows:
        if not (found and found[-1][:3] == row[:3] and same_delay(found[-1][3], row[3])):
            found.append(row)
    return [(rx, tx, path) for rx, tx, _, _, path in found]


def distinct_paths(paths):
    """(receiver, transmitter, interactions, delay) of every path, each once, sorted."""
    kinds, delay = np.moveaxis(paths.interactions.numpy(), 0, -1), paths.tau.numpy()
    return [(*i[:2], tuple(kinds[i].tolist()), float(delay[i])) for i in distinct(paths)]


def write_paths(file, paths, links, rays, interactions, tx_count, rx_count):
    """The distinct paths as a reference list (tests/reference/README.md) of V ports; the H ports are 0."""
    kinds = np.moveaxis(paths.interactions.numpy(), 0, -1)
    vertices = np.moveaxis(paths.vertices.numpy(), 0, -2)  # rx, tx, path, depth, xyz
    real, imaginary = (part.numpy()[:, 0, :, 0] for part in paths.a)  # axes: rx, antenna, tx, antenna, path
    angles = {"aod_theta_phi_rad": (paths.theta_t.numpy(), paths.phi_t.numpy()),
              "aoa_theta_phi_rad": (paths.theta_r.numpy(), paths.phi_r.numpy())}
    delay = paths.tau.numpy()
    rows = []
    for i in distinct(paths):
        count = int(np.count_nonzero(kinds[i]))
        row = {"rx": i[0], "tx": i[1], "tau_s": float(delay[i]), "interactions": kinds[i][:count].tolist(),
               "vertices_m": vertices[i][:count].tolist(),
               "a_re": [[float(real[i]), 0], [0, 0]], "a_im": [[float(imaginary[i]), 0], [0, 0]]}
        rows.append(row | {name: [float(theta[i]), float(phi[i])] for name, (theta, phi) in angles.items()})
    file.write_text(json.dumps({
        "case": file.stem, "scene": links["scene"], "frequency_hz": links["frequency_hz"],
        "max_depth": links["max_depth"], "reflection": True, "transmission": "transmission" in interactions,
        "diffraction": "diffraction" in interactions,
        "solver": f"Sionna RT {importlib.metadata.version('sionna-rt')}, {rays} rays per transmitter",
        "tx_m": links["transmitters_m"][:tx_count], "rx_m": links["receivers_m"][:rx_count], "paths": rows}))


def same_delay(a, b):
    return abs(a - b) <= max(SAME_DELAY_S, SAME_DELAY * b)


def recall(reference, found):
    """Share of the reference's paths that are in `found`, which has no path twice."""
    left = {}
    for *key, delay in found:
        left.setdefault(tuple(key), []).append(delay)
    hits = 0
    for *key, delay in reference:
        delays = left.get(tuple(key), [])
        match = next((d for d in delays if same_delay(d, delay)), None)
        if match is not None:
            delays.remove(match)
            hits += 1
    return hits / max(len(reference), 1)


def solve(solver, scene, links, rays, interactions):
    """Seconds of one solve until its results lie in the host's memory, and the paths."""
    start = time.perf_counter()
    paths = solver(scene, max_depth=links["max_depth"], samples_per_src=rays, los=True, specular_reflection=True,
                   diffuse_reflection=False, refraction="transmission" in interactions,
                   diffraction="diffraction" in interactions, edge_diffraction="free edges" in interactions,
                   synthetic_array=True)
    real, imaginary = paths.a
    for result in (paths.valid, paths.tau, real, imaginary):
        result.numpy()
    return time.perf_counter() - start, paths


def device_name():
    where = "OptiX" if mi.variant().startswith("cuda") else "LLVM"
    processor = platform.processor() or platform.machine()
    cpuinfo = pathlib.Path("/proc/cpuinfo")
    if where == "LLVM" and cpuinfo.exists():
        names = [line for line in cpuinfo.read_text().splitlines() if line.startswith("model name")]
        processor = f"{names[0].split(':', 1)[1].strip()}, {len(names)} threads" if names else processor
    what = "CUDA GPU" if where == "OptiX" else processor
    return f"{what}, Sionna RT {importlib.metadata.version('sionna-rt')} ({where})"


def measure(solver, scene, links, rays, interactions, runs):
    """Seconds of the first solve, median seconds of warm ones, and the paths of the last."""

    def once():
        return solve(solver, scene, links, rays, interactions)

    first, _ = once()
    once()  # the second solve still compiles
    seconds = [once()[0] for _ in range(runs)]  # no result outlives its solve
    return first, statistics.median(seconds), once()[1]


def count_with(paths, kind):
    return sum(int(kind) in kinds for _, _, kinds, _ in paths)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("links", type=pathlib.Path, help="written by bench_paths --write-links")
    parser.add_argument("scene", type=pathlib.Path, help="the Mitsuba XML file of the same scene")
    parser.add_argument("--runs", type=int, default=5, help="warm solves of which the median counts")
    parser.add_argument("--large", action="store_true", help="on a CPU, too, the cases of 1e7 rays and more")
    parser.add_argument("--only", metavar="TXxRX", action="append",
                        help="only cases of this many links, such as 1x100; may be given several times")
    parser.add_argument("--rays", type=float, help="only cases of this many rays per transmitter, such as 1e6")
    parser.add_argument("--diffraction", action="store_true", help="paths with a diffraction at a wedge, too")
    parser.add_argument("--free-edges", action="store_true", help="with --diffraction: at edges of one face, too")
    parser.add_argument("--paths", type=pathlib.Path, metavar="FOLDER", help="write the paths of each case there")
    parser.add_argument("--transmission", action="store_true", help="paths through surfaces, too")
    arguments = parser.parse_args()
    if arguments.free_edges and not arguments.diffraction:
        parser.error("--free-edges needs --diffraction")
    interactions = ["reflection"] + [name for name, wanted in (("diffraction", arguments.diffraction),
                                                               ("free edges", arguments.free_edges),
                                                               ("transmission", arguments.transmission)) if wanted]
    links = json.loads(arguments.links.read_text(encoding="utf-8"))
    if arguments.paths:
        arguments.paths.mkdir(parents=True, exist_ok=True)
    all_cases = arguments.large or mi.variant().startswith("cuda")
    solver = rt.PathSolver()
    results = []
    for tx_count, rx_count, rays in CASES:
        name = f"{tx_count}x{rx_count}"
        if tx_count * rays >= LARGE and not all_cases:
            continue
        if (arguments.only and name not in arguments.only) or arguments.rays not in (None, rays):
            continue
        scene = load(arguments.scene, links, tx_count, rx_count)
        first, median, solved = measure(solver, scene, links, rays, interactions, arguments.runs)
        if arguments.paths:
            file = arguments.paths / f"{name}_{rays}_{'_'.join(interactions).replace(' ', '_')}.json"
            write_paths(file, solved, links, rays, interactions, tx_count, rx_count)
        paths = distinct_paths(solved)
        results.append((name, rays, first, median, paths))
        print(f"sionna_rt.py: {name}, {rays} rays: {median:.3f} s, {len(paths)} paths", file=sys.stderr)
    largest = {name: (rays, paths) for name, rays, _, _, paths in results}
    for name, rays, first, median, paths in results:
        most_rays, most_paths = largest[name]
        print(json.dumps({
            "bench": "paths",
            "case": ", ".join([links["scene"], f"{name} links", f"{rays:.0e} rays per transmitter"] + interactions[1:]),
            "device": device_name(),
            "value": median,
            "unit": "s per frame",
            "baseline": None,
            "baseline_value": None,
            "ratio": None,
            "error": None if rays == most_rays else 1 - recall(most_paths, paths),
            "detail": f"{len(paths)} distinct paths; first solve {first:.3f} s",
            "links": name,
            "rays": rays,
            "interactions": interactions,
            "paths": len(paths),
            "diffracted_paths": count_with(paths, InteractionType.DIFFRACTION),
            "transmitted_paths": count_with(paths, InteractionType.REFRACTION),
            "first_frame_s": first,
            "command": " ".join([pathlib.Path(sys.argv[0]).name] + sys.argv[1:]),
            "date": datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ"),
        }))


if __name__ == "__main__":
    main()
