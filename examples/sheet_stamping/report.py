#!/usr/bin/python3
# SPDX-License-Identifier: BSL-1.0
"""The punch in three dimensions against the axisymmetric one: prints the table of forces and draws the formed sheet.

    examples/sheet_stamping/report.py --programs build/release/examples --out out/sheet_stamping

The picture needs gnuplot, and VTK's Python to read what was written (on Debian: python3-vtk9)."""

import argparse
import json
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "common"))
from skin import draw  # noqa: E402

SOLVERS = {"quasi-coulomb": "cholmod", "coulomb": "mumps"}


def run(program, *options):
    return json.loads(subprocess.run([str(program), *options, "--quiet", "--json", "-"], check=True, capture_output=True, text=True).stdout)


def table(programs, refines, mu, travel):
    print(f"force at {travel:g} mm, mu = {mu:g}")
    print("| law | elements | unknowns | steps / iterations | in space | axisymmetric | difference | time | memory |")
    for refine in refines:
        for law, solver in SOLVERS.items():
            common = ["--friction", law, "--mu", str(mu), "--refine", str(refine), "--travel", str(travel)]
            b, a = run(programs / "sheet_stamping", *common, "--solver", solver), run(programs / "osu_punch", *common)
            force, expected = b["final_force_N"], a["final_force_N"]
            print(f"| {law} | {b['elements']} | {b['unknowns']} | {b['steps']} / {b['iterations']} | {force / 1000:.2f} kN | {expected / 1000:.2f} kN "
                  f"| {100 * (force / expected - 1):+.2f} % | {b['seconds_total']:.0f} s | {b['peak_memory_mb']:.0f} MB |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--programs", type=pathlib.Path, required=True, help="folder of the built examples")
    parser.add_argument("--out", type=pathlib.Path, required=True, help="folder for VTU files and the picture")
    parser.add_argument("--refine", type=int, nargs="+", default=[1, 2], help="meshes of the table (default 1 2)")
    parser.add_argument("--drawn", type=int, default=2, help="mesh of the picture (default 2)")
    parser.add_argument("--mu", type=float, default=0.15, help="friction coefficient (default 0.15)")
    parser.add_argument("--travel", type=float, default=25, help="of the table, in mm (default 25)")
    parser.add_argument("--picture-only", action="store_true", help="no table; draw what --out holds if it holds a run")
    arguments = parser.parse_args()
    if not arguments.picture_only:
        table(arguments.programs, arguments.refine, arguments.mu, arguments.travel)
    files = sorted(arguments.out.glob("sheet_stamping_*.vtu")) if arguments.picture_only else []
    if not files:
        run(arguments.programs / "sheet_stamping", "--friction", "quasi-coulomb", "--solver", "cholmod", "--mu", str(arguments.mu),
            "--refine", str(arguments.drawn), "--output", str(arguments.out))
        files = sorted(arguments.out.glob("sheet_stamping_*.vtu"))
    draw(files[-1], (arguments.out / "sheet.png").resolve(), f"sheet_stamping, quasi-coulomb, mu = {arguments.mu:.2f}: a quarter of the sheet at 40 mm",
         "set view 52,35\nset xyplane at -45\nset xtics 20\nset ytics 20,20\nset ztics 10\n"
         "set xrange [0:60]\nset yrange [0:60]\nset zrange [-45:5]")
    print(arguments.out / "sheet.png")


if __name__ == "__main__":
    main()
