# SPDX-License-Identifier: Apache-2.0
"""The method of moments for closed conducting bodies of triangles: the electric field integral equation with the
functions of Rao, Wilton and Glisson (IEEE Trans. Antennas Propag. 30(3), 1982), tested with themselves. Integrals of 1/R
over triangles that are near are closed ones (D. R. Wilton et al., IEEE Trans. Antennas Propag. 32(3), 1984); what is left
of them, and all of them farther off, is by seven points. Needs numpy and scipy.
"""
import numpy as np
import scipy.linalg

# A rule of degree 5 on a triangle (R. Cowper, Int. J. Numer. Methods Eng. 7, 1973): barycentric coordinates and weights.
_A, _B, _C, _D = 0.059715871789770, 0.470142064105115, 0.797426985353087, 0.101286507323456
POINTS = np.array([[1 / 3, 1 / 3, 1 / 3], [_A, _B, _B], [_B, _A, _B], [_B, _B, _A], [_C, _D, _D], [_D, _C, _D], [_D, _D, _C]])
WEIGHTS = np.array([0.225] + 3 * [0.132394152788506] + 3 * [0.125939180544827])
NEAR = 3.0  # in longest edges: triangles whose middles are nearer have closed integrals
BLOCK = 16  # triangles whose rows are made at a time


def inverse_distances(r, corners, normal):
    """The integrals of 1 / R and of r' / R over triangles, shapes (n,) and (n, 3), seen from r (n, 3). corners: (n, 3, 3),
    in order about the normal (n, 3)."""
    height = np.einsum("ni,ni->n", r - corners[:, 0], normal)
    foot, above = r - height[:, None] * normal, np.abs(height)
    scalar, vector = np.zeros(len(r)), np.zeros((len(r), 3))
    for i in range(3):
        a, b = corners[:, i], corners[:, (i + 1) % 3]
        along = (b - a) / np.linalg.norm(b - a, axis=1)[:, None]
        out = np.cross(along, normal)
        from_s, to_s = np.einsum("ni,ni->n", a - foot, along), np.einsum("ni,ni->n", b - foot, along)
        away = np.einsum("ni,ni->n", a - foot, out)
        from_r, to_r = np.linalg.norm(r - a, axis=1), np.linalg.norm(r - b, axis=1)
        square = away**2 + height**2
        ahead = from_s + to_s > 0  # the form without a difference of nearly equal numbers
        log = np.log(np.where(ahead, to_r + to_s, from_r - from_s) / np.where(ahead, from_r + from_s, to_r - to_s))
        scalar += away * log - above * (np.arctan2(away * to_s, square + above * to_r)
                                        - np.arctan2(away * from_s, square + above * from_r))
        vector += 0.5 * out * (square * log + to_s * to_r - from_s * from_r)[:, None]
    return scalar, vector + foot * scalar[:, None]


class Moments:
    """The matrix of a conducting body, factored once for all waves. vertices: (n, 3), triangles: (m, 3), outward."""

    def __init__(self, vertices, triangles, wave_number):
        self.k = wave_number
        self.corners = vertices[triangles]
        across = np.cross(self.corners[:, 1] - self.corners[:, 0], self.corners[:, 2] - self.corners[:, 0])
        self.area = np.linalg.norm(across, axis=1) / 2
        self.normal = across / (2 * self.area[:, None])
        self.points = np.einsum("qc,tci->tqi", POINTS, self.corners)
        # Function j of a triangle flows out of the edge opposite to its corner j, or into it from the other triangle.
        numbers, self.function, self.sign = {}, np.empty((len(triangles), 3), int), np.empty((len(triangles), 3))
        for t, triangle in enumerate(triangles):
            for j in range(3):
                edge = (triangle[(j + 1) % 3], triangle[(j + 2) % 3])
                self.function[t, j] = numbers.setdefault(tuple(sorted(edge)), len(numbers))
                self.sign[t, j] = 1 if edge[0] < edge[1] else -1
        ends = np.array(list(numbers))
        length = np.linalg.norm(vertices[ends[:, 0]] - vertices[ends[:, 1]], axis=1)
        self.unknowns = len(numbers)
        self.scale = self.sign * length[self.function] / (2 * self.area[:, None])
        self.reach = NEAR * length.max()
        self.factors = scipy.linalg.lu_factor(self._matrix())

    def _inner(self, rows):
        """Integrals of G and of r' G over all triangles, from the points of these: shape (rows, 7, triangles, 4)."""
        weighted = (WEIGHTS[None, :] * self.area[:, None])[:, :, None] * np.concatenate(
            [np.ones(self.points.shape[:2] + (1,)), self.points], axis=2)
        middles = self.corners.mean(axis=1)
        out = np.empty((len(rows), 7, len(self.area), 4), complex)
        for at, t in enumerate(rows):
            distance = np.linalg.norm(self.points[t][:, None, None, :] - self.points[None], axis=3)
            near = np.flatnonzero(np.linalg.norm(middles - middles[t], axis=1) < self.reach)
            with np.errstate(divide="ignore", invalid="ignore"):
                green = np.exp(-1j * self.k * distance) / distance
                rest = (np.exp(-1j * self.k * distance[:, near]) - 1) / distance[:, near]
            green[:, near] = np.where(distance[:, near] > 0, rest, -1j * self.k)
            out[at] = np.einsum("qtp,tpc->qtc", green, weighted, optimize=True)
            r = np.repeat(self.points[t], len(near), axis=0)
            scalar, vector = inverse_distances(r, np.tile(self.corners[near], (7, 1, 1)), np.tile(self.normal[near], (7, 1)))
            out[at, :, near, 0] += scalar.reshape(7, -1).T
            out[at, :, near, 1:] += vector.reshape(7, -1, 3).transpose(1, 0, 2)
        return out

    def _matrix(self):
        matrix = np.zeros((self.unknowns, self.unknowns), complex)
        for first in range(0, len(self.area), BLOCK):
            rows = np.arange(first, min(first + BLOCK, len(self.area)))
            inner, outer = self._inner(rows), WEIGHTS[None, :] * self.area[rows][:, None]
            charge = np.einsum("tq,tqs->ts", outer, inner[..., 0])
            here = np.einsum("tq,tqi,tqs->tsi", outer, self.points[rows], inner[..., 0], optimize=True)  # of r G
            there = np.einsum("tq,tqsi->tsi", outer, inner[..., 1:])
            both = np.einsum("tq,tqi,tqsi->ts", outer, self.points[rows], inner[..., 1:], optimize=True)
            for i in range(3):
                a = self.corners[rows, i]
                for j in range(3):
                    b = self.corners[:, j]
                    flow = (both - np.einsum("ti,tsi->ts", a, there) - np.einsum("tsi,si->ts", here, b)
                            + charge * (a @ b.T)) - 4 / self.k**2 * charge
                    flow *= self.scale[rows, i][:, None] * self.scale[None, :, j]
                    np.add.at(matrix, (self.function[rows, i][:, None], self.function[None, :, j]), flow)
        return matrix

    def _wave(self, look, polarization):
        """The functions' integrals with a plane wave that comes from `look`."""
        turn = np.exp(1j * self.k * self.points @ look) * (WEIGHTS[None, :] * self.area[:, None])
        out = np.zeros(self.unknowns, complex)
        for j in range(3):
            flow = np.einsum("tq,tq->t", turn, (self.points - self.corners[:, j][:, None]) @ polarization)
            np.add.at(out, self.function[:, j], self.scale[:, j] * flow)
        return out

    def cross_section_m2(self, look, polarization):
        """The cross section back to a source in the direction `look`, with both fields along `polarization`."""
        wave = self._wave(look, polarization)
        return 4 * np.pi * abs(wave @ scipy.linalg.lu_solve(self.factors, wave)) ** 2
