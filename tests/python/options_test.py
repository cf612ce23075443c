#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Functions of the package that stand for commands have the options of these commands: every option has a keyword with
the same default, and every keyword an option, but for exceptions that say why.

Usage: options_test.py. Exits with 77 without numpy.
"""
import inspect
import pathlib
import re
import sys
from unittest import mock

try:
    import wavetracer as wt
    from wavetracer import _calibration, _coverage, _page, _program
except ModuleNotFoundError as missing:
    if missing.name != "numpy":
        raise
    sys.exit(77)

# Options whose keyword has another name; errors and sets are mappings, where options are repeated.
RENAMED = {"calibrate": {"config": "config", "output": "folder", "error": "errors", "set": "sets"}}
# Options without a keyword, each with its reason.
OPTIONS_ALONE = {
    "coverage": {"output": "the maps are in memory, as an xarray.Dataset", "format": "the maps are in memory"},
    "view": {"output": "Page.save writes the page",
             "frames": "the keyword options has words of the command", "max-paths": "as frames",
             "title": "as frames"}}
# Keywords without an option, each with its reason.
KEYWORDS_ALONE = {"coverage": {"run": "the command's RUN"},
                  "view": {"run": "the command's RUN", "height": "of the part of a notebook that shows the page",
                           "options": "they are options of the command"}}
FUNCTIONS = {"calibrate": wt.calibrate, "coverage": wt.coverage, "view": wt.view}


def options_of(command):
    """The options of a command and their defaults as texts (None without one), from its help."""
    found = {}
    for line in _program.call(command, "--help").splitlines():
        option = re.match(r"  (?:-\w,)?--([a-z-]+)(.*?)(?:   |$)", line)  # the rest is its description
        if option and option[1] != "help":
            default = re.search(r"=(\S+)", option[2])
            found[option[1]] = default[1].strip("[]") if default else None
    assert found, f"wavetracer {command} --help lists no options"
    return found


def keyword_of(command, option):
    return RENAMED.get(command, {}).get(option, option.replace("-", "_"))


def check_names(command):
    options, alone = set(options_of(command)), OPTIONS_ALONE.get(command, {})
    keywords, own = set(inspect.signature(FUNCTIONS[command]).parameters), KEYWORDS_ALONE.get(command, {})
    assert set(alone) <= options, f"{command}: exceptions that are no options: {set(alone) - options}"
    assert set(own) <= keywords, f"wt.{command}: exceptions that are no keywords: {set(own) - keywords}"
    expected = {keyword_of(command, option) for option in options - set(alone)} | set(own)
    assert keywords == expected, (f"wt.{command} lacks {sorted(expected - keywords)} of the command, which lacks "
                                  f"{sorted(keywords - expected)}")


def check_defaults(command):
    parameters, compared = inspect.signature(FUNCTIONS[command]).parameters, 0
    for option, default in options_of(command).items():
        if option in OPTIONS_ALONE.get(command, {}) or default is None:
            continue  # without a default the keyword is None or empty
        own = parameters[keyword_of(command, option)].default
        if own is inspect.Parameter.empty:
            continue  # the caller says it
        same = str(own) == default if isinstance(own, str) else float(own) == float(default)
        assert same, f"wt.{command}: {option} is {own!r} by default, and {default} in the command"
        compared += 1
    return compared


class Called(Exception):
    pass


def words_of(module, function, *arguments, **keywords):
    """The words with which a function calls the program."""
    with mock.patch.object(module._program, "call", side_effect=Called) as call:
        try:
            function(*arguments, **keywords)
        except Called:
            pass
    return [str(word) for word in call.call_args[0]]


def has(words, option, value):
    at = [i for i, word in enumerate(words) if word == option or word.startswith(option + "=")]
    return any(words[i] == f"{option}={value}" or words[i + 1:i + 2] == [value] for i in at)


def check_calibrate_passes_on():
    given = {"fit": (["a", "b.height"], "a,b.height"), "offset": ("tx", "tx"), "spreads": ("delay", "delay"),
             "profiles": (25, "25.0"), "prior": (2, "2.0"), "errors": ({"mast.x": 3}, "mast.x=3.0"), "folds": (2, "2"),
             "level": ("power_dbm", "power_dbm"), "crs": ("EPSG:25832", "EPSG:25832"), "device": ("CPU", "CPU"),
             "sets": ({"trace.rays": 7}, "trace.rays=7")}
    options = {keyword_of("calibrate", option): option for option in options_of("calibrate")}
    assert set(given) | {"config", "measured", "folder"} == set(options), "an option is not tried here"
    words = words_of(_calibration, wt.calibrate, "c.toml", ["m.csv", "n.csv"], "out",
                     **{keyword: value for keyword, (value, _) in given.items()})
    for keyword, (_, text) in given.items():
        assert has(words, "--" + options[keyword], text), f"wt.calibrate does not pass on {keyword}: {words}"
    for option, text in (("--measured", "m.csv"), ("--measured", "n.csv"), ("-c", "c.toml"), ("-o", "out")):
        assert has(words, option, text), f"wt.calibrate does not pass on {option}: {words}"


def check_coverage_passes_on():
    run = pathlib.Path(__file__).parent  # a folder
    words = []
    with mock.patch.object(_coverage, "_xarray"), mock.patch.object(_coverage, "_folder_of", return_value=run):
        words += words_of(_coverage, wt.coverage, run, grid="g", tx="t", frame=3, layers=["sinr_db"], on_streets=True)
        words += words_of(_coverage, wt.coverage, run, frames="all")
    for option, text in (("--grid", "g"), ("--tx", "t"), ("--frame", "3"), ("--layers", "sinr_db"), ("--frames", "all")):
        assert has(words, option, text), f"wt.coverage does not pass on {option}: {words}"
    assert "--on-streets" in words
    tried = {"grid", "tx", "frame", "layers", "frames", "on-streets"}
    assert tried | set(OPTIONS_ALONE["coverage"]) == set(options_of("coverage")), "an option is not tried here"


def main():
    compared = 0
    for command in FUNCTIONS:
        check_names(command)
        compared += check_defaults(command)
    assert compared >= 6, "the defaults of calibrate are not in its help"
    check_calibrate_passes_on()
    check_coverage_passes_on()
    words = words_of(_page, wt.view, "folder", options=("--frames", "0:2"))
    assert words[-2:] == ["--frames", "0:2"], words


main()
