# SPDX-License-Identifier: Apache-2.0
"""The clients of docs/examples against one server: what the C++ one prints is what the Python one reads, in both
encodings, at the same poses and between them. Assumes an OpenCL device."""
import os
import re
import subprocess
import sys
import tempfile

from live_server import SOURCE, Server, expect

sys.path.insert(0, os.path.join(SOURCE, "python"))
try:
    import numpy as np
except ImportError:
    print("skipped: no NumPy (Debian: python3-numpy)")
    sys.exit(77)
from wavetracer.live import LiveClient, LiveError

CLIENT = sys.argv[3]
STEP_S, SPEED_M_S = 0.1, 14.0
CONFIG = """
[scene]
generate = "--seed 1 --blocks 2x2"
[[transmitter]]
name = "rsu"
position_m = [8.0, 8.0, 6.0]
[[live_vehicle]]
type = "passenger"
count = 2
[[mount]]
name = "roof"
offset_m = [0.0, 0.0, 1.6]
[trace]
rays = 10000
max_depth = 2
reuse = false
"""


def poses(step):
    way_m = SPEED_M_S * (step * STEP_S)
    return [{"id": "eastwards", "type": "passenger", "position_m": [-60 + way_m, -3, 0], "yaw_deg": 0,
             "velocity_m_s": [SPEED_M_S, 0, 0]},
            {"id": "northwards", "type": "passenger", "position_m": [3, -60 + way_m, 0], "yaw_deg": 90,
             "velocity_m_s": [0, SPEED_M_S, 0]}]


def strongest(channels):
    for row in np.flatnonzero(channels.links["paths"]):
        rows = channels.rows_of(row)
        best = rows.start + np.argmax(channels.paths["gain_db"][rows])
        return (*channels.names(row), channels.links["paths"][row], channels.paths["gain_db"][best],
                1e9 * channels.paths["delay_s"][best], channels.paths["doppler_hz"][best])
    return None


def same(one, other):
    """The same columns came by two ways: as JSON, and in CBOR."""
    pairs = [(one.links, other.links), (one.paths, other.paths), (one.vertices, other.vertices)]
    for left, right in pairs:
        expect(sorted(left) == sorted(right) and len(left) > 3, (left.keys(), right.keys()))
        for key in left.keys() - {"tx", "rx", "vehicle"}:
            finite = np.isfinite(right[key])  # JSON has null for what is not finite
            expect(left[key].shape == right[key].shape and (left[key][finite] == right[key][finite]).all(), key)
    expect([one.names(k) for k in range(len(one))] == [other.names(k) for k in range(len(other))], "names")
    vehicles = [[each.ids[place] if place < len(each.ids) else None for place in each.vertices["vehicle"]]
                for each in (one, other)]
    expect(vehicles[0] == vehicles[1] and one.vertices["position_m"].shape[1] == 3, "vertices")


def with_a_token():
    """The example gives the token of a file, and a client without one is refused."""
    with tempfile.NamedTemporaryFile("w") as secret:
        secret.write("sixteen-letters-and-more\n")
        secret.flush()
        os.chmod(secret.name, 0o600)
        with Server(config=CONFIG, more=["--token-file", secret.name]) as server:
            try:
                LiveClient(server.name)
                raise SystemExit("failed: welcome without a token")
            except LiveError as error:
                expect(error.reason == "token" and error.code == 1, error)
            example([server.name, "--token-file", secret.name])


def example(arguments):
    """Returns what docs/examples/live_client.py prints of two frames."""
    return subprocess.run([sys.executable, "-B", os.path.join(SOURCE, "docs/examples/live_client.py"), "--frames", "2",
                           "--server", *arguments], check=True, capture_output=True, text=True,
                          env={**os.environ, "PYTHONPATH": os.path.join(SOURCE, "python")}).stdout


def main():
    with Server(config=CONFIG) as server:
        done = subprocess.run([CLIENT, server.name, "3"], check=True, capture_output=True, text=True)
        lines = done.stdout.splitlines()[1:]
        answers = []
        with LiveClient(server.name, detail="paths", encoding="json") as client:
            for step in range(3):
                answer = client.channels(step * STEP_S, poses(step))
                before_s, now_s = (step - 1) * STEP_S, step * STEP_S
                times = [min(now_s, before_s + k * (now_s - before_s) / 10) for k in range(1, 11)]
                answers += [answer] if step == 0 else client.at_each(times)
        both = []
        for encoding in ("json", "cbor"):
            with LiveClient(server.name, encoding=encoding, detail="vertices") as client:
                both.append([client.channels(step * STEP_S, poses(step), cold=True) for step in range(2)])
        printed = example([server.name])
        refused = subprocess.run([CLIENT, "tcp:127.0.0.1:1"], capture_output=True, text=True)
    expect(len(lines) == len(answers) == 21, f"{len(lines)} lines, {len(answers)} answers")
    form = re.compile(r"([0-9.]+) s: (\S+) -> (\S+): (\d+) paths, the strongest has (\S+) dB, (\S+) ns, (\S+) Hz")
    for line, answer in zip(lines, answers):
        found = form.fullmatch(line)
        expect(found, line)
        tx, rx, count, gain_db, delay_ns, shift_hz = strongest(answer)
        expect(found.group(2, 3) == (tx, rx) and int(found.group(4)) == count, (line, tx, rx, count))
        for text, value, digits in zip(found.group(1, 5, 6, 7), (answer.time_s, gain_db, delay_ns, shift_hz), (3, 3, 3, 2)):
            expect(abs(float(text) - value) <= 0.51 * 10 ** -digits, (line, value))
    for one, other in zip(*both):
        same(one, other)
    expect(len(both[1][0]) == 4 and both[1][0].paths["a"].shape[1:] == (1, 1), both)
    power = np.abs(both[1][0].paths["a"][:, 0, 0]) ** 2
    expect(np.allclose(10 * np.log10(power), both[1][0].paths["gain_db"], atol=1e-9), "gains of coefficients")
    expect("0.100 s: 2 of 4 links" in printed and "rsu -> eastwards/roof: " in printed, printed)
    with_a_token()
    expect(refused.returncode == 1 and "live_client: no server answers at tcp:127.0.0.1:1" in refused.stderr, refused)
    print("clients in C++ and Python agree")


if __name__ == "__main__":
    sys.exit(main())
