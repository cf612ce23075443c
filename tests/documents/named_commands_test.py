# SPDX-License-Identifier: Apache-2.0
"""Commands that pages name inside of sentences exist, with their options: those of `wavetracer` on the pages whose blocks
no test runs (run_document.py looks at the others), and `./dev NAME` and `bench_NAME` on all pages.

    named_commands_test.py SOURCE WAVETRACER
"""
import os
import pathlib
import re
import sys

from run_document import misspelt

source, program = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve()
environment = os.environ | {"PATH": f"{program.parent}:{os.environ['PATH']}"}
history = {source / "CHANGELOG.md"}  # names commands that are gone
pages = [page for folder in (".", "docs", "docs/design", "kernels", "bench", "configs", "configs/scenes", "tests/reference")
         for page in sorted((source / folder).glob("*.md")) if page not in history]
dev = (source / "dev").read_text(encoding="utf-8")
subcommands = set(re.findall(r"^  ([a-z]+)", dev[dev.index("usage: ./dev"):dev.index("\nTEXT")], re.M))
benches = {file.stem for file in (source / "bench").glob("bench_*.cpp")}
faults, seen = [], 0
for page in pages:
    text = page.read_text(encoding="utf-8")
    told = list(misspelt(text, environment, source)) if page.parent != source / "docs" and page.name != "README.md" else []
    for name in re.findall(r"\./dev ([a-z]+)", text):
        seen += 1
        if name not in subcommands:
            told.append(f"`./dev {name}`: there is no such command")
    for name in re.findall(r"`(bench_[a-z_]+)", text):
        seen += 1
        if name not in benches:
            told.append(f"`{name}`: there is no such benchmark")
    faults += [f"{page.relative_to(source)}: {fault}" for fault in told]
assert seen > 100 and len(pages) > 40 and len(subcommands) > 15, (seen, len(pages), subcommands)
if faults:
    sys.exit("\n".join(faults))
print(f"{len(pages)} pages name commands that exist")
