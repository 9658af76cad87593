# SPDX-License-Identifier: BSL-1.0
"""Holds what is cited of docs/theory.md against what stands there: equations are numbered in the
order in which they stand, and every equation and section that code or a document names exists."""

import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
theory = (root / "docs/theory.md").read_text()
NUMBER = r"\d+\.\d+"
LIST = rf"{NUMBER}(?:(?:\s*(?:-|to|and|,|or)\s*)(?:eq\.\s*)?{NUMBER})*"

tags = re.findall(rf"\\tag\{{({NUMBER})\}}", theory)
sections = set(re.findall(r"^#+ (\d+(?:\.\d+)*)\.?\s", theory, re.M))
assert len(tags) > 100 and len(sections) > 20, "theory.md has lost its numbers"
offences = [f"theory.md: equation {tag} stands twice" for tag in sorted(set(tags)) if tags.count(tag) > 1]
chapters = [tag.split(".")[0] for tag in tags]
offences += [f"theory.md: equation {tag} stands where {chapter}.{chapters[:k + 1].count(chapter)} is expected"
             for k, (tag, chapter) in enumerate(zip(tags, chapters)) if tag != f"{chapter}.{chapters[:k + 1].count(chapter)}"]

files = [*sorted((root / "include").rglob("*.hpp")), *sorted((root / "docs").glob("*.md")), root / "README.md",
         *(path for folder in ("tests", "examples", "bench") for path in sorted((root / folder).rglob("*.[ch]pp")))]
cited = 0
for path in files:
    text = re.sub(r"\n\s*(?:///?|//!<?)?\s*", " ", path.read_text())
    for found in re.findall(rf"\beqs?\.\s+({LIST})", text):
        for number in re.findall(NUMBER, found):
            cited += 1
            if number not in tags:
                offences.append(f"{path.relative_to(root)}: equation {number} is not in theory.md")
    for number in re.findall(r"theory\.md\)?,? (?:section )?(\d+\.\d+)\b(?!-)", text):
        cited += 1
        if number not in sections:
            offences.append(f"{path.relative_to(root)}: section {number} is not in theory.md")
print("\n".join(offences))
print(f"{len(tags)} equations, {cited} citations, {len(offences)} offences")
sys.exit(bool(offences))
