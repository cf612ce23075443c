#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""wavetracer.from_sionna: scenes of Sionna RT, solved by both, give the same channels in the same arrays.

Usage: sionna_test.py. Exits with 77, "skipped", where sionna-rt, its LLVM or h5py is missing.
"""
import os
import pathlib
import re
import sys
import tempfile
import warnings

import needs_sionna  # noqa: F401
import numpy as np
import sionna.rt as rt
import wavetracer as wt


def canyon(tx, rx, frequency_hz=3.5e9):
    scene = rt.load_scene(rt.scene.simple_street_canyon)
    scene.frequency = frequency_hz
    one = {"num_rows": 1, "num_cols": 1}
    scene.tx_array, scene.rx_array = rt.PlanarArray(**one, **tx), rt.PlanarArray(**one, **rx)
    scene.add(rt.Transmitter("tx", position=[-32, 10, 32], orientation=[0.3, 0.5, 0.1], velocity=[3, -20, 1]))
    scene.add(rt.Receiver("a", position=[22, -3, 1.5], orientation=[-2.5, 0.2, -0.4]))
    scene.add(rt.Receiver("b", position=[40, 5, 1.5], velocity=[-10, 2, 0]))
    return scene


def close(ours, theirs, share):
    """Theirs is in float32: the phases of long ways, and ways near a border, have few digits."""
    assert ours.shape == theirs.shape, (ours.shape, theirs.shape)
    worst = np.abs(ours - theirs).max() / np.abs(theirs).max()
    assert worst < share, worst
    return worst


def compare(tx, rx, order=slice(None)):
    """order: of our ports, where both count them differently."""
    scene = canyon(tx, rx)
    theirs = rt.PathSolver()(scene, max_depth=3, refraction=False, samples_per_src=10**5)
    simulation = wt.from_sionna(scene, trace={"max_depth": 3, "rays": 100_000})
    assert simulation.transmitters == ["tx"] and simulation.receivers == ["a", "b"] and simulation.frequency_hz == 3.5e9
    ours = simulation.run_frame().paths
    time_s, frequencies = np.arange(3) / 1000, np.linspace(-10e6, 10e6, 32)
    a, tau = ours.cir(time_s)
    their_a, their_tau = theirs.cir(sampling_frequency=1000, num_time_steps=3, out_type="numpy")
    assert a.shape == their_a.shape and tau.shape == their_tau.shape, (a.shape, their_a.shape)
    for r in range(2):
        np.testing.assert_allclose(np.sort(their_tau[r, 0])[::-1], np.sort(tau[r, 0])[::-1], atol=1e-12, rtol=1e-4)
    worst = close(ours.cfr(frequencies, time_s)[:, order],
                  theirs.cfr(frequencies, sampling_frequency=1000, num_time_steps=3, out_type="numpy"), 0.01)
    close(ours.taps(50e6, 21, first=-5, time_s=time_s / 2)[:, order],
          theirs.taps(50e6, -5, 15, sampling_frequency=2000, num_time_steps=3, out_type="numpy"), 0.01)
    close(ours.cfr(frequencies, normalize=True, reverse_direction=True)[:, :, :, order],
          theirs.cfr(frequencies, normalize=True, reverse_direction=True, out_type="numpy"), 0.01)
    print(f"{tx['pattern']} {tx['polarization']} to {rx['pattern']} {rx['polarization']}: {len(ours)} paths, the response "
          f"differs by {worst:.1e} of its largest value")


def compare_arrays():
    """Panels, with Sionna RT's synthetic arrays, which are plane waves; and a small one with a ray for each element."""
    two = {"pattern": "iso", "polarization": "VH"}
    scene = canyon(two, two)
    for shape, wavefront in (((2, 3), "plane"), ((1, 2), "spherical")):
        scene.tx_array = rt.PlanarArray(num_rows=shape[0], num_cols=shape[1], vertical_spacing=0.7, **two)
        scene.rx_array = rt.PlanarArray(num_rows=3, num_cols=1, vertical_spacing=2.0, pattern="iso", polarization="H")
        theirs = rt.PathSolver()(scene, max_depth=2, refraction=False, samples_per_src=10**5,
                                 synthetic_array=wavefront == "plane")
        simulation = wt.from_sionna(scene, trace={"max_depth": 2, "rays": 100_000}, radio={"wavefront": wavefront})
        ours = simulation.run_frame().paths
        # Delays are absolute: theirs begin at the first of all pairs of antennas, ours at that of the centres.
        h = ours.cfr([0.0, 1e6], normalize_delays=False)
        assert h.shape == (2, 3, 1, 2 * shape[0] * shape[1], 1, 2)
        worst = close(h, theirs.cfr([0.0, 1e6], normalize_delays=False, out_type="numpy"), 0.01)
        print(f"arrays of {h.shape[1]} x {h.shape[3]} antennas, {wavefront}: differs by {worst:.1e} of the largest value")


def run_document():
    """The two scripts of docs/from-sionna.md give the same channels."""
    root = pathlib.Path(__file__).resolve().parents[2]
    scripts = re.findall(r"^```python\n(.*?)^```$", (root / "docs/from-sionna.md").read_text(), re.M | re.S)
    os.chdir(root)  # readers have configs/ there
    theirs, ours = ({}, {})
    for script, names in zip(scripts, (theirs, ours), strict=True):
        exec(compile(script, "docs/from-sionna.md", "exec"), names)
    assert np.count_nonzero(ours["tau"] >= 0) > 3
    worst = [close(ours[name], theirs[name], 0.01) for name in ("h", "taps")]
    print(f"the scripts of docs/from-sionna.md: {ours['paths']}, responses differ by {max(worst):.1e}")


def raises(part, scene):
    try:
        wt.from_sionna(scene)
    except wt.ConfigError as error:
        assert part in str(error), error
    else:
        raise AssertionError(f"no error with {part}")


def check_scenes():
    """Tests the properties beside antennas that are carried over, and those that cannot be."""
    antenna = {"pattern": "iso", "polarization": "V"}
    scene = canyon(antenna, antenna)
    building = next(iter(scene.objects.values()))
    building.radio_material = rt.RadioMaterial("mine", relative_permittivity=3.0, conductivity=0.25, thickness=0.3,
                                               scattering_coefficient=0.4, xpd_coefficient=0.1,
                                               scattering_pattern="directive", alpha_r=6)
    building.velocity = [1, 0, 0]
    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        simulation = wt.from_sionna(scene, folder=folder)
        assert [str(each.message).split(" has")[0] for each in told] == [f"object {building.name}"], told
        again = wt.Simulation(folder + "/wavetracer.toml")  # what was kept is a configuration of its own
        assert again.receivers == simulation.receivers
        text = again.config
    for line in ('name = "mine"', "permittivity = 3.0", "conductivity_s_m = 0.25", "thickness_m = 0.3", "scattering = 0.4",
                 "scattering_lobe = 6", "scattering_cross_polar = 0.1"):
        assert line in text or f"{line}0000" in text, (line, text[:3000])
    scene.rx_array = rt.PlanarArray(num_rows=1, num_cols=1, polarization_model="tr38901_1",
                                    **(antenna | {"polarization": "cross"}))
    raises("scene.rx_array has a pattern or polarisation", scene)
    for name in ("a", "b"):
        scene.remove(name)
    raises("the scene has no receiver", scene)
    scene = rt.load_scene(rt.scene.box)
    scene.tx_array = rt.PlanarArray(num_rows=1, num_cols=1, **antenna)
    scene.add(rt.Transmitter("tx", position=[0, 0, 2]))
    scene.add(rt.Receiver("rx", position=[1, 0, 2]))
    raises("scene.rx_array is not set", scene)


compare({"pattern": "iso", "polarization": "V"}, {"pattern": "iso", "polarization": "VH"})
compare({"pattern": "tr38901", "polarization": "H"}, {"pattern": "dipole", "polarization": "V"})
# Sionna RT counts -45 degrees first, and we +45.
compare({"pattern": "hw_dipole", "polarization": "V"}, {"pattern": "iso", "polarization": "cross"}, slice(None, None, -1))
compare_arrays()
check_scenes()
run_document()
