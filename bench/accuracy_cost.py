#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""What accuracy costs in time: the paper's benchmarks under every law and solver at several step counts and meshes, each
against a converged run of exact Coulomb friction on the same mesh; and the laws up a wedge, where friction feeds back.

    bench/accuracy_cost.py --build build/release --out out/accuracy [--quick] [--rebuild-references] [--document FILE]

Writes runs.csv, wedge.csv, tables.md and a work-precision diagram a scene (error of the force over the wall time of the
run, Pareto front marked); with --document, the tables into that file's places for them and the diagrams into the folder images
beside it. The error is the L2 norm of the difference of the forces at the ends of the steps over the norm of the
reference's; "largest" and "last" are differences over the reference's last force. The references lie in
bench/references with what made them. Runs of one scene are interleaved and repeated; times are medians, with the smallest
and the largest. Needs gnuplot for the diagrams."""

import argparse
import bisect
import csv
import json
import math
import pathlib
import re
import shutil
import statistics
import subprocess
import time

HERE = pathlib.Path(__file__).resolve().parent

# A scene: the program, what it is told, step counts by mesh (elements in each direction over the standard), those of the
# reference, how far the curves are compared.
SCENES = {
    "extrusion, unbounded cone": {
        "program": "conical_extrusion", "options": [], "reference": 5000, "until": 178,
        "steps": {1: ["auto", 60, 125, 250, 500, 1000], 2: ["auto", 250]}},
    "extrusion, container": {
        "program": "conical_extrusion", "options": ["--die", "container"], "reference": 5000, "until": 178,
        "steps": {1: ["auto", 60, 125, 250, 500, 1000], 2: ["auto", 250]}},
    "punch": {
        "program": "osu_punch", "options": ["--mu", "0.3"], "reference": 4000, "until": 40,
        "steps": {1: ["auto", 30, 60, 125, 250, 500], 2: ["auto", 125]}},
    "tube": {
        "program": "shock_absorber", "options": ["--mu", "0.15", "--self-contact", "off"], "reference": 5000, "until": 42,
        "steps": {1: ["auto", 320, 640, 1280]}},
}
QUICK = {"extrusion, unbounded cone": {1: ["auto", 60, 250]}, "punch": {1: ["auto", 30, 125]}}

# Laws with the solvers that are compared: one of bands, one of sparse matrices.
LAWS = {
    "coulomb": ["banded", "umfpack", "corrected-banded", "corrected-cholmod"],
    "quasi-coulomb": ["banded", "cholmod"],
    "extrapolated-quasi-coulomb": ["banded"],
    "lag-iterated-coulomb": ["banded"],
    "symmetrised-coulomb": ["banded"],
}
STYLES = {"coulomb": ("#d62728", 7), "quasi-coulomb": ("#1f77b4", 5), "extrapolated-quasi-coulomb": ("#2ca02c", 9),
          "lag-iterated-coulomb": ("#9467bd", 11), "symmetrised-coulomb": ("#8c564b", 13)}


# The extrusion on a fine mesh, where factors cost: what is compared with the first.
FINE_MESH = 8
ON_FINE_MESH = [("coulomb", "umfpack"), ("coulomb", "banded"), ("coulomb", "corrected-banded"), ("coulomb", "corrected-eigen-ldlt"),
                ("coulomb", "corrected-cholmod"), ("quasi-coulomb", "banded"), ("quasi-coulomb", "eigen-ldlt")]


def run(programs, scene, law, solver, mesh, steps, tolerance=None, patience=10):
    """A run's JSON, or None if it did not reach its end within `patience` seconds; a run of given tolerance has all the time it needs."""
    command = [str(programs / scene["program"]), *scene["options"], "--friction", law, "--solver", solver, "--refine", str(mesh),
               "--steps", str(steps), "--quiet", "--json", "-", "--mesh-error-every", "0"]
    if tolerance:
        command += ["--tolerance", str(tolerance)]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=None if tolerance else patience)
    except subprocess.TimeoutExpired:
        return None
    return json.loads(done.stdout[done.stdout.index("{"):]) if done.returncode == 0 else None


def at(curve, travel):
    x, y = curve
    i = min(max(bisect.bisect_right(x, travel) - 1, 0), len(x) - 2)
    return y[i] + (y[i + 1] - y[i]) * (travel - x[i]) / (x[i + 1] - x[i])


def error(curve, reference, until):
    """At the ends of the steps: L2 difference over the reference's norm; the largest difference and the last one over the reference's last force."""
    square = whole = largest = last = 0
    for before, x, force in zip(curve[0], curve[0][1:], curve[1][1:]):
        if x > until * (1 + 1e-9):
            break
        exact = at(reference, x)
        square += (x - before) * (force - exact) ** 2
        whole += (x - before) * exact ** 2
        last = abs(force - exact)
        largest = max(largest, last)
    return math.sqrt(square / whole), largest / abs(at(reference, until)), last / abs(at(reference, until))


def reference_of(programs, name, scene, mesh, rebuild):
    """The converged curve, and how far one with half the steps is from it: what the reference itself is worth."""
    file = HERE / "references" / (file_name(name) + (f"_{mesh}" if mesh > 1 else "") + ".json")
    if not rebuild and file.exists():
        stored = json.loads(file.read_text())
        return (stored["travel_mm"], stored["force_N"]), stored["worth"]
    curves = []
    for steps in (scene["reference"] // 2, scene["reference"]):
        r = run(programs, scene, "coulomb", "banded", mesh, steps, 1e-5)
        if r is None:
            raise SystemExit(f"accuracy_cost: the reference of {name} did not reach its end")
        curves.append((r["history"]["displacement_mm"], r["history"]["force_N"]))
    worth = error(curves[0], curves[1], scene["until"])[0]
    travels = [scene["until"] * k / 4000 for k in range(4001)]
    file.parent.mkdir(exist_ok=True)
    file.write_text(json.dumps({
        "made_by": f"{scene['program']} {' '.join(scene['options'])} --friction coulomb --solver banded --refine {mesh} --steps {scene['reference']} --tolerance 1e-5",
        "steps": r["steps"], "iterations": r["iterations"], "worth": worth,
        "worth_is": "relative L2 difference of the same with half the steps",
        "travel_mm": travels, "force_N": [round(at(curves[1], x), 4) for x in travels]}))
    return (travels, [at(curves[1], x) for x in travels]), worth


def measure(programs, name, scene, meshes, references, repeats):
    jobs = [(law, solver, mesh, n) for law, solvers in LAWS.items() for solver in solvers for mesh, steps in meshes.items() for n in steps]
    seconds, answers = {job: [] for job in jobs}, {}
    for _ in range(repeats):  # interleaved, so that a slow spell of the machine hits all alike
        for job in jobs:
            if answers.get(job, True) is None:
                continue
            r = run(programs, scene, *job)
            answers[job] = r
            if r:
                seconds[job].append(r["seconds_total"])
    rows = []
    for job in jobs:
        r = answers[job]
        row = {"scene": name, "law": job[0], "solver": job[1], "mesh": job[2], "steps_asked": job[3], "completed": r is not None}
        if r:
            reference, worth = references[job[2]]
            off, largest, last = error((r["history"]["displacement_mm"], r["history"]["force_N"]), reference, scene["until"])
            row |= {"unknowns": r["unknowns"], "steps": r["steps"], "iterations": r["iterations"], "factorizations": r["factorizations"],
                    "rejected_steps": r["rejected_steps"], "factor_mb": round(r["factor_mb"], 3), "peak_memory_mb": round(r["peak_memory_mb"], 1), "error": off,
                    "largest_error": largest, "last_error": last, "estimated_lag": r["estimated_error_lag"], "estimated_time": r["estimated_error_time"],
                    "reference_worth": worth, "seconds": statistics.median(seconds[job]),
                    "seconds_min": min(seconds[job]), "seconds_max": max(seconds[job])}
        rows.append(row)
    return rows


def pareto(rows):
    """The runs that no other is both quicker and more accurate than."""
    front, best = [], math.inf
    for r in sorted(rows, key=lambda r: r["seconds"]):
        if r["error"] < 0.98 * best:
            front.append(r)
            best = r["error"]
    return front


def file_name(scene):
    return scene.replace(", ", "_").replace(" ", "_")


def draw(out, name, rows):
    base = file_name(name)
    done = sorted((r for r in rows if r["completed"] and r["mesh"] == 1), key=lambda r: r["steps"])
    plots = []
    for law, solvers in LAWS.items():
        colour, point = STYLES[law]
        for k, solver in enumerate(solvers):
            line = [r for r in done if r["law"] == law and r["solver"] == solver]
            if not line:
                continue
            data = out / f"{base}_{law}_{solver}.dat"
            data.write_text("".join(f"{r['seconds']} {100 * r['error']} {r['seconds_min']} {r['seconds_max']}\n" for r in line))
            plots.append(f"'{data.name}' using 1:2:3:4 with xerrorbars lc rgb '{colour}' pt {point + k % 2} ps 1 notitle, "
                         f"'' using 1:2 with linespoints lc rgb '{colour}' pt {point + k % 2} dt {k + 1} title '{law}, {solver}'")
    front = out / f"{base}_front.dat"
    front.write_text("".join(f"{r['seconds']} {100 * r['error']}\n" for r in pareto(done)))
    plots.append(f"'{front.name}' using 1:2 with lines lw 6 lc rgb '#40bbbbbb' title 'Pareto front'")
    body = (f"set title 'accuracy against time: {name}'\nset logscale xy\nset grid\nset key outside right\nset xlabel 'wall time of the run [s]'\n"
            f"set ylabel 'error of the force curve [%]'\nplot {', '.join(plots)}\nunset output\n")
    script = out / f"{base}.gp"
    script.write_text("".join(f"set terminal {kind} size 1100,600 noenhanced background rgb 'white' font 'sans,12'\nset output '{base}.{end}'\n{body}"
                              for kind, end in (("pngcairo", "png"), ("svg", "svg"))))
    subprocess.run(["gnuplot", script.name], cwd=out, check=True)


def cheapest(rows, limit):
    return min((r for r in rows if r["error"] < limit), key=lambda r: r["seconds"], default=None)


def table(header, rows):
    return "\n".join("| " + " | ".join(cells) + " |" for cells in [header, ["---"] * len(header), *rows]) + "\n"


def scene_tables(rows):
    done = [r for r in rows if r["completed"]]
    text = f"References good for {100 * max((r['reference_worth'] for r in done), default=0):.2g} %.\n\n"
    lines = []
    for limit in (0.05, 0.01, 0.001):
        coarse = [r for r in done if r["mesh"] == 1]
        best = cheapest(coarse, limit)
        lu = cheapest([r for r in coarse if r["law"] == "coulomb" and r["solver"] in ("banded", "umfpack")], limit)
        lines.append([f"{100 * limit:g} %"] +
                     ([f"{best['law']}, {best['solver']}", f"{best['steps']} / {best['iterations']}",
                       f"{best['seconds']:.3f} ({best['seconds_min']:.3f}-{best['seconds_max']:.3f})"] if best else ["none of these runs", "", ""]) +
                     ([f"{lu['solver']}, {lu['steps']} / {lu['iterations']}", f"{lu['seconds']:.3f}"] if lu else ["none", ""]))
    text += table(["error below", "cheapest", "steps / iterations", "time, s (min-max)", "cheapest by LU of the exact law", "time, s"], lines)
    for mesh in sorted({r["mesh"] for r in rows}):
        asked = list(dict.fromkeys(r["steps_asked"] for r in rows if r["mesh"] == mesh))
        unknowns = next((r["unknowns"] for r in done if r["mesh"] == mesh), 0)
        lines = []
        for law, solvers in LAWS.items():
            for solver in solvers:
                cells = [next(r for r in rows if (r["law"], r["solver"], r["mesh"], r["steps_asked"]) == (law, solver, mesh, n)) for n in asked]
                lines.append([f"{law}, {solver}"] + [f"{100 * r['error']:.2g} %, {r['seconds']:.3g} s, {r['iterations']}" if r["completed"] else "ended early" for r in cells])
        text += f"\nMesh {mesh} ({unknowns} unknowns): error, time, iterations\n\n" + table(["law, solver"] + [f"{n} steps" for n in asked], lines)
    # The default steps, the law of the paper for one.
    auto = {(r["law"], r["solver"]): r for r in done if r["mesh"] == 1 and r["steps_asked"] == "auto"}
    if ("quasi-coulomb", "banded") in auto:
        base = auto["quasi-coulomb", "banded"]
        text += "\nAt the default steps; the error now as a share of the reference's last force:\n\n" + table(
            ["law, solver", "largest", "at the end", "steps / iterations", "time over quasi-coulomb's, banded"],
            [[f"{law}, {solver}", f"{100 * r['largest_error']:.2f} %", f"{100 * r['last_error']:.2f} %", f"{r['steps']} / {r['iterations']}",
              f"{r['seconds'] / base['seconds']:.2f}"] for (law, solver), r in auto.items()])
    return text


def fine_table(programs):
    scene, lines, first = SCENES["extrusion, unbounded cone"], [], None
    for law, solver in ON_FINE_MESH:
        r = run(programs, scene, law, solver, FINE_MESH, "auto", patience=600)
        if r is None:
            lines.append([f"{law}, {solver}"] + ["ended early"] * 7)
            continue
        forces = r["history"]["force_N"]
        first = first or forces
        apart = max(abs(a - b) for a, b in zip(first, forces)) / max(first) if law == "coulomb" and len(forces) == len(first) else None
        each = lambda key: f"{1000 * r[key] / r['iterations']:.1f}"
        lines.append([f"{law}, {solver}", f"{r['steps']} / {r['iterations']}", f"{apart:.0e}" if apart is not None else "",
                      each("seconds_factorization"), each("seconds_solve"), each("seconds_total"), f"{r['factor_mb']:.1f} MB", f"{r['peak_memory_mb']:.0f} MB"])
    return table(["law, solver", "steps / iterations", "largest difference of forces", "factorisation, ms", "solution, ms", "whole iteration, ms", "factor", "whole process"], lines)


def wedge_table(text, steps="160"):
    rows = [r for r in csv.DictReader(text.splitlines()) if r["steps"] == steps]
    refusal = lambda outcome: "lag feeds back" if "lag feeds back" in outcome else re.split("[;,]", outcome)[0]
    cell = lambda r: f"{float(r['error']):.0e}, {r['iterations']}" if r["outcome"] == "completed" else "refused: " + refusal(r["outcome"])
    return table(["law, solver"] + [f"mu {mu}, kappa {kappa}" for mu, kappa in dict.fromkeys((r["mu"], r["kappa"]) for r in rows)],
                 [[law] + [cell(r) for r in rows if r["law"] == law] for law in dict.fromkeys(r["law"] for r in rows)])


def fill(document, parts):
    """Puts every part between the two lines of the document that name it."""
    text = document.read_text()
    for name, part in parts.items():
        begin, end = f"<!-- {name}: what follows is written by ./reproduce --accuracy -->\n", f"<!-- end of {name} -->"
        if begin not in text or end not in text:
            raise SystemExit(f"accuracy_cost: {document} has no place for the part \"{name}\"")
        before, rest = text.split(begin, 1)
        text = before + begin + "\n" + part.rstrip() + "\n\n" + end + rest.split(end, 1)[1]
    document.write_text(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, required=True, help="build folder with the examples and the benchmarks")
    parser.add_argument("--out", type=pathlib.Path, required=True, help="folder for what is written")
    parser.add_argument("--quick", action="store_true", help="two scenes, fewer steps, no repeats: under three minutes")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--scenes", nargs="+", choices=list(SCENES), default=list(SCENES))
    parser.add_argument("--rebuild-references", action="store_true")
    parser.add_argument("--document", type=pathlib.Path, help="Markdown file that shows the tables and the diagrams; not with --quick")
    arguments = parser.parse_args()
    if arguments.document and (arguments.quick or arguments.scenes != list(SCENES)):
        parser.error("--document wants all scenes at their full length")
    arguments.out.mkdir(parents=True, exist_ok=True)
    programs, begin, rows_by_scene = arguments.build / "examples", time.time(), {}
    for name in arguments.scenes:
        if arguments.quick and name not in QUICK:
            continue
        scene = SCENES[name]
        meshes = QUICK[name] if arguments.quick else scene["steps"]
        references = {mesh: reference_of(programs, name, scene, mesh, arguments.rebuild_references) for mesh in meshes}
        rows_by_scene[name] = measure(programs, name, scene, meshes, references, 1 if arguments.quick else arguments.repeats)
        draw(arguments.out, name, rows_by_scene[name])
        print(f"{name}: {time.time() - begin:.0f} s so far", flush=True)
    wedge = subprocess.run([arguments.build / "bench" / "bench_wedge"], capture_output=True, text=True, check=True).stdout
    (arguments.out / "wedge.csv").write_text(wedge)
    columns = ["scene", "law", "solver", "mesh", "unknowns", "steps_asked", "completed", "steps", "iterations", "factorizations", "rejected_steps",
               "factor_mb", "peak_memory_mb", "error", "largest_error", "last_error", "estimated_lag", "estimated_time", "reference_worth", "seconds", "seconds_min", "seconds_max"]
    with open(arguments.out / "runs.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, columns)
        writer.writeheader()
        for rows in rows_by_scene.values():
            writer.writerows(rows)
    parts = {name: scene_tables(rows) for name, rows in rows_by_scene.items()} | {"wedge": wedge_table(wedge)}
    if not arguments.quick:
        parts["fine mesh"] = fine_table(programs)
    effects = subprocess.run([arguments.build / "bench" / "bench_effects"], capture_output=True, text=True, check=True).stdout
    parts["effects"] = "```\n" + effects.strip() + "\n```\n"
    text = "\n".join(f"**{name}**\n\n{part}" for name, part in parts.items())
    (arguments.out / "tables.md").write_text(text)
    print(text)
    if arguments.document:
        fill(arguments.document, parts)
        for name in rows_by_scene:
            shutil.copy(arguments.out / f"{file_name(name)}.png", arguments.document.parent / "images" / f"accuracy_{file_name(name)}.png")


if __name__ == "__main__":
    main()
