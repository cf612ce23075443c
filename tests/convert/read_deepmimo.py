# SPDX-License-Identifier: Apache-2.0
"""The deepmimo export loaded by DeepMIMO itself: its arrays and its OFDM channels against paths.h5.
Run as read_deepmimo.py PROGRAM RUN OUTPUT; answers 77, "skipped", where the package is missing."""
import os
import sys

from reading import OUTPUT, Truth, convert, np

try:
    import deepmimo as dm
except ImportError as missing:
    print(f"skipped: {missing} (PyPI: deepmimo)")
    sys.exit(77)

truth = Truth()
numbers = truth.frames["frame"]
T, R = len(truth.tx), len(truth.rx)
CODE = {1: "1", 2: "3", 4: "4", 8: "2"}
dm.config.set("scenarios_folder", OUTPUT)
most = max(len(truth.rows(*link)) for link in truth.used_links())


def per_transmitter(dataset):
    """A scenario of one transmitter is a Dataset, of several a list of them."""
    return list(dataset.datasets) if hasattr(dataset, "datasets") else [dataset]


def expected_rows(number, tx, rx):
    rows = truth.rows(number, tx, rx)
    power = truth.a[:, 0, 0].real ** 2 + truth.a[:, 0, 0].imag ** 2
    order = sorted(rows, key=lambda r: (truth.paths["depth"][r] > 0, -power[r]))
    return np.array(order, dtype=int)


def check_frame(dataset, number):
    row = list(numbers).index(number)
    parts = per_transmitter(dataset)
    assert len(parts) == T
    worst = 0
    for tx, part in enumerate(parts):
        assert np.array_equal(np.ravel(part.tx_pos), truth.frames["transmitter_position_m"][row, tx], equal_nan=True)
        assert np.array_equal(part.rx_pos, truth.frames["receiver_position_m"][row], equal_nan=True)
        assert part.rt_params.frequency == truth.f
        for rx in range(R):
            rows = expected_rows(number, tx, rx)
            n = len(rows)
            assert np.count_nonzero(~np.isnan(part.delay[rx])) == n
            p = truth.paths
            assert np.allclose(part.delay[rx, :n], p["delay_s"][rows], rtol=1e-12)
            assert np.allclose(part.power[rx, :n], 20 * np.log10(np.abs(truth.a[rows, 0, 0])), atol=1e-9)
            for name, column in (("aod_el", "aod_theta_rad"), ("aod_az", "aod_phi_rad"), ("aoa_el", "aoa_theta_rad"),
                                 ("aoa_az", "aoa_phi_rad")):
                assert np.allclose(np.radians(part[name][rx, :n]), p[column][rows], atol=1e-12), name
            for k, r in enumerate(rows):
                first, depth = int(p["vertex_offset"][r]), int(p["depth"][r])
                kinds = truth.vertices["interaction"][first:first + depth]
                assert part.inter[rx, k] == int("".join(CODE[kind] for kind in kinds) or "0")
                assert np.array_equal(part.inter_pos[rx, k, :depth], truth.vertices["position_m"][first:first + depth])
                assert np.isnan(part.inter_pos[rx, k, depth:]).all()
        worst = max(worst, check_channels(part, number, tx))
        check_los(part, number, tx)
    return worst


def check_los(part, number, tx):
    for rx in range(R):
        rows = truth.rows(number, tx, rx)
        los = -1 if len(rows) == 0 else int(np.any(truth.paths["depth"][rows] == 0))
        assert part.los[rx] == los


def check_channels(part, number, tx):
    """Channels of single isotropic antennas: subcarrier k is h(f + k * spacing), normalised by their number."""
    parameters = dm.ChannelParameters()
    parameters.bs_antenna.shape = parameters.ue_antenna.shape = np.array([1, 1])
    parameters.num_paths = most
    parameters.freq_domain = True
    parameters.ofdm.subcarriers, parameters.ofdm.bandwidth = 64, 2e6  # symbols longer than any delay here
    parameters.ofdm.selected_subcarriers = np.array([0, 1, 5])
    parameters.ofdm.rx_filter = 0
    channels = part.compute_channels(parameters)
    worst = 0
    for rx in range(R):
        rows = truth.rows(number, tx, rx)
        if len(rows) == 0:
            continue
        for i, k in enumerate((0, 1, 5)):
            h = truth.h(rows, truth.f + k * 2e6 / 64) / np.sqrt(64)
            scale = np.sum(np.abs(truth.a[rows, 0, 0])) / np.sqrt(64)
            worst = max(worst, abs(channels[rx, 0, 0, i] - h) / scale)
    return worst


convert("deepmimo", "one_frame", "--frames", str(numbers[0]))
worst = check_frame(dm.load("one_frame", max_paths=most), numbers[0])

target, said = convert("deepmimo", "all_frames")
assert "Doppler" in said
drive = dm.load("all_frames", max_paths=most)
assert len(drive.datasets) == len(numbers)
for number, snapshot in zip(numbers, drive.datasets):
    worst = max(worst, check_frame(snapshot, number))
assert worst < 1e-4, worst  # DeepMIMO forms channels in single precision
_, said = convert("deepmimo", "Capitals", code=2)
assert "capitals" in said
print(f"deepmimo {dm.__version__}: {T} transmitters, {R} receivers, {len(numbers)} frames; channels within {worst:.1e} of h(f)")
