# SPDX-License-Identifier: Apache-2.0
"""Executes docs/examples/channels.ipynb with the installed wheel, and looks at its pictures.

Usage, with the Python of the environment: notebook_test.py NOTEBOOK FOLDER. FOLDER/view.html is the cell that shows the
page, for notebook_page.py.
"""
import base64
import io
import pathlib
import shutil
import sys

import matplotlib.image
import nbclient
import nbformat
import numpy as np

notebook, folder = map(pathlib.Path, sys.argv[1:])
shutil.rmtree(folder, ignore_errors=True)
folder.mkdir(parents=True)
executed = nbclient.NotebookClient(nbformat.read(notebook, 4), timeout=300, kernel_name="python3",
                                   resources={"metadata": {"path": str(folder)}}).execute()
cells = [cell for cell in executed.cells if cell.cell_type == "code"]


def output(cell, kind):
    (found,) = [out.data[kind] for out in cell.outputs if kind in out.get("data", {})]
    return found


def stderr(cell):
    return "".join(out.text for out in cell.outputs if out.output_type == "stream" and out.name == "stderr")


assert "21 transmitters, 20 receivers, 11 frames" in output(cells[0], "text/plain")
assert "11 frames" in output(cells[1], "text/plain") and "11/11" in stderr(cells[1]), stderr(cells[1])
assert "path_gain_db" in output(cells[2], "text/html") and "/roof" in output(cells[2], "text/html")
# Curves: pixels of matplotlib's first colour in nearly every column between the axes of the left picture, and stems on
# the right; several colours in the second figure.
curve = np.array([0x1F, 0x77, 0xB4]) / 255
for number, (cell, columns) in enumerate([(cells[3], slice(0, 0.5)), (cells[4], slice(0, 1))]):
    png = base64.b64decode(output(cell, "image/png"))
    (folder / f"figure{number}.png").write_bytes(png)
    pixels = matplotlib.image.imread(io.BytesIO(png))[:, :, :3]
    width = pixels.shape[1]
    part = pixels[:, int(columns.start * width):int(columns.stop * width)]
    drawn = (np.abs(part - curve).max(axis=2) < 0.05).any(axis=0)
    assert drawn.mean() > (0.6 if number == 0 else 0.02), (number, drawn.mean())
    colours = len(np.unique((pixels.reshape(-1, 3) * 8).astype(int), axis=0))
    assert colours > (5 if number == 0 else 15), (number, colours)
    print(f"figure {number}: {width} x {pixels.shape[0]}, a curve in {drawn.mean():.0%} of the columns, {colours} colours")
(folder / "view.html").write_text(f'<!doctype html><meta charset="utf-8">{output(cells[5], "text/html")}')
