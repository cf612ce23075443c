# SPDX-License-Identifier: Apache-2.0
"""docs/examples/sumo_live.py follows a real SUMO: poses against SUMO's own FCD of the same run, lines of sight against
Friis' equation. Answers 77, "skipped", where there is no SUMO. Assumes an OpenCL device."""
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as tree

from live_server import SOURCE, Server, expect

CONFIG = """
[scene]
generate = "--seed 1 --blocks 2x2"
[[live_vehicle]]
type = "passenger"
count = 6
[[mount]]
name = "roof"
offset_m = [0.0, 0.0, 1.6]
[trace]
rays = 10000
max_depth = 1
"""
ROUTES = """<routes><vType id="car" vClass="passenger" length="5" sigma="0"/>
<route id="r" edges="A1B1 B1B0"/><vehicle id="first" type="car" route="r" depart="0"/>
<vehicle id="second" type="car" route="r" depart="3"/></routes>"""


# sumo_live.py takes the package of the source tree.
ENVIRONMENT = {**os.environ, "PYTHONPATH": os.path.join(SOURCE, "python")}


def main():
    tools = os.path.join(os.environ.get("SUMO_HOME", "/usr/share/sumo"), "tools")
    if not shutil.which("sumo") or not shutil.which("netgenerate") or not os.path.isdir(os.path.join(tools, "traci")):
        print("skipped: no SUMO (Debian: sumo, sumo-tools)")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        net, routes, fcd, out = (os.path.join(folder, name) for name in ("n.net.xml", "r.rou.xml", "fcd.xml", "out.jsonl"))
        with open(routes, "w", encoding="utf-8") as file:
            file.write(ROUTES)
        # Crossings at -100, 0 and 100 m as in the scene.
        subprocess.run(["netgenerate", "--grid", "--grid.number", "3", "--grid.length", "100", "-o", net], check=True,
                       stdout=subprocess.DEVNULL)
        with Server(config=CONFIG) as server:
            subprocess.run([sys.executable, "-B", os.path.join(SOURCE, "docs/examples/sumo_live.py"), "--server",
                            server.name, "--offset", "-100", "-100", "0", "--steps", "15", "--detail", "paths", "-o",
                            out, "--", "sumo", "-n", net, "-r", routes, "--fcd-output", fcd, "--precision", "6",
                            "--no-step-log"], check=True, stdout=subprocess.DEVNULL, env=ENVIRONMENT)
            between = subprocess.run([sys.executable, "-B", os.path.join(SOURCE, "docs/examples/sumo_live.py"), "--server",
                                      server.name, "--offset", "-100", "-100", "0", "--steps", "6", "--between", "4",
                                      "--encoding", "cbor", "--", "sumo", "-n", net, "-r", routes, "--no-step-log"],
                                     check=True, capture_output=True, text=True, env=ENVIRONMENT).stdout
            times = [float(line.split()[0]) for line in between.splitlines() if " links have paths" in line]
            expect(times == [k / 5 for k in range(5, 31)], f"instants between the steps: {times}")
        with open(out, encoding="utf-8") as file:
            answers = [json.loads(line) for line in file]
        steps = {round(float(step.get("time"))): step for step in tree.parse(fcd).getroot()}
    expect(len(answers) == 15, f"{len(answers)} answers")
    poses = sights = 0
    for answer in answers:
        # traci.simulation.getTime() is that after the step; FCD has the state at the step's begin.
        recorded = {v.get("id"): v for v in steps[round(answer["time_s"]) - 1]}
        expect({v["id"] for v in answer["vehicles"]} == set(recorded), f"vehicles at {answer['time_s']} s")
        for mine in answer["vehicles"]:
            theirs = recorded[mine["id"]]
            bearing = math.radians(float(theirs.get("angle")))
            ahead = math.sin(bearing), math.cos(bearing)  # east, north
            middle = [float(theirs.get("x")) - 100 - 2.5 * ahead[0], float(theirs.get("y")) - 100 - 2.5 * ahead[1]]
            expect(math.dist(mine["position_m"][:2], middle) < 1e-4, f"{mine} and {theirs.attrib}")
            w, x, y, z = mine["orientation"]
            expect(math.isclose(math.cos(2 * math.atan2(z, w)), ahead[0], abs_tol=1e-5), mine)
            poses += 1
        places = {v["id"]: v for v in answer["vehicles"]}
        for link in answer["links"]:
            if link["los"]:
                a, b = (places[link[end].removesuffix("/roof")]["position_m"] for end in ("tx", "rx"))
                metres = math.dist(a, b)  # both antennas 1.6 m above level ground, level vehicles
                expect(math.isclose(link["delay_s"][0], metres / 299792458, rel_tol=1e-9), link)
                friis = 20 * math.log10(299792458 / 5.9e9 / (4 * math.pi * metres))
                expect(math.isclose(link["gain_db"][0], friis, abs_tol=1e-6), f"{link['gain_db'][0]} and {friis}")
                sights += 1
    expect(poses > 15 and sights > 10, f"{poses} poses, {sights} lines of sight")
    print(f"{poses} poses as SUMO's FCD has them, {sights} lines of sight as Friis says")
    return 0


if __name__ == "__main__":
    sys.exit(main())
