#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""What the units of the examples take to compile, each alone and with its build's own flags.

    bench/compile_time.py --build build/release [--repeat 3] [--only TEXT]

Prints the median, the smallest and the largest of the processor time, in seconds, and the bytes of code. The build
directory is one of Ninja's, built: precompiled headers count for nothing. --only takes the units whose name holds TEXT,
from whatever folder. The measured objects go to a folder of their own."""

import argparse
import json
import pathlib
import resource
import shlex
import statistics
import subprocess
import sys
import tempfile


def units(build, only):
    """Name and command of every unit that is to be measured."""
    listed = subprocess.run(["ninja", "-C", build, "-t", "compdb"], capture_output=True, text=True)
    if listed.returncode:
        sys.exit(f"compile_time: --build {build} is not a directory that Ninja builds in")
    for entry in json.loads(listed.stdout):
        name = entry["output"]
        if name.endswith(".cpp.o") and (only in name if only else name.startswith("examples/")):
            yield name.replace("CMakeFiles/", ""), entry


def seconds(entry, to):
    words = shlex.split(entry["command"])
    words[words.index("-o") + 1] = str(to)
    for flag in ("-MT", "-MF"):
        if flag in words:
            del words[words.index(flag):words.index(flag) + 2]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([w for w in words if w != "-MD"], cwd=entry["directory"], check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def code_bytes(of):
    table = subprocess.run(["size", of], capture_output=True, text=True, check=True).stdout
    return int(table.splitlines()[1].split()[0])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, required=True)
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--only", default="")
    options = parser.parse_args()
    if options.repeat < 1:
        parser.error("--repeat must be at least 1")
    chosen = sorted(units(options.build, options.only), key=lambda unit: unit[0])
    if not chosen:
        sys.exit(f"compile_time: no unit of {options.build} is called \"{options.only or 'examples/'}\"")
    print(f"{'unit':<62} {'median':>7} {'least':>7} {'most':>7} {'code':>9}")
    taken = {name: [] for name, _ in chosen}
    sizes = {}
    with tempfile.TemporaryDirectory() as folder:
        to = pathlib.Path(folder) / "unit.o"
        for _ in range(options.repeat):  # interleaved, so that a busy spell of the machine falls on all of them
            for name, entry in chosen:
                taken[name].append(seconds(entry, to))
                sizes[name] = code_bytes(to)
    for name, times in taken.items():
        print(f"{name:<62} {statistics.median(times):7.1f} {min(times):7.1f} {max(times):7.1f} {sizes[name]:9}")


if __name__ == "__main__":
    main()
