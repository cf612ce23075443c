#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Radar signals of made-up paths: samples against the formula of docs/radar.md, cubes against closed forms. No device is
used.

Usage: radar_test.py FOLDER. Exits with 77 without numpy or h5py.
"""
import pathlib
import sys

try:
    import h5py  # noqa: F401
    import numpy as np
except ImportError:
    sys.exit(77)
import wavetracer
from wavetracer import radar
from wavetracer.links import Ends
from wavetracer.paths import Paths

C, CARRIER = 299792458.0, 77e9
FOLDER = pathlib.Path(sys.argv[1])
WAVE = radar.Waveform(bandwidth_hz=1e9, chirp_s=20e-6, chirps=64, samples=128, interval_s=25e-6, power_dbm=30)


def made(delay_s, doppler_hz, a, elements=None, names=(("t",), ("r",))):
    n = len(delay_s)
    columns = {"tx": np.zeros(n, np.uint32), "rx": np.zeros(n, np.uint32), "delay_s": np.array(delay_s, float),
               "a": np.array(a, complex).reshape(n, 1, 1), "doppler_hz": np.array(doppler_hz, float)}
    counts = ((), ()) if elements is None else tuple((k,) for k in elements[0].shape[1:][::-1])
    between = None if elements is None else lambda rows, shape: (elements[0][rows], elements[1][rows])
    return Paths(columns.__getitem__, Ends(*names, CARRIER, *counts), elements=between)


def refused(call, part):
    try:
        call()
    except wavetracer.Error as error:
        assert part in str(error), error
    else:
        raise AssertionError("taken: " + part)


def check_samples():
    """Every sample is the sent chirp times the conjugate of the received one, from their phases in exact time."""
    delay, doppler, a = [21.3e-9, 77.7e-9], [4000.0, -9000.0], [0.3 - 0.1j, 0.05j]
    signal = radar.beat(made(delay, doppler, a), WAVE)[0, 0]
    slope, low = WAVE.bandwidth_hz / WAVE.chirp_s, CARRIER - WAVE.bandwidth_hz / 2

    def sent_cycles(t):
        return low * t + slope * t * t / 2

    for n, s in ((0, 0), (0, 127), (17, 64), (63, 127)):
        t = s * WAVE.chirp_s / WAVE.samples
        expected = 0
        for tau0, shift, gain in zip(delay, doppler, a):
            tau = tau0 - shift / CARRIER * (n * WAVE.interval_s + t)
            expected += gain * np.exp(2j * np.pi * (sent_cycles(t - tau) - sent_cycles(t)))
        assert abs(signal[n, s] - expected) < 1e-6, (n, s, signal[n, s], expected)


def check_peak():
    """A path is in the cell of its delay and shift, with its power; a receding one has a negative shift."""
    delay, doppler = 40 / 1e9, 5 / (64 * 25e-6)
    cube = radar.cube(made([delay], [doppler], [1e-4]), WAVE)
    n, s = np.unravel_index(cube.power_dbm.argmax(), cube.power_dbm.shape)
    assert abs(cube.delay_s[s] - delay) < 0.5e-9 and abs(cube.doppler_hz[n] - doppler) < 400
    assert abs(cube.power_dbm.max() - (30 - 80)) < 0.3  # the Doppler shift moves the beat within a cell
    assert abs(cube.range_m[s] - 40e-9 * C / 2) < 1e-6 and cube.speed_m_s[n] > 0
    found = cube.detections()
    assert len(found["range_m"]) >= 1 and abs(found["delay_s"][0] - delay) < 0.2e-9
    assert abs(found["doppler_hz"][0] - doppler) < 60
    away = radar.cube(made([delay], [-doppler], [1e-4]), WAVE)
    assert away.doppler_hz[away.power_dbm.max(axis=1).argmax()] < 0
    # Levels of the cells about a path between two cells are those of the windows' transforms.
    x = np.arange(33, 49) - 40.5
    hann = np.sinc(x) / (1 - x**2)
    for window, shape in (("none", np.sinc(x)), ("hann", hann)):
        row = radar.cube(made([40.5e-9], [0], [1e-4]), WAVE, range_window=window).power_dbm[32]
        np.testing.assert_allclose(row[33:49], -50 + 20 * np.log10(np.abs(shape)), atol=0.3)
    row = radar.cube(made([40.5e-9], [0], [1e-4]), WAVE, range_window="blackman").power_dbm[32]
    assert max(row[:36].max(), row[46:].max()) < -50 - 58


def check_two_targets():
    """Two paths that differ in speed alone are two detections, by falling power; a third one is too late."""
    cube = radar.cube(made([30e-9, 30e-9, 400e-9], [-6000, 8000, 0], [1e-4, 5e-5, 1]), WAVE)
    found = cube.detections()
    assert cube.left_out == 1
    np.testing.assert_allclose(found["doppler_hz"][:2], [-6000, 8000], atol=80)
    np.testing.assert_allclose(found["power_dbm"][:2], [-50, -56.02], atol=1.5)
    np.testing.assert_allclose(found["speed_m_s"][:2], found["doppler_hz"][:2] * C / CARRIER / 2)


def check_false_alarms():
    """Noise passes the threshold as often as it was asked to, and has the power of the figure."""
    wave = radar.Waveform(1e9, 20e-6, chirps=256, samples=256, noise_figure_db=12, seed=5)
    signal = radar.beat(made([1.0], [0], [1]), wave)  # the only path is too late
    power = 1.380649e-23 * 290 * 10**1.2 * 256 / 20e-6
    assert abs((np.abs(signal) ** 2).mean() / power - 1) < 0.02
    assert np.array_equal(signal, radar.beat(made([1.0], [0], [1]), wave))
    cube = radar.cube_of(signal, wave, CARRIER, "none", "none")
    counts = [len(cube.detections(false_alarm=p)["range_m"]) for p in (1e-3, 1e-2)]
    # Peaks are one in nine cells where cells are independent, and all high cells are peaks.
    assert 30 < counts[0] < 110 and 350 < counts[1] < 800, counts


def line_of_elements(delays, azimuths, spacing, counts):
    """Delays between elements of two lines along y, for waves that leave and arrive at these azimuths."""
    offsets = [np.stack([np.zeros(n), (np.arange(n) - (n - 1) / 2) * gap, np.zeros(n)], 1)
               for n, gap in zip(counts, (spacing, spacing * counts[0]))]
    look = np.stack([np.cos(azimuths), np.sin(azimuths), np.zeros(len(azimuths))], 1)
    later = -(look @ offsets[0].T)[:, :, None] / C - (look @ offsets[1].T)[:, None, :] / C
    return offsets, (np.asarray(delays)[:, None, None] + later, np.ones_like(later))


def check_angles(turns):
    """Beams of a virtual array of 4 x 3 antennas tell two targets of one range and speed apart by their azimuths."""
    azimuths, delays = np.radians([-20.0, 25.0]), [50e-9, 50e-9]
    offsets, elements = line_of_elements(delays, azimuths, C / CARRIER / 2, (4, 3))
    wave = radar.Waveform(1e9, 20e-6, chirps=64, samples=128, interval_s=25e-6, turns=turns)
    cube = radar.cube(made(delays, [2500, 2500], [1e-4, 1e-4], elements), wave)
    assert cube.values.shape == (4, 3, 64, 128)
    look = np.radians(np.arange(-60, 60.5, 0.5))
    beams = cube.beams(offsets[0], offsets[1], np.stack([np.cos(look), np.sin(look), 0 * look], 1))
    n, s = np.unravel_index(cube.power_dbm.argmax(), cube.power_dbm.shape)
    level = np.abs(beams[:, n, s])
    peaks = [i for i in range(1, len(look) - 1) if level[i] == level[max(0, i - 12):i + 13].max()]
    best = sorted(peaks, key=lambda i: -level[i])[:2]
    np.testing.assert_allclose(sorted(np.degrees(look[best])), [-20, 25], atol=2)


def check_wheel():
    """Spectra of a rolling wheel reach from 0 to twice the speed of its centre: +-2 v f / c about that of the body."""
    speed, wave = 8.0, radar.Waveform(150e6, 10e-6, chirps=4096, samples=32, interval_s=12e-6)
    motion = radar.wheel([12, 0, 0.3], np.pi, 0.3, speed)
    assert np.allclose(motion(0.01)[:, 0].mean(), 12 - 0.08)
    step = 1e-7
    speeds = np.linalg.norm(motion(step) - motion(0), axis=1) / step
    assert abs(speeds.max() - 2 * speed) < 0.05 and speeds.min() < 0.05
    signal = radar.beat_of_points(motion, 1e-2, wave, CARRIER, tx_m=[0, 0, 0.3])
    time_s, shift, power = radar.spectrogram(signal, wave, length=512, step=256)
    assert power.shape == (len(time_s), len(shift)) == (15, 512)
    mean = 10 ** (power / 10)
    mean = mean.mean(axis=0)
    present = shift[mean > 1e-3 * mean.max()]
    edge = 2 * speed * CARRIER / C
    width = 2 * (shift[1] - shift[0])
    assert abs(present.max() - 2 * edge) < 2 * width and abs(present.min()) < 2 * width, (present.min(), present.max(), edge)
    # The power of a still point is the radar equation's.
    still = radar.beat_of_points(lambda t: np.array([[30.0, 0, 0]]), 2.0, wave, CARRIER)
    wavelength = C / CARRIER
    received = 10 + 10 * np.log10(2.0 * wavelength**2 / ((4 * np.pi) ** 3 * 30.0**4))
    assert abs(10 * np.log10((np.abs(still) ** 2).mean()) + 30 - received) < 1e-6


def check_files():
    """A file that was written is read back, and the maps and detections are those of the cubes."""
    cubes = [radar.cube(made([30e-9], [shift], [1e-4]), WAVE) for shift in (500, -2500)]
    spectra = radar.spectrogram(radar.beat(made([30e-9], [500], [1e-4]), WAVE), WAVE, 16, 8)
    radar.save(FOLDER / "radar.h5", cubes, [3, 5], [0.3, 0.5], spectra)
    again = radar.load(FOLDER / "radar.h5")
    assert list(again) == [3, 5]
    for cube, read in zip(cubes, again.values()):
        assert np.array_equal(read.values, cube.values.astype(np.complex64)) and np.array_equal(read.range_m, cube.range_m)
        assert read.frequency_hz == CARRIER and "64 Doppler shifts" in repr(read)
    assert radar.names(FOLDER / "radar.h5") == ["radar"]
    with h5py.File(FOLDER / "radar.h5") as whole:
        file = whole["radar"]
        assert file["maps/power_dbm"].shape == (2, 64, 128) and file["spectrogram/power_dbm"].shape == spectra[2].shape
        assert file["spectrogram_doppler_hz"].shape == spectra[1].shape and list(file["frames/tx"]) == [0, 0]
        found = [cube.detections() for cube in cubes]
        assert list(file["detections/frame"]) == sum(([n] * len(d["range_m"]) for n, d in zip((3, 5), found)), [])
        assert np.array_equal(file["detections/doppler_hz"], np.concatenate([d["doppler_hz"] for d in found]))
    refused(lambda: radar.load(FOLDER / "radar.h5", "rear"), "has no radar 'rear', only radar")
    refused(lambda: radar.save(FOLDER / "named.h5", cubes, [3, 5], [0.3, 0.5], name="a/b"), "letters, digits")
    with h5py.File(FOLDER / "radar.h5", "r+") as file:
        file["radar/frames/tx"][...] = [0, 1]
    refused(lambda: radar.load(FOLDER / "radar.h5"), "has 2 links, 0 to 0, 1 to 0: choose one")
    assert list(radar.load(FOLDER / "radar.h5", tx=1)) == [5]
    with h5py.File(FOLDER / "radar.h5", "r+") as file:
        file.attrs["format_version"] = 1
    refused(lambda: radar.load(FOLDER / "radar.h5"), "it has version 1 of the format")
    other = radar.cube(made([30e-9], [0], [1]), radar.Waveform(1e9, 20e-6, chirps=32, samples=128))
    refused(lambda: radar.save(FOLDER / "mixed.h5", [cubes[0], other], [0, 1], [0, 1]), "of one waveform")
    (FOLDER / "other.h5").write_text("no")
    refused(lambda: radar.load(FOLDER / "other.h5"), "cannot be read")
    with h5py.File(FOLDER / "empty.h5", "w"):
        pass
    refused(lambda: radar.load(FOLDER / "empty.h5"), "no radar.h5")


def check_configured():
    """The waveform of a run is that of its [[radar]], with the power of [radio] where it has none of its own."""
    table = '[radio]\ntransmit_power_dbm = 7.5\n[[radar]]\nname = "front"\nbandwidth_hz = 3e8\nturns = true\n{}[output]\nchirps = 1\n'
    assert radar.waveform_of(table.format("chirps = 32\nchirp_s = 1e-5\n")) == radar.Waveform(
        3e8, 1e-5, chirps=32, power_dbm=7.5, turns=True)
    assert radar.waveform_of(table.format("chirp_s = 1e-5\npower_dbm = 1.0\n"), "front").power_dbm == 1
    refused(lambda: radar.waveform_of("[radio]\n"), "has no [[radar]]")
    refused(lambda: radar.waveform_of(table.format(""), "rear"), "the run has the radars front")


def check_misuse():
    refused(lambda: radar.Waveform(0, 1e-5), "bandwidth_hz")
    refused(lambda: radar.Waveform(1e9, 1e-5, interval_s=5e-6), "at least chirp_s")
    refused(lambda: radar.Waveform(1e9, 1e-5, chirps=1), "2 or more")
    refused(lambda: radar.Waveform(1e9, 1e-6, samples=1001), "longer than its chirp")
    assert radar.Waveform(1e9, 1e-6, samples=1000).longest_delay_s == 1e-6
    paths = made([30e-9], [0], [1], names=(("t", "u"), ("r",)))
    refused(lambda: radar.cube(paths, WAVE), "choose one with tx=")
    cube = radar.cube(made([30e-9], [0], [1]), WAVE)
    refused(lambda: radar.cube(made([30e-9], [0], [1]), WAVE, range_window="kaiser"), "there is no window")
    refused(lambda: cube.detections(training=100), "guard")
    refused(lambda: cube.detections(false_alarm=2), "probability")
    refused(lambda: cube.looking([1, 0, 0]), "give them to beams()")
    refused(lambda: cube.beams(np.zeros((2, 3)), np.zeros((1, 3)), [1, 0, 0]), "rx offsets")
    refused(lambda: radar.spectrogram(radar.beat(made([30e-9], [0], [1]), WAVE), WAVE, length=100), "a length from 2 to 64")


FOLDER.mkdir(parents=True, exist_ok=True)
check_samples()
check_peak()
check_two_targets()
check_false_alarms()
check_angles(False)
check_angles(True)
check_wheel()
check_files()
check_configured()
check_misuse()
print("radar ok")
