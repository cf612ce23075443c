# SPDX-License-Identifier: Apache-2.0
"""Derivatives of paths through the package, against differences of whole simulations. Exits with 77 without numpy."""
import sys

try:
    import numpy as np
except ImportError:
    sys.exit(77)
import wavetracer as wt

PLACE_M, CONCRETE = np.array([40.3, 3.2, 1.7]), {"permittivity": 5.2, "conductivity_s_m": 0.12, "thickness_m": 0.25}


def street(place_m=PLACE_M, yaw_deg=20.0, **concrete):
    return {
        "scene": {"generate": "--seed 1 --blocks 2"}, "radio": {"frequency_hz": 3.5e9},
        "transmitter": [{"name": "mast", "position_m": [-3, -2, 9], "antenna": "tr38901", "polarization": "VH",
                         "orientation_deg": [yaw_deg, 10, 0]}],
        "receiver": [{"name": "phone", "position_m": list(place_m)}, {"name": "other", "position_m": [20, -4, 1.5]}],
        "material": [{"name": "concrete", **(CONCRETE | concrete)}],
        "trace": {"rays": 5000, "max_depth": 2, "diffraction": True, "seed": 3}}


def paths_of(config):
    with wt.Simulation(config) as simulation:
        return simulation.run_frame().paths.select(rx="phone")


def rows_by_key(paths):
    """Rows by the surfaces and edges that a path meets; a path meets each sequence once."""
    ends = paths.vertex_offset.astype(int)
    return {tuple(zip(paths.vertex_surface[a:b], paths.vertex_interaction[a:b])): row
            for row, (a, b) in enumerate(zip(ends, ends[1:]))}


def compared(paths, derivative, axis, step, moved):
    """The number of paths whose differences between moved(step) and moved(-step) were compared with the derivative."""
    chosen = (lambda values: values if axis is None else values[..., axis])
    above, below = paths_of(moved(step)), paths_of(moved(-step))
    rows, more, less = rows_by_key(paths), rows_by_key(above), rows_by_key(below)
    count = 0
    for key in rows.keys() & more.keys() & less.keys():
        row, i, j = rows[key], more[key], less[key]
        if derivative.gap[row]:
            continue
        slope = (above.a[i] - below.a[j]) / (2 * step)
        exact = chosen(derivative.a)[row]
        size = np.abs(exact).max() + 1e-6 * np.abs(paths.a[row]).max()
        assert np.abs(slope - exact).max() < 1e-3 * size, (key, slope, exact)
        delay = (above.delay_s[i] - below.delay_s[j]) / (2 * step)
        assert abs(delay - chosen(derivative.delay_s)[row]) < 1e-14, (key, delay)
        gain = (above.gain_db[i] - below.gain_db[j]) / (2 * step)
        assert abs(gain - chosen(derivative.gain_db)[row]) < 1e-3 * abs(gain) + 1e-5, (key, gain)
        count += 1
    return count


def refused(call, kind, part):
    try:
        call()
    except kind as error:
        assert part in str(error), error
    else:
        raise AssertionError(f"nothing was raised with {part!r}")


simulation = wt.Simulation(street())
frame = simulation.run_frame()
phone = frame.paths.select(rx="phone")
found = phone.gradient(["rx.position", "tx.orientation", "concrete.*"])
assert list(found) == ["rx.position", "tx.orientation", "concrete.permittivity", "concrete.conductivity",
                       "concrete.thickness"], list(found)
assert found["rx.position"].a.shape == (len(phone), 1, 2, 3) and found["concrete.permittivity"].a.shape == phone.a.shape
assert len(phone.select(kind="diffracted")) > 5 and (found["rx.position"].gap == 0).all()

for axis in range(3):
    def moved(step, axis=axis):
        return street(PLACE_M + step * np.eye(3)[axis])
    assert compared(phone, found["rx.position"], axis, 1e-4, moved) > len(phone) / 2
assert compared(phone, found["tx.orientation"], 2, 1e-4, lambda step: street(yaw_deg=20 + np.degrees(step))) > 20
for word, key, step in (("permittivity", "permittivity", 1e-3), ("conductivity", "conductivity_s_m", 1e-4),
                        ("thickness", "thickness_m", 1e-6)):
    assert compared(phone, found[f"concrete.{word}"], None, step,
                    lambda step, key=key: street(**{key: CONCRETE[key] + step})) > 20

# a choice of paths has the rows of all; paths without a wall do not depend on it
direct = phone.select(kind="line_of_sight")
assert len(direct) == 1
again = direct.gradient(["rx.position", "*"])
assert list(again) == ["rx.position"]
np.testing.assert_array_equal(again["rx.position"].a[0], found["rx.position"].a[rows_by_key(phone)[()]])
assert not found["concrete.permittivity"].a[rows_by_key(phone)[()]].any()

refused(lambda: phone.gradient("height"), wt.ConfigError, "there is no parameter 'height'")
refused(lambda: phone.gradient("concret.permittivity"), wt.ConfigError, "no path depends on 'concret.permittivity'")
refused(lambda: phone.gradient([]), wt.ConfigError, "wrt is empty")
refused(lambda: phone.gradient([3]), TypeError, "and not 3")
refused(lambda: found["rx.height"], KeyError, "rx.position")
simulation.close()
refused(phone.gradient, wt.ConfigError, "was closed")
refused(wt.Paths.__reduce__(phone)[0](*wt.Paths.__reduce__(phone)[1]).gradient, wt.ConfigError, "no derivatives")
