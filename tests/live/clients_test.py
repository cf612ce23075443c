# SPDX-License-Identifier: Apache-2.0
"""The clients of docs/examples against one server: what the C++ one prints is what the Python one reads, in both
encodings, at the same poses and between them. Assumes an OpenCL device."""
import os
import re
import subprocess
import sys

from live_server import SOURCE, Server, expect

sys.path.insert(0, os.path.join(SOURCE, "docs/examples"))
import live_client

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


def strongest(answer):
    for link in answer["links"]:
        if link["paths"]:
            best = max(range(link["paths"]), key=lambda k: link["gain_db"][k])
            return (link["tx"], link["rx"], link["paths"], link["gain_db"][best], 1e9 * link["delay_s"][best],
                    link["doppler_hz"][best])
    return None


def main():
    with Server(config=CONFIG) as server:
        done = subprocess.run([CLIENT, server.name, "3"], check=True, capture_output=True, text=True)
        lines = done.stdout.splitlines()[1:]
        answers = []
        with live_client.Server(server.name, detail="paths") as client:
            for step in range(3):
                answer = client.channels(step * STEP_S, poses(step))
                before_s, now_s = (step - 1) * STEP_S, step * STEP_S
                times = [min(now_s, before_s + k * (now_s - before_s) / 10) for k in range(1, 11)]
                answers += [answer] if step == 0 else [client.at(time_s) for time_s in times]
        with live_client.Server(server.name, encoding="cbor") as client:
            for step in range(2):
                columns = client.channels(step * STEP_S, poses(step))
            rows = live_client.links_of(columns)
        script = os.path.join(SOURCE, "docs/examples/live_client.py")
        refused = [subprocess.run([*client, "tcp:127.0.0.1:1"], capture_output=True, text=True)
                   for client in ([CLIENT], [sys.executable, script])]
    expect(len(lines) == len(answers) == 21, f"{len(lines)} lines, {len(answers)} answers")
    form = re.compile(r"([0-9.]+) s: (\S+) -> (\S+): (\d+) paths, the strongest has (\S+) dB, (\S+) ns, (\S+) Hz")
    for line, answer in zip(lines, answers):
        found = form.fullmatch(line)
        expect(found, line)
        tx, rx, count, gain_db, delay_ns, shift_hz = strongest(answer)
        expect(found.group(2, 3) == (tx, rx) and int(found.group(4)) == count, (line, tx, rx, count))
        for text, value, digits in zip(found.group(1, 5, 6, 7), (answer["time_s"], gain_db, delay_ns, shift_hz), (3, 3, 3, 2)):
            expect(abs(float(text) - value) <= 0.51 * 10 ** -digits, (line, value))
    by_name = {(row["tx"], row["rx"]): row for row in rows}
    expect(len(by_name) == 4 and all(row["paths"] >= 0 for row in rows), by_name)
    for done in refused:
        expect(done.returncode == 1 and done.stderr == (
            "live_client: no server answers at tcp:127.0.0.1:1 (Connection refused); this starts one: wavetracer serve -c "
            "configs/live.toml --listen tcp:127.0.0.1:1\n"), done)
    print("clients in C++ and Python agree")


if __name__ == "__main__":
    sys.exit(main())
