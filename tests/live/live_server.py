# SPDX-License-Identifier: Apache-2.0
"""Starts `wavetracer serve` for a test, and talks to it line by line.
Assumes the program as the first argument of the test and the source folder as the second."""
import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
import threading

PROGRAM, SOURCE = sys.argv[1], sys.argv[2]

CONFIG = """
[scene]
generate = "--seed 1 --blocks 2x2"
[[live_vehicle]]
type = "passenger"
count = 4
[[live_vehicle]]
type = "truck"
count = 1
[[mount]]
name = "roof"
on = "passenger"
offset_m = [0.0, 0.0, 1.6]
[[transmitter]]
name = "rsu"
position_m = [8.0, 8.0, 6.0]
[trace]
rays = 50000
max_depth = 4
"""




def drive(lorry):
    """A drive of one frame at 0 s: ego looks along +y, other meets it, and a lorry follows its waypoints."""
    return f"""
[[track]]
id = "ego"
waypoints = [[0.0, 3.0, -60.0, 0.0], [1.0, 3.0, -50.0, 0.0]]
[[track]]
id = "other"
waypoints = [[0.0, -3.0, -30.0, 0.0], [1.0, -3.0, -45.0, 0.0]]
[[track]]
id = "lorry"
type = "truck"
waypoints = {lorry}
[time]
start_s = 0.0
end_s = 0.0
step_s = 0.1
"""


class Server:
    """A running server; `with` ends it."""

    def __init__(self, listen="tcp:127.0.0.1:0", config=CONFIG, sets=(), more=()):
        self.folder = tempfile.TemporaryDirectory()
        path = os.path.join(self.folder.name, "live.toml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(config)
        command = [PROGRAM, "serve", "-c", path, "--listen", listen, *more]
        for one in sets:
            command += ["--set", one]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        line = self.process.stdout.readline()
        if not line.startswith("listening on "):
            error = self.process.communicate()[1]
            self.folder.cleanup()
            raise RuntimeError(f"exit {self.process.returncode}: {error.strip().splitlines()[-1] if error else ''}")
        self.name = line.removeprefix("listening on ").strip()
        self.log = []
        self.reader = threading.Thread(target=lambda: self.log.extend(self.process.stderr), daemon=True)
        self.reader.start()

    def connect(self):
        return Client(self.name)

    def end(self, how=signal.SIGTERM):
        """The exit code."""
        if self.process.poll() is None:
            self.process.send_signal(how)
        code = self.process.wait(timeout=20)
        self.reader.join(5)
        self.process.stdout.close()
        self.process.stderr.close()
        self.folder.cleanup()
        return code

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.end()


class Client:
    """A connection. receive() is None where the server has closed it."""

    def __init__(self, name):
        if name.startswith("unix:"):
            self.socket = socket.socket(socket.AF_UNIX)
            self.socket.connect(name.removeprefix("unix:"))
        else:
            host, port = name.removeprefix("tcp:").rsplit(":", 1)
            self.socket = socket.create_connection((host.strip("[]"), int(port)))
        self.socket.settimeout(30)
        self.file = self.socket.makefile("rb")

    def send(self, message):
        self.bytes(message.encode() if isinstance(message, str) else json.dumps(message).encode() + b"\n")

    def bytes(self, data):
        self.socket.sendall(data)

    def receive(self):
        line = self.file.readline()
        return json.loads(line) if line else None

    def ask(self, message):
        self.send(message)
        return self.receive()

    def hello(self, **more):
        return self.ask({"message": "hello", "protocol": 1, **more})

    def close(self):
        self.file.close()
        self.socket.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


def vehicle(name, x, y, yaw_deg=0, kind="passenger", **more):
    return {"id": name, "type": kind, "position_m": [x, y, 0], "yaw_deg": yaw_deg, **more}


def frame(number, time_s, vehicles, **more):
    return {"message": "frame", "frame": number, "time_s": time_s, "vehicles": vehicles, **more}


# An instant of two cars and a truck on the streets of CONFIG.
POSES = [vehicle("ego", 3, -60, 90, velocity_m_s=[0, 10, 0], angular_velocity_rad_s=[0, 0, 0]),
         vehicle("other", -3, -30, -90, velocity_m_s=[0, -15, 0], angular_velocity_rad_s=[0, 0, 0]),
         vehicle("lorry", -20, 3, 180, "truck", velocity_m_s=[-8, 0, 0], angular_velocity_rad_s=[0, 0, 0])]


def expect(condition, what):
    """Ends the test where the condition is false; what: said then."""
    if not condition:
        raise SystemExit(f"failed: {what}")
