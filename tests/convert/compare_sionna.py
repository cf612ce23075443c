# SPDX-License-Identifier: Apache-2.0
"""The same ends in the same scene, traced by Sionna RT and exported from wavetracer: same shapes, same conventions.
Run as compare_sionna.py PROGRAM OUTPUT; answers 77, "skipped", where sionna-rt or its LLVM is missing."""
import os
import subprocess
import sys

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "python"))
import needs_sionna  # noqa: F401, E402
import numpy as np  # noqa: E402
import sionna.rt as rt  # noqa: E402

PROGRAM, OUTPUT = sys.argv[1:3]
os.makedirs(OUTPUT, exist_ok=True)
F = 5.9e9
TX, RX, SPEED = (-2.0, 1.0, 2.5), [(2.5, -1.5, 1.0), (1.0, 2.0, 3.0)], [(3.0, -1.0, 0.5), (0.0, 2.0, 0.0)]

scene = rt.load_scene(rt.scene.box)
scene.frequency = F
scene.tx_array = scene.rx_array = rt.PlanarArray(num_rows=1, num_cols=1, pattern="iso", polarization="VH")
scene.add(rt.Transmitter("tx", TX))
for i, (position, velocity) in enumerate(zip(RX, SPEED)):
    scene.add(rt.Receiver(f"rx{i}", position, velocity=velocity))
theirs = rt.PathSolver()(scene, max_depth=2, samples_per_src=10**6, refraction=False, synthetic_array=True)

config = f"""scene.file = "{os.path.join(os.path.dirname(rt.scene.box), 'box.xml')}"
radio.frequency_hz = {F}
trace.max_depth = 2
trace.rays = 100000
[[transmitter]]
name = "tx"
position_m = {list(TX)}
polarization = "VH"
"""
for i, (position, velocity) in enumerate(zip(RX, SPEED)):
    config += f'[[receiver]]\nname = "rx{i}"\nposition_m = {list(position)}\nvelocity_m_s = {list(velocity)}\npolarization = "VH"\n'
with open(os.path.join(OUTPUT, "box.toml"), "w") as file:
    file.write(config)
subprocess.run([PROGRAM, "run", "-c", os.path.join(OUTPUT, "box.toml"), "-o", os.path.join(OUTPUT, "run")], check=True,
               capture_output=True)
npz = os.path.join(OUTPUT, "box.npz")
subprocess.run([PROGRAM, "convert", os.path.join(OUTPUT, "run"), "-o", npz], check=True, capture_output=True)
with np.load(npz) as file:
    ours = dict(file)

# Shapes must agree, except for the number of paths and the largest depth.
a = [part.numpy() for part in theirs.a]
assert a[0].shape[:4] == ours["a_real"].shape[:4] == (2, 2, 1, 2)
for name in "tau theta_t phi_t theta_r phi_r doppler valid".split():
    assert getattr(theirs, name).numpy().ndim == ours[name].ndim == 3, name
for name in "interactions objects primitives vertices".split():
    assert getattr(theirs, name).numpy().ndim == ours[name].ndim, name
    assert getattr(theirs, name).numpy().shape[1:3] == ours[name].shape[1:3], name
assert np.allclose(theirs.sources.numpy(), ours["sources"], atol=1e-6)
assert np.allclose(theirs.targets.numpy(), ours["targets"], atol=1e-6)

tau, valid = theirs.tau.numpy(), theirs.valid.numpy()
pairs = 0
for rx in range(2):
    mine = np.flatnonzero(ours["valid"][rx, 0])
    yours = np.flatnonzero(valid[rx, 0])
    assert len(mine) == len(yours) > 5, (len(mine), len(yours))
    for k in mine:
        # The path has the same points of the same kinds; two may have one length in a box.
        kinds = ours["interactions"][:, rx, 0, k]
        depth = np.count_nonzero(kinds)
        points = ours["vertices"][:depth, rx, 0, k]
        same = [q for q in yours if np.count_nonzero(theirs.interactions.numpy()[:, rx, 0, q]) == depth
                and np.allclose(theirs.vertices.numpy()[:depth, rx, 0, q], points, atol=1e-3)]
        assert len(same) == 1, (rx, k, same)
        q = same[0]
        assert np.array_equal(theirs.interactions.numpy()[:depth, rx, 0, q], kinds[:depth])
        assert abs(tau[rx, 0, q] - ours["tau"][rx, 0, k]) < 1e-6 * tau[rx, 0, q]
        assert abs(theirs.doppler.numpy()[rx, 0, q] - ours["doppler"][rx, 0, k]) < 1e-3 * F * 3.3 / 3e8
        for name in ("theta_t", "phi_t", "theta_r", "phi_r"):
            turn = getattr(theirs, name).numpy()[rx, 0, q] - ours[name][rx, 0, k]
            assert abs(np.exp(1j * turn) - 1) < 1e-3, name
        z = (a[0] + 1j * a[1])[rx, :, 0, :, q]
        own = (ours["a_real"] + 1j * ours["a_imag"])[rx, :, 0, :, k]
        assert np.max(np.abs(z - own)) < 2e-3 * np.max(np.abs(own)), (rx, k, z, own)
        pairs += 1

# Their channel must equal the sum that is ours, port by port.
f = np.array([0.0, 1.7e6])
h = theirs.cfr(frequencies=f, normalize_delays=False, out_type="numpy")[:, :, :, :, 0]
t = np.where(ours["tau"] < 0, 0, ours["tau"])[:, None, :, None]
b = (ours["a_real"] + 1j * ours["a_imag"]) * np.exp(-2j * np.pi * F * t)
worst = 0
for i, offset in enumerate(f):
    own = np.sum(b * np.exp(-2j * np.pi * offset * t), axis=-1)
    worst = max(worst, np.max(np.abs(h[..., i] - own)) / np.max(np.abs(own)))
assert worst < 2e-2, worst  # single precision there: some milliradians of carrier phase
print(f"sionna-rt {rt.__version__}: {pairs} paths alike, channels within {worst:.1e}")
