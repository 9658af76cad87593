# SPDX-License-Identifier: BSL-1.0
"""What the paper says of its benchmarks, as far as it is a fact and not a figure of its own code."""

import json
import subprocess
import sys

osu, extrusion, tube = sys.argv[1:]
checks = 0


def run(program, *options):
    done = subprocess.run([program, *options, "--quiet", "--json", "-"], capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def check(condition, what):
    global checks
    checks += 1
    assert condition, what


def energy_balance_closes(result, part):
    """The energy ledger: what cannot be accounted for, as a part of the work done; nothing is negative that cannot be."""
    check(abs(result["unbalanced_work_J"]) < part * result["external_work_J"], result["unbalanced_work_J"])
    for key in ("kinetic_energy_J", "plastic_work_J", "friction_work_J", "elastic_energy_J", "penalty_energy_J"):
        check(result[key] >= 0, (key, result[key]))


# The punch: both laws' forces differ by less than 1 % of the peak.
forces = {}
for law in ("coulomb", "quasi-coulomb"):
    r = run(osu, "--friction", law, "--mu", "0.3")
    check(r["completed"] and r["steps"] <= 120 and r["iterations"] <= 330, (r["steps"], r["iterations"]))
    forces[law] = r["final_force_N"]
check(abs(forces["coulomb"] - forces["quasi-coulomb"]) < 0.01 * forces["coulomb"], forces)

# The extrusion: slip over 250 mm, penetration below 1/500 of the radius, the lagged force falls behind.
for law in ("coulomb", "quasi-coulomb"):
    r = run(extrusion, "--friction", law)
    steps, iterations = (130, 330) if law == "coulomb" else (160, 420)
    check(r["steps"] <= steps and r["iterations"] <= iterations, (law, r["steps"], r["iterations"]))
    check(r["completed"] and r["max_slip_mm"] > 250 and r["max_penetration_mm"] < 50.8 / 500, (law, r["max_slip_mm"], r["max_penetration_mm"]))
    check(r["kinetic_energy_J"] == 0 and r["friction_work_J"] > 0.05 * r["external_work_J"], r["friction_work_J"])
    energy_balance_closes(r, 1e-3)
    forces[law] = r["final_force_N"]
check(0.85 < forces["quasi-coulomb"] / forces["coulomb"] < 0.97, forces)
container = run(extrusion, "--die", "container")
check(container["completed"] and container["max_slip_mm"] > 270, container["max_slip_mm"])
wider = run(extrusion, "--half-angle", "3")
check(wider["final_force_N"] < forces["coulomb"], "a slimmer cone takes less force")

# The tube: turned inside out without friction, and the energy balance closes under every law.
for law, mu in (("frictionless", "0"), ("quasi-coulomb", "0.15"), ("coulomb", "0.15"), ("quasi-coulomb", "0.3"), ("coulomb", "0.3")):
    r = run(tube, "--friction", law, "--mu", mu, "--self-contact", "off")
    check(r["completed"] and abs(r["history"]["displacement_mm"][-1] - 50) < 1e-9, (law, r["steps"]))
    check(r["steps"] <= 250 and r["iterations"] <= 900, (law, mu, r["steps"], r["iterations"]))
    check(r["symmetric_storage"] == (law != "coulomb"), r["symmetric_storage"])
    check(r["kinetic_energy_J"] > 0 and r["plastic_work_J"] > 0.3 * r["external_work_J"], r["plastic_work_J"])
    energy_balance_closes(r, 1e-2)
    check((r["self_penetration_from_mm"] is None) == (law == "frictionless"), r["self_penetration_from_mm"])
    check((r["deepest_in_itself_mm"] > 0.2) == (law != "frictionless"), (law, mu, r["deepest_in_itself_mm"]))
# In contact with itself it folds, to the end of the travel.
for law, mu in (("coulomb", "0.15"), ("coulomb", "0.30"), ("quasi-coulomb", "0.30")):
    r = run(tube, "--friction", law, "--mu", mu)
    check(r["completed"], f"the tube folds on itself to the end, {law}, {mu}")
    check(r["deepest_in_itself_mm"] < 0.1, f"no node deeper in itself than a fifth of an element: {r['deepest_in_itself_mm']}, {law}, {mu}")
    check(abs(r["unbalanced_work_J"]) < 1e-3 * r["external_work_J"], f"its energy balance closes, {law}, {mu}")

abrupt = run(tube, "--friction", "frictionless", "--start-velocity", "off")
check(max(abrupt["history"]["force_N"][:40]) > 1000, "an abrupt start sends a shock through the tube")
print(f"{checks} passed, 0 failed")
