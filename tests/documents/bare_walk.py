# SPDX-License-Identifier: Apache-2.0
"""Types the commands of documents in a Debian 12 that has nothing but its base, as root, and tells which of them fail.

    bare_walk.py FOLDER [DOCUMENT...] [--mirror ADDRESS] [--ccache FOLDER]

FOLDER becomes the root folder of that system (debootstrap makes it where it is missing, and it is kept); /root/wavetracer
in it is a clone of the last commit. Without names the documents are README.md, docs/tutorial.md, docs/python.md and docs/from-sionna.md. Each
is typed line by line into one shell, as a reader types it, and blocks of Python run with the `python3` of that shell.
The list bare_not_run.txt names the commands that a fresh container cannot run, with reasons. Maps of the reader's own come from
tests/documents/files. --ccache gives a folder of compiled files, which makes the build faster and changes nothing else.
This takes root, debootstrap, a network, some 5 GB, and 20 minutes on two cores: `./dev bare FOLDER` starts it.
"""
import argparse
import os
import pathlib
import shlex
import shutil
import subprocess
import sys
import time

import run_document

here = pathlib.Path(__file__).resolve().parent
project = here.parents[1]
clone = "/root/wavetracer"
marker = "--- the command has ended with "


class Root:
    """A folder with a Debian of its own, whose devices and processes are those of this machine while it is open."""

    def __init__(self, folder, mirror, ccache):
        self.folder, self.mirror, self.mounted = pathlib.Path(folder).resolve(), mirror, []
        self.mounts = {"/proc": "proc", "/sys": "sys", "/dev": "dev"} | ({ccache: "root/.cache/ccache"} if ccache else {})

    def __enter__(self):
        if not (self.folder / "usr/bin").exists():
            subprocess.run(["debootstrap", "--variant=minbase", "--include=ca-certificates", "bookworm",
                            str(self.folder), self.mirror], check=True, stdout=subprocess.DEVNULL)
        shutil.copy("/etc/resolv.conf", self.folder / "etc/resolv.conf")
        if certificates := os.environ.get("PIP_CERT"):
            (self.folder / certificates[1:]).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(certificates, self.folder / certificates[1:])
        shutil.rmtree(f"{self.folder}{clone}", ignore_errors=True)
        subprocess.run(["git", "clone", "-q", str(project), f"{self.folder}{clone}"], check=True)
        for file in (here / "files").iterdir():
            shutil.copy(file, f"{self.folder}{clone}")
        for source, place in self.mounts.items():
            (self.folder / place).mkdir(parents=True, exist_ok=True)
            subprocess.run(["mount", "--bind", source, str(self.folder / place)], check=True)
            self.mounted.append(self.folder / place)
        return self

    def __exit__(self, *_):
        for place in reversed(self.mounted):
            subprocess.run(["umount", "--lazy", str(place)], check=False)

    def shell(self):
        """A login shell of root in the clone."""
        pip = [f"{name}={value}" for name, value in os.environ.items() if name.startswith("PIP_") and name != "PIP_FIND_LINKS"]
        return subprocess.Popen(
            ["chroot", str(self.folder), "/usr/bin/env", "-i", "HOME=/root", "TERM=dumb", "LANG=C.UTF-8", *pip,
             "PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin", "bash", "-c", f"cd {clone} && exec bash"],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")


class Reader:
    """Types commands into one shell, one after the other, so that exports and environments of Python last."""

    def __init__(self, root):
        self.shell = root.shell()

    def type(self, command):
        """(exit code, output) of the command."""
        self.shell.stdin.write(f"{{ {command}\n}} </dev/null\nprintf '\\n{marker}%s\\n' $?\n")
        self.shell.stdin.flush()
        told = []
        for line in self.shell.stdout:
            if line.startswith(marker):
                return int(line[len(marker):]), "".join(told)
            told.append(line)
        return self.shell.wait(), "".join(told)

    def run(self, language, source):
        if language == "python":
            return self.type(f"python3 -c {shlex.quote(source)}")
        return self.type(source)

    def end(self):
        self.shell.stdin.close()
        self.shell.wait()


def walk(root, document):
    """Types all blocks of a document. Returns its faults, and the rows of bare_not_run.txt that it needed."""
    reader, faults, used = Reader(root), [], set()
    listed = [row for row in run_document.not_run(here / "bare_not_run.txt") if row[0] == document.name]
    try:
        for language, line, source in run_document.blocks(document.read_text()):
            if language not in ("sh", "python"):
                continue
            for command in run_document.commands(source) if language == "sh" else [source]:
                if row := next((row for row in listed if row[1].search(command)), None):
                    used.add(row)
                    continue
                start = time.time()
                code, told = reader.run(language, command)
                name = f"{document.name}:{line}: {command.splitlines()[0][:90]}"
                print(f"{time.time() - start:7.1f} s  {'failed' if code else 'done'}  {name}", flush=True)
                if code not in (0, 141):  # 141: `... | head` ended first
                    faults.append(f"{document.name}:{line}: exit code {code} of\n{command}\n{told[-3000:]}")
    finally:
        reader.end()
    return faults + [f"bare_not_run.txt: no command of {row[0]} matches '{row[1].pattern}'" for row in listed if row not in used]


def main():
    parser = argparse.ArgumentParser(usage="bare_walk.py FOLDER [DOCUMENT...] [--mirror ADDRESS] [--ccache FOLDER]")
    parser.add_argument("folder")
    parser.add_argument("documents", nargs="*", default=["README.md", "docs/tutorial.md", "docs/python.md", "docs/from-sionna.md"])
    parser.add_argument("--mirror", default="http://deb.debian.org/debian")
    parser.add_argument("--ccache")
    options = parser.parse_args()
    if os.geteuid() != 0 or not shutil.which("debootstrap"):
        print("skipped: this needs root, and the package debootstrap")
        sys.exit(77)
    faults = []
    with Root(options.folder, options.mirror, options.ccache) as root:
        for document in options.documents:
            faults += walk(root, pathlib.Path(f"{root.folder}{clone}") / document)
    if faults:
        sys.exit("\n".join(faults))
    print("every command ran as it is typed")


if __name__ == "__main__":
    main()
