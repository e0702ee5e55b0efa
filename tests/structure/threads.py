#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that every thread begins with a call of caught() (framework/text/caught.hpp): an exception that leaves a thread ends the program.

Usage: threads.py [SOURCE_FOLDER]. Prints FILE:LINE for each problem. Exit status 1 if there are any."""

import pathlib
import re
import sys

BEGINS = re.compile(r"\bstd::j?thread \(|\blistening \(\[|\bthread \(\[|\bstd::async \(|\bpthread_create \(")
RUNS = re.compile(r"^void (\w+)::run\(\)\n\{\n(.*?)^\}", re.S | re.M)
COMMENT = re.compile(r"//[^\n]*")


def call(code, at):
    """The text of a call, from its opening parenthesis to the matching one."""
    depth = 0
    for end in range(at, len(code)):
        depth += {"(": 1, ")": -1}.get(code[end], 0)
        if depth == 0:
            return code[at:end]
    return code[at:]


def problems(root):
    count = 0
    for folder in ("framework", "host", "nodes"):
        for path in sorted((root / folder).rglob("*.[hc]pp")):
            if path.name.startswith("fake_") and "drivers" in path.parts:
                continue  # stands for the library of a maker, which does not use ours
            code = COMMENT.sub("", path.read_text(encoding="utf-8"))
            at_line = lambda at: f"{path.relative_to(root).as_posix()}:{code.count(chr(10), 0, at) + 1}"
            persists = re.search(r"const auto persist = .*?caught \(", code, re.S)
            for begin in BEGINS.finditer(code):
                count += 1
                text = call(code, begin.end() - 1 if code[begin.end() - 1] == "(" else begin.end() - 2)
                if "caught (" not in text and not (persists and "persist (" in text):
                    yield f"{at_line(begin.start())}: this thread does not begin with caught()"
            header = path.with_suffix(".hpp")
            if path.suffix == ".cpp" and header.is_file() and re.search(r"(public|private) juce::Thread\b", header.read_text(encoding="utf-8")):
                for run in RUNS.finditer(code):
                    count += 1
                    if "caught (" not in run[2]:
                        yield f"{at_line(run.start())}: the thread of {run[1]} does not call caught()"
    if count < 10:
        yield f"only {count} threads were found, so this check does not know how threads begin"


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parents[2]).resolve()
    found = list(problems(root))
    print("\n".join(found) if found else "every thread begins with caught()")
    return 1 if found else 0


sys.exit(main())
