# SPDX-License-Identifier: Apache-2.0
"""The protocol over real sockets: the channels of `wavetracer run` at the same poses, both kinds of sockets, two clients
at once, step by step and free-running, a server that starts again.
Assumes an OpenCL device; results are compared between two runs of the program on that device."""
import cmath
import json
import math
import os
import stat
import subprocess
import sys
import tempfile

from live_server import CONFIG, POSES, PROGRAM, SOURCE, Server, drive, expect, frame, vehicle

# The truck turns the corner.
TRACKS = drive("[[0.0, -20.0, 3.0, 0.0], [1.0, -28.0, 3.0, 0.0]]")


def same_as_run():
    try:
        import h5py
    except ImportError:
        print("no h5py: the comparison with `wavetracer run` is left out")
        return
    with tempfile.TemporaryDirectory() as folder:
        config = CONFIG[:CONFIG.index("[[live_vehicle]]")] + CONFIG[CONFIG.index("[[mount]]"):] + TRACKS
        path = os.path.join(folder, "drive.toml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(config)
        subprocess.run([PROGRAM, "run", "-c", path, "-o", os.path.join(folder, "out")], check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        expected = {}
        with h5py.File(os.path.join(folder, "out", "paths.h5")) as run:
            names = {role: [n.decode() for n in run[f"{role}s/name"][:]] for role in ("transmitter", "receiver")}
            paths = run["paths"]
            re, im = paths["a_re"][:], paths["a_im"][:]
            for k in range(len(paths["delay_s"])):
                link = names["transmitter"][paths["tx"][k]], names["receiver"][paths["rx"][k]]
                expected.setdefault(link, []).append(
                    (float(paths["delay_s"][k]), float(re[k].flat[0]), float(im[k].flat[0])))
    with Server() as server, server.connect() as client:
        client.hello(detail="paths")
        answer = client.ask(frame(0, 0.0, POSES))
    found = {(link["tx"], link["rx"]): [(d, r[0], i[0]) for d, r, i in zip(link["delay_s"], link["a_re"], link["a_im"])]
             for link in answer["links"] if link["paths"]}
    expect(found.keys() == expected.keys(), f"links {found.keys() ^ expected.keys()}")
    count = 0
    for link, rows in expected.items():
        expect(sorted(rows) == sorted(found[link]), f"{link}: {sorted(rows)} and {sorted(found[link])}")
        count += len(rows)
    expect(count > 10, f"{count} paths")
    print(f"{count} paths of {len(expected)} links as `run` has them, bit for bit in a and delay")


def columns_are_the_lines():
    """With encoding = "cbor" every number is the same double as in the line of JSON."""
    sys.path.insert(0, os.path.join(SOURCE, "python"))
    try:
        from wavetracer._live_columns import read_cbor
    except ImportError:
        print("no NumPy: the comparison of columns with lines is left out")
        return

    def same(column, values, what):
        values = [math.nan if value is None else value for value in values]
        equal = len(column) == len(values) and all(
            a == b or not math.isfinite(a) and math.isnan(b) for a, b in zip(column, values))
        expect(equal, f"{what}: {list(column)[:5]} and {values[:5]}")

    with Server() as server:
        for detail in ("links", "paths", "vertices"):
            with server.connect() as client:
                client.hello(detail=detail)
                lines = client.ask(frame(1, 0.0, POSES, cold=True))["links"]
            with server.connect() as client:
                client.hello(detail=detail, encoding="cbor")
                first = client.ask(frame(1, 0.0, POSES, cold=True))
                first.update(read_cbor(client.file.read(first["bytes"])))
                expect(client.ask(frame(2, 0.1, POSES))["frame"] == 2, "the next line comes after the columns")
            expect("links" in first and first["bytes"] > 0, first.keys())
            links = first["links"]
            ends = [(first["transmitters"][t], first["receivers"][r]) for t, r in zip(links["tx"], links["rx"])]
            expect(ends == [(link["tx"], link["rx"]) for link in lines], ends)
            same(links["paths"], [link["paths"] for link in lines], "paths")
            same(links["los"], [int(link["los"]) for link in lines], "los")
            for key in ("path_gain_db", "sum_of_powers_db", "narrowband_gain_db", "mean_delay_s", "rms_delay_spread_s",
                        "doppler_spread_hz", "missed_power_share"):
                same(links[key], [link[key] for link in lines], key)
            expect(("paths" in first) == (detail != "links"), detail)
            expect(("vertices" in first) == (detail == "vertices"), detail)
            if detail != "links":
                for key in ("delay_s", "gain_db", "doppler_hz", "aod_theta_rad", "aod_phi_rad", "aoa_theta_rad",
                            "aoa_phi_rad"):
                    same(first["paths"][key], [v for link in lines for v in link.get(key, [])], key)
                pairs = [v for link in lines for re, im in zip(link["a_re"], link["a_im"])
                         for pair in zip(re, im) for v in pair]
                same(first["paths"]["a"], pairs, "a")
            if detail == "vertices":
                vertices = first["vertices"]
                each = {key: [v for link in lines for path in link[key] for v in path]
                        for key in ("vertices_m", "interactions", "surfaces", "vehicles")}
                same(vertices["depth"], [len(path) for link in lines for path in link["interactions"]], "depth")
                same(vertices["position_m"], [x for point in each["vertices_m"] for x in point], "position_m")
                same(vertices["interaction"], each["interactions"], "interaction")
                same(vertices["surface"], each["surfaces"], "surface")
                vehicles = [None if v == 4294967295 else first["ids"][v] for v in vertices["vehicle"]]
                expect(vehicles == each["vehicles"], vehicles)
                expect(len(vehicles) > 10, vehicles)
    print("columns in CBOR have the numbers of the lines")


def steps_and_detail(listen):
    with Server(listen) as server:
        with server.connect() as client:
            world = client.hello()
            expect(world["message"] == "world" and world["protocol"] == 1, world)
            expect([(t["type"], t["places"]) for t in world["types"]] == [("passenger", 4), ("truck", 1)], world)
            expect(world["transmitters"] == ["rsu"] and world["receivers"] == [], world)
            for number, detail in enumerate(("links", "paths", "vertices")):
                answer = client.ask(frame(number, number / 10, POSES, detail=detail))
                expect(answer["frame"] == number and answer["time_s"] == number / 10, answer)
                names = {(link["tx"], link["rx"]) for link in answer["links"]}
                # The truck carries no antenna; rsu sends and does not listen.
                expect(names == {("rsu", "ego/roof"), ("rsu", "other/roof"), ("ego/roof", "other/roof"),
                                 ("other/roof", "ego/roof")}, names)
                expect(answer["missed"]["paths"]["high"] >= answer["missed"]["paths"]["low"] >= 0, answer["missed"])
                for link in answer["links"]:
                    expect(not link["paths"] or link["missed_power_share"] >= 0, link)
                    expect(("delay_s" in link) == (detail != "links"), link)
                    expect(("vertices_m" in link) == (detail == "vertices"), link)
                    if detail != "links" and link["paths"]:
                        power = sum(r[0] ** 2 + i[0] ** 2 for r, i in zip(link["a_re"], link["a_im"]))
                        expect(math.isclose(10 * math.log10(power), link["path_gain_db"], abs_tol=1e-9), link)
                        h = sum(complex(r[0], i[0]) * cmath.exp(-2j * math.pi * ((world["frequency_hz"] * tau) % 1))
                                for r, i, tau in zip(link["a_re"], link["a_im"], link["delay_s"]))
                        expect(math.isclose(20 * math.log10(abs(h)), link["narrowband_gain_db"], abs_tol=1e-6), link)
                    if detail == "vertices":
                        for depth, vertices in zip(map(len, link["interactions"]), link["vertices_m"]):
                            expect(depth == len(vertices), link)
            # Many frames at once are answered in their order, refusals among them.
            wrong = frame(11, 1.1, [vehicle("ego", 3, -60, kind="tank")])
            client.send("".join(json.dumps(m) + "\n" for m in (frame(10, 1.0, POSES), wrong, frame(12, 1.2, POSES))))
            answers = [client.receive() for _ in range(3)]
            expect([a["frame"] for a in answers] == [10, 11, 12], answers)
            expect([a["message"] for a in answers] == ["channels", "error", "channels"], answers)
            expect(answers[1]["code"] == "unknown_type", answers[1])
            expect(client.ask({"message": "bye"})["message"] == "bye", "bye")
            expect(client.receive() is None, "closed after bye")
        expect(server.end() == 0, f"exit code; {server.log}")
    print(f"steps over {listen.split(':')[0]}")


def station():
    """A road-side unit that sends and receives, under one name in both lists; it is no link to itself."""
    with Server(config=CONFIG.replace("[[transmitter]]", "[[station]]")) as server, server.connect() as client:
        world = client.hello(detail="paths")
        expect(world["transmitters"] == ["rsu"] and world["receivers"] == ["rsu"], world)
        links = {(link["tx"], link["rx"]): link for link in client.ask(frame(0, 0.0, POSES))["links"]}
        cars = ("ego/roof", "other/roof")
        expect(links.keys() == {(a, b) for a in ("rsu", *cars) for b in ("rsu", *cars) if a != b}, links.keys())
        for car in cars:  # isotropic antennas: as much one way as the other
            there, back = links["rsu", car], links[car, "rsu"]
            expect(len(there["delay_s"]) == len(back["delay_s"]) > 2, (there, back))
            for one, other in zip(there["delay_s"], back["delay_s"]):
                expect(math.isclose(one, other, rel_tol=1e-12), (there, back))
    print("a station sends and receives")


def beams_and_sparse_rays():
    """With beams answers have their certificate in place of an estimate; rays that do not show what they missed have none,
    neither for the frame nor for its links."""
    beams = CONFIG.replace("rays = 50000", 'discovery = "beams"')
    with Server(config=beams) as server, server.connect() as client:
        client.hello()
        answer = client.ask(frame(0, 0.0, POSES))
        certificate = answer["certificate"]
        expect(certificate["depth"] == 4 and 0 <= certificate["left_out_sr"] < 1e-6, certificate)
        expect(certificate["edges"] == 0, certificate)
        expect(certificate["any_depth"] is False and "floor_db" not in certificate, certificate)
        expect(0 <= certificate["left_out_power"] <= certificate["left_out_sr"], certificate)
        # rsu and the two cars send.
        share = certificate["left_out_sr"] / (3 * 4 * math.pi)
        expect(math.isclose(certificate["left_out_share"], share, rel_tol=1e-12), certificate)
        expect("missed" not in answer and "missed_unknown" not in answer, answer)
        expect(any(link["paths"] for link in answer["links"]), answer)
        expect(all(link["missed_power_share"] is None for link in answer["links"]), answer)
    far = CONFIG.replace("[8.0, 8.0, 6.0]", "[0.0, 0.0, 150.0]").replace("rays = 50000", "rays = 100")
    with Server(config=far) as server, server.connect() as client:
        client.hello()
        answer = client.ask(frame(0, 0.0, POSES))
        expect("missed" not in answer and "certificate" not in answer and answer["missed_unknown"] is True, answer)
        expect(any("it is not known how many paths they missed" in text for text in answer["warnings"]), answer)
        expect(all(link["missed_power_share"] is None for link in answer["links"]), answer)
    with Server() as server, server.connect() as client:
        client.hello()
        answer = client.ask(frame(0, 0.0, POSES))
        expect("missed" in answer and "certificate" not in answer and "missed_unknown" not in answer, answer)
    print("certificates of beams, and rays that do not show what they missed")


def two_clients():
    """Each has its own vehicles, though they share ids and places."""
    with Server() as server, server.connect() as one, server.connect() as two:
        one.hello(detail="paths")
        two.hello(detail="paths")
        alone = one.ask(frame(0, 0, POSES, cold=True))["links"]
        for step in range(1, 4):
            one.send(frame(step, step, POSES, cold=True))
            two.send(frame(step, step, [vehicle("ego", 0, 40, 90)], cold=True))
            first, second = one.receive(), two.receive()
            expect(first["links"] == alone, f"client one in step {step}")
            expect([link["rx"] for link in second["links"]] == ["ego/roof"], second)
        two.close()  # in the middle, with a frame of its own under way
        with server.connect() as third:
            third.hello()
            third.send(frame(0, 0, POSES))
            third.close()
        expect(one.ask(frame(9, 9, POSES, cold=True))["links"] == alone, "client one goes on")
    print("two clients, and two that vanish")


def between_poses():
    """Channels at times between two frames of poses: the car on its way, and its Doppler shift."""
    with Server() as server, server.connect() as client:
        client.hello(detail="paths")
        expect(client.ask({"message": "at", "frame": 0, "time_s": 0})["code"] == "out_of_time", "no poses yet")
        ends = []
        for step in range(2):
            y, speed = -60 + 1.1 * step, 10 + 2 * step
            ends.append(client.ask(frame(step, step / 10, [vehicle("ego", 3, y, 90, velocity_m_s=[0, speed, 0])])))
        inner = [client.ask({"message": "at", "frame": 2 + k, "time_s": 0.02 * k}) for k in range(6)]
        expect([a["frame"] for a in inner] == list(range(2, 8)), inner)
        sight = [min(a["links"][0]["delay_s"]) for a in inner]
        shift = [a["links"][0]["doppler_hz"][a["links"][0]["delay_s"].index(d)] for a, d in zip(inner, sight)]
        expect(all(a > b for a, b in zip(sight, sight[1:])), f"it comes closer: {sight}")
        expect(shift == sorted(shift), f"faster and faster: {shift}")
        for here, there in ((inner[0], ends[0]), (inner[5], ends[1])):
            expect(math.isclose(min(here["links"][0]["delay_s"]), min(there["links"][0]["delay_s"]), rel_tol=1e-12),
                   "at the poses themselves")
        expect(client.ask({"message": "at", "frame": 8, "time_s": 0.11})["code"] == "out_of_time", "later than poses")
        expect(client.ask({"message": "at", "frame": 9})["code"] == "missing_key", "no time")
        expect(client.ask({"message": "at", "frame": 9, "time_s": 0, "vehicles": []})["code"] == "unknown_key", "poses")
    print("between poses")


def free_running():
    """If frames come faster than they are solved, the newest is solved, and the others are counted."""
    with Server(sets=["live.max_pending_frames=1"]) as server, server.connect() as client:
        client.hello(mode="free")
        last = 40
        client.send("".join(json.dumps(frame(k, k / 10, POSES)) + "\n" for k in range(last + 1)))
        answered = skipped = 0
        previous = -1
        while previous != last:
            answer = client.receive()
            expect(answer["message"] == "channels" and answer["frame"] > previous, answer)
            previous = answer["frame"]
            answered += 1
            skipped += answer["skipped"]
        expect(answered + skipped == last + 1 and skipped > 0, f"{answered} answered, {skipped} skipped")
    print(f"free-running: {answered} frames answered, {skipped} skipped")


def nothing_for_nobody():
    """Results that answers cannot carry are not computed, and a warning says so."""
    server = Server(sets=["response.bandwidth_hz=20e6", "radio.frequencies_hz=[5.9e9, 28e9]"])
    with server.connect() as client:
        client.hello()
        expect(client.ask(frame(0, 0, POSES))["message"] == "channels", "with [response]")
    expect(server.end() == 0, "the end of a server")
    for key in ("response.bandwidth_hz", "radio.frequencies_hz"):
        expect(any(f"{key}" in line and "is left out" in line for line in server.log), server.log)
    print("responses and more carriers are left out, with a warning")


def starts_again():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "live.sock")
        server = Server("unix:" + path)
        expect(stat.S_IMODE(os.stat(path).st_mode) == 0o600, "mode of the socket")
        try:
            Server("unix:" + path)
            raise SystemExit("failed: a second server took the socket of the first")
        except RuntimeError as error:
            expect("exit 2" in str(error) and "already" in str(error), error)
        server.end(9)  # killed: the socket stays, dead
        expect(os.path.exists(path), "the socket of a killed server")
        with Server("unix:" + path) as server, server.connect() as client:
            client.hello()
            expect(client.ask(frame(0, 0, POSES))["message"] == "channels", "after a restart")
        expect(not os.path.exists(path), "the socket is removed")
        with open(path, "w", encoding="utf-8") as file:
            file.write("mine")
        try:
            Server("unix:" + path)
            raise SystemExit("failed: a file was overwritten")
        except RuntimeError as error:
            expect("exit 2" in str(error), error)
        with open(path, encoding="utf-8") as file:
            expect(file.read() == "mine", "the file that was there")
    print("restart, stale socket, a file in the way")


def main():
    same_as_run()
    columns_are_the_lines()
    steps_and_detail("tcp:127.0.0.1:0")
    with tempfile.TemporaryDirectory() as folder:
        steps_and_detail(f"unix:{folder}/live.sock")
    beams_and_sparse_rays()
    station()
    two_clients()
    between_poses()
    free_running()
    nothing_for_nobody()
    starts_again()


if __name__ == "__main__":
    sys.exit(main())
