# SPDX-License-Identifier: Apache-2.0
"""Total fields along short lines across shadow boundaries: the largest step from one receiver to the next.

A case is a profile across an axis, x along the way and z up, and a scene of it that is drawn out along the axis: screens, a
block, or a block with one edge alone (a corner). Scenes are turned, so that nothing is round in float32, and reach `size_m`
from end to end: 3 km, or 20 m. Its boundaries follow from its points: the lines from the source, from its images in the faces
and from every edge, with their images, past every edge. Receivers stand on a line across each, 2 cm long, on it and
from 1e-5 m beside it on.

The field must be smooth there, so what is left is looked at after a polynomial was fitted to either side: the largest
difference of two neighbours, over the field in free space. A boundary counts for a kind: incidence (a way that ends is
straight) or reflection (a face reflects it before it passes the edge). Boundaries where nothing ends count as well: there the
field must be as smooth. Left out are lines that come near another boundary, and what is inside of a body.

Rays find a diffracted path once they hit one of the edge's faces, of which a receiver just beside a boundary sees a strip of
a millimetre. Receivers that lack a diffracted path which one farther off on their side has are left out of the largest step,
and have a column of their own. Direct and reflected paths must never be missing.
"""
import itertools
import multiprocessing
import pathlib
import tempfile

import numpy as np
import wavetracer as wt

SPEED_OF_LIGHT = 299792458.0
F_HZ = 5.9e9
DIFFRACTION = 8  # in vertex_interaction
TURN_RAD, TILT_RAD = 0.37, 0.11
HALF_LINE_M = 1e-2
STEPS_M = np.unique(np.concatenate([np.arange(1, 21) * 1e-5, np.arange(1, 21) * 1e-4, np.arange(1, 21) * 5e-4]))
OFFSETS_M = np.concatenate([-STEPS_M[::-1], [0.0], STEPS_M])
APART_M = 5e-2
ASIDE = 2e-3  # in parts of the distance from the edge: where a receiver on either side says which paths there are


def case(name, size_m, edges, tops=None, block=None, distances_m=(0.25, 0.25), height=0.0):
    """tops: (x, z) of screens; block: (x0, x1), its top is z = 0. distances_m: of the ends, in parts of the size, from
    the first and the last edge; the source stands `height` (in parts of its distance) above the first edge."""
    return {"name": name, "size_m": size_m, "edges": edges, "tops": tops, "block": block, "distances_m": distances_m,
            "height": height}


def all_cases():
    out = []
    for size in (20.0, 3000.0):
        s = size / 20
        places = [((0.25, 0.25), "far ends"), ((0.25, 5 / size), "near receivers")]
        for distances, words in places if size > 100 else places[:1]:
            for height, way in ((0.12, "source above"), (-0.09, "source below")):
                label = f"{words}, {way}"
                out += [case(f"screen, {label}", size, 1, tops=((0, 0),), distances_m=distances, height=height),
                        case(f"corner, {label}", size, 1, block=(0, size / 2), distances_m=distances, height=height),
                        case(f"two screens, {label}", size, 2, tops=((-1.3 * s, 0), (1.1 * s, 0.17 * s)),
                             distances_m=distances, height=height),
                        case(f"block, {label}", size, 2, block=(-1.1 * s, 1.3 * s), distances_m=distances, height=height),
                        case(f"three screens, {label}", size, 3,
                             tops=((-1.9 * s, 0), (0.13 * s, 0.11 * s), (2.1 * s, 0.07 * s)), distances_m=distances,
                             height=height)]
    return out


def corners_of(row):
    """The edges of the profile, from left to right."""
    if row["block"]:
        x0, x1 = row["block"]
        return np.array([(x0, 0.0)] if row["edges"] == 1 else [(x0, 0.0), (x1, 0.0)])
    return np.array(row["tops"], float)


def faces_of(row):
    """Faces of the profile, ((x, z), (x, z)): points of each."""
    deep = -row["size_m"] / 2
    if row["block"]:
        x0, x1 = row["block"]
        return [((x0, deep), (x0, 0.0)), ((x0, 0.0), (x1, 0.0)), ((x1, 0.0), (x1, deep))]
    return [((x, deep), (x, z)) for x, z in row["tops"]]


def mirrored(point, face):
    a, b = np.asarray(face, float)
    along = (b - a) / np.linalg.norm(b - a)
    normal = np.array([along[1], -along[0]])
    return point - 2 * np.dot(point - a, normal) * normal


def rays_past_edges(row, source):
    """(kind, edge, direction) of all boundaries that begin at an edge."""
    edges, out = corners_of(row), []
    for i, start in enumerate([source, *edges]):
        images = [("incidence", start)] + [("reflection", mirrored(start, face)) for face in faces_of(row)]
        for kind, image in images:
            for edge in edges:
                way = edge - image
                length = np.linalg.norm(way)
                if length < 1e-3 or (i > 0 and np.allclose(edge, edges[i - 1])):
                    continue
                out.append((kind, edge, way / length))
    return out


def is_in_body(row, p):
    return bool(row["block"]) and row["block"][0] - 0.01 < p[0] < row["block"][1] + 0.01 and p[1] < 0.01


def lines_of(row):
    """The source and the lines, (kind, points): beyond each edge along its boundaries. The first and the last point of a
    line are far aside."""
    edges, size = corners_of(row), row["size_m"]
    before, after = (part * size for part in row["distances_m"])
    source = edges[0] + np.array([-before, row["height"] * before])
    rays, lines, apart = rays_past_edges(row, source), [], max(APART_M, 2 * ASIDE * after)
    for kind, edge, way in rays:
        middle = edge + after * way
        across = np.array([-way[1], way[0]])
        if middle[1] < -0.4 * size or np.abs(middle[0]) > 0.45 * size or is_in_body(row, middle):
            continue
        if any(np.linalg.norm(middle - m) < apart for _, m, _, _ in lines):
            continue
        near = False
        for _, other, direction in rays:
            d = middle - other
            if np.dot(d, direction) > 0 and 1e-6 < abs(d[0] * direction[1] - d[1] * direction[0]) < apart:
                near = True
        if not near:
            lines.append((kind, middle, across, way))
    places = np.concatenate([[-ASIDE * after], OFFSETS_M, [ASIDE * after]])
    return source, [(kind, middle[None, :] + places[:, None] * across[None, :]) for kind, middle, across, _ in lines]


def placed(points, along=0.0):
    """Points (x, z) of the profile in the scene: turned about the vertical and tilted along the way."""
    x, z = np.asarray(points, float).T
    c, s = np.cos(TILT_RAD), np.sin(TILT_RAD)
    x, z = c * x - s * z, s * x + c * z
    c, s = np.cos(TURN_RAD), np.sin(TURN_RAD)
    return np.stack([c * x - s * along, s * x + c * along, z], axis=-1)


def write_scene(path, row):
    half, lines, count = row["size_m"] / 2, [], 0
    for i, face in enumerate(faces_of(row)):
        quad = np.concatenate([placed(face, -half), placed(face, half)[::-1]])
        lines += ["v " + " ".join(repr(float(c)) for c in corner) for corner in quad]
        lines += [f"o face{i}", "usemtl body", "f " + " ".join(str(count + k + 1) for k in range(4))]
        count += 4
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def configuration(row, tx, rx):
    ends = [[{"name": f"{side}{i}", "position_m": [float(c) for c in place], "polarization": "VH"}
             for i, place in enumerate(places)] for side, places in (("tx", tx), ("rx", rx))]
    return {"scene": {"file": "scene.obj"}, "radio": {"frequency_hz": F_HZ}, "transmitter": ends[0], "receiver": ends[1],
            "material": [{"name": "body", "permittivity": 1.0, "conductivity_s_m": 1e7, "thickness_m": float("inf")}],
            "trace": {"rays": 50_000, "diffraction_rays": 20_000, "diffraction": True, "free_edges": True, "reflection": True,
                      "max_diffractions": row["edges"], "max_depth": row["edges"] + 1}}


def fields(paths, row, source, receivers):
    """The sum over free space, (receiver, VV and HH), of the paths over edges of the profile: those of its rims are others.
    And the set of diffracted paths that each receiver has, by their interactions and edges."""
    out, sets = np.zeros((len(receivers), 2), complex), [set() for _ in receivers]
    direct = np.linalg.norm(receivers - source, axis=1)
    offset, along = paths.vertex_offset, placed([(0.0, 0.0)], 1.0)[0]
    for i in range(len(paths.tx)):
        vertices = paths.vertex_position_m[offset[i]:offset[i + 1]]
        if len(vertices) and (np.abs(vertices @ along).max() > 1e-3 or vertices[:, 2].min() < -0.35 * row["size_m"]):
            continue
        r = direct[paths.rx[i]]
        phase = np.exp(-2j * np.pi * F_HZ * (paths.delay_s[i] - r / SPEED_OF_LIGHT))
        kinds = tuple(paths.vertex_interaction[offset[i]:offset[i + 1]])
        if DIFFRACTION in kinds:
            sets[paths.rx[i]].add((kinds, tuple(tuple(np.round(v, 2)) for k, v in zip(kinds, vertices) if k == DIFFRACTION)))
        out[paths.rx[i]] += np.diagonal(paths.a[i]) * phase * 4 * np.pi * r * F_HZ / SPEED_OF_LIGHT
    return out, sets


def are_whole(sets):
    """Tells which receivers of a line have all diffracted paths of those aside and of the last three on their side; of that on
    the boundary, those of both. sets: with those aside."""
    sides, sets = [set().union(*sets[:4]), set().union(*sets[-4:])], sets[1:-1]
    return np.array([(sides[0] & sides[1] if at == 0 else sides[int(at > 0)]) <= found
                     for at, found in zip(OFFSETS_M, sets)])


def fitted(at, field, degree):
    """A polynomial through most of the points."""
    keep = np.ones(len(at), bool)
    for _ in range(4):
        p = np.polynomial.Polynomial.fit(at[keep], field[keep].real, degree, domain=[-HALF_LINE_M, HALF_LINE_M])
        q = np.polynomial.Polynomial.fit(at[keep], field[keep].imag, degree, domain=[-HALF_LINE_M, HALF_LINE_M])
        off = np.hypot(p(at) - field.real, q(at) - field.imag)
        keep = off <= max(6 * np.median(off), 1e-6)
    return lambda x: p(x) + 1j * q(x), lambda x: p.deriv()(x) + 1j * q.deriv()(x)


def largest_step(field, whole):
    """Returns the largest step of the field along one line, (point,), beyond what a smooth field would do; where it is; and
    the largest step beside receivers that are not `whole`."""
    left, right = (OFFSETS_M <= 0) & whole, (OFFSETS_M >= 0) & whole
    # If receivers are left out, a polynomial of a high degree would swing between those that are there.
    fits = [fitted(OFFSETS_M[side], field[side], 5 if whole.all() else 2) for side in (left, right)]
    worst, at, late = 0.0, 0.0, 0.0
    for i in range(len(OFFSETS_M) - 1):
        a, b = OFFSETS_M[i], OFFSETS_M[i + 1]
        value, _ = fits[0] if b <= 0 else fits[1]
        step = abs((field[i + 1] - value(b)) - (field[i] - value(a)))
        if not (whole[i] and whole[i + 1]):
            late = max(late, step)
        elif step > worst:
            worst, at = step, (a + b) / 2
    slope = (fits[0][1](0.0) + fits[1][1](0.0)) / 2
    for a, b in ((-STEPS_M[0], 0.0), (0.0, STEPS_M[0])):
        i = int(np.argmin(np.abs(OFFSETS_M - a)))
        step = abs(field[i + 1] - field[i] - slope * (b - a))
        if whole[i] and whole[i + 1] and step > worst:
            worst, at = step, (a + b) / 2
    return worst, at, late


def solve(row):
    """The case, and by kind of boundary: lines, largest step of V and of H, place of the larger one on its line, lines on
    which paths are found late, largest step there."""
    source, lines = lines_of(row)
    tx = placed([source])
    rx = placed(np.concatenate([points for _, points in lines]))
    with tempfile.TemporaryDirectory() as folder:
        write_scene(pathlib.Path(folder) / "scene.obj", row)
        with wt.Simulation(configuration(row, tx, rx), folder=folder) as simulation:
            total, sets = fields(simulation.run_frame().paths, row, tx[0], rx)
    out = {}
    for k, (kind, points) in enumerate(lines):
        span = slice(k * len(points) + 1, (k + 1) * len(points) - 1)
        whole = are_whole(sets[span.start - 1:span.stop + 1])
        best = out.setdefault(kind, {"lines": 0, "steps": [0.0, 0.0], "at": 0.0, "late": 0, "late_step": 0.0})
        best["lines"] += 1
        best["late"] += not whole.all()
        for port in range(2):
            step, at, late = largest_step(total[span, port], whole)
            if step > max(best["steps"]):
                best["at"] = at
            best["steps"][port] = max(best["steps"][port], step)
            best["late_step"] = max(best["late_step"], late)
    return row, out


def table(only=None, processes=2):
    """The largest steps of all cases whose names contain one of these texts, in Markdown."""
    rows = [row for row in all_cases() if not only or any(text in row["name"] for text in only)]
    with multiprocessing.get_context("spawn").Pool(processes) as pool:
        found = pool.map(solve, rows, chunksize=1)
    lines = ["| edges | scene | size | boundaries | lines | largest step, V | H | beside the boundary by | found late: lines "
             "| largest step |", "| ---: | --- | ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: |"]
    for row, kinds in sorted(found, key=lambda x: (x[0]["edges"], x[0]["name"], x[0]["size_m"])):
        for kind, best in sorted(kinds.items()):
            steps = " | ".join(f"{step:.0e}" for step in best["steps"])
            late = f"{best['late']} | {best['late_step']:.0e}" if best["late"] else "0 |"
            lines.append(f"| {row['edges']} | {row['name']} | {row['size_m']:.0f} m | {kind} | {best['lines']} | {steps} "
                         f"| {1e3 * best['at']:+.3f} mm | {late} |")
    return "\n".join(lines)
