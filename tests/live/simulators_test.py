# SPDX-License-Identifier: Apache-2.0
"""Simulators that die, restart, run ahead and send old times: nothing stale is answered, and others are served as
docs/live.md says.
Assumes an OpenCL device."""
import json
import socket
import struct
import sys

from live_server import Server, expect, frame, vehicle
from van3twin_client import Van3twinClient


def poses(step):
    """No velocities: the server takes them from the last two poses."""
    return [vehicle("ego", 3, -60 + 1.4 * step, 90), vehicle("other", -3, -20 - 1.4 * step, -90)]


def run(client, steps=4):
    """Every frame is cold, so that it depends on its own message alone, but for the velocities."""
    return [client.ask(frame(k, k / 10, poses(k), cold=True))["links"] for k in range(steps)]


def shifts(links):
    return [shift for link in links for shift in link["doppler_hz"]]


def dies_and_restarts():
    """The connection breaks in the middle of a message; the next run has the same vehicles, and its time begins again."""
    with Server(sets=["live.max_clients=2"]) as server, server.connect() as witness:
        witness.hello(detail="paths")
        truth = run(witness)
        expect(not any(shifts(truth[0])) and any(shifts(truth[1])), "velocities come with the second frame")
        for life in range(4):
            client = server.connect()
            expect(client.hello(detail="paths")["message"] == "world", f"life {life}: it is let in")
            early = client.ask({"message": "at", "frame": 9, "time_s": 0.05})
            expect(early["code"] == "out_of_time", f"life {life}: poses of the run before: {early}")
            expect(run(client) == truth, f"life {life}: another run has other answers")
            client.bytes(json.dumps(frame(9, 0.9, poses(9))).encode()[:-20])
            client.socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))  # as a reset
            client.close()
            expect(witness.ask(frame(9, 0.9, poses(3), cold=True))["message"] == "channels", "the witness is served")
    print("a simulator that dies and restarts")


def runs_ahead():
    """It sends all frames at once, and reads no answer before; each answer is that of its own frame, in order."""
    with Server(sets=["live.max_pending_frames=3"]) as server, server.connect() as slow, server.connect() as fast:
        slow.hello(detail="paths")
        fast.hello(detail="paths")
        truth = run(slow, 12)
        fast.send("".join(json.dumps(frame(k, k / 10, poses(k), cold=True)) + "\n" for k in range(12)))
        expect(slow.ask(frame(99, 99, poses(0), cold=True))["message"] == "channels", "the other one is served meanwhile")
        answers = [fast.receive() for _ in range(12)]
        expect([a["frame"] for a in answers] == list(range(12)), [a["frame"] for a in answers])
        expect([a["links"] for a in answers] == truth, "an answer is that of another frame")
        for time_s in (1.1001, 5):  # the server does not predict
            expect(fast.ask({"message": "at", "frame": 13, "time_s": time_s})["code"] == "out_of_time", time_s)
    print("a simulator that runs ahead")


def sends_old_times():
    """A frame counts by its order and not by its time: the newest message has the poses, and no velocity goes backwards
    in time."""
    with Server() as server, server.connect() as client:
        client.hello(detail="paths")
        truth = run(client)
        for time_s in (0.3, 0.1, -5):  # the same time, and earlier ones
            answer = client.ask(frame(5, time_s, poses(0), cold=True))
            expect(answer["time_s"] == time_s and not any(shifts(answer["links"])), answer)
            expect(answer["links"] == truth[0], "the poses of the message, and none of before")
        late = client.ask({"message": "at", "frame": 6, "time_s": 0.2})  # between frames 2 and 3, which have passed
        expect(late["code"] == "out_of_time", late)
        client.ask(frame(7, -4.9, poses(1)))
        between = client.ask({"message": "at", "frame": 8, "time_s": -4.95})
        expect(between["message"] == "channels" and any(shifts(between["links"])), between)
    print("a simulator that sends old times")


def van3twin():
    """It dies without a word; the next run comes from another port, and sees nothing of the vehicles before."""
    with Server("udp:127.0.0.1:0", more=["--protocol", "van3twin"]) as server:
        for life in range(3):
            with Van3twinClient(server.name) as client:
                expect(client.figure("PATHGAIN", "veh1", "veh2") == "300", f"life {life}: vehicles of the run before")
                client.move("veh1", 3, -60)
                client.move("veh2", -3, -30, 0, 180)
                expect(float(client.figure("PATHGAIN", "veh1", "veh2")) < 120, "both are there")
        expect(server.end() == 0, server.log)
    print("VaN3Twin that dies and restarts")


def main():
    dies_and_restarts()
    runs_ahead()
    sends_old_times()
    van3twin()


if __name__ == "__main__":
    sys.exit(main())
