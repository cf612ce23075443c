# SPDX-License-Identifier: Apache-2.0
"""Makes the site of the documents: make_site.py MKDOCS ROOT. MKDOCS is the program, ROOT the source tree.

Pages, and the files that they link to, are copied to build/site/pages in the layout of the tree, so that links stay as
they are; the site is build/site/html. A link that leads nowhere is an error.
"""
import pathlib
import shutil
import subprocess
import sys

import pages


def main():
    mkdocs, root = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
    staged = root / "build/site/pages"
    shutil.rmtree(staged, ignore_errors=True)
    shown = pages.pages(root)
    wanted = set(shown)
    for page in shown:
        text = (root / page).read_text(encoding="utf-8")
        wanted |= {pages.target_of(root, page, target)[0].relative_to(root) for _, target in pages.links(text)}
    for path in wanted:
        if (root / path).is_file():
            (staged / path).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(root / path, staged / path)
    shutil.copy(root / "docs/site/site.css", staged)
    done = subprocess.run([mkdocs, "build", "--strict", "-f", root / "docs/site/mkdocs.yml"])
    sys.exit(done.returncode)


main()
