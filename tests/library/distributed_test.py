# SPDX-License-Identifier: Apache-2.0
"""wavetracer.distributed: a drive on a Dask cluster of two workers, one of which is killed in the middle, and as a job
array of Slurm, are the bytes that one process writes. distributed_test.py PROGRAM SOURCE
Answers 77 (skipped) without dask.distributed or an OpenCL device."""
import contextlib
import filecmp
import os
import pathlib
import pickle
import signal
import stat
import subprocess
import sys
import tempfile
import time

try:
    from dask.distributed import Client, LocalCluster
    import dask
except ImportError:
    sys.exit(77)

import wavetracer.distributed as wd

PROGRAM, SOURCE = sys.argv[1:3]
if subprocess.run([PROGRAM, "devices"], capture_output=True).returncode != 0:
    sys.exit(77)

FRAMES, PARTS = 24, 6
CONFIG = f"""scene.file = "{SOURCE}/configs/scenes/room/room.xml"
trace.rays = 2000
trace.max_depth = 2
output.shard_frames = 3
time.step_s = 0.1
[[station]]
name = "lamp"
position_m = [1, 1, 2.5]
[[track]]
id = "truck"
type = "passenger"
waypoints = [[0, 3, 2, 0], [{(FRAMES - 1) / 10}, 5, 4, 0]]
[[mount]]
name = "roof"
offset_m = [0, 0, 1.8]
"""


def written(path, text, executable=False):
    path.write_text(text)
    if executable:
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
    return path


def check_same(folder, expected):
    for name in ("paths.h5", "links.csv"):
        assert filecmp.cmp(folder / name, expected / name, shallow=False), f"{folder / name} is not {expected / name}"
    assert (expected / "paths.h5").stat().st_size > 50_000


def processes_of(folder):
    """Command lines of processes that compute for this folder."""
    found = []
    for entry in pathlib.Path("/proc").iterdir():
        with contextlib.suppress(OSError, ValueError):
            int(entry.name)
            line = (entry / "cmdline").read_bytes().decode(errors="replace").replace("\0", " ")
            if f"-o {folder}" in line and int(entry.name) != os.getpid():
                found.append(line)
    return found


def wait_until(what, condition, seconds=60):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, f"waited {seconds} s until {what}"
        time.sleep(0.02)


def fails(call, *words):
    try:
        call()
    except wd.DriveError as error:
        assert all(word in str(error) for word in words), (words, str(error))
        return error
    raise AssertionError(f"no DriveError with {words}")


def killed_in_the_middle(client, config, folder, expected):
    """One worker is killed while both compute. Every part waits in a file of the test until that has happened."""
    gate = folder.with_suffix(".gate")
    slow = written(folder.with_suffix(".sh"), f'#!/bin/sh\nwhile [ ! -e "{gate}" ]; do sleep 0.05; done\n'
                   f'exec "{PROGRAM}" "$@"\n', executable=True)
    job = wd.Job(str(config), str(folder), PARTS, program=(str(slow),))
    workers = client.run(os.getpid)
    assert len(workers) == 2
    futures, whole = wd.submit(job, client=client)
    wait_until("both workers have begun", lambda: len(list(job.folder.glob(".*"))) == 2)
    wait_until("both programs run", lambda: len(processes_of(job.folder)) == 2)
    os.kill(next(iter(workers.values())), signal.SIGKILL)
    wait_until("the program of the killed worker has ended with it", lambda: len(processes_of(job.folder)) <= 1)
    assert not any(future.done() for future in futures)
    gate.touch()
    outcome = whole.result(timeout=240)
    assert outcome == {"folder": str(folder)}, outcome
    check_same(folder, expected)
    assert not job.folder.exists()  # the parts are merged
    assert set(client.run(os.getpid).values()) != set(workers.values())  # the killed one was replaced


def tried_again(client, config, folder, expected):
    """The program fails at its first start of each part with what may be different next time."""
    once = written(folder.with_suffix(".sh"), f'#!/bin/sh\nmark="{folder}.$(echo "$*" | sed "s/.*--shard //; s,/.*,,")"\n'
                   f'[ "$1" = merge ] || [ -e "$mark" ] || {{ touch "$mark"; echo "out of memory" >&2; exit 4; }}\n'
                   f'exec "{PROGRAM}" "$@"\n', executable=True)
    steps = []
    assert wd.run(config, folder, client=client, parts=2, program=[once], retries=1, keep_parts=True,
                  progress=lambda done, parts: steps.append((done, parts))) == folder
    assert steps == [(1, 2), (2, 2)], steps
    check_same(folder, expected)
    assert len(list((folder / "parts").iterdir())) == 2
    # Whole parts are not computed again: the next call only merges.
    (folder / "paths.h5").unlink()
    never = written(folder.with_suffix(".never.sh"), f'#!/bin/sh\n[ "$1" = merge ] && exec "{PROGRAM}" "$@"\nexit 1\n',
                    executable=True)
    wd.run(config, folder, client=client, parts=2, program=[never])
    check_same(folder, expected)


def mistakes(client, folder):
    wrong = written(folder.with_suffix(".toml"), CONFIG.replace("max_depth", "max_deph"))
    error = fails(lambda: wd.run(wrong, folder, client=client, parts=3, program=PROGRAM, retries=5),
                  f"{wrong.name}:3", 'did you mean "trace.max_depth"', "exit code 2")
    assert error.code == 2 and pickle.loads(pickle.dumps(error)).code == 2
    wait_until("the other parts are given up", lambda: not list((folder / "parts").glob("*")))
    fails(lambda: wd.run(wrong, folder, client=client, parts=1, program="no-such-wavetracer"), "no such program")
    # A part that fails every time fails for good after the retries, and the error has the program's message.
    broken = written(folder.with_suffix(".sh"), "#!/bin/sh\necho the device is gone >&2\nexit 4\n", executable=True)
    fails(lambda: wd.run(wrong, folder, client=client, parts=1, program=[broken], retries=1), "the device is gone",
          "exit code 4")
    for parts in (0, -1):
        try:
            wd.Job("a.toml", "out", parts)
        except ValueError as error:
            assert "at least one part" in str(error)
        else:
            raise AssertionError(parts)


def given_up(client, config, folder, expected):
    """A cancelled drive leaves no process, and the next call computes it."""
    forever = written(folder.with_suffix(".sh"), "#!/bin/sh\nexec sleep 1000\n", executable=True)
    job = wd.Job(str(config), str(folder), 2, program=(str(forever),))
    futures, whole = wd.submit(job, client=client)
    wait_until("both workers have begun", lambda: len(list(job.folder.glob(".*"))) == 2)
    wd.cancel([*futures, whole], client=client)
    wait_until("nothing is left", lambda: not list(job.folder.glob(".*")))
    assert not processes_of(job.folder)
    wd.run(config, folder, client=client, parts=2, program=PROGRAM)
    check_same(folder, expected)


def as_command(cluster, config, folder, expected):
    done = subprocess.run([sys.executable, "-m", "wavetracer.distributed", "--dask", cluster.scheduler_address, "-c",
                           config, "-o", folder, "--parts", "2", "--program", PROGRAM], capture_output=True, text=True)
    assert done.returncode == 0 and done.stdout == f"{folder}: written\n", (done.stdout, done.stderr)
    assert "part 2 of 2 is done" in done.stderr
    check_same(folder, expected)


SBATCH = r"""#!/bin/sh
# A stand-in for Slurm: it runs the tasks of a job array one after the other, and jobs only after those they depend on.
echo "$*" >> sbatch.log
script=$(mktemp ./job.XXXXXX)
cat > "$script"
for word in "$@"; do
  case "$word" in
    --array=*) tasks=$(echo "${word#--array=}" | sed 's/,/ /g'); case "$tasks" in *-*) tasks=$(seq "${tasks%-*}" "${tasks#*-}") ;; esac ;;
    --dependency=afterok:*) [ -e "ok.${word#*:}" ] || exit 1 ;;
  esac
done
number=$(ls job.?????? | wc -l)
for task in ${tasks:-none}; do
  SLURM_ARRAY_TASK_ID=$task sh "$script" >> job.log 2>&1 || { echo "$number"; exit 0; }
done
touch "ok.$number"
echo "$number;cluster"
"""


def on_slurm(config, folder, expected):
    place = folder.with_suffix(".slurm")
    place.mkdir()
    written(place / "sbatch", SBATCH, executable=True)
    before, path = os.getcwd(), os.environ["PATH"]
    os.chdir(place)
    os.environ["PATH"] = f"{place}:{path}"
    try:
        array, whole = wd.submit_slurm(config, folder, parts=3, program=PROGRAM, sbatch=["--gpus=1"])
        log = (place / "sbatch.log").read_text()
        assert "--array=0-2" in log and "--gpus=1" in log and f"--dependency=afterok:{array}" in log, log
        assert (array, whole) == ("1", "2"), (place / "job.log").read_text()
        check_same(folder, expected)
        assert not (folder / "parts").exists()
        # The script of the examples does the same by itself.
        other = folder.with_suffix(".by_hand")
        os.environ["PATH"] = f"{place}:{pathlib.Path(PROGRAM).parent}:{path}"
        script = pathlib.Path(SOURCE, "configs/slurm.sh")
        for task in range(3):
            subprocess.run(["sh", script, config, other], check=True, capture_output=True,
                           env={**os.environ, "SLURM_ARRAY_TASK_ID": str(task), "SLURM_ARRAY_TASK_COUNT": "3"})
        subprocess.run(["sh", script, "merge", other], check=True, capture_output=True)
        check_same(other, expected)
    finally:
        os.chdir(before)
        os.environ["PATH"] = path


def main(folder):
    config, one = written(folder / "a.toml", CONFIG), folder / "one"
    subprocess.run([PROGRAM, "run", "-c", config, "-o", one], check=True, capture_output=True)
    on_slurm(config, folder / "slurm", one)
    dask.config.set({"distributed.comm.timeouts.connect": "20s"})
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None,
                      local_directory=str(folder)) as cluster, Client(cluster) as client:
        killed_in_the_middle(client, config, folder / "killed", one)
        tried_again(client, config, folder / "again", one)
        mistakes(client, folder / "wrong")
        given_up(client, config, folder / "forever", one)
        as_command(cluster, config, folder / "command", one)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as made:
        main(pathlib.Path(made))
    print("distributed: as one process, by Dask with a killed worker and by a job array")
