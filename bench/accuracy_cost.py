#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""What accuracy costs in time: the paper's benchmarks under every law and solver at several step counts, each against a
converged run of exact Coulomb friction on the same mesh.

    bench/accuracy_cost.py --programs build/release/examples --out out/accuracy [--quick] [--rebuild-references]

Writes runs.csv, a work-precision diagram a scene (error of the force over the wall time of the run, Pareto front marked)
and tables.md. The error is the L2 norm of the difference of the force-travel curves over the norm of the reference's. The
references lie in bench/references with what made them. Runs of one scene are interleaved and repeated; times are
medians, with the smallest and the largest. Needs gnuplot for the diagrams."""

import argparse
import bisect
import csv
import json
import math
import pathlib
import statistics
import subprocess
import time

HERE = pathlib.Path(__file__).resolve().parent

# A scene: the program, what it is told, step counts, those of the reference, how far the curves are compared.
SCENES = {
    "extrusion, unbounded cone": {
        "program": "conical_extrusion", "options": ["--mu", "0.1"], "steps": [60, 125, 250, 500, 1000], "reference": 5000, "until": 178},
    "extrusion, container": {
        "program": "conical_extrusion", "options": ["--mu", "0.1", "--die", "container"], "steps": [60, 125, 250, 500, 1000],
        "reference": 5000, "until": 178},
    "punch": {"program": "osu_punch", "options": ["--mu", "0.3"], "steps": [30, 60, 125, 250, 500], "reference": 4000, "until": 40},
    "tube": {"program": "shock_absorber", "options": ["--mu", "0.15"], "steps": [160, 320, 640, 1280], "reference": 5000, "until": 42},
}
QUICK = {"extrusion, unbounded cone": [60, 125, 250], "punch": [30, 125]}

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


def run(programs, scene, law, solver, steps, tolerance=None):
    """A run's JSON, or None if it did not reach its end."""
    command = [str(programs / scene["program"]), *scene["options"], "--friction", law, "--solver", solver, "--steps", str(steps),
               "--quiet", "--json", "-"]
    if tolerance:
        command += ["--tolerance", str(tolerance)]
    done = subprocess.run(command, capture_output=True, text=True)
    return json.loads(done.stdout[done.stdout.index("{"):]) if done.returncode == 0 else None


def at(curve, travel):
    x, y = curve
    i = min(max(bisect.bisect_right(x, travel) - 1, 0), len(x) - 2)
    return y[i] + (y[i + 1] - y[i]) * (travel - x[i]) / (x[i + 1] - x[i])


def error(curve, reference, until):
    travels = [until * k / 1000 for k in range(1001)]
    exact = [at(reference, x) for x in travels]
    return math.sqrt(sum((at(curve, x) - e) ** 2 for x, e in zip(travels, exact)) / sum(e * e for e in exact))


def reference_of(programs, name, scene, rebuild):
    """The converged curve, and how far one with half the steps is from it: what the reference itself is worth."""
    file = HERE / "references" / (name.replace(", ", "_").replace(" ", "_") + ".json")
    if not rebuild and file.exists():
        stored = json.loads(file.read_text())
        return (stored["travel_mm"], stored["force_N"]), stored["worth"]
    curves = []
    for steps in (scene["reference"] // 2, scene["reference"]):
        r = run(programs, scene, "coulomb", "banded", steps, 1e-6)
        if r is None:
            raise SystemExit(f"accuracy_cost: the reference of {name} did not reach its end")
        curves.append((r["history"]["displacement_mm"], r["history"]["force_N"]))
    worth = error(curves[0], curves[1], scene["until"])
    travels = [scene["until"] * k / 1000 for k in range(1001)]
    file.parent.mkdir(exist_ok=True)
    file.write_text(json.dumps({
        "made_by": f"{scene['program']} {' '.join(scene['options'])} --friction coulomb --solver banded --steps {scene['reference']} --tolerance 1e-6",
        "steps": r["steps"], "iterations": r["iterations"], "worth": worth,
        "worth_is": "relative L2 difference of the same with half the steps",
        "travel_mm": travels, "force_N": [round(at(curves[1], x), 4) for x in travels]}))
    return (travels, [at(curves[1], x) for x in travels]), worth


def measure(programs, name, scene, steps, repeats):
    reference, worth = scene["curve"], scene["worth"]
    jobs = [(law, solver, n) for law, solvers in LAWS.items() for solver in solvers for n in steps]
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
        row = {"scene": name, "law": job[0], "solver": job[1], "steps_asked": job[2], "completed": r is not None}
        if r:
            row |= {"steps": r["steps"], "iterations": r["iterations"], "factorizations": r["factorizations"],
                    "rejected_steps": r["rejected_steps"], "peak_memory_mb": round(r["peak_memory_mb"], 1),
                    "error": error((r["history"]["displacement_mm"], r["history"]["force_N"]), reference, scene["until"]),
                    "reference_worth": worth, "seconds": statistics.median(seconds[job]),
                    "seconds_min": min(seconds[job]), "seconds_max": max(seconds[job])}
        rows.append(row)
    return rows


def pareto(rows):
    """The runs that no other is both quicker and more accurate than."""
    front, best = [], math.inf
    for r in sorted(rows, key=lambda r: r["seconds"]):
        if r["error"] < best:
            front.append(r)
            best = r["error"]
    return front


def draw(out, name, rows):
    base = name.replace(", ", "_").replace(" ", "_")
    done = [r for r in rows if r["completed"]]
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


def tables(rows_by_scene):
    lines = []
    for name, rows in rows_by_scene.items():
        done = [r for r in rows if r["completed"]]
        lines += [f"**{name}** (reference good for {100 * rows[0].get('reference_worth', 0):.2g} %)\n",
                  "| error below | cheapest | steps / iterations | time, s (min-max) | cheapest of the exact law by LU | time, s |", "|---|---|---|---|---|---|"]
        for limit in (0.05, 0.01, 0.001):
            def cheapest(candidates):
                good = [r for r in candidates if r["error"] < limit]
                return min(good, key=lambda r: r["seconds"]) if good else None
            best, lu = cheapest(done), cheapest([r for r in done if r["law"] == "coulomb" and r["solver"] in ("banded", "umfpack")])
            lines.append(f"| {100 * limit:g} % | " + (
                f"{best['law']}, {best['solver']} | {best['steps']} / {best['iterations']} | {best['seconds']:.3f} ({best['seconds_min']:.3f}-{best['seconds_max']:.3f}) | "
                if best else "none of these runs | | | ") + (f"{lu['solver']}, {lu['steps']} / {lu['iterations']} | {lu['seconds']:.3f} |" if lu else "none | |"))
        lines += ["", "| law, solver | " + " | ".join(str(n) for n in sorted({r["steps_asked"] for r in rows})) + " steps |",
                  "|---|" + "---|" * len({r["steps_asked"] for r in rows})]
        for law, solvers in LAWS.items():
            for solver in solvers:
                cells = []
                for n in sorted({r["steps_asked"] for r in rows}):
                    r = next(r for r in rows if (r["law"], r["solver"], r["steps_asked"]) == (law, solver, n))
                    cells.append(f"{100 * r['error']:.2g} %, {r['seconds']:.2f} s, {r['iterations']}" if r["completed"] else "ended early")
                lines.append(f"| {law}, {solver} | " + " | ".join(cells) + " |")
        lines.append("")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--programs", type=pathlib.Path, required=True, help="folder of the built examples")
    parser.add_argument("--out", type=pathlib.Path, required=True, help="folder for what is written")
    parser.add_argument("--quick", action="store_true", help="two scenes, fewer steps, no repeats: under three minutes")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--scenes", nargs="+", choices=list(SCENES), default=list(SCENES))
    parser.add_argument("--rebuild-references", action="store_true")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    begin, rows_by_scene = time.time(), {}
    for name in arguments.scenes:
        if arguments.quick and name not in QUICK:
            continue
        scene = SCENES[name]
        scene["curve"], scene["worth"] = reference_of(arguments.programs, name, scene, arguments.rebuild_references)
        rows_by_scene[name] = measure(arguments.programs, name, scene, QUICK[name] if arguments.quick else scene["steps"], 1 if arguments.quick else arguments.repeats)
        draw(arguments.out, name, rows_by_scene[name])
        print(f"{name}: {time.time() - begin:.0f} s so far", flush=True)
    columns = ["scene", "law", "solver", "steps_asked", "completed", "steps", "iterations", "factorizations", "rejected_steps", "peak_memory_mb",
               "error", "reference_worth", "seconds", "seconds_min", "seconds_max"]
    with open(arguments.out / "runs.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, columns)
        writer.writeheader()
        for rows in rows_by_scene.values():
            writer.writerows(rows)
    text = tables(rows_by_scene)
    (arguments.out / "tables.md").write_text(text + "\n")
    print(text)


if __name__ == "__main__":
    main()
