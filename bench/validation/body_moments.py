#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Radar cross sections of a small metal box by physical optics (`wavetracer scene radar`) beside the method of moments
(bempp-cl of PyPI; the electric field integral equation with functions of Rao, Wilton and Glisson).

Usage: body_moments.py PROGRAM FOLDER. The Python needs bempp-cl, numba, numpy, scipy. Prints a table in Markdown: the
levels of both methods, both ends at one azimuth, and the largest difference within 10 dB of the strongest level. A sphere is computed first,
whose cross section is known, and the script stops if the moments miss it by 0.3 dB.
"""
import csv
import io
import pathlib
import subprocess
import sys

import bempp_cl.api as bempp
import numpy as np
import scipy.linalg

WAVELENGTH = 0.1
SPEED_OF_LIGHT_M_S = 299792458.0
WAVE_NUMBER = 2 * np.pi / WAVELENGTH
SIZE = np.array([2.0, 1.5, 1.0]) * WAVELENGTH
STEP = WAVELENGTH / 8


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


@bempp.callable(complex=True, parameterized=True)
def trace(x, n, domain, result, wave):
    """The trace E x n of a plane wave: `wave` has its direction and its polarization."""
    turn = np.exp(-1j * WAVE_NUMBER * (x[0] * wave[0] + x[1] * wave[1] + x[2] * wave[2]))
    result[0] = turn * (wave[4] * n[2] - wave[5] * n[1])
    result[1] = turn * (wave[5] * n[0] - wave[3] * n[2])
    result[2] = turn * (wave[3] * n[1] - wave[4] * n[0])


class Moments:
    """The matrix of a conducting body, factored once for all waves."""

    def __init__(self, vertices, triangles):
        grid = bempp.Grid(vertices.T.copy(), triangles.T.astype(np.uint32))
        self.div, self.curl = bempp.function_space(grid, "RWG", 0), bempp.function_space(grid, "SNC", 0)
        operator = bempp.operators.boundary.maxwell.electric_field(self.div, self.div, self.curl, WAVE_NUMBER)
        self.factors = scipy.linalg.lu_factor(bempp.as_matrix(operator.weak_form()))
        self.unknowns = self.div.global_dof_count

    def cross_section_m2(self, look, polarization):
        """The cross section back to a source in the direction `look`, with both fields along `polarization`."""
        wave = np.concatenate([look, polarization])
        right = bempp.GridFunction(self.div, dual_space=self.curl, fun=trace, function_parameters=wave).projections(self.curl)
        current = bempp.GridFunction(self.div, coefficients=scipy.linalg.lu_solve(self.factors, right))
        far = bempp.operators.far_field.maxwell.electric_field(self.div, look[:, None], WAVE_NUMBER)
        field = far.evaluate(current)[:, 0]
        return 4 * np.pi * abs(np.dot(field, polarization)) ** 2


def physical_optics(program, folder, polarization, azimuths):
    """The program's cross sections of the box in dB over 1 m^2, both ends at the same azimuth."""
    vertices, triangles = box_mesh(SIZE, 10.0)
    mesh = folder / "box.obj"
    mesh.write_text("".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in vertices.tolist())
                    + "".join("f " + " ".join(str(i + 1) for i in t) + "\n" for t in triangles.tolist()))
    step = azimuths[1] - azimuths[0]
    out = subprocess.run([program, "scene", "radar", mesh, f"--frequency={SPEED_OF_LIGHT_M_S / WAVELENGTH}",
                          f"--azimuths={azimuths[0]},{azimuths[-1]},{step}"], check=True, capture_output=True, text=True)
    return np.array([float(row[f"{polarization}_{polarization}_dbsm"]) for row in csv.DictReader(io.StringIO(out.stdout))])


def main(program, folder):
    folder.mkdir(parents=True, exist_ok=True)
    sphere = Moments(*sphere_mesh(0.2 * WAVELENGTH, WAVELENGTH / 20))
    found = sphere.cross_section_m2(np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0]))
    known = mie_back_m2(0.2 * WAVELENGTH)
    print(f"sphere of ka = {0.4 * np.pi:.2f}: {10 * np.log10(found):.2f} dBsm by moments with {sphere.unknowns} unknowns, "
          f"{10 * np.log10(known):.2f} dBsm by the series of Mie")
    if abs(10 * np.log10(found / known)) > 0.3:
        sys.exit("body_moments.py: the moments miss the sphere by more than 0.3 dB; refine its mesh")
    box, azimuths = Moments(*box_mesh(SIZE, STEP)), np.arange(0.0, 91.0, 5.0)
    print(f"box of 2 x 1.5 x 1 wavelengths, {box.unknowns} unknowns\n\n"
          "| azimuth (degrees) | polarization | moments (dBsm) | physical optics (dBsm) | difference (dB) |\n"
          "| --- | --- | --- | --- | --- |", flush=True)
    for name in ("theta", "phi"):
        levels, moments = physical_optics(program, folder, name, azimuths), []
        for azimuth, level in zip(azimuths, levels):
            look = np.array([np.cos(np.radians(azimuth)), np.sin(np.radians(azimuth)), 0.0])
            field = np.array([0.0, 0.0, 1.0]) if name == "theta" else np.array([-look[1], look[0], 0.0])
            moments.append(10 * np.log10(box.cross_section_m2(look, field)))
            print(f"| {azimuth:.0f} | {name} | {moments[-1]:.2f} | {level:.2f} | {level - moments[-1]:.2f} |", flush=True)
        off = np.abs(np.array(moments) - levels)
        lobes = np.array(moments) > max(moments) - 10
        print(f"| within 10 dB of the strongest | {name} | | | largest {off[lobes].max():.2f} |\n"
              f"| the others | {name} | | | median {np.median(off[~lobes]):.2f}, largest {off[~lobes].max():.2f} |", flush=True)


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
    main(sys.argv[1], pathlib.Path(sys.argv[2]))
