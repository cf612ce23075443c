# SPDX-License-Identifier: Apache-2.0
"""The sionna export against paths.h5: shapes, values, padding, and the channel as Sionna RT's cfr() defines it.
Run as read_sionna.py PROGRAM RUN OUTPUT."""
from reading import OUTPUT, Truth, convert, np

truth = Truth()
numbers = truth.frames["frame"]
assert len(numbers) > 1, "the test wants a run of several frames"
T, R = len(truth.tx), len(truth.rx)


def cfr(arrays, rx, tx, i, j, f):
    """sionna.rt.Paths.cir() then cfr(), normalize_delays = False: carrier phase, then that of a baseband frequency."""
    tau = np.where(arrays["tau"][rx, tx] == -1, 0, arrays["tau"][rx, tx])
    a = arrays["a_real"][rx, i, tx, j] + 1j * arrays["a_imag"][rx, i, tx, j]
    a = a * np.exp(-2j * np.pi * float(arrays["frequency"]) * tau)
    return np.sum(a * np.exp(-2j * np.pi * f * tau))


def check_frame(arrays, number):
    rp, tp = truth.a.shape[1:]
    P = arrays["tau"].shape[-1]
    D = arrays["interactions"].shape[0]
    assert arrays["a_real"].shape == arrays["a_imag"].shape == (R, rp, T, tp, P)
    for name in "tau theta_t phi_t theta_r phi_r doppler valid".split():
        assert arrays[name].shape == (R, T, P), name
    for name in "interactions objects primitives".split():
        assert arrays[name].shape == (D, R, T, P) and arrays[name].dtype == np.uint32, name
    assert arrays["vertices"].shape == (D, R, T, P, 3)
    assert arrays["valid"].dtype == bool and arrays["valid"].sum() == np.sum(truth.paths["frame"] == number)
    unused = ~arrays["valid"]
    assert np.all(arrays["tau"][unused] == -1)
    assert not arrays["a_real"].transpose(0, 2, 4, 1, 3)[unused].any()
    assert np.all(arrays["objects"][:, unused] == 0xFFFFFFFF) and np.all(arrays["primitives"][:, unused] == 0xFFFFFFFF)
    assert not arrays["interactions"][:, unused].any()
    worst = 0
    for rx in range(R):
        for tx in range(T):
            rows = truth.rows(number, tx, rx)
            n = len(rows)
            assert np.array_equal(arrays["valid"][rx, tx], np.arange(P) < n)
            for name, column in (("tau", "delay_s"), ("theta_t", "aod_theta_rad"), ("phi_t", "aod_phi_rad"),
                                 ("theta_r", "aoa_theta_rad"), ("phi_r", "aoa_phi_rad"), ("doppler", "doppler_hz")):
                assert np.array_equal(arrays[name][rx, tx, :n], truth.paths[column][rows]), name
            a = arrays["a_real"][rx, :, tx, :, :n] + 1j * arrays["a_imag"][rx, :, tx, :, :n]
            assert np.array_equal(a, truth.a[rows].transpose(1, 2, 0))
            for k, row in enumerate(rows):
                depth = truth.paths["depth"][row]
                first = int(truth.paths["vertex_offset"][row])
                part = slice(first, first + int(depth))
                assert np.array_equal(arrays["interactions"][:depth, rx, tx, k], truth.vertices["interaction"][part])
                assert not arrays["interactions"][depth:, rx, tx, k].any()
                assert np.array_equal(arrays["primitives"][:depth, rx, tx, k], truth.vertices["surface"][part])
                assert np.array_equal(arrays["vertices"][:depth, rx, tx, k], truth.vertices["position_m"][part])
                names = ["scene" if i == 0xFFFFFFFF else truth.vehicles[i] for i in truth.vertices["instance"][part]]
                assert list(arrays["object_names"][arrays["objects"][:depth, rx, tx, k]]) == names
            for offset in (0.0, 3.7e6):
                for i in range(rp):
                    for j in range(tp):
                        h = truth.h(rows, truth.f + offset, (i, j))
                        scale = np.sum(np.abs(truth.a[rows, i, j])) + 1e-300
                        worst = max(worst, abs(cfr(arrays, rx, tx, i, j, offset) - h) / scale)
    assert worst < 1e-9, worst
    row = list(numbers).index(number)
    assert np.array_equal(arrays["sources"], truth.frames["transmitter_position_m"][row].T, equal_nan=True)
    assert np.array_equal(arrays["targets"], truth.frames["receiver_position_m"][row].T, equal_nan=True)
    asked = np.zeros((R, T), bool)
    here = truth.links["frame"] == number
    asked[truth.links["rx"][here], truth.links["tx"][here]] = True
    assert np.array_equal(arrays["linked"], asked)
    assert list(arrays["tx_names"]) == truth.tx and list(arrays["rx_names"]) == truth.rx
    return worst


# One frame: exactly the shapes of Sionna.
target, _ = convert("sionna", "one.npz", "--frames", str(numbers[-1]))
with np.load(target) as file:
    worst = check_frame(dict(file), numbers[-1])
    assert list(file["frame"]) == [numbers[-1]] and file["frequency"].shape == () and file["frequency"] == truth.f

# All frames: the same arrays with an axis of frames in front.
target, _ = convert("sionna", "all.npz")
shared = {"frequency", "tx_names", "rx_names", "object_names", "frame", "time_s"}
with np.load(target) as file:
    arrays = dict(file)
assert list(arrays["frame"]) == list(numbers) and np.array_equal(arrays["time_s"], truth.frames["time_s"])
for i, number in enumerate(numbers):
    worst = max(worst, check_frame({k: v if k in shared else v[i] for k, v in arrays.items()}, number))
print(f"sionna: {len(truth.paths['tx'])} paths as in paths.h5, cfr within {worst:.1e} of h(f)")
