# SPDX-License-Identifier: BSL-1.0
"""The cylinder drawn along a block: both laws and every solver over a short way, one answer a law."""

import json
import subprocess
import sys

program = sys.argv[1]


def run(*options):
    return subprocess.run([program, *options], capture_output=True, text=True, timeout=300)


listed = {law: solvers.split() for law, solvers in (line.split(":") for line in run("--list").stdout.splitlines())}
assert set(listed) == {"coulomb", "quasi-coulomb"}, listed
for law, solvers in listed.items():
    forces = []
    for solver in solvers:
        done = run("--friction", law, "--solver", solver, "--depth", "0.1", "--way", "0.2", "--steps", "6", "--tolerance", "1e-8", "--json", "-")
        assert done.returncode == 0 and done.stderr == "", (law, solver, done.stderr)
        r = json.loads(done.stdout)
        assert (r["kinematics"], r["elements"], r["unknowns"]) == ("three-dimensional", 960, 3444), r["unknowns"]
        assert r["symmetric_storage"] == (law != "coulomb" or solver.startswith("corrected")), (law, solver)
        assert r["max_slip_mm"] > 0.01 and r["max_plastic_strain"] > 0.01, solver
        forces.append(r["final_force_N"])
    # The block holds the cylinder back, by more than friction alone would where it sinks in.
    assert min(forces) > 0 and max(forces) - min(forces) < 1e-5 * max(forces), (law, forces)
