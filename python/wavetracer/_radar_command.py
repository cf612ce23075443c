# SPDX-License-Identifier: Apache-2.0
"""Makes range-Doppler cubes, maps, detections and a spectrogram of a radar in a saved run: radar.h5 in its folder, which
`wavetracer plot RUN --what range-doppler,micro-doppler` draws."""
from __future__ import annotations

import argparse
import pathlib
import sys
from collections.abc import Sequence

import numpy as np

from . import radar
from .errors import ConfigError, Error
from .paths import KINDS
from .runs import Run, SavedFrame


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python3 -m wavetracer.radar", description=__doc__)
    parser.add_argument("run", type=pathlib.Path, metavar="RUN", help="folder of `wavetracer run`")
    parser.add_argument("-o", "--output", type=pathlib.Path, metavar="FILE", help="radar.h5 in RUN if not given")
    parser.add_argument("--tx", help="name of the radar's transmitter, where there are several")
    parser.add_argument("--rx", help="name of its receiver, where there are several")
    parser.add_argument("--bandwidth", type=float, default=1e9, metavar="HZ", help="of a chirp; default: %(default)g")
    parser.add_argument("--chirp", type=float, default=20e-6, metavar="S", help="duration of a chirp; default: %(default)g")
    parser.add_argument("--interval", type=float, metavar="S", help="from a chirp to the next; default: that of a chirp")
    parser.add_argument("--chirps", type=int, default=128, help="chirps of a frame; default: %(default)s")
    parser.add_argument("--samples", type=int, default=256, help="samples of a chirp; default: %(default)s")
    parser.add_argument("--power", type=float, default=10.0, metavar="DBM", help="that is sent; default: %(default)g")
    parser.add_argument("--noise-figure", type=float, metavar="DB", help="of the receiver; no noise if not given")
    parser.add_argument("--seed", type=int, default=0, help="of the noise of the first frame; default: %(default)s")
    parser.add_argument("--turns", action="store_true", help="transmitting antennas send in turns")
    parser.add_argument("--window", default="hann", help="hann, hamming, blackman or none; default: %(default)s")
    parser.add_argument("--false-alarm", type=float, default=1e-6, metavar="P",
                        help="probability of a false detection in a cell of noise; default: %(default)g")
    parser.add_argument("--no-direct", action="store_true",
                        help="leave out the direct path from the transmitter to the receiver, as a radar's filter would")
    parser.add_argument("--osi", type=pathlib.Path, metavar="FILE",
                        help="also write the paths as reflections of OSI's RadarSensorView, with angles in the scene's axes")
    parser.add_argument("--frames", metavar="A:B", help="only frames with numbers from A to B")
    return parser


def _chosen(run: Run, asked: str | None) -> list[SavedFrame]:
    if asked is None:
        return list(run)
    try:
        first, last = (int(part) for part in asked.split(":"))
    except ValueError:
        raise ConfigError(f"--frames {asked}: give two numbers of frames, such as 0:9") from None
    frames = [frame for frame in run if first <= frame.number <= last]
    if not frames:
        raise ConfigError(f"--frames {asked}: the run has frames {run[0].number} to {run[-1].number}")
    return frames


def main(arguments: Sequence[str] | None = None) -> int:
    options = _parser().parse_args(arguments)
    try:
        with Run(options.run) as run:
            frames, cubes, signals, heard = _chosen(run, options.frames), [], [], []
            for i, frame in enumerate(frames):
                wave = radar.Waveform(options.bandwidth, options.chirp, options.chirps, options.samples, options.interval,
                                      options.power, options.noise_figure, options.seed + i, options.turns)
                kinds = [kind for kind in KINDS if kind != "line_of_sight"] if options.no_direct else None
                paths = frame.paths.select(tx=options.tx, rx=options.rx, kind=kinds)
                heard.append((frame.time_s, paths))
                signals.append(radar.beat(paths, wave))
                cubes.append(radar.cube_of(signals[-1], wave, run.frequency_hz, options.window, options.window))
                cubes[-1].left_out = int((paths.delay_s >= wave.longest_delay_s).sum())
            # Each frame gives one spectrum: the spectrogram of a drive has the times of its frames.
            spectra = [radar.spectrogram(signal, wave, wave.chirps, wave.chirps) for signal in signals]
            times = [frame.time_s for frame in frames]
            if options.osi:
                radar.write_osi(options.osi, heard)
            spectrogram = (np.array(times), spectra[0][1], np.concatenate([power for _, _, power in spectra]))
        file = options.output or options.run / "radar.h5"
        radar.save(file, cubes, [frame.number for frame in frames], times, spectrogram, options.false_alarm)
    except Error as error:
        print(f"wavetracer: {error}", file=sys.stderr)
        return error.code
    left_out = sum(cube.left_out for cube in cubes)
    print(f"{file}: {len(cubes)} frames{' without direct paths' if options.no_direct else ''}, {sum(len(cube.detections(options.false_alarm)['range_m']) for cube in cubes)} "
          f"detections" + (f"; {left_out} paths are later than {wave.longest_delay_s:g} s and left out" if left_out else ""))
    return 0
