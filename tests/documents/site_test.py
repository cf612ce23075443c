# SPDX-License-Identifier: Apache-2.0
"""The site of the documents is made without a warning, and its search knows the pages.

Usage: site_test.py SOURCE. Exits with 77 where MkDocs is not in build/site/environment (`./dev test` and `./dev site` put it there).
"""
import json
import pathlib
import subprocess
import sys

source = pathlib.Path(sys.argv[1]).resolve()
mkdocs = source / "build/site/environment/bin/mkdocs"
if not mkdocs.exists():
    sys.exit(77)
subprocess.run([sys.executable, "-B", source / "docs/site/make_site.py", mkdocs, source], check=True)
index = json.loads((source / "build/site/html/search/search_index.json").read_text(encoding="utf-8"))
found = {entry["location"].partition("#")[0] for entry in index["docs"]}
for page in ("index.html", "docs/speed.html", "docs/design/edges.html", "bench/RESULTS.html"):
    assert (source / "build/site/html" / page).exists(), page
    assert page in found, f"{page} is not in the index of the search"
print(f"{len(found)} pages can be searched")
