# SPDX-License-Identifier: Apache-2.0
"""The ns3 export read as ns-3's QdChannelModel reads it, and the channel that it would form against h(f) of paths.h5.
Run as read_ns3.py PROGRAM RUN OUTPUT. The reader is strict where the model would misread in silence."""
import glob
import math
import os
import re

from reading import Truth, convert, np

truth = Truth()
folder, said = convert("ns3", "scenario")

# paraCfgCurrent.txt: a header line, then NAME<tab>VALUE, numbers as C's atoi and atof take them.
with open(os.path.join(folder, "Input/paraCfgCurrent.txt")) as file:
    lines = file.read().split("\n")
assert lines[0] == "ParameterName\tParameterValue" and lines[-1] == ""
parameters = dict(line.split("\t") for line in lines[1:-1])
steps = int(parameters["numberOfTimeDivisions"])
assert steps == len(truth.frames["frame"]) and float(parameters["carrierFrequency"]) == truth.f
step_s = float(parameters["totalTimeDuration"]) / steps
assert np.allclose(np.diff(truth.frames["time_s"]), step_s, rtol=1e-6)

# Nodes: a line each, x,y,z of where they begin. Twins are one node.
with open(os.path.join(folder, "Output/Ns3/NodesPosition/NodesPosition.csv")) as file:
    nodes = [tuple(float(v) for v in line.split(",")) for line in file.read().splitlines()]
assert len(nodes) == int(parameters["numberOfNodes"])
tx_track, rx_track = truth.frames["transmitter_position_m"], truth.frames["receiver_position_m"]
there = [~np.isnan(track[:, :, 0]).all(axis=0) for track in (tx_track, rx_track)]  # in any frame
senders, receivers = np.flatnonzero(there[0]), np.flatnonzero(there[1])
node_of_tx = {t: i for i, t in enumerate(senders)}
node_of_rx = {}
for r in receivers:
    t = truth.tx.index(truth.rx[r]) if truth.rx[r] in truth.tx else None
    if t in node_of_tx and np.array_equal(tx_track[:, t], rx_track[:, r], equal_nan=True):
        node_of_rx[r] = node_of_tx[t]
alone = [r for r in receivers if r not in node_of_rx]
node_of_rx |= {r: len(senders) + k for k, r in enumerate(alone)}
assert len(nodes) == len(senders) + len(alone)


def first(track):
    return tuple(track[~np.isnan(track[:, 0])][0])


assert all(nodes[node_of_tx[t]] == first(tx_track[:, t]) for t in node_of_tx)
assert all(nodes[node_of_rx[r]] == first(rx_track[:, r]) for r in node_of_rx)

# Files: N, then seven lines of N numbers, for every step; none for a node with itself.
number = re.compile(r"-?\d+(\.\d+)?(e[+-]?\d+)?")


def read_steps(name):
    with open(name) as file:
        lines = file.read().split("\n")
    assert lines.pop() == ""
    out, at = [], 0
    while at < len(lines):
        count = int(lines[at])
        block = lines[at + 1:at + 8] if count else [""] * 7
        values = [[float(v) for v in line.split(",")] if line else [] for line in block]
        assert all(number.fullmatch(v) for line in block if line for v in line.split(",")), name
        assert len(values) == 7 and all(len(v) == count for v in values), name
        out.append(np.array(values))
        at += 8 if count else 1
    return out


channels = {}
for name in sorted(glob.glob(os.path.join(folder, "Output/Ns3/QdFiles/*"))):
    a, b = (int(v) for v in re.fullmatch(r"Tx(\d+)Rx(\d+)\.txt", os.path.basename(name)).groups())
    channels[a, b] = read_steps(name)
    assert len(channels[a, b]) == steps, name
assert set(channels) == {(i, k) for i in range(len(nodes)) for k in range(len(nodes)) if i != k}


def model_h(step):
    """GetNewChannel() for antennas of one element."""
    delay, gain, phase = step[0], step[1], step[2]
    return np.sum(10 ** (gain / 20) * np.exp(1j * (-2 * math.pi * delay * truth.f + phase)))


asked = {(node_of_tx[t], node_of_rx[r]) for t, r in zip(truth.links["tx"], truth.links["rx"])
         if t in node_of_tx and r in node_of_rx}
worst, compared, reversed_links = 0, 0, 0
for frame, tx, rx in truth.used_links():
    i, k = node_of_tx[tx], node_of_rx[rx]
    if i == k:
        continue
    rows = truth.rows(frame, tx, rx)
    rows = rows[truth.a[rows, 0, 0] != 0]
    step = channels[i, k][list(truth.frames["frame"]).index(frame)]
    back = channels[k, i][list(truth.frames["frame"]).index(frame)]
    p = truth.paths
    assert np.array_equal(step[0], p["delay_s"][rows])
    for line, column in ((3, "aod_theta_rad"), (4, "aod_phi_rad"), (5, "aoa_theta_rad"), (6, "aoa_phi_rad")):
        assert np.allclose(np.radians(step[line]), p[column][rows], rtol=0, atol=1e-12)
    if (k, i) not in asked:  # by reciprocity: the same paths, walked the other way
        assert np.array_equal(back[[0, 1, 2, 5, 6, 3, 4]], step)
        reversed_links += 1
    scale = np.sum(np.abs(truth.a[rows, 0, 0]))
    worst = max(worst, abs(model_h(step) - truth.h(rows, truth.f)) / scale)
    compared += 1
assert ("by reciprocity" in said) == (reversed_links > 0)
assert compared > 0 and worst < 1e-9, (compared, worst)
# Steps without a path exist, and are empty.
empty = sum(step.size == 0 for steps_of in channels.values() for step in steps_of)
print(f"ns3: {len(nodes)} nodes, {len(channels)} files, {compared} channels within {worst:.1e} of h(f), {empty} steps empty")
