# SPDX-License-Identifier: Apache-2.0
"""Clients as they should not be: each is refused or dropped as docs/live.md says, and the server goes on.
Assumes an OpenCL device."""
import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time

from live_server import Server, expect, frame, vehicle


def alive(server):
    with server.connect() as client:
        expect(client.hello()["message"] == "world", "a new client is welcome")
        answer = client.ask(frame(1, 0, [vehicle("a", 0, -40)]))
        expect(answer["message"] == "channels" and len(answer["links"]) == 1, answer)


def welcome(server, seconds=60):
    """A client that was let in: tried again while the server has not noticed yet who has left, or gave it no time."""
    end = time.monotonic() + seconds
    while True:
        client = server.connect()
        try:
            if client.hello()["message"] == "world":
                return client
        except (OSError, TypeError):  # closed before it was answered
            pass
        client.close()
        expect(time.monotonic() < end, f"no client is welcome for {seconds} s")


def ends_with(client, code):
    answer = client.receive()
    expect(answer and answer["message"] == "error" and answer["code"] == code and answer["fatal"], f"{code}: {answer}")
    expect(client.receive() is None, f"closed after {code}")


def refused(server, line, code):
    with server.connect() as client:
        client.hello()
        client.send(line if isinstance(line, (str, bytes)) else json.dumps(line) + "\n")
        answer = client.receive()
        expect(answer["message"] == "error" and answer["code"] == code and not answer["fatal"], f"{line}: {answer}")
        expect(client.ask(frame(1, 0, []))["message"] == "channels", f"goes on after {code}")


def wrong_messages(server):
    one = vehicle("a", 0, -40)
    refused(server, "{\n", "bad_json")
    refused(server, "[" * 3000 + "\n", "bad_json")
    refused(server, json.dumps(frame(1, 0, [one])).replace("-40", "1e999") + "\n", "bad_json")
    refused(server, json.dumps(frame(1, 0, [one])).replace("-40", "NaN") + "\n", "bad_json")
    refused(server, frame(1, 0, [vehicle("a", 1e6, 0)]), "out_of_bounds")
    refused(server, frame(1, 0, [vehicle("a", 1e200, 0)]), "bad_value")
    refused(server, frame(1, 0, [one, one]), "duplicate_id")
    refused(server, frame(1, 0, [one], file="/etc/passwd"), "unknown_key")
    refused(server, frame(1, 0, [vehicle(str(k), 0, -40) for k in range(6)]), "no_place")
    refused(server, frame(1, 0, [vehicle(str(k), 0, 10 * k) for k in range(5)]), "no_place")
    refused(server, {"message": "hello", "protocol": 1}, "unexpected")
    with server.connect() as client:
        client.bytes(b"\xff\xfe\x00" * 1000 + b"\n")
        ends_with(client, "bad_json")
    with server.connect() as client:
        client.send(frame(1, 0, []))
        ends_with(client, "hello_first")
    with server.connect() as client:
        client.send({"message": "hello", "protocol": 2})
        ends_with(client, "protocol")
    with server.connect() as client:
        client.hello()
        client.bytes(b"x" * 5000)  # max_message_bytes is 4096 here
        ends_with(client, "too_long")
    with server.connect() as client:
        client.hello()
        client.bytes(b"{}\n" * 100)
        for _ in range(99):
            answer = client.receive()
            expect(answer["code"] == "missing_key", answer)
        ends_with(client, "too_many_errors")


def time_outs():
    """Each in a time of its own, which is too short for anything else: a slow machine would meet it everywhere."""
    limits = ["live.message_timeout_s=1", "live.hello_timeout_s=1", "live.idle_timeout_s=2"]
    with Server(sets=limits) as server:
        start = time.monotonic()
        with server.connect() as silent:
            ends_with(silent, "timeout")
        expect(time.monotonic() - start > 0.5, "silent until hello_timeout_s")
        with welcome(server) as partial, welcome(server) as idle:
            try:
                partial.bytes(b'{"message":')
                for _ in range(4):  # a byte now and then does not help
                    time.sleep(0.1)
                    partial.bytes(b" ")
            except OSError:
                pass  # its time is over already
            ends_with(partial, "timeout")
            ends_with(idle, "timeout")
        expect(server.end() == 0, f"exit code; {server.log[-3:]}")


def crowd(server):
    clients = [server.connect() for _ in range(4)]
    for client in clients:
        client.hello()
    with server.connect() as more:
        ends_with(more, "too_many_clients")  # before it has said hello
    for client in clients:
        client.close()
    welcome(server).close()
    alive(server)


def strangers():
    """Connections that say nothing, or what they say too slowly, keep nobody out who knows the token."""
    secret = "0123456789abcdef"
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "token")
        with open(path, "w", encoding="utf-8") as file:
            file.write(secret)
        os.chmod(path, 0o600)
        sets = ["live.max_clients=2", "live.max_strangers=3", "live.hello_timeout_s=60"]
        with Server(sets=sets, more=["--token-file", path]) as server:
            first = server.connect()
            expect(first.hello(token=secret)["message"] == "world", "the first client")
            silent = []
            for k in range(40):
                silent.append(server.connect())
                if k % 2:
                    silent[-1].bytes(b'{"message":')
                if k % 8 == 7:
                    with server.connect() as client:
                        expect(client.hello(token=secret)["message"] == "world", f"let in beside {k + 1} silent ones")
                        expect(client.ask(frame(k, k, []))["message"] == "channels", "and answered")
            expect(first.ask(frame(1, 0, []))["message"] == "channels", "the first client stays")
            # The oldest connections were closed, with or without a message; the newest are still open.
            expect(all(c.receive() is None or c.receive() is None for c in silent[:30]), "the oldest gave way")
            silent[-1].socket.settimeout(0.3)
            try:
                expect(silent[-1].receive() is not None, "the newest gave way")
                raise SystemExit("failed: the newest was told something")
            except TimeoutError:
                pass
            for client in silent[:30]:  # so many are not told at once why they cannot stay
                client.close()
            # Places are for clients that have said hello: two have them, and a third is refused with a message.
            with server.connect() as second, server.connect() as third:
                expect(second.hello(token=secret)["message"] == "world", "the second client")
                third.send({"message": "hello", "protocol": 1, "token": secret})
                ends_with(third, "too_many_clients")
            for client in silent[30:]:
                client.close()
            with server.connect() as long_hello:
                long_hello.bytes(b'{"message":"' + b"a" * 40000)
                ends_with(long_hello, "too_long")


def long_messages(server):
    """A client's long messages are read beside the answers to others, and in their order."""
    one = vehicle("a", 0, -40)
    junk = json.dumps({"message": "frame", "frame": 1, "file": "a" * 1000000}) + "\n"
    with server.connect() as bad, server.connect() as good:
        bad.hello()
        good.hello()
        bad.bytes((junk + json.dumps(frame(2, 0, [one])) + "\n" + junk + json.dumps(frame(3, 0, [one])) + "\n").encode())
        answers = [bad.receive() for _ in range(4)]
        expect([a.get("code", a["message"]) for a in answers] == ["unknown_key", "channels"] * 2, answers)
        expect([answers[1]["frame"], answers[3]["frame"]] == [2, 3], answers)
        # The message has most of a megabyte of vehicles, each of which would be removed again: building it would take
        # seconds.
        begin = time.monotonic()
        bad.bytes(b'{"message":"frame","frame":4,"vehicles":[' + b",".join([b'{"id":1}'] * 100000) + b"]}\n")
        expect(good.ask(frame(1, 0, [one]))["message"] == "channels", "the other client is answered")
        answer = bad.receive()
        expect(answer["code"] == "no_place" and answer["frame"] == 4, answer)
        expect(time.monotonic() - begin < 5, f"{time.monotonic() - begin} s for a megabyte of nothing")
    for _ in range(3):  # one that leaves while its message is read
        with server.connect() as client:
            client.hello()
            client.bytes(junk.encode())
    alive(server)


def slow_reader(server):
    """Asks and asks, and never reads: the server must neither grow nor wait."""
    with server.connect() as client:
        client.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        client.hello(detail="vertices")
        client.socket.settimeout(0.5)
        line = json.dumps(frame(1, 0, [vehicle(str(k), 0, -40 - 9 * k) for k in range(4)])).encode() + b"\n"
        begin = time.monotonic()
        try:
            while time.monotonic() - begin < 20:
                client.bytes(line)
        except TimeoutError:
            pass  # the server has stopped reading
        except OSError:
            print("slow reader dropped while it sent")
            return alive(server)
        with open(f"/proc/{server.process.pid}/status", encoding="utf-8") as status:
            resident = next(int(text.split()[1]) for text in status if text.startswith("VmRSS"))
        expect(resident < 2_000_000, f"{resident} kB resident")
        dropped = False
        begin = time.monotonic()
        while not dropped and time.monotonic() - begin < 60:  # send_timeout_s is 2
            try:
                client.bytes(line)
            except TimeoutError:
                pass
            except OSError:
                dropped = True
        expect(dropped, "the slow reader is dropped")
    alive(server)


def tokens():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "token")
        with open(path, "w", encoding="utf-8") as file:
            file.write("0123456789abcdef\n")
        os.chmod(path, 0o644)
        for listen, more, code in (("tcp:0.0.0.0:0", [], 2), ("tcp:127.0.0.1:0", ["--token-file", path], 2),
                                   ("tcp:127.0.0.1:0", ["--token-file", folder], 3), ("tcp:example.org:1", [], 2)):
            try:
                Server(listen, more=more)
                raise SystemExit(f"failed: listens on {listen} {more}")
            except RuntimeError as error:
                expect(f"exit {code}" in str(error), f"{listen} {more}: {error}")
        os.chmod(path, 0o600)
        with Server("tcp:0.0.0.0:0", more=["--token-file", path]) as server:
            server.name = server.name.replace("0.0.0.0", "127.0.0.1")
            for token in ({}, {"token": ""}, {"token": "0123456789abcdeF"}, {"token": "0123456789abcdef0"}):
                with server.connect() as client:
                    client.send({"message": "hello", "protocol": 1, **token})
                    ends_with(client, "token")
            with server.connect() as client:
                expect(client.hello(token="0123456789abcdef")["message"] == "world", "the token")


def signals():
    for how in (signal.SIGINT, signal.SIGTERM):
        with Server() as server, server.connect() as client:
            client.hello()
            server.process.send_signal(how)
            expect(client.receive()["message"] == "bye", "bye at the end")
            expect(server.process.wait(20) == 0, "exit code")


def main():
    limits = ["live.max_message_bytes=4096", "live.max_clients=4", "live.send_timeout_s=2", "live.max_queue_bytes=20000"]
    with Server(sets=limits) as server:
        for part in (wrong_messages, crowd, slow_reader, alive):
            part(server)
            print(part.__name__)
        expect(server.end() == 0, f"exit code; {server.log[-3:]}")
    with Server() as server:
        long_messages(server)
        print("long_messages")
    for part in (time_outs, tokens, strangers, signals):
        part()
        print(part.__name__)


if __name__ == "__main__":
    sys.exit(main())
