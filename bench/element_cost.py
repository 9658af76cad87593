#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""What an element costs and what it buys: mean dilatation and assumed strains on several meshes of the punch, the tube
and of bent bodies, each against a fine mesh.

    bench/element_cost.py --build build/release --out out/elements [--document FILE]

Writes elements.md and work-precision diagrams of the punch; with --document, the tables into that file's place for them
and the diagram into the folder images beside it. Runs of one scene are interleaved and repeated; times are medians.
Needs gnuplot."""

import argparse
import csv
import pathlib
import shutil
import statistics
import subprocess

from accuracy_cost import at, fill, run, table

ELEMENTS = {"mean-dilatation": ("#d62728", 7), "assumed-strain": ("#1f77b4", 5)}

# A scene: the program, meshes (elements in each direction over the standard), that of the reference, the travels at
# which forces are compared. Equal steps, which end at these travels; the tube is compared by its mean force.
SCENES = {
    "punch": {"program": "osu_punch", "options": ["--mu", "0.15"], "steps": 200, "meshes": [1, 2, 4, 8], "reference": 12, "travels": [2, 10, 25, 40]},
    "tube": {"program": "shock_absorber", "options": ["--mu", "0.15", "--self-contact", "off"], "steps": "auto", "meshes": [1, 2], "reference": 3, "travels": []},
}


def values(scene, r):
    """The forces at the scene's travels, or the mean force up to the last travel."""
    x, y = r["history"]["displacement_mm"], r["history"]["force_N"]
    if scene["travels"]:
        return {f"{t} mm": at((x, y), t) for t in scene["travels"]}
    until = 42
    work = sum((b - a) * 0.5 * (f + g) for a, b, f, g in zip(x, x[1:], y, y[1:]) if b <= until)
    return {f"mean to {until} mm": work / until}


def measure(programs, scene, element, mesh, patience=1200):
    options = scene | {"options": scene["options"] + ["--element", element]}
    return run(programs, options, "coulomb", "banded", mesh, scene["steps"], patience=patience)


def scene_part(programs, name, scene, repeats):
    fine = measure(programs, scene, "assumed-strain", scene["reference"])
    if fine is None:
        raise SystemExit(f"element_cost: the reference of {name} did not reach its end")
    reference = values(scene, fine)
    jobs = [(element, mesh) for mesh in scene["meshes"] for element in ELEMENTS]
    answers, seconds = {}, {job: [] for job in jobs}
    for _ in range(repeats):
        for job in jobs:
            answers[job] = measure(programs, scene, *job)
            if answers[job]:
                seconds[job].append(answers[job]["seconds_total"])
    rows, points = [], {}
    for job in jobs:
        element, mesh = job
        r = answers[job]
        if r is None:
            rows.append([element, str(mesh), "ended early"] + [""] * (len(reference) + 1))
            continue
        now = values(scene, r)
        off = {key: now[key] / reference[key] - 1 for key in reference}
        time = statistics.median(seconds[job])
        points.setdefault(element, []).append((time, off))
        rows.append([element, f"{mesh} ({r['elements']})", f"{r['steps']} / {r['iterations']}"] +
                    [f"{now[key]:.0f} ({100 * off[key]:+.2g} %)" for key in reference] + [f"{time:.3g}"])
    rows.append([f"reference: assumed-strain", f"{scene['reference']} ({fine['elements']})", f"{fine['steps']} / {fine['iterations']}"] +
                [f"{reference[key]:.0f}" for key in reference] + [""])
    head = ["element", "mesh (elements)", "steps / iterations"] + [f"force, N, {key}" for key in reference] + ["time, s"]
    return table(head, rows), points


def bent_part(text):
    rows = list(csv.DictReader(text.splitlines()))
    part = ""
    for scene in dict.fromkeys(r["scene"] for r in rows):
        reference = next(r for r in rows if r["scene"] == scene and r["element"] == "reference")
        lines = []
        meshes = dict.fromkeys((r["along"], r["across"]) for r in rows if r["scene"] == scene and r["element"] != "reference")
        for mesh in meshes:
            cells = [f"{mesh[0]} x {mesh[1]}"]
            for element in ELEMENTS:
                r = next(r for r in rows if r["scene"] == scene and r["element"] == element and (r["along"], r["across"]) == mesh)
                off = float(r["value"]) / float(reference["value"]) - 1
                cells += [f"{float(r['value']):.4g} ({100 * off:+.2g} %)", r["iterations"], f"{1000 * float(r['seconds']):.3g}"]
            lines.append(cells)
        head = ["mesh"] + [word for element in ELEMENTS for word in (element, "iterations", "ms")]
        part += f"\n{scene[0].upper() + scene[1:]}; reference {float(reference['value']):.4g} by assumed strains on {reference['along']} x {reference['across']}\n\n" + table(head, lines)
    return part


def draw(out, points, keys, image):
    plots = []
    for key in keys:
        lines = []
        for element, (colour, point) in ELEMENTS.items():
            data = out / f"punch_{element}_{key.replace(' ', '_')}.dat"
            data.write_text("".join(f"{time} {100 * abs(off[key])}\n" for time, off in points[element]))
            lines.append(f"'{data.name}' with linespoints lw 2 lc rgb '{colour}' pt {point} ps 1.4 title '{element}'")
        plots.append(f"set title 'punch, force at {key}'\nplot {', '.join(lines)}\n")
    script = out / "elements.gp"
    script.write_text(f"set terminal pngcairo size 1100,480 noenhanced background rgb 'white' font 'sans,12'\nset output '{image}'\n"
                      "set multiplot layout 1,2\nset logscale xy\nset format y '%g'\nset grid\nset key top right\nset xlabel 'wall time of the run [s]'\n"
                      "set ylabel 'error of the force [%]'\n" + "".join(plots) + "unset multiplot\nunset output\n")
    subprocess.run(["gnuplot", script.name], cwd=out, check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, required=True, help="build folder with the examples and the benchmarks")
    parser.add_argument("--out", type=pathlib.Path, required=True, help="folder for what is written")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--scenes", nargs="+", choices=list(SCENES), default=list(SCENES))
    parser.add_argument("--document", type=pathlib.Path, help="Markdown file that shows the tables and the diagram")
    arguments = parser.parse_args()
    if arguments.document and arguments.scenes != list(SCENES):
        parser.error("--document wants all scenes")
    arguments.out.mkdir(parents=True, exist_ok=True)
    parts = []
    for name in arguments.scenes:
        text, points = scene_part(arguments.build / "examples", name, SCENES[name], arguments.repeats)
        parts.append(f"{name[0].upper() + name[1:]}, exact Coulomb friction, {SCENES[name]['steps']} steps\n\n{text}")
        if name == "punch":
            draw(arguments.out, points, ["2 mm", "25 mm"], "elements.png")
    bent = subprocess.run([arguments.build / "bench" / "bench_bending"], capture_output=True, text=True, check=True).stdout
    (arguments.out / "bending.csv").write_text(bent)
    text = "\n".join(parts) + bent_part(bent)
    (arguments.out / "elements.md").write_text(text)
    print(text)
    if arguments.document:
        fill(arguments.document, {"elements": text})
        shutil.copy(arguments.out / "elements.png", arguments.document.parent / "images" / "accuracy_elements.png")


if __name__ == "__main__":
    main()
