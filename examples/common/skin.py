#!/usr/bin/python3
# SPDX-License-Identifier: BSL-1.0
"""Draws the deformed surface of a VTU file in space, coloured by plastic strain, as PNG and SVG.

    examples/common/skin.py out/ironing/ironing_0040.vtu --out out/ironing.png --title "ironing"

Needs gnuplot, and VTK's Python (on Debian: python3-vtk9)."""

import argparse
import pathlib
import subprocess

PALETTE = "set palette defined (0 '#440154', 1 '#3b528b', 2 '#21918c', 3 '#5ec962', 4 '#fde725')\n"


def draw(vtu, picture, title, commands=""):
    """`picture` ends in .png; an SVG and the data stand beside it. `commands` are gnuplot's, of view and ranges."""
    from vtkmodules.vtkFiltersGeneral import vtkWarpVector
    from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(vtu))
    warp = vtkWarpVector()
    warp.SetInputConnection(reader.GetOutputPort())
    warp.SetInputArrayToProcess(0, 0, 0, 0, "displacement")
    outside = vtkGeometryFilter()
    outside.SetInputConnection(warp.GetOutputPort())
    outside.Update()
    skin = outside.GetOutput()
    strain = skin.GetCellData().GetArray("plastic_strain")
    folder, name = picture.parent, picture.stem
    with open(folder / f"{name}.dat", "w") as data:
        print("# x y z plastic_strain: one patch a facet of the surface", file=data)
        for i in range(skin.GetNumberOfCells()):
            points = skin.GetCell(i).GetPoints()
            corners = [" ".join(f"{c:.6g}" for c in points.GetPoint(a)) + f" {strain.GetValue(i):.6g}" for a in (0, 1, 3, 2)]
            print(*corners[:2], "", *corners[2:], "\n", sep="\n", file=data)
    script = (f"set title '{title}'\nset view equal xyz\nset key off\nset cblabel 'plastic strain'\n{PALETTE}"
              f"set xlabel 'x [mm]'\nset ylabel 'y [mm]'\nset zlabel 'z [mm]' rotate\n{commands}\n"
              f"set pm3d depthorder corners2color c1 border lc rgb '#404040' lw 0.3\nsplot '{name}.dat' using 1:2:3:4 with pm3d\nunset output\n")
    (folder / f"{name}.gp").write_text("".join(
        f"set terminal {kind} size 1000,700 noenhanced background rgb 'white' font 'sans,12'\nset output '{name}.{end}'\n{script}"
        for kind, end in (("pngcairo", "png"), ("svg", "svg"))))
    subprocess.run(["gnuplot", f"{name}.gp"], cwd=folder, check=True)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("vtu", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path, required=True, help="the PNG to be written")
    parser.add_argument("--title", default="")
    parser.add_argument("--commands", default="set view 60,340", help="gnuplot's, of view and ranges")
    arguments = parser.parse_args()
    draw(arguments.vtu, arguments.out.resolve(), arguments.title, arguments.commands)
