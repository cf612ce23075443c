#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Bistatic radar cross sections of metal spheres by physical optics (`wavetracer scene radar`) beside the series of Mie,
for spheres of several sizes and meshes.

Usage: body_spheres.py PROGRAM FOLDER. The Python needs numpy and scipy. Prints a table in Markdown: for each sphere the
differences in dB with the fields across the plane of both ends (the largest one) and in it (at each bistatic angle).
"""
import csv
import io
import pathlib
import subprocess
import sys

import numpy as np
from scipy.special import spherical_jn, spherical_yn

WAVELENGTH = 0.1
FREQUENCY_HZ = 299792458.0 / WAVELENGTH
SPHERES = ((35, 28), (35, 56), (70, 56), (140, 80), (280, 110))  # ka, cuts of an edge of the octahedron
ANGLES = np.arange(0, 91, 10)


def amplitudes(ka, theta):
    """S1 and S2 of a conductor (C. F. Bohren and D. R. Huffman, chapter 4); theta = pi is back to the source."""
    last = int(ka + 4.05 * ka ** (1 / 3) + 20)
    n = np.arange(1, last + 1)
    psi, before = ka * spherical_jn(n, ka), ka * spherical_jn(n - 1, ka)
    xi = psi - 1j * ka * spherical_yn(n, ka)
    xi_before = before - 1j * ka * spherical_yn(n - 1, ka)
    a, b = (before - n / ka * psi) / (xi_before - n / ka * xi), psi / xi
    mu, low, high = np.cos(theta), 0.0, 1.0
    s1 = s2 = 0
    for i in range(1, last + 1):
        tau, weight = i * mu * high - (i + 1) * low, (2 * i + 1) / (i * (i + 1))
        s1 += weight * (a[i - 1] * high + b[i - 1] * tau)
        s2 += weight * (a[i - 1] * tau + b[i - 1] * high)
        low, high = high, ((2 * i + 1) * mu * high - (i + 1) * low) / i
    return s1, s2


def write_sphere(path, radius, cuts):
    """An octahedron with cut faces, blown up to a sphere, whose mean radius is that of the sphere. Returns its facets."""
    triangles = []
    for octant in range(8):
        sign = np.array([-1 if octant >> axis & 1 else 1 for axis in range(3)])

        def at(i, j):
            p = sign * np.array([i, j, cuts - i - j], float)
            return p / np.linalg.norm(p)

        for i in range(cuts):
            for j in range(cuts - i):
                found = [(at(i, j), at(i + 1, j), at(i, j + 1))]
                if i + j + 1 < cuts:
                    found.append((at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)))
                triangles += [t if sign.prod() > 0 else (t[0], t[2], t[1]) for t in found]
    t = np.array(triangles)
    area = np.linalg.norm(np.cross(t[:, 1] - t[:, 0], t[:, 2] - t[:, 0]), axis=1)
    t *= radius / ((np.average(np.linalg.norm(t.mean(axis=1), axis=1), weights=area) + 1) / 2)
    numbers, faces = {}, []
    for corners in t:
        keys = [tuple(np.round(p / radius * 1e9).astype(int)) for p in corners]
        faces.append([numbers.setdefault(key, (len(numbers) + 1, p))[0] for key, p in zip(keys, corners)])
    path.write_text("".join("v {:.12g} {:.12g} {:.12g}\n".format(*p) for _, p in numbers.values())
                    + "".join("f {} {} {}\n".format(*face) for face in faces))
    return len(t)


def main(program, folder):
    folder.mkdir(parents=True, exist_ok=True)
    print("| ka | facets | across the plane, largest (dB) | in the plane, at " + ", ".join(f"{a}" for a in ANGLES)
          + " degrees (dB) |\n| --- | --- | --- | --- |")
    for ka, cuts in SPHERES:
        mesh = folder / "sphere.obj"
        facets = write_sphere(mesh, ka * WAVELENGTH / (2 * np.pi), cuts)
        out = subprocess.run([program, "scene", "radar", mesh, f"--frequency={FREQUENCY_HZ!r}", "--azimuths=0,90,10",
                              "--transmitter-azimuth=0", "--bounces=1"], check=True, capture_output=True, text=True)
        off = []
        for angle, row in zip(ANGLES, csv.DictReader(io.StringIO(out.stdout))):
            wanted = [10 * np.log10(WAVELENGTH**2 * abs(s) ** 2 / np.pi) for s in amplitudes(ka, np.pi - np.radians(angle))]
            off.append([float(row["theta_theta_dbsm"]) - wanted[0], float(row["phi_phi_dbsm"]) - wanted[1]])
        across, along = np.array(off).T
        print(f"| {ka} | {facets} | {np.abs(across).max():.2f} | {', '.join(f'{x:+.2f}' for x in along)} |", flush=True)


if __name__ == "__main__":
    main(sys.argv[1], pathlib.Path(sys.argv[2]))
