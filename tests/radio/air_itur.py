# SPDX-License-Identifier: Apache-2.0
"""Rain, gases and fog of paths against itur (PyPI), whose P.838-3, P.676-12 and P.840-8 it uses.

Usage: air_itur.py PROGRAM OUTPUT. Answers 77, "skipped", without itur or h5py. The tables and equations of P.676-12,
Annex 1 are those of P.676-13 (host/radio/gas_lines.hpp). Lengths are 1 km, so that dB are dB/km.
"""
import os
import subprocess
import sys

try:
    import h5py
    import itur.models.itu676 as p676
    import itur.models.itu838 as p838
    import itur.models.itu840 as p840
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing} (PyPI: itur, h5py)")
    sys.exit(77)

PROGRAM, OUTPUT = sys.argv[1:]
GHZ = np.unique(np.r_[1:11, 12:60:4, 57:66, 22.235, 70:101:5, 118.75]).astype(float)
ELEVATIONS = np.radians([0, 20, 45, 80])
os.makedirs(OUTPUT, exist_ok=True)
p676.change_version(12)
p838.change_version(3)
p840.change_version(8)

with open(os.path.join(OUTPUT, "scene.ply"), "w") as file:
    file.write("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
               "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
               "0 -9000 -9000\n1 -9000 -9000\n0 -8999 -9000\n3 0 1 2\n")
with open(os.path.join(OUTPUT, "air.toml"), "w") as file:
    file.write("[scene]\nfile = 'scene.ply'\ndefault_material = 'stone'\n[[material]]\nname = 'stone'\npermittivity = 5\n"
               f"[radio]\nfrequencies_hz = [{', '.join(f'{f * 1e9:.0f}.0' for f in GHZ)}]\n"
               f"frequency_hz = {GHZ[0] * 1e9:.0f}.0\n[trace]\nrays = 1\nmax_depth = 0\n"
               "[[transmitter]]\nname = 'tx'\nposition_m = [0, 0, 0]\npolarization = 'VH'\n")
    for i, angle in enumerate(ELEVATIONS):
        file.write(f"[[receiver]]\nname = 'rx{i}'\npolarization = 'VH'\n"
                   f"position_m = [{1000 * np.cos(angle):.17g}, 0, {1000 * np.sin(angle):.17g}]\n")


def gains(name, *settings):
    """dB of V to V and H to H: (carrier, receiver, 2)."""
    folder = os.path.join(OUTPUT, name)
    subprocess.run([PROGRAM, "run", "-c", os.path.join(OUTPUT, "air.toml"), "-o", folder,
                    *(f"--set=air.{setting}" for setting in settings)], check=True, capture_output=True)
    with h5py.File(os.path.join(folder, "carriers.h5"), "r") as file:
        group = next(g for g in file.values() if isinstance(g, h5py.Group) and "a_re" in g)
        a = group["a_re"][...] + 1j * group["a_im"][...]
    if a.shape[0] != len(GHZ):
        a = np.moveaxis(a, 1, 0)  # one row per path
    assert a.shape == (len(GHZ), len(ELEVATIONS), 2, 2), a.shape
    return 20 * np.log10(np.abs(np.stack([a[..., 0, 0], a[..., 1, 1]], axis=-1)))


def compare(name, got, wanted):
    worst = np.abs(got - wanted).max()
    print(f"{name}: up to {np.abs(wanted).max():.4g} dB/km, worst difference {worst:.2g} dB/km")
    assert worst < 1e-6, name


clear = gains("clear")
for temperature, pressure, humidity in ((15, 1013.25, 7.5), (-10, 950, 0), (35, 1000, 30)):
    vapour = humidity * (temperature + 273.15) / 216.7
    wanted = p676.gamma_exact(GHZ, pressure - vapour, humidity, temperature + 273.15).value
    got = clear - gains("gases", "gases=true", f"temperature_c={temperature}", f"pressure_hpa={pressure}",
                        f"humidity_g_m3={humidity}")
    compare(f"gases at {temperature} degrees, {pressure} hPa, {humidity} g/m3", got, wanted[:, None, None])
for temperature in (-8, 20):
    wanted = 0.5 * p840.specific_attenuation_coefficients(GHZ, temperature)
    wanted = np.asarray(getattr(wanted, "value", wanted))
    got = clear - gains("fog", "fog_g_m3=0.5", f"temperature_c={temperature}")
    compare(f"fog at {temperature} degrees", got, wanted[:, None, None])
for rate in (3, 100):
    got = clear - gains("rain", f"rain_mm_h={rate}")
    for port, tilt in ((0, 90), (1, 0)):
        for i, angle in enumerate(np.degrees(ELEVATIONS)):
            wanted = np.array([float(p838.rain_specific_attenuation(rate, f, angle, tilt).value) for f in GHZ])
            compare(f"rain of {rate} mm/h, tilt {tilt}, elevation {angle:.0f}", got[:, i, port], wanted)
