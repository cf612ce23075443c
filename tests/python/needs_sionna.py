# SPDX-License-Identifier: Apache-2.0
"""Import this before sionna.rt: finds an LLVM for it, and ends the script with 77, "skipped", where either is missing."""
import glob
import os
import sys

newer = sorted(glob.glob("/usr/lib/x86_64-linux-gnu/libLLVM.so.*"))  # from 18 on they are called so
if newer:
    os.environ.setdefault("DRJIT_LIBLLVM_PATH", newer[-1])
try:
    import drjit as dr
    import numpy  # noqa: F401
    import sionna.rt  # noqa: F401
except ImportError as missing:
    print(f"skipped: {missing} (PyPI: sionna-rt)")
    sys.exit(77)
if not (dr.has_backend(dr.JitBackend.LLVM) and dr.detail.llvm_version() >= (16, 0, 0)):
    print("skipped: LLVM is older than 16, which sionna-rt cannot use (Debian: libllvm19)")
    sys.exit(77)
