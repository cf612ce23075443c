# SPDX-License-Identifier: Apache-2.0
"""Makes range-Doppler cubes, maps, detections and a spectrogram of a radar in a saved run: radar.h5 in its folder, which
`wavetracer plot RUN --what range-doppler,micro-doppler` draws."""
from __future__ import annotations

import argparse
import pathlib
import re
import sys
from collections.abc import Sequence
from typing import Any

import numpy as np

from . import _radar_config, _radar_file, radar
from .errors import ConfigError, Error
from .paths import KINDS, Paths
from .runs import Run, SavedFrame


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python3 -m wavetracer.radar", description=__doc__)
    parser.add_argument("run", type=pathlib.Path, metavar="RUN", help="folder of `wavetracer run`")
    parser.add_argument("-o", "--output", type=pathlib.Path, metavar="FILE",
                        help="radar.h5 in RUN if not given; one that the run itself wrote is only replaced if FILE names it")
    parser.add_argument("--tx", help="name of the radar's transmitter, where there are several")
    parser.add_argument("--rx", help="name of its receiver, where there are several")
    parser.add_argument("--radar", metavar="NAME", help="take what is not given from this [[radar]] of the run; the only one "
                        "if not given. A run without any has the defaults below")
    parser.add_argument("--bandwidth", type=float, metavar="HZ", help="of a chirp; default: 1e9")
    parser.add_argument("--chirp", type=float, metavar="S", help="duration of a chirp; default: 2e-5")
    parser.add_argument("--interval", type=float, metavar="S", help="from a chirp to the next; default: that of a chirp")
    parser.add_argument("--chirps", type=int, help="chirps of a frame; default: 128")
    parser.add_argument("--samples", type=int, help="samples of a chirp; default: 256")
    parser.add_argument("--power", type=float, metavar="DBM", help="that is sent; default: 10")
    parser.add_argument("--noise-figure", type=float, metavar="DB", help="of the receiver; no noise if not given")
    parser.add_argument("--seed", type=int, help="of the noise of the first frame; default: 0")
    parser.add_argument("--turns", action="store_true", default=None, help="transmitting antennas send in turns")
    parser.add_argument("--window", help="hann, hamming, blackman or none; default: hann")
    parser.add_argument("--false-alarm", type=float, metavar="P",
                        help="probability of a false detection in a cell of noise; default: 1e-6")
    parser.add_argument("--no-direct", action="store_true", default=None,
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


def _settings(run: Run, options: argparse.Namespace) -> dict[str, Any]:
    """The options, or else what the [[radar]] of the run says, or else the defaults."""
    table = _radar_config.chosen(run.config, options.radar)
    wave = vars(radar.waveform_of(run.config, options.radar)) if table is not None else vars(radar.Waveform(1e9, 20e-6))
    given = {"bandwidth_hz": options.bandwidth, "chirp_s": options.chirp, "interval_s": options.interval,
             "chirps": options.chirps, "samples": options.samples, "power_dbm": options.power,
             "noise_figure_db": options.noise_figure, "seed": options.seed, "turns": options.turns}
    table = table or {}
    return {"wave": wave | {key: value for key, value in given.items() if value is not None},
            "windows": [options.window or table.get(key, "hann") for key in ("range_window", "doppler_window")],
            "false_alarm": table.get("false_alarm", 1e-6) if options.false_alarm is None else options.false_alarm,
            "no_direct": not table.get("direct", True) if options.no_direct is None else options.no_direct,
            "around": {"guard": table.get("guard", 2), "training": table.get("training", 6)},
            "name": table.get("name", "radar"), "tx": options.tx or _one_name(table, "transmitter", run.transmitters),
            "rx": options.rx or _one_name(table, "receiver", run.receivers)}


def _one_name(table: dict[str, Any], key: str, names: Sequence[str]) -> str | None:
    """The end that a [[radar]] names, if it is one."""
    # As in the program, only * and ? are special.
    parts = ({"*": ".*", "?": "."}.get(letter) or re.escape(letter) for letter in table.get(key, "*"))
    pattern = re.compile("".join(parts), re.DOTALL)
    found = [name for name in names if pattern.fullmatch(name)]
    return found[0] if len(found) == 1 else None


def _output(options: argparse.Namespace) -> pathlib.Path:
    if options.output is not None:
        return pathlib.Path(options.output)
    file = pathlib.Path(options.run) / "radar.h5"
    if _radar_file.of_run(file):
        raise ConfigError(f"{file} is what the run wrote for its [[radar]], which would be lost: give -o with another file, or "
                          f"-o {file} to replace it")
    return file


def main(arguments: Sequence[str] | None = None) -> int:
    options = _parser().parse_args(arguments)
    try:
        with Run(options.run) as run:
            file = _output(options)
            frames, cubes, signals, heard = _chosen(run, options.frames), [], [], []
            settings = _settings(run, options)
            for i, frame in enumerate(frames):
                wave = radar.Waveform(**settings["wave"] | {"seed": settings["wave"]["seed"] + i})
                kinds = [kind for kind in KINDS if kind != "line_of_sight"] if settings["no_direct"] else None
                # Saved runs have paths between the centres of arrays, which are one antenna each here.
                paths = Paths(frame.__getitem__, run._ends, links=frame.links).select(tx=settings["tx"], rx=settings["rx"], kind=kinds)
                heard.append((frame.time_s, paths))
                signals.append(radar.beat(paths, wave))
                cubes.append(radar.cube_of(signals[-1], wave, run.frequency_hz, *settings["windows"]))
                cubes[-1].left_out = int((paths.delay_s >= wave.longest_delay_s).sum())
            # Each frame gives one spectrum: the spectrogram of a drive has the times of its frames.
            spectra = [radar.spectrogram(signal, wave, wave.chirps, wave.chirps) for signal in signals]
            times = [frame.time_s for frame in frames]
            if options.osi:
                radar.write_osi(options.osi, heard)
            spectrogram = (np.array(times), spectra[0][1], np.concatenate([power for _, _, power in spectra]))
            ends = (run.transmitters.index(paths.transmitters[0]), run.receivers.index(paths.receivers[0]))
        radar.save(file, cubes, [frame.number for frame in frames], times, spectrogram, settings["false_alarm"],
                   settings["name"], ends, **settings["around"])
    except Error as error:
        print(f"wavetracer: {error}", file=sys.stderr)
        return error.code
    left_out = sum(cube.left_out for cube in cubes)
    found = sum(len(cube.detections(settings["false_alarm"], **settings["around"])["range_m"]) for cube in cubes)
    if re.search(r"^\[\[array\]\]", run.config, re.M):
        print("wavetracer: warning: the run has arrays, and its paths are those between their centres: each end has one "
              "antenna here; a [[radar]] of the configuration has all", file=sys.stderr)
    print(f"{file}: {len(cubes)} frames{' without direct paths' if settings['no_direct'] else ''}, {found} detections"
          + (f"; {left_out} paths are later than {wave.longest_delay_s:g} s and left out" if left_out else ""))
    return 0
