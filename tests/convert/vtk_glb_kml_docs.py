# SPDX-License-Identifier: Apache-2.0
"""Runs the examples of docs/formats.md as they stand there: the conversions, then every block of Python.
Run as vtk_glb_kml_docs.py PROGRAM RUN ARRAYS OUTPUT; a block whose package is missing is skipped, and said so."""
import json
import os
import re
import shlex
import shutil
import subprocess
import sys

program, run, arrays, output = (os.path.abspath(path) for path in sys.argv[1:5])
page = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../docs/formats.md")
blocks = re.findall(r"^```(\w+)\n(.*?)^```$", open(page, encoding="utf-8").read(), re.DOTALL | re.MULTILINE)
shutil.rmtree(output, ignore_errors=True)
os.makedirs(os.path.join(output, "out"))
os.symlink(run, os.path.join(output, "out/demo"))
os.symlink(arrays, os.path.join(output, "out/arrays"))

done = failed = 0
for kind, text in blocks:
    if kind == "sh":
        for words in map(shlex.split, text.splitlines()):
            assert words[0] == "wavetracer" and words[1] in ("run", "convert", "coverage"), words
            if words[1] == "convert":  # runs are there already, and maps have tests of their own
                subprocess.run([program, *words[1:]], cwd=output, check=True, stdout=subprocess.DEVNULL)
                done += 1
        continue
    if kind == "json":  # a file as it is written, not an example to run
        json.loads(text)
        continue
    assert kind == "python", kind
    name = re.search(r'"(?:out/)?(?:demo|arrays|coverage)[^"]*"', text).group()
    if "coverage" in name:  # the test of this document by itself makes the map and runs this
        continue
    result = subprocess.run([sys.executable, "-c", text], cwd=output, capture_output=True, text=True)
    if result.returncode == 0 and result.stdout:
        done += 1
    elif "ModuleNotFoundError" in result.stderr:
        print(f"{name}: left out, {result.stderr.splitlines()[-1]}")
    else:
        failed += 1
        print(f"{name}: fails or prints nothing\n{result.stdout}{result.stderr}")
assert done > 10, done
sys.exit(f"{failed} examples of docs/formats.md fail" if failed else print(f"docs/formats.md: {done} examples run"))
