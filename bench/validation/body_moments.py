#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Radar cross sections of small metal boxes by physical optics (`wavetracer scene radar`) beside the method of moments
(moments.py).

Usage: body_moments.py PROGRAM FOLDER [CELLS]. The Python needs numpy and scipy. CELLS: cells in a wavelength, 8 if not
given. Prints tables in Markdown: the levels of both methods, both ends at one azimuth, and the largest difference within
10 dB of the strongest level. A sphere is computed first, whose cross section is known, and the script stops if the
moments miss it by 0.3 dB.
"""
import csv
import io
import pathlib
import subprocess
import sys

import moments
import numpy as np

WAVELENGTH = 0.1
SPEED_OF_LIGHT_M_S = 299792458.0
WAVE_NUMBER = 2 * np.pi / WAVELENGTH
BOXES = ((2.0, 1.5, 1.0), (3.0, 1.0, 1.5))  # sizes in wavelengths


def box_mesh(size, step):
    """Vertices (n, 3) and triangles (m, 3), outward, of a box about the origin."""
    points, triangles = {}, []

    def vertex(p):
        return points.setdefault(tuple(np.round(p / step * 1e6).astype(int)), (len(points), p))[0]

    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        nu, nv = (int(np.ceil(size[i] / step)) for i in (u, v))
        for side in (-1, 1):
            for i in range(nu):
                for j in range(nv):
                    corners = []
                    for a, b in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)):
                        p = np.zeros(3)
                        p[axis], p[u], p[v] = side * size[axis] / 2, (a / nu - 0.5) * size[u], (b / nv - 0.5) * size[v]
                        corners.append(vertex(p))
                    corners = corners if side > 0 else corners[::-1]
                    triangles += [[corners[0], corners[1], corners[2]], [corners[0], corners[2], corners[3]]]
    return np.array([p for _, p in points.values()]), np.array(triangles)


def sphere_mesh(radius, step):
    """A cube's mesh, blown up to a sphere."""
    vertices, triangles = box_mesh(np.full(3, 2 * radius), step)
    bent = np.tan(vertices / radius * np.pi / 4)  # cells of about one size
    return radius * bent / np.linalg.norm(bent, axis=1)[:, None], triangles


def physical_optics(program, folder, size, polarization, azimuths):
    """The program's cross sections of the box in dB over 1 m^2, both ends at the same azimuth."""
    vertices, triangles = box_mesh(size, 10.0)
    mesh = folder / "box.obj"
    mesh.write_text("".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in vertices.tolist())
                    + "".join("f " + " ".join(str(i + 1) for i in t) + "\n" for t in triangles.tolist()))
    step = azimuths[1] - azimuths[0]
    out = subprocess.run([program, "scene", "radar", mesh, f"--frequency={SPEED_OF_LIGHT_M_S / WAVELENGTH}",
                          f"--azimuths={azimuths[0]},{azimuths[-1]},{step}"], check=True, capture_output=True, text=True)
    return np.array([float(row[f"{polarization}_{polarization}_dbsm"]) for row in csv.DictReader(io.StringIO(out.stdout))])


def compare(program, folder, size, cells):
    body = moments.Moments(*box_mesh(size, WAVELENGTH / cells), WAVE_NUMBER)
    azimuths = np.arange(0.0, 91.0, 5.0)
    print(f"\nbox of {' x '.join(f'{s / WAVELENGTH:g}' for s in size)} wavelengths, {body.unknowns} unknowns\n\n"
          "| azimuth (degrees) | polarization | moments (dBsm) | physical optics (dBsm) | difference (dB) |\n"
          "| --- | --- | --- | --- | --- |", flush=True)
    for name in ("theta", "phi"):
        levels, found = physical_optics(program, folder, size, name, azimuths), []
        for azimuth, level in zip(azimuths, levels):
            look = np.array([np.cos(np.radians(azimuth)), np.sin(np.radians(azimuth)), 0.0])
            field = np.array([0.0, 0.0, 1.0]) if name == "theta" else np.array([-look[1], look[0], 0.0])
            found.append(10 * np.log10(body.cross_section_m2(look, field)))
            print(f"| {azimuth:.0f} | {name} | {found[-1]:.2f} | {level:.2f} | {level - found[-1]:.2f} |", flush=True)
        off = np.abs(np.array(found) - levels)
        lobes = np.array(found) > max(found) - 10
        print(f"| within 10 dB of the strongest | {name} | | | largest {off[lobes].max():.2f} |\n"
              f"| the others | {name} | | | median {np.median(off[~lobes]):.2f}, largest {off[~lobes].max():.2f} |", flush=True)


def main(program, folder, cells):
    folder.mkdir(parents=True, exist_ok=True)
    sphere = moments.Moments(*sphere_mesh(0.2 * WAVELENGTH, WAVELENGTH / 20), WAVE_NUMBER)
    found = sphere.cross_section_m2(np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0]))
    known = mie_back_m2(0.2 * WAVELENGTH)
    print(f"sphere of ka = {0.4 * np.pi:.2f}: {10 * np.log10(found):.2f} dBsm by moments with {sphere.unknowns} unknowns, "
          f"{10 * np.log10(known):.2f} dBsm by the series of Mie", flush=True)
    if abs(10 * np.log10(found / known)) > 0.3:
        sys.exit("body_moments.py: the moments miss the sphere by more than 0.3 dB; refine its mesh")
    for size in BOXES:
        compare(program, folder, np.array(size) * WAVELENGTH, cells)


def mie_back_m2(radius):
    """The cross section of a conducting sphere back to the source (J. J. Bowman et al., chapter 10)."""
    from scipy.special import spherical_jn, spherical_yn

    x, total = WAVE_NUMBER * radius, 0
    for n in range(1, int(x + 4.05 * x ** (1 / 3) + 10)):
        j, y = spherical_jn(n, x), spherical_yn(n, x)
        hankel = j + 1j * y
        slope = j + x * spherical_jn(n, x, True)
        a = slope / (slope + 1j * (y + x * spherical_yn(n, x, True)))
        total += (-1) ** n * (2 * n + 1) * (a - j / hankel)
    return WAVELENGTH**2 / (4 * np.pi) * abs(total) ** 2


if __name__ == "__main__":
    main(sys.argv[1], pathlib.Path(sys.argv[2]), float(sys.argv[3]) if len(sys.argv) > 3 else 8.0)
