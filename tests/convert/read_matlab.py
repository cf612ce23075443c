# SPDX-License-Identifier: Apache-2.0
"""The matlab export against paths.h5: header and attributes by h5py, values by mat73, a reader of MATLAB's files.
Run as read_matlab.py PROGRAM RUN OUTPUT; without mat73 the values are compared through h5py alone."""
import sys

from reading import Truth, convert, np
import h5py

truth = Truth()
target, _ = convert("matlab", "run.mat")

with open(target, "rb") as file:
    header = file.read(512)
assert header.startswith(b"MATLAB 7.3 MAT-file, ") and header[124:128] == b"\x00\x02IM" and not any(header[128:])
with h5py.File(target, "r") as file:
    assert file.userblock_size == 512
    assert file["run"].attrs["MATLAB_class"] == b"struct"

    def check(name, item):
        if name.startswith("#refs#") and isinstance(item, h5py.Group):
            return
        kind = item.attrs["MATLAB_class"]
        if isinstance(item, h5py.Group):
            assert kind == b"struct", name
        elif "MATLAB_empty" not in item.attrs:
            assert item.ndim >= 2, name
            expected = {b"double": "fV", b"uint32": "u", b"uint8": "u", b"char": "u", b"cell": "O"}[kind]
            assert item.dtype.kind in expected, (name, kind, item.dtype)

    file.visititems(check)
    # Each text is stored once, however many ends have it.
    kept = ["".join(map(chr, np.ravel(item))) if "MATLAB_empty" not in item.attrs else "" for item in file["#refs#"].values()]
    assert len(kept) == len(set(kept)), "a text is there twice"
    n = len(truth.a)
    a = file["run/paths/a"][...]  # dimensions the other way round
    assert a.shape == truth.a.shape[::-1]
    assert np.array_equal((a["real"] + 1j * a["imag"]).T, truth.a)
    assert np.array_equal(file["run/paths/delay_s"][0], truth.paths["delay_s"])
    assert np.array_equal(file["run/paths/tx"][0], truth.paths["tx"] + 1)

try:
    import mat73
except ImportError as missing:
    print(f"matlab: header, classes and columns as they must be; not read back: {missing}")
    sys.exit(0)

run = mat73.loadmat(target)["run"]
assert float(run["frequency_hz"]) == truth.f and "h(f) = sum" in run["conventions"]
names = lambda cells: [str(np.squeeze(cell)) for cell in np.ravel(np.array(cells, dtype=object))]
assert names(run["transmitters"]["name"]) == truth.tx, run["transmitters"]["name"]
assert names(run["receivers"]["name"]) == truth.rx
paths, vertices = run["paths"], run["vertices"]
assert np.array_equal(np.reshape(paths["a"], truth.a.shape), truth.a)
for name in "frame depth delay_s gain_db aod_theta_rad aod_phi_rad aoa_theta_rad aoa_phi_rad doppler_hz".split():
    assert np.array_equal(np.ravel(paths[name]), truth.paths[name]), name
assert np.array_equal(np.ravel(paths["rx"]), truth.paths["rx"] + 1)
first = np.ravel(paths["first_vertex"]).astype(int)
assert np.array_equal(first - 1, truth.paths["vertex_offset"])
assert np.array_equal(np.reshape(vertices["position_m"], (-1, 3)), truth.vertices["position_m"])
assert np.array_equal(np.ravel(vertices["instance"]), truth.vertices["instance"] + np.uint32(1))
for name in ("transmitter_position_m", "receiver_velocity_m_s"):
    shape = truth.frames[name].shape
    assert np.array_equal(np.reshape(run["frames"][name], shape), truth.frames[name], equal_nan=True), name
first_path = np.ravel(run["frames"]["first_path"]).astype(int)
assert np.array_equal(first_path - 1, truth.frames["path_offset"])
print(f"matlab: {n} paths in mat73 as in paths.h5")
