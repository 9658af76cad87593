#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Compares the benchmarks of two builds: runs the same programs of both with the same options and compares what they
write with --json, all but times and memory.

compare_runs.py OLD NEW [--forces TOLERANCE] [--quick]

OLD and NEW are folders with the programs of examples/. Counts (steps, iterations, rejected steps) must be the same; all
other numbers bit for bit, or with --forces to that relative tolerance. Exit code 1: something differs.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

LAWS = ["coulomb", "quasi-coulomb"]
SOLVERS = {"coulomb": ["eigen-lu", "umfpack", "corrected-cholmod", "banded"], "quasi-coulomb": ["eigen-ldlt", "cholmod", "banded"]}
RUNS = [(program, ["--friction", law, "--mu", mu])
        for program, mus in (("osu_punch", ["0.15", "0.30"]), ("conical_extrusion", ["0.1"]), ("shock_absorber", ["0.15", "0.30"]))
        for mu in mus for law in LAWS]
RUNS += [("shock_absorber", ["--friction", law, "--mu", "0.30", "--self-contact", "off"]) for law in LAWS]
MORE = [(program, ["--friction", law, "--solver", solver]) for program in ("osu_punch", "conical_extrusion", "shock_absorber")
        for law in LAWS for solver in SOLVERS[law]]
MORE += [("osu_punch", ["--friction", law]) for law in ("frictionless", "extrapolated-quasi-coulomb", "lag-iterated-coulomb",
                                                         "symmetrised-coulomb")]
COUNTS = {"steps", "iterations", "rejected_steps"}
LEFT_OUT = ("seconds", "memory", "evaluations", "tangents", "line_search_cuts")


def run(folder, program, options):
    with tempfile.TemporaryDirectory() as place:
        target = pathlib.Path(place) / "run.json"
        done = subprocess.run([str(folder / program), *options, "--quiet", "--json", str(target)], capture_output=True,
                              text=True)
        if not target.exists():
            return {"failed": done.stderr.strip()}
        return json.loads(target.read_text())


def differences(old, new, tolerance, path=""):
    """Names what differs: a list of (path, old, new)."""
    if any(word in path.split(".")[-1] for word in LEFT_OUT):
        return []
    if isinstance(old, dict) and isinstance(new, dict):
        return [d for key in sorted(old.keys() | new.keys())
                for d in differences(old.get(key), new.get(key), tolerance, f"{path}.{key}" if path else key)]
    if isinstance(old, list) and isinstance(new, list) and len(old) == len(new):
        scale = max((abs(x) for x in old if isinstance(x, float)), default=0)
        return [d for k, (a, b) in enumerate(zip(old, new))
                for d in ([] if isinstance(a, float) and isinstance(b, float) and abs(a - b) <= tolerance * scale
                          else differences(a, b, tolerance, f"{path}[{k}]"))]
    if old == new:
        return []
    if isinstance(old, float) and isinstance(new, float) and path.split(".")[-1] not in COUNTS \
            and abs(old - new) <= tolerance * max(abs(old), abs(new)):
        return []
    return [(path, old, new)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("old", type=pathlib.Path)
    parser.add_argument("new", type=pathlib.Path)
    parser.add_argument("--forces", type=float, default=0)
    parser.add_argument("--quick", action="store_true", help="the default solver alone")
    options = parser.parse_args()
    unlike = 0
    for program, words in RUNS + ([] if options.quick else MORE):
        old, new = run(options.old, program, words), run(options.new, program, words)
        found = differences(old, new, options.forces)
        unlike += bool(found)
        counts = f"{new.get('steps')} / {new.get('iterations')}"
        work = [new.get(key, 0) for key in ("evaluations", "tangents_unused", "evaluations_repeated")]
        lost = f", {100 * (work[1] + work[2]) / work[0]:.1f} % of {work[0]} evaluations unused or repeated" if work[0] else ""
        print(f"{program} {' '.join(words)}: {counts}{lost}; " + (f"{len(found)} differ" if found else "the same"), flush=True)
        for path, a, b in found[:6]:
            print(f"    {path}: {a} -> {b}")
    return unlike > 0


if __name__ == "__main__":
    sys.exit(main())
