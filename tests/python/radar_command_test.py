#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The example of docs/radar.md: a run of configs/radar.toml, its radar.h5 against the drive and against the cubes of
Python, and the figures of `wavetracer plot`.

Usage: radar_command_test.py PROGRAM CONFIGS FOLDER. Exits with 77 without numpy or h5py.
"""
import pathlib
import subprocess
import sys

try:
    import h5py
    import numpy as np
except ImportError:
    sys.exit(77)
import wavetracer
from wavetracer import _radar_command, radar

PROGRAM, CONFIGS, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
RUN = FOLDER / "run"


def said(*command):
    done = subprocess.run([str(word) for word in command], check=False, capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


def column(file, name):
    return file["front"][name][...]


def check_example():
    """The car ahead, the pedestrian and the car that comes are where they are in the drive, with their speeds."""
    code, text = said(PROGRAM, "run", "-c", CONFIGS / "radar.toml", "-o", RUN, "--set", "trace.rays=5000", "--frames", "0:4")
    assert code == 0, text
    with h5py.File(RUN / "radar.h5") as file:
        found = {name: values[...] for name, values in file["front/detections"].items()}
        times = column(file, "frames/time_s")
        assert list(column(file, "frames/frame")) == [0, 1, 2, 3, 4] and column(file, "cube/re").shape == (5, 4, 1, 256, 256)
        assert np.array_equal(column(file, "spectrogram/time_s"), times)
    assert np.isnan(found["elevation_rad"]).all()
    bumper = -57.4 + 14 * times
    places = {"ahead": (-30.5 + 13 * times, -3.0 + 0 * times, 1.0), "pedestrian": (-32 + 0 * times, -6.0 + 1.2 * 0 * times, 13.9),
              "oncoming": (37.5 - 13 * times, 3.0 + 0 * times, 27.0)}
    for name, (x, y, speed) in places.items():
        ranges, azimuths = np.hypot(x - bumper, y + 3), np.arctan2(y + 3, x - bumper)
        for frame, (distance, azimuth) in enumerate(zip(ranges, azimuths)):
            near = ((found["frame"] == frame) & (np.abs(found["range_m"] - distance) < 0.6)
                    & (np.abs(found["speed_m_s"] - speed) < 0.5) & (np.abs(found["azimuth_rad"] - azimuth) < 0.03))
            assert near.any(), (name, frame, distance, azimuth, {key: values[found["frame"] == frame] for key, values in found.items()})
    # The strongest beam of the cell of a detection is the one of its azimuth; the radar looks along x.
    cube, angles = radar.load(RUN / "radar.h5")[2], np.radians(np.arange(-90, 90.5, 0.5))
    look = np.abs(cube.looking(np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1)))
    for i in np.flatnonzero(found["frame"] == 2)[:5]:
        cell = np.abs(cube.speed_m_s - found["speed_m_s"][i]).argmin(), np.abs(cube.range_m - found["range_m"][i]).argmin()
        assert abs(np.sin(angles[look[:, cell[0], cell[1]].argmax()]) - np.sin(found["azimuth_rad"][i])) < 0.02, i
    # Python finds the same cells in the cubes of the file.
    for frame, cube in radar.load(RUN / "radar.h5").items():
        again = cube.detections()
        for key in ("range_m", "speed_m_s", "power_dbm"):
            np.testing.assert_allclose(found[key][found["frame"] == frame], again[key], rtol=1e-3, atol=1e-3)


DIRECT = "direct = false          # without the path from one antenna to the other\n"


def quiet(*parts):
    """The example without noise and without these parts."""
    text = (CONFIGS / "radar.toml").read_text()
    for part in ("noise_figure_db = 12.0\n", *parts):
        assert part in text
        text = text.replace(part, "")
    return text


def check_arrays():
    """Cubes of all antennas, which send in turns, are those of Python, which asks the library for paths between
    elements."""
    text = quiet().replace('offset_m = [2.6, 0.1, 0.6]', 'array = "row"\noffset_m = [2.6, 0.1, 0.6]')
    config = FOLDER / "arrays.toml"
    config.write_text(text)
    sets = ("chirps=20", "samples=48", "turns=true", "chirp_s=5e-6", "interval_s=6e-6", "direct=true", "bandwidth_hz=100e6")
    options = [word for one in sets for word in ("--set", "radar.0." + one)]
    code, said_text = said(PROGRAM, "run", "-c", config, "-o", FOLDER / "arrays", "--frames", "3", "--set", "trace.rays=5000", *options)
    assert code == 0, said_text
    run = wavetracer.open(FOLDER / "arrays")
    cube = radar.cube(wavetracer.Simulation(run.config).run_frame(3).paths, radar.waveform_of(run.config))
    assert cube.values.shape == (4, 4, 20, 48)
    stored = radar.load(FOLDER / "arrays/radar.h5")[3]
    peak = np.abs(cube.values).max()
    assert np.abs(stored.values - cube.values).max() < 1e-6 * peak
    with h5py.File(FOLDER / "arrays/radar.h5") as file:
        expected = 1e3 * (np.abs(cube.values) ** 2).mean(axis=(0, 1))
        assert np.abs(10 ** (column(file, "maps/power_dbm")[0] / 10) - expected).max() < 1e-9 * expected.max()


def check_equal():
    """The maps of the program are those of Python, which has code of its own, to 1e-9 of their peaks."""
    text = quiet("array = \"row\"\n", '[[array]]\nname = "row"\ncolumns = 4\n', DIRECT)
    config = FOLDER / "equal.toml"
    config.write_text(text + '[[radar]]\nname = "rear"\ncube = false\ndirect = false\nrange_window = "none"\ndoppler_window = "blackman"\n'
                             "chirps = 30\nsamples = 50\nbandwidth_hz = 1e9\n")
    options = ("--frames", "2:5", "--set", "trace.rays=5000", "--set", "output.shard_frames=2")
    code, said_text = said(PROGRAM, "run", "-c", config, "-o", FOLDER / "equal", *options)
    assert code == 0, said_text
    run = wavetracer.open(FOLDER / "equal")
    with h5py.File(FOLDER / "equal/radar.h5") as file:
        indirect = [kind for kind in wavetracer.paths.KINDS if kind != "line_of_sight"]
        for name, windows, kinds in (("front", ("hann", "hann"), None), ("rear", ("none", "blackman"), indirect)):
            wave, maps = radar.waveform_of(run.config, name), file[name]["maps/power_dbm"][...]
            for i, frame in enumerate(run):
                paths = frame.paths.select(kind=kinds)
                cube = radar.cube(paths, wave, range_window=windows[0], doppler_window=windows[1])
                expected = (np.abs(cube.values[0, 0]) ** 2) * 1e3
                assert np.abs(10 ** (maps[i] / 10) - expected).max() < 1e-9 * expected.max(), (name, i)
                assert file[name]["frames/left_out"][i] == cube.left_out
                assert np.allclose(file[name]["doppler_hz"], cube.doppler_hz, rtol=1e-12)
                if name == "front":
                    values = file["front/cube/re"][i] + 1j * file["front/cube/im"][i]
                    assert np.abs(values - cube.values).max() < 1e-6 * np.abs(cube.values).max()
                    spectrum = radar.spectrogram(radar.beat(paths, wave), wave, wave.chirps, wave.chirps)[2][0]
                    np.testing.assert_allclose(file["front/spectrogram/power_dbm"][i], spectrum, atol=1e-6)
        whole = {name: file[name][...] for name in ("front/maps/power_dbm", "front/detections/range_m", "rear/frames/frame")}
        assert "cube" not in file["rear"] and len(whole["front/maps/power_dbm"]) == 4
    # Several processes write the same.
    code, said_text = said(PROGRAM, "run", "-c", config, "-o", FOLDER / "shared", *options, "--processes", 2)
    assert code == 0, said_text
    with h5py.File(FOLDER / "shared/radar.h5") as file:
        for name, values in whole.items():
            assert np.array_equal(file[name][...], values), name
    for options, part in ((("radar.0.transmitter=own/send",), 'radar "front": transmitter'), (("links.same_vehicle=false",), "give links.same_vehicle = true"),
                          (("radar.1.turns=true",), "turns = true has no effect"), (("radar.0.samples=65536", "radar.0.chirps=65536", "radar.0.chirp_s=3e-4",
                           "radar.0.interval_s=3e-4"), "are the limit"),
                          (("radar.0.kind=bistatic",), "all of them are on one vehicle"), (("links.receivers=[\"o*\"]", "radar.0.receiver=x"), "receiver")):
        sets = [word for option in options for word in ("--set", option)]
        code, said_text = said(PROGRAM, "run", "-c", config, "-o", FOLDER / "refused", *sets)
        assert code == 2 and part in said_text, said_text


STILL = """
[scene]
generate = "--seed 1 --blocks 2x2"
extrapolate_materials = true
[radio]
frequency_hz = 77e9
[trace]
rays = 2000
max_depth = 0
"""


def check_pairs():
    """Fixed ends: all pairs are monostatic radars, and a bistatic one hears the direct path with the power of Friis. Blocks
    of links in two processes make the same file."""
    places = {"a": (3, -40), "b": (3, 40), "c": (40, 3)}
    text = STILL + "".join(f'[[transmitter]]\nname = "{name}/tx"\nposition_m = [{x}, {y}, 2]\n' for name, (x, y) in places.items())
    text += "".join(f'[[receiver]]\nname = "{name}/rx"\nposition_m = [{x}.2, {y}, 2]\n' for name, (x, y) in places.items() if name != "c")
    length = np.hypot(80, 0.2)
    text += ('[[radar]]\nname = "all"\nchirps = 16\nsamples = 200\nbandwidth_hz = 200e6\nnoise_figure_db = 10.0\n[[radar]]\n'
             'name = "pair"\ntransmitter = "a/*"\nreceiver = "b/*"\nkind = "bistatic"\nchirps = 16\nsamples = 128\n'
             f"bandwidth_hz = {54 * 299792458.0 / length!r}\n")  # the direct path is in the middle of a cell
    config = FOLDER / "still.toml"
    config.write_text(text)
    crowd = FOLDER / "crowd.toml"
    crowd.write_text(text + '[[receiver]]\nname = "c/rx"\nposition_m = [40.2, 3, 2]\n')
    large = [word for one in ("chirps=8192", "samples=8192", "chirp_s=1e-4") for word in ("--set", "radar.0." + one)]
    code, said_text = said(PROGRAM, "run", "-c", crowd, "-o", FOLDER / "crowd", *large)
    assert code != 0 and "603981824 cells of all links" in said_text and "give radar.cube = false" in said_text, said_text
    code, said_text = said(PROGRAM, "run", "-c", config, "-o", FOLDER / "fewer", "--set", 'links.receivers=["a/*"]', "--set", "radar.1.receiver=a/rx")
    assert code == 0 and 'radar "all": 3 of its 6 pairs of ends are left out; the link from "c/tx" to "b/rx"' in said_text, said_text
    assert 'links.receivers leaves out its receiver' in said_text and 'radar "pair"' not in said_text, said_text
    files = []
    for folder, options in (("alone", ()), ("together", ("--processes", 2))):
        code, said_text = said(PROGRAM, "run", "-c", config, "-o", FOLDER / folder, *options)
        assert code == 0, said_text
        files.append((FOLDER / folder / "radar.h5").read_bytes())
    assert files[0] == files[1]
    with h5py.File(FOLDER / "alone/radar.h5") as file:
        assert [list(file["all/frames"][end][...]) for end in ("tx", "rx")] == [[0, 0, 1, 1, 2, 2], [0, 1, 0, 1, 0, 1]]
        assert [list(file["pair/frames"][end][...]) for end in ("tx", "rx")] == [[0], [1]]
        found = {name: values[0] for name, values in file["pair/detections"].items()}
    friis = 10 + 20 * np.log10(299792458.0 / 77e9 / (4 * np.pi * length))
    assert abs(found["range_m"] - length / 2) < 0.05 and found["speed_m_s"] == 0, found
    assert abs(found["power_dbm"] - friis) < 0.2, (found, friis)
    assert len(radar.load(FOLDER / "alone/radar.h5", "all", tx=2, rx=0)) == 1


def check_bistatic():
    """The car ahead hears the radar: the direct path has the way from bumper to bumper, and shortens by 1 m/s."""
    config = FOLDER / "bistatic.toml"
    config.write_text(quiet("direct = false          # without the path from one antenna to the other\n"))
    options = ("-o", FOLDER / "bistatic", "--frames", "0", "--set", "trace.rays=2000", "--set", "mount.1.on=ahead")
    code, text = said(PROGRAM, "run", "-c", config, *options)
    assert code == 2 and "no pair of its ends is monostatic" in text and 'or kind = "bistatic"' in text, text
    code, text = said(PROGRAM, "run", "-c", config, *options, "--set", "radar.0.kind=bistatic")
    assert code == 0, text
    with h5py.File(FOLDER / "bistatic/radar.h5") as file:
        found = {name: values[0] for name, values in file["front/detections"].items()}
        assert len(column(file, "frames/frame")) == 1
    assert abs(found["range_m"] - np.hypot(32, 0.2) / 2) < 0.1 and abs(found["speed_m_s"] - 0.5) < 0.05, found
    assert abs(found["azimuth_rad"] - 0.2 / 32) < 0.01, found  # it comes from behind, which a row takes for ahead


def check_command():
    """The command of Python takes the waveform of the run, and options replace it."""
    command = [sys.executable, "-m", "wavetracer.radar", RUN]
    elsewhere = (*command, "-o", FOLDER / "none.h5")
    code, text = said(*elsewhere, "--frames", "70:80")
    assert code == 2 and "frames 0 to 4" in text, text
    code, text = said(*elsewhere, "--window", "kaiser")
    assert code == 2 and "there is no window" in text, text
    code, text = said(*elsewhere, "--radar", "side")
    assert code == 2 and "the run has the radars front" in text, text
    # The file of the run is only replaced if -o names it; a file of the command itself is replaced.
    before = (RUN / "radar.h5").read_bytes()
    code, text = said(*command)
    assert code == 2 and "is what the run wrote" in text and f"-o {RUN / 'radar.h5'} to replace it" in text, text
    assert (RUN / "radar.h5").read_bytes() == before
    code, text = said(*command, "--frames", "0:0", "-o", RUN / "radar.h5")
    assert code == 0 and len(radar.load(RUN / "radar.h5")) == 1, text
    code, text = said(*command, "--frames", "0:1")
    assert code == 0 and len(radar.load(RUN / "radar.h5")) == 2, text
    (RUN / "radar.h5").write_bytes(before)
    names = ("a[1]/x", "a1/x", "a2/x")
    for pattern, name in (("a[1]/?", names[0]), ("a1*", names[1]), ("a?/x", None), ("*.x", None)):
        assert _radar_command._one_name({"transmitter": pattern}, "transmitter", names) == name, pattern
    code, text = said(*command, "--samples", 64, "-o", FOLDER / "short.h5")
    assert code == 0 and "are later than 2.13333e-07 s and left out" in text and "the run has arrays" in text, text
    code, text = said(*command, "--osi", FOLDER / "radar.osi", "-o", FOLDER / "again.h5")
    assert code == 0 and "5 frames without direct paths" in text, text
    cubes = radar.load(FOLDER / "again.h5")
    assert radar.names(FOLDER / "again.h5") == ["front"] and cubes[0].values.shape == (1, 1, 256, 256)
    assert (FOLDER / "radar.osi").stat().st_size > 1000


def check_plots():
    code, text = said(PROGRAM, "plot", RUN, "--what", "range-doppler,micro-doppler", "--frame", 3, "-o", FOLDER / "plots")
    assert code == 0, text
    rows = (FOLDER / "plots/range_doppler.csv").read_text().splitlines()
    assert rows[0] == "speed_m_s,range_m,power_dbm" and len(rows) == 1 + 256 * 256
    table = np.array([[float(cell) for cell in row.split(",")] for row in rows[1:]])
    np.testing.assert_allclose(table[:, 2].reshape(256, 256), radar.load(RUN / "radar.h5")[3].power_dbm, atol=1e-3)
    rows = (FOLDER / "plots/micro_doppler.csv").read_text().splitlines()
    assert rows[0] == "time_s,speed_m_s,power_dbm" and len(rows) == 1 + 5 * 256
    if "gnuplot" not in text:
        assert b"<svg" in (FOLDER / "plots/range_doppler.svg").read_bytes()[:2000]
    for options, part in ((("--radar", "side"), "has no radar"), (("--frame", 9), "no such frame"), (("--tx", "own/hears"), "--tx")):
        code, text = said(PROGRAM, "plot", RUN, "--what", "range-doppler", *options, "-o", FOLDER / "plots")
        assert code == 2 and part in text, text
    code, text = said(PROGRAM, "plot", FOLDER / "equal", "--what", "range-doppler", "--radar", "rear", "-o", FOLDER / "plots")
    assert code == 0 and len((FOLDER / "plots/range_doppler.csv").read_text().splitlines()) == 1 + 30 * 50, text
    with h5py.File(RUN / "radar.h5", "r+") as file:
        file["front/frames/frame"][...] = 7
    code, text = said(PROGRAM, "plot", RUN, "--what", "range-doppler", "-o", FOLDER / "plots")
    assert code == 3 and "/front/frames/frame" in text, (code, text)
    (RUN / "radar.h5").unlink()
    code, text = said(PROGRAM, "plot", RUN, "--what", "range-doppler", "-o", FOLDER / "plots")
    assert code == 2 and "python3 -m wavetracer.radar" in text, text


def check_plate():
    """Echoes of a plate of 0.3 m x 0.3 m at 8 m are one detection with the power of the radar equation, 4 pi A^2 / lambda^2
    at normal incidence, less what the near field costs: 8 m is less than 2 D^2 / lambda = 46 m."""
    (FOLDER / "plate.obj").write_text("v 8 -0.15 -0.15\nv 8 0.15 -0.15\nv 8 0.15 0.15\nv 8 -0.15 0.15\nf 1 2 3\nf 1 3 4\n")
    carrier, wave = 77e9, radar.Waveform(1e9, 20e-6, chirps=32, samples=128)
    found = radar.echoes(FOLDER / "plate.obj", carrier, [0, 0, 0], [0, 0, 0], "--up=z", "--echo-size=0.1")
    assert found["a"].shape == (len(found["delay_s"]), 2, 2) and (found["bounces"] == 1).all()
    assert np.allclose(found["first_m"][:, 0], 8) and np.array_equal(found["first_m"], found["last_m"])
    cube = radar.cube_of(radar.beat_of_echoes(found["delay_s"], found["a"][:, 0, 0], wave, carrier, 2000.0), wave, carrier)
    peak = cube.detections()
    assert abs(peak["range_m"][0] - 8) < 0.05 and abs(peak["doppler_hz"][0] - 2000) < 250
    # The field of a plate at this distance by Fresnel integrals, over that of the far field.
    wavelength = 299792458.0 / carrier
    x = (np.arange(20000) + 0.5) / 20000 * 0.15
    near = abs(np.mean(np.exp(-2j * np.pi / wavelength * x**2 / 8))) ** 2
    far = wavelength / (4 * np.pi) * (0.09 / wavelength) / 64
    expected = 10 + 20 * np.log10(far * near)
    assert abs(20 * np.log10(abs((found["a"][:, 0, 0] * np.exp(-2j * np.pi * carrier * found["delay_s"])).sum())) + 10
               - expected) < 0.2
    assert abs(peak["power_dbm"][0] - expected) < 2


FOLDER.mkdir(parents=True, exist_ok=True)
check_example()
check_equal()
check_arrays()
check_pairs()
check_bistatic()
check_command()
check_plots()
check_plate()
print("radar of a run ok")
