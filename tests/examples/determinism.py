#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""The same run writes the same bytes again, and whatever the number of threads of BLAS and OpenMP.

determinism.py SHEET_STAMPING   hexahedra: their factors are dense enough for BLAS to share the work out
"""
import hashlib
import os
import subprocess
import sys
import tempfile
from pathlib import Path

program = sys.argv[1]
runs = {"quasi-coulomb": ["cholmod", "banded", "mumps", "eigen-ldlt", "conjugate-gradients"],
        "coulomb": ["umfpack", "banded", "mumps", "corrected-cholmod", "bicgstab"]}


def written(friction, solver, threads):
    """A digest of every file that a run with so many threads writes."""
    environment = dict(os.environ, OPENBLAS_NUM_THREADS=str(threads), OMP_NUM_THREADS=str(threads))
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "--friction", friction, "--solver", solver, "--travel", "1", "--quiet", "--output", folder],
                       env=environment, check=True, capture_output=True, timeout=600)
        files = sorted(path for path in Path(folder).rglob("*") if path.suffix in (".vtu", ".csv"))
        assert len(files) > 2, files
        return {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in files}


failures = 0
for friction, solvers in runs.items():
    for solver in solvers:
        first = written(friction, solver, 1)
        for threads in (1, 2, 4):
            if written(friction, solver, threads) != first:
                failures += 1
                print(f"{friction}, {solver}: another run with {threads} threads wrote other bytes")
print(f"{sum(map(len, runs.values()))} runs, four times each: {failures} differences")
sys.exit(failures > 0)
