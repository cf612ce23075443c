# SPDX-License-Identifier: Apache-2.0
"""Every link of the documents leads to a file and a heading that exist, and every page is linked from another one.

Usage: links_test.py SOURCE. The site takes lists and tables only after an empty line; that is checked as well.
"""
import pathlib
import re
import shutil
import sys
import tempfile

source = pathlib.Path(sys.argv[1]).resolve()
sys.dont_write_bytecode = True
sys.path.insert(0, str(source / "docs/site"))
import pages


def faults(root):
    """Returns the faults of the links of a tree, in words."""
    found, linked = [], {root / "README.md"}
    shown = pages.pages(root)
    texts = {(root / page).resolve(): (root / page).read_text(encoding="utf-8") for page in shown}
    for page in shown:
        text = texts[(root / page).resolve()]
        for line, target in pages.links(text):
            path, anchor = pages.target_of(root, page, target)
            if not path.exists():
                found.append(f"{page}:{line}: {target} does not exist")
            elif anchor and path in texts and anchor not in pages.anchors(texts[path]):
                found.append(f"{page}:{line}: {target}: the page has no such heading")
            if path != (root / page).resolve():
                linked.add(path)
        lines = [""] + pages.prose(text).splitlines()
        for number, (before, line) in enumerate(zip(lines, lines[1:]), start=1):
            for start in (r"[-*] ", r"\|", r"1\. "):
                begins = re.match(start, line) and before.strip() and not re.match(r"\s*(#|[-*] |\||\d+\. |  )", before)
                if begins and not re.match(r" {2}", before):
                    found.append(f"{page}:{number}: a list or table without an empty line before it")
    for page in shown:
        if (root / page).resolve() not in {path.resolve() for path in linked}:
            found.append(f"{page}: no other page leads to it")
    return found


def broken_links_are_found():
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder).resolve()
        (root / "docs").mkdir()
        (root / "bench/results").mkdir(parents=True)
        shutil.copy(source / "bench/RESULTS.md", root / "bench")
        (root / "bench/RESULTS.md").write_text("# Results\n")
        (root / "README.md").write_text("# A\n[b](docs/b.md#there) [c](docs/c.md) [r](bench/RESULTS.md)\ntext\n- item\n")
        (root / "docs/b.md").write_text("# B\n## Here\n`[no](link.md)`\n")
        (root / "docs/d.md").write_text("# D\n")
        assert faults(root) == ["README.md:2: docs/b.md#there: the page has no such heading", "README.md:2: docs/c.md does not exist",
                                "README.md:4: a list or table without an empty line before it", "docs/d.md: no other page leads to it"], faults(root)


broken_links_are_found()
found = faults(source)
for fault in found:
    print(fault)
sys.exit(1 if found else 0)
