#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Draws the folders of the library and what includes what, from the headers themselves: docs/images/rooms.svg.

rooms.py [--check]   needs Graphviz' dot; --check only prints the edges, without dot
"""
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
LIBRARY = ROOT / "include/stickslip"
POLICIES = {"kinematics", "element", "material", "friction", "enforcement", "time_integration", "damping", "linear_solver"}
FLOORS = [["io", "verify", "advise", "run_time"], ["problem"], ["scene"], ["solve"], ["body", "contact"], ["dofs"],
          ["models of the policies", "geometry"], ["policy", "mesh"], ["tensor"], ["base"]]


def room(path):
    part = path.split("/")[0].removesuffix(".hpp")
    return "models of the policies" if part in POLICIES else part


def edges():
    """(from, to) -> number of includes."""
    count = {}
    for header in sorted(LIBRARY.rglob("*.hpp")):
        here = room(str(header.relative_to(LIBRARY)))
        for target in re.findall(r"#include <stickslip/([^>]+)>", header.read_text(encoding="utf-8")):
            there = room(target)
            if here != there and "stickslip" not in (here, there) and "version" not in (here, there):
                count[here, there] = count.get((here, there), 0) + 1
    return count


def reduced(count):
    """Without the edges that a longer way shows as well."""
    following = {}
    for here, there in count:
        following.setdefault(here, set()).add(there)

    def reaches(here, goal):
        return any(n == goal or reaches(n, goal) for n in following.get(here, ()))

    return {(a, b): n for (a, b), n in count.items() if not any(c != b and reaches(c, b) for c in following[a])}


def main():
    count = edges()
    if "--check" in sys.argv:
        for (here, there), n in sorted(count.items()):
            print(f"{here} -> {there}: {n}")
        return
    lines = {}
    for header in LIBRARY.rglob("*.hpp"):
        here = room(str(header.relative_to(LIBRARY)))
        files, length = lines.get(here, (0, 0))
        lines[here] = files + 1, length + len(header.read_text(encoding="utf-8").splitlines())
    dot = ["digraph rooms {", '  rankdir=TB; nodesep=0.35; ranksep=0.4;',
           '  node [shape=box, style="rounded,filled", fillcolor="#eef3f8", color="#5b7a99", fontname="Helvetica", fontsize=12];',
           '  edge [color="#7a8a99", arrowsize=0.7];']
    for floor in FLOORS:
        for name in floor:
            files, length = lines[name]
            label = f"{name}\\n{files} files, {length} lines" if files > 1 else f"{name}.hpp\\n{length} lines"
            dot.append(f'  "{name}" [label="{label}"];')
        dot.append("  { rank=same; " + " ".join(f'"{name}";' for name in floor) + " }")
    dot += [f'  "{here}" -> "{there}";' for here, there in sorted(reduced(count))]
    dot.append("}")
    target = ROOT / "docs/images/rooms.svg"
    subprocess.run(["dot", "-Tsvg", "-o", str(target)], input="\n".join(dot), text=True, check=True)
    print(target.relative_to(ROOT))


if __name__ == "__main__":
    main()
