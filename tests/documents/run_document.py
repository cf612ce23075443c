# SPDX-License-Identifier: Apache-2.0
"""Runs the commands of a document as a reader would: every ```sh and ```python block, in the order of the page.

    run_document.py DOCUMENT --program WAVETRACER --configs FOLDER --examples FOLDER --package FOLDER --shared-object FILE
                    --work FOLDER

The folder of work is made anew and holds what the reader has: the program where `./dev run` builds it, the
configurations, the examples, and the maps of his own that the text speaks of (tests/documents/files). Commands run as
they are typed, with an empty home, the PATH of a fresh Debian and no variables of the caller but those of OpenCL and of
the package, which an installation would need none of. Kernels come from the caller's cache, because compiling them for
each document would take minutes. A command that cannot run in a test is in not_run.txt with a reason; one that fails
and is not there fails the test, and so does a line of not_run.txt that no document needs any more.
Commands inside of sentences (`wavetracer plot DIR`) must name commands and options that exist.
"""
import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

here = pathlib.Path(__file__).resolve().parent


def not_run(file=here / "not_run.txt"):
    """(document, pattern, reason) of every line of the list."""
    rows = []
    for number, line in enumerate(file.read_text().splitlines(), 1):
        if not line.strip() or line.startswith("#"):
            continue
        cells = [cell.strip() for cell in line.split(" | ")]
        if len(cells) != 3 or not all(cells):
            sys.exit(f"{file.name}:{number}: write DOCUMENT | PATTERN | reason")
        rows.append((cells[0], re.compile(cells[1]), cells[2]))
    return rows


def blocks(text):
    """(language, line, source) of all fenced blocks; a fence without a language is output."""
    for match in re.finditer(r"^```([a-z]*)\n(.*?)^```$", text, re.M | re.S):
        yield match[1], text.count("\n", 0, match.start()) + 2, match[2]


def commands(source):
    """Single commands of a shell block: continued lines and here-documents are one."""
    lines, out = source.splitlines(), []
    while lines:
        command = lines.pop(0)
        while command.endswith("\\") and lines:
            command += "\n" + lines.pop(0)
        if here_document := re.search(r"<<\s*'?(\w+)'?", command):
            while lines:
                command += "\n" + lines[0]
                if lines.pop(0) == here_document[1]:
                    break
        if command.strip() and not command.startswith("#"):
            out.append(command)
    return out


def clean_environment(work):
    """The variables of a login on a fresh Debian, with those of the caller that say where OpenCL's drivers are."""
    environment = {name: value for name, value in os.environ.items()
                   if name in ("OCL_ICD_VENDORS", "LD_LIBRARY_PATH") or name.startswith("POCL_")}
    home = work / "home"
    home.mkdir()
    cache = os.environ.get("XDG_CACHE_HOME", pathlib.Path.home() / ".cache")
    return environment | {"HOME": str(home), "LANG": "C.UTF-8", "TERM": "dumb", "XDG_CACHE_HOME": str(cache),
                          "PATH": f"{work / 'bin'}:/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin"}


def prepare(options):
    work = pathlib.Path(options.work)
    shutil.rmtree(work, ignore_errors=True)
    (work / "bin").mkdir(parents=True)
    built = work / "build/release/host/app"
    built.mkdir(parents=True)
    for program in (work / "bin/wavetracer", built / "wavetracer"):
        program.symlink_to(options.program)
    # `python3` must be the one that has the packages, even if another one comes first in the PATH.
    (work / "bin/python3").write_text(f'#!/bin/sh\nexec {sys.executable} "$@"\n')
    (work / "bin/python3").chmod(0o755)
    shutil.copytree(options.configs, work / "configs", symlinks=True)
    for stale in (work / "configs").rglob("*.fcd.xml"):  # of someone who tried it
        stale.unlink()
    shutil.copytree(options.examples, work / "docs/examples")
    for file in (here / "files").iterdir():
        shutil.copy(file, work)
    environment = clean_environment(work)
    environment["PYTHONPATH"] = options.package
    environment["PYTHONDONTWRITEBYTECODE"] = "1"
    environment["WAVETRACER_PROGRAM"] = options.program
    environment["WAVETRACER_LIBRARY"] = options.shared_object
    # This is the drive that a reader has.
    subprocess.run(["wavetracer", "scene", "city", "-o", ".", "--blocks", "2x2", "--vehicles", "4", "--seconds", "0.3"],
                   cwd=work, env=environment, check=True, stdout=subprocess.DEVNULL)
    return work, environment


class Session:
    """One shell for the blocks of a document: exports and folders last, servers end with it."""

    def __init__(self, work, environment):
        self.work, self.environment, self.servers, self.exports = work, environment, [], ""

    def shell(self, command):
        if command.startswith("export "):
            self.exports += command.split("#")[0] + "\n"
        if re.match(r"wavetracer serve ", command):
            return self.serve(command)
        return subprocess.run(["bash", "-c", f"set -eo pipefail\n{self.exports}{command}"], cwd=self.work,
                              env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def serve(self, command):
        log = open(self.work / "serve.log", "w+")
        server = subprocess.Popen(["bash", "-c", "exec " + command], cwd=self.work, env=self.environment, stdout=log,
                                  stderr=log)
        self.servers.append(server)
        for _ in range(600):
            text = (self.work / "serve.log").read_text()
            if "listening on" in text or server.poll() is not None:
                break
            time.sleep(0.1)
        return subprocess.CompletedProcess(command, 0 if server.poll() is None else 1, text)

    def python(self, source):
        return subprocess.run(["/usr/bin/python3", "-c", source], cwd=self.work, env=self.environment,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def end(self):
        for server in self.servers:
            server.terminate()
            server.wait(60)


def misspelt(text, environment, work):
    """Commands in sentences whose command or options do not exist."""
    helps = {}

    def help_of(words):
        key = " ".join(words)
        if key not in helps:
            told = subprocess.run(["wavetracer", "help", *words], cwd=work, env=environment, capture_output=True, text=True)
            helps[key] = told.stdout if told.returncode == 0 else None
        return helps[key]

    prose = re.sub(r"^```.*?^```$", "", text, flags=re.M | re.S)
    for code in re.findall(r"`(wavetracer [a-z][^`]*)`", prose):
        words = code.split()[1:]
        path = [words[0]]
        if words[0] == "scene" and len(words) > 1 and words[1] in ("info", "materials", "city", "radar"):
            path.append(words[1])
        told = help_of(path)
        if told is None:
            yield f"`{code}`: there is no such command"
            continue
        for option in re.findall(r"(?<![\w-])--?[a-z][a-z-]*", " ".join(words[len(path):])):
            if not re.search(rf"(?<![\w-]){re.escape(option)}(?![\w-])", told):
                yield f"`{code}`: {option} is no option of it"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("document")
    for name in ("program", "configs", "examples", "package", "shared-object", "work"):
        parser.add_argument("--" + name, required=True)
    options = parser.parse_args()
    document = pathlib.Path(options.document)
    text = document.read_text()
    work, environment = prepare(options)
    listed = [row for row in not_run() if row[0] == document.name]
    used, faults, done, left = set(), [], 0, 0
    session = Session(work, environment)
    try:
        for language, line, source in blocks(text):
            if language not in ("sh", "python", "c", "cpp", "cmake"):
                continue
            for command in commands(source) if language == "sh" else [source]:
                reason = next((row for row in listed if row[1].search(command)), None)
                if reason:
                    used.add(reason)
                    left += 1
                    continue
                if language not in ("sh", "python"):
                    faults.append(f"{document.name}:{line}: a block of {language} that no test builds")
                    continue
                start = time.time()
                told = session.shell(command) if language == "sh" else session.python(command)
                print(f"{time.time() - start:6.1f} s  {command.splitlines()[0][:100]}", flush=True)
                done += 1
                if told.returncode not in (0, 141):  # 141: `... | head` ended first
                    faults.append(f"{document.name}:{line}: exit code {told.returncode} of\n{command}\n{told.stdout[-2000:]}")
    finally:
        session.end()
    faults += misspelt(text, environment, work)
    faults += [f"not_run.txt: no command of {row[0]} matches '{row[1].pattern}'" for row in listed if row not in used]
    if faults:
        sys.exit("\n".join(faults))
    print(f"{document.name}: {done} commands run, {left} listed in not_run.txt")


if __name__ == "__main__":
    main()
