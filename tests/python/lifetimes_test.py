# SPDX-License-Identifier: Apache-2.0
"""Lifetimes of paths: a column of frames, of chosen paths and of saved runs, if output.lifetimes asks for it.
Usage: lifetimes_test.py FOLDER; exits with 77 without numpy or h5py."""
import shutil
import sys

try:
    import h5py  # noqa: F401
    import numpy as np
except ImportError:
    sys.exit(77)
import wavetracer

folder = sys.argv[1]
shutil.rmtree(folder, ignore_errors=True)


def config(at, **output):
    return {"scene": {"generate": "--seed 1 --blocks 2"}, "trace": {"max_depth": 2, "discovery": "beams"}, "output": output,
            "transmitter": [{"name": "t", "position_m": [0, 0, 6]}], "receiver": [{"name": "r", "position_m": at}]}


def touched(paths):
    return {tuple(paths.vertex_surface[a:b]) for a, b in zip(paths.vertex_offset[:-1], paths.vertex_offset[1:])}


simulation = wavetracer.Simulation(config([30, 3, 2], lifetimes=True))
frame = simulation.run_frame()
paths = frame.paths
assert len(paths) > 3 and paths.lifetime_m.shape == (len(paths),)
assert (paths.lifetime_m >= 0).all() and (paths.lifetime_m > 0.01).any()
assert np.array_equal(paths.select(kind="reflected").lifetime_m, paths.lifetime_m[paths.depth > 0])
lasting = paths.lifetime_m >= 0.05
moved = wavetracer.Simulation(config([30, 3.05, 2])).run_frame().paths
assert len(moved.lifetime_m) == 0
offset = paths.vertex_offset
assert {tuple(paths.vertex_surface[offset[i]:offset[i + 1]]) for i in np.nonzero(lasting)[0]} <= touched(moved)
with simulation.write(folder, [frame]) as run:
    assert np.array_equal(run[0].paths.lifetime_m, paths.lifetime_m)
print("lifetimes ok")
