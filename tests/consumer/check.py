# SPDX-License-Identifier: BSL-1.0
"""Checks around the installed package.

check.py lines FILE            the three policies of FILE take fewer than 60 lines together, comments included
check.py install CMAKE BUILD PREFIX  installs a build and moves what it installed to PREFIX
check.py paths TREE FOLDER...  no file of TREE names one of the FOLDERs, and no CMake file of it any absolute path
check.py says CODE TEXT COMMAND...  the command ends with CODE (ok or error) and TEXT is in what it says, in one piece
"""
import pathlib
import re
import shutil
import subprocess
import sys


def lines(file):
    text = pathlib.Path(file).read_text(encoding="utf-8")
    between = re.search(r"^// --- policies: begin\n(.*?)^// --- policies: end$", text, re.S | re.M)
    assert between, "the rulers are gone"
    policies = between[1]
    for contract in ("role::Friction", "role::Hardening", "role::LinearSolver"):
        assert contract in policies, f"no policy of {contract} between the rulers"
    count = policies.count("\n")
    assert count < 60, f"{count} lines"
    print(f"{count} lines")


def install(cmake, build, prefix):
    staging = prefix + ".staging"
    for folder in (staging, prefix):
        shutil.rmtree(folder, ignore_errors=True)
    subprocess.run([cmake, "--install", build, "--prefix", staging], check=True, stdout=subprocess.DEVNULL)
    pathlib.Path(staging).rename(prefix)


def paths(tree, *folders):
    files = [p for p in pathlib.Path(tree).rglob("*") if p.is_file()]
    assert any(p.name == "stickslipTargets.cmake" for p in files), f"no package under {tree}"
    for file in files:
        text = file.read_bytes().decode("utf-8", "replace")
        for folder in folders:
            # As a path of its own, not as the end of another: a checkout may well lie in /stickslip.
            assert not re.search(rf"(?<![\w.}})*-]){re.escape(folder)}(?![\w.-])", text), f"{file} names {folder}"
        if file.suffix == ".cmake":
            found = re.search(r"""(?:^|[\s"';=(])(/\w[^\s"';)]*)""", text)
            assert not found, f"{file} holds the absolute path {found[1]}"
    print(f"{len(files)} files")


def says(code, text, *command):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    said = " ".join(done.stdout.split())  # messages are wrapped
    assert (done.returncode == 0) == (code == "ok"), f"exit code {done.returncode}:\n{done.stdout}"
    assert text in said, f'"{text}" is not in:\n{done.stdout}'


{"lines": lines, "install": install, "paths": paths, "says": says}[sys.argv[1]](*sys.argv[2:])
