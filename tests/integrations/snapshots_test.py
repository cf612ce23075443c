# SPDX-License-Identifier: Apache-2.0
"""live_snapshots.hpp, which the module of integrations/inet asks for gains between positions: its gains against answers
of the server in JSON, the number of its questions, instants that have passed, other coordinates, and its errors.
Assumes an OpenCL device."""
import json
import math
import subprocess
import sys

sys.path.insert(0, sys.argv[2] + "/tests/live")
from live_server import Server, expect, frame, vehicle

PROBE = sys.argv[3]
WORLD = """
[scene]
generate = "--seed 1 --blocks 2x2"
[[live_vehicle]]
type = "passenger"
count = 2
[[mount]]
name = "roof"
offset_m = [0.0, 0.0, 1.6]
[[station]]
name = "rsu"
position_m = [8.0, 8.0, 6.0]
[trace]
rays = 3000
max_depth = 1
reuse = false
"""
STATION = [7.0, 9.0, 6.0]  # its place in the simulator, which is not asked about
FAR = [5000.0, 0.0, 0.0]


class Probe:
    def __init__(self, server, keep_s=0.0, gain="path_gain_db"):
        self.process = subprocess.Popen([PROBE, server.name, str(keep_s), gain], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, text=True)

    def ask(self, **command):
        self.process.stdin.write(json.dumps(command) + "\n")
        self.process.stdin.flush()
        return json.loads(self.process.stdout.readline())

    def take(self, time_s, *nodes, **more):
        answer = self.ask(take=time_s, nodes=[*nodes, {"station": "rsu", "at": STATION}], **more)
        expect("error" not in answer, answer)
        return answer

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.stdin.close()
        expect(self.process.wait(timeout=20) == 0, "exit code of the probe")
        self.process.stdout.close()


def node(name, x, y, velocity=(0, 0, 0), ahead=(0, 1, 0)):
    return {"id": name, "at": [x, y, 0], "velocity": list(velocity), "ahead": list(ahead)}


def truth(server, *instants, gain="path_gain_db"):
    """Gains by the ends of links for each instant, from the protocol in JSON; only links with paths."""
    with server.connect() as client:
        client.hello(detail="links")
        answers = [client.ask(frame(k, k, each)) for k, each in enumerate(instants)]
    return [{(link["tx"].removesuffix("/roof"), link["rx"].removesuffix("/roof")): link[gain]
             for link in answer["links"] if link["paths"]} for answer in answers]


def compare(probe, expected, points, **when):
    """Each pair of nodes. The number of questions after it."""
    heard = 0
    for a in points:
        for b in points:
            if a == b:
                continue
            answer = probe.ask(gain=[points[a], points[b]], **when)
            heard += (a, b) in expected
            if (a, b) in expected:
                expect(answer["gain_db"] is not None and math.isclose(answer["gain_db"], expected[a, b], abs_tol=1e-9),
                       (a, b, answer, expected[a, b]))
            else:
                expect(answer["gain_db"] is None, (a, b, answer))
    expect(heard == len(expected) >= 2, f"{heard} of {len(expected)} links with paths")
    return answer["questions"]


def instants(server):
    first, later = truth(server, [vehicle("a", 3, -60, 90), vehicle("b", -3, -30, -90)],
                         [vehicle("a", 3, -57, 90), vehicle("b", -3, -30, -90)])
    expect(abs(first["a", "b"] - later["a", "b"]) > 0.01, "the gains of both instants are the same")
    b = node("b", -3, -30, ahead=(0, -1, 0))
    points = {"a": [3, -60, 0], "b": [-3, -30, 0], "rsu": STATION}
    moved = {**points, "a": [3, -57, 0]}
    with Probe(server) as probe:
        expect(probe.take(0.0, node("a", 3, -60), b) == {"snapshots": 1, "questions": 0}, "take() has asked")
        expect(compare(probe, first, points) == 1, "all pairs of an instant are more than one question")
        expect(probe.take(0.5, node("a", 3, -60), b)["snapshots"] == 1, "nothing has moved")
        expect(compare(probe, first, points, time=0.25) == 1, "an instant between two equal ones has a question")
        expect(probe.take(1.0, node("a", 3, -57), b)["snapshots"] == 2, "a node has moved")
        expect(compare(probe, later, moved) == 2, "the questions after a node has moved")
        # The first instant is still there, by its time and by the position of the node that has moved since.
        expect(compare(probe, first, points, time=0.5) == 2, "an instant that has passed is asked again")
        expect(math.isclose(probe.ask(gain=[[3, -60, 0], points["b"]])["gain_db"], first["a", "b"]), "by position")
        # Both instants have these two points, and the gains differ only by who stands between: the newest is told.
        expect(probe.ask(gain=[points["b"], STATION])["gain_db"] == later["b", "rsu"], "the newest instant")
        for wrong in ({"gain": [[3, -60, 0], points["b"]], "time": 1.0}, {"gain": [[1, 1, 1], points["b"]]},
                      {"gain": [points["b"], points["b"]]}, {"gain": [moved["a"], points["b"]], "time": 0.75},
                      {"gain": [[3, -60, 0], moved["a"]]}):  # one node at two instants
            answer = probe.ask(**wrong)
            expect("no two nodes are known at (" in answer.get("error", ""), answer)
        expect(probe.ask(forget=0.75)["snapshots"] == 1 and probe.ask(forget=9)["snapshots"] == 1, "forget")
        expect("error" in probe.ask(gain=[[3, -60, 0], points["b"]]), "an instant that was given up is told")
        expect(compare(probe, later, moved) == 2, "the last instant was given up")
    print("gains between positions at two instants, each asked once")


def arrivals(server):
    """A node outside of the scene, one that leaves, and one that takes its place."""
    alone, other = truth(server, [vehicle("a", 3, -60, 90)], [vehicle("a", 3, -60, 90), vehicle("c", -3, -20, -90)])
    a, c = node("a", 3, -60), node("c", -3, -20, ahead=(0, -1, 0))
    points = {"a": [3, -60, 0], "rsu": STATION}
    with Probe(server) as probe:
        probe.take(0.0, a, {**node("b", 0, 0), "at": FAR})
        expect(compare(probe, alone, {**points, "b": FAR}) == 1, "a vehicle outside of the scene")
        probe.take(0.0, a)  # the same time
        compare(probe, alone, points)
        probe.take(0.1, a, c)
        expect(compare(probe, other, {**points, "c": [-3, -20, 0]}) == 3, "a vehicle that came")
        # A signal that was sent before c came, from a place that a has left since: between both, as c finds them.
        probe.take(0.15, a)
        probe.take(0.16, node("a", 3, -57), c)
        late = probe.ask(gain=[points["a"], [-3, -20, 0]], time=0.15)["gain_db"]
        expect(late == probe.ask(gain=[[3, -57, 0], [-3, -20, 0]], time=0.16)["gain_db"], late)
        expect(late is not None and abs(late - other["a", "c"]) > 0.01, (late, other["a", "c"]))
        for wrong, text in (({"type": "tank"}, "no [[live_vehicle]] of type"), ({"mount": "hook"}, "add a [[mount]]")):
            answer = probe.ask(take=0.2, nodes=[{**a, **wrong}])
            expect(text in answer.get("error", ""), answer)
        answer = probe.ask(take=0.2, nodes=[{"station": "mast", "at": STATION}])
        expect("no fixed antenna" in answer.get("error", ""), answer)
        probe.take(0.3, a, c, node("d", -3, -40))  # three vehicles for two places
        answer = probe.ask(gain=[points["a"], STATION], time=0.3)
        expect("no_place" in answer.get("error", ""), answer)
    print("vehicles that are outside, leave and come")


def kept(server):
    """keep_s: channels stay, and the positions by which they are asked for are the new ones."""
    first, later = truth(server, [vehicle("a", 3, -60, 90)], [vehicle("a", 3, -45, 90)], gain="narrowband_gain_db")
    with Probe(server, keep_s=0.1, gain="narrowband_gain_db") as probe:
        for time_s, y, gains, questions in ((0, -60, first, 1), (0.05, -50, first, 1), (0.09375, -47, first, 1),
                                            (0.125, -45, later, 2)):
            probe.take(time_s, node("a", 3, y, (0, 200, 0)))
            expect(compare(probe, gains, {"a": [3, y, 0], "rsu": STATION}) == questions, (time_s, questions))
    print("channels that are kept for a while")


def coordinates(server):
    """Axes whose y grows southwards, with another origin, and positions of front bumpers, as SUMO has them."""
    with server.connect() as client:
        length_m = client.hello()["types"][0]["length_m"]
    gains, = truth(server, [vehicle("a", 3, -60, 90), vehicle("b", -8, -3, 180)])
    half = length_m / 2
    # In the simulator x is that of the scene + 500, and y is 400 - y.
    a = {**node("a", 503, 400 - (-60 + half), ahead=(0, -1, 0))}
    b = {**node("b", 492 - half, 403, ahead=(-1, 0, 0))}
    with Probe(server) as probe:
        probe.take(0.0, a, b, coordinates={"offset": [-500, 400, 0], "mirror_y": True, "is_front": True})
        for pair, points in ((("a", "b"), (a["at"], b["at"])), (("b", "rsu"), (b["at"], STATION))):
            answer = probe.ask(gain=points)
            expect(math.isclose(answer["gain_db"], gains[pair], abs_tol=1e-6), (pair, answer, gains[pair]))
        # Free space by the rule of ITU-R P.525: 32.4 dB + 20 lg MHz + 20 lg km.
        gain_db = 10 * math.log10(probe.ask(free_space=[299792458 / 5.9e9, 250.0])["gain"])
        expect(abs(gain_db + 32.4 + 20 * math.log10(5900) + 20 * math.log10(0.25)) < 0.1, gain_db)
        expect(probe.ask(free_space=[0.05, 0.0])["gain"] == 1, "no distance")
    print("coordinates of Veins and positions of SUMO")


with Server(config=WORLD) as it:
    instants(it)
    arrivals(it)
    kept(it)
    coordinates(it)
