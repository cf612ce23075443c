# SPDX-License-Identifier: Apache-2.0
"""Helpers that the tests of exports share: paths.h5 by h5py, and a run of the program. Assumes that the script is
called with the program, the folder of a run, and a folder to write to."""
import os
import shutil
import subprocess
import sys

try:
    import h5py
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing} (Debian: python3-h5py, python3-numpy)")
    sys.exit(77)

PROGRAM, RUN, OUTPUT = sys.argv[1:4]
os.makedirs(OUTPUT, exist_ok=True)


def convert(form, name, *options, code=0):
    """Runs `wavetracer convert` into OUTPUT/name; answers that path and what the program said on stderr."""
    target = os.path.join(OUTPUT, name)
    if os.path.isdir(target):
        shutil.rmtree(target)
    done = subprocess.run([PROGRAM, "convert", RUN, "--to", form, "-o", target, *options], capture_output=True, text=True)
    assert done.returncode == code, (done.returncode, done.stderr)
    return target, done.stderr


class Truth:
    """The run, read without the program. h(frame, tx, rx, f) is what its convention_channel says."""

    def __init__(self):
        with h5py.File(os.path.join(RUN, "paths.h5"), "r") as file:
            self.f = float(np.ravel(file.attrs["frequency_hz"])[0])
            self.paths = {name: data[...] for name, data in file["paths"].items()}
            self.vertices = {name: data[...] for name, data in file["vertices"].items()}
            self.frames = {name: data[...] for name, data in file["frames"].items()}
            self.links = {name: data[...] for name, data in file["links"].items()}
            self.tx = list(file["transmitters/name"].asstr())
            self.rx = list(file["receivers/name"].asstr())
            self.vehicles = list(file["instances/id"].asstr())
        self.a = self.paths["a_re"] + 1j * self.paths["a_im"]

    def rows(self, frame, tx, rx):
        p = self.paths
        return np.flatnonzero((p["frame"] == frame) & (p["tx"] == tx) & (p["rx"] == rx))

    def used_links(self):
        """(frame, tx, rx) of links that have paths."""
        return np.unique(np.stack([self.paths["frame"], self.paths["tx"], self.paths["rx"]], axis=1), axis=0)

    def h(self, rows, f, ports=(0, 0)):
        return np.sum(self.a[rows, ports[0], ports[1]] * np.exp(-2j * np.pi * f * self.paths["delay_s"][rows]))
