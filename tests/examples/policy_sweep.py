# SPDX-License-Identifier: BSL-1.0
"""The table of the compile-time experiment: every model runs, and the columns say what they must."""

import subprocess
import sys

program = sys.argv[1]
HEADING = ["model", "along/N", "up/N", "diff./%", "steps", "iter.", "passes", "time/ms", "tangent", "point", "node"]


def run(*options):
    return subprocess.run([program, *options], capture_output=True, text=True, timeout=300)


table = run()
assert table.returncode == 0, table.stdout + table.stderr
lines = table.stdout.splitlines()
start = next(i for i, line in enumerate(lines) if line.split() == HEADING)
rows = {}
for line in lines[start + 1 :]:
    numbers = line[34:].split()
    assert len(numbers) == len(HEADING) - 1, line
    rows[line[:34].strip()] = dict(zip(HEADING[1:], numbers))
assert len(rows) == 9, list(rows)

reference = rows["Coulomb, penalty, finite J2"]
assert float(reference["diff./%"]) == 0
for name, row in rows.items():
    assert float(row["up/N"]) > 0 > float(row["along/N"]), name  # the strip pushes the roller up and holds it back
    assert int(row["iter."]) >= int(row["steps"]) >= 100, name
    symmetric = name in ("pressure of the last step", "pressure extrapolated", "pressure iterated",
                         "augmented, symmetric", "no friction")
    assert row["tangent"] == ("symmetric" if symmetric else "general"), name
    if name in ("pressure iterated", "augmented Lagrangian", "augmented, symmetric"):
        assert int(row["passes"]) > int(row["steps"]), name
# The pressure that passes bring up to date is the current one, to the passes' tolerance.
assert float(rows["pressure iterated"]["diff./%"]) <= 0.1
assert float(rows["augmented, symmetric"]["diff./%"]) < 1
assert rows["no friction"]["node"] == "0"
assert float(rows["capped at the shear yield stress"]["along/N"]) > float(reference["along/N"])

for options in (["--refine"], ["--refine", "0"], ["--steps", "many"], ["--law", "coulomb"]):
    refused = run(*options)
    assert refused.returncode == 2 and "usage" in refused.stderr and not refused.stdout, options
assert run("--help").returncode == 0
with open("/dev/full", "w") as full:
    lost = subprocess.run([program, "--steps", "20"], stdout=full, stderr=subprocess.PIPE, text=True)
    assert lost.returncode == 1 and "could not be written" in lost.stderr, lost
