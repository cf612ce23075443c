# SPDX-License-Identifier: Apache-2.0
"""Reads the sample of the output tests with h5py, as a user would; expects the formulas of sample_run.cpp.
Run as read_paths.py FOLDER; answers 77, "skipped", where h5py is not installed."""
import sys

try:
    import h5py
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing} (Debian: python3-h5py)")
    sys.exit(77)

DATASETS = {
    "paths": "frame tx rx depth delay_s gain_db a_re a_im aod_theta_rad aod_phi_rad aoa_theta_rad aoa_phi_rad "
             "doppler_hz group group_weight vertex_offset",
    "vertices": "position_m interaction surface instance",
    "frames": "frame time_s path_offset transmitter_position_m transmitter_velocity_m_s receiver_position_m "
              "receiver_velocity_m_s",
    "instances": "id type model",
    "poses": "frame instance position_m rotation velocity_m_s",
    "links": "frame tx rx",
    "inputs": "name file bytes hash",
    "transmitters": "name position_m antenna polarization orientation_deg velocity_m_s",
    "receivers": "name position_m antenna polarization orientation_deg velocity_m_s",
}

with h5py.File(sys.argv[1] + "/paths.h5", "r") as file:
    assert set(file) == set(DATASETS), list(file)
    for group, names in DATASETS.items():
        assert set(file[group]) == set(names.split()), (group, list(file[group]))
        for name, dataset in file[group].items():
            assert dataset.attrs["units"] and dataset.attrs["description"], name

    row = np.arange(5)
    paths, vertices = file["paths"], file["vertices"]
    assert np.array_equal(paths["depth"], row) and paths["depth"].dtype == np.uint32
    assert np.array_equal(paths["delay_s"], 1e-7 * (row + 1)) and paths["delay_s"].dtype == np.float64
    a = paths["a_re"][...] + 1j * paths["a_im"][...]
    assert a.shape == (5, 2, 1)
    assert np.array_equal(a[:, 0, 0], 1e-4 * row + 1j) and np.array_equal(a[:, 1, 0], 2e-4 * row - 1j)
    assert paths["group"].shape == paths["group_weight"].shape == (5, 4) and paths["group"].dtype == np.uint32
    alone = paths["tx"][...].astype(int) * 2 + paths["rx"][...]  # the sample's paths are groups of their own
    assert all(paths["group"][i, 0] == (alone[:i] == alone[i])[paths["frame"][:i] == paths["frame"][i]].sum() for i in row)
    assert np.array_equal(paths["group_weight"][...], [[1, 0, 0, 0]] * 5) and (paths["group"][:, 1:] == 0xFFFFFFFF).all()
    offset = paths["vertex_offset"][...]
    assert offset.dtype == np.uint64 and np.array_equal(np.diff(offset), row)
    assert vertices["interaction"].dtype == np.uint8
    for i in row:
        part = slice(int(offset[i]), int(offset[i + 1]))
        assert np.array_equal(vertices["surface"][part], 100 * i + np.arange(i))
        assert np.array_equal(vertices["position_m"][part, 0], np.full(i, 1e6 + i))
        assert np.array_equal(vertices["position_m"][part, 1], np.arange(i) / 3.0)

    assert list(file["transmitters/name"].asstr()) == ["rsu, north", "rsu"]
    assert list(file["receivers/polarization"].asstr()) == ["VH", "V"]
    assert list(file["instances/model"].asstr()) == ["car", "/models/bus.glb"]
    assert np.array_equal(file["frames/transmitter_position_m"][1], [[1, 2, 3], [4, 5, 6]])
    turned = file["poses/rotation"][2] @ [1, 0, 0]
    assert np.array_equal(turned, [0, 1, 0]), turned
    assert list(file["inputs/name"].asstr()) == ["scene.file", "scene.file: a.ply"]
    assert list(file["inputs/bytes"]) == [100, 7] and list(file["inputs/hash"]) == [42, 43]
    assert file.attrs["format_version"] == 1 and file.attrs["frequency_hz"] == [5.9e9]
    assert file.attrs["config"] == 'scene.file = "scene.xml"  # \u00e9\n'
print("paths.h5: all datasets as written")
