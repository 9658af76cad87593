#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Checks the floors of the library: a header includes only headers of floors below its own, or of its own folder.

floors.py FOLDER      checks include/stickslip
floors.py --self-test checks that made-up offences are found
"""
import pathlib
import re
import sys

MODELS = {"kinematics", "element", "material", "friction", "enforcement", "time_integration", "damping", "linear_solver"}
FLOORS = [
    {"base", "version.hpp"},
    {"tensor"},
    {"policy", "mesh"},
    MODELS | {"geometry"},
    {"dofs"},
    {"body", "contact"},
    {"solve"},
    {"scene.hpp"},
    {"problem.hpp"},
    {"verify", "io", "advise.hpp", "run_time.hpp"},
    {"stickslip.hpp"},
]
FLOOR = {part: floor for floor, parts in enumerate(FLOORS) for part in parts}
# These see contracts, never models: the policies are interchangeable because nobody here knows one by name.
BLIND_TO_MODELS = {"dofs", "body", "contact", "solve", "scene.hpp", "problem.hpp", "advise.hpp", "run_time.hpp"}
# Whole-Eigen headers cost seconds; streams belong to io.
BANNED = {"Eigen/Dense", "Eigen/Eigen", "Eigen/Sparse", "iostream"}
IO_ONLY = {"ostream", "istream"}
# Streams of one's own are in the global locale: io reads through text.hpp and writes through new_file.hpp, which are not.
STREAMS_IN = {"fstream": {"io/text.hpp"}, "sstream": set()}
LICENCE = "// SPDX-License-Identifier: BSL-1.0"


def part(path):
    """Folder of a header, or its own name at the top."""
    return path.split("/")[0]


def offences(headers):
    """headers: path below include/stickslip -> text. Yields one sentence an offence."""
    for path, text in sorted(headers.items()):
        here = part(path)
        if here not in FLOOR:
            yield f"{path}: '{here}' has no floor"
            continue
        if not text.startswith(LICENCE + "\n"):
            yield f"{path}: does not begin with the SPDX line"
        if not re.search(r"^#pragma once$", text, re.M):
            yield f"{path}: no #pragma once"
        for include in re.findall(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', text, re.M):
            if include in BANNED or (include in IO_ONLY and here != "io") or path not in STREAMS_IN.get(include, {path}):
                yield f"{path}: includes <{include}>"
            if not include.startswith("stickslip/"):
                continue
            target = include.removeprefix("stickslip/")
            there = part(target)
            if target not in headers:
                yield f"{path}: includes <{include}>, which does not exist"
            elif there not in FLOOR or there == here:
                continue  # of no floor: said above; of the same folder: allowed
            elif FLOOR[there] > FLOOR[here]:
                yield f"{path}: includes <{include}>, an upward edge"
            elif FLOOR[there] == FLOOR[here]:
                yield f"{path}: includes <{include}>, a sideways edge"
            elif here in BLIND_TO_MODELS and there in MODELS:
                yield f"{path}: includes <{include}>, a model where only contracts are seen"


def self_test():
    head = LICENCE + "\n#pragma once\n"
    sound = {
        "base/types.hpp": head + "#include <Eigen/Core>\n",
        "policy/material.hpp": head + "#include <stickslip/base/types.hpp>\n",
        "material/log.hpp": head,
        "material/hencky.hpp": head + "#include <stickslip/material/log.hpp>\n#include <stickslip/policy/material.hpp>\n",
        "friction/coulomb.hpp": head,
        "mesh/mesh.hpp": head,
        "body/body.hpp": head + "#include <stickslip/mesh/mesh.hpp>\n",
        "io/text.hpp": head + "#include <fstream>\n",
        "io/vtk.hpp": head + "#include <ostream>\n#include <stickslip/body/body.hpp>\n",
        "problem.hpp": head + "#include <stickslip/body/body.hpp>\n",
        "stickslip.hpp": head + "#include <stickslip/problem.hpp>\n#include <stickslip/material/hencky.hpp>\n",
    }
    assert not list(offences(sound)), list(offences(sound))

    def caught(path, text, reason):
        found = list(offences(sound | {path: text}))
        assert len(found) == 1 and found[0].startswith(path) and reason in found[0], (path, reason, found)

    caught("base/bad.hpp", head + "#include <stickslip/policy/material.hpp>\n", "upward")
    caught("policy/bad.hpp", head + "#include <stickslip/material/hencky.hpp>\n", "upward")
    caught("policy/worse.hpp", head + '  #  include "stickslip/mesh/mesh.hpp"\n', "sideways")
    caught("material/bad.hpp", head + "#include <stickslip/friction/coulomb.hpp>\n", "sideways")
    caught("verify/bad.hpp", head + "#include <stickslip/io/vtk.hpp>\n", "sideways")
    caught("contact/bad.hpp", head + "#include <stickslip/material/hencky.hpp>\n", "a model where")
    caught("solve/bad.hpp", head + "#include <stickslip/friction/coulomb.hpp>\n", "a model where")
    caught("solve/worse.hpp", head + "#include <stickslip/stickslip.hpp>\n", "upward")
    caught("run_time.hpp", head + "#include <stickslip/friction/coulomb.hpp>\n", "a model where")
    caught("attic/bad.hpp", head, "no floor")
    caught("mesh/bad.hpp", head + "#include <stickslip/mesh/gone.hpp>\n", "does not exist")
    caught("material/dense.hpp", head + "#include <Eigen/Dense>\n", "Eigen/Dense")
    caught("linear_solver/sparse.hpp", head + "#include <Eigen/Sparse>\n", "Eigen/Sparse")
    caught("io/streams.hpp", head + "#include <iostream>\n", "iostream")
    caught("solve/file.hpp", head + "#include <fstream>\n", "fstream")
    caught("io/file.hpp", head + "#include <fstream>\n", "fstream")
    caught("io/words.hpp", head + "#include <sstream>\n", "sstream")
    caught("mesh/twice.hpp", LICENCE + "\n", "#pragma once")
    caught("mesh/whose.hpp", "#pragma once\n", "SPDX")
    print("self-test: 19 offences found")


def main():
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    root = pathlib.Path(sys.argv[1])
    headers = {p.relative_to(root).as_posix(): p.read_text(encoding="utf-8") for p in root.rglob("*.hpp")}
    if not headers:
        sys.exit(f"no headers under {root}")
    found = list(offences(headers))
    for sentence in found:
        print(sentence)
    print(f"{len(headers)} headers, {len(found)} offences")
    sys.exit(1 if found else 0)


main()
