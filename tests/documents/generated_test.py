# SPDX-License-Identifier: Apache-2.0
"""Pages and tables of measurements are what bench/report.py makes of bench/results, and follow them.

Usage: generated_test.py SOURCE. In a copy of the tree a row that is replaced, a number that is typed and a page that is
gone must each be noticed. No device is used.
"""
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

source = pathlib.Path(sys.argv[1]).resolve()


def check(root):
    """(exit code, what is said) of report.py --check."""
    done = subprocess.run([sys.executable, "-B", root / "bench/report.py", "--check"], capture_output=True, text=True)
    return done.returncode, done.stderr


def copied(folder):
    """The parts of the tree that report.py reads and writes."""
    root = pathlib.Path(folder) / "tree"
    shutil.copytree(source / "bench", root / "bench", ignore=shutil.ignore_patterns("*.cpp", "*.hpp", "validation", "peers"))
    shutil.copytree(source / "docs", root / "docs", ignore=shutil.ignore_patterns("*.png", "examples"))
    shutil.copy(source / "README.md", root)
    return root


def edited(path, old, new):
    text = path.read_text(encoding="utf-8")
    assert old in text, f"{path}: {old}"
    path.write_text(text.replace(old, new, 1), encoding="utf-8")


def main():
    code, said = check(source)
    if code:
        sys.exit(said)
    with tempfile.TemporaryDirectory() as folder:
        root = copied(folder)
        assert check(root) == (0, ""), check(root)
        edited(root / "README.md", " 22,500 places |", " 22,501 places |")
        assert check(root)[0] == 1 and "README.md" in check(root)[1], "a number that is typed is not noticed"
        (root / "bench/results/leaks.md").unlink()
        assert "bench/results/leaks.md" in check(root)[1], "a page that is gone is not noticed"

        results = root / "bench/results/live.jsonl"
        rows = [json.loads(line) for line in results.read_text().splitlines()]
        newer = rows[0] | {"value": 2 * rows[0]["value"], "date": "2999-01-01T00:00:00Z"}
        with open(results, "a", encoding="utf-8") as file:
            file.write(json.dumps(newer) + "\n")
        subprocess.run([sys.executable, "-B", root / "bench/report.py"], check=True)
        kept = [json.loads(line) for line in results.read_text().splitlines()]
        assert kept == rows[1:] + [newer], "the row that a newer one replaces is still there, or another one is gone"
        assert check(root) == (0, ""), check(root)
        edited(root / "README.md", "generated: visitor", "generated: nothing")
        assert "no generated block is called nothing" in check(root)[1]
    print("pages and tables are those of the results")


main()
