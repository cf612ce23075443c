#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Gathers what a release has: the wheel, the Debian package, the source archive, and SHA256SUMS of the three.

usage: make_release.py FOLDER WHEEL PACKAGE [--commit COMMIT]

FOLDER is emptied of older files of this kind. The archive is that of COMMIT (HEAD if not given) and has the same bytes
wherever it is made. All three must have the version of CMakeLists.txt there, else nothing is written. Needs git and
dpkg-deb.
"""
import argparse
import gzip
import hashlib
import pathlib
import re
import shutil
import subprocess
import sys
import zipfile

root = pathlib.Path(__file__).resolve().parent.parent


def output(*command):
    """The bytes that a command prints."""
    done = subprocess.run(list(map(str, command)), capture_output=True, cwd=root)
    if done.returncode:
        sys.exit(f"make_release: {' '.join(map(str, command))}: {done.stderr.decode().strip()}")
    return done.stdout


def version_of_wheel(wheel):
    with zipfile.ZipFile(wheel) as archive:
        name = next(name for name in archive.namelist() if name.endswith(".dist-info/METADATA"))
        return re.search(r"^Version: (\S+)", archive.read(name).decode(), re.M)[1]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("wheel", type=pathlib.Path)
    parser.add_argument("package", type=pathlib.Path)
    parser.add_argument("--commit", default="HEAD")
    options = parser.parse_args()
    made_by = output("git", "show", f"{options.commit}:CMakeLists.txt").decode()
    version = re.search(r"^project\(wavetracer VERSION ([0-9.]+)", made_by, re.M)[1]
    told = {options.wheel: version_of_wheel(options.wheel),
            options.package: output("dpkg-deb", "-f", options.package.resolve(), "Version").decode().strip()}
    wrong = [f"{file} has version {other}" for file, other in told.items() if other != version]
    if wrong:
        sys.exit(f"make_release: {'; '.join(wrong)}, and CMakeLists.txt of {options.commit} has {version}: build them anew")
    tar = output("git", "-c", "tar.umask=0022", "archive", "--format=tar", f"--prefix=wavetracer-{version}/", options.commit)
    options.folder.mkdir(parents=True, exist_ok=True)
    for pattern in ("wavetracer-*.whl", "wavetracer_*.deb", "wavetracer-*.tar.gz", "SHA256SUMS"):
        for old in options.folder.glob(pattern):
            old.unlink()
    source = options.folder / f"wavetracer-{version}.tar.gz"
    source.write_bytes(gzip.compress(tar, 9, mtime=0))
    files = [source, *(pathlib.Path(shutil.copyfile(file, options.folder / file.name)) for file in told)]
    sums = [f"{hashlib.sha256(file.read_bytes()).hexdigest()}  {file.name}\n" for file in sorted(files)]
    (options.folder / "SHA256SUMS").write_text("".join(sums))
    for file in sorted(files):
        print(f"{file}: {file.stat().st_size / 1e6:.1f} MB")
    print(options.folder / "SHA256SUMS")


if __name__ == "__main__":
    main()
