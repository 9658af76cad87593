# SPDX-License-Identifier: BSL-1.0
"""Checks that the header, CMake's project, CITATION.cff and what README.md asks for are of one version."""

import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])


def found(file, pattern):
    match = re.search(pattern, (root / file).read_text(encoding="utf-8"))
    assert match, f"{file} names no version"
    return ".".join(match.groups())


HEADER = "include/stickslip/version.hpp"
version = found(HEADER, r"version_major = (\d+), version_minor = (\d+), version_patch = (\d+);")
others = {f"{HEADER}, text": found(HEADER, r'version = "([^"]*)"'),
          "CMakeLists.txt": found("CMakeLists.txt", r"project\(stickslip VERSION (\S+)"),
          "CITATION.cff": found("CITATION.cff", r"(?m)^version: (\S+)$")}
minor = version.rpartition(".")[0]
asked = found("README.md", r"find_package\(stickslip (\S+) CONFIG")
offences = [f"{place} has {other}, {HEADER} {version}" for place, other in others.items() if other != version]
offences += [f"README.md asks for {asked}, {HEADER} has {version}"] * (asked != minor)
print("\n".join(offences))
print(f"version {version}, {len(offences)} offences")
sys.exit(bool(offences))
