#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests uses that the Python package refuses with a message: copies, pickles, forked processes, arguments of wrong
types; and threads, which take turns.

Needs wavetracer installed or in PYTHONPATH, and its library in WAVETRACER_LIBRARY. Exits with 77 without numpy or h5py.
"""
import copy
import gc
import multiprocessing
import os
import pathlib
import pickle
import shutil
import signal
import sys
import threading
import traceback

try:
    import h5py  # noqa: F401  (of saved runs)
    import numpy as np
except ImportError:
    sys.exit(77)
import wavetracer
from wavetracer import distributed

CONFIG = {"scene": {"generate": "--seed 1 --blocks 2x2"}, "transmitter": [{"name": "m", "position_m": [8, 8, 12]}],
          "receiver": [{"name": f"p{i}", "position_m": [40 + 10 * i, 3, 1.5]} for i in range(3)],
          "trace": {"rays": 5000, "max_depth": 2}}


def raises(kind, part, function, /, *arguments, **named):
    try:
        function(*arguments, **named)
    except kind as error:
        assert part in str(error), repr(error)
    else:
        raise AssertionError(f"no error with {part}")


def same(paths, wanted):
    for name in ("tx", "rx", "delay_s", "a", "vertex_offset", "vertex_position_m", "vertex_instance", "kind"):
        assert np.array_equal(getattr(paths, name), getattr(wanted, name)), name
    assert not paths.delay_s.flags.writeable
    assert paths.receivers == wanted.receivers and paths.frequency_hz == wanted.frequency_hz
    assert np.array_equal(paths.cfr([0, 1e6]), wanted.cfr([0, 1e6]))
    for name in paths.links.columns:
        assert np.array_equal(paths.links[name], wanted.links[name], equal_nan=name not in ("los",)), name


def check_config_errors(folder):
    """Errors of configurations have the place that the caller knows: a line of a file or a text, a key of a dict."""
    file = folder / "street.toml"
    folder.mkdir(parents=True)
    file.write_text("[trace]\nrays = -4\n")
    wrong = "trace.rays = -4 is out of range"
    for config, sets, whole in ((file, {}, f"{file}:2:8: {wrong}"), (str(file), {}, f"{file}:2:8: {wrong}"),
                                ("[trace]\nrays = -4\n", {}, f"config:2:8: {wrong}"),
                                (CONFIG | {"trace": {"rays": -4}}, {}, wrong), (CONFIG, {"trace": {"rays": -4}}, wrong),
                                (CONFIG, {"trace.rays": -4}, wrong)):
        try:
            wavetracer.Simulation(config, **sets)
        except wavetracer.ConfigError as error:
            assert str(error).startswith(whole), error
        else:
            raise AssertionError(f"no error for {config} with {sets}")


def check_copies(folder):
    """Copies of objects of the library are refused with a hint what to copy instead; values are copied."""
    simulation = wavetracer.Simulation(CONFIG)
    frame = simulation.run_frame()
    copiers = (pickle.dumps, copy.copy, copy.deepcopy, lambda thing: pickle.dumps([thing], 2))
    for copier in copiers:
        raises(TypeError, "pickle frame.paths", copier, frame)
        raises(TypeError, "its attribute `config`", copier, simulation)
    for copier in (copy.copy, copy.deepcopy, lambda thing: pickle.loads(pickle.dumps(thing))):
        for paths in (frame.paths, frame.paths.select(rx="p1"), frame.paths.select(kind="reflected")):
            same(copier(paths), paths)
        assert np.array_equal(copier(frame.links)["path_gain_db"], frame.links["path_gain_db"])
        assert copier(frame.counts).paths == frame.counts.paths
        assert np.array_equal(copier(frame["a"]), frame["a"])
        error = copier(wavetracer.ConfigError("of a key"))
        assert str(error) == "of a key" and error.code == 2 and type(error) is wavetracer.ConfigError
    text = pickle.dumps(frame.paths)
    delay_s = frame.paths.delay_s.copy()
    with simulation.write(folder, [frame]) as run:
        for copier in (copy.copy, copy.deepcopy, lambda thing: pickle.loads(pickle.dumps(thing))):
            again, saved = copier(run), copier(run[0])
            assert np.array_equal(again[0].paths.delay_s, delay_s) and np.array_equal(saved.paths.delay_s, delay_s)
            same(copier(run[0].paths), run[0].paths)
    simulation.close()
    del frame, simulation
    gc.collect()
    assert np.array_equal(pickle.loads(text).delay_s, delay_s)


def check_copied_arrays_and_carriers():
    """Between elements and at other carriers copied paths know what the others know."""
    config = CONFIG | {"array": [{"name": "pair", "positions_m": [[0, -0.1, 0], [0, 0.1, 0.05]]}],
                       "transmitter": [CONFIG["transmitter"][0] | {"array": "pair"}],
                       "radio": {"frequencies_hz": [5.9e9, 28e9]}}
    simulation = wavetracer.Simulation(config)
    paths = simulation.run_frame().paths
    kept = pickle.loads(pickle.dumps(paths))
    simulation.close()
    assert kept.elements()[0].shape == (len(kept), 1, 2)
    assert np.array_equal(kept.at_carrier(1).a, paths.at_carrier(1).a)
    assert kept.select(rx="p2").cfr(0).shape == (1, 1, 1, 2, 1, 1)
    raises(wavetracer.ConfigError, "was closed", pickle.loads(pickle.dumps(paths)).elements)  # as those it was made of


_shared = None


def _old(_):
    return len(_shared.run_frame().paths)


def _new(_):
    with wavetracer.Simulation(CONFIG) as simulation:
        return len(simulation.run_frame().paths)


def in_child(function):
    """The exit code of a forked process that calls this, or minus the signal that ended it; 30 s at most."""
    child = os.fork()
    if child == 0:
        signal.signal(signal.SIGALRM, signal.SIG_DFL)
        signal.alarm(30)
        try:
            function()
        except BaseException:
            traceback.print_exc()
            os._exit(1)
        sys.stdout.flush()
        os._exit(0)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


def check_forks():
    """A forked process is told what to do; it may read frames, and ends."""
    global _shared
    _shared = wavetracer.Simulation(CONFIG)
    frame = _shared.run_frame()
    delay_s = frame.paths.delay_s.copy()
    for function in (_old, _new):
        with multiprocessing.get_context("fork").Pool(2) as pool:
            tasks = pool.map_async(function, range(3))
            raises(wavetracer.RunError, '"spawn"', tasks.get, 60)

    def child():
        assert np.array_equal(frame.paths.delay_s, delay_s) and len(frame.paths.select(rx=0)) > 0
        for function in (_shared.run_frame, _shared.forget, lambda: list(_shared.frames()), wavetracer.devices,
                         lambda: wavetracer.Simulation(CONFIG), lambda: _shared.write("/tmp/never", [frame])):
            raises(wavetracer.RunError, '"spawn"', function)
        _shared.close()

    assert in_child(child) == 0
    # Another thread uses it, until the interpreter ends.
    begun, go_on = threading.Event(), threading.Event()

    class Slow:
        def __init__(self, **_):
            pass

        def set_postfix_str(self, *_, **__):
            begun.set()
            go_on.wait(60)

        def update(self, _):
            pass

        close = lambda self: None  # noqa: E731

    thread = threading.Thread(target=lambda: list(_shared.frames(progress=Slow)))
    thread.start()
    assert begun.wait(60)
    assert in_child(child) == 0
    go_on.set()
    thread.join()
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        assert pool.apply_async(_new, (0,)).get(240) == len(delay_s)
    assert np.array_equal(_shared.run_frame().paths.delay_s, delay_s)
    _shared.close()


def check_threads():
    """Threads of one simulation take turns; one that closes it waits; what watches a frame cannot use it."""
    simulation = wavetracer.Simulation(CONFIG)
    wanted = simulation.run_frame().paths.delay_s.copy()
    wrong = []

    def work(i):
        try:
            for _ in range(4):
                if i == 0:
                    simulation.forget()
                if not np.array_equal(simulation.run_frame().paths.delay_s, wanted):
                    wrong.append("other paths")
        except Exception as error:
            wrong.append(repr(error))

    threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong, wrong
    said = []

    class Watching:
        def __init__(self, **_):
            pass

        def set_postfix_str(self, *_, **__):
            for function in (simulation.run_frame, simulation.forget, simulation.close):
                try:
                    function()
                except wavetracer.ConfigError as error:
                    said.append(str(error))

        def update(self, _):
            pass

        close = lambda self: None  # noqa: E731

    assert len(list(simulation.frames(progress=Watching))) == 1
    assert len(said) >= 3 and all("solving a frame" in text for text in said), said[:3]
    closed = []

    def until_closed():
        try:
            while True:
                simulation.run_frame()
        except wavetracer.ConfigError as error:
            closed.append(str(error))

    threads = [threading.Thread(target=until_closed) for _ in range(2)]
    for thread in threads:
        thread.start()
    simulation.close()
    for thread in threads:
        thread.join()
    assert len(closed) == 2 and all("was closed" in text for text in closed), closed


def check_types(folder):
    """Wrong types are said in the words of the function that was called."""
    for config in (None, 5, b"x", [("trace", 1)]):
        raises(wavetracer.ArgumentError, "config is the path of a TOML file, TOML text or a dict, not", wavetracer.Simulation, config)
    assert issubclass(wavetracer.ArgumentError, (wavetracer.ConfigError)) and issubclass(wavetracer.ArgumentError, TypeError)
    raises(TypeError, "folder is a path", wavetracer.Simulation, CONFIG, folder=5)
    for device in (1.5, True, ["cpu"], b"cpu"):
        raises(TypeError, "device is a part of a device's name, or its index", wavetracer.Simulation, CONFIG, device=device)
    error = wavetracer.ConfigError
    raises(error, "null character", wavetracer.Simulation, "[trace]\nrays = 5\n\0[nonsense]\n")
    raises(error, "null character", wavetracer.Simulation, CONFIG, device="\0")
    raises(error, "null character", wavetracer.Simulation, CONFIG, folder="a\0b")
    raises(error, "no text", wavetracer.Simulation, '[scene]\nfile = "\ud800"\n')
    raises(error, "a key is a text", wavetracer.Simulation, CONFIG, trace={1: 2})
    simulation = wavetracer.Simulation(CONFIG, trace={"seed": np.int64(2), "diffraction": np.bool_(False)})
    for number in (0.5, float("nan"), "0", None, [0]):
        raises(TypeError, "the number of a frame is an integer, not", simulation.run_frame, number)
    for number in (-1, 1, 2**40, 10**30):
        raises(error, "there is no frame", simulation.run_frame, number)
    frame = simulation.run_frame(np.uint8(0))
    raises(TypeError, "numbers are those of frames", lambda: list(simulation.frames(5)))
    raises(TypeError, "numbers are those of frames", lambda: list(simulation.frames("0")))
    raises(TypeError, "the number of a frame", lambda: list(simulation.frames([0.5])))
    raises(TypeError, "progress is True, False, None", lambda: list(simulation.frames(progress="yes")))
    for function in (lambda: simulation.run(None), lambda: simulation.write(5, [frame]), lambda: wavetracer.open(None),
                     lambda: wavetracer.view(5)):
        raises(TypeError, "is a path, not", function)
    raises(error, "null character", simulation.run, "a\0")
    raises(TypeError, "write: give frames", simulation.write, folder, frame)
    raises(error, "write: give frames", simulation.write, folder, [None])
    raises(error, "no transmitter or receiver 5", simulation.element_positions_m, 5)
    raises(TypeError, "a column has a name", lambda: frame[0])
    raises(TypeError, "not iterable", iter, frame)
    paths = frame.paths
    for choice in (1.5, [None], object(), [1.5]):
        raises(TypeError, "transmitter", paths.select, tx=choice)
    raises(TypeError, "kind: give", paths.select, kind=5)
    raises(error, "no paths of kind 5", paths.select, kind=[5])
    raises(TypeError, "the place of a path is an integer", paths.points, 0.5)
    raises(error, "there is no path -1", paths.points, -1)
    raises(error, "there is no path", paths.points, len(paths))
    raises(TypeError, "the number of a carrier", paths.at_carrier, "1")
    for values in ("x", [["x"]], None, object(), [1j], {}):
        if values is not None:
            raises(TypeError, "time_s", paths.cir, values)
        raises(TypeError, "frequencies_hz", paths.cfr, values)
    raises(error, "frequencies_hz", paths.cfr, [[0.0]])
    raises(error, "frequencies_hz", paths.cfr, np.nan)
    for count in (2.5, "4", None):
        raises(TypeError, "count is an integer", paths.taps, 1e6, count)
        raises(TypeError, "first is an integer", paths.taps, 1e6, 4, first=count)
    for bandwidth in ("1e6", None, [1, 2], 1j):
        raises(TypeError, "bandwidth_hz is a number", paths.taps, bandwidth, 4)
    raises(error, "bandwidth_hz", paths.taps, np.inf, 4)
    raises(error, "no column", lambda: paths.links[["tx"]])
    with simulation.write(folder, [frame]) as run:
        raises(TypeError, "the place of a frame is an integer", lambda: run[0.5])
        raises(TypeError, "the place of a frame is an integer", lambda: run["0"])
        raises(TypeError, "a column has a name", lambda: run[0][0])
        raises(TypeError, "options are words", wavetracer.view, run, options="--frames 0:1")
        raises(TypeError, "options are words", wavetracer.view, run, options=(1,))
        raises(TypeError, "height", wavetracer.view, run, height="x")
    simulation.close()


def check_distributed():
    """Values of Python become those of TOML, whatever they are; what is no list of texts is refused."""
    given = {"trace.diffraction": True, "trace": {"rays": np.int64(5), "tile_m": 2.5}, "links.max_distance_m": float("inf"),
             "scene.file": "a b.xml", "output.directory": pathlib.PurePosixPath("out"), "radio.frequencies_hz": [5.9e9, 28e9],
             "links.transmitters": ("a", 'b "c"'), "transmitter.0.position_m": np.array([0.0, 1, 2])}
    job = distributed.Job("c.toml", "out", 2, sets=given)
    assert job.sets == ("trace.diffraction=true", "trace.rays=5", "trace.tile_m=2.5", "links.max_distance_m=inf",
                        'scene.file="a b.xml"', 'output.directory="out"', "radio.frequencies_hz=[5900000000.0, 28000000000.0]",
                        'links.transmitters=["a", "b \\u0022c\\u0022"]', "transmitter.0.position_m=[0.0, 1.0, 2.0]"), job.sets
    assert distributed.Job("c.toml", "out", 2, sets=["trace.rays=5"]).sets == ("trace.rays=5",)
    # They are what the program reads.
    config = {**CONFIG, "trace": {"rays": 100}}
    taken = {"trace.diffraction": True, "trace.rays": 50, "trace.tile_m": 2.5, "trace.directions": "fibonacci",
             "radio.frequencies_hz": [5.9e9, 28e9], "links.max_distance_m": float("inf")}
    with wavetracer.Simulation(config, **taken) as simulation:
        for line in ("diffraction = true", "rays = 50", "tile_m = 2.5", 'directions = "fibonacci"'):
            assert line in simulation.config, line
    for sets in ("trace.rays=5", 5, [5], ["trace.rays"]):
        raises(TypeError, "sets", distributed.Job, "c.toml", "out", 2, sets=sets)
    raises(TypeError, "parts", distributed.Job, "c.toml", "out", 1.5)
    raises(TypeError, "parts", distributed.Job, "c.toml", "out", "2")
    raises(TypeError, "frames", distributed.Job, "c.toml", "out", 2, frames=(0, 5))
    raises(wavetracer.ConfigError, "trace.rays is", distributed.Job, "c.toml", "out", 2, sets={"trace.rays": object()})


def main():
    folder = pathlib.Path(sys.argv[1])
    shutil.rmtree(folder, ignore_errors=True)
    check_distributed()
    check_config_errors(folder / "errors")
    check_copies(folder / "copies")
    check_copied_arrays_and_carriers()
    check_types(folder / "types")
    check_threads()
    check_forks()
    print("ok")


if __name__ == "__main__":
    main()
