#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws a frame of `wavetracer convert --to vtk` as PNG, with VTK alone, as ParaView shows it when run.pvd is opened.

    docs/examples/render_vtk.py FOLDER -o picture.png --frame 0

FOLDER is the output of convert. Needs VTK 9 and a display (Debian: python3-vtk9; where there is no screen, start it
by xvfb-run of the package xvfb).
"""
import argparse
import os
import sys
import xml.etree.ElementTree as ET

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (the renderer)
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
from vtkmodules.vtkRenderingCore import (vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow,
                                         vtkWindowToImageFilter)


def files_of(folder, frame):
    """The files of one time, as the .pvd lists them; times count from 0."""
    steps: dict[float, list[str]] = {}
    for row in ET.parse(os.path.join(folder, "run.pvd")).getroot().iter("DataSet"):
        steps.setdefault(float(row.attrib["timestep"]), []).append(os.path.join(folder, row.attrib["file"]))
    times = sorted(steps)
    if not 0 <= frame < len(times):
        sys.exit(f"{folder}: has times 0 to {len(times) - 1}")
    return steps[times[frame]]


def plasma():
    """The colours from weak to strong: violet, red, yellow."""
    stops = [(0.45, 0.00, 0.66), (0.74, 0.22, 0.53), (0.93, 0.47, 0.33), (0.99, 0.79, 0.15), (0.94, 0.98, 0.13)]
    table = vtkLookupTable()
    table.SetNumberOfTableValues(256)
    for i in range(256):
        at = i / 255 * (len(stops) - 1)
        k = min(int(at), len(stops) - 2)
        table.SetTableValue(i, *(a + (b - a) * (at - k) for a, b in zip(stops[k], stops[k + 1])), 1)
    table.Build()
    return table


def actor_of(file):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(file)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(reader.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    look, name = actor.GetProperty(), os.path.basename(file)
    look.SetInterpolationToFlat()
    if name.startswith("paths"):
        reader.Update()
        gain_db = reader.GetOutput().GetCellData().GetArray("gain_db")
        strongest_db = gain_db.GetFiniteRange(0)[1] if gain_db.GetNumberOfTuples() else 0
        mapper.ScalarVisibilityOn()
        mapper.SetScalarModeToUseCellFieldData()
        mapper.SelectColorArray("gain_db")
        mapper.SetLookupTable(plasma())
        mapper.SetScalarRange(strongest_db - 60, strongest_db)
        look.LightingOff()
    elif name.startswith("ends"):
        look.SetColor(1, 0.36, 0.45)
        look.SetPointSize(8)
        look.RenderPointsAsSpheresOn()
    elif name.startswith("vehicles"):
        look.SetColor(0.35, 0.7, 1)
    elif name.startswith("edges"):
        look.SetColor(0.24, 0.5, 0.4)
    else:
        look.SetColor(0.42, 0.45, 0.5)
    return actor


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("-o", "--output", default="picture.png")
    parser.add_argument("--frame", type=int, default=0, help="which time of run.pvd, counted from 0")
    parser.add_argument("--zoom", type=float, default=1.6)
    arguments = parser.parse_args()
    renderer = vtkRenderer()
    renderer.SetBackground(0.07, 0.08, 0.11)
    for file in files_of(arguments.folder, arguments.frame):
        renderer.AddActor(actor_of(file))
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetSize(1200, 900)
    window.AddRenderer(renderer)
    renderer.ResetCamera()
    camera = renderer.GetActiveCamera()
    camera.Elevation(-40)
    camera.Zoom(arguments.zoom)
    renderer.ResetCameraClippingRange()
    window.Render()
    picture = vtkWindowToImageFilter()
    picture.SetInput(window)
    writer = vtkPNGWriter()
    writer.SetFileName(arguments.output)
    writer.SetInputConnection(picture.GetOutputPort())
    writer.Write()


if __name__ == "__main__":
    main()
