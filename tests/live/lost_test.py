# SPDX-License-Identifier: Apache-2.0
"""The clients in Python and C++ where something goes wrong: no server, servers that are silent, slow, killed and started
again, or that answer another question. Both must say the same, and never return the answer to another question.
The fake servers of this test know the protocol and no radio. Assumes an OpenCL device for the servers that are real."""
import json
import os
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time

from live_server import SOURCE, Server, expect, frame, vehicle

sys.path.insert(0, os.path.join(SOURCE, "python"))
try:
    import numpy
except ImportError:
    print("skipped: no NumPy (Debian: python3-numpy)")
    sys.exit(77)
from wavetracer.live import LiveClient, LiveError

PROBE = sys.argv[3]
CONFIG = """
[scene]
generate = "--seed 1 --blocks 2x2"
[[transmitter]]
name = "rsu"
position_m = [8.0, 8.0, 6.0]
[[live_vehicle]]
type = "passenger"
count = 1
[[mount]]
name = "roof"
offset_m = [0.0, 0.0, 1.6]
[trace]
rays = 5000
max_depth = 2
reuse = false
"""


def car(time_s):
    return vehicle("ego", 3, -60 + 10 * time_s, 90, velocity_m_s=[0, 10, 0])


class PythonClient:
    """wavetracer.live, with the answers of the probe."""

    def __init__(self, server, timeout_s, retries):
        try:
            self.client, self.first = LiveClient(server, timeout_s=timeout_s, retries=retries), None
        except LiveError as error:
            self.client, self.first = None, {"reason": error.reason, "text": str(error)}

    def ask(self, question):
        kind, *times = question.split()
        times = [float(each) for each in times]
        try:
            instants = self.client.at_each(times) if kind == "at" else [self.client.channels(times[0], [car(times[0])])]
        except LiveError as error:
            return {"reason": error.reason, "text": str(error)}
        return {"connections": self.client.connections, "instants": [
            {"time_s": each.time_s, "names": [list(each.names(k)) for k in range(len(each))],
             "path_gain_db": each.links["path_gain_db"].tolist()} for each in instants]}

    def end(self):
        if self.client:
            self.client.close()


class CppClient:
    """The probe: the client in C++."""

    def __init__(self, server, timeout_s, retries):
        self.process = subprocess.Popen([PROBE, server, str(timeout_s), str(retries)], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, text=True)
        self.first = json.loads(self.process.stdout.readline())
        self.first = None if "world" in self.first else self.first

    def ask(self, question):
        self.process.stdin.write(question + "\n")
        self.process.stdin.flush()
        return json.loads(self.process.stdout.readline())

    def end(self):
        self.process.communicate()


KINDS = (PythonClient, CppClient)


def columns(gain_db):
    """One link from "t" to "r" in CBOR, written by hand."""
    def text(value):
        return bytes([0x60 + len(value)]) + value.encode()

    def typed(tag, data):
        return bytes([0xd8, tag, 0x40 + len(data)]) + data

    names = text("transmitters") + b"\x81" + text("t") + text("receivers") + b"\x81" + text("r")
    links = b"".join(text(key) + typed(70, struct.pack("<I", value)) for key, value in (("tx", 0), ("rx", 0), ("paths", 1)))
    links += text("los") + typed(64, b"\x01") + text("path_gain_db") + typed(86, struct.pack("<d", gain_db))
    return b"\xa3" + names + text("links") + b"\xa5" + links


def answer(number, gain_db):
    data = columns(gain_db)
    return json.dumps({"message": "channels", "frame": number, "time_s": 1.0, "rx_ports": 1, "tx_ports": 1,
                       "bytes": len(data)}).encode() + b"\n" + data


class Fake:
    """Answers hello, then calls act(connection number, question, socket) for each line; it returns False to hang up."""

    def __init__(self, act):
        self.act, self.accepted = act, 0
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.name = f"tcp:127.0.0.1:{self.listener.getsockname()[1]}"
        threading.Thread(target=self.accept, daemon=True).start()

    def accept(self):
        while True:
            try:
                one, _ = self.listener.accept()
            except OSError:
                return
            self.accepted += 1
            threading.Thread(target=self.serve, args=(self.accepted, one), daemon=True).start()

    def serve(self, number, one):
        world = {"message": "world", "limits": {"max_pending_frames": 4}}
        try:
            for line in one.makefile("rb"):
                question = json.loads(line)
                if question["message"] == "hello":
                    one.sendall(json.dumps(world).encode() + b"\n")
                elif not self.act(number, question, one):
                    break
        except OSError:
            pass
        one.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.listener.close()


def with_both(make, questions, timeout_s=0.4, retries=1):
    """The answers of both clients to questions, each with a fake server of its own; they must say the same."""
    said = []
    for kind in KINDS:
        with Fake(make()) as fake:
            client = kind(fake.name, timeout_s, retries)
            answers = [client.ask(question) for question in questions] if client.first is None else [client.first]
            client.end()
            said.append(json.loads(json.dumps(answers).replace(fake.name, "SERVER")))
            said[-1].append(fake.accepted)
    expect(said[0] == said[1], f"Python and C++ say the same: {said}")
    return said[0]


def no_server():
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
    for name in (f"tcp:127.0.0.1:{port}", "unix:/nowhere/at/all.sock"):
        for kind in KINDS:
            first = kind(name, 1, 3).first
            expect(first and first["reason"] == "no_server", first)
            expect(f"start one with `wavetracer serve -c configs/live.toml --listen {name}`" in first["text"], first)
    for wrong in ("127.0.0.1:7710", "tcp:7710", "tcp:host:port", "unix:"):
        try:
            LiveClient(wrong)
            raise SystemExit(f"failed: {wrong} was taken")
        except ValueError as error:
            expect("is neither tcp:ADDRESS:PORT nor unix:PATH" in str(error), error)


def silent_servers():
    """The first connection gets no answer, or one that is late or never complete; the second one is answered."""
    def silent(number, question, one):
        if number > 1:
            one.sendall(answer(question["frame"], -80.0))
        return True

    def late(number, question, one):
        if number == 1:
            time.sleep(0.8)
            one.sendall(answer(question["frame"], -33.0))
        else:
            one.sendall(answer(question["frame"], -80.0))
        return True

    def drops(number, question, one):
        if number > 1:
            one.sendall(answer(question["frame"], -80.0))
            return True
        for byte in answer(question["frame"], -33.0):
            one.sendall(bytes([byte]))
            time.sleep(0.02)
        return True

    for act in (silent, late, drops):
        began = time.monotonic()
        first, second, connections = with_both(lambda: act, ["frame 0", "frame 1"])
        expect(time.monotonic() - began < 8, f"{act.__name__} ended in time")
        expect(first["reason"] == "no_answer" and "has not answered within 0.4 s" in first["text"], first)
        expect(second["instants"][0]["path_gain_db"] == [-80.0] and connections == 2, second)


def other_answers():
    """The answer to another question, something that is no answer, and columns that are cut short."""
    def stale(number, question, one):
        one.sendall(answer(question["frame"] - 1, -33.0))
        return True

    def garbage(number, question, one):
        one.sendall(b"HTTP/1.1 400 Bad Request\n")
        return True

    def cut(number, question, one):
        data = columns(-33.0)[:-3]
        one.sendall(json.dumps({"message": "channels", "frame": question["frame"], "time_s": 0, "rx_ports": 1,
                                "tx_ports": 1, "bytes": len(data)}).encode() + b"\n" + data)
        return True

    def doubled(number, question, one):  # a second answer to the same question must not become that of the next one
        one.sendall(answer(question["frame"], -80.0) + answer(question["frame"], -33.0))
        return True

    expect(with_both(lambda: stale, ["frame 0"])[0]["reason"] == "stale", "an answer to an older question")
    for act in (garbage, cut):
        for kind in KINDS:
            with Fake(act) as fake:
                client = kind(fake.name, 2, 0)
                expect(client.ask("frame 0")["reason"] == "unreadable", act.__name__)
                client.end()
    first, second, *_ = with_both(lambda: doubled, ["frame 0", "frame 1"])
    expect(first["instants"][0]["path_gain_db"] == [-80.0] and second["reason"] == "stale", (first, second))


def hanging_up():
    """Connections that end in the middle of six instants: what was answered is kept, the rest is asked again."""
    def make():
        asked = []

        def act(number, question, one):
            asked.append(question["message"])
            if number == 1 and asked.count("at") == 3:
                return False
            one.sendall(answer(question["frame"], -question["time_s"]))
            return True
        return act

    def never(number, question, one):
        return False

    def idle(number, question, one):  # as a server ends a connection that was silent for live.idle_timeout_s
        if number > 1:
            one.sendall(answer(question["frame"], -80.0))
            return True
        one.sendall(json.dumps({"message": "error", "code": "timeout", "fatal": True, "text": "silent"}).encode() + b"\n")
        return False

    *_, instants, connections = with_both(make, ["frame 1", "frame 2", "at 1 1.2 1.4 1.6 1.8 2"])
    gains = [each["path_gain_db"] for each in instants["instants"]]
    expect(gains == [[-1.0], [-1.2], [-1.4], [-1.6], [-1.8], [-2.0]] and connections == 2, (gains, connections))
    lost, connections = with_both(lambda: never, ["frame 0"], retries=3)
    expect(lost["reason"] == "lost" and "3 tries to connect again have failed" in lost["text"], lost)
    expect(connections == 4, connections)
    once, connections = with_both(lambda: idle, ["frame 0"])
    expect(once["instants"][0]["path_gain_db"] == [-80.0] and connections == 2, (once, connections))


def killed_server():
    """A server is killed between two frames and started again: the channels are those of a server that was not."""
    with Server(config=CONFIG) as server, server.connect() as client:
        client.hello()
        truth = [client.ask(frame(k, time_s, [car(time_s)])) for k, time_s in enumerate((0.0, 0.1, 0.2))]
        truth.append(client.ask({"message": "at", "frame": 9, "time_s": 0.15}))
        gains = [[link["path_gain_db"] for link in each["links"]] for each in truth]
    for kind in KINDS:
        with tempfile.TemporaryDirectory() as folder:
            name = f"unix:{folder}/live.sock"
            server = Server(name, config=CONFIG)
            client = kind(name, 20, 12)
            first = [client.ask("frame 0"), client.ask("frame 0.1")]
            server.end(9)
            again = []
            waiting = threading.Thread(target=lambda: again.append(client.ask("frame 0.2")))
            waiting.start()
            time.sleep(0.3)
            with Server(name, config=CONFIG) as server:
                waiting.join()
                between = client.ask("at 0.15")
                refused = client.ask("at 0.5")
                after = client.ask("at 0.15")
                many = client.ask("at " + " ".join(["0.15"] * 20))
            client.end()
        answers = [*first, *again, between]
        expect([each["instants"][0]["path_gain_db"] for each in answers] == gains, (answers, gains))
        expect([each["connections"] for each in answers] == [1, 1, 2, 2], answers)
        expect(refused["reason"] == "out_of_time", refused)
        expect(after["connections"] == 2 and after["instants"] == between["instants"], "a refusal costs no connection")
        expect(many["instants"] == 20 * between["instants"], "twenty instants at once")


def main():
    no_server()
    silent_servers()
    other_answers()
    hanging_up()
    killed_server()
    print("clients in Python and C++: no server, silent, slow, killed, and other answers")


if __name__ == "__main__":
    sys.exit(main())
