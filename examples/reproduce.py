#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Runs the paper's benchmarks, prints its tables with ours beside them and draws the figures. See ./reproduce."""

import argparse
import bisect
import json
import pathlib
import statistics
import subprocess
import sys

LAWS = ("quasi-coulomb", "coulomb")  # the paper's "Sym" and "Non sym"

# García Garino & Ponthot, table 2: mu -> law -> (steps, iterations).
PAPER_OSU = {
    0.00: {"quasi-coulomb": (101, 301), "coulomb": (101, 301)},
    0.15: {"quasi-coulomb": (65, 173), "coulomb": (58, 158)},
    0.30: {"quasi-coulomb": (67, 194), "coulomb": (66, 189)},
}

# Solvers compared: what the symmetric law takes against what the non-symmetric law needs.
PAIRS = (("banded", "banded"), ("cholmod", "umfpack"), ("eigen-ldlt", "eigen-lu"))


class Failed(Exception):
    pass


def run(program, *options):
    """Runs a benchmark and returns its JSON."""
    command = [str(program), *options, "--quiet", "--json", "-"]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise Failed(f"{' '.join(command)} ended with exit code {done.returncode}: {done.stderr.strip()}")
    return json.loads(done.stdout)


def options(law, mu, solver="banded"):
    return ["--friction", law, "--mu", str(mu), "--solver", solver]


def force_at(result, travel):
    """Force at a travel, linear between the steps."""
    x, y = result["history"]["displacement_mm"], result["history"]["force_N"]
    i = min(max(bisect.bisect_right(x, travel) - 1, 0), len(x) - 2)
    return y[i] + (y[i + 1] - y[i]) * (travel - x[i]) / (x[i + 1] - x[i])


def largest_difference(a, b):
    """Largest difference of two force curves over the common travel, as a part of the first one's peak, and where."""
    end = min(a["history"]["displacement_mm"][-1], b["history"]["displacement_mm"][-1])
    travels = [end * k / 2000 for k in range(2001)]
    difference, where = max((abs(force_at(a, x) - force_at(b, x)), x) for x in travels)
    return difference / max(a["history"]["force_N"]), where


def table(header, rows):
    widths = [max(len(str(row[i])) for row in [header, *rows]) for i in range(len(header))]
    line = lambda row: "| " + " | ".join(str(c).ljust(w) for c, w in zip(row, widths)) + " |"
    return "\n".join([line(header), line(["-" * w for w in widths]), *map(line, rows)])


def spread(values, form):
    return f"{form(statistics.median(values))} ({form(min(values))}-{form(max(values))})"


def draw(directory, name, body):
    """Writes a gnuplot script and has it drawn as PNG and SVG."""
    script = "".join(
        f"set terminal {kind} size 900,600 noenhanced background rgb 'white' font 'sans,12'\nset output '{name}.{end}'\n{body}\nunset output\n"
        for kind, end in (("pngcairo", "png"), ("svg", "svg"))
    )
    (directory / f"{name}.gp").write_text(script)
    try:
        subprocess.run(["gnuplot", f"{name}.gp"], cwd=directory, check=True, capture_output=True, text=True)
    except FileNotFoundError:
        raise Failed("gnuplot is missing; install the package gnuplot-nox") from None
    except subprocess.CalledProcessError as error:
        raise Failed(f"gnuplot could not draw {directory / name}: {error.stderr.strip()}") from None


def osu_punch(programs, out, repeats):
    program = programs / "osu_punch"
    results = {}
    for mu in PAPER_OSU:
        for law in LAWS:
            folder = out / "osu_punch" / f"{law}-{mu:.2f}"
            results[mu, law] = run(program, *options(law, mu), "--output", str(folder))

    say("OSU hemispherical punch, axisymmetric, 14 x 2 elements (paper, table 2)\n")
    rows = []
    for mu in PAPER_OSU:
        difference, where = largest_difference(results[mu, "coulomb"], results[mu, "quasi-coulomb"])
        for law in LAWS:
            r = results[mu, law]
            steps, iterations = PAPER_OSU[mu][law]
            rows.append(
                [f"{mu:.2f}", law, f"{steps} / {iterations}", f"{r['steps']} / {r['iterations']}", r["rejected_steps"],
                 f"{r['final_force_N'] / 1000:.2f}", f"{r['max_penetration_mm']:.3f}", f"{r['max_slip_mm']:.2f}", f"{r['max_plastic_strain']:.3f}",
                 f"{100 * difference:.2f} % at {where:.1f} mm" if law == "quasi-coulomb" and mu > 0 else ""])
    say(table(["mu", "law", "paper steps / iterations", "ours", "rejected", "force at 40 mm [kN]", "penetration [mm]", "slip [mm]", "plastic strain",
               "largest difference of the laws' forces, of the peak"], rows))

    say("\nTime of a run, median of paired runs (smallest-largest)\n")
    rows = []
    for symmetric, general in PAIRS:
        for mu in (0.15, 0.30):
            sym, non, ratio = [], [], []
            for _ in range(repeats):
                a = run(program, *options("quasi-coulomb", mu, symmetric))["seconds_total"]
                b = run(program, *options("coulomb", mu, general))["seconds_total"]
                sym.append(a), non.append(b), ratio.append(a / b)
            ms = lambda s: f"{1000 * s:.1f}"
            rows.append([f"{mu:.2f}", f"{symmetric} / {general}", spread(sym, ms), spread(non, ms), spread(ratio, lambda r: f"{r:.2f}")])
    say(table(["mu", "solvers Sym / Non sym", "Sym [ms]", "Non sym [ms]", "Sym / Non sym"], rows))

    # The paper's figure 5.
    curves = []
    for mu, colour in ((0.30, "#d62728"), (0.15, "#1f77b4"), (0.00, "#2ca02c")):
        data = lambda law: f"'{law}-{mu:.2f}/history.csv' every ::1 using 3:($4/1000)"
        curves.append(f"{data('coulomb')} with lines lw 2 lc rgb '{colour}' title 'Coulomb, mu = {mu:.2f}'")
        if mu > 0:
            curves.append(f"{data('quasi-coulomb')} with points pt 6 ps 0.8 lc rgb '{colour}' title 'Quasi-Coulomb, mu = {mu:.2f}'")
    draw(out / "osu_punch", "force",
         "set datafile separator ','\nset title 'OSU hemispherical punch: punch force (paper, figure 5)'\nset xlabel 'punch travel [mm]'\n"
         "set ylabel 'punch force [kN]'\nset grid\nset key top left\nplot " + ", \\\n".join(curves))
    return all(r["completed"] for r in results.values())


said = []


def say(text):
    print(text)
    said.append(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--programs", type=pathlib.Path, required=True, help="folder of the built examples")
    parser.add_argument("--out", type=pathlib.Path, required=True, help="folder for data and pictures")
    parser.add_argument("--quick", action="store_true", help="time every run once")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    try:
        completed = osu_punch(arguments.programs, arguments.out, 1 if arguments.quick else 11)
    except Failed as error:
        sys.exit(f"reproduce: {error}")
    (arguments.out / "tables.md").write_text("\n".join(said) + "\n")
    print(f"\nPictures and data are under {arguments.out}/, the tables in {arguments.out / 'tables.md'}")
    if not completed:
        sys.exit("reproduce: not every run reached its end")


if __name__ == "__main__":
    main()
