#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Answers questions of users of Sionna RT with both programs on one scene, and prints the numbers of
docs/from-sionna.md, a line each.

    sionna_questions.py [receivers] [repeat] [scattering] [rows] [cars]

Needs `pip install sionna-rt` and wavetracer's package; on CPUs LLVM, too, as sionna_rt.py says. Without arguments all
questions are asked, which takes some minutes on two cores.
"""
import datetime
import platform
import sys
import time

import numpy as np
import sionna.rt as rt
import wavetracer as wt

ONE = {"num_rows": 1, "num_cols": 1, "pattern": "iso", "polarization": "V"}
TRACE = {"max_depth": 4, "rays": 1_000_000}


def munich(receivers):
    """The scene of Sionna RT's first tutorial, with receivers at drawn places; the first is always the same."""
    scene = rt.load_scene(rt.scene.munich)
    scene.frequency = 5.9e9
    scene.tx_array = scene.rx_array = rt.PlanarArray(**ONE)
    scene.add(rt.Transmitter("tx", position=[8.5, 21, 27]))
    random = np.random.default_rng(1)
    places = np.c_[random.uniform(-150, 150, (100, 2)), np.full(100, 1.5)]
    places[0] = [45, 90, 1.5]
    for i in range(receivers):
        scene.add(rt.Receiver(f"rx{i}", position=places[i].tolist()))
    return scene


def solve(scene, **options):
    return rt.PathSolver()(scene, max_depth=4, refraction=False, samples_per_src=10**6, **options)


def gain_db(h):
    return 20 * np.log10(np.abs(h[0, 0, 0, 0, 0, 0]))


def receivers():
    """The first receiver's channel, whoever else is in the call."""
    for count in (1, 10, 100):
        scene = munich(count)
        solve(scene)
        start = time.perf_counter()
        theirs = solve(scene)
        h = theirs.cfr([0.0], normalize_delays=False, out_type="numpy")
        seconds = time.perf_counter() - start
        print(f"receivers: {count} in the call; Sionna RT: {int((theirs.tau.numpy()[0, 0] >= 0).sum())} paths of the first, "
              f"{gain_db(h):.3f} dB, {seconds:.2f} s", flush=True)
        simulation = wt.from_sionna(scene, trace=TRACE)
        simulation.run_frame()
        simulation.forget()
        start = time.perf_counter()
        ours = simulation.run_frame().paths.select(rx="rx0")
        seconds = time.perf_counter() - start
        print(f"receivers: {count} in the call; wavetracer: {len(ours)} paths of the first, "
              f"{gain_db(ours.cfr([0.0], normalize_delays=False)):.3f} dB, {seconds:.2f} s", flush=True)


def repeat():
    """The same call three times, with diffraction."""
    scene = munich(10)
    theirs = [solve(scene, diffraction=True).cfr([0.0], normalize_delays=False, out_type="numpy") for _ in range(3)]
    gains_db = 20 * np.log10([np.abs(h[h != 0]) for h in theirs])
    print(f"repeat: Sionna RT: gains of {gains_db.shape[1]} links, thrice, differ by up to {np.ptp(gains_db, axis=0).max():.2g} dB",
          flush=True)
    simulations = [wt.from_sionna(scene, trace=TRACE | {"diffraction": True}) for _ in range(3)]
    ours = [simulation.run_frame().paths for simulation in simulations]
    same = all(np.array_equal(getattr(a, name), getattr(ours[0], name)) for a in ours
               for name in ("a", "delay_s", "doppler_hz", "aod_phi_rad", "vertex_position_m"))
    print(f"repeat: wavetracer: {len(ours[0])} paths, thrice, {'the same bits' if same else 'NOT the same'}")


def scattering():
    """Doppler shifts of scattered paths against the change of their lengths, from places 0.1 mm before and after."""
    step_s, velocity = 1e-5, np.array([10.0, -4.0, 0.0])
    material = {"name": "brick", "a": 3.91, "b": 0, "c": 0.0238, "d": 0.16, "scattering": 0.4}
    config = {"scene": {"generate": "--seed 1 --blocks 4x4"}, "material": [material],
              "transmitter": [{"name": "tx", "position_m": [8, 8, 6]}],
              "trace": {"rays": 20_000, "max_depth": 1, "scattering": True}}
    runs = [wt.Simulation(config | {"receiver": [{"name": "rx", "velocity_m_s": velocity,
                                                  "position_m": np.array([60.0, 3, 1.5]) + velocity * t}]}).run_frame().paths
            for t in (-step_s, 0, step_s)]
    lengths = [dict(zip(map(tuple, run.vertex_position_m[run.vertex_offset[:-1][run.kind == "scattered"].astype(int)]),
                        run.delay_s[run.kind == "scattered"])) for run in runs]
    shift = dict(zip(lengths[1], runs[1].doppler_hz[runs[1].kind == "scattered"]))
    common = [tile for tile in shift if tile in lengths[0] and tile in lengths[2]]
    rate = np.array([(lengths[0][tile] - lengths[2][tile]) / (2 * step_s) * 5.9e9 for tile in common])
    off = np.abs(rate - np.array([shift[tile] for tile in common]))
    print(f"scattering: wavetracer: {len(common)} scattered paths, Doppler shifts of {min(shift.values()):.0f} to "
          f"{max(shift.values()):.0f} Hz, off by at most {off.max():.2g} Hz from the change of their lengths")


def rows():
    """Prints the number of paths stored for a map of 90,000 receivers."""
    simulation = wt.Simulation(wt.configs / "coverage.toml")
    simulation.run_frame()
    simulation.forget()
    start = time.perf_counter()
    frame = simulation.run_frame()
    seconds = time.perf_counter() - start
    most = int(frame.links["paths"].max())
    print(f"rows: wavetracer: {len(frame):,} paths of {len(frame.links):,} links in {seconds:.1f} s; arrays of all links with "
          f"room for {most} paths each would have {most * len(frame.links):,} elements")


def cars():
    """Seconds a frame while cars move: all of the street canyon's are moved and the scene is solved again."""
    scene = rt.load_scene(rt.scene.simple_street_canyon_with_cars, merge_shapes=False)
    scene.frequency = 5.9e9
    scene.tx_array = scene.rx_array = rt.PlanarArray(**ONE)
    moving = [thing for name, thing in scene.objects.items() if name.startswith("car")]
    scene.add(rt.Transmitter("tx", position=[22.7, 5.6, 4.0]))
    for i, car in enumerate(moving):
        x, y, z = np.ravel(np.array(car.position))
        scene.add(rt.Receiver(f"rx{i}", position=[float(x), float(y), float(z) + 2]))
    seconds = []
    for _ in range(6):
        start = time.perf_counter()
        for i, car in enumerate(moving):
            x, y, z = (float(each) for each in np.ravel(np.array(car.position)))
            car.position = [x + 0.5, y, z]
            scene.get(f"rx{i}").position = [x + 0.5, y, z + 2]
        solve(scene).tau.numpy()
        seconds.append(time.perf_counter() - start)
    print(f"cars: Sionna RT: {len(moving)} cars, 1 x {len(moving)} links, 10^6 rays, depth 4: "
          f"{np.median(seconds[1:]):.2f} s a frame", flush=True)
    simulation = wt.Simulation(wt.configs / "demo.toml", trace={"max_depth": 4})
    seconds = []
    for number in range(len(simulation)):
        start = time.perf_counter()
        frame = simulation.run_frame(number)
        seconds.append(time.perf_counter() - start)
    print(f"cars: wavetracer: 20 vehicles, {len(frame.links)} links, 10^5 rays a transmitter in the first frame and 10^4 in "
          f"those after it, depth 4: {np.median(seconds[1:]):.2f} s a frame")


if __name__ == "__main__":
    asked = sys.argv[1:] or ["receivers", "repeat", "scattering", "rows", "cars"]
    print(f"{datetime.date.today()}, {wt.devices()[0]['name']}, {platform.python_version()}, Sionna RT {rt.__version__}, "
          f"wavetracer {wt.__version__}", flush=True)
    for question in asked:
        {"receivers": receivers, "repeat": repeat, "scattering": scattering, "rows": rows, "cars": cars}[question]()
