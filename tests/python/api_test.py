#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The Python package on a device: columns against closed forms and against what h5py reads, links, saved runs, pages,
errors, Ctrl-C, lifetimes.

Usage: api_test.py FOLDER. wavetracer is installed, or PYTHONPATH names it, and WAVETRACER_LIBRARY and
WAVETRACER_PROGRAM what it calls. Exits with 77 without numpy or h5py.
"""
import csv
import gc
import json
import os
import pathlib
import shutil
import signal
import sys

try:
    import h5py
    import numpy as np
except ImportError:
    sys.exit(77)
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


CLASSES = {1: wavetracer.RunError, 2: wavetracer.ConfigError, 3: wavetracer.InputError, 4: wavetracer.DeviceError}


def raises(code, part, function, *arguments, **named):
    try:
        function(*arguments, **named)
    except wavetracer.Error as error:
        assert type(error) is CLASSES[code] and error.code == code and part in str(error), repr(error)
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
    # Rays have found something of every link with a path, and nothing of one without.
    shares = frame["link_missed_power_share"]
    assert shares.shape == (len(frame["link"]),)
    with_path = [np.any((frame["tx"] == tx) & (frame["rx"] == rx)) for tx, rx in frame["link"]]
    assert any(with_path) and np.array_equal(np.isfinite(shares), with_path) and np.all(shares[with_path] >= 0)
    assert max(frame["rx"]) < len(simulation.receivers)


def check_missed(folder, frames):
    """The estimates of missed paths are those in the files; those of summary.json are compared for a single frame only,
    since estimates of frames are not simply added."""
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
    with h5py.File(folder + "/paths.h5") as file:
        assert np.array_equal(file["paths/delay_s"], np.concatenate([frame["delay_s"] for frame in frames]))
        assert np.array_equal(file["paths/a_re"], np.concatenate([frame["a"].real for frame in frames]))


def check_paths(frame):
    """Attributes are the columns, kinds those of the interactions, and what select() leaves is what a mask leaves."""
    paths = frame.paths
    assert len(paths) == len(frame) and paths.frequency_hz == 5.9e9
    for name in ("tx", "rx", "depth", "delay_s", "gain_db", "a", "aod_theta_rad", "aod_phi_rad", "aoa_theta_rad",
                 "aoa_phi_rad", "doppler_hz", "vertex_offset", "vertex_position_m", "vertex_interaction",
                 "vertex_surface", "vertex_instance"):
        assert np.array_equal(getattr(paths, name), frame[name]) and np.shares_memory(getattr(paths, name), frame[name])
    assert np.array_equal(paths.kind == "line_of_sight", frame["depth"] == 0) and set(paths.kind) <= set(
        ("line_of_sight", "reflected"))
    wanted = (frame["rx"] == 1) & (frame["depth"] > 0)
    some = paths.select(rx=[1], kind="reflected")
    assert 0 < len(some) == wanted.sum() and np.array_equal(some.delay_s, frame["delay_s"][wanted])
    assert some.receivers == [paths.receivers[1]] and some.transmitters == paths.transmitters
    rows = np.flatnonzero(wanted)
    for i, row in enumerate(rows):
        assert np.array_equal(some.points(i), paths.points(row)) and len(paths.points(row)) == frame["depth"][row]
    assert len(paths.select(rx="*/roof")) == len(paths) and len(paths.select(tx="rsu", rx=(0, "veh1*"))) > 0
    assert some.select(rx=0).receivers == [] and len(some.select(rx=0)) == 0
    raises(2, "no transmitter 'rsv'; there are 1: rsu", paths.select, tx="rsv")
    raises(2, "no receiver 99", paths.select, rx=99)
    raises(2, "no paths of kind 'los'", paths.select, kind="los")
    raises(2, 'no column "gain" of links', lambda: paths.links["gain"])
    # The figures of chosen paths, from the columns, are those of the library where all paths are chosen.
    figures, again = frame.links, paths.select(kind=("line_of_sight", "reflected")).links
    for name in ("tx", "rx", "paths", "los", "path_gain_db", "sum_of_powers_db", "narrowband_gain_db", "mean_delay_s", "rms_delay_spread_s",
                 "doppler_spread_hz"):
        np.testing.assert_allclose(again[name].astype(float), figures[name].astype(float), rtol=1e-9, atol=1e-9)
    assert len(paths.select(rx=1).links) == (figures["rx"] == 1).sum()
    # A frequency response at the carrier is the coherent gain of the link.
    h = paths.cfr(0.0, normalize_delays=False)
    assert h.shape == (len(paths.receivers), 1, 1, 1, 1, 1)
    for t, r, gain in zip(figures["tx"], figures["rx"], figures["narrowband_gain_db"]):
        assert gain == -np.inf and h[r, 0, t, 0, 0, 0] == 0 or abs(20 * np.log10(abs(h[r, 0, t, 0, 0, 0])) - gain) < 1e-6


def check_run(run, frames):
    """A saved run says what the frames say that it was made of."""
    assert len(run) == len(frames) and run.times_s == [frame.time_s for frame in frames]
    assert run.receivers == frames[0].paths.receivers and run.transmitters == ["rsu"] and run.frequency_hz == 5.9e9
    assert "seed = 3" in run.config and run.summary["counts"]["paths"] == sum(map(len, frames))
    for saved, frame in zip(run, frames):
        assert saved.number == frame.number and len(saved) == len(frame)
        for name in ("delay_s", "a", "vertex_offset", "vertex_position_m", "vertex_surface", "doppler_hz", "tx"):
            assert np.array_equal(getattr(saved.paths, name), frame[name]), name
        assert np.array_equal(saved.receiver_position_m, frame.receiver_position_m)
        assert np.array_equal(saved.paths.cfr([-1e6, 1e6]), frame.paths.cfr([-1e6, 1e6]))
        for name in saved.links.columns:  # links.csv has fewer digits
            np.testing.assert_allclose(saved.links[name].astype(float), frame.links[name].astype(float), rtol=1e-5,
                                       atol=1e-2 if name.endswith("_db") else 0)
    assert np.array_equal(run.links["frame"], np.concatenate([np.full(len(f.links), f.number) for f in frames]))
    assert np.array_equal(run[-1].paths.delay_s, frames[-1].paths.delay_s)
    try:
        run[len(run)]
    except IndexError as error:
        assert "no frame 3" in str(error)
    else:
        raise AssertionError("a frame that is not there")


def check_open(folder, run):
    """Files that cannot be opened, and folders without a complete run, give errors."""
    raises(3, "no such file", wavetracer.open, folder / "nowhere")
    work = folder.parent / "python_bad"
    shutil.rmtree(work, ignore_errors=True)
    (work / "shards").mkdir(parents=True)
    raises(3, "run --resume", wavetracer.open, work)
    (work / "paths.h5").write_text("no HDF5")
    raises(3, "cannot be read", wavetracer.open, work)
    with h5py.File(work / "paths.h5", "w"):
        pass
    raises(3, "no paths.h5 of wavetracer", wavetracer.open, work)
    shutil.copy(folder / "paths.h5", work)
    lines = (folder / "links.csv").read_text().splitlines()
    (work / "links.csv").write_text("\n".join(lines[:-1]) + "\n")
    raises(3, "of two runs", lambda: wavetracer.open(work).links)
    page = wavetracer.view(run)
    assert "<canvas" in page.html and page._repr_html_().startswith("<iframe srcdoc=")
    page.save(work / "page.html")
    assert (work / "page.html").read_text() == page.html
    raises(3, "nowhere", wavetracer.view, folder / "nowhere")


def check_configs(folder):
    """A text, a file and a dict are the same configuration, and keys are set over it in both spellings."""
    config = {"scene": {"generate": "--seed 1 --blocks 2"}, "trace": {"rays": np.int64(5000), "max_depth": 2},
              "transmitter": [{"name": 't "one"\n', "position_m": np.array([0, 0, 6.0])}],
              "receiver": [{"name": "r", "position_m": [30, 0, 6], "velocity_m_s": None}]}
    raises(2, "control character", wavetracer.Simulation, config)
    config["transmitter"][0]["name"] = 't "one" \\ ü'
    file = folder / "config.toml"
    with wavetracer.Simulation(config, trace={"seed": 7}, **{"radio.frequency_hz": 28e9}) as simulation:
        assert simulation.transmitters == ['t "one" \\ ü'] and simulation.frequency_hz == 28e9 and len(simulation) == 1
        assert "rays = 5000" in simulation.config and "seed = 7" in simulation.config
        file.write_text(simulation.config)
        delay_s = simulation.run_frame().paths.delay_s
        assert abs(delay_s[0] - 30 / 299792458) < 1e-16
    with wavetracer.Simulation(file) as simulation:
        assert np.array_equal(simulation.run_frame().paths.delay_s, delay_s)
    raises(2, 'unknown key "trace.ray"', wavetracer.Simulation, file, trace={"ray": 1})
    raises(2, "trace.rays is", wavetracer.Simulation, config | {"trace": {"rays": object()}})
    raises(3, "nowhere.toml: the configuration cannot be read: No such file", wavetracer.Simulation, "nowhere.toml")
    assert (wavetracer.configs / "demo.toml").exists()


class Bar:
    """tqdm's interface, noting what it is told."""
    made = []

    def __init__(self, total, **_):
        self.total, self.n, self.told, self.closed = total, 0, [], False
        Bar.made.append(self)

    def set_postfix_str(self, text, refresh):
        self.told.append(text)

    def update(self, n):
        self.n += n

    def close(self):
        self.closed = True


def check_progress(simulation):
    assert [frame.number for frame in simulation.frames(range(1, 3), progress=Bar)] == [1, 2]
    bar = Bar.made[-1]
    assert bar.total == bar.n == 2 and bar.closed and any(t.startswith("rays") for t in bar.told) \
        and any(t.startswith("paths") for t in bar.told), bar.told
    # Ctrl-C in the middle of a frame: the frame is cancelled, and the simulation can continue.
    class Pressed(Bar):
        def set_postfix_str(self, text, refresh):
            os.kill(os.getpid(), signal.SIGINT)
    try:
        list(simulation.frames(progress=Pressed))
    except KeyboardInterrupt:
        assert Bar.made[-1].n == 0 and Bar.made[-1].closed
    else:
        raise AssertionError("Ctrl-C was lost")
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    # The same holds for a bar that fails.
    class Broken(Bar):
        def update(self, n):
            raise ZeroDivisionError("in the bar")
    try:
        list(simulation.frames(progress=Broken))
    except ZeroDivisionError:
        assert Bar.made[-1].closed
    else:
        raise AssertionError("the bar's error was lost")
    assert len(simulation.run_frame(0)) > 1


def check_arrays(folder):
    """Line of sight between a panel and a pair: every channel by the distance of its elements, with a wave of length
    c / f; the order of antennas is port * elements + element. Responses of the saved run are the same."""
    config = {"scene": {"generate": "--blocks 2"}, "trace": {"max_depth": 0},
              "array": [{"name": "panel", "rows": 2, "columns": 3, "vertical_spacing_m": 0.5, "horizontal_spacing_m": 0.4},
                        {"name": "pair", "positions_m": [[0, -0.1, 0], [0, 0.1, 0.05]]}],
              "transmitter": [{"name": "t", "position_m": [0, 0, 6], "array": "panel"}],
              "receiver": [{"name": "one", "position_m": [20, 1, 6], "polarization": "VH"},
                           {"name": "two", "position_m": [12, -2, 4], "array": "pair"}],
              "response": {"bandwidth_hz": 40e6, "subcarriers": 16, "times": 2, "time_step_s": 1e-3}}
    simulation = wavetracer.Simulation(config)
    frame = simulation.run_frame()
    places = {name: simulation.element_positions_m(name) for name in ("t", "one", "two")}
    assert [len(place) for place in places.values()] == [6, 1, 2] and places["one"].tolist() == [[0, 0, 0]]
    raises(2, "no transmitter or receiver 'x'", simulation.element_positions_m, "x")
    frequencies = np.linspace(-20e6, 20e6, 5)
    h = frame.paths.cfr(frequencies, normalize_delays=False)
    assert h.shape == (2, 4, 1, 6, 1, 5)  # two ports of the one, two elements of the other
    for r, name in enumerate(("one", "two")):
        ends = np.array(config["receiver"][r]["position_m"]) + places[name], np.array([0, 0, 6]) + places["t"]
        d = np.linalg.norm(ends[0][:, None] - ends[1], axis=2)
        wanted = 299792458 / 5.9e9 / (4 * np.pi * d[..., None]) * np.exp(
            -2j * np.pi * ((5.9e9 + frequencies) * d[..., None] / 299792458 % 1))
        assert np.abs(h[r, :len(d), 0, :, 0] - wanted).max() < 1e-9 * np.abs(wanted).max()
    # The receiver "two" has one port: its second half, and the port H of "one" in this line of sight, are zero.
    assert not h[1, 2:].any() and np.abs(h[0, 2:]).max() < 1e-9 * np.abs(h[0, 0]).max()
    only = frame.paths.select(rx="two")
    assert only.cfr(0).shape == (1, 4, 1, 6, 1, 1) and only.cir()[0].shape == (1, 4, 1, 6, 1, 1)
    assert np.allclose(only.cir(normalize_delays=False)[0][..., 0, 0], h[1:, ..., 0, 2], rtol=1e-9, atol=0)
    delay, amplitude = only.elements()
    assert delay.shape == amplitude.shape == (1, 2, 6) and np.allclose(delay[0] * 299792458, d, rtol=1e-12)
    run = simulation.write(folder / "arrays", [frame])
    axis, saved = run.responses.frequencies_hz - 5.9e9, run[0].response("t", "two")
    assert saved.shape == (2, 6, 2, 16) and run.responses.times_s.tolist() == [0, 1e-3]
    fresh = frame.paths.cfr(axis, run.responses.times_s, normalize_delays=False)[1, :2, 0]
    assert np.abs(saved - fresh).max() < 1e-6 * np.abs(fresh).max()
    assert run[0].response(0, 0).shape == (2, 6, 2, 16)
    raises(2, "no receiver 'three'", run[0].response, "t", "three")
    raises(2, "no link from transmitter 0 to receiver 7", run[0].response, 0, 7)
    raises(2, "centres of arrays", run[0].paths.cfr, 0)
    assert frame["response"].dtype == np.complex64
    simulation.close()
    raises(2, "was closed", frame.paths.cfr, 0)


def check_carriers():
    """A second carrier is what a simulation at that frequency alone finds."""
    config = {"scene": {"generate": "--seed 1 --blocks 2"}, "trace": {"max_depth": 2, "rays": 5000},
              "transmitter": [{"name": "t", "position_m": [0, 0, 6], "velocity_m_s": [9, 0, 0]}],
              "receiver": [{"name": "r", "position_m": [40, 3, 2], "polarization": "VH"}]}
    both = wavetracer.Simulation(config, radio={"frequencies_hz": [5.9e9, 28e9]})
    alone = wavetracer.Simulation(config, radio={"frequency_hz": 28e9})
    assert both.carriers_hz == [5.9e9, 28e9] and alone.carriers_hz == [28e9] and both.frequency_hz == 5.9e9
    paths, wanted = both.run_frame().paths, alone.run_frame().paths
    there = paths.at_carrier(1)
    assert paths.at_carrier(0) is paths and there.frequency_hz == 28e9 and len(there) == len(wanted) > 2
    for name in ("a", "gain_db", "doppler_hz", "delay_s"):
        assert np.array_equal(getattr(there, name), getattr(wanted, name)), name
    assert np.array_equal(there.select(kind="reflected").cfr([0, 1e6]), wanted.select(kind="reflected").cfr([0, 1e6]))
    for name in ("path_gain_db", "narrowband_gain_db", "doppler_spread_hz"):
        np.testing.assert_allclose(there.links[name], wanted.links[name], rtol=1e-9)
    raises(2, "no carrier 2; there are 2: 5.9e+09 Hz", paths.at_carrier, 2)


def main():
    folder = sys.argv[1]
    shutil.rmtree(folder, ignore_errors=True)
    assert any(device["kind"] in ("GPU", "CPU", "other") for device in wavetracer.devices())
    raises(2, 'unknown key "trace.ray"', wavetracer.Simulation, "[trace]\nray = 1\n")
    raises(4, "no such device", wavetracer.Simulation, DRIVE, device="no such device")
    with wavetracer.Simulation(DRIVE, trace={"seed": 3}) as simulation:
        assert simulation.times_s == [0, 0.1, 0.2], simulation.times_s
        assert simulation.transmitters == ["rsu"] and simulation.receivers[0].endswith("/roof")
        assert "seed = 3" in simulation.config
        frames = list(simulation.frames())
        for number, frame in enumerate(frames):
            assert frame.number == number
            check_frame(simulation, frame)
            check_paths(frame)
        raises(2, "no frame 3", simulation.run_frame, 3)
        raises(2, 'no column "delay"', lambda: frames[0]["delay"])
        with simulation.write(folder, frames) as run:
            check_run(run, frames)
            check_open(pathlib.Path(folder), run)
        check_files(folder, frames)
        check_missed(folder, frames)
        simulation.write(folder, frames[1:2])
        check_missed(folder, frames[1:2])
        raises(2, "sorted", simulation.write, folder, frames[::-1])
        raises(2, "frames that this simulation", simulation.write, folder, [1])
        check_progress(simulation)
    raises(2, "was closed", simulation.run_frame, 0)
    check_configs(pathlib.Path(folder))
    check_arrays(pathlib.Path(folder))
    check_carriers()
    raises(2, "no response.bandwidth_hz", lambda: wavetracer.open(folder).responses)
    # A sphere catches no exact paths: the missed power is unknown.
    with wavetracer.Simulation(DRIVE, trace={"reception": "sphere"}) as simulation:
        assert (unknown := simulation.run_frame(0)).missed is None
        assert np.all(np.isnan(unknown["link_missed_power_share"])) and len(unknown["link_missed_power_share"]) > 0
    with wavetracer.Simulation(DRIVE, trace={"discovery": "beams", "max_depth": 2}) as simulation:
        beams = simulation.run_frame(0)
        assert beams.missed is None and unknown.certificate is None
        assert beams.certificate["depth"] == 2 and 0 <= beams.certificate["left_out_sr"] < 1e-6
        assert 0 <= beams.certificate["left_out_share"] <= beams.certificate["left_out_sr"]
        assert 0 <= beams.certificate["left_out_power"] <= beams.certificate["left_out_sr"]
        assert beams.certificate["edges"] == 0
        assert beams.certificate["any_depth"] is False and "floor_db" not in beams.certificate
    with wavetracer.Simulation(DRIVE, trace={"discovery": "beams", "max_depth": 64, "floor_db": -100}) as simulation:
        floor = simulation.run_frame(0).certificate
        assert floor["any_depth"] is True and floor["floor_db"] == -100 and 0 < floor["weak_share"] < 1, floor
    raises(2, "trace.floor_db = -100 leaves out beams that are too weak, but rays are not left out",
           lambda: wavetracer.Simulation(DRIVE, trace={"floor_db": -100}))
    del unknown, beams
    # A view outlives its frame, and the frame its simulation.
    delay, copy = frames[0]["delay_s"], frames[0]["delay_s"].copy()
    del frames, frame, simulation, run
    gc.collect()
    assert np.array_equal(delay, copy)
    print("wavetracer", wavetracer.version(), "ok")


main()
