# SPDX-License-Identifier: Apache-2.0
"""make_release.py on a wheel and a package that have nothing but their versions: files, checksums, equal bytes, and
versions that differ. Usage: release_test.py SOURCE FOLDER. Exits with 77 without dpkg-deb or git."""
import hashlib
import io
import pathlib
import re
import shutil
import subprocess
import sys
import tarfile
import zipfile

source, work = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
inside = subprocess.run(["git", "-C", source, "rev-parse", "HEAD"], capture_output=True) if shutil.which("git") else None
if not shutil.which("dpkg-deb") or inside is None or inside.returncode:
    print("skipped: dpkg-deb is missing, or the sources are no clone of git")
    sys.exit(77)
committed = subprocess.run(["git", "-C", source, "show", "HEAD:CMakeLists.txt"], capture_output=True, text=True, check=True).stdout
version = re.search(r"^project\(wavetracer VERSION ([0-9.]+)", committed, re.M)[1]
shutil.rmtree(work, ignore_errors=True)
work.mkdir(parents=True)


def made(number):
    """A wheel and a package of this version."""
    wheel = work / f"wavetracer-{number}-py3-none-any.whl"
    with zipfile.ZipFile(wheel, "w") as archive:
        archive.writestr(f"wavetracer-{number}.dist-info/METADATA", f"Metadata-Version: 2.1\nName: wavetracer\nVersion: {number}\n")
    tree = work / f"package-{number}"
    (tree / "DEBIAN").mkdir(parents=True)
    (tree / "DEBIAN/control").write_text(f"Package: wavetracer\nVersion: {number}\nArchitecture: all\nMaintainer: a <a@b>\nDescription: none\n")
    package = work / f"wavetracer_{number}_all.deb"
    subprocess.run(["dpkg-deb", "--root-owner-group", "-b", tree, package], check=True, capture_output=True)
    return wheel, package


def release(folder, wheel, package):
    return subprocess.run([sys.executable, source / "python/make_release.py", work / folder, wheel, package],
                          capture_output=True, text=True)


wheel, package = made(version)
for folder in ("one", "two"):
    done = release(folder, wheel, package)
    assert done.returncode == 0, done.stderr
files = {path.name: path.read_bytes() for path in (work / "one").iterdir()}
assert set(files) == {"SHA256SUMS", f"wavetracer-{version}.tar.gz", wheel.name, package.name}, set(files)
assert files == {path.name: path.read_bytes() for path in (work / "two").iterdir()}  # the same bytes again
sums = dict(reversed(line.split("  ")) for line in files["SHA256SUMS"].decode().splitlines())
assert sums == {name: hashlib.sha256(data).hexdigest() for name, data in files.items() if name != "SHA256SUMS"}, sums
with tarfile.open(fileobj=io.BytesIO(files[f"wavetracer-{version}.tar.gz"])) as archive:
    names = archive.getnames()
    assert archive.extractfile(f"wavetracer-{version}/CMakeLists.txt").read().decode() == committed
listed = subprocess.run(["git", "-C", source, "ls-tree", "-r", "--name-only", "-z", "HEAD"], capture_output=True, text=True, check=True).stdout
assert {f"wavetracer-{version}/{name}" for name in listed.rstrip("\0").split("\0")} <= set(names)

# Versions that differ are named, and nothing is written.
other_wheel, other_package = made("9.8.7")
for pair, named in (((other_wheel, package), other_wheel), ((wheel, other_package), other_package)):
    done = release("wrong", *pair)
    assert done.returncode == 1 and f"{named} has version 9.8.7" in done.stderr and version in done.stderr, done
    assert not (work / "wrong").exists()
print("a release has its three files, their checksums, and one version")
