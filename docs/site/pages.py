# SPDX-License-Identifier: Apache-2.0
"""The pages of the documents, and their links."""
import pathlib
import re

LINK = re.compile(r"(!?)\[[^\]]*\]\(([^)\s]+)\)")
TOP = ("README.md", "CHANGELOG.md", "CONTRIBUTING.md", "SECURITY.md", "kernels/README.md")


def pages(root):
    """Every page that the site shows, as paths below `root`: those at the top, in docs/, kernels/ and bench/."""
    found = [root / name for name in TOP if (root / name).exists()]
    found += sorted((root / "docs").rglob("*.md"))
    found += [root / "bench" / "RESULTS.md", *sorted((root / "bench" / "results").glob("*.md"))]
    return [path.relative_to(root) for path in found]


def prose(text):
    """A page without its code, so that code that looks like Markdown does not count. Lines keep their numbers."""
    text = re.sub(r"^```.*?^```$", lambda block: "\n" * block[0].count("\n"), text, flags=re.M | re.S)
    return re.sub(r"`[^`\n]*`", lambda code: "x" * len(code[0]), text)


def links(text):
    """(line, target) of each link and image of a page, except addresses of the web."""
    for match in LINK.finditer(prose(text)):
        if not re.match(r"[a-z]+:", match[2]):
            yield text.count("\n", 0, match.start()) + 1, match[2]


def anchors(text):
    """The anchors of a page's headings, as GitHub and the site make them."""
    seen, found = {}, set()
    for heading in re.findall(r"^#+ (.*)$", re.sub(r"^```.*?^```$", "", text, flags=re.M | re.S), re.M):
        heading = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "")
        slug = re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")
        seen[slug] = seen.get(slug, 0) + 1
        found.add(slug if seen[slug] == 1 else f"{slug}-{seen[slug] - 1}")
    return found


def target_of(root, page, target):
    """(file, anchor) that a link of a page means; the file is absolute and may be missing."""
    name, _, anchor = target.partition("#")
    return ((root / page).parent / name).resolve() if name else (root / page).resolve(), anchor
