# SPDX-License-Identifier: Apache-2.0
"""Two laws that no ray tracer may break: energy in a closed room, and reciprocity.

Energy: a transmitter of 1 W in an empty room of one material. All of it arrives at the walls (order 0); what they do not
take arrives again (order 1), and so on. The flux of every order is integrated over the walls by Gauss' rule, from
receivers 1 mm in front of them; what the walls take is that flux times 1 - |R|^2, with reflectances of this file, not of
the program. Fluxes are sums of powers: interference only moves energy from one place of a wall to another.
"""
import pathlib
import tempfile

import numpy as np
import wavetracer as wt

from screens import SPEED_OF_LIGHT

ROOM_M = (8.0, 6.0, 3.0)
TRANSMITTER_M = (2.9, 2.3, 1.6)
ORDERS = 6
POINTS = 10  # along each side of a wall
# Permittivity, conductivity (S/m) and thickness (m): concrete, glass and wet ground of ITU-R P.2040-3, Table 3, at 5.9 GHz.
MATERIALS = {"concrete, half space": (5.24, 0.0462 * 5.9**0.7822, np.inf),
             "glass, 10 mm": (6.31, 0.0036 * 5.9**1.3394, 0.01),
             "wet ground, half space": (30 * 5.9**-0.4, 0.15 * 5.9**1.3, np.inf)}
FREQUENCY_HZ = 5.9e9


def reflectances(cosine, permittivity, conductivity_s_m, thickness_m):
    """|R|^2 of transverse electric and transverse magnetic waves: ITU-R P.2040-3, section 2.2.2 (Fresnel, slab)."""
    wavelength = SPEED_OF_LIGHT / FREQUENCY_HZ
    eta = permittivity - 1j * conductivity_s_m / (2 * np.pi * FREQUENCY_HZ * 8.8541878128e-12)
    root = np.sqrt(eta - (1 - cosine**2))
    out = []
    for r in ((cosine - root) / (cosine + root), (eta * cosine - root) / (eta * cosine + root)):
        if np.isfinite(thickness_m):
            turn = np.exp(-2j * 2 * np.pi * thickness_m / wavelength * root)
            r = r * (1 - turn) / (1 - r * r * turn)
        out.append(np.abs(r) ** 2)
    return out


def walls(points):
    """Gauss points of all six walls, 1 mm inside: positions, inward normals, weights in m^2."""
    nodes, weights = np.polynomial.legendre.leggauss(points)
    position, normal, area = [], [], []
    for axis in range(3):
        u, v = (other for other in range(3) if other != axis)
        for end in (0, 1):
            for i in range(points):
                for j in range(points):
                    at = [1e-3 if end == 0 else ROOM_M[k] - 1e-3 for k in range(3)]
                    at[u], at[v] = ROOM_M[u] * (nodes[i] + 1) / 2, ROOM_M[v] * (nodes[j] + 1) / 2
                    position.append(at)
                    normal.append([(1.0 - 2 * end) * (k == axis) for k in range(3)])
                    area.append(weights[i] * weights[j] * ROOM_M[u] * ROOM_M[v] / 4)
    return position, np.array(normal), np.array(area)


def write_room(path):
    """The room as an OBJ file: the corners of a box, two triangles per wall."""
    x, y, z = ROOM_M
    corners = [(i * x, j * y, k * z) for k in (0, 1) for j in (0, 1) for i in (0, 1)]
    faces = ((1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4))
    lines = ["v {} {} {}".format(*corner) for corner in corners] + ["o room", "usemtl walls"]
    lines += [f"f {a} {b} {c}\nf {a} {c} {d}" for a, b, c, d in faces]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def paths_in_room(material, positions, orders):
    permittivity, conductivity, thickness = material
    with tempfile.TemporaryDirectory() as folder:
        write_room(pathlib.Path(folder) / "room.obj")
        receivers = [{"name": f"p{i}", "position_m": at, "polarization": "VH"} for i, at in enumerate(positions)]
        config = {"scene": {"file": "room.obj"}, "radio": {"frequency_hz": FREQUENCY_HZ},
                  "material": [{"name": "walls", "permittivity": permittivity, "conductivity_s_m": conductivity,
                                "thickness_m": thickness}],
                  "transmitter": [{"name": "source", "position_m": list(TRANSMITTER_M), "polarization": "V"}],
                  "receiver": receivers, "trace": {"rays": 100_000, "max_depth": orders, "reflection": True}}
        with wt.Simulation(config, folder=folder) as simulation:
            return simulation.run_frame().paths


def energy(material, orders=ORDERS, points=POINTS):
    """Rows of the orders: the power that arrives at the walls, what of it leaves them again by our reflectances and by the
    paths of the program, and what the walls have taken; all of 1 W."""
    positions, normals, areas = walls(points)
    paths = paths_in_room(material, positions, orders)
    theta, phi = paths.aoa_theta_rad, paths.aoa_phi_rad
    towards = np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)], axis=1)
    v = np.stack([np.cos(theta) * np.cos(phi), np.cos(theta) * np.sin(phi), -np.sin(theta)], axis=1)
    h = np.stack([-np.sin(phi), np.cos(phi), 0 * phi], axis=1)
    # |a|^2 is the power of an isotropic antenna, of the area wavelength^2 / (4 pi).
    field = (paths.a[:, 0, 0, None] * v + paths.a[:, 1, 0, None] * h) * np.sqrt(4 * np.pi) * FREQUENCY_HZ / SPEED_OF_LIGHT
    normal = normals[paths.rx]
    cosine = (towards * normal).sum(axis=1)  # positive: it comes from the room
    across = np.cross(normal, towards)
    across /= np.linalg.norm(across, axis=1)[:, None]
    te = np.abs((field * across).sum(axis=1)) ** 2
    tm = (np.abs(field) ** 2).sum(axis=1) - te
    weight = areas[paths.rx] * np.abs(cosine)
    r_te, r_tm = reflectances(np.abs(cosine), *material)
    rows, taken = [], 0.0
    for order in range(orders + 1):
        arriving = (paths.depth == order) & (cosine > 0)
        leaving = (paths.depth == order + 1) & (cosine < 0)
        power = float((weight * (te + tm))[arriving].sum())
        back = float((weight * (r_te * te + r_tm * tm))[arriving].sum())
        taken += power - back
        rows.append({"order": order, "arrives_w": power, "returns_w": back, "taken_w": taken,
                     "program_returns_w": float((weight * (te + tm))[leaving].sum()) if order < orders else None})
    return rows


def reciprocity(seed=5, transmitters=6, receivers=30):
    """A generated city with all kinds of interactions, one way and with its ends swapped."""
    random = np.random.default_rng(seed)

    def place():
        street, along, across = random.integers(-1, 2) * 100.0, random.uniform(-140, 140), random.uniform(-8, 8)
        at = [along, street + across] if random.random() < 0.5 else [street + across, along]
        return [*map(float, at), float(random.uniform(1.5, 6))]

    a, b = ([{"name": f"{side}{i}", "position_m": place(), "antenna": "tr38901", "polarization": "VH",
              "orientation_deg": [float(random.uniform(0, 360)), 0.0, 0.0]} for i in range(count)]
            for side, count in (("a", transmitters), ("b", receivers)))
    config = {"scene": {"generate": "--seed 1 --blocks 4x4"}, "radio": {"frequency_hz": FREQUENCY_HZ},
              "material": [{"name": name, "scattering": 0.3} for name in ("concrete", "brick")],
              "trace": {"rays": 300_000, "max_depth": 3, "diffraction": True, "transmission": True, "scattering": True,
                        "tile_m": 20.0}}
    both = []
    for tx, rx in ((a, b), (b, a)):
        with wt.Simulation({**config, "transmitter": tx, "receiver": rx}) as simulation:
            both.append(simulation.run_frame().paths)
    return compare_swapped(*both, transmitters, receivers)


def compare_swapped(there, back, transmitters, receivers):
    """Paths of one length over the same points, one way and the other: how far their coefficients differ, and the power of
    those that one way alone has found."""

    def keyed(paths, swapped):
        out = {}
        offset, points = paths.vertex_offset, np.round(paths.vertex_position_m, 3) + 0.0
        for i in range(len(paths)):
            at = points[offset[i]:offset[i + 1]]
            ends = (int(paths.rx[i]), int(paths.tx[i])) if swapped else (int(paths.tx[i]), int(paths.rx[i]))
            out[(*ends, (at[::-1] if swapped else at).tobytes())] = i
        return out

    one, other = keyed(there, False), keyed(back, True)
    common = [(one[key], other[key]) for key in one.keys() & other.keys()]
    i, j = (np.array(rows, int) for rows in zip(*common))
    first, second = np.abs(there.a[i]), np.abs(back.a[j]).transpose(0, 2, 1)
    scale = np.abs(there.a[i]).max(axis=(1, 2))
    power = [10 ** (paths.gain_db / 10) for paths in (there, back)]
    return {"links": transmitters * receivers, "paths": len(one), "paths_back": len(other), "common": len(common),
            "worst_of_amplitude": float((np.abs(first - second) / scale[:, None, None]).max()),
            "worst_delay_s": float(np.abs(there.delay_s[i] - back.delay_s[j]).max()),
            "lost_share": float(1 - min(power[0][i].sum() / power[0].sum(), power[1][j].sum() / power[1].sum()))}
