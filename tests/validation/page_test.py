#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""docs/validation.md is what bench/validation makes of its results, and says nothing that they do not.

Usage: page_test.py FOLDER; FOLDER is bench/validation. Exits with 77 without numpy. No device is used.
"""
import pathlib
import sys

folder = pathlib.Path(sys.argv[1])
sys.path.insert(0, str(folder))
try:
    import page
except ImportError:
    sys.exit(77)
import validate


def main():
    docs = folder.parents[1] / "docs"
    text = page.text(validate.results())
    if text != (docs / "validation.md").read_text(encoding="utf-8"):
        sys.exit("docs/validation.md is not what bench/validation/results make: python3 bench/validation/validate.py --page")
    for figure in page.FIGURES:
        assert (docs / "figures" / figure).exists() and f"(figures/{figure})" in text, figure
    # A different result gives a different page.
    changed = validate.results()
    changed["edges"]["double"][0]["v_db"] += 9
    assert page.text(changed) != text, "the page does not follow its results"
    print("the page is that of the results")


if __name__ == "__main__":
    main()
