#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The formulas of bench/validation against values that others have computed or published.

Usage: models_test.py FOLDER; FOLDER is bench/validation. Exits with 77 without numpy and scipy. No device is used.
"""
import sys
import types

try:
    import numpy as np
    import scipy.integrate
except ImportError:
    sys.exit(77)
sys.path.insert(0, sys.argv[1])
import links
import p526
import p1411
import tr37885
import tr38901
import virtualsource11p


def near(got, wanted, tolerance, what):
    assert abs(got - wanted) <= tolerance, f"{what}: {got}, not {wanted}"


def check_3gpp():
    # These are the expected powers of ns-3's own tests, three-gpp-propagation-loss-model-test-suite.cc: 5 GHz, 10 m and
    # 1.5 m high (UMi), 1.6 m (vehicles); they are less accurate than printed, hence ns-3's tolerance.
    for distance, los, nlos in ((10, 69.8591, 76.7563), (100, 88.4122, 107.9432), (1000, 119.3114, 143.1886)):
        near(tr38901.path_loss(5, distance, 10, 1.5, "los"), los, 0.05, f"UMi, LOS, {distance} m")
        near(tr38901.path_loss(5, distance, 10, 1.5, "nlos"), nlos, 0.05, f"UMi, NLOS, {distance} m")
    for distance, los, nlos in ((10, 68.1913, 80.0605), (100, 84.8913, 110.0605), (1000, 101.5913, 140.0605)):
        near(tr37885.path_loss(5, distance, "los"), los, 0.05, f"V2V, LOS, {distance} m")
        near(tr37885.path_loss(5, distance, "nlos"), nlos, 0.05, f"V2V, NLOS, {distance} m")
    near(tr37885.blockage(100)[0], 9, 0, "a vehicle in between, near")
    near(tr37885.blockage(1000)[0], 13, 1e-12, "a vehicle in between, at 1 km: 15 * 3 - 41 = 4 dB more")
    # By hand at 9 GHz, where log10(1 + f) is 1.
    for got, wanted in ((tr38901.spreads(9, "los"), {"ds": (-7.38, 0.38), "asa": (1.65, 0.294), "asd": (1.16, 0.41)}),
                        (tr38901.spreads(9, "nlos"), {"ds": (-7.07, 0.44), "asa": (1.73, 0.35), "asd": (1.30, 0.44)}),
                        (tr37885.spreads(9, "los"), {"ds": (-7.7, 0.1), "asa": (1.5, 0.1), "asd": (1.5, 0.1)}),
                        (tr37885.spreads(9, "nlos"), {"ds": (-7.3, 0.28), "asa": (1.73, 0.35), "asd": (1.73, 0.35)}),
                        (tr37885.spreads(9, "nlosv"), {"ds": (-7.4, 0.1), "asa": (1.6, 0.1), "asd": (1.6, 0.1)})):
        for name, pair in wanted.items():
            near(got[name][0], pair[0], 1e-12, name)
            near(got[name][1], pair[1], 1e-12, f"sigma of {name}")


def check_p1411():
    # By hand: at 100 m and 10 GHz the logarithms are 2 and 1.
    for kind, wanted in (("los", 42.4 + 29.2 + 21.1), ("nlos_high_rise", 80 + 10.2 + 23.6),
                         ("nlos_low_rise", 101.2 - 4.68 + 20.2)):
        near(p1411.site_general(10, 100, kind), wanted, 1e-9, kind)
    # By hand: a wavelength of 0.1 m, both antennas 2 m high: breakpoint 160 m, where the lower bound is
    # abs(20 log10(0.01 / (32 pi))) = 80.0454 dB and 160 m of free space 20 log10(4 pi 160 / 0.1) = 86.066 dB.
    lower, median, upper = p1411.los_bounds(2.998, 160, 2, 2)
    near(lower, 80.0454, 1e-3, "lower bound at the breakpoint")
    near(median, 86.066, 0.05, "median at the breakpoint, free space")
    near(upper, 100.0454, 1e-3, "upper bound at the breakpoint")
    near(p1411.los_bounds(2.998, 16, 2, 2)[0], 60.0454, 1e-3, "lower bound a decade before")
    near(p1411.los_bounds(2.998, 16, 2, 2)[2], 75.0454, 1e-3, "upper bound a decade before")
    near(p1411.los_bounds(2.998, 1600, 2, 2)[0], 120.0454, 1e-3, "lower bound a decade after")
    near(p1411.los_bounds(2.998, 160, 3, 3, road_m=1)[0], 80.0454, 1e-3, "antennas over the road")
    near(p1411.los_millimetre(28, 100), 101.0 - 0.056, 1e-3, "28 GHz, 100 m: 88.944 - 28 + 40")
    # Around a corner: 20 dB at 30 m into the other street, continuous at both of its borders, then 60 dB per decade.
    los = p1411.los_millimetre(28, 60)
    for x2, wanted in ((5, 0), (11, 0), (40, 20 / np.log10(31) * np.log10(30)), (41, 20), (41.0001, 20),
                       (140, 20 + 60 * np.log10(2))):
        near(p1411.corner(28, 60, x2, 20, 10, 1.5) - los, wanted, 0.3 if x2 == 41.0001 else 1e-9, f"corner, {x2} m")

    # One turn at 1 GHz by hand: S1 = 3.45e4 * 10^-4.14 = 2.49931, and both powers alike up to 30 m behind the crossing.
    for x2, wanted in ((0, 0), (15, 10 * np.log10((1 + 23.0769 / 6.24655) / 2)), (30, 10 * np.log10(23.0769 / 6.24655)),
                       (100, 16.9897 - 7.9564)):
        los = p1411.los_bounds(1, 100 + x2, 1.6, 1.6)[1]
        near(p1411.one_turn(1, 100, x2, 1.6, 1.6) - los, wanted, 1e-3, f"one turn, {x2} m")


def check_crossings():
    # By hand: both ends 100 m from the crossing, the product of widths 100 m^2, 4 pi / wavelength = 10^2.3932302 per metre.
    loss = virtualsource11p.path_loss
    near(loss(100, 100, 20, 5), 3.75 + 26.9 * (2 * 0.957 - 2 * 0.81 + 2 + 2.3932302), 1e-4, "VirtualSource11p")
    near(loss(100, 100, 20, 5, suburban=True) - loss(100, 100, 20, 5), 2.94, 1e-9, "suburban")
    near(loss(1000, 100, 20, 5) - loss(100, 100, 20, 5), 25.7433, 1e-9, "a decade of the transmitter's distance")
    near(loss(100, 100, 20, 50) - loss(100, 100, 20, 5), -21.789, 1e-9, "a decade of the distance to the wall")
    near(loss(100, 100, 200, 5) - loss(100, 100, 20, 5), -21.789, 1e-9, "a decade of the street's width")
    near(loss(100, 180, 20, 5) - loss(100, 18, 20, 5), 26.9, 1e-9, "a decade before the breakpoint")
    near(loss(100, 1800, 20, 5) - loss(100, 180, 20, 5), 53.8, 1e-9, "a decade beyond")
    near(loss(100, 180.0001, 20, 5) - loss(100, 179.9999, 20, 5), 0, 1e-3, "both branches meet")


def check_corners():
    """Four vehicles in the grid of streets, 100 m apart and 20 m wide: A and B meet at (100, 0), D and B at (100, 100); C
    stands in a crossing, and A and D drive in parallel streets."""
    import crossings
    import streets
    place = np.array([[30, 2, 1.6], [103, 60, 1.6], [3, 4, 1.6], [-50, 98, 1.6]], float)
    found = streets.vehicles_around_corner(place)
    none = np.nan
    for key, wanted in (("end_m", [[none, 70, none, none], [60, none, none, 40], [none] * 4, [none, 150, none, none]]),
                        ("wall_m", [[none, 8, none, none], [13, none, none, 13], [none] * 4, [none, 8, none, none]])):
        assert np.allclose(found[key], wanted, atol=1e-9, equal_nan=True), (key, found[key])
    rows = {"los": np.array([False, True, False]), "d_m": np.array([92.0, 1, 2]),
            **{f"loss_db_{name}": np.array([99.0, 1, 2]) for name in crossings.VARIANTS},
            **{f"{end}_{key}": np.array([found[key][pair], 30, none]) for end, pair in (("first", (0, 1)), ("second", (1, 0)))
               for key in found}}
    both = crossings.both_ways(rows)
    assert [both[key].tolist() for key in ("transmitter_m", "receiver_m", "wall_m", "d_m")] == [
        [70, 60], [60, 70], [8, 13], [92, 92]], both
    bin_ = crossings.beside({**both, "loss_db_with": np.array([99.0, np.inf])}, 0, 65, "with")
    assert (bin_["links"], bin_["heard"], bin_["weak"]) == (1, 1, 0), bin_


def check_edges():
    for nu, wanted in ((0, 6.02060), (1, 13.86411), (2, 19.09096), (2.4, 20.61820), (5, 26.93620)):
        near(p526.single_exact_db(nu), wanted, 1e-5, f"Fresnel integral at {nu}")
        near(p526.single_db(nu), wanted, 0.13, f"approximation at {nu}")
    near(p526.nu_of(10, 1000, 500, 0.3), 10 * np.sqrt(2 / 0.3 * 0.003), 1e-12, "nu")
    # Two edges on the straight line: 1/4 + arcsin(s) / (2 pi), which is 1/3 where the three distances are equal.
    near(p526.double_exact_db(70, 70, 70, 0, 0, 0.05), 20 * np.log10(3), 1e-9, "two edges on the line")
    near(p526.double_exact_db(90, 1e-3, 60, 2, 2, 0.05), p526.single_exact_db(p526.nu_of(2, 90, 60, 0.05)), 0.1,
         "two edges in one place")
    a, b, c, h1, h2, wavelength = 80.0, 50.0, 120.0, 1.5, 1.3, 0.1
    near(p526.double_exact_db(a, b, c, h1, h2, wavelength), by_propagation(a, b, c, h1, h2, wavelength), 0.05,
         "two edges, by propagating the field from plane to plane")
    # Section 4.3 by hand: both losses above 15 dB, and the correction for a = b = c, 10 log10(4 / 3).
    nu = p526.nu_of(5 - 2.5, 100, 100, 0.05)
    near(p526.double_db(100, 100, 100, 5, 5, 0.05), 2 * p526.single_db(nu) + 1.2494, 1e-3, "alike edges")
    near(p526.double_db(100, 20, 200, 5, 4, 0.05), p526.double_db(200, 20, 100, 4, 5, 0.05), 1e-9, "from the other end")


def by_propagation(a, b, c, h1, h2, wavelength):
    """Huygens' principle twice: from the source to the half plane above the first edge, from there to that above the
    second, to the receiver; with windows that fall off smoothly, in place of rotating contours."""
    k = 2 * np.pi / wavelength
    y1 = np.linspace(h1, h1 + 40, 6001)
    y2 = np.linspace(h2, h2 + 40, 6001)
    window = np.clip((40 - (y1 - h1)) / 30, 0, 1)
    window = window * window * (3 - 2 * window)
    first = np.exp(1j * k * y1**2 / (2 * a)) * window
    middle = np.array([np.trapz(first * np.exp(1j * k * (y - y1) ** 2 / (2 * b)), y1) for y in y2])
    last = np.trapz(middle * window * np.exp(1j * k * y2**2 / (2 * c)), y2)
    free = 2j * np.pi / k * np.sqrt(a * b * c / (a + b + c))
    return -20 * np.log10(abs(last / free))


class Made(types.SimpleNamespace):
    def __len__(self):
        return len(self.tx)


def check_figures():
    """Two links and one without a path: two equal paths 100 ns apart from +-30 degrees, and one beside a path 40 dB down."""
    turn = np.radians([30, -30, 90, 10])
    paths = Made(
        tx=np.array([0, 0, 1, 1]), rx=np.array([0, 0, 0, 0]), depth=np.array([0, 1, 1, 2]), aoa_phi_rad=turn, aod_phi_rad=2 * turn,
        delay_s=np.array([1e-6, 1.1e-6, 1e-6, 5e-6]), frequency_hz=5e6,  # half a turn in 100 ns
        a=np.sqrt(np.array([0.5e-8, 0.5e-8, 1e-8, 1e-12]))[:, None, None] * np.ones((1, 1, 1), complex),
        kind=np.array(["line_of_sight", "diffracted", "reflected", "reflected"]))
    found = links.figures(paths, 2, 2)
    near(found["loss_db"][0], 80, 1e-9, "two halves")
    assert found["fading_db"][0] > 150, "opposite fields cancel"
    near(found["ds"][0] * 1e9, 50, 1e-6, "half of 100 ns")
    near(found["asa"][0], np.degrees(np.sqrt(-2 * np.log(np.cos(np.radians(30))))), 1e-9, "TR 38.901, A-1")
    near(found["asd"][0], np.degrees(np.sqrt(-2 * np.log(0.5))), 1e-9, "departure, +-60 degrees")
    near(found["ds"][2], 0, 0, "what is 40 dB down does not spread")
    near(found["asa"][2], 0, 0, "nor turn")
    assert np.isinf(found["loss_db"][1]) and np.isnan(found["ds"][1]), "no path"
    near(links.figures(paths, 2, 2, diffraction=False)["loss_db"][0], 80 + 10 * np.log10(2), 1e-9, "without the edge")
    assert links.line_of_sight(paths, 2, 2).tolist() == [True, False, False, False]


def main():
    check_3gpp()
    check_figures()
    check_p1411()
    check_crossings()
    check_corners()
    check_edges()
    print("all formulas hold")


if __name__ == "__main__":
    main()
