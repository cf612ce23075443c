# SPDX-License-Identifier: Apache-2.0
"""Draws with gnuplot for documents: the one place of bench/ that starts it."""
import subprocess


def svg(lines, size):
    """The SVG that these commands draw. size: "width,height" in pixels."""
    head = [f"set terminal svg size {size} font 'sans-serif,13' background '#ffffff'", "set grid lc rgb '#dddddd'"]
    return subprocess.run(["gnuplot"], input="\n".join(head + lines), text=True, check=True, stdout=subprocess.PIPE).stdout
