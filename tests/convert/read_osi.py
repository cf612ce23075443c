# SPDX-License-Identifier: Apache-2.0
"""Reads the osi export with ASAM's own bindings, and compares it with the poses of paths.h5.
Run as read_osi.py PROGRAM RUN OUTPUT; answers 77, "skipped", where h5py or osi3 is missing (PyPI: osi-python)."""
import struct
import sys

from reading import RUN, convert

try:
    import h5py
    import numpy as np
    from osi3.osi_groundtruth_pb2 import GroundTruth
    from osi3.osi_object_pb2 import MovingObject
except ImportError as missing:
    print(f"skipped: {missing} (PyPI: osi-python)")
    sys.exit(77)

target, said = convert("osi", "run.osi")
data, at, frames = open(target, "rb").read(), 0, []
while at < len(data):
    (length,) = struct.unpack_from("<L", data, at)
    frames.append(GroundTruth.FromString(data[at + 4:at + 4 + length]))
    at += 4 + length
assert at == len(data)


def vector(message):
    return np.array([message.x, message.y, message.z])


with h5py.File(f"{RUN}/paths.h5") as run:
    ids, types = list(run["instances/id"].asstr()), list(run["instances/type"].asstr())
    time_s = run["frames/time_s"][...]
    poses = {name: column[...] for name, column in run["poses"].items()}
    numbers = run["frames/frame"][...] if "frame" in run["frames"] else np.arange(len(time_s))
assert len(frames) == len(time_s)
count = 0
for row, truth in enumerate(frames):
    assert truth.IsInitialized() and truth.version.version_major == 3
    assert abs(truth.timestamp.seconds + 1e-9 * truth.timestamp.nanos - time_s[row]) < 1e-9
    for thing in truth.moving_object:
        assert thing.source_reference[0].reference == "wavetracer"
        name, kind = thing.source_reference[0].identifier
        assert thing.id.value == ids.index(name) + 1 and kind == types[ids.index(name)]
        i = np.flatnonzero((poses["frame"] == numbers[row]) & (poses["instance"] == ids.index(name)))
        assert len(i) == 1
        base, size = thing.base, thing.base.dimension
        assert thing.type == MovingObject.TYPE_VEHICLE and size.length > size.width > 0 and size.height > 0
        wanted = poses["position_m"][i[0]] + [0, 0, size.height / 2]  # vehicles stand upright in these runs
        assert np.allclose(vector(base.position)[:2], wanted[:2], atol=0.5), (vector(base.position), wanted)
        assert abs(base.position.z - wanted[2]) < 0.2 or base.orientation.pitch != 0
        assert np.allclose(vector(base.velocity), poses["velocity_m_s"][i[0]], atol=1e-9)
        count += 1
assert count == len(poses["frame"]), (count, len(poses["frame"]))
print(f"{len(frames)} messages with {count} moving objects")
