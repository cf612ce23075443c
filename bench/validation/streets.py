# SPDX-License-Identifier: Apache-2.0
"""Links in streets: ten generated cities and, where its files are, the centre of Munich.

"mast" links go from 10 m down to 1.5 m, as in UMi of TR 38.901; "vehicle" links are between antennas at 1.6 m, as in
TR 37.885, in cities those of moving cars among vans and trucks, with these and without.
"""
import fnmatch
import pathlib
import sys

import numpy as np
import wavetracer as wt

import links

ROOT = pathlib.Path(__file__).resolve().parents[2]
CARRIERS_HZ = (5.9e9, 28e9)
SEEDS = tuple(range(1, 11))
BLOCK_M, STREET_M = 100.0, 20.0  # generated cities: distance from street to street, and the width of a street
MAST_M, PEDESTRIAN_M, ROOF_M = 10.0, 1.5, 1.6
FAR_M = 400.0  # links are no longer than this
TRACE = {"rays": 50_000, "max_depth": 4, "diffraction": True, "diffraction_rays": 10_000}


def street_places(random, count, height_m):
    """Places in the inner streets of a generated city, and of each (axis along which its street runs, its centre line)."""
    axis = random.integers(0, 2, count)
    line = random.integers(-2, 3, count) * BLOCK_M
    along, across = random.uniform(-240, 240, count), random.uniform(-8, 8, count)
    position = np.stack([np.where(axis == 0, along, line + across), np.where(axis == 0, line + across, along),
                         np.full(count, height_m)], axis=1)
    return position, axis, line


def around_corner(one, other):
    """Distances of both ends from the crossing of their streets, shape (ones, others); NaN where the streets are parallel
    or an end stands in the crossing."""
    (at, axis, line), (their_at, their_axis, their_line) = one, other
    x1 = np.abs(np.take_along_axis(at, axis[:, None], 1) - their_line)
    x2 = np.abs(np.take_along_axis(their_at, their_axis[:, None], 1)[:, 0] - line[:, None])
    crossed = (axis[:, None] != their_axis) & (x1 > STREET_M) & (x2 > STREET_M / 2 + 1)
    return np.where(crossed, x1, np.nan), np.where(crossed, x2, np.nan)


def vehicles_around_corner(positions):
    """Distances of both ends of each pair of vehicles from the crossing of their streets, and from the wall of their street
    on the side of the other end, each of shape (vehicles, vehicles); NaN where the streets are parallel or a vehicle stands
    in a crossing. The second index counts the other end."""
    near = np.abs(positions[:, :2] - BLOCK_M * np.round(positions[:, :2] / BLOCK_M)) < STREET_M / 2
    axis = np.where(near[:, 1], 0, 1)  # a street along x has a line of constant y
    inside = near.sum(axis=1) == 1
    places = np.arange(len(positions))
    along, across = positions[places, axis], positions[places, 1 - axis]
    line = BLOCK_M * np.round(across / BLOCK_M)
    crossed = inside[:, None] & inside & (axis[:, None] != axis)
    side = np.sign(along[None, :] - line[:, None])  # the other vehicle is on this side of one's own street
    wall = STREET_M / 2 - side * (across - line)[:, None]
    return {key: np.where(crossed, value, np.nan) for key, value in (
        ("end_m", np.abs(along[:, None] - line)), ("wall_m", wall))}


def solved(config, positions, receivers, trace=TRACE):
    """Paths from these positions to those, at each carrier."""
    def ends(side, places):
        return [{"name": f"{side}{i}", "position_m": list(map(float, at))} for i, at in enumerate(places)]

    config = {**config, **common(trace), "transmitter": ends("tx", positions), "receiver": ends("rx", receivers)}
    with wt.Simulation(config, folder=ROOT) as simulation:
        paths = simulation.run_frame().paths
    return [paths.at_carrier(i) for i in range(len(CARRIERS_HZ))]


def common(trace=TRACE):
    return {"radio": {"frequencies_hz": list(CARRIERS_HZ)}, "trace": trace, "links": {"max_distance_m": FAR_M}}


def table(paths, positions, receivers, **more):
    """One row per link that is not too long, as columns."""
    shape = len(positions), len(receivers)
    apart = np.asarray(receivers)[None, :, :] - np.asarray(positions)[:, None, :]
    out = {"d2_m": np.hypot(apart[..., 0], apart[..., 1]).ravel(), "d_m": np.linalg.norm(apart, axis=2).ravel(),
           "los": links.line_of_sight(paths, *shape)}
    for name, diffraction in (("with", True), ("without", False)):
        out |= {f"{key}_{name}": column for key, column in links.figures(paths, *shape, diffraction).items()}
    out |= {key: np.asarray(column).ravel() for key, column in more.items()}
    wanted = (out["d_m"] <= FAR_M) & (out["d2_m"] >= 10)
    return {key: column[wanted] for key, column in out.items()}


def joined(tables):
    return {key: np.concatenate([each[key] for each in tables]) for key in tables[0]}


def city_masts(seed, masts=4, terminals=100, trace=TRACE, **more):
    """A table per carrier; `more` are further tables of the configuration."""
    random = np.random.default_rng(1000 + seed)
    one, other = street_places(random, masts, MAST_M), street_places(random, terminals, PEDESTRIAN_M)
    x1, x2 = around_corner(one, other)
    return [table(paths, one[0], other[0], x1_m=x1, x2_m=x2)
            for paths in solved({**city(seed), **more}, one[0], other[0], trace)]


def city(seed):
    return {"scene": {"generate": f"--seed {seed} --blocks 6x6"}}


LINKED = ["veh?/roof", "veh1?/roof", "veh2?/roof"]  # the passenger cars among the first 30 vehicles


def city_vehicles(seed, vehicles=200):
    """Pairs of LINKED, each pair once; a table per carrier. `los` and figures without vehicles, and those among all vehicles
    as columns ..._traffic. first_... and second_... are what vehicles_around_corner says of both ends."""
    busy = common()
    busy["links"] = {**busy["links"], "transmitters": LINKED, "receivers": LINKED}
    drive = {**city(seed), **busy,
             "trajectories": {"generate": f"--seed {seed} --blocks 6x6 --vehicles {vehicles} --seconds 0.1 --step 0.1"},
             "mount": [{"name": "roof", "on": "passenger", "role": "both", "offset_m": [0.0, 0.0, ROOF_M]}]}
    with wt.Simulation(drive) as simulation:
        frame = simulation.run_frame(0)
        among, all_places = frame.paths, frame.transmitter_position_m.copy()
        chosen = [i for i, name in enumerate(simulation.transmitters) if any(fnmatch.fnmatch(name, each) for each in LINKED)]
    positions, n, out = all_places[chosen], len(all_places), []
    block = np.ix_(chosen, chosen)
    once = np.triu(np.ones((len(chosen), len(chosen)), bool), 1)
    corners = {f"{end}_{key}": value if end == "first" else value.T
               for key, value in vehicles_around_corner(positions).items() for end in ("first", "second")}
    for i, paths in enumerate(solved(city(seed), positions, positions)):
        around = {**links.figures(among.at_carrier(i), n, n), "los": links.line_of_sight(among, n, n)}
        traffic = {f"{key}_traffic": column.reshape(n, n)[block] for key, column in around.items()}
        out.append(once_each(table(paths, positions, positions, once=once, **corners, **traffic)))
    return out


def once_each(columns):
    return {key: column[columns["once"]] for key, column in columns.items()}


# --- Munich ---

MUNICH = pathlib.Path("../shared/scenes/munich/munich.xml")  # from the root of the project


def open_places(random, candidates=400, half_m=250.0, see_m=80.0):
    """Places in the streets and squares of the centre: nothing but the ground below, nothing above, and another such place
    at least see_m away in sight, which leaves out courtyards."""
    sys.path.insert(0, str(ROOT / "docs"))
    import read_scene

    corners = read_scene.read_scene(str(ROOT / MUNICH))
    found = []
    while len(found) < candidates:
        at = np.array([*random.uniform(-half_m, half_m, 2), PEDESTRIAN_M])
        if not np.any(heights_over(corners, at) > 0.5):
            found.append(at)
    found = np.array(found)
    sight = solved({"scene": {"file": str(MUNICH)}}, found, found, {"rays": 1000, "max_depth": 0})[0]
    far = np.linalg.norm(found[sight.tx] - found[sight.rx], axis=1) >= see_m
    return found[np.unique(sight.tx[far])]


def heights_over(corners, at):
    """Heights at which the vertical line through a place meets triangles, shape (triangles, 3, 3)."""
    a, b, c = (corners[:, i] for i in range(3))
    area = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    with np.errstate(divide="ignore", invalid="ignore"):
        u = ((b[:, 0] - at[0]) * (c[:, 1] - at[1]) - (b[:, 1] - at[1]) * (c[:, 0] - at[0])) / area
        v = ((c[:, 0] - at[0]) * (a[:, 1] - at[1]) - (c[:, 1] - at[1]) * (a[:, 0] - at[0])) / area
        inside = (area != 0) & (u >= 0) & (v >= 0) & (u + v <= 1)
        return (u * a[:, 2] + v * b[:, 2] + (1 - u - v) * c[:, 2])[inside]


def munich(kind):
    """A table per carrier; None where the files of Munich are not."""
    if not (ROOT / MUNICH).exists():
        print(f"{MUNICH} is not there: the page has no Munich", file=sys.stderr)
        return None
    places = open_places(np.random.default_rng(7))
    one, other = places[:40].copy(), places[:40]
    if kind == "mast":
        one, other = places[:8].copy(), places[8:128]
    one[:, 2] = MAST_M if kind == "mast" else ROOF_M
    if kind == "vehicle":
        other = one
    once = np.ones((len(one), len(other)), bool) if kind == "mast" else np.triu(np.ones((len(one), len(one)), bool), 1)
    return [once_each(table(paths, one, other, once=once)) for paths in solved({"scene": {"file": str(MUNICH)}}, one, other)]
