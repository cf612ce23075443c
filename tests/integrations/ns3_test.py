# SPDX-License-Identifier: Apache-2.0
"""The module of integrations/ns3 in ns-3: its models against answers of the server in JSON, its example of vehicles past
a corner against `wavetracer run` at the same places, and the beacons that arrive against what the gains predict.
Answers 77, "skipped", where ns-3 was not there when the tests were built. Assumes an OpenCL device."""
import cmath
import csv
import json
import math
import os
import subprocess
import sys
import tempfile

if sys.argv[3] == "none":
    print("skipped: no ns-3 when this was built (Debian: libns3-dev)")
    sys.exit(77)
sys.path.insert(0, os.path.join(sys.argv[2], "tests/live"))
from live_server import PROGRAM, SOURCE, Server, expect, frame, vehicle

CORNER, PROBE = sys.argv[3:5]
CARS, STEP_S, SPEED_M_S, TX_DBM, THRESHOLD_DBM = 20, 0.1, 14.0, 10.0, -82.0  # ns-3 detects no preamble that is weaker
WORLD = """
[scene]
generate = "--seed 1 --blocks 2x2"
[[mount]]
name = "roof"
offset_m = [0.0, 0.0, 1.6]
[trace]
rays = 3000
max_depth = 1
reuse = false
"""
LIVE = "[[live_vehicle]]\ntype = \"passenger\"\ncount = 20\n"
STATION = "[[station]]\nname = \"rsu\"\nposition_m = [8.0, 8.0, 6.0]\n"


def near(one, other, most=1e-9):
    return one == other or abs(one - other) <= most


def array_factor(side, theta, phi):
    """The factor of an array in the plane of y and z, with half a wavelength between elements, whose weights are 1/2."""
    return sum(0.5 * cmath.exp(1j * math.pi * (column * math.sin(theta) * math.sin(phi) + row * math.cos(theta)))
               for row in range(side) for column in range(side))


def power_at(link, hz, side=None):
    """The power gain of a link of an answer at a frequency; side: between arrays of so many rows and columns."""
    total = 0
    for k, (re, im, tau) in enumerate(zip(link["a_re"], link["a_im"], link["delay_s"])):
        factor = 1 if side is None else (array_factor(side, link["aod_theta_rad"][k], link["aod_phi_rad"][k]) *
                                         array_factor(side, link["aoa_theta_rad"][k], link["aoa_phi_rad"][k]))
        total += complex(re[0], im[0]) * cmath.exp(-2j * math.pi * ((hz * tau) % 1)) * factor
    return abs(total) ** 2


def models():
    """Each model of four nodes, at instants that differ in one thing each."""
    rest = {"velocity_m_s": [0, 0, 0]}
    driving = {"velocity_m_s": [0, -15, 0]}
    poses = {"first": [vehicle("node0", 3, -60, 0), vehicle("node1", -3, -30, -90, **driving)],
             "moved at the same time": [vehicle("node0", 3, -58, 90, **rest), vehicle("node1", -3, -30, -90, **driving)],
             "driven": [vehicle("node0", 3, -58, 90, **rest), vehicle("node1", -3, -31.5, -90, **driving)],
             "later": [vehicle("node0", 3, -58, 90, **rest), vehicle("node1", -3, -40.5, -90, **driving)]}
    names = {"node0/roof": 0, "node1/roof": 1, "rsu": 2}
    places = {"first": [(3, -60, 0), (-3, -30, 0)], "moved at the same time": [(3, -58, 0), (-3, -30, 0)],
              "driven": [(3, -58, 0), (-3, -31.5, 0)], "later": [(3, -58, 0), (-3, -40.5, 0)]}
    with Server(config=STATION + WORLD + LIVE) as server:
        done = subprocess.run([PROBE, server.name], check=True, capture_output=True, text=True).stdout
        with server.connect() as client:
            client.hello(detail="paths")
            truth = {label: client.ask(frame(k, k, each)) for k, (label, each) in enumerate(poses.items())}
    said = {each["label"]: each for each in map(json.loads, done.splitlines())}
    frames = [each["frames"] for each in said.values()]
    expect(list(said) == ["first", "moved at the same time", "driven", "driven, again", "kept", "later"], list(said))
    expect(frames == [1, 2, 3, 3, 3, 4], f"questions to the server: {frames}")
    for label in ("driven, again", "kept"):
        for one, other in zip(said[label]["links"], said["driven"]["links"]):
            expect(all(one[key] == other[key] for key in ("gain_db", "delay_s", "los", "spectrum")), (label, one, other))
            for key in ("matrix", "arrays"):  # a Doppler shift is added and taken back, with errors of rounding
                expect(all(math.isclose(a, b, rel_tol=1e-9, abs_tol=1e-12) for a, b in zip(one[key], other[key])),
                       (label, one, other))
    heard = 0
    for label, answer in truth.items():
        links = {(names[link["tx"]], names[link["rx"]]): link for link in answer["links"]}
        expect(len(links) == 6, links.keys())
        positions = [*places[label], (8, 8, 6), (5000, 0, 0)]
        for mine in said[label]["links"]:
            link = links.get((mine["from"], mine["to"]))
            if link is None or not link["paths"]:
                expect(mine["gain_db"] == -300 and not mine["los"] and max(mine["spectrum"]) == 0, (label, mine))
                way_s = math.dist(positions[mine["from"]], positions[mine["to"]]) / 299792458
                expect(near(mine["delay_s"], way_s, 1e-9 + 1e-9 * way_s), (label, mine, way_s))  # times are of 1 ns
                continue
            heard += 1
            expect(near(mine["gain_db"], link["path_gain_db"]) and mine["los"] == link["los"], (label, mine, link))
            expect(near(mine["delay_s"], min(link["delay_s"]), 1e-9), (label, mine, link["delay_s"]))
            for hz, power in zip((5.895e9, 5.9e9, 5.905e9, 5.915e9), mine["spectrum"]):
                expect(math.isclose(power_at(link, hz), power, rel_tol=1e-6), (label, hz, power_at(link, hz), power))
            # The antenna path of 3GPP has gains relative to that of the link, and no more Doppler shift than the channels.
            for side, powers in ((1, mine["matrix"]), (2, mine["arrays"])):
                for hz, power in zip((5.895e9, 5.9e9, 5.905e9, 5.915e9), powers):
                    expected = power_at(link, hz, side) / 10 ** (link["path_gain_db"] / 10)
                    expect(math.isclose(expected, power, rel_tol=1e-6, abs_tol=1e-9), (label, side, hz, expected, power))
    expect(heard >= 16, f"{heard} links with paths")
    print(f"{heard} links of four nodes as the server has them, at four instants")


def place(k, time_s):
    """The position of vehicle k in the example."""
    way = -90.0 + 18.0 * (k // 2) + SPEED_M_S * time_s
    return (3.0, way) if k % 2 else (way, -3.0)


def corner(server, folder, seconds, *more):
    """The lines of receptions of the example, and what it prints."""
    path = os.path.join(folder, "receptions")
    done = subprocess.run([CORNER, "--server=" + server.name, f"--seconds={seconds}", "--receptions=" + path, *more],
                          check=True, capture_output=True, text=True).stdout
    with open(path, encoding="ascii") as file:
        rows = [line.split() for line in file]
    return {tuple(map(int, row[:3])): (float(row[3]), float(row[4]), int(row[5])) for row in rows}, done.strip()


def arrivals(links):
    """Every beacon arrives whose preamble can be detected, and no other: noise is 15 dB below that, and none overlap."""
    predicted = {key: gain_db + TX_DBM >= THRESHOLD_DBM for key, (gain_db, _, _) in links.items()}
    wrong = [(key, links[key]) for key, arrives in predicted.items() if arrives != (links[key][2] == 1)]
    expect(not wrong, f"{len(wrong)} beacons, such as {wrong[:3]}")
    return sum(predicted.values())


def as_run():
    """Gains of the example are those of `wavetracer run` on a drive through the same places."""
    tracks = "".join(f'[[track]]\nid = "node{k}"\nwaypoints = [[0.0, {x0}, {y0}, 0.0], [0.2, {x1}, {y1}, 0.0]]\n'
                     for k in range(CARS) for (x0, y0), (x1, y1) in [(place(k, 0), place(k, 0.2))])
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "drive.toml")
        with open(path, "w", encoding="ascii") as file:
            file.write(WORLD + "[time]\nstart_s = 0.0\nend_s = 0.2\nstep_s = 0.1\n" + tracks)
        subprocess.run([PROGRAM, "run", "-c", path, "-o", os.path.join(folder, "out")], check=True, capture_output=True)
        with open(os.path.join(folder, "out/links.csv"), encoding="ascii") as file:
            rows = list(csv.DictReader(file))
        with Server(config=WORLD + LIVE) as server:
            links, _ = corner(server, folder, 0.3)
    expect(len(links) == len(rows) == 3 * CARS * (CARS - 1), f"{len(links)} links, {len(rows)} of run")
    heard = 0
    for row in rows:
        key = (round(float(row["time_s"]) / STEP_S), *(int(row[end].removeprefix("node").removesuffix("/roof"))
                                                       for end in ("tx", "rx")))
        gain_db = float(row["path_gain_db"])
        heard += math.isfinite(gain_db)
        expect(near(links[key][0], max(gain_db, -300)), (key, links[key], gain_db))
    expect(heard > 400, f"{heard} links with a path")
    arrivals(links)
    print(f"{heard} gains of three instants as `run` has them, to 1e-9 dB")


def traffic():
    with open(os.path.join(SOURCE, "configs/ns3/corner.toml"), encoding="utf-8") as file:
        config = file.read()
    with tempfile.TemporaryDirectory() as folder, Server(config=config) as server:
        links, said = corner(server, folder, 2)
        arrive = arrivals(links)
        expect(len(links) == 20 * CARS * (CARS - 1) and len(links) / 4 < arrive < 0.95 * len(links), (len(links), arrive))
        expect(said.startswith(f"{arrive} of {len(links)} beacons have arrived; 20 frames of channels took "), said)
        bands, _ = corner(server, folder, 0.3, "--spectrum=1")
        with server.connect() as client:
            client.hello(detail="paths")
            truth = [client.ask(frame(k, k * STEP_S, [vehicle(f"node{n}", *place(n, k * STEP_S), 90 * (n % 2))
                                                      for n in range(CARS)])) for k in range(3)]
    judged = 0
    for step, answer in enumerate(truth):
        for link in answer["links"]:
            key = (step, *(int(link[end].removeprefix("node").removesuffix("/roof")) for end in ("tx", "rx")))
            power = sum(power_at(link, 5.18e9 + 312500 * k) for k in range(-26, 27)) / 53  # carriers of 802.11a
            over_db = 10 * math.log10(power or 1e-30) + TX_DBM - THRESHOLD_DBM
            if abs(over_db) > 0.5:  # edges of its spectrum have less power
                judged += 1
                expect((over_db > 0) == (bands[key][2] == 1), (key, over_db, bands[key]))
    expect(len(bands) == 3 * CARS * (CARS - 1) and judged > 0.9 * len(bands), f"{judged} of {len(bands)}")
    print(said)


def refusals():
    done = subprocess.run([CORNER, "--server=tcp:127.0.0.1:1"], capture_output=True, text=True)
    expect(done.returncode != 0 and "start one with `wavetracer serve" in done.stderr, done)
    with Server(config=WORLD + LIVE) as server:
        done = subprocess.run([CORNER, "--server=" + server.name, "--vehicles=21"], capture_output=True, text=True)
    expect(done.returncode != 0 and "no_place" in done.stderr, done)


def main():
    models()
    as_run()
    traffic()
    refusals()


if __name__ == "__main__":
    sys.exit(main())
