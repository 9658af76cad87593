# SPDX-License-Identifier: BSL-1.0
"""Checks that stickslip.hpp brings every header but those that its comment leaves out, with the helpers of these alone,
and that the comment leaves out every header that needs another library."""

import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
include = root / "include/stickslip"
texts = {p.relative_to(include).as_posix(): p.read_text(encoding="utf-8") for p in include.rglob("*.hpp")}
edges = {path: set(re.findall(r"#include <stickslip/([^>]+)>", text)) for path, text in texts.items()}


def reached(start):
    seen, open_ = set(), list(start)
    while open_:
        path = open_.pop()
        if path not in seen:
            seen.add(path)
            open_ += edges[path]
    return seen


umbrella = "stickslip.hpp"
comment = " ".join(re.findall(r"^/// (.*)$", texts[umbrella].split("#include")[0], re.M))
named = set(re.findall(r"(?<![\w/])(?:\w+/)?\w+\.hpp", comment))
folders = set(re.findall(r"(?<![\w/.])(\w+/)(?![\w])", comment))
parts = re.search(r"stickslip_parts \"\"\)(.*?)\n# stickslip_add_part", (root / "cmake/stickslipParts.cmake").read_text(), re.S)[1]
optional = {header for line in re.findall(r"HEADERS ([^A-Z]*)", parts) for header in line.split()}
out = named | {path for path in texts if any(path.startswith(folder) for folder in folders)}
brought = reached([umbrella])
assert folders and optional and len(brought) > 80, "the comment or the parts have lost their form"

offences = [f"the comment names {path}, which does not exist" for path in sorted(named - set(texts))]
offences += [f"brings {path}, which its comment leaves out" for path in sorted(brought & out)]
offences += [f"does not bring {path}, and its comment does not leave it out"
             for path in sorted(set(texts) - brought - reached(out & set(texts)))]
offences += [f"{path} needs another library, and the comment does not leave it out" for path in sorted(optional - out)]
print("\n".join(f"{umbrella}: {sentence}" for sentence in offences))
print(f"{len(brought)} of {len(texts)} headers brought, {len(offences)} offences")
sys.exit(bool(offences))
