#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Checks the names of the doctest cases: each stands once in all of tests/, is a claim of three words or more, and holds
no character that CTest or doctest's filter reads as its own.

test_names.py FOLDER      checks tests/
test_names.py --self-test checks that made-up offences are found
"""
import pathlib
import re
import sys

STRING = r'"(?:[^"\\]|\\.)*"'
CASE = re.compile(rf"^\s*TEST_CASE\w*\(\s*((?:{STRING}\s*)*)", re.M)
RESERVED = set(';[]*?"\\$')  # of CMake's lists, doctest's wildcards, and quoting


def offences(sources):
    """sources: path below tests/ -> text. Yields one sentence an offence."""
    seen = {}
    for path, text in sorted(sources.items()):
        for found in CASE.finditer(text):
            name = "".join(literal[1:-1] for literal in re.findall(STRING, found[1]))
            if len(name.split()) < 3:
                yield f'{path}: "{name}" is no claim'
            reserved = sorted(RESERVED & set(name))
            if reserved:
                yield f'{path}: "{name}" holds {" ".join(reserved)}'
            if name.lower() in seen:  # doctest's filter does not look at the case
                yield f'{path}: "{name}" stands in {seen[name.lower()]} already'
            seen.setdefault(name.lower(), path)


def self_test():
    sound = {"unit/a.cpp": 'TEST_CASE("one is one") {\n}\nTEST_CASE_TEMPLATE(\n    "two, in "\n    "parts, is two", T, int) {\n}\n',
             "unit/b.cpp": 'TEST_CASE("two is (almost) one") {\n  CHECK(TEST_CASES);\n}\n'}
    assert not list(offences(sound)), list(offences(sound))
    for name, reason in {"One is one": "already", "two, in parts, is two": "already", "dialects": "no claim",
                         "one is one; two is two": "holds ;", "a[0] is the first": "holds [ ]", "any * is one": "holds *"}.items():
        found = list(offences(sound | {"unit/c.cpp": f'TEST_CASE("{name}") {{\n}}\n'}))
        assert len(found) == 1 and found[0].startswith("unit/c.cpp") and reason in found[0], (name, found)
    found = list(offences({"unit/d.cpp": "TEST_CASE(name) {\n}\n"}))
    assert len(found) == 1, found
    print("self-test: 7 offences found")


def main():
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    root = pathlib.Path(sys.argv[1])
    sources = {p.relative_to(root).as_posix(): p.read_text(encoding="utf-8") for p in root.rglob("*.[ch]pp")}
    names = sum(len(CASE.findall(text)) for text in sources.values())
    if not names:
        sys.exit(f"no test cases under {root}")
    found = list(offences(sources))
    for sentence in found:
        print(sentence)
    print(f"{names} test cases, {len(found)} offences")
    sys.exit(1 if found else 0)


main()
