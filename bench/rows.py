# SPDX-License-Identifier: Apache-2.0
"""Rows of bench/results/*.jsonl: one JSON object a line, with the keys of json_line.hpp.

The tree keeps the newest row of each measurement and device; `newest` says which those are.
"""
import json
import re
import sys

KEYS = ("bench", "case", "device", "value", "unit", "baseline", "baseline_value", "ratio", "error", "command", "date")


def read(path):
    """[(line, object)] of a file, in its order. A line that is no such object ends the program with file and line."""
    rows = []
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
        if not line.strip():
            continue
        try:
            row = json.loads(line)
            missing = [key for key in KEYS if key not in row]
        except (ValueError, TypeError) as error:
            sys.exit(f"{path}:{number}: not a JSON object: {error}")
        if missing:
            sys.exit(f"{path}:{number}: missing {', '.join(missing)}; was it printed by json_line.hpp?")
        rows.append((line, row))
    return rows


def measurement(row):
    """The name of what was measured. bench_paths appends the launch that the error is taken against: a frame that was
    measured again with another truth is the same measurement."""
    case = row["case"]
    return re.sub(r", error against \S+$", "", case) if row["bench"] == "paths" else case


def newest(rows):
    """Those of `rows` ([(line, object)]) that no later row of the same measurement and device has replaced."""
    last = {}
    for index, (_, row) in enumerate(rows):
        key = row["bench"], measurement(row), row["device"]
        if key not in last or row["date"] >= rows[last[key]][1]["date"]:
            last[key] = index
    kept = set(last.values())
    return [row for index, row in enumerate(rows) if index in kept]


def grouped(objects):
    """{(bench, device): {measurement: object}}, each in the order of `objects`."""
    groups = {}
    for row in objects:
        groups.setdefault((row["bench"], row["device"]), {})[measurement(row)] = row
    return groups


def of_device(groups, bench, device, case):
    """The newest row of a measurement on devices whose names begin so; None where there is none."""
    found = [cases[case] for (b, d), cases in groups.items() if b == bench and d.startswith(device) and case in cases]
    return max(found, key=lambda row: row["date"], default=None)


def command(row):
    """The command of a row as anybody may repeat it: without folders of the machine that it ran on."""
    return re.sub(r"(?<=[ =])/\S*/(?=\S)", "", re.sub(r" --shared \S+", "", row["command"]))


def device_name(name):
    """A device as a reader calls it: PoCL names a processor `pthread-KIND-NAME`."""
    name = re.sub(r"^pthread-[a-z0-9-]*?-(?=[A-Z])", "two cores of an ", name)
    return name.replace(" 80GB HBM3", "").replace("(R)", "").replace(" Processor", "")
