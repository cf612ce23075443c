# SPDX-License-Identifier: Apache-2.0
"""bench/verdicts.py puts the runs of `wavetracer thesis` together, and bench/thesis_gpus.py leaves no experiment out.

Usage: verdicts_test.py SOURCE PROGRAM. The program lists its experiments; no device is used.
"""
import os
import pathlib
import subprocess
import sys
import tempfile

source, program = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]
sys.path.insert(0, str(source / "bench"))
import thesis_gpus  # noqa: E402
import verdicts  # noqa: E402


def page(device, command, *claims):
    """The parts of thesis.md that matter, of a run with these claims: figure, words, verdict."""
    lines = [f"| {figure} | {words} | thesis | {verdict} | 1.20 |" for figure, words, verdict in claims]
    return (f"# Title\n\n- device: {device} (platform, driver 1)\n- date: 2026-11-27, wavetracer 1\n- command: `{command}`\n\n"
            "## Verdicts\n\n| figure | claim | origin | verdict | measured |\n" + "\n".join(lines) + "\n\n## Speed\n")


def check_merging():
    old = [{"device": device, "date": "2026-11-01", "command": "old", "figure": "figure-6.1", "claim": "old", "origin": "thesis",
            "verdict": "refuted", "measured": "2"} for device in ("pthread-old-A", "GPU 1", "GPU 2")]
    first = page("pthread-new-A", "wavetracer thesis figure-6.2 figure-6.10 -o a --frames 3", ("figure-6.10", "ten", "refuted"),
                 ("figure-6.2", "two", "reproduced"))
    second = page("pthread-new-A", "wavetracer thesis cache-step figure-6.1 -o b --frames 3", ("cache-step", "step", "in part"),
                  ("figure-6.1", "one", "exceeded"))
    rows = verdicts.merged(old, [first, second], note="a note", instead_of="GPU 1")
    names = [(row["device"], row["claim"]) for row in rows]
    assert names == [("pthread-new-A", "one"), ("pthread-new-A", "two"), ("pthread-new-A", "ten"), ("pthread-new-A", "step"),
                     ("GPU 2", "old")], names
    assert [row["verdict"] for row in rows[:2]] == ["exceeded", "reproduced"], rows
    lines = verdicts.counts(rows)
    assert any(line.startswith("| two cores | thesis | 4 | 1 | 1 | 1 | 1 | 0 | 0 | 0 |") for line in lines), lines
    assert any(line.endswith("| `wavetracer thesis NAME... --frames 3`, 2026-11-27, a note |") for line in lines), lines
    assert any(line.endswith("| `old`, 2026-11-01 |") for line in lines), lines
    no_claims = "# Title\n\n- device: A\n- date: B\n- command: `C`\n\n## Verdicts\n\n## Speed\n"
    assert verdicts.merged(old, [no_claims, first, second], note="a note", instead_of="GPU 1") == rows
    apart = verdicts.merged(rows, [page("GPU 2", "long", ("figure-6.1", "old", "exceeded"))], apart="500 cycles")
    assert [row["device"] for row in apart[4:]] == ["GPU 2", "GPU 2, 500 cycles"], apart
    more = verdicts.merged(apart, [page("GPU 2", "more", ("figure-6.2", "two", "refuted"))], apart="500 cycles", add=True)
    assert [row["claim"] for row in more if row["device"] == "GPU 2, 500 cycles"] == ["old", "two"], more
    whole = verdicts.page(apart)
    assert "| claim | two cores | GPU 2 | GPU 2, 500 cycles |" in whole and "| old |  | **refuted**: 2 | **exceeded**: 1.20 |" in whole, whole
    assert whole.endswith("## cache-step\n\n| claim | two cores |\n| --- | --- |\n| step | **in part**: 1.20 |\n"), whole
    for texts in ([first, first], [no_claims]):
        try:
            verdicts.merged(old, texts)
        except SystemExit:
            continue
        raise AssertionError("a figure that two files have, or a file without verdicts, is not noticed")


def check_groups():
    listing = subprocess.run([program, "thesis"], capture_output=True, text=True, check=True).stdout
    names = {line.split()[0] for line in listing.splitlines() if line.startswith("  ")}
    # The page of all has no coherence-*: their claims are those of figure-6.13.
    expected = {name for name in names if name != "all" and not name.startswith("coherence-")}
    grouped = [name for group in thesis_gpus.GROUPS for name in group]
    assert sorted(grouped) == sorted(expected), set(grouped) ^ expected


def check_run():
    """A program that stands for wavetracer: it writes the GPU that it sees and its arguments, and one of its runs fails."""
    with tempfile.TemporaryDirectory() as folder:
        fake = pathlib.Path(folder) / "fake"
        fake.write_text('#!/bin/sh\necho "$CUDA_VISIBLE_DEVICES $*"\ntest "$2" != cache-division\n', encoding="utf-8")
        os.chmod(fake, 0o755)
        run = [sys.executable, "-B", source / "bench/thesis_gpus.py", fake, pathlib.Path(folder) / "out", "2", "--frames", "3"]
        done = subprocess.run(run, capture_output=True, text=True)
        assert done.returncode == 1 and "exit code 1: cache-division cache-step" in done.stdout, done
        for names in thesis_gpus.GROUPS:
            said = (pathlib.Path(folder) / "out" / names[0] / "log.txt").read_text(encoding="utf-8").split()
            assert said[0] in ("0", "1") and said[1:] == ["thesis", *names, "-o", names[0], "--frames", "3"], said


check_merging()
check_groups()
check_run()
