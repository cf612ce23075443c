#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests the OpenCL drivers that the package offers, on made-up systems, with made-up packages of PyPI: nothing is
loaded.

Usage: drivers_test.py. Exits with 77 without numpy.
"""
import importlib
import os
import pathlib
import stat
import sys
import tempfile
from unittest import mock

try:
    import wavetracer._library  # noqa: F401
except ModuleNotFoundError as missing:
    if missing.name != "numpy":
        raise
    sys.exit(77)
from wavetracer import _drivers

work = pathlib.Path(tempfile.mkdtemp(prefix="wavetracer-drivers-"))


def system(listed, nvidia=False, pocl=False, zig=False, tools=(), **variables):
    """Returns the variables that the package adds to the environment of a system with these drivers listed, packages
    installed and tools."""
    root = pathlib.Path(tempfile.mkdtemp(dir=work))
    for folder in ("vendors", "lib", "site", "bin", "cache"):
        (root / folder).mkdir()
    for name, content in listed.items():
        (root / "vendors" / name).write_text(content)
    if nvidia:
        (root / "lib/libnvidia-opencl.so.1").touch()
    if pocl:
        (root / "site/pocl_binary_distribution").mkdir()
        (root / "site/pocl_binary_distribution/__init__.py").touch()
        (root / "site/pyopencl/.libs").mkdir(parents=True)
        (root / "site/pyopencl/.libs/libpocl-0.so").touch()
    if zig:
        (root / "site/ziglang").mkdir()
        (root / "site/ziglang/__init__.py").touch()
        (root / "site/ziglang/zig").write_text('#!/bin/sh\necho "zig $@"\n')
        (root / "site/ziglang/zig").chmod(0o755)
    for name in tools:
        (root / "bin" / name).write_text("#!/bin/sh\n")
        (root / "bin" / name).chmod(0o755)
    variables = {"PATH": str(root / "bin"), "XDG_CACHE_HOME": str(root / "cache")} | variables
    importlib.invalidate_caches()
    with mock.patch.dict(os.environ, variables, clear=True), mock.patch.object(sys, "path", [str(root / "site")]), \
            mock.patch.object(_drivers, "SYSTEM_VENDORS", str(root / "vendors")), \
            mock.patch.object(_drivers, "_LIBRARY_FOLDERS", (str(root / "lib"),)):
        return root, _drivers.environment()


def drivers(folder):
    return sorted(file.read_text().strip() for file in pathlib.Path(folder).glob("*.icd"))


POCL = {"pocl.icd": "libpocl.so.2.10.0\n"}
assert system({})[1] == {}  # nothing to offer
assert system(POCL)[1] == {}
assert system(POCL, pocl=True)[1] == {} or "OCL_ICD_VENDORS" not in system(POCL, pocl=True)[1]  # never two of them
assert system({"nvidia.icd": "libnvidia-opencl.so.1\n"}, nvidia=True)[1] == {}

root, added = system({}, pocl=True)
assert drivers(added["OCL_ICD_VENDORS"]) == [f"{root}/site/pyopencl/.libs/libpocl-0.so"]
assert added["OCL_ICD_VENDORS"].startswith(f"{root}/cache/wavetracer/")
assert stat.S_IMODE(os.stat(added["OCL_ICD_VENDORS"]).st_mode) == 0o700
# A driver that exists but is not listed is added to those that are; PoCL is added beside a GPU's driver.
root, added = system(POCL, nvidia=True)
assert drivers(added["OCL_ICD_VENDORS"]) == [f"{root}/lib/libnvidia-opencl.so.1", "libpocl.so.2.10.0"]
root, added = system({"intel.icd": "libigdrcl.so\n"}, nvidia=True, pocl=True)
assert drivers(added["OCL_ICD_VENDORS"]) == [f"{root}/lib/libnvidia-opencl.so.1",
                                             f"{root}/site/pyopencl/.libs/libpocl-0.so", "libigdrcl.so"]
# A value set by the user is kept.
assert "OCL_ICD_VENDORS" not in system({}, pocl=True, OCL_ICD_VENDORS="/mine")[1]
# Caches that cannot be written to, or that others can write to, are not used.
for cache in ("/proc/nowhere", str(work / "open")):
    if cache.endswith("open"):
        os.umask(0)
        with mock.patch.object(pathlib.Path, "mkdir", lambda self, **_: os.makedirs(self, 0o777, exist_ok=True)):
            _, added = system({}, pocl=True, XDG_CACHE_HOME=cache)
        os.umask(0o022)
    else:
        _, added = system({}, pocl=True, XDG_CACHE_HOME=cache)
    assert not added["OCL_ICD_VENDORS"].startswith(cache) and len(drivers(added["OCL_ICD_VENDORS"])) == 1

# The linker that PoCL calls: the system's, else that of ziglang, behind all else in the PATH.
assert "PATH" not in system({}, pocl=True, zig=True, tools=["ld"])[1]
assert "PATH" not in system({}, pocl=True)[1] and "PATH" not in system({}, zig=True)[1]
root, added = system({}, pocl=True, zig=True)
first, last = added["PATH"].split(":")
assert first == f"{root}/bin" and os.popen(f"{last}/ld -shared -lc 'a b' -lgcc").read() == "zig ld.lld -shared a b\n"
print("drivers ok")
