# SPDX-License-Identifier: Apache-2.0
"""OpenCL drivers for machines on which users cannot install one: PoCL from PyPI, and NVIDIA's where it is not listed.

The OpenCL loader takes its drivers from the files *.icd of one folder, /etc/OpenCL/vendors. If there is a driver that
this folder does not list, a folder of our own lists all of them, and OCL_ICD_VENDORS names that folder. If the user has
set OCL_ICD_VENDORS, it is left unchanged.

PoCL calls a linker, `ld`. Where there is none, as on a machine without compilers, that of the package ziglang (LLVM's
lld) is offered under this name. The extra `pocl` of this package brings both.
"""
from __future__ import annotations

import hashlib
import importlib.util
import os
import pathlib
import shutil
import sys
import tempfile

SYSTEM_VENDORS = "/etc/OpenCL/vendors"
_NVIDIA = "libnvidia-opencl.so.1"
_LIBRARY_FOLDERS = ("/usr/lib/x86_64-linux-gnu", "/usr/lib64", "/usr/lib/wsl/lib", "/usr/local/nvidia/lib64")


# A machine without a compiler lacks the files that -lc and -lgcc name; the process that loads a kernel has the
# libraries loaded already.
_LINKER = """#!/bin/sh
for word do
  shift
  case $word in -lc | -lgcc | -lgcc_s) ;; *) set -- "$@" "$word" ;; esac
done
exec "{zig}" ld.lld "$@"
"""


def _package_folder(name: str) -> pathlib.Path | None:
    """The folder of an installed package, which is not imported."""
    try:
        found = importlib.util.find_spec(name)
    except (ImportError, ValueError):
        return None
    places = list(found.submodule_search_locations or ()) if found else []
    return pathlib.Path(places[0]) if places else None


def pocl_library() -> pathlib.Path | None:
    """libpocl.so of the package pocl-binary-distribution, which lies where pyopencl would look for it."""
    folder = _package_folder("pocl_binary_distribution")
    if not folder:
        return None
    return next(iter(sorted(folder.parent.glob("pyopencl/.libs/libpocl*.so"))), None)


def nvidia_library() -> str | None:
    """NVIDIA's OpenCL driver, as containers have it: there, but not listed."""
    return next((f"{folder}/{_NVIDIA}" for folder in _LIBRARY_FOLDERS if os.path.exists(f"{folder}/{_NVIDIA}")), None)


def unlisted(listed: str) -> list[str]:
    """The drivers to add to those whose files *.icd say `listed`. A second PoCL in one process would clash with the
    first."""
    out = []
    nvidia, pocl = nvidia_library(), pocl_library()
    if nvidia and "libnvidia-opencl" not in listed:
        out.append(nvidia)
    if pocl and "pocl" not in listed:
        out.append(str(pocl))
    return out


def _own_folder(key: str) -> pathlib.Path:
    """A folder that only this user can write to, the same for the same key. This matters because files in it are loaded
    and run."""
    name = hashlib.sha256(key.encode()).hexdigest()[:16]
    caches = pathlib.Path(os.environ.get("XDG_CACHE_HOME") or pathlib.Path.home() / ".cache")
    folder = caches / "wavetracer" / name
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        status = folder.stat()
        if status.st_uid == os.getuid() and not status.st_mode & 0o022 and os.access(folder, os.W_OK):
            return folder
    except OSError:
        pass
    return pathlib.Path(tempfile.mkdtemp(prefix="wavetracer-"))


def _write(file: pathlib.Path, content: str, mode: int) -> None:
    """Writes a file so that only the complete file appears under its name, even if several processes do so at once."""
    if file.exists() and file.read_text() == content:
        return
    part = file.with_name(f"{file.name}.{os.getpid()}")
    part.write_text(content)
    part.chmod(mode)
    part.replace(file)


def _vendors() -> str | None:
    lists = {file.name: file.read_text(errors="replace") for file in sorted(pathlib.Path(SYSTEM_VENDORS).glob("*.icd"))}
    added = unlisted("".join(lists.values()))
    if not added:
        return None
    lists |= {f"wavetracer{i}.icd": driver + "\n" for i, driver in enumerate(added)}
    folder = _own_folder("vendors" + repr(lists))
    for name, content in lists.items():
        _write(folder / name, content, 0o600)
    return str(folder)


def linker() -> str | None:
    """A folder with `ld` for PoCL; None where the system has one, or where no package brings one."""
    zig = _package_folder("ziglang")
    if shutil.which("ld") or not zig or not (zig / "zig").exists():
        return None
    script = _LINKER.format(zig=zig / "zig")
    folder = _own_folder("linker" + script)
    _write(folder / "ld", script, 0o700)
    return str(folder)


def environment() -> dict[str, str]:
    """The variables to add to the environment so that the library and the program find their drivers."""
    out = {}
    if not os.environ.get("OCL_ICD_VENDORS") and sys.platform == "linux" and (vendors := _vendors()):
        out["OCL_ICD_VENDORS"] = vendors
    if pocl_library() and (folder := linker()):
        out["PATH"] = os.environ.get("PATH", os.defpath) + os.pathsep + folder
    return out
