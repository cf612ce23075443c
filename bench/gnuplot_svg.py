# SPDX-License-Identifier: Apache-2.0
"""Draws with gnuplot for documents: the one place of bench/ that starts it."""
import math
import subprocess


def svg(lines, size):
    """The SVG that these commands draw. size: "width,height" in pixels."""
    head = [f"set terminal svg size {size} font 'sans-serif,13' background '#ffffff'", "set grid lc rgb '#dddddd'"]
    return subprocess.run(["gnuplot"], input="\n".join(head + lines), text=True, check=True, stdout=subprocess.PIPE).stdout


def log_axis(axis, values):
    """Commands for a logarithmic axis: it ends near the values, and has at least three labels. values: above 0."""
    low, high = min(values) / 1.25, max(values) * 1.25
    decades = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    for steps in ((1,), (1, 3), (1, 2, 5)):
        places = [step * 10**decade for decade in decades for step in steps if low <= step * 10**decade <= high]
        if len(places) > 3:
            break
    labels = ", ".join(f"'{label(place)}' {place:g}" for place in places)
    return [f"set logscale {axis}", f"set {axis}range [{low:g}:{high:g}]", f"set {axis}tics ({labels})", f"set m{axis}tics default"]


def label(number):
    """The number as it stands at an axis: 0.01, 500, 20,000, 10^{4}."""
    power = round(math.log10(number))
    if power >= 4 and number == 10**power:
        return f"10^{{{power}}}"
    return f"{number:,.0f}" if number >= 1 else f"{number:g}"
