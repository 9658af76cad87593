# SPDX-License-Identifier: BSL-1.0
"""The benchmarks' common command line: exit codes, sentences, JSON contract."""

import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile

program, pressed_block = sys.argv[1:]
KEYS = """benchmark friction mu solver kinematics material element elements unknowns symmetric_storage completed steps iterations
rejected_steps factorizations indefinite_factorizations line_search_cuts evaluations tangents_unused evaluations_repeated
inner_iterations seconds_total seconds_assembly seconds_contact seconds_factorization seconds_solve seconds_estimates factor_mb peak_memory_mb max_penetration_mm max_slip_mm max_plastic_strain max_lag estimated_error_lag
estimated_error_time estimated_error_penetration estimated_error_space final_force_N warnings history""".split()
checks = 0


def run(*options):
    return subprocess.run([program, *options], capture_output=True, text=True, timeout=300)


def check(condition, what):
    global checks
    checks += 1
    assert condition, what


# Bad values: exit code 2, one sentence that names option, value and what is accepted; nothing on standard output.
for options, words in [
    (["--friction", "tresca"], ["--friction", '"tresca"', "coulomb, quasi-coulomb, frictionless"]),
    (["--solver", "magic"], ["--solver", '"magic"', "banded"]),
    (["--solver", "cholmod", "--friction", "coulomb"], ["--solver", '"cholmod"', "symmetric", "umfpack"]),
    (["--solver", "umfpack", "--friction", "quasi-coulomb"], ["--solver", '"umfpack"', "makes a symmetric one", "cholmod"]),
    (["--solver", "eigen-ldlt", "--friction", "coulomb"], ["--solver", '"eigen-ldlt"', "eigen-lu"]),
    (["--mu", "-0.1"], ["--mu", '"-0.1"', "0 to 10"]),
    (["--mu", "nan"], ["--mu", '"nan"']),
    (["--mu", "0.1x"], ["--mu", '"0.1x"']),
    (["--mu", ""], ["--mu"]),
    (["--mu", "0.1", "--friction", "frictionless"], ["--mu", '"0.1"', "frictionless"]),
    (["--refine", "0"], ["--refine", '"0"', "whole number"]),
    (["--refine", "1.5"], ["--refine", '"1.5"']),
    (["--steps", "soon"], ["--steps", '"soon"', "auto"]),
    (["--steps", "-3"], ["--steps", '"-3"']),
    (["--tolerance", "0"], ["--tolerance", '"0"', "1e-14"]),
    (["--lag-tolerance", "-1"], ["--lag-tolerance", '"-1"', "0 to 10"]),
    (["--step-tolerance", "inf"], ["--step-tolerance", '"inf"']),
    (["--mesh-error-every", "0.5"], ["--mesh-error-every", '"0.5"', "whole number"]),
    (["--advise", "1"], ["--advise", '"1"', "0.5"]),
    (["--checkpoint", ""], ["--checkpoint", "name of a file"]),
    (["--checkpoint", "x", "--checkpoint-every", "0"], ["--checkpoint-every", '"0"', "1 to 1000000"]),
    (["--checkpoint-every", "5"], ["--checkpoint-every", '"5"', "--checkpoint beside it"]),
    (["--restart", ""], ["--restart", "name of a file"]),
    (["--travel", "0"], ["--travel", '"0"', "1 to 500"]),
    (["--element", "shell"], ["--element", '"shell"', "mean-dilatation, assumed-strain"]),
    (["--element", "assumed-strain", "--friction", "frictionless"], ["--friction", '"frictionless"', "--element assumed-strain", "coulomb, quasi-coulomb"]),
    (["--unknown"], ["--unknown", "--help"]),
    (["--fric", "coulomb"], ["--fric"]),
    (["stray"], ["--help"]),
]:
    done = run(*options)
    check(done.returncode == 2, (options, done.returncode, done.stderr))
    check(done.stdout == "", (options, done.stdout))
    check(done.stderr.count("\n") == 1, (options, done.stderr))
    for word in words:
        check(word in done.stderr, (options, word, done.stderr))

done = run("--help")
check(done.returncode == 0 and all(f"--{o}" in done.stdout for o in "friction mu solver refine steps tolerance lag-tolerance step-tolerance mesh-error-every advise output json checkpoint checkpoint-every restart quiet list help element".split()), done.stdout)

# Every listed pair runs and keeps the contract; its answer does not depend on the solver.
listed = dict(line.split(":") for line in run("--list").stdout.splitlines())
cures = {"extrapolated-quasi-coulomb", "lag-iterated-coulomb", "symmetrised-coulomb"}
corrected = ["corrected-banded", "corrected-cholmod", "corrected-eigen-ldlt"]
lower = ["banded", "eigen-ldlt", "cholmod", "mumps", "conjugate-gradients"]
full = ["eigen-lu", "umfpack", "bicgstab"]
check(set(listed) == {"frictionless", "coulomb", "quasi-coulomb"} | cures, listed)
check(sorted(listed["coulomb"].split()) == sorted(["banded", "mumps"] + full + corrected), listed)
for law in cures | {"quasi-coulomb", "frictionless"}:
    check(sorted(listed[law].split()) == sorted(lower), listed)
for friction, solvers in listed.items():
    forces = []
    for solver in solvers.split():
        done = run("--friction", friction, "--solver", solver, "--json", "-", "--tolerance", "1e-9", "--steps", "100")
        # The sheet's cells are thin for this element, which the run says once.
        check(done.returncode == 0 and done.stderr.count("\n") == 1 and "osu_punch: warning: cell" in done.stderr and "bends" in done.stderr, (friction, solver, done.stderr))
        result = json.loads(done.stdout)
        check(list(result) == KEYS, list(result))
        check(result["element"] == "mean-dilatation" and [w["name"] for w in result["warnings"]] == ["thin_cells_bend"], result["warnings"])
        check(result["benchmark"] == "osu_punch" and result["friction"] == friction and result["solver"] == solver, result["solver"])
        check(result["mu"] == (0 if friction == "frictionless" else 0.15), result["mu"])
        # A symmetrised tangent may not converge, and the step is cut.
        steps = result["steps"]
        check(steps == 100 or (steps > 100 and friction == "symmetrised-coulomb"), (friction, solver, steps))
        check(result["completed"] is True and result["elements"] == 28 and result["unknowns"] == 81, "counts")
        check(result["symmetric_storage"] == (solver in corrected or (solver in lower and friction != "coulomb")), (friction, solver))
        lengths = {len(v) for v in result["history"].values()}
        check(lengths == {steps + 1} and list(result["history"]) == ["time_s", "displacement_mm", "force_N"], lengths)
        check(abs(result["history"]["displacement_mm"][-1] - 40) < 1e-12, "travel")
        check(result["history"]["force_N"][-1] == result["final_force_N"] > 6e4, result["final_force_N"])
        check((result["max_slip_mm"] == 0) == (friction == "frictionless"), result["max_slip_mm"])
        check((result["max_lag"] > 0) == ("quasi" in friction or "lag" in friction), result["max_lag"])
        check(0 < result["max_penetration_mm"] < 0.1, result["max_penetration_mm"])
        check((result["estimated_error_lag"] > 1e-4) == ("quasi" in friction), result["estimated_error_lag"])
        check(all(0 < result[f"estimated_error_{e}"] < 0.3 for e in ("time", "penetration", "space")), result)
        forces.append(result["final_force_N"])
    check(max(forces) - min(forces) < 1e-6 * max(forces), (friction, forces))

# The element that bends: no warning, and at 2 mm half the force of the other, which is twice too stiff there.
forces = {}
for element in ("mean-dilatation", "assumed-strain"):
    for friction in ("coulomb", "quasi-coulomb"):
        done = run("--element", element, "--friction", friction, "--travel", "2", "--steps", "20", "--json", "-")
        result = json.loads(done.stdout)
        check(done.returncode == 0 and result["element"] == element and (done.stderr == "") == (element == "assumed-strain"), done.stderr)
        forces[element, friction] = result["final_force_N"]
        check(abs(forces["assumed-strain", friction] / 376 - 1) < 0.06 if element == "assumed-strain" else forces[element, friction] > 700, forces)

# Advice in words: which pressure, factor and how many steps.
advised = run("--friction", "quasi-coulomb", "--advise", "0.001", "--quiet")
check(advised.returncode == 0 and all(w in advised.stdout for w in ("0.1 %", "the current pressure", "corrected factor", "steps", "the last converged pressure", "AssumedStrain")), advised.stdout)

# A run that cannot reach its end: exit code 1, the reason, and all that was computed is there.
with tempfile.TemporaryDirectory() as folder:
    folder = pathlib.Path(folder)
    done = subprocess.run([pressed_block, "--lost-after", "0.5", "--json", str(folder / "run.json"), "--output", str(folder / "files"), "--quiet"], capture_output=True, text=True)
    check(done.returncode == 1 and done.stdout == "", (done.returncode, done.stdout))
    reason = [line for line in done.stderr.splitlines() if not line[0].isdigit()]  # the others are its times
    check(len(reason) == 1 and "failed" in reason[0] and "not finite" in reason[0], done.stderr)
    result = json.loads((folder / "run.json").read_text())
    check(result["completed"] is False and len(result["history"]["time_s"]) == result["steps"] + 1, result["steps"])
    check(0.49 < result["history"]["time_s"][-1] <= 0.5, result["history"]["time_s"][-1])
    check(abs(result["final_force_N"] + 0) > 0 and all(f == f for f in result["history"]["force_N"]), "the converged forces, not the failed ones")
    lines = (folder / "files" / "history.csv").read_text().splitlines()
    check(len(lines) == result["steps"] + 2, "history of the part that ran")
    for name in ("pressed_block.pvd", "force.png", "mesh.svg"):
        check((folder / "files" / name).stat().st_size > 0, name)

    # Warnings stand in the JSON, and on standard error in a line each.
    check(result["warnings"] == [], result["warnings"])
    done = subprocess.run([pressed_block, "--radius", "0.05", "--lost-after", "0.02", "--json", "-", "--quiet"], capture_output=True, text=True)
    told = json.loads(done.stdout)["warnings"]
    check(len(told) == 1 and told[0]["name"] == "tool_smaller_than_mesh" and told[0]["step"] == 0 and told[0]["count"] == 1, told)
    check(all(word in told[0]["text"] for word in ('contact "top"', "0.05", "0.166667")), told)
    said = [line for line in done.stderr.splitlines() if "warning" in line]
    check(said == ["pressed_block: warning: " + told[0]["text"]], done.stderr)

    # Output that cannot be written is named with the reason, before anything is computed.
    (folder / "file").write_text("")

    def told(options, stdout=subprocess.PIPE, program=pressed_block, **more):
        """Exit code, what was said, and whether a step was taken before (the program tells its times)."""
        done = subprocess.run([program, "--quiet", *map(str, options)], stdout=stdout, stderr=subprocess.PIPE, text=True, timeout=100, **more)
        lines = done.stderr.splitlines()
        words = [line for line in lines if not line[0].isdigit()]
        return done.returncode, words, len(words) < len(lines)

    deeper = folder / "file" / "deeper"
    for options, path, reason in [
        (["--output", deeper], deeper, "Not a directory"),
        (["--json", deeper], deeper, "Not a directory"),
        (["--json", folder], folder, "Is a directory"),
        (["--json", folder / "no" / "a.json"], folder / "no" / "a.json", "No such file or directory"),
        (["--checkpoint", deeper], deeper, "Not a directory"),
        (["--checkpoint", folder], folder, "Is a directory"),
        (["--checkpoint", "/dev/null"], "/dev/null", "it is no regular file"),
    ]:
        before = sorted(p.name for p in folder.iterdir())
        check(told(options) == (1, [f"pressed_block: cannot write {path}: {reason}"], False), (options, told(options)))
        check(sorted(p.name for p in folder.iterdir()) == before, list(folder.iterdir()))

    # The standard output: a full disc, a pipe that nobody reads, and one that is closed.
    with open("/dev/full", "w") as full:
        check(told(["--json", "-"], stdout=full)[:2] == (4, ["pressed_block: cannot write to the standard output: No space left on device"]), "full")
        for option in "--help", "--list":
            done = subprocess.run([program, option], stdout=full, stderr=subprocess.PIPE, text=True)
            check(done.returncode == 4 and "No space left on device" in done.stderr, (option, done))
    read, write = os.pipe()
    os.close(read)
    check(told(["--json", "-"], stdout=write)[:2] == (4, ["pressed_block: cannot write to the standard output: Broken pipe"]), "pipe")
    os.close(write)
    check(told(["--json", "-"], preexec_fn=lambda: os.close(1)) == (1, ["pressed_block: cannot write to the standard output: Bad file descriptor"], False), "closed")
    # What is opened first does not take its place and get what is printed.
    files = folder / "closed"
    check(told(["--output", files], preexec_fn=lambda: os.close(1)) == (0, [], True), "closed")
    check(not any("N; penetration" in p.read_text(errors="replace") for p in files.iterdir()), "the summary went to a file")

    # Results go to a pipe and to a device as well, and a link is to a file.
    (folder / "link.json").symlink_to(folder / "linked.json")
    (folder / "linked.json").write_text("old")
    check(told(["--json", folder / "link.json"])[0] == 0 and (folder / "link.json").is_symlink(), "link")
    check(json.loads((folder / "linked.json").read_text())["completed"], "linked")
    done = subprocess.run([pressed_block, "--quiet", "--json", "/dev/stdout"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    check(done.returncode == 0 and json.loads(done.stdout)["completed"], done.returncode)
    check(told(["--json", "/dev/full"])[:2] == (4, ["pressed_block: cannot write /dev/full: No space left on device"]), "device")

    # A disc that is full, by the limit of the size of files: no torn file, the run goes on, and record and code say so.
    files = folder / "full"
    limited = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (33000, 33000))
    code, words, ran = told(["--output", files, "--json", folder / "full.json"], preexec_fn=limited)
    check(code == 4 and ran and words[0] == f"pressed_block: cannot write {files / 'pressed_block_0000.vtu'}: File too large", words)
    result = json.loads((folder / "full.json").read_text())
    missing = result["files_missing"]
    check(result["completed"] and len(missing) > 30 and all(line.startswith("cannot write ") or "gnuplot" in line for line in missing), missing)
    check(words[1:] == [f"pressed_block: {len(missing)} files could not be written"], words)
    check(not list(files.glob("*.vtu")) and not list(files.glob("*partial*")) and (files / "mesh.dat").exists(), list(files.iterdir()))
    check(told(["--output", files, "--json", folder / "full.json"])[0] == 0 and "files_missing" not in json.loads((folder / "full.json").read_text()), "room again")
print(f"{checks} passed, 0 failed")
