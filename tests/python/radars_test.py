# SPDX-License-Identifier: Apache-2.0
"""Frame.radars of a drive: detections and cubes are those that the same frame has in radar.h5, and targets are where they
stand. Usage: radars_test.py FOLDER, which is written to. Assumes an OpenCL device."""
import pathlib
import shutil
import sys

try:
    import h5py
    import numpy as np
except ImportError:
    print("skipped: no NumPy or h5py (Debian: python3-numpy, python3-h5py)")
    sys.exit(77)
import wavetracer
from wavetracer import radar

CONFIG = {
    "scene": {"generate": "--seed 1 --blocks 2x2", "extrapolate_materials": True},
    "radio": {"frequency_hz": 77e9}, "trace": {"rays": 5000, "max_depth": 1}, "links": {"same_vehicle": True, "v2v": False},
    "array": [{"name": "row", "columns": 3}],
    "track": [{"id": "own", "waypoints": [[0, -60, -3, 0], [1, -50, -3, 0]]}],
    "time": {"step_s": 0.5},
    "mount": [{"name": "sends", "on": "own", "role": "transmitter", "offset_m": [2.6, 0.1, 0.6]},
              {"name": "hears", "on": "own", "role": "receiver", "offset_m": [2.6, -0.1, 0.6], "array": "row"}],
    "target_model": [{"name": "ball", "rcs_dbsm": [30], "points_m": [[0, 0, 0.6]]}],
    "target": [{"name": "there", "model": "ball", "position_m": [-40, -3, 0]}],
    "radar": [{"name": "front", "bandwidth_hz": 300e6, "chirps": 32, "samples": 128, "direct": False},
              {"name": "map", "bandwidth_hz": 300e6, "chirps": 32, "samples": 128, "direct": False, "cube": False}]}


def check_file(found, path, frame):
    """The rows of one radar against its group of radar.h5, whose cubes have fewer digits."""
    with h5py.File(path) as file:
        group = file[found.name]
        for name, values in found.detections.items():
            assert len(values) > 0 and np.allclose(values, group["detections"][name][...], rtol=1e-9, atol=0, equal_nan=True), name
    if found.cube is not None:
        saved = radar.load(path, found.name)[frame]
        assert found.cube.values.shape == saved.values.shape == (3, 1, 32, 128)
        assert np.abs(found.cube.values - saved.values).max() < 1e-6 * np.abs(saved.values).max()
        assert np.allclose(found.cube.delay_s, saved.delay_s) and np.allclose(found.cube.doppler_hz, saved.doppler_hz)
        assert found.cube.left_out == saved.left_out == found.left_out


def main():
    folder = pathlib.Path(sys.argv[1])
    shutil.rmtree(folder, ignore_errors=True)
    with wavetracer.Simulation(CONFIG) as simulation:
        assert simulation.radars == ["front", "map"]
        frame = simulation.run_frame(1)
        simulation.write(folder, [frame])
    rows = frame.radars  # they outlive the simulation
    assert [(each.name, each.tx, each.rx) for each in rows] == [(name, "own/sends", "own/hears") for name in ("front", "map")]
    assert rows[0].cube is not None and rows[1].cube is None
    for each in rows:
        check_file(each, folder / "radar.h5", 1)
        # At 0.5 s the ball is 20 - 5 - 2.6 m ahead, and the car comes nearer at 10 m/s. Cells have 0.5 m and 3 m/s.
        at = np.argmin(abs(each.detections["range_m"] - 12.4))
        assert abs(each.detections["range_m"][at] - 12.4) < 0.5 and abs(each.detections["speed_m_s"][at] - 10) < 3.1
        assert "front" in repr(each) or "map" in repr(each)
    with wavetracer.Simulation({key: value for key, value in CONFIG.items() if key != "radar"}) as simulation:
        assert simulation.radars == [] and simulation.run_frame(1).radars == []
    print("ok")


main()
