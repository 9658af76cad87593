# SPDX-License-Identifier: BSL-1.0
"""Reads what a benchmark wrote with VTK's own reader and holds it against the run's JSON and history."""

import json
import math
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

program = sys.argv[1]
EXPECTED_POINT = {"displacement": 3, "contact_force": 3, "contact_traction": 3, "slip": 1, "gap": 1}
EXPECTED_CELL = {"cauchy_stress": 6, "von_mises_stress": 1, "pressure": 1, "plastic_strain": 1, "stress_error": 1}


def read(path):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    assert reader.GetErrorCode() == 0, f"VTK refuses {path}"
    return reader.GetOutput()


with tempfile.TemporaryDirectory() as folder:
    folder = pathlib.Path(folder)
    done = subprocess.run([program, "--friction", "coulomb", "--mu", "0.15", "--output", str(folder), "--json", str(folder / "run.json"), "--quiet"],
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert done.stdout == "" and all(" warning: " in line for line in done.stderr.splitlines()), "--quiet must be quiet but for warnings"
    run = json.loads((folder / "run.json").read_text())

    sets = xml.parse(folder / "osu_punch.pvd").getroot().findall("./Collection/DataSet")
    assert 35 <= len(sets) <= 45, len(sets)
    times = [float(s.get("timestep")) for s in sets]
    assert times[0] == 0 and times == sorted(times) and abs(times[-1] - 1) < 1e-12
    assert all(abs(min(run["history"]["time_s"], key=lambda t: abs(t - time)) - time) < 1e-12 for time in times)

    for entry in sets:
        grid = read(folder / entry.get("file"))
        assert grid.GetNumberOfCells() == run["elements"] and grid.GetNumberOfPoints() == 45
        assert {grid.GetCellType(i) for i in range(grid.GetNumberOfCells())} == {9}
        for data, expected in ((grid.GetPointData(), EXPECTED_POINT), (grid.GetCellData(), EXPECTED_CELL)):
            found = {data.GetArrayName(i): data.GetArray(i).GetNumberOfComponents() for i in range(data.GetNumberOfArrays())}
            assert found == expected, found

    first, last = read(folder / sets[0].get("file")), read(folder / sets[-1].get("file"))
    displacement = first.GetPointData().GetArray("displacement")
    assert all(displacement.GetTuple3(i) == (0, 0, 0) for i in range(45)), "the first state is the undeformed one"

    points, data = last.GetPointData(), last.GetCellData()
    pole = [i for i in range(45) if last.GetPoint(i)[0] == 0 and last.GetPoint(i)[1] == 1]
    assert len(pole) == 1
    assert abs(points.GetArray("displacement").GetTuple3(pole[0])[1] + 40) < 0.1, "the pole goes with the punch"
    top = [i for i in range(45) if last.GetPoint(i)[1] == 1]
    axial = sum(points.GetArray("contact_force").GetTuple3(i)[1] for i in top)
    assert abs(axial - run["final_force_N"]) < 1e-9 * run["final_force_N"], "nodal contact forces sum to the punch force"
    gaps = [points.GetArray("gap").GetValue(i) for i in range(45)]
    assert sum(math.isnan(g) for g in gaps) == 15, "the middle layer of nodes has no tool"
    # The VTU holds the last state, the JSON the largest penetration of the run.
    penetration = max(-g for g in gaps if not math.isnan(g))
    assert 0 < penetration <= run["max_penetration_mm"] * (1 + 1e-12)
    assert abs(max(points.GetArray("slip").GetValue(i) for i in range(45)) - run["max_slip_mm"]) < 1e-9
    strains = [data.GetArray("plastic_strain").GetValue(i) for i in range(28)]
    assert 0 < max(strains) <= run["max_plastic_strain"]
    mises = [data.GetArray("von_mises_stress").GetValue(i) for i in range(28)]
    flow = [589 * (1e-4 + p) ** 0.216 for p in strains]
    assert all(m < 1.02 * f for m, f in zip(mises, flow)), "Cauchy stress stays on or inside the yield surface (J is nearly 1)"
    assert max(m / f for m, f in zip(mises, flow)) > 0.9, "and reaches it"

    for picture, magic in (("force.png", b"\x89PNG"), ("mesh.png", b"\x89PNG"), ("force.svg", b"<?xml"), ("mesh.svg", b"<?xml")):
        content = (folder / picture).read_bytes()
        assert content.startswith(magic) and len(content) > 5000, picture
print("1 passed, 0 failed")
