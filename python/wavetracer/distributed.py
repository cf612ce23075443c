# SPDX-License-Identifier: Apache-2.0
"""Drives on clusters that others run: Dask (dask.distributed) and Slurm.

A drive is cut into N parts, each of which depends on the configuration alone. Part K is

    wavetracer run -c CONFIG -o FOLDER --shard K/N

on whatever machine, and `wavetracer merge` joins the parts to the files that one process would have written, byte for
byte, if it was given the configuration by its absolute path, as parts are. This module hands those two commands to a scheduler and does nothing else: the scheduler decides where a part is
computed, tries it again when a worker dies, and shows how far the drive is.

    from dask.distributed import Client
    import wavetracer.distributed as wd

    wd.run("drive.toml", "out/drive", client=Client("tcp://scheduler:8786"))       # Dask
    wd.submit_slurm("drive.toml", "out/drive", parts=16, sbatch=["--gpus=1"])      # Slurm: a job array and a merge

All workers need the program `wavetracer`, this module, and the same view of the files: the configuration, what it names,
and the folder of the results, at the same paths. Give every worker one device and one thread (`dask worker --nthreads 1`).
Only the standard library is needed until `run` is called, which takes dask.distributed from its client.
"""
from __future__ import annotations

import argparse
import collections
import dataclasses
import logging
import os
import pathlib
import shlex
import shutil
import signal
import socket
import subprocess
import sys
import threading
import uuid
from collections.abc import Iterable, Mapping
from typing import Any

__all__ = ["DriveError", "Job", "cancel", "merge", "run", "submit", "submit_slurm"]

log = logging.getLogger("wavetracer.distributed")

# Exit codes of the program: usage or configuration, input, parts missing. A retry would end the same way.
_FINAL_CODES = {2, 3, 5}
_MISSING = ("dask.distributed is not installed: install it with `pip install distributed`, or use submit_slurm, which "
            "needs no Python package")


class DriveError(RuntimeError):
    """A part, or the merge, has failed for good. `code` is the program's exit code, or None if it gave none."""

    def __init__(self, text: str, code: int | None = None) -> None:
        super().__init__(text, code)
        self.code = code

    def __str__(self) -> str:
        return str(self.args[0])


def _texts(sets: Any) -> tuple[str, ...]:
    """The texts KEY=VALUE of keys that are set over a configuration, with values in TOML."""
    if isinstance(sets, Mapping):
        from . import _toml
        return tuple(_toml.sets(sets))
    if isinstance(sets, (str, bytes)) or not isinstance(sets, Iterable):
        raise TypeError(f"sets is a dict, or a list of texts KEY=VALUE, not {sets!r}")
    out = tuple(sets)
    for text in out:
        if not isinstance(text, str) or "=" not in text:
            raise TypeError(f"sets has {text!r}, which is no text KEY=VALUE; a dict may have values of Python")
    return out


@dataclasses.dataclass(frozen=True)
class Job:
    """A drive and the number of its parts. Two jobs with the same fields compute the same.

    config, output  the TOML file, and the folder of the results; made absolute here
    parts           number of parts, N of `--shard K/N`; parts that the drive is too short for are empty
    sets            texts KEY=VALUE, as after --set, or a dict; kept as texts
    frames          text A:B, as after --frames; empty: all frames
    device          text, as after --device; empty: the program chooses
    program         the command to start, a text or a sequence of words
    environment     pairs (name, value) that the program gets besides its worker's environment
    """

    config: str
    output: str
    parts: int
    sets: tuple[str, ...] = ()
    frames: str = ""
    device: str = ""
    program: tuple[str, ...] = ("wavetracer",)
    environment: tuple[tuple[str, str], ...] = ()

    def __post_init__(self) -> None:
        if isinstance(self.parts, bool) or not isinstance(self.parts, int):
            raise TypeError(f"parts is the number of parts, not {self.parts!r}")
        if self.parts < 1:
            raise ValueError(f"parts = {self.parts}: a drive has at least one part")
        for name in ("frames", "device"):
            if not isinstance(getattr(self, name), str):
                raise TypeError(f"{name} is a text, as after --{name}, not {getattr(self, name)!r}")
        program = shlex.split(self.program) if isinstance(self.program, str) else self.program
        for name, value in (("config", str(pathlib.Path(self.config).absolute())),
                            ("output", str(pathlib.Path(self.output).absolute())), ("sets", _texts(self.sets)),
                            ("program", tuple(map(str, program))),
                            ("environment", tuple(dict(self.environment).items()))):
            object.__setattr__(self, name, value)

    @property
    def folder(self) -> pathlib.Path:
        """The folder of the parts until they are merged."""
        return pathlib.Path(self.output) / "parts"

    def part_folder(self, index: int) -> pathlib.Path:
        """The folder of a part, which appears when the part is complete."""
        return self.folder / f"{index:05d}_of_{self.parts:05d}"

    def part_command(self, index: int, folder: str | pathlib.Path) -> list[str]:
        command = [*self.program, "run", "-c", self.config, "-o", str(folder), "--shard", f"{index}/{self.parts}"]
        for text in self.sets:
            command += ["--set", text]
        for option, value in (("--frames", self.frames), ("--device", self.device)):
            if value:
                command += [option, value]
        return command

    def merge_command(self) -> list[str]:
        folders = [str(self.part_folder(index)) for index in range(self.parts)]
        return [*self.program, "merge", "-o", self.output, *folders]


# --- on the workers --------------------------------------------------------------------------------------------------

_running: dict[str, set[Any]] = collections.defaultdict(set)  # processes of this worker, by the token of what was submitted
_stopped: set[str] = set()                   # tokens of what was given up
_lock = threading.Lock()

# The program ends with its worker, even if that is killed: a part that is retried elsewhere should not be computed
# twice. The kernel sends the signal to children of a thread that has ended, and workers keep their threads.
_WITH_PARENT = ("import ctypes, os, sys\n"
                "ctypes.CDLL(None).prctl(1, 9)\n"  # PR_SET_PDEATHSIG, SIGKILL
                "os.getppid() == int(sys.argv[1]) or sys.exit(1)\n"
                "os.execvp(sys.argv[2], sys.argv[2:])\n")


def _start(command: list[str], environment: tuple[tuple[str, str], ...]) -> Any:
    words = list(command)
    if shutil.which(words[0]) is None:
        raise FileNotFoundError(f"{words[0]}: there is no such program on {socket.gethostname()}; install wavetracer "
                                "there, or give program=")
    if sys.platform == "linux":
        words = [sys.executable, "-c", _WITH_PARENT, str(os.getpid()), *words]
    return subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                            text=True, errors="replace", env={**os.environ, **dict(environment)})


def _call(job: Job, token: str, command: list[str], what: str) -> dict[str, Any] | None:
    """Runs a command of a job; its messages go to the log of the worker. Returns None if it succeeds, or {"error":
    text, "code": exit code} if another attempt would fail in the same way; else raises DriveError."""
    last: collections.deque[str] = collections.deque(maxlen=20)
    try:
        process = _start(command, job.environment)
    except FileNotFoundError as error:
        return {"error": str(error), "code": 2}
    with _lock:
        _running[token].add(process)
        if token in _stopped:
            process.kill()
    try:
        for line in process.stderr:
            last.append(line.rstrip())
            log.info("%s", line.rstrip())
        code = process.wait()
    finally:
        process.kill()
        process.wait()
        process.stderr.close()
        with _lock:
            _running[token].discard(process)
    if code == 0:
        return None
    text = f"{what} on {socket.gethostname()} has failed"
    text += f" with exit code {code}" if code > 0 else f", ended by signal {signal.Signals(-code).name}"
    text = "\n  ".join([text + (":" if last else ""), *last])
    if code in _FINAL_CODES:
        return {"error": text, "code": code}
    raise DriveError(text, code)


def compute_part(job: Job, index: int, token: str = "") -> dict[str, Any]:
    """Computes a part and returns {"folder": its folder}, or {"error": text, "code": exit code} if another attempt
    would fail in the same way. Other failures raise DriveError. A part that is there already is not computed again.

    Every attempt writes to a folder of its own, which gets the name of the part when it is whole. So an attempt that was
    given up, and may still be running somewhere, disturbs no other one."""
    final = job.part_folder(index)
    if final.is_dir():
        return {"folder": str(final)}
    attempt = final.with_name(f".{final.name}.{socket.gethostname()}.{uuid.uuid4().hex[:12]}")
    try:
        attempt.mkdir(parents=True)
        failure = _call(job, token, job.part_command(index, attempt), f"part {index} of {job.parts}")
        if failure:
            return failure
        try:
            attempt.rename(final)
        except OSError:
            if not final.is_dir():  # else another attempt was faster, and has the same contents
                raise
        return {"folder": str(final)}
    finally:
        shutil.rmtree(attempt, ignore_errors=True)


def merge(job: Job, parts: Any = (), keep_parts: bool = False, token: str = "") -> dict[str, Any]:
    """Joins the parts of a job to its results and removes them; returns {"folder": the results} or {"error", "code"}.
    parts: what compute_part returned, of which the first error is handed on."""
    for part in parts:
        if "error" in part:
            return dict(part)
    failure = _call(job, token, job.merge_command(), "the merge")
    if failure:
        return failure
    if not keep_parts:
        shutil.rmtree(job.folder, ignore_errors=True)
    return {"folder": job.output}


def _stop(token: str) -> None:
    """Ends this worker's processes of jobs submitted under the token, and lets it start no more of them.
    """
    with _lock:
        _stopped.add(token)
        for process in _running[token]:
            process.kill()


# --- on a Dask cluster -----------------------------------------------------------------------------------------------

def _client(client: Any) -> Any:
    try:
        from dask import distributed
    except ImportError:
        raise ImportError(_MISSING) from None
    if client is None:
        try:
            client = distributed.get_client()
        except ValueError:
            raise ValueError("there is no Dask client: give client=Client(ADDRESS), or client=Client() for workers on "
                             "this machine") from None
    if getattr(client, "asynchronous", False):
        raise ValueError("this is an asynchronous client: use submit(), and await its futures")
    return client


def _default_parts(client: Any) -> Any:
    """Four parts for every thread of the cluster, so that it stays busy when parts take different times."""
    return 4 * max(1, sum(client.nthreads().values()))


def submit(job: Job, *, client: Any, retries: int = 2, keep_parts: bool = False, **options: Any) -> Any:
    """Submits a job without waiting. Returns (part futures, merge future), tasks of Dask named wavetracer-part and
    wavetracer-merge; each gives what compute_part and merge return.

    retries  how often a part that failed is tried again; a worker that dies is counted by Dask itself
             (distributed.scheduler.allowed-failures)
    options  further arguments of Client.submit for the parts: resources={"GPU": 1}, workers=..., priority=..."""
    token = uuid.uuid4().hex[:8]
    parts = [client.submit(compute_part, job, index, token, key=f"wavetracer-part-{token}-{index:05d}", retries=retries,
                           pure=False, **options) for index in range(job.parts)]
    whole = client.submit(merge, job, parts, keep_parts, token, key=f"wavetracer-merge-{token}", retries=retries, pure=False)
    return parts, whole


def cancel(futures: Any, *, client: Any) -> None:
    """Cancels the futures that submit() has returned: takes the tasks from the cluster and ends the processes that
    compute them."""
    futures = list(futures)
    client.cancel(futures, force=True)
    for token in {str(future.key).split("-")[2] for future in futures}:
        client.run(_stop, token)


def _result(future: Any, job: Job) -> Any:
    from dask import distributed
    try:
        return future.result()
    except distributed.KilledWorker as killed:
        raise DriveError(f"{future.key}: {killed.last_worker and killed.last_worker.address} and workers before it died "
                         "while they computed it, most often for lack of memory: give workers more of it, or lower "
                         "trace.batch_rays. What is finished is kept: the same call goes on from there") from killed
    except distributed.CancelledError:
        raise DriveError(f"{future.key} was cancelled; the same call with {job.parts} parts goes on from there") from None


def run(config: Any, output: Any, *, client: Any = None, parts: int | None = None, sets: Any = (), frames: str = "",
        device: str = "", program: Any = "wavetracer", environment: Any = (), retries: int = 2, keep_parts: bool = False,
        progress: Any = None, **options: Any) -> pathlib.Path:
    """Computes a drive on a Dask cluster and returns the folder of its results.

    config, output  the TOML file, and the folder of the results, as all workers see them
    client          a dask.distributed.Client; None: the current one
    parts           into how many parts the drive is cut; None: four for every thread of the cluster. More parts than
                    shards (frames / output.shard_frames) are empty, and each part loads the scene anew
    sets            texts KEY=VALUE, as after --set; or a dict of keys and values of Python, as Simulation takes them:
                    {"trace.rays": 10**6, "trace": {"diffraction": True}, "scene.file": "a.xml"}
    frames, device, program, environment   as in Job
    retries, options                       as in submit
    keep_parts      whether the folder OUTPUT/parts stays
    progress        a function (done, parts), called whenever a part is finished

    Parts that an earlier call with the same number of parts has finished are taken as they are; `wavetracer merge`
    refuses those of another configuration, and names the keys that changed. Ctrl-C ends the processes on all workers.
    Raises DriveError."""
    client = _client(client)
    job = Job(str(config), str(output), _default_parts(client) if parts is None else parts, sets, frames,
              device, program, environment)
    futures, whole = submit(job, client=client, retries=retries, keep_parts=keep_parts, **options)
    try:
        _wait(job, futures, progress)
        outcome = _result(whole, job)
        if "error" in outcome:
            raise DriveError(outcome["error"], outcome["code"])
        return pathlib.Path(outcome["folder"])
    except BaseException:
        cancel([*futures, whole], client=client)
        raise


def _wait(job: Job, futures: Any, progress: Any) -> Any:
    from dask import distributed
    for done, future in enumerate(distributed.as_completed(futures), 1):
        outcome = _result(future, job)
        if "error" in outcome:
            raise DriveError(outcome["error"], outcome["code"])
        log.info("part %d of %d is done", done, job.parts)
        if progress:
            progress(done, job.parts)


# --- on Slurm --------------------------------------------------------------------------------------------------------

def slurm_commands(job: Job, sbatch: Any = (), array: str = "") -> tuple[list[str], str, list[str], str]:
    """The two jobs of Slurm as (sbatch words, script): the array of parts, and the merge, whose --dependency is still to
    be added. array: the tasks to start, such as "3,7" for those that failed; empty: all."""
    part = shlex.join(job.part_command(0, "FOLDER")).replace(f"--shard 0/{job.parts}",
                                                             f'--shard "$SLURM_ARRAY_TASK_ID/{job.parts}"')
    folder = shlex.quote(str(job.folder))
    part = part.replace("-o FOLDER", f'-o "$part"')
    exports = "".join(f"export {name}={shlex.quote(value)}\n" for name, value in job.environment)
    script = (f"#!/bin/sh\n{exports}"
              f'part={folder}/$(printf "%05d_of_%05d" "$SLURM_ARRAY_TASK_ID" {job.parts})\n'
              f"exec {part} --resume\n")  # exec, so that the signal before the time limit reaches the program
    whole = f"#!/bin/sh\n{exports}{shlex.join(job.merge_command())} && rm -r {folder}\n"
    array_words = ["sbatch", "--parsable", "--job-name=wavetracer", f"--array={array or f'0-{job.parts - 1}'}",
                   "--requeue", "--signal=B:INT@60", *sbatch]
    return array_words, script, ["sbatch", "--parsable", "--job-name=wavetracer-merge"], whole


def submit_slurm(config: Any, output: Any, *, parts: int, sets: Any = (), frames: str = "", device: str = "",
                 program: Any = "wavetracer", environment: Any = (), sbatch: Any = (), merge_sbatch: Any = (),
                 array: str = "") -> tuple[str, str]:
    """Submits a drive to Slurm: an array of `parts` tasks, and a job that merges when all have ended well. Returns both
    job numbers.

    sbatch, merge_sbatch  further options of the array and of the merge: ["--gpus=1", "--time=04:00:00"]
    array                 tasks to start, such as "3,7", where others are finished; empty: all

    A task that is preempted or reaches its time limit goes on where it was when it is started again. Raises DriveError."""
    job = Job(str(config), str(output), parts, sets, frames, device, program, environment)
    array_words, script, merge_words, whole = slurm_commands(job, sbatch, array)
    job.folder.mkdir(parents=True, exist_ok=True)
    number = _sbatch(array_words, script)
    return number, _sbatch([*merge_words, f"--dependency=afterok:{number}", *merge_sbatch], whole)


def _sbatch(words: list[str], script: str | None) -> str:
    try:
        done = subprocess.run(words, input=script, capture_output=True, text=True)
    except FileNotFoundError:
        raise DriveError("there is no sbatch here: call submit_slurm where jobs are submitted to Slurm") from None
    if done.returncode != 0:
        raise DriveError(f"{shlex.join(words)}: {done.stderr.strip()}", done.returncode)
    return done.stdout.strip().split(";")[0]


# --- as a command ----------------------------------------------------------------------------------------------------

def _arguments() -> Any:
    parser = argparse.ArgumentParser(prog="python -m wavetracer.distributed",
                                     description="Computes a drive on a Dask cluster, or submits it to Slurm.")
    where = parser.add_mutually_exclusive_group(required=True)
    where.add_argument("--dask", metavar="ADDRESS", help="scheduler of a Dask cluster, such as tcp://host:8786")
    where.add_argument("--slurm", action="store_true", help="submit a job array and a merge by sbatch")
    parser.add_argument("-c", "--config", required=True, help="config file (TOML)")
    parser.add_argument("-o", "--output", required=True, help="folder for the results, which all workers see")
    parser.add_argument("--parts", type=int, help="number of parts; of Dask's by default four for each thread")
    parser.add_argument("--set", dest="sets", action="append", default=[], metavar="KEY=VALUE")
    parser.add_argument("--frames", default="", metavar="A:B")
    parser.add_argument("--device", default="")
    parser.add_argument("--program", default="wavetracer", help="command to start on the workers")
    parser.add_argument("--sbatch", action="append", default=[], metavar="OPTION", help="option of the job array")
    parser.add_argument("--array", default="", help="tasks of the job array, such as 3,7; all if not given")
    return parser


def main(words: list[str] | None = None) -> int:
    parser = _arguments()
    given = parser.parse_args(words)
    common = dict(sets=given.sets, frames=given.frames, device=given.device, program=given.program)
    try:
        if given.slurm:
            if not given.parts:
                parser.error("--slurm needs --parts, the number of tasks of the job array")
            numbers = submit_slurm(given.config, given.output, parts=given.parts, sbatch=given.sbatch,
                                   array=given.array, **common)
            print("submitted: job array {}, merge {}".format(*numbers))
            return 0
        try:
            from dask.distributed import Client
        except ImportError:
            print(_MISSING, file=sys.stderr)
            return 1
        with Client(given.dask) as client:
            folder = run(given.config, given.output, client=client, parts=given.parts,
                         progress=lambda done, parts: print(f"part {done} of {parts} is done", file=sys.stderr),
                         **common)
        print(f"{folder}: written")
        return 0
    except (DriveError, OSError) as error:
        print(f"error: {error}", file=sys.stderr)
        return getattr(error, "code", None) or 1


if __name__ == "__main__":
    # The module is called by this name, not as __main__, so that workers find the functions that they are sent.
    from wavetracer.distributed import main as named_main
    sys.exit(named_main())
