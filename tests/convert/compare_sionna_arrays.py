# SPDX-License-Identifier: Apache-2.0
"""Channels between the elements of panels, by Sionna RT (synthetic arrays: plane waves) and from wavetracer's responses.
Run as compare_sionna_arrays.py PROGRAM OUTPUT; answers 77, "skipped", where sionna-rt or its LLVM is missing."""
import os
import subprocess
import sys

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "python"))
import needs_sionna  # noqa: F401, E402
import numpy as np  # noqa: E402
import sionna.rt as rt  # noqa: E402

PROGRAM, OUTPUT = sys.argv[1:3]
os.makedirs(OUTPUT, exist_ok=True)
F, BAND, N = 5.9e9, 40e6, 16
TX, RX, TURN = (-2.0, 1.0, 2.5), (2.5, -1.5, 1.0), (30.0, 10.0, 5.0)


def theirs(polarization):
    scene = rt.load_scene(rt.scene.box)
    scene.frequency = F
    scene.tx_array = rt.PlanarArray(num_rows=3, num_cols=2, vertical_spacing=0.7, horizontal_spacing=0.5, pattern="iso",
                                    polarization=polarization)
    scene.rx_array = rt.PlanarArray(num_rows=2, num_cols=2, pattern="iso", polarization=polarization)
    scene.add(rt.Transmitter("tx", TX, orientation=[float(np.radians(a)) for a in TURN]))
    scene.add(rt.Receiver("rx", RX))
    paths = rt.PathSolver()(scene, max_depth=2, samples_per_src=10**6, refraction=False, synthetic_array=True)
    spacing = BAND / N
    offsets = (np.arange(N) - N // 2) * spacing
    return np.array(paths.cfr(frequencies=offsets.astype(np.float32), num_time_steps=1, normalize_delays=False,
                              out_type="numpy"))


def ours(polarization, wavefront):
    config = f"""scene.file = "{os.path.join(os.path.dirname(rt.scene.box), 'box.xml')}"
radio.frequency_hz = {F}
radio.wavefront = "{wavefront}"
trace.max_depth = 2
trace.rays = 100000
response.bandwidth_hz = {BAND}
response.subcarriers = {N}
[[array]]
name = "3x2"
rows = 3
columns = 2
vertical_spacing_wavelengths = 0.7
[[array]]
name = "2x2"
rows = 2
columns = 2
[[transmitter]]
name = "tx"
position_m = {list(TX)}
polarization = "{polarization}"
orientation_deg = {list(TURN)}
array = "3x2"
[[receiver]]
name = "rx"
position_m = {list(RX)}
polarization = "{polarization}"
array = "2x2"
"""
    with open(os.path.join(OUTPUT, "box.toml"), "w") as file:
        file.write(config)
    run, npz = os.path.join(OUTPUT, "run"), os.path.join(OUTPUT, "box.npz")
    subprocess.run([PROGRAM, "run", "-c", os.path.join(OUTPUT, "box.toml"), "-o", run], check=True, capture_output=True)
    subprocess.run([PROGRAM, "convert", run, "-o", npz], check=True, capture_output=True)
    with np.load(npz) as file:
        return file["h_real"] + 1j * file["h_imag"]


def error(a, b):
    return np.sqrt(np.mean(np.abs(a - b) ** 2) / np.mean(np.abs(b) ** 2))


for polarization in ("V", "VH"):
    found, expected = ours(polarization, "plane"), theirs(polarization)
    assert found.shape == expected.shape, (found.shape, expected.shape)
    ports = len(polarization)
    if ports == 2:  # Sionna counts the elements of one polarisation, then those of the other
        for axis, elements in ((1, 4), (3, 6)):
            order = np.arange(ports * elements).reshape(ports, elements).T.ravel()
            expected = np.take(expected, order, axis=axis)
    plane, spherical = error(found, expected), error(ours(polarization, "spherical"), expected)
    print(f"{polarization}: rms error of plane waves {plane:.2e}, of spherical ones {spherical:.2e}")
    assert plane < 1e-2, plane  # single precision there: some milliradians of carrier phase
    assert 2 * plane < spherical < 0.2, spherical  # the error of plane waves in a room of 10 m
