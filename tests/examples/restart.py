# SPDX-License-Identifier: BSL-1.0
"""Restart files: killed at random moments a run loses no more than the steps since the last file, and its results are
those of the run that was let alone."""

import json
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time

pressed_block, punch = sys.argv[1:]
KILLS, EVERY = 20, 7
random.seed(4)


def result(path):
    """What must be the same: all but times and memory."""
    read = json.loads(path.read_text())
    return {k: v for k, v in read.items() if not k.startswith("seconds_") and k != "peak_memory_mb"}


def refused(program, *options):
    done = subprocess.run([program, *options, "--quiet"], capture_output=True, text=True, timeout=60)
    assert done.returncode == 1 and done.stdout == "", done
    lines = [line for line in done.stderr.splitlines() if not line[0].isdigit()]
    assert len(lines) == 1, done.stderr
    return lines[0]


def killed_at_random(folder):
    """Returns how many kills met a run that was under way, and how many steps each of them cost."""
    kept, out, alone = folder / "run.restart", folder / "out.json", folder / "alone.json"
    program = [pressed_block, "--refine", "2", "--quiet"]
    begin = time.monotonic()
    subprocess.run([*program, "--json", alone], check=True, stderr=subprocess.DEVNULL, timeout=100)
    took = time.monotonic() - begin
    wanted = result(alone)
    steps = {t: n for n, t in enumerate(wanted["history"]["time_s"])}
    assert len(steps) > 250 and wanted["completed"], len(steps)
    lost, reached, kills, finished = [], 0, 0, 0
    while True:
        known = kept.exists()
        restart = ["--restart", kept] if known else []
        run = subprocess.Popen([*program, "--json", out, "--checkpoint", kept, "--checkpoint-every", str(EVERY), *restart],
                               stderr=subprocess.PIPE, text=True)
        # The last run is let alone.
        patience = random.uniform(0.005, 0.25 * took) if kills < KILLS else 100
        try:
            run.wait(patience)
        except subprocess.TimeoutExpired:
            run.kill()
            kills += 1
        said = [float(line) for line in run.stderr.read().splitlines()]
        assert run.wait() in (0, -signal.SIGKILL), (run.returncode, said)
        seen = [steps[t] for t in said]  # every time is one of the run that was let alone
        if known and seen:
            begun = seen[0] - 1
            assert begun % EVERY == 0 or begun == len(steps) - 1, begun
            lost.append(reached - begun)
            assert 0 <= lost[-1] <= EVERY, (reached, begun)
        assert seen == list(range(seen[0], seen[-1] + 1)) if seen else True, seen
        reached = seen[-1] if seen else (reached if known else 0)
        if run.returncode == 0:
            finished += 1
            assert result(out) == wanted, "the results differ"
            out.unlink()
            kept.unlink()
            reached = 0
            if kills >= KILLS:
                break
    leftovers = {p.name for p in folder.iterdir()} - {"alone.json"}
    assert not leftovers, leftovers
    return kills, lost, finished


def stopped_by_a_signal(folder):
    """The punch with all its output, stopped by each signal on the way."""
    kept = folder / "punch.restart"
    scene = ["--refine", "4", "--travel", "20"]
    common = [punch, "--friction", "extrapolated-quasi-coulomb", *scene]
    files = {}
    for name, stops in ("alone", []), ("stopped", [signal.SIGTERM, signal.SIGINT, signal.SIGHUP]):
        out = folder / name
        with_output = [*common, "--output", out, "--json", folder / f"{name}.json"]
        restart = []
        for stop in stops:
            run = subprocess.Popen([*with_output, "--checkpoint", kept, *restart], stderr=subprocess.PIPE, text=True)
            marks = len(list(out.glob("*.vtu"))) + 3
            while run.poll() is None and len(list(out.glob("*.vtu"))) < marks:
                time.sleep(0.002)
            run.send_signal(stop)
            said = run.communicate(timeout=60)[1]
            assert run.returncode == 3, (run.returncode, said)
            assert said.count("\n") == 1 and said.startswith(f"osu_punch: stopped by signal {stop.value} after step "), said
            assert f"--restart {kept} continues from there" in said and not (folder / f"{name}.json").exists(), said
            restart = ["--restart", kept]
        subprocess.run([*with_output, *restart], check=True, stdout=subprocess.DEVNULL, timeout=100)
        files[name] = {p.name: p.read_bytes() for p in out.iterdir() if p.suffix in (".csv", ".pvd", ".vtu", ".dat")}
    assert result(folder / "alone.json") == result(folder / "stopped.json")
    assert len(files["alone"]) > 15 and files["alone"] == files["stopped"], [n for n in files["alone"] if files["alone"][n] != files["stopped"].get(n)]

    # What does not fit is refused in a sentence, before anything is written.
    def says(*words, options=("--friction", "extrapolated-quasi-coulomb"), file=kept):
        said = refused(punch, *scene, *options, "--json", folder / "not.json", "--restart", file)
        assert said.startswith(f"osu_punch: {file} ") and all(w in said for w in words), said
        assert not (folder / "not.json").exists()

    says("does not fit: its mu is \"0.15\", here it is \"0.2\"", options=["--friction", "extrapolated-quasi-coulomb", "--mu", "0.2"])
    says("its friction law is", options=["--friction", "coulomb"])
    says("its output is")
    cut = folder / "cut"
    cut.write_bytes(kept.read_bytes()[:5000])
    says("is cut off: it has 5000 bytes of", file=cut)
    says("is not a restart file of stickslip", file=folder / "alone.json")
    said = refused(*common, "--restart", folder / "none")
    assert said == f"osu_punch: cannot read {folder / 'none'}: No such file or directory", said
    said = refused(*common, "--checkpoint", folder / "no" / "file", "--checkpoint-every", "1")
    assert said == f"osu_punch: cannot write {folder / 'no' / 'file'}: No such file or directory", said


def signals_that_are_ignored(folder):
    """nohup ignores the end of the terminal, and so does what it starts."""
    run = subprocess.Popen([pressed_block, "--quiet", "--checkpoint", folder / "hup.restart", "--json", folder / "hup.json"], stderr=subprocess.PIPE, text=True,
                           preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
    run.stderr.readline()
    run.send_signal(signal.SIGHUP)
    run.communicate(timeout=60)
    assert run.returncode == 0 and result(folder / "hup.json")["completed"], run.returncode


def one_run_at_a_time(folder):
    """The second run on a folder or a restart file ends at once, a dead run's is taken over, and what lies about under
    the names of unfinished files is not followed."""
    kept, out, victim = folder / "one.restart", folder / "one", folder / "victim"
    victim.write_text("untouched")
    (folder / "one.restart.partial").symlink_to(victim)
    first = subprocess.Popen([pressed_block, "--refine", "4", "--quiet", "--output", out, "--checkpoint", kept, "--checkpoint-every", "1"],
                             stderr=subprocess.PIPE, text=True)
    for _ in range(3):
        first.stderr.readline()
    said = refused(pressed_block, "--output", out)
    assert said == f"pressed_block: {out} is in use by another run, process {first.pid} ({out / 'stickslip.lock'})", said
    said = refused(pressed_block, "--checkpoint", kept)
    assert said == f"pressed_block: {kept} is in use by another run, process {first.pid} ({kept}.lock)", said
    assert first.poll() is None
    first.kill()
    first.communicate()
    assert pathlib.Path(f"{kept}.lock").exists()
    (folder / "one.restart.partial-0123456789abcdef").write_text("left by a run that was killed")
    done = subprocess.run([pressed_block, "--quiet", "--output", out, "--checkpoint", kept], stderr=subprocess.PIPE, text=True, timeout=100)
    assert done.returncode == 0, done.stderr
    names = {p.name for p in folder.iterdir() if p.name.startswith("one")}
    assert names == {"one", "one.restart", "one.restart.partial"} and not list(out.glob("*lock")) + list(out.glob("*partial*")), names
    assert victim.read_text() == "untouched" and kept.stat().st_size > 1000


with tempfile.TemporaryDirectory() as name:
    killed = pathlib.Path(name) / "killed"
    killed.mkdir()
    begin = time.monotonic()
    kills, lost, finished = killed_at_random(killed)
    print(f"{kills} kills, {len(lost)} restarts that went on, {finished} runs that ended; steps lost: mean {sum(lost) / len(lost):.1f}, "
          f"most {max(lost)}, with a file every {EVERY}; {time.monotonic() - begin:.1f} s")
    stopped_by_a_signal(pathlib.Path(name))
    signals_that_are_ignored(pathlib.Path(name))
    one_run_at_a_time(pathlib.Path(name))
    print(f"signals and refusals: {time.monotonic() - begin:.1f} s in all")
