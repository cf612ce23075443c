#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Follows a running SUMO by TraCI, sends its vehicles to `wavetracer serve`, and prints or writes their channels.

    wavetracer serve -c configs/sumo/live.toml &
    python3 docs/examples/sumo_live.py --steps 50 -- sumo -c configs/sumo/town.sumocfg

The command after `--` starts SUMO (sumo or sumo-gui). --offset is added to SUMO's coordinates to
get those of the scene. SUMO's angle is a compass bearing and its position the middle of the front bumper: both are
converted for the server, yaw from +x counter-clockwise and the middle of the vehicle. A vehicle takes a place
of the type that is called as its vehicle class (passenger, truck, bus, ...), or as --default-type; one that has no
place, or is outside of the scene, is left out and counted. --between N also asks for the channels at N instants of
every step, from the vehicles that both of its ends have: SUMO steps by tenths of a second, radios by milliseconds.
It needs SUMO's TraCI (Debian: sumo-tools), NumPy, and wavetracer.live (in the source tree: PYTHONPATH=python).
"""
import argparse
import contextlib
import json
import math
import os
import sys

from live_client import print_links
from wavetracer import live

sys.path.append(os.path.join(os.environ.get("SUMO_HOME", "/usr/share/sumo"), "tools"))


def pose(traci, name, offset_m):
    """position_m of the middle of the footprint, orientation (w, x, y, z) and velocity_m_s of a vehicle of SUMO."""
    front_m = [p + o for p, o in zip(traci.vehicle.getPosition3D(name), offset_m)]
    yaw = math.radians(90 - traci.vehicle.getAngle(name))
    pitch = math.radians(traci.vehicle.getSlope(name))  # nose up
    ahead = [math.cos(pitch) * math.cos(yaw), math.cos(pitch) * math.sin(yaw), math.sin(pitch)]
    length_m, speed_m_s = traci.vehicle.getLength(name), traci.vehicle.getSpeed(name)
    c, s, d, t = math.cos(yaw / 2), math.sin(yaw / 2), math.cos(pitch / 2), math.sin(pitch / 2)
    return {"position_m": [p - length_m / 2 * a for p, a in zip(front_m, ahead)],
            "orientation": [c * d, s * t, -c * t, s * d],  # yaw about z, then pitch about the vehicle's y
            "velocity_m_s": [speed_m_s * a for a in ahead]}


class Places:
    """The vehicles of SUMO that have a place on the server: they keep it, and others come when places get free."""

    def __init__(self, world, default_type):
        self.free = {kind["type"]: kind["places"] for kind in world["types"]}
        self.lower, self.upper = world["bounds_m"]["lower"], world["bounds_m"]["upper"]
        self.default_type = default_type
        self.type_of = {}

    def vehicles(self, traci, offset_m):
        """The vehicles of this step, and the number of those that had to be left out."""
        poses = {name: pose(traci, name, offset_m) for name in traci.vehicle.getIDList()}
        inside = {name: p for name, p in poses.items()
                  if all(a <= x <= b for a, x, b in zip(self.lower, p["position_m"], self.upper))}
        for name in [name for name in self.type_of if name not in inside]:
            self.free[self.type_of.pop(name)] += 1
        for name in inside:
            kind = traci.vehicle.getVehicleClass(name)
            kind = kind if kind in self.free else self.default_type
            if name not in self.type_of and self.free.get(kind, 0) > 0:
                self.free[kind] -= 1
                self.type_of[name] = kind
        out = [{"id": name, "type": self.type_of[name], **p} for name, p in inside.items() if name in self.type_of]
        return out, len(poses) - len(out)


def follow(traci, client, options, output):
    """Sends the vehicles of each step, prints their channels, and writes them if there is an output."""
    places = Places(client.world, options.default_type)
    last_s = None
    for _ in range(options.steps):
        traci.simulationStep()
        vehicles, left_out = places.vehicles(traci, options.offset)
        now_s = traci.simulation.getTime()
        channels = client.channels(now_s, vehicles)
        inner = range(1, options.between + 1 if last_s is not None else 1)
        instants = client.at_each([last_s + k * (now_s - last_s) / (options.between + 1) for k in inner])
        for each in instants:
            print_links(each, 1)
        print_links(channels, 3)
        if left_out:
            print(f"  {left_out} vehicles had no place, or were outside of the scene")
        if output:
            output.writelines(json.dumps(each.answer) + "\n" for each in instants)
            output.write(json.dumps({"vehicles": vehicles, **channels.answer}) + "\n")
        last_s = now_s


def main():
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    live.add_arguments(parser, encoding="json")
    parser.add_argument("--offset", type=float, nargs=3, default=[0, 0, 0], metavar=("X", "Y", "Z"))
    parser.add_argument("--default-type", default="passenger")
    parser.add_argument("--steps", type=int, default=100)
    parser.add_argument("--between", type=int, default=0, metavar="N", help="instants of a step, beside its ends")
    parser.add_argument("-o", "--output", help="file for the answers, one line of JSON per instant")
    parser.add_argument("sumo", nargs="+", help="command that starts SUMO")
    options = parser.parse_args()
    if options.output and options.encoding == "cbor":
        sys.exit("--output writes lines of JSON: leave out --encoding cbor")
    try:
        import traci
    except ImportError:
        sys.exit("no TraCI: install sumo-tools, or set SUMO_HOME")
    with contextlib.ExitStack() as stack:
        client = stack.enter_context(live.connect(options))
        output = stack.enter_context(open(options.output, "w", encoding="utf-8")) if options.output else None
        traci.start(options.sumo)
        stack.callback(traci.close)
        follow(traci, client, options, output)


if __name__ == "__main__":
    try:
        main()
    except live.Error as error:
        sys.exit(f"sumo_live: {error}")
