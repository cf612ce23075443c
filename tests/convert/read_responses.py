# SPDX-License-Identifier: Apache-2.0
"""Responses of a run in every export that has them, and against the channel that paths.h5 makes of the centres.
Run as read_responses.py PROGRAM RUN OUTPUT, RUN of configs/arrays.toml; answers 77, "skipped", without h5py."""
import os

import h5py

from reading import OUTPUT, RUN, Truth, convert, np

truth = Truth()
with h5py.File(os.path.join(RUN, "responses.h5"), "r") as file:
    links = {name: data[...] for name, data in file["links"].items()}
    f, t = file["frequencies/frequency_hz"][...], file["times/time_s"][...]
    ends = {name: {key: data[...] for key, data in file[name].items()} for name in ("transmitters", "receivers")}
    h = file["responses/h_re"][...] + 1j * file["responses/h_im"][...]
    beams = None
    antennas = {name: end["ports"] * np.diff(end["first_element"].astype(int)) for name, end in ends.items()}
with h5py.File(os.path.join(RUN, "beams.h5"), "r") as file:
    beams = {name: data[...] for name, data in file["beams"].items()}
assert len(f) == 64 and len(t) == 7 and h.shape[1] == 64
assert f[32] == truth.f and np.allclose(np.diff(f), 20e6 / 64)
assert np.array_equal(links["frame"], truth.links["frame"]) and np.array_equal(links["rx"], truth.links["rx"])
first = links["row_offset"].astype(int)


def of_link(i):
    """(time, rx antenna, tx antenna, frequency)"""
    shape = len(t), antennas["receivers"][links["rx"][i]], antennas["transmitters"][links["tx"][i]], len(f)
    return h[first[i]:first[i + 1]].reshape(shape)


def check_power():
    """Over all antennas the powers of paths add up to what the centres have: a mean over the band and 128 x 2 antennas."""
    compared = 0
    for i, (number, tx, rx) in enumerate(zip(links["frame"], links["tx"], links["rx"])):
        rows = truth.rows(number, tx, rx)
        if len(rows) == 0:
            assert np.all(of_link(i) == 0)
            continue
        compared += 1
        p = np.abs(of_link(i)[0]) ** 2
        power = np.sum(np.abs(truth.a[rows]) ** 2) * p.shape[0] * p.shape[1] / truth.a.shape[1] / truth.a.shape[2]
        assert abs(10 * np.log10(p.mean(axis=-1).sum() / power)) < 3
    assert compared >= 3


def check_beams():
    """No pair of beams has more than all elements together; the best beam of a panel has most of it."""
    for number, tx, rx in truth.used_links():
        here = (beams["frame"] == number) & (beams["tx"] == tx) & (beams["rx"] == rx)
        assert np.count_nonzero(here) == 64
        rows = truth.rows(number, tx, rx)
        power_db = 10 * np.log10(np.sum(np.abs(truth.a[rows]) ** 2))
        best = beams["gain_db"][here].max()
        assert power_db < best <= power_db + 10 * np.log10(64) + 1


def check_sionna():
    target, _ = convert("sionna", "run.npz")
    with np.load(target) as file:
        got = file["h_real"] + 1j * file["h_imag"]
        assert np.array_equal(file["h_frequency_hz"], f) and np.array_equal(file["h_time_s"], t)
    assert got.shape == (len(truth.frames["frame"]), len(truth.rx), 2, len(truth.tx), 128, 7, 64)
    for i, (number, tx, rx) in enumerate(zip(links["frame"], links["tx"], links["rx"])):
        frame = list(truth.frames["frame"]).index(number)
        assert np.array_equal(got[frame, rx, :, tx].transpose(2, 0, 1, 3), of_link(i))


def check_matlab():
    target, _ = convert("matlab", "run.mat")
    with h5py.File(target) as file:
        part = file["run/responses"]
        values = part["h"][...]
        got = values["real"] + 1j * values["imag"]
        assert np.array_equal(got.T, h)
        assert np.array_equal(part["first_response"][0] - 1, first)
        assert np.array_equal(part["tx_antennas"][0], antennas["transmitters"][links["tx"]])
        assert np.array_equal(part["frequency_hz"][0], f)


def check_deepmimo():
    target, said = convert("deepmimo", "run_deepmimo")
    assert "channel_*.npz" in said, said
    for i, (number, tx, rx) in enumerate(zip(links["frame"], links["tx"], links["rx"])):
        folder = os.path.join(target, f"frame_{number}")
        parts = [np.load(os.path.join(folder, f"channel_{part}_t000_tx{tx:03}_r001.npz"))[f"channel_{part}"]
                 for part in ("re", "im")]
        assert parts[0].shape == (len(truth.rx), 2, 128, 64, 7)
        assert np.array_equal((parts[0] + 1j * parts[1])[rx].transpose(3, 0, 1, 2), of_link(i))


for check in (check_power, check_beams, check_sionna, check_matlab, check_deepmimo):
    check()
    print(check.__name__, "ok")
