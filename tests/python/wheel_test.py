# SPDX-License-Identifier: Apache-2.0
"""Makes the wheel of a build, looks at what it carries, and installs it in an environment that has no other wavetracer.

Usage: wheel_test.py SOURCE BUILD ENVIRONMENT FOLDER. Exits with 77 where the environment is not there (no PyPI).
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import zipfile

source, build, environment, folder = map(pathlib.Path, sys.argv[1:])
python = environment / "bin/python"
if not (environment / "installed.txt").exists():
    print(f"skipped: {environment} is not complete: ./dev test makes it from PyPI")
    sys.exit(77)
# The environment has nothing of this machine's but its program loader.
clean = {"PATH": f"{environment}/bin:/usr/bin:/bin", "HOME": os.environ.get("HOME", "/tmp"), "LC_ALL": "C.UTF-8"}


def run(*command, **options):
    done = subprocess.run(list(map(str, command)), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          **{"env": clean, "cwd": folder} | options)
    assert done.returncode == 0, f"{command}\n{done.stdout}"
    return done.stdout


shutil.rmtree(folder, ignore_errors=True)
folder.mkdir(parents=True)
print(run(python, source / "python/make_wheel.py", folder / "wheel", "--build", build,
          env=dict(os.environ, PIP_DISABLE_PIP_VERSION_CHECK="1")))
(wheel,) = (folder / "wheel").glob("*.whl")
version = re.search(r"project\(wavetracer VERSION ([0-9.]+)", (source / "CMakeLists.txt").read_text())[1]
# One wheel for every Python, and for every Linux from the C library of this one on.
assert re.fullmatch(rf"wavetracer-{re.escape(version)}-py3-none-manylinux_2_[0-9]+_(x86_64|aarch64)\.whl", wheel.name), wheel
with zipfile.ZipFile(wheel) as archive:
    names = archive.namelist()
    carried = {re.sub(r"-[0-9a-f]{8}.*", "", pathlib.Path(name).name) for name in names if ".libs/" in name}
    assert carried >= {"libhdf5_serial", "libassimp", "libproj", "libOpenCL", "libtbb"}, carried
    assert not carried & {"libc", "libstdc++", "libgcc_s"}, carried
    for name in ("wavetracer/py.typed", "wavetracer/share/configs/demo.toml", "wavetracer/share/proj/proj.db",
                 "wavetracer/share/examples/channels.ipynb", "wavetracer/share/examples/live_client.py",
                 "wavetracer/lib/libwavetracer_kernels.so", "wavetracer/share/include/wavetracer/kernels/sort.hpp"):
        assert name in names, name
    assert any(name.startswith("wavetracer/share/kernels/") and name.endswith("radix_sort.cl") for name in names)
    texts = [name for name in names if "/licenses/libraries/" in name and name.endswith(".txt")]
    assert len(texts) >= len(carried) - 5, texts  # some packages have several libraries
    mode = archive.getinfo("wavetracer/bin/wavetracer").external_attr >> 16
    assert mode & 0o111 == 0o111, oct(mode)
assert wheel.stat().st_size < 60e6

run(python, "-m", "pip", "install", "-q", "--no-deps", "--force-reinstall", wheel)
run(python, "-m", "pip", "check")
where = run(python, "-c", "import wavetracer; print(wavetracer.__file__, wavetracer.__version__)").split()
assert where == [str(next(environment.glob("lib/python3*/site-packages/wavetracer/__init__.py"))), version], where
assert run("wavetracer", "--version").startswith(f"wavetracer {version}\n")
assert run(python, "-m", "wavetracer", "--version").startswith(f"wavetracer {version}\n")
run(python, "-c", "import wavetracer as wt; assert all((f / n).exists() for f, n in ((wt.configs, 'demo.toml'), (wt.examples, 'channels.ipynb')))")
# The extra has what the notebook imports, and the kernel that runs it.
extras = run(python, "-c", "import importlib.metadata as m; print(*(r for r in m.requires('wavetracer') if 'notebook' in r), sep='\\n')")
assert {re.split(r"[ ;]", line)[0] for line in extras.splitlines()} >= {"ipykernel", "matplotlib", "pandas", "tqdm", "xarray"}, extras
# The command does not wait for NumPy; everything that the package offers exists, and nothing else.
run(python, "-c", "import sys, wavetracer, wavetracer._program; assert 'numpy' not in sys.modules")
run(python, "-c", """
import wavetracer
from wavetracer import *
assert all(getattr(wavetracer, name) is not None for name in dir(wavetracer)) and open is not wavetracer.open
assert Simulation is wavetracer.Simulation and callable(view) and not hasattr(wavetracer, "nothing")
""")
# Libraries that the loader takes from outside of the wheel must be part of every Linux.
own = next(environment.glob("lib/python3*/site-packages"))
for file in (own / "wavetracer/bin/wavetracer", own / "wavetracer/lib/libwavetracer.so", own / "wavetracer/lib/libwavetracer_kernels.so"):
    for name, found in re.findall(r"(\S+) => (/\S+)", run("ldd", file)):
        assert found.startswith(str(own)) or re.match(r"(libc|libm|libstdc\+\+|libgcc_s|libresolv|libz|libexpat)\.so", name), found
# The program says what is wrong with the exit code of its own, and reads its own files.
wrong = subprocess.run(["wavetracer", "run", "-c", "nowhere.toml"], env=clean, cwd=folder, capture_output=True, text=True)
assert wrong.returncode == 2 and "nowhere.toml" in wrong.stderr, wrong
# It opens no GDAL of the system beside its own libraries, gives advice, and ends normally.
(folder / "town.geojson").write_text('{"type": "FeatureCollection", "features": []}')
gdal = subprocess.run(["wavetracer", "convert", "town.geojson", "-o", "town"], env=clean | {"LD_DEBUG": "files"},
                      cwd=folder, capture_output=True, text=True)
assert gdal.returncode == 1 and "wheels come without it: convert the file with" in gdal.stderr, gdal
assert "file=libgdal" not in gdal.stderr, gdal
(folder / "my.toml").write_text(run("wavetracer", "init", "--minimal"))
run("wavetracer", "run", "-c", "my.toml", "-o", "out")
run("wavetracer", "view", "out")
assert (folder / "out/view.html").stat().st_size > 100_000
# Types are checked for the package, and for a user's code.
(folder / "typed.py").write_text("""import numpy
import wavetracer as wt

simulation = wt.Simulation({"scene": {"generate": "--blocks 2"}}, trace={"rays": 10})
frame: wt.Frame = simulation.run_frame(0)
h: "numpy.ndarray" = frame.paths.select(tx="t", kind=["reflected"]).cfr([0.0, 1e6])
run: wt.Run = wt.open("out")
version: str = wt.__version__
""")
run(python, "-m", "mypy", "--strict", "--ignore-missing-imports", "--cache-dir", folder / "mypy", folder / "typed.py",
    source / "python/wavetracer", env=clean | {"MYPYPATH": str(source / "python")})
# The examples have few annotations, but what they do with the package and with Python's own modules has the right types.
(folder / "examples.ini").write_text("[mypy]\ncheck_untyped_defs = True\nignore_missing_imports = True\nfollow_imports = silent\n")
run(python, "-m", "mypy", "--config-file", folder / "examples.ini", "--cache-dir", folder / "mypy_examples",
    *sorted((source / "docs/examples").glob("*.py")), env=clean | {"MYPYPATH": str(source / "python")})
print("the wheel is installed in", environment)
