#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The rules of the house that a program can check.

usage: house.py SOURCE format|names|sizes|types|kernels|english|project|licence

format  every source is formatted by clang-format with .clang-format
names   tests are called NAME_test.cpp, in a folder with the name of the folder of host/ that they test
sizes   files above 300 lines (kernels: 200) and functions above 60 are those that large.txt lists, and no others
types   no two types of one namespace have the same name: the linker would merge their functions and keep either
kernels every kernel has a row in bench/kernel_costs.cpp, which gives its minimal work; sorts have bench_sort; passes
        launch kernels by the names of their arguments (host/gpu/kernel_of.hpp); kernel, pass, test and benchmark have
        one name, and kernels/README.md lists them (kernel_table.py)
english no comment or docstring begins with a bare "Of", "What", "Who", "Whether" and the like: it has a subject and a verb
project all files name one version; warnings are errors in the presets alone; the hosted checks are those of .ci/run
licence every source file begins with the line of its licence, after an interpreter's line or a document type
"""
import ast
import json
import pathlib
import re
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True
import kernel_table

SKIPPED = 77
FOLDERS = ("bench", "host", "include", "kernels", "tests")
SUFFIXES = {".cpp", ".hpp", ".h", ".c", ".cl", ".clh"}
# These folders of tests are about more than one folder of host/.
OF_THE_WHOLE = {"consumers", "documents", "drivers", "fuzz", "hard", "house", "install", "integrations", "kernels", "python", "reference", "robustness",
                "validation"}
MOST_LINES, MOST_KERNEL_LINES, MOST_FUNCTION_LINES = 300, 200, 60


SPDX = "SPDX-License-Identifier: Apache-2.0"
# A comment of one line is written so, by the end of a file's name; other files carry no such line.
COMMENTS = {"// {}": (".cpp", ".hpp", ".h", ".c", ".cl", ".clh", ".cu", ".js", ".hpp.in"), "/* {} */": (".css",), "<!-- {} -->": (".html",),
            "# {}": (".py", ".sh", ".cmake", ".cmake.in", ".pc.in", ".yml", "CMakeLists.txt", "pyproject.toml", "dev", ".ci/run")}
# Inputs of the program and of tests.
NOT_SOURCES = ("build", "out", "bundle", "tests/fuzz/corpus", "tests/reference/oracle", "tests/reference/scenes")


def sources(root):
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in SUFFIXES:
                yield path


def misformatted(root):
    program = shutil.which("clang-format-14") or shutil.which("clang-format")
    version = subprocess.run([program, "--version"], capture_output=True, text=True).stdout if program else ""
    if "version 14." not in version:
        print("clang-format 14 is not installed: other versions format differently")
        sys.exit(SKIPPED)
    files = [str(path) for path in sources(root)]
    done = subprocess.run([program, "--dry-run", "--ferror-limit=1", *files], capture_output=True, text=True)
    found = sorted(set(re.findall(r"^(.*?):\d+:\d+: warning: code should be clang-formatted", done.stderr, re.M)))
    return [f"{pathlib.Path(name).relative_to(root)}: run clang-format -i on it" for name in found]


def misnamed(root):
    faults = []
    hosts = {path.name for path in (root / "host").iterdir()}
    for path in sorted((root / "tests").glob("*/*.cpp")):
        name = path.relative_to(root)
        has_tests = re.search(r"^TEST_CASE", path.read_text(), re.M) is not None
        if has_tests and not path.stem.endswith("_test"):
            faults.append(f"{name}: it has test cases, so its name ends in _test.cpp")
        if not has_tests and path.stem.endswith("_test"):
            faults.append(f"{name}: it has no test case, so its name does not end in _test.cpp")
    for path in sorted((root / "tests").iterdir()):
        if path.is_dir() and path.name not in hosts | OF_THE_WHOLE:
            faults.append(f"tests/{path.name}: no folder of host/ has this name")
    return faults


def long_functions(lines):
    """(name, lines) of functions, and of those in classes at the margin, as clang-format lays them out."""
    for margin in ("", "  "):
        header, begin = None, None
        for number, line in enumerate(lines):
            at_margin = line.startswith(margin) and line[len(margin):len(margin) + 1] not in ("", " ", "}", "#", "/")
            if begin is None and at_margin:
                header = number
            if begin is None and header is not None and line.endswith("{"):
                text = " ".join(lines[header:number + 1]).strip()
                scope = re.match(r"(typedef )?(namespace|extern|struct|class|enum|union|inline namespace)\b", text)
                scope = scope or re.match(r"(for|if|while|switch|do|else|try|return)\b|[^(]*[=\[\]{.]", text)
                begin = None if scope or "(" not in text else header
                header = None
            elif begin is None and line.endswith((";", "}", ":")):
                header = None
            elif begin is not None and line.startswith(margin + "}"):
                if number - begin + 1 > MOST_FUNCTION_LINES:
                    text = " ".join(lines[begin:number])
                    test = re.match(r'\s*TEST_CASE\("([^"]*)"', text)
                    yield test[1] if test else text.split("(")[0].split()[-1].lstrip("*&"), number - begin + 1
                begin, header = None, None


def large(root):
    found = {}
    for path in sources(root):
        name = str(path.relative_to(root))
        lines = [line for line in path.read_text().splitlines() if not line.endswith(SPDX)]
        most = MOST_KERNEL_LINES if name.startswith("kernels/") else MOST_LINES
        if len(lines) > most:
            found[name] = f"{len(lines)} lines, where {most} are the limit"
        for function, count in long_functions(lines):
            found[f"{name} {function}"] = f"{count} lines, where {MOST_FUNCTION_LINES} are the limit"
    return found


def wrong_sizes(root):
    listed = [line for line in (root / "tests/house/large.txt").read_text().splitlines() if line and line[0] != "#"]
    found = large(root)
    for name, why in found.items():
        print(f"{name}: {why}")
    new = [f"{name}: {why}; split it" for name, why in found.items() if name not in listed]
    return new + [f"tests/house/large.txt: {name} is no longer too large: remove the line" for name in listed
                  if name not in found]


def types_twice(root):
    files = {}
    for path in sources(root):
        if path.relative_to(root).parts[0] not in ("host", "include") or path.suffix not in (".cpp", ".hpp"):
            continue
        spaces = []
        for line in path.read_text().splitlines():
            opened = re.match(r"namespace( [\w:]+)? \{", line)
            defined = re.match(r"(?:struct|class|enum class|enum) (\w+)(?: final)?(?: :[^;]*)?\s*\{", line)
            if opened:
                spaces.append(opened[1] or "")
            elif line.startswith("}  // namespace") and spaces:
                spaces.pop()
            elif defined and "" not in spaces:
                files.setdefault("::".join(spaces).replace(" ", "") + "::" + defined[1], []).append(path.relative_to(root))
    return [f"{name}: " + " and ".join(map(str, where)) for name, where in files.items() if len(set(where)) > 1]


def unmeasured(root):
    rows = (root / "bench" / "kernel_costs.cpp").read_text()
    kernel_table.try_the_checks()
    faults = kernel_table.faults(root)
    for path in sorted((root / "kernels").glob("*/*.cl")):
        if path.stem.startswith(("radix_sort", "bitonic_sort")):
            continue
        for kernel in sorted(set(re.findall(r"\bkernel void (\w+)\(", path.read_text()))):
            if f'{{"{path.stem}/{kernel}",' not in rows:
                faults.append(f"{path.relative_to(root)}: {kernel} has no row in bench/kernel_costs.cpp")
    for path in sorted((root / "host").glob("*/*.[ch]pp")):
        if path.parent.name != "gpu" and re.search(r"\bgpu::Kernel\b|\.kernel\((?!\))", path.read_text()):
            faults.append(f"{path.relative_to(root)}: a kernel without its declaration; use gpu::KernelOf")
    return faults


# The files beside the folders of the project: compilers and tools leave others there.
TOP_FILES = {".clang-format", ".gitignore", "CHANGELOG.md", "CITATION.cff", "CMakeLists.txt", "CMakePresets.json", "CONTRIBUTING.md",
             "Containerfile", "LICENSE", "README.md", "SECURITY.md", "dev", "packages-test.txt", "packages.txt", "pyproject.toml"}


def stray_files(root):
    listed = subprocess.run(["git", "-C", root, "ls-files"], capture_output=True, text=True)
    strays = sorted(name for name in listed.stdout.splitlines() if "/" not in name and name not in TOP_FILES)
    return [f"{name}: it is no file of the project's top folder (TOP_FILES in tests/house/house.py): remove it" for name in strays]


def project_faults(root):
    faults = stray_files(root)

    def found(name, pattern):
        match = re.search(pattern, (root / name).read_text(), re.M)
        return match[1] if match else None

    version = found("CMakeLists.txt", r"^project\(wavetracer VERSION ([0-9.]+)")
    named = {"CHANGELOG.md": found("CHANGELOG.md", r"^## \[([0-9.]+)\]"), "CITATION.cff": found("CITATION.cff", r"^version: (.*)$")}
    faults += [f"{name}: it names version {told}, and CMakeLists.txt {version}" for name, told in named.items() if told != version]
    for file in ("python/wavetracer/_library.py", "python/wavetracer/kernels.py"):
        soname = found(file, r'^SONAME = "libwavetracer(?:_kernels)?.so.([0-9.]+)"')
        if soname != ".".join(version.split(".")[:2]):
            faults.append(f"{file}: SONAME is of {soname}, and CMakeLists.txt of {version}")

    if found("CMakeLists.txt", r"^option\(WAVETRACER_WERROR .* (ON|OFF)\)") != "OFF":
        faults.append("CMakeLists.txt: WAVETRACER_WERROR is not OFF by default, so a newer compiler stops a packager")
    for preset in json.loads((root / "CMakePresets.json").read_text())["configurePresets"]:
        keys = preset["cacheVariables"]  # warnings are those of GCC
        if "CMAKE_CXX_COMPILER" not in keys and keys.get("WAVETRACER_WERROR") != "ON":
            faults.append(f"CMakePresets.json: {preset['name']} lets warnings pass")

    own = set(re.findall(r"^part (\w+)", (root / ".ci/run").read_text(), re.M))
    hosted = set(found(".github/workflows/checks.yml", r"part: \[(.*)\]").split(", "))
    if own != hosted:
        faults.append(f".github/workflows/checks.yml: its parts are {sorted(hosted)}, and those of .ci/run {sorted(own)}")
    return faults


def unlicensed(root):
    listed = subprocess.run(["git", "-C", root, "ls-files", "-co", "--exclude-standard"], capture_output=True, text=True)
    names = listed.stdout.splitlines() if listed.returncode == 0 else [str(p.relative_to(root)) for p in root.rglob("*") if p.is_file()]
    faults = []
    for name in sorted(names):
        style = next((style for style, ends in COMMENTS.items() for end in ends if name == end or name.endswith(end if end[0] == "." else "/" + end)), None)
        if not style or name.startswith(tuple(folder + "/" for folder in NOT_SOURCES)) or not (root / name).is_file():
            continue
        lines = (root / name).read_text(encoding="utf-8").splitlines()
        if lines and (lines[0].startswith("#!") or lines[0].lower().startswith("<!doctype")):
            lines.pop(0)
        if not lines or lines[0] != style.format(SPDX):
            faults.append(f"{name}: its first line is not {style.format(SPDX)}")
    return faults


# Words that begin a relative clause or a genitive without a main clause.
BARE = r"(?:Of|What|Whatever|Who|Whoever|Whose|Whether|Which|Where|How|Likewise)\b"
BARE_SENTENCE = r"(?<=[.?!] )(?:Of|What|Whatever|Who|Whoever|Whose|Whether|Likewise)\b"
ENGLISH_FOLDERS = (*FOLDERS, "cmake", "docs", "python")
ENGLISH_FILES = ("CMakeLists.txt", "dev", ".ci/run")
ENGLISH_SUFFIXES = SUFFIXES | {".py", ".cmake", ".sh", ".js", ".txt", ".map", ".supp"}


def comments(lines, mark):
    """(number of the first line, text) of every comment: lines of comments that follow each other are one."""
    block, begin = [], 0
    for number, line in enumerate([*lines, ""], 1):
        alone = re.match(rf"\s*(?:{mark}(?!##)|/\*)\s?(.*)", line)  # ### is a heading in a text
        if alone and not (mark == "#" and line.startswith("#!")) and "SPDX-License-Identifier" not in line:
            begin = begin if block else number
            block.append(alone[1].strip())
            continue
        if block:
            yield begin, " ".join(block)
            block = []
        behind = re.match(rf"[^\"']*\S\s+(?:{mark}|/\*) (.*)", line)
        if behind:
            yield number, behind[1][:1].upper() + behind[1][1:]


def docstrings(text):
    """(number of the first line, text) of every docstring of a Python source."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef)) and ast.get_docstring(node):
            yield node.body[0].lineno, " ".join(ast.get_docstring(node).split())


def bare_comments(root):
    paths = [path for folder in ENGLISH_FOLDERS for path in sorted((root / folder).rglob("*"))
             if path.suffix in ENGLISH_SUFFIXES and path.is_file()]
    faults = []
    for path in [*paths, *(root / name for name in ENGLISH_FILES)]:
        name = str(path.relative_to(root))
        if "/corpus/" in name:
            continue
        mark = "//" if path.suffix in SUFFIXES | {".js"} else "#"
        text = path.read_text(errors="replace")
        found = [*comments(text.splitlines(), mark), *(docstrings(text) if path.suffix == ".py" else [])]
        for number, text in found:
            bare = re.match(BARE, text) or re.search(BARE_SENTENCE, text)
            if bare:
                faults.append(f"{name}:{number}: the comment has a bare \"{bare[0]}\": say who does what: {text[:60]}")
    return faults


CHECKS = {"format": misformatted, "names": misnamed, "sizes": wrong_sizes, "types": types_twice,
          "kernels": unmeasured, "english": bare_comments, "project": project_faults, "licence": unlicensed}


def main():
    if len(sys.argv) != 3 or sys.argv[2] not in CHECKS:
        sys.exit(__doc__)
    faults = CHECKS[sys.argv[2]](pathlib.Path(sys.argv[1]).resolve())
    for fault in faults:
        print("FAULT " + fault)
    sys.exit(1 if faults else 0)


main()
