#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The tables of kernels/README.md, made of the sources, and the rule that a kernel has one name everywhere.

usage: kernel_table.py SOURCE [--write]

The rule: the first comment of a file in kernels/FOLDER begins with the kernel's NAME, the file is called NAME.cl, or
NAME_FORM.cl where the kernel has several forms, and there are host/passes/NAME.hpp and .cpp, tests/passes/NAME_test.cpp
and a file of bench/ that measures it. --write makes the tables anew; without it, faults are printed.
"""
import pathlib
import re
import sys
import tempfile

HEAD = ["| kernel | what it does | pass | test | benchmark | bound |", "| --- | --- | --- | --- | --- | --- |"]
BEGIN, END = "<!-- generated: {} by tests/house/kernel_table.py -->", "<!-- end of generated -->"


def files(root):
    return sorted(path for path in (root / "kernels").glob("*/*.cl") if path.parent.name != "lib")


def first_comment(path):
    """The words of the comment that follows the line of the licence."""
    words = []
    for line in path.read_text(encoding="utf-8").splitlines()[1:]:
        if not line.startswith("// "):
            break
        words.append(line[3:].strip())
    return " ".join(words)


def name_and_purpose(path):
    """The name that the first comment begins with, and its first sentence to the colon; None where it has no name."""
    comment = re.sub(r" \([^()]*\)", "", first_comment(path)).replace("|", r"\|")
    found = re.match(r"(\w+): (.*?)(?:(?<=\w)[.:](?= |$)|$)", comment)
    return (found[1], found[2]) if found else (None, "")


def arguments(text):
    """The parts of a list, split at the commas that are in no brackets and no string."""
    parts, depth, quoted = [""], 0, False
    for sign in text:
        quoted ^= sign == '"'
        depth += not quoted and (sign in "<({") - (sign in ">)}")
        if sign == "," and depth == 0 and not quoted:
            parts.append("")
        else:
            parts[-1] += sign
    return [part.strip() for part in parts]


def work(expression, unit):
    """Work for an element: a number with its unit, or the function of kernel_costs.cpp that computes it."""
    if expression == "nothing":
        return []
    inner = re.fullmatch(r"always<(.*)>", re.sub(r"device::|(static_cast<size_t>)(\((.*)\))", r"\3", expression))
    if not inner:
        return [f"`{expression}`"]
    number = inner[1] if inner[1].isdigit() else f"`{inner[1]}`"
    if inner[1] == "1" and unit == "operations":
        return ["an operation"]
    return [number if unit.split()[0] in inner[1] else f"{number} {unit}"]


def bounds(root):
    """{"program/kernel": what an element must move and compute}, of the table in kernel_costs.cpp."""
    table = (root / "bench/kernel_costs.cpp").read_text(encoding="utf-8")
    found = {}
    for row in re.findall(r'^    \{("\w+/\w+",.*?)\},$', table, re.M | re.S):
        kernel, _, element, _, moved, computed, *more = arguments(" ".join(row.split()))
        unit = "operations" if not more or more[0] != "true" else "operations in double"
        places = [f"{more[1]} random places" if more[1] != "1" else "a random place"] if len(more) > 1 and more[1] != "0" else []
        found[kernel.strip('"')] = element.strip('"') + ": " + ", ".join(work(moved, "B") + places + work(computed, unit))
    return found


def benchmark(root, path, name):
    """The file of bench/ that names kernels of this file, or else measures the pass; None where there is none."""
    sources = {source: source.read_text(encoding="utf-8") for source in sorted((root / "bench").glob("*.cpp"))}
    named = [source for source, text in sources.items() if f'"{path.stem}/' in text]
    own = [source for source, text in sources.items() if f'#include "passes/{name}.hpp"' in text]
    return (named + own[::-1] + [None])[0]


def kernels_of(path):
    found = re.findall(r"\bkernel (?:__attribute__\(\(.*?\)\)\) )?void (\w+)\(", path.read_text(encoding="utf-8"))
    return list(dict.fromkeys(found))


def bound_of(path, known):
    kernels = [kernel for kernel in kernels_of(path) if f"{path.stem}/{kernel}" in known]
    cells = [(f"`{kernel}`, " if len(kernels_of(path)) > 1 else "") + known[f"{path.stem}/{kernel}"] for kernel in kernels]
    return "; ".join(cells) or "in its benchmark"


def tables(root):
    """{folder: lines of its table}, and the faults of names."""
    made, faults, known = {}, [], bounds(root)
    for path in files(root):
        name, purpose = name_and_purpose(path)
        where = path.relative_to(root)
        if not name or not (path.stem == name or path.stem.startswith(name + "_")):
            faults.append(f"{where}: its first comment begins with the kernel's name, `// {path.stem}: ...`, or the name without that of the form")
            continue
        own = [f"host/passes/{name}.hpp", f"host/passes/{name}.cpp", f"tests/passes/{name}_test.cpp"]
        faults += [f"{where}: there is no {file}" for file in own if not (root / file).exists()]
        bench = benchmark(root, path, name)
        if not bench:
            faults.append(f"{where}: no file of bench/ measures it; add its row to bench/kernel_costs.cpp")
            continue
        links = [f"[{path.stem}]({path.parent.name}/{path.name})", purpose, f"[{name}](../{own[0]})",
                 f"[{name}_test](../{own[2]})", f"[{bench.stem}](../bench/{bench.name})", bound_of(path, known)]
        made.setdefault(path.parent.name, list(HEAD)).append("| " + " | ".join(links) + " |")
    faults += [f"kernels/{path.name}: it lies in no folder of kernels/" for path in sorted((root / "kernels").glob("*.cl"))]
    return made, faults


def page_faults(root, made, write):
    """Faults of kernels/README.md; with `write`, tables are made anew first."""
    path, faults = root / "kernels/README.md", []
    text = path.read_text(encoding="utf-8") if path.exists() else ""
    for folder, lines in made.items():
        begin = BEGIN.format(folder)
        if text.count(begin) != 1:
            faults.append(f"kernels/README.md: folder {folder} has no table; write a section with {begin} and {END}")
            continue
        head, _, rest = text.partition(begin)
        old, _, tail = rest.partition(END)
        new = "\n\n" + "\n".join(lines) + "\n\n"
        if write:
            text = head + begin + new + END + tail
        elif old != new:
            faults.append(f"kernels/README.md: the table of {folder} is old; run python3 tests/house/kernel_table.py . --write")
    faults += [f"kernels/README.md: there is no folder {folder}" for folder in re.findall("<!-- generated: (.*?) by", text)
               if folder not in made]
    if write:
        path.write_text(text, encoding="utf-8")
    return faults


def faults(root, write=False):
    made, names = tables(root)
    return names + page_faults(root, made, write)


def try_the_checks():
    """The checks find what they are for."""
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)

        def add(name, text=""):
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text)

        add("kernels/rays/turn_gpu.cl", "// licence\n// turn: turns rays. More.\nkernel void turn(uint n) {}\n")
        add("bench/kernel_costs.cpp", '    {"turn_gpu/turn", "", "rays", n, always<2 * sizeof(ray)>, nothing, true, 1},\n')
        add("kernels/README.md", f"# Kernels\n{BEGIN.format('rays')}\n{END}\n")
        missing = ["host/passes/turn.hpp", "host/passes/turn.cpp", "tests/passes/turn_test.cpp"]
        assert [fault.split()[-1] for fault in tables(root)[1]] == missing, tables(root)
        for name in missing:
            add(name)
        assert "table of rays is old" in faults(root)[0]
        assert faults(root, True) == [] and faults(root) == []
        assert "| turns rays | [turn](../host/passes/turn.hpp) |" in (root / "kernels/README.md").read_text()
        assert "rays: `2 * sizeof(ray)` B, a random place |" in (root / "kernels/README.md").read_text()
        add("kernels/turn.cl", "// licence\n// turn: turns rays.\n")
        assert "no folder" in faults(root)[0]
        (root / "kernels/turn.cl").unlink()
        add("kernels/paths/other.cl", "// licence\n// turn: a wrong name.\n")
        assert "other.cl: its first comment" in faults(root)[0]
        add("kernels/paths/other.cl", "// licence\n// other: it has nothing else.\n")
        assert sum("other" in fault for fault in faults(root)) == 4, faults(root)


if __name__ == "__main__":
    try_the_checks()
    found = faults(pathlib.Path(sys.argv[1]).resolve(), "--write" in sys.argv)
    print("\n".join(found))
    sys.exit(1 if found else 0)
