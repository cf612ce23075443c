#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures `wavetracer serve --protocol van3twin` as VaN3Twin's modules use it: all vehicles are placed, then every pair is
asked for its path gain, delay and line of sight, step by step.

usage: van3twin_latency.py PROGRAM [--vehicles N] [--steps N] [--device TEXT] [--pause MS]

Prints p50 and p99 in milliseconds: of confirmations, of the first question of each step, for which the channels of all
pairs are computed, and of all questions. --pause: the time from the last update of a step to its first question, which a
simulator needs for its own work; the server computes the channels meanwhile. The world is that of configs/ns3/corner.toml.
"""
import argparse
import pathlib
import subprocess
import sys
import time

SOURCE = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(SOURCE / "tests/live"))
from van3twin_client import Van3twinClient


def place(k, step):
    """x, y and bearing: half of the vehicles drive eastwards, half northwards."""
    way_m = -90.0 + 18.0 * (k // 2) + 1.4 * step
    return (3.0, way_m, 0.0) if k % 2 else (way_m, -3.0, 90.0)


def timed(times, action, *arguments):
    began = time.perf_counter()
    out = action(*arguments)
    times.append(1e3 * (time.perf_counter() - began))
    return out


def measure(client, vehicles, steps, pause_s):
    names = [f"veh{k + 1}" for k in range(vehicles)]
    confirmations, firsts, questions, heard = [], [], [], 0
    for step in range(steps):
        for k, name in enumerate(names):
            x, y, bearing_deg = place(k, step)
            timed(confirmations, client.move, name, x, y, 0.0, bearing_deg)
        time.sleep(pause_s)
        asked = []
        for a in names:
            for b in names:
                if a == b:
                    continue
                heard += timed(asked, client.figure, "PATHGAIN", a, b) != "300"
                timed(asked, client.figure, "DELAY", a, b)
                timed(asked, client.figure, "LOS", a, b)
        questions += asked
        firsts += asked[:1]
    return {"confirmations": confirmations, "first questions of steps": firsts[1:], "all questions": questions}, heard


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--vehicles", type=int, default=20)
    parser.add_argument("--steps", type=int, default=50)
    parser.add_argument("--pause", type=float, default=0, help="ms")
    parser.add_argument("--device")
    options = parser.parse_args()
    command = [options.program, "serve", "--protocol", "van3twin", "-c", SOURCE / "configs/ns3/corner.toml", "--listen",
               "udp:127.0.0.1:0", *(["--device", options.device] if options.device else [])]
    server = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    line = server.stdout.readline()
    if not line.startswith("listening on "):
        sys.exit(server.communicate()[1])
    with Van3twinClient(line.removeprefix("listening on ").strip()) as client:
        times, heard = measure(client, options.vehicles, options.steps, options.pause / 1e3)
    server.terminate()
    server.communicate()
    print(f"{options.vehicles} vehicles, {options.steps} steps: {heard} pairs with a path")
    for what, values in times.items():
        values.sort()
        print(f"{what}: {len(values)}, p50 {values[len(values) // 2]:.3f} ms, p99 {values[len(values) * 99 // 100]:.3f} ms, "
              f"longest {values[-1]:.3f} ms")


if __name__ == "__main__":
    main()
