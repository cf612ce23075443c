# SPDX-License-Identifier: Apache-2.0
"""Tests the effect of a message on those that wait: newer frames of a free-running client, times between frames, errors
among them, bye and a closed direction. Every message is answered or counted. Assumes an OpenCL device; how many frames
are skipped depends on it, and no test on how many."""
import json
import socket
import sys

from live_server import POSES, Server, expect, frame, vehicle


def lines_of(*messages):
    return "".join(json.dumps(message) + "\n" for message in messages)


def instant(number, time_s):
    return {"message": "at", "frame": number, "time_s": time_s}


def free_running_instants():
    """Each "at" is answered once and skips no frame; a frame skips the one that waits, but no "at" behind it."""
    with Server(sets=["live.max_pending_frames=2"]) as server, server.connect() as client:
        client.hello(mode="free")
        for step in (1, 2):
            client.ask(frame(step, step, POSES))
        client.send(lines_of(*(instant(10 + k, 1.2 + 0.2 * k) for k in range(5))))
        answers = [client.receive() for _ in range(5)]
        expect([(a["message"], a.get("frame")) for a in answers] == [("channels", 10 + k) for k in range(5)], answers)
        client.send(lines_of(frame(3, 3, POSES), instant(30, 2.5)))
        answers = [client.receive() for _ in range(2)]
        expect([(a["message"], a["frame"], a["skipped"]) for a in answers] ==
               [("channels", 3, 0), ("channels", 30, 0)], answers)
        skipped, last = 0, 3
        for turn in range(20):  # until one was skipped, which the time of a solve decides
            begin = last
            client.send(lines_of(*(message for k in range(1, 6) for message in
                                   (frame(begin + k, begin + k, POSES), instant(100 + begin + k, begin + 0.1)))))
            last += 5
            solved, instants, missed = [], [], 0
            while not solved or solved[-1] != last or len(instants) < 5:
                answer = client.receive()
                if answer["message"] == "error":  # its time was before the last two frames
                    expect(answer["code"] == "out_of_time" and answer["frame"] > 100, answer)
                    instants.append(answer["frame"])
                    continue
                missed += answer["skipped"]
                (instants if answer["frame"] > 100 + begin else solved).append(answer["frame"])
            expect(instants == list(range(101 + begin, 106 + begin)), instants)
            expect(len(solved) + missed == 5 and solved == sorted(solved), (solved, missed))
            skipped += missed
            if skipped:
                break
        expect(skipped > 0, "no frame was ever skipped")
        expect(client.ask(instant(999, last + 1))["code"] == "out_of_time", "later than poses")
    print("free-running: every instant is answered")


def skipped_frames_that_matter():
    """If a skipped frame was to start cold, the next one does; skipped frames are counted where an error comes between.
    """
    sets = ["trace.rays=1000", "trace.refresh_rays=1"]
    still = {"velocity_m_s": [0, 0, 0], "angular_velocity_rad_s": [0, 0, 0]}
    moved = [vehicle("ego", -40, 3, 0, **still), vehicle("other", 30, -3, 0, **still)]
    wrong = [vehicle("ego", 0, 0, kind="truck")]  # is refused by the solver: its type has changed
    with Server(sets=sets) as server, server.connect() as client:
        client.hello(mode="free", detail="paths")
        alone = client.ask(frame(0, 0, moved, cold=True))["links"]
        forgot = counted = False
        for turn in range(1, 60):
            client.ask(frame(3 * turn, 10 * turn, POSES, cold=True))
            warm = client.ask(frame(3 * turn, 10 * turn + 1, moved))["links"]
            expect(warm != alone, "a warm frame differs from a cold one here")
            client.ask(frame(3 * turn, 10 * turn + 2, POSES, cold=True))
            # The second is skipped if the third comes in time.
            client.send(lines_of(frame(1000, 10 * turn + 3, POSES), frame(1001, 10 * turn + 4, moved, cold=True),
                                 frame(1002, 10 * turn + 5, moved)))
            answers = [client.receive()]
            while answers[-1]["frame"] != 1002:
                answers.append(client.receive())
            expect(len(answers) + sum(a["skipped"] for a in answers) == 3, answers)
            if 1001 not in [a["frame"] for a in answers]:
                expect(answers[-1]["links"] == alone, "cold was lost with the frame that had it")
                forgot = True
            client.send(lines_of(frame(1003, 10 * turn + 6, POSES), frame(1004, 10 * turn + 7, POSES),
                                 frame(1005, 10 * turn + 8, wrong)))
            answers = [client.receive()]
            while answers[-1]["frame"] != 1005:
                answers.append(client.receive())
            expect(answers[-1]["code"] == "type_changed", answers[-1])
            before = len(answers) + sum(a.get("skipped", 0) for a in answers)
            after = client.ask(frame(1006, 10 * turn + 9, POSES))
            expect(before + after["skipped"] == 3, f"{before} before, {after['skipped']} after the error")
            counted = counted or after["skipped"] > 0
            if forgot and counted:
                break
        expect(forgot and counted, f"no frame was ever skipped: {forgot}, {counted}")
    print("free-running: what skipped frames ask for and their number are kept")


def leaving():
    """Requests before bye, or before the client closes its direction, are answered."""
    with Server(sets=["live.max_rate_hz=6"]) as server:
        for mode in ("step", "free"):
            with server.connect() as client:
                client.hello(mode=mode)
                client.ask(frame(0, 0, POSES))
                client.send(lines_of(frame(1, 1, POSES), instant(2, 0.5), {"message": "bye"}, frame(3, 3, POSES)))
                answers = [client.receive() for _ in range(3)]
                expect([(a["message"], a.get("frame")) for a in answers] ==
                       [("channels", 1), ("channels", 2), ("bye", None)], answers)
                expect(client.receive() is None, "closed after bye")
        with server.connect() as client:
            client.hello()
            client.send(lines_of(*(frame(k, k, POSES) for k in range(10))))
            client.socket.shutdown(socket.SHUT_WR)
            answers = [client.receive() for _ in range(10)]
            expect([a and a["frame"] for a in answers] == list(range(10)), answers)
            expect(client.receive() is None, "closed once all is answered")
        with server.connect() as client:
            expect(client.ask({"message": "bye"})["message"] == "bye", "bye before hello")
    print("leaving: what was asked for is answered")


def main():
    free_running_instants()
    skipped_frames_that_matter()
    leaving()


if __name__ == "__main__":
    sys.exit(main())
