# SPDX-License-Identifier: BSL-1.0
"""Compiles and runs every complete program that the documents show, with warnings as errors."""

import pathlib
import re
import subprocess
import sys
import tempfile

compiler, eigen, root = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
FLAGS = ["-std=c++20", "-O1", "-DNDEBUG", "-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Werror", f"-I{root / 'include'}", "-isystem", eigen]

programs = []
for document in ("README.md", "docs/policies.md"):
    for block in re.findall(r"^```cpp\n(.*?)^```", (root / document).read_text(), re.S | re.M):
        if "int main" in block:
            programs.append((document, block))
assert len(programs) >= 2, "the documents have lost their programs"
assert programs[0][0] == "README.md" and programs[0][1].count("\n") <= 26, "the first program stays at about 25 lines"

with tempfile.TemporaryDirectory() as folder:
    for number, (document, text) in enumerate(programs):
        name = f"{document}, program {number + 1}"
        source, binary = pathlib.Path(folder) / f"{number}.cpp", pathlib.Path(folder) / str(number)
        source.write_text(text)
        built = subprocess.run([compiler, *FLAGS, str(source), "-o", str(binary)], capture_output=True, text=True)
        assert built.returncode == 0, f"{name} does not compile:\n{built.stderr[:3000]}"
        done = subprocess.run([str(binary)], capture_output=True, text=True, timeout=120)
        assert done.returncode == 0 and done.stderr == "", f"{name}: exit code {done.returncode}, {done.stderr}"
        assert done.stdout.strip(), f"{name} prints nothing"
        if number == 0:
            last = done.stdout.strip().splitlines()[-1]
            assert last.startswith("178 mm"), f"{name} stops at: {last}"
        print(f"{name}: {done.stdout.strip().splitlines()[-1]}")
print(f"{len(programs)} passed, 0 failed")
