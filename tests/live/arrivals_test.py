# SPDX-License-Identifier: Apache-2.0
"""Worlds that no road has: vehicles that come and go at random, stand in each other, on walls and on the ground, clocks
that run back. Every frame is answered, by channels or by an error that says what is wrong, and the server goes on.
Assumes an OpenCL device."""
import math
import random
import sys

from live_server import CONFIG, Server, expect, frame, vehicle

SMALL = ["trace.rays=2000", "trace.max_depth=2"]
AUTO = ["trace.rays='auto'", "trace.max_depth=2", "trace.max_rays=50000"]


def finite(answer):
    """No number of the answer is anything but finite, gains of links without a path excepted."""
    for link in answer["links"]:
        expect(link["paths"] == 0 or link["path_gain_db"] is not None, link)
        for key in ("delay_s", "gain_db", "doppler_hz", "aod_theta_rad", "aoa_phi_rad"):
            expect(all(v is not None and math.isfinite(v) for v in link.get(key, [])), (key, link))


def random_arrivals(sets):
    """Numbers of antennas that change from frame to frame, of two clients that take turns."""
    generator = random.Random(1)
    with Server(sets=sets) as server, server.connect() as one, server.connect() as two:
        one.hello(detail="paths")
        two.hello(detail="paths")
        for step in range(30):
            client = generator.choice((one, two))
            cars = generator.sample(range(20), generator.randrange(5))
            vehicles = [vehicle(f"car{k}", generator.uniform(-80, 80), generator.uniform(-80, 80),
                                generator.uniform(0, 360)) for k in cars]
            vehicles += [vehicle("lorry", -20, 3, 180, "truck")] * generator.randrange(2)
            answer = client.ask(frame(step, step / 10, vehicles, cold=generator.random() < 0.2))
            expect(answer["message"] == "channels" and answer["frame"] == step, answer)
            names = {link["rx"] for link in answer["links"]}
            expect(names == {f"car{k}/roof" for k in cars}, (names, cars))
            finite(answer)
        expect(server.process.poll() is None, server.log)
    print(f"random arrivals, {sets[0]}")


def as_many_samples_of_fewer():
    """A cold frame of one antenna launches as many rays to begin with as a warm one of four."""
    cars = [vehicle(f"car{k}", 0, -60 + 30 * k) for k in range(3)]
    with Server(sets=AUTO) as server, server.connect() as client, server.connect() as other:
        client.hello()
        other.hello()
        for _ in range(3):
            for step, (vehicles, cold) in enumerate(((cars, True), (cars, False), (cars[:1], True), (cars[:1], False))):
                answer = client.ask(frame(step, step, vehicles, cold=cold))
                expect(answer and answer["message"] == "channels", f"frame {step}: {answer}, {server.log[-3:]}")
        expect(other.ask(frame(0, 0, cars))["message"] == "channels", "the other client")
    print("as many samples of fewer antennas")


def in_one_place():
    """Two vehicles in one point, or a little beside it: the line of sight between their antennas is left out."""
    with Server(sets=SMALL) as server, server.connect() as client:
        client.hello(detail="paths")
        for step, gap_m in enumerate((0, 1e-15, 1e-13, 1e-10, 1e-7, 9e-7, 1e-5, 9e-5, 1.5e-4, 1e-3, 0.1)):
            answer = client.ask(frame(step, step, [vehicle("a", 1, -40), vehicle("b", 1, -40 + gap_m)]))
            expect(answer["message"] == "channels", f"{gap_m} m: {answer}")
            links = {(link["tx"], link["rx"]): link for link in answer["links"]}
            for tx, rx in (("a/roof", "b/roof"), ("b/roof", "a/roof")):
                expect(links[tx, rx]["los"] == (gap_m > 1e-4), f"{gap_m} m: {links[tx, rx]}")
            told = [text for text in answer.get("warnings", []) if "left out" in text]
            expect(bool(told) == (gap_m <= 1e-4), f"{gap_m} m: {answer.get('warnings')}")
            expect(not told or '"a/roof" -> "b/roof"' in told[0], told)
            finite(answer)
    print("two vehicles in one place")


def on_surfaces():
    """Antennas on the ground and just above it, which reflects what they send, or does not."""
    low = CONFIG.replace("[0.0, 0.0, 1.6]", "[0.0, 0.0, 0.0]")
    with Server(config=low, sets=SMALL) as server, server.connect() as client:
        client.hello(detail="paths")
        for step, gap_m in enumerate((0, 1e-15, 1e-13, 1e-10, 1e-7, 9e-7, 1e-5, 1e-3)):
            vehicles = [vehicle("a", 1, -40), vehicle("b", 1, -20)]
            vehicles[0]["position_m"][2] = gap_m
            vehicles[1]["position_m"][2] = 1
            answer = client.ask(frame(step, step, vehicles))
            expect(answer["message"] == "channels", f"{gap_m} m: {answer}")
            links = {(link["tx"], link["rx"]): link for link in answer["links"]}
            there, back = links["a/roof", "b/roof"], links["b/roof", "a/roof"]
            expect(there["paths"] == back["paths"] > 0, f"{gap_m} m: {there}, {back}")
            expect(math.isclose(there["path_gain_db"], back["path_gain_db"], abs_tol=1e-6), (there, back))
            finite(answer)
    print("antennas on surfaces")


def clocks():
    """Times that stand, run back or leap, and turns faster than any vehicle's: no shift is nonsense."""
    aside = CONFIG.replace("[0.0, 0.0, 1.6]", "[1.0, 0.0, 1.6]")
    with Server(config=aside, sets=SMALL) as server, server.connect() as client:
        client.hello(detail="paths")
        for step, time_s in enumerate((5, 5, 4, -1e12, 1e12, 0, 1e-300, 2e-300, 1e-12, 0.1)):
            answer = client.ask(frame(step, time_s, [vehicle("a", 1, -40, 90 * step), vehicle("b", 1, -20)]))
            expect(answer["message"] == "channels" and answer["time_s"] == time_s, answer)
            finite(answer)
            for link in answer["links"]:  # 150 m/s, and 100 rad/s about an axis 1 m away, of either end
                expect(all(abs(shift) < 2 * 250 * 5.9e9 / 3e8 for shift in link["doppler_hz"]), link)
    print("clocks")


def leaves_in_the_middle():
    """Clients that vanish while a frame is solved, while its answer is on the way, after half a message."""
    vehicles = [vehicle(f"car{k}", 0, -60 + 30 * k) for k in range(4)]
    with Server(sets=SMALL) as server, server.connect() as witness:
        witness.hello()
        for step in range(6):
            client = server.connect()
            client.hello(detail="vertices")
            client.send(frame(0, 0, vehicles))
            if step % 3 == 1:
                client.socket.recv(100)
            if step % 3 == 2:
                client.send({"message": "bye"})  # before the answer
                client.bytes(b'{"message":"fra')
            client.close()
            expect(witness.ask(frame(step, step, vehicles))["message"] == "channels", f"after departure {step}")
        expect(server.end() == 0, server.log[-3:])
    print("clients that leave in the middle")


def main():
    random_arrivals(SMALL)
    random_arrivals(AUTO)
    as_many_samples_of_fewer()
    in_one_place()
    on_surfaces()
    clocks()
    leaves_in_the_middle()


if __name__ == "__main__":
    sys.exit(main())
