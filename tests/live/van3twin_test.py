# SPDX-License-Identifier: Apache-2.0
"""`wavetracer serve --protocol van3twin` with clients that speak as VaN3Twin's modules do: figures of links against those
that the same world has in the other protocol, vehicles that come and leave, and datagrams as they should not be.
Assumes an OpenCL device.

usage: van3twin_test.py PROGRAM SOURCE [DATAGRAMS [SEED]]
With DATAGRAMS, for example 1000000, it sends only so many datagrams as they should not be; without, 4000 of them."""
import math
import random
import socket
import subprocess
import sys
import tempfile
import time

from live_server import PROGRAM, Server, expect, frame
from van3twin_client import Van3twinClient

WORLD = """
[scene]
generate = "--seed 1 --blocks 2x2"
[[live_vehicle]]
type = "passenger"
count = 5
[[mount]]
name = "roof"
offset_m = [0.0, 0.0, 1.6]
[trace]
rays = 3000
max_depth = 2
reuse = false
"""
VAN3TWIN = ("--protocol", "van3twin")
CARS = {"veh1": (3.0, -60.0, 0.0), "veh2": (-3.0, -30.0, 180.0), "veh3": (60.0, -3.0, 90.0), "obj4": (-50.0, 3.0, 270.0)}


def serving(*more, sets=()):
    return Server("udp:127.0.0.1:0", config=WORLD, more=(*VAN3TWIN, *more), sets=sets)


def memory_kb(server):
    with open(f"/proc/{server.process.pid}/status", encoding="ascii") as file:
        return next(int(line.split()[1]) for line in file if line.startswith("VmRSS"))


def truth(cars, front=True):
    """Links of the same world in the other protocol. Positions are those of front bumpers, bearings clockwise from
    north."""
    with Server(config=WORLD) as server, server.connect() as client:
        length_m = client.hello(detail="paths")["types"][0]["length_m"]
        vehicles = []
        for name, (x, y, bearing_deg) in cars.items():
            back = length_m / 2 * front
            angle = math.radians(bearing_deg)
            vehicles.append({"id": name, "type": "passenger", "yaw_deg": 90 - bearing_deg,
                             "position_m": [x - back * math.sin(angle), y - back * math.cos(angle), 0]})
        answer = client.ask(frame(0, 0, vehicles))
    return {(link["tx"].removesuffix("/roof"), link["rx"].removesuffix("/roof")): link for link in answer["links"]}


def compare(client, links, gain="narrowband_gain_db"):
    heard = 0
    for (a, b), link in links.items():
        loss_db, delay_s = float(client.figure("PATHGAIN", a, b)), float(client.figure("DELAY", a, b))
        los = client.figure("LOS", a, b)
        expect(los == ("[True]" if link["los"] else "[False]"), (a, b, los, link))
        if not link["paths"]:
            expect(loss_db == 300 and delay_s == 1e5, (a, b, loss_db, delay_s))
            continue
        heard += 1
        expect(math.isclose(loss_db, -link[gain], abs_tol=1e-9), (a, b, loss_db, link[gain]))
        expect(math.isclose(delay_s, min(link["delay_s"]), rel_tol=1e-12), (a, b, delay_s))
    expect(len(links) == 12 and 4 <= heard, f"{heard} of {len(links)} links have paths")
    return heard


def place(client, cars, offset=(0, 0, 0)):
    for name, (x, y, bearing_deg) in cars.items():
        client.move(name, x - offset[0], y - offset[1], -offset[2], bearing_deg, (1.5, -2.5, 0))


def figures():
    links = truth(CARS)
    moved = {**CARS, "veh1": (3.0, -40.0, 0.0)}
    with serving() as server, Van3twinClient(server.name) as client:
        # Nodes wait at the origin before they take part, and are asked about, too.
        for a, b in (("0", "0"), ("", ""), ("0", "veh1"), ("veh1", "")):
            expect([client.figure(kind, a, b) for kind in ("PATHGAIN", "DELAY", "LOS")] == ["0", "0", "0"], (a, b))
        place(client, CARS)
        heard = compare(client, links)
        client.move("veh1", *moved["veh1"][:2], 0.0, moved["veh1"][2])
        compare(client, truth(moved))
        expect(client.figure("PATHGAIN", "veh1", "veh9") == "300", "a vehicle that was never placed")
        # Another client has its own vehicles with the same ids.
        with Van3twinClient(server.name) as other:
            expect(other.figure("PATHGAIN", "veh1", "veh2") == "300", "nothing of another client's vehicles")
            place(other, CARS)
            compare(other, links)
        # A shut-down ends the client, and not the server.
        client.send("SHUTDOWN_SIONNA")
        expect(client.figure("PATHGAIN", "veh1", "veh2") == "300", "forgotten after the shut-down")
        place(client, CARS)
        compare(client, links)
        expect(server.process.poll() is None, server.log)
    with serving("--offset", "100", "-50", "-1.5", "--position", "middle", "--gain", "path") as server:
        with Van3twinClient(server.name) as client:
            place(client, CARS, (100, -50, -1.5))
            compare(client, truth(CARS, front=False), "path_gain_db")
    print(f"{heard} of {len(links)} links as in the other protocol, with offsets, two clients, and after a shut-down")


def coming_and_leaving():
    """Six cars and five places; then two do not come back."""
    with serving() as server, Van3twinClient(server.name) as client:
        row = {f"veh{k}": (3.0, -80.0 + 10 * k, 0.0) for k in range(6)}
        place(client, row)
        expect(float(client.figure("PATHGAIN", "veh0", "veh4")) < 200, "both have places")
        expect(client.figure("PATHGAIN", "veh0", "veh5") == "300", "no place is left")
        for _ in range(4):
            place(client, {name: row[name] for name in ("veh2", "veh3", "veh4", "veh5")})
        expect(client.figure("PATHGAIN", "veh2", "veh0") == "300", "it has left")
        expect(float(client.figure("PATHGAIN", "veh2", "veh5")) < 200, "it has the place of one that left")
        client.move("veh5", 5000, 0)
        expect(client.figure("LOS", "veh2", "veh5") == "[False]", "outside of the scene")
        expect(any("vehicle veh5 is left out" in line for line in server.log), server.log)
    print("vehicles without a place, that leave, and outside of the scene")


def ahead(rounds=20):
    """A frame that is computed before it is asked for is that of the last poses, and never of others."""
    links = truth(CARS)
    with serving() as server, Van3twinClient(server.name) as client:
        aside = {name: (x, y - 7, bearing_deg) for name, (x, y, bearing_deg) in CARS.items()}
        names = list(CARS)
        place(client, aside)
        for _ in range(rounds):
            client.figure("LOS", names[0], names[1])  # a client that asks
            place(client, CARS)
            time.sleep(0.05)  # the server computes this frame meanwhile
            compare(client, links)
            place(client, aside)
            time.sleep(0.05)
        place(client, CARS)  # the frame before was computed, and is that of other poses
        compare(client, links)
        expect(server.end() == 0, server.log)
        line = next(line for line in server.log if "before they were asked for" in line)
        frames, early = int(line.split(" frames")[0].split()[-1]), int(line.split(" of them")[0].split()[-1])
        expect(frames >= rounds and 0 < early < frames, line)
    print(f"{early} of {frames} frames were computed before they were asked for")


def mutated(generator):
    """A valid datagram with a few bytes changed, cut, doubled or put in; or bytes that are all random."""
    if generator.random() < 0.2:
        return generator.randbytes(generator.randrange(0, 1500))
    data = bytearray(generator.choice([
        b"LOC_UPDATE:veh1,1.000000,-2.000000,0.000000,90.000000,0.000000,1.000000,0.000000",
        b"CALC_REQUEST_PATHGAIN:veh1,veh2", b"CALC_REQUEST_DELAY:veh1,veh2", b"CALC_REQUEST_LOS:,veh2",
        b"LOC_UPDATE:veh%d,3.0,-60,0,0,0,0,0" % generator.randrange(10**9), b"SHUTDOWN_SIONNA"]))
    for _ in range(generator.randrange(4)):
        at = generator.randrange(len(data) + 1)
        data[at:at + generator.randrange(3)] = generator.randbytes(generator.randrange(4))
    return bytes(data)


def hostile(count=4000, seed=7):
    """Datagrams of enemies, from many ports; another client gets the right answers all the while."""
    generator = random.Random(seed)
    links = truth(CARS)
    with serving(sets=["live.max_clients=3"]) as server, Van3twinClient(server.name) as client:
        place(client, CARS)
        compare(client, links)
        began, enemies = time.monotonic(), [Van3twinClient(server.name) for _ in range(20)]
        before_kb = None
        for k in range(count):
            enemies[k % len(enemies)].send(mutated(generator))
            if k % 100 == 0:
                expect(float(client.figure("PATHGAIN", "veh1", "veh2")) < 200, f"served after {k} datagrams")
            if k == count // 4:
                before_kb = memory_kb(server)
        compare(client, links)
        grown_kb = memory_kb(server) - before_kb
        for each in enemies:
            each.close()
        expect(grown_kb < 20000, f"{grown_kb} kB more memory")
        expect(server.end() == 0, server.log)
        expect(any("were no messages of the protocol" in line for line in server.log), server.log)
        most = 100 + 11 * (time.monotonic() - began)  # ten lines per second, and their count
        expect(len(server.log) < most, f"{len(server.log)} lines of log")
    print(f"{count} random and mutated datagrams of 20 ports (seed {seed}): the other client has the right answers, "
          f"{grown_kb} kB more memory after three quarters of them")


def too_many_clients():
    with serving(sets=["live.max_clients=2"]) as server:
        clients = [Van3twinClient(server.name, timeout_s=1) for _ in range(3)]
        for client in clients[:2]:
            place(client, CARS)
        try:
            place(clients[2], CARS)
            raise SystemExit("failed: a third client was served")
        except socket.timeout:
            pass
        clients[0].send("SHUTDOWN_SIONNA")
        place(clients[2], CARS)
        for client in clients:
            client.close()
    print("a third client has to wait for a place")


def comes_and_leaves_often(count=300):
    """A client that fills the log: no line is lost in silence, and few are written."""
    with serving() as server, Van3twinClient(server.name) as client:
        for _ in range(count):
            client.move("veh1", 3, -60)
            client.send("SHUTDOWN_SIONNA")
        expect(client.figure("PATHGAIN", "veh1", "veh2") == "300", "nobody is left")
        expect(server.end() == 0, server.log)
        lines = [line for line in server.log if " came" in line or " left" in line and "left out" not in line]
        left_out = sum(int(line.split(" more lines")[0].split()[-1]) for line in server.log if " more lines" in line)
        expect(len(lines) + left_out == 2 * count, f"{len(lines)} lines and {left_out} left out")
        expect(10 <= len(lines) <= 100 and left_out > count, f"{len(lines)} lines of log")
    print(f"{count} times a client comes and leaves: {len(lines)} lines of log, {left_out} counted")


def refusals():
    def refused(text, *arguments):
        with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
            file.write(WORLD)
            file.flush()
            done = subprocess.run([PROGRAM, "serve", "-c", file.name, *arguments], capture_output=True, text=True)
        expect(done.returncode == 2 and text in done.stderr, (arguments, done))

    refused("give udp:ADDRESS:PORT", *VAN3TWIN, "--listen", "tcp:127.0.0.1:0")
    refused("only --protocol van3twin takes datagrams", "--listen", "udp:127.0.0.1:0")
    refused("give --peer ADDRESS", *VAN3TWIN, "--listen", "udp:0.0.0.0:0")
    refused("has no secret", *VAN3TWIN, "--listen", "udp:127.0.0.1:0", "--token-file", "/dev/null")
    with serving("--peer", "127.0.0.2") as server, Van3twinClient(server.name, timeout_s=0.5) as client:
        try:
            client.move("veh1", 3, -60)
            raise SystemExit("failed: another address than --peer was answered")
        except socket.timeout:
            pass
    print("addresses that are refused")


def latency(steps=10):
    with serving() as server, Van3twinClient(server.name) as client:
        seconds = []
        for step in range(steps):
            for name, (x, y, bearing_deg) in CARS.items():
                client.move(name, x, y + 0.1 * step, 0.0, bearing_deg)
            for a in CARS:
                for b in CARS:
                    if a != b:
                        began = time.perf_counter()
                        client.figure("PATHGAIN", a, b)
                        seconds.append(time.perf_counter() - began)
    seconds.sort()
    print(f"{len(seconds)} questions: p50 {1e3 * seconds[len(seconds) // 2]:.2f} ms, "
          f"p99 {1e3 * seconds[int(0.99 * len(seconds))]:.2f} ms")


def main():
    if len(sys.argv) > 3:
        hostile(int(sys.argv[3]), int(sys.argv[4]) if len(sys.argv) > 4 else 7)
        return
    figures()
    coming_and_leaving()
    ahead()
    hostile()
    too_many_clients()
    comes_and_leaves_often()
    refusals()
    latency()


if __name__ == "__main__":
    sys.exit(main())
