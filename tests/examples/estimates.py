# SPDX-License-Identifier: BSL-1.0
"""The estimated errors in the JSON of the punch and of the tube against the errors themselves."""

import bisect
import json
import subprocess
import sys

punch, tube = sys.argv[1:]


def run(program, law, *options):
    done = subprocess.run([program, "--friction", law, "--solver", "banded", "--quiet", "--json", "-", *options],
                          capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def force_at(r, travel):
    x, y = r["history"]["displacement_mm"], r["history"]["force_N"]
    i = min(max(bisect.bisect_right(x, travel) - 1, 0), len(x) - 2)
    return y[i] + (y[i + 1] - y[i]) * (travel - x[i]) / (x[i + 1] - x[i])


def difference(a, b, until):
    """Mean difference of the forces at the ends of a's steps over the mean force."""
    off = whole = 0
    x = a["history"]["displacement_mm"]
    for i in range(1, len(x)):
        if x[i] > until:
            break
        exact = force_at(b, x[i])
        off += (x[i] - x[i - 1]) * abs(a["history"]["force_N"][i] - exact)
        whole += (x[i] - x[i - 1]) * abs(exact)
    return off / whole


# Until the tube folds onto itself, at 42 mm.
for program, options, until, reference_steps, counts in [
    (punch, ["--mu", "0.3"], 40, 2000, ["auto", "60", "125", "250"]),
    (tube, ["--mu", "0.15", "--self-contact", "off"], 42, 4000, ["auto", "320"]),
]:
    reference = run(program, "coulomb", *options, "--steps", str(reference_steps), "--tolerance", "1e-6")
    for steps in counts:
        exact = run(program, "coulomb", *options, "--steps", steps)
        lagged = run(program, "quasi-coulomb", *options, "--steps", steps)
        for what, estimate, error in [
            ("time", exact["estimated_error_time"], difference(exact, reference, until)),
            ("lag", lagged["estimated_error_lag"], difference(lagged, exact, until)),
        ]:
            print(f"{exact['benchmark']}, {steps} steps, {what}: estimate {estimate:.5f}, error {error:.5f}, ratio {estimate / error:.2f}")
            assert 0.3 * error < estimate < 3 * error, (exact["benchmark"], steps, what, estimate, error)
        assert exact["estimated_error_lag"] == 0
        assert 0 < exact["estimated_error_space"] < 1
