#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""All experiments of `wavetracer thesis`, spread over the GPUs of one machine.

Usage: thesis_gpus.py WAVETRACER FOLDER GPUS [OPTION...]

Each process sees one GPU (CUDA_VISIBLE_DEVICES) and measures one group of experiments at a time; the longest groups
begin. A group has the experiments that share a measurement. FOLDER, which must not exist, gets a folder with thesis.md,
thesis.html and log.txt for each group. OPTIONs are those of `wavetracer thesis`. The seconds of each group are printed.
The exit code is 1 if a group has failed. Afterwards verdicts.py FOLDER/*/thesis.md puts the verdicts of all groups
together.
"""
import os
import pathlib
import queue
import subprocess
import sys
import threading
import time

# Longest first. Two have experiments that share nothing, because a page of verdicts takes two experiments.
GROUPS = (
    ("figure-6.1", "figure-6.13"),
    ("figure-6.18", "figure-6.10"),
    ("figure-6.16", "figure-6.17"),
    ("figure-6.11", "figure-6.12"),
    ("figure-6.14", "figure-6.15"),
    ("cache-division", "cache-step"),
    ("innerframe", "innerframe-ordered"),
    ("figure-6.5", "figure-6.8", "figure-6.9"),
    ("figure-6.6", "figure-6.7"),
    ("figure-6.2", "figure-6.3", "figure-6.4"),
)


def measure(program, folder, gpu, names, options):
    """Runs one group; returns its exit code. Its command has no folder of this machine, since pages quote it."""
    place = folder / names[0]
    place.mkdir()
    with open(place / "log.txt", "w", encoding="utf-8") as log:
        return subprocess.run(["wavetracer", "thesis", *names, "-o", names[0], *options], executable=program, cwd=folder, stdout=log,
                              stderr=log, env=os.environ | {"CUDA_VISIBLE_DEVICES": str(gpu)}, check=False).returncode


def work(gpu, waiting, codes, *, program, folder, options):
    """Measures groups on one GPU until none is left."""
    while True:
        try:
            names = waiting.get_nowait()
        except queue.Empty:
            return
        start = time.monotonic()
        codes[names] = measure(program, folder, gpu, names, options)
        print(f"{time.monotonic() - start:6.1f} s on GPU {gpu}, exit code {codes[names]}: {' '.join(names)}", flush=True)


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    program, folder, gpus = str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(sys.argv[2]), int(sys.argv[3])
    folder.mkdir(parents=True)
    waiting, codes = queue.SimpleQueue(), {}
    for names in GROUPS:
        waiting.put(names)
    threads = [threading.Thread(target=work, args=(gpu, waiting, codes), kwargs={"program": program, "folder": folder, "options": sys.argv[4:]})
               for gpu in range(gpus)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    sys.exit(int(any(codes.values()) or len(codes) < len(GROUPS)))


if __name__ == "__main__":
    main()
