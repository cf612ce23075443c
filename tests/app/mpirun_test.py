# SPDX-License-Identifier: Apache-2.0
"""Ranks of mpirun share a run: the data of one process, also after a rank was killed. mpirun_test.py PROGRAM SOURCE GATE
GATE is the library of gate.cpp, which lets ranks wait.
Answers 77 (skipped) without mpirun, h5py or an OpenCL device."""
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time

try:
    import h5py
    import numpy
except ImportError:
    sys.exit(77)

PROGRAM, SOURCE, GATE = sys.argv[1:4]
MPIRUN = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", "2"]
if shutil.which("mpirun") is None or subprocess.run([PROGRAM, "devices"], capture_output=True).returncode != 0:
    sys.exit(77)

CONFIG = f"""scene.file = "{SOURCE}/configs/scenes/room/room.xml"
trace.rays = 2000
trace.max_depth = 2
output.shard_frames = 3
time.step_s = 0.1
[[transmitter]]
name = "lamp"
position_m = [1, 1, 2.5]
[[track]]
id = "truck"
type = "passenger"
waypoints = [[0, 3, 2, 0], [1.9, 5, 4, 0]]
[[mount]]
name = "roof"
role = "receiver"
offset_m = [0, 0, 1.8]
"""


def columns(file):
    found = {}
    with h5py.File(file) as h5:
        h5.visititems(lambda name, item: found.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
    return found


def wait_until(what, holds, seconds=60):
    end = time.monotonic() + seconds
    while not holds():
        assert time.monotonic() < end, f"waited {seconds} s until {what}"
        time.sleep(0.002)


def check_same(found, expected):
    a, b = columns(f"{found}/paths.h5"), columns(f"{expected}/paths.h5")
    assert a.keys() == b.keys() and len(a) > 30
    for name, values in b.items():
        assert numpy.array_equal(a[name], values, equal_nan=values.dtype.kind == "f"), name
    assert len(b["paths/delay_s"]) > 50
    with open(f"{found}/links.csv") as one, open(f"{expected}/links.csv") as other:
        assert one.read() == other.read()


with tempfile.TemporaryDirectory() as folder:
    config, one, many = f"{folder}/a.toml", f"{folder}/one", f"{folder}/many"
    with open(config, "w") as file:
        file.write(CONFIG)
    words = [PROGRAM, "run", "-c", config, "-o"]
    environment = dict(os.environ, TMPDIR=folder)
    subprocess.run(words + [one], check=True, capture_output=True)
    run = subprocess.run(MPIRUN + words + [many], capture_output=True, text=True, env=environment)
    assert run.returncode == 0, run.stderr
    assert "rank 0: " in run.stderr and "rank 1: " in run.stderr, run.stderr
    assert run.stdout.count("written    ") == 1, run.stdout
    check_same(many, one)

    # A rank dies midway; mpirun ends the others. Both wait with a part each, so that no rank can end the run: otherwise
    # the other one would take over the part of the dead one.
    gate = f"{folder}/gate"
    os.mkdir(gate)
    waits = lambda: [int(name.split(".")[1]) for name in os.listdir(gate) if name.startswith("waits.")]
    held = dict(environment, LD_PRELOAD=GATE, GATE=gate, GATE_AT="frames_", GATE_NOT="frames_000000_")
    job = subprocess.Popen(MPIRUN + words + [many], stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL, env=held)
    wait_until("both ranks wait", lambda: len(waits()) == 2)
    ranks = waits()
    os.kill(ranks[0], signal.SIGKILL)
    assert job.wait() != 0
    assert not os.path.exists(f"{many}/paths.h5")
    wait_until("no rank is left", lambda: not any(os.path.exists(f"/proc/{rank}") for rank in ranks))
    again = subprocess.run(MPIRUN + words + [many, "--resume"], capture_output=True, text=True, env=environment)
    assert again.returncode == 0, again.stderr
    assert "1 of 7 parts are computed already" in again.stderr, again.stderr
    check_same(many, one)
print("two ranks, one killed and resumed: the data of one process")
