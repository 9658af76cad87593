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

# García Garino & Ponthot: steps and iterations by friction coefficient and law; table 2, table 4 and section III.C.
PAPER = {
    "osu_punch": {
        0.00: {"quasi-coulomb": (101, 301), "coulomb": (101, 301)},
        0.15: {"quasi-coulomb": (65, 173), "coulomb": (58, 158)},
        0.30: {"quasi-coulomb": (67, 194), "coulomb": (66, 189)},
    },
    "shock_absorber": {
        0.00: {"quasi-coulomb": (145, 411), "coulomb": (145, 411)},
        0.15: {"quasi-coulomb": (150, 428), "coulomb": (143, 411)},
        0.30: {"quasi-coulomb": (147, 432), "coulomb": (153, 430)},
    },
    "conical_extrusion": {0.10: {"quasi-coulomb": (136, 348), "coulomb": (115, 264)}},
}

# Solvers compared: what the symmetric law takes against what the non-symmetric law needs.
PAIRS = (("banded", "banded"), ("cholmod", "umfpack"), ("eigen-ldlt", "eigen-lu"))

# The paper's tube passes through itself.
THROUGH_ITSELF = ("--self-contact", "off")

COLOURS = {0.30: "#d62728", 0.15: "#1f77b4", 0.10: "#1f77b4", 0.00: "#2ca02c"}


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


def draw(directory, name, body, size="900,600"):
    """Writes a gnuplot script and has it drawn as PNG and SVG."""
    script = "".join(
        f"set terminal {kind} size {size} noenhanced background rgb 'white' font 'sans,12'\nset output '{name}.{end}'\n{body}\nunset output\n"
        for kind, end in (("pngcairo", "png"), ("svg", "svg"))
    )
    (directory / f"{name}.gp").write_text(script)
    try:
        subprocess.run(["gnuplot", f"{name}.gp"], cwd=directory, check=True, capture_output=True, text=True)
    except FileNotFoundError:
        raise Failed("gnuplot is missing; install the package gnuplot-nox") from None
    except subprocess.CalledProcessError as error:
        raise Failed(f"gnuplot could not draw {directory / name}: {error.stderr.strip()}") from None


def run_all(programs, out, name, extra=(), label=""):
    """Every run of a benchmark in the paper, with files; `extra` are further options, `label` goes before their folders."""
    return {
        (mu, law): run(programs / name, *options(law, mu), *extra, "--output", str(out / name / f"{label}{law}-{mu:.2f}"))
        for mu in PAPER[name]
        for law in LAWS
    }


def counts(name, results, extra=()):
    """Prints the paper's counts beside ours; `extra` are further columns, a header and a function of a result each."""
    rows = []
    for (mu, law), r in results.items():
        steps, iterations = PAPER[name][mu][law]
        rows.append([f"{mu:.2f}", law, f"{steps} / {iterations}", f"{r['steps']} / {r['iterations']}", r["rejected_steps"],
                     f"{r['final_force_N'] / 1000:.2f}", f"{r['max_penetration_mm']:.4f}", f"{r['max_slip_mm']:.2f}",
                     f"{r['max_plastic_strain']:.3f}", *(form(r) for _, form in extra)])
    say(table(["mu", "law", "paper steps / iterations", "ours", "rejected", "final force [kN]", "penetration [mm]", "slip [mm]", "plastic strain",
               *(header for header, _ in extra)], rows))


def times(programs, name, repeats, extra=()):
    """Prints the times of the symmetric law against those of the non-symmetric one, run in turn."""
    say(f"\nTime of a run, median of {repeats} paired runs (smallest-largest)\n")
    rows = []
    for symmetric, general in PAIRS:
        for mu in PAPER[name]:
            if mu == 0:
                continue
            sym, non, ratio = [], [], []
            for _ in range(repeats):
                a = run(programs / name, *options("quasi-coulomb", mu, symmetric), *extra)["seconds_total"]
                b = run(programs / name, *options("coulomb", mu, general), *extra)["seconds_total"]
                sym.append(a), non.append(b), ratio.append(a / b)
            ms = lambda s: f"{1000 * s:.1f}"
            rows.append([f"{mu:.2f}", f"{symmetric} / {general}", spread(sym, ms), spread(non, ms), spread(ratio, lambda r: f"{r:.2f}")])
    say(table(["mu", "solvers Sym / Non sym", "Sym [ms]", "Non sym [ms]", "Sym / Non sym"], rows))


def draw_forces(out, name, title, x, y, column="3"):
    curves = []
    for mu in sorted(PAPER[name], reverse=True):
        data = lambda law: f"'{law}-{mu:.2f}/history.csv' every ::1 using {column}:($4/1000)"
        curves.append(f"{data('coulomb')} with lines lw 2 lc rgb '{COLOURS[mu]}' title 'Coulomb, mu = {mu:.2f}'")
        if mu > 0:
            curves.append(f"{data('quasi-coulomb')} with points pt 6 ps 0.8 lc rgb '{COLOURS[mu]}' title 'Quasi-Coulomb, mu = {mu:.2f}'")
    draw(out / name, "force", f"set datafile separator ','\nset title '{title}'\nset xlabel '{x}'\nset ylabel '{y}'\nset grid\nset key top left\nplot "
         + ", \\\n".join(curves))


def shots(folder):
    """The deformed meshes that a run has kept, by travel: (travel, file)."""
    found = [(float(p.stem.split("_")[1]), p.name) for p in folder.glob("mesh_*.dat")]
    return sorted(found)


def draw_sequence(directory, name, title, files, shift, view, tool=None, size="900,600"):
    """Deformed meshes side by side, each `shift` mm to the right of the one before; `files` are (label, file). A `tool` is
    drawn with each, up to an abscissa: (file, abscissa)."""
    plots, labels = [], []
    for i, (label, file) in enumerate(files):
        plots.append(f"'{file}' using ($1+{i * shift}):2:3 with pm3d")
        if tool:
            plots.append(f"'{tool[0]}' using ($1<{tool[1]} ? $1+{i * shift} : NaN):2:(0) with lines lw 2 lc rgb 'black'")
        labels.append(f"set label {i + 1} '{label}' at first {i * shift + view['label'][0]}, first {view['label'][1]} front")
    draw(directory, name, f"set title '{title}'\nset view map\nset size ratio -1\nunset key\nset cblabel 'plastic strain'\n"
         "set palette defined (0 '#440154', 1 '#3b528b', 2 '#21918c', 3 '#5ec962', 4 '#fde725')\n"
         "set pm3d corners2color c1 border lc rgb '#404040' lw 0.2\n" + "\n".join(labels) + f"\n{view['ranges']}\nsplot " + ", ".join(plots), size)


def profile(path):
    """Plastic strain over initial radius: means through the thickness of the columns of elements."""
    columns = {}
    patch = []
    for line in path.read_text().splitlines():
        if line.startswith("#") or not line.strip():
            continue
        patch.append([float(v) for v in line.split()])
        if len(patch) == 4:
            radius = sum(p[3] for p in patch) / 4
            columns.setdefault(round(radius, 6), []).append(patch[0][2])
            patch = []
    return [(r, sum(v) / len(v)) for r, v in sorted(columns.items())]


def osu_punch(programs, out, repeats):
    name = "osu_punch"
    results = run_all(programs, out, name)
    say("\n## OSU hemispherical punch, axisymmetric, 14 x 2 elements (paper, table 2)\n")
    counts(name, results)
    say("")
    for mu in (0.15, 0.30):
        difference, where = largest_difference(results[mu, "coulomb"], results[mu, "quasi-coulomb"])
        say(f"mu = {mu:.2f}: the laws' forces differ by at most {100 * difference:.2f} % of the peak, at {where:.1f} mm.")
    times(programs, name, repeats)
    draw_forces(out, name, "OSU hemispherical punch: punch force (paper, figure 5)", "punch travel [mm]", "punch force [kN]")
    for mu, figure in ((0.15, 6), (0.30, 7)):
        curves = []
        for law, style in (("coulomb", "with lines lw 2"), ("quasi-coulomb", "with points pt 6")):
            folder = out / name / f"{law}-{mu:.2f}"
            for i, (travel, file) in enumerate([*shots(folder), (40.0, "mesh.dat")]):
                data = folder / f"profile_{travel:.0f}.dat"
                data.write_text("".join(f"{r} {p}\n" for r, p in profile(folder / file)))
                curves.append(f"'{law}-{mu:.2f}/{data.name}' {style} lc {i + 1} title '{law}, {travel:.0f} mm'")
        draw(out / name, f"profile_{mu:.2f}", f"set title 'Plastic strain over initial radius, mu = {mu:.2f} (paper, figure {figure})'\n"
             "set xlabel 'initial radius [mm]'\nset ylabel 'plastic strain'\nset grid\nset key outside right\nplot " + ", \\\n".join(curves))
    return results


def conical_extrusion(programs, out, repeats):
    name = "conical_extrusion"
    results = run_all(programs, out, name)
    say("\n## Conical extrusion, axisymmetric, 4 x 20 elements (paper, section III.C)\n")
    counts(name, results)
    exact, lagged = results[0.10, "coulomb"], results[0.10, "quasi-coulomb"]
    final = exact["final_force_N"]
    say("")
    for travel in (44.5, 89, 100, 110, 120, 135, 150, 178):
        a, b = force_at(exact, travel), force_at(lagged, travel)
        say(f"at {travel:5.1f} mm: Coulomb {a / 1000:9.1f} kN, Quasi-Coulomb {b / 1000:9.1f} kN, {100 * (b - a) / a:+6.2f} % of it, {100 * (b - a) / final:+6.2f} % of the final force")
    times(programs, name, repeats)
    draw_forces(out, name, "Conical extrusion: ram force (paper, figure 15)", "ram travel [mm]", "ram force [kN]")
    folder = out / name / "coulomb-0.10"
    draw_sequence(folder, "sequence", "Conical extrusion at 44.5, 89, 135 and 178 mm, Coulomb (paper, figure 14)",
                  [(f"{t:g} mm", f) for t, f in [*shots(folder), (178.0, "mesh.dat")]], 130, {"label": (5, 620), "ranges": "set xrange [-10:490]\nset yrange [0:650]"})
    return results


def shock_absorber(programs, out, repeats):
    name = "shock_absorber"
    results = run_all(programs, out, name, THROUGH_ITSELF)
    say("\n## Shock absorber, axisymmetric, implicit dynamics, 3 x 100 elements (paper, table 4)\n")
    own = lambda r: "no" if r["self_penetration_from_mm"] is None else f"from {r['self_penetration_from_mm']:.1f} mm"
    counts(name, results, [("through itself", own), ("energy not accounted for", lambda r: f"{100 * abs(r['unbalanced_work_J']) / r['external_work_J']:.3f} %")])
    say("")
    for mu in PAPER[name]:
        if mu == 0:
            continue
        a, b = results[mu, "coulomb"], results[mu, "quasi-coulomb"]
        end = min(r["self_penetration_from_mm"] or 50 for r in (a, b))
        travels = [end * k / 1000 for k in range(1001)]
        square = sum((force_at(a, x) - force_at(b, x)) ** 2 for x in travels) / sum(force_at(a, x) ** 2 for x in travels)
        say(f"mu = {mu:.2f}: relative L2 difference of the laws' forces up to {end:.1f} mm {100 * square ** 0.5:.2f} %")
    times(programs, name, repeats, THROUGH_ITSELF)
    folds = run_all(programs, out, name, label="folds-")
    say("\n### The same in contact with itself, to the end\n")
    counts(name, folds, [("deepest in itself [mm]", lambda r: f"{r['deepest_in_itself_mm']:.3f}"),
                         ("energy not accounted for", lambda r: f"{100 * abs(r['unbalanced_work_J']) / r['external_work_J']:.3f} %"),
                         ("algorithmic", lambda r: f"{100 * r['algorithmic_work_J'] / r['external_work_J']:.2f} %")])
    draw_forces(out, name, "Shock absorber: force on the upper end (paper, figure 13)", "time [ms]", "force [kN]", "($2*1000)")
    for mu, figure in ((0.00, 9), (0.15, 10), (0.30, 11)):
        folder = out / name / f"coulomb-{mu:.2f}"
        files = [(f"{t / 40:.2f} ms", f) for t, f in [*shots(folder), (50.0, "mesh.dat")]]
        draw_sequence(folder, "sequence", f"Shock absorber, mu = {mu:.2f}, Coulomb (paper, figure {figure})", files, 40,
                      {"label": (18, 66), "ranges": "set xrange [15:230]\nset yrange [-10:70]"})
    draw_sequence(out / name, "final", "Shock absorber: final shapes, Coulomb (paper, figure 12)",
                  [(f"mu = {mu:.2f}", f"coulomb-{mu:.2f}/mesh.dat") for mu in PAPER[name]], 40, {"label": (18, 25), "ranges": "set xrange [15:150]\nset yrange [-10:35]"})
    for mu in (0.15, 0.30):
        folder = out / name / f"folds-coulomb-{mu:.2f}"
        files = [(f"{t:g} mm", f) for t, f in [*shots(folder), (50.0, "mesh.dat")] if t >= 20]
        draw_sequence(folder, "folds", f"Shock absorber in contact with itself, mu = {mu:.2f}, Coulomb", files, 21,
                      {"label": (27, 22.5), "ranges": "set xrange [19:106]\nset yrange [-6:24]"}, ("tools.dat", 200), "1400,620")
    return results


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
    repeats = 1 if arguments.quick else 11
    results = []
    try:
        for benchmark in (osu_punch, shock_absorber, conical_extrusion):
            results += benchmark(arguments.programs, arguments.out, repeats).values()
    except Failed as error:
        sys.exit(f"reproduce: {error}")
    say(f"\nThe paper's {len(results)} runs took {sum(r['seconds_total'] for r in results):.2f} s on one core.")
    (arguments.out / "tables.md").write_text("\n".join(said) + "\n")
    print(f"\nPictures and data are under {arguments.out}/, the tables in {arguments.out / 'tables.md'}")
    if not all(r["completed"] for r in results):
        sys.exit("reproduce: not every run reached its end")


if __name__ == "__main__":
    main()
