# SPDX-License-Identifier: Apache-2.0
"""The table of every kernel beside its bound, of the rows of bench_kernels.

A kernel has one line: on a CPU and on a GPU its newest device, and there the row with the most elements.
"""
import rows

KINDS = ("cpu", "gpu")


def chosen(groups):
    """{(kernel, kind): row}"""
    found = {}
    for (bench, _), cases in groups.items():
        for row in cases.values() if bench == "kernels" else ():
            if "kernel" not in row:
                continue
            key = row["kernel"], row["device_kind"]
            rank = row["date"][:10], row["device"], row["elements"]
            if key not in found or rank > found[key][0]:
                found[key] = rank, row
    return {key: row for key, (_, row) in found.items()}


def cells(row):
    """Time with what was timed, bound, and how many times the bound that is."""
    if row is None:
        return ["", "", ""]
    variant = row["case"].split(", ", 1)[1]
    return [f"{row['value']:.3g} ms ({variant})", f"{row['baseline_value']:.3g} ms, {row['baseline']}", f"{row['time_over_bound']:.3g}"]


def table(groups):
    """Markdown lines; none where no row is stored."""
    found = chosen(groups)
    if not found:
        return []
    devices = [sorted({rows.device_name(row["device"]) for (_, k), row in found.items() if k == kind}) for kind in KINDS]
    heads = [" and ".join(names) or "no device" for names in devices]
    lines = ["| kernel | " + " | ".join(f"{head} | bound | time / bound" for head in heads) + " |",
             "| --- |" + " --- | --- | ---: |" * len(KINDS)]
    for kernel in sorted({kernel for kernel, _ in found}):
        columns = [cell for kind in KINDS for cell in cells(found.get((kernel, kind)))]
        lines.append(f"| {kernel} | " + " | ".join(columns) + " |")
    return lines
