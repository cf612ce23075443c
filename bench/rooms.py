#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes furnished rooms as a Mitsuba scene, for measurements of beams in closed spaces.

usage: rooms.py office|floor [--pieces N] [--gap M] [--seed N] OUTPUT.xml

office  20 x 12 x 3 m with two partitions that leave passages, and N desks and cabinets.
floor   ten such rooms without partitions, 8 x 6 x 3 m, five on each side of a corridor of 2 m, with a door that is
        open in each of them (0.9 x 2.1 m, in walls of 10 cm), and N pieces in each.

Rooms are closed, of concrete. Furniture is of wood. It stands on the ground and has no lower face, or the gap is below
it. A mesh of each material is written beside OUTPUT.xml.
"""
import argparse
import pathlib
import random


class Mesh:
    """Quads of one material."""

    def __init__(self):
        self.quads = []

    def box(self, low, high, faces="xXyYzZ"):
        """Some faces of a box: x is that at the lower x, X that at the upper one."""
        def corner(i, j, k):
            return (low, high)[i][0], (low, high)[j][1], (low, high)[k][2]
        loops = {"x": ((0, 0, 0), (0, 1, 0), (0, 1, 1), (0, 0, 1)), "X": ((1, 0, 0), (1, 0, 1), (1, 1, 1), (1, 1, 0)),
                 "y": ((0, 0, 0), (0, 0, 1), (1, 0, 1), (1, 0, 0)), "Y": ((0, 1, 0), (1, 1, 0), (1, 1, 1), (0, 1, 1)),
                 "z": ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)), "Z": ((0, 0, 1), (0, 1, 1), (1, 1, 1), (1, 0, 1))}
        self.quads += [[corner(*at) for at in loops[face]] for face in faces]

    def write(self, path):
        lines = ["ply", "format ascii 1.0", f"element vertex {4 * len(self.quads)}", "property double x",
                 "property double y", "property double z", f"element face {len(self.quads)}",
                 "property list uchar int vertex_indices", "end_header"]
        lines += [" ".join(repr(float(c)) for c in corner) for quad in self.quads for corner in quad]
        lines += [f"4 {4 * i} {4 * i + 1} {4 * i + 2} {4 * i + 3}" for i in range(len(self.quads))]
        path.write_text("\n".join(lines) + "\n")


def furnish(mesh, chance, low, high, pieces, gap, barred=()):
    """Boxes at random places between two corners of a room, none of which reaches a place x of `barred`."""
    while pieces > 0:
        across = chance.random() < 0.5
        width, depth = (1.6, 0.8) if across else (0.8, 1.6)
        x = chance.uniform(low[0], high[0] - width)
        y = chance.uniform(low[1], high[1] - depth)
        height = chance.choice((0.75, 1.2, 1.9))
        if any(abs(x + width / 2 - bar) < width / 2 + 0.3 for bar in barred):
            continue
        mesh.box((x, y, gap), (x + width, y + depth, height), "xXyYzZ" if gap > 0 else "xXyYZ")
        pieces -= 1


def office(walls, wood, chance, pieces, gap):
    walls.box((0, 0, 0), (20, 12, 3))
    walls.box((6.013, 0, 0), (6.113, 8, 3))
    walls.box((13.027, 4, 0), (13.127, 12, 3))
    furnish(wood, chance, (0.5, 0.5), (19.6, 11.3), pieces, gap, (6.06, 13.08))


def floor(walls, wood, chance, pieces, gap):
    """The corridor lies along x from 0 to 40 m, and y from 0 to 2 m."""
    door_low, door_high, top, thickness = 3.4, 4.3, 2.1, 0.1
    ends = {-1: (-thickness - 6, -thickness), 1: (2 + thickness, 8 + thickness)}
    walls.box((-0.1, -6.1, 0), (40.1, 8.1, 3))
    for side, (near, far) in ends.items():
        wall = (-thickness, 0) if side < 0 else (2, 2 + thickness)
        for room in range(5):
            x = 8.0 * room
            begin, end = (-0.1 if room == 0 else x), (40.1 if room == 4 else x + 8)
            # The wall beside the door and above it; the sides of the door itself are faces of these boxes.
            walls.box((begin, wall[0], 0), (x + door_low, wall[1], 3), "XyY")
            walls.box((x + door_high, wall[0], 0), (end, wall[1], 3), "xyY")
            walls.box((x + door_low, wall[0], top), (x + door_high, wall[1], 3), "yYz")
            if room > 0:  # the wall to the room before
                walls.box((x - 0.05, near, 0), (x + 0.05, far, 3), "xX")
            furnish(wood, chance, (x + 0.6, near + 0.4), (x + 7.4, far - 0.4), pieces, gap)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kind", choices=("office", "floor"))
    parser.add_argument("output", type=pathlib.Path)
    parser.add_argument("--pieces", type=int, default=60, help="of furniture, in each room")
    parser.add_argument("--gap", type=float, default=0.0, help="between furniture and ground, m")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    walls, wood = Mesh(), Mesh()
    (office if options.kind == "office" else floor)(walls, wood, random.Random(options.seed), options.pieces,
                                                        options.gap)
    shapes = []
    for name, mesh in (("concrete", walls), ("wood", wood)):
        if not mesh.quads:
            continue
        ply = options.output.with_name(f"{options.output.stem}_{name}.ply")
        mesh.write(ply)
        shapes.append(f'<bsdf type="itu-radio-material" id="mat-{name}"><string name="type" value="{name}"/></bsdf>\n'
                      f'<shape type="ply" id="{name}"><string name="filename" value="{ply.name}"/>'
                      f'<ref id="mat-{name}" name="bsdf"/></shape>\n')
    options.output.write_text('<scene version="2.1.0">\n' + "".join(shapes) + "</scene>\n")


if __name__ == "__main__":
    main()
