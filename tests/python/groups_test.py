# SPDX-License-Identifier: Apache-2.0
"""Groups of paths: figures of chosen paths add the fields of one wave before powers, as the library does; groups are
kept by pickles and saved runs. Usage: groups_test.py FOLDER; exits with 77 without numpy or h5py."""
import pickle
import shutil
import sys

try:
    import h5py  # noqa: F401
    import numpy as np
except ImportError:
    sys.exit(77)
import wavetracer
from wavetracer.paths import KINDS

folder = sys.argv[1]
shutil.rmtree(folder, ignore_errors=True)
simulation = wavetracer.Simulation({
    "scene": {"generate": "--seed 1 --blocks 2"}, "trace": {"max_depth": 2, "rays": 5000, "diffraction": True},
    "transmitter": [{"name": "t", "position_m": [0, 0, 6]}],
    "receiver": [{"name": f"r{i}", "position_m": [20 + i, 3 + 0.3 * i, 2]} for i in range(20)]})
frame = simulation.run_frame()
paths, links = frame.paths, frame.links
assert paths.group.shape == paths.group_weight.shape == (len(paths), 4)
np.testing.assert_allclose((paths.group_weight ** 2).sum(axis=1), 1, rtol=1e-12)
assert (np.abs(links["path_gain_db"] - links["sum_of_powers_db"]) > 0.01).any()
again = paths.select(kind=tuple(KINDS)).links
for name in ("path_gain_db", "sum_of_powers_db"):
    np.testing.assert_allclose(again[name], links[name], rtol=1e-9)
few = pickle.loads(pickle.dumps(paths.select(rx="r3")))
assert len(few) > 0 and np.array_equal(few.group, paths.group[paths.rx == 3])
with simulation.write(folder, [frame]) as run:
    assert np.array_equal(run[0].paths.group, paths.group)
    assert np.array_equal(run[0].paths.group_weight, paths.group_weight)
    assert np.array_equal(run[0].links["sum_of_powers_db"], links["sum_of_powers_db"])
with h5py.File(folder + "/paths.h5", "a") as file:  # as an older version wrote it
    del file["paths/group"], file["paths/group_weight"]
old = wavetracer.open(folder)[0].paths
assert len(old.group) == 0
plain = old.select(kind=("line_of_sight", "reflected", "diffracted")).links
np.testing.assert_allclose(plain["path_gain_db"], links["sum_of_powers_db"], rtol=1e-9)
print("groups ok")
