#!/usr/bin/env python3
"""The Python module of docs/examples/python: columns against closed forms and against what h5py reads, errors, lifetimes.

Usage: python_test.py FOLDER_OF_MODULE FOLDER. WAVETRACER_LIBRARY names the library. Exits with 77 without numpy.
"""
import csv
import gc
import json
import shutil
import sys

try:
    import numpy as np
except ImportError:
    sys.exit(77)
sys.path.insert(0, sys.argv[1])
sys.dont_write_bytecode = True
import wavetracer

DRIVE = """
[scene]
generate = "--seed 1 --blocks 4"
[trajectories]
generate = "--seed 1 --blocks 4 --vehicles 4 --seconds 0.2 --step 0.1"
[[transmitter]]
name = "rsu"
position_m = [0, 0, 6]
[[mount]]
name = "roof"
role = "receiver"
offset_m = [0, 0, 1.6]
[trace]
rays = 20000
max_depth = 2
"""


def raises(code, part, function, *arguments, **named):
    try:
        function(*arguments, **named)
    except wavetracer.Error as error:
        assert error.code == code and part in str(error), error
    else:
        raise AssertionError(f"no error with {part}")


def check_frame(simulation, frame):
    assert set(wavetracer.columns()) >= {"delay_s", "a", "vertex_position_m", "link"}
    assert len(frame) > 1 and frame.counts.paths == len(frame["delay_s"])
    for name in ("tx", "rx", "depth", "gain_db", "doppler_hz"):
        assert frame[name].shape == (len(frame),), name
    assert frame["a"].shape == (len(frame), 1, 1) and frame["a"].dtype == np.complex128
    assert np.allclose(10 * np.log10(np.abs(frame["a"][:, 0, 0]) ** 2), frame["gain_db"], atol=1e-9)
    # Every path is as long as the way over its vertices.
    tx, rx = frame["transmitter_position_m"], frame["receiver_position_m"]
    offset, vertices = frame["vertex_offset"], frame["vertex_position_m"]
    for i in range(len(frame)):
        way = np.vstack([tx[frame["tx"][i]], vertices[offset[i]:offset[i + 1]], rx[frame["rx"][i]]])
        length = np.linalg.norm(np.diff(way, axis=0), axis=1).sum()
        assert abs(length / 299792458.0 - frame["delay_s"][i]) < 1e-15
    # Both gains of every link, from its paths.
    f_hz = 5.9e9
    h = frame["a"][:, 0, 0] * np.exp(-2j * np.pi * (f_hz * frame["delay_s"] % 1))
    for (t, r), count, powers, coherent in zip(frame["link"], frame["link_paths"], frame["link_path_gain_db"],
                                               frame["link_narrowband_gain_db"]):
        rows = (frame["tx"] == t) & (frame["rx"] == r)
        assert count == rows.sum()
        if count:
            assert abs(powers - 10 * np.log10((np.abs(h[rows]) ** 2).sum())) < 1e-9
            assert abs(coherent - 20 * np.log10(np.abs(h[rows].sum()))) < 1e-6
        else:
            assert powers == coherent == -np.inf
    assert not frame["delay_s"].flags.writeable
    # Rays have seen something of every link with a path, and nothing of one without.
    shares = frame["link_missed_power_share"]
    assert shares.shape == (len(frame["link"]),)
    with_path = [np.any((frame["tx"] == tx) & (frame["rx"] == rx)) for tx, rx in frame["link"]]
    assert any(with_path) and np.array_equal(np.isfinite(shares), with_path) and np.all(shares[with_path] >= 0)
    assert max(frame["rx"]) < len(simulation.receivers)


def check_missed(folder, frames):
    """What was missed is what the files say; of frames alone, as they do not add up by a plain sum."""
    with open(folder + "/links.csv") as file:
        written = [float(row["missed_power_share"]) for row in csv.DictReader(file)]
    assert np.array_equal(written, np.concatenate([frame["link_missed_power_share"] for frame in frames]), equal_nan=True)
    with open(folder + "/summary.json") as file:
        summary = json.load(file)
    if len(frames) > 1:
        return
    for what, bounds in frames[0].missed.items():
        for bound, value in bounds.items():
            assert abs(summary["missed"][what][bound] - value) <= 0.005 * value, (what, bound, value, summary["missed"])


def check_files(folder, frames):
    try:
        import h5py
    except ImportError:
        return
    with h5py.File(folder + "/paths.h5") as file:
        assert np.array_equal(file["paths/delay_s"], np.concatenate([frame["delay_s"] for frame in frames]))
        assert np.array_equal(file["paths/a_re"], np.concatenate([frame["a"].real for frame in frames]))


def main():
    folder = sys.argv[2]
    shutil.rmtree(folder, ignore_errors=True)
    raises(2, 'unknown key "trace.ray"', wavetracer.Simulation, "[trace]\nray = 1\n")
    raises(4, "no such device", wavetracer.Simulation, DRIVE, device="no such device")
    with wavetracer.Simulation(DRIVE, sets=["trace.seed=3"]) as simulation:
        assert simulation.times_s == [0, 0.1, 0.2], simulation.times_s
        assert simulation.transmitters == ["rsu"] and simulation.receivers[0].endswith("/roof")
        assert "seed = 3" in simulation.config
        frames = list(simulation.frames())
        for number, frame in enumerate(frames):
            assert frame.number == number
            check_frame(simulation, frame)
        raises(2, "no frame 3", simulation.run_frame, 3)
        raises(2, 'no column "delay"', lambda: frames[0]["delay"])
        simulation.write(folder, frames)
        check_files(folder, frames)
        check_missed(folder, frames)
        simulation.write(folder, frames[1:2])
        check_missed(folder, frames[1:2])
        raises(2, "sorted", simulation.write, folder, frames[::-1])
    raises(2, "self is null", simulation.run_frame, 0)
    # A sphere catches no exact paths: nothing is known of what it missed.
    with wavetracer.Simulation(DRIVE, sets=['trace.reception="sphere"']) as simulation:
        assert (unknown := simulation.run_frame(0)).missed is None
        assert np.all(np.isnan(unknown["link_missed_power_share"])) and len(unknown["link_missed_power_share"]) > 0
    del unknown
    # A view outlives its frame, and the frame its simulation.
    delay, copy = frames[0]["delay_s"], frames[0]["delay_s"].copy()
    del frames, frame, simulation
    gc.collect()
    assert np.array_equal(delay, copy)
    print("wavetracer", wavetracer.version(), "ok")


main()
