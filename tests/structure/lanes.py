#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that code for one kind of processor stays where it belongs.

Usage: lanes.py NODES_LIBRARY. Prints what is wrong. Exit status 77 if this computer has no nm.

The objects for lanes (framework/kit/pack.hpp) are compiled for processors with AVX2 or AVX-512. If such an object had a copy of a function
that other objects have too, the linker might keep that copy, and the program would crash on every other processor. So each function in
these objects must have the width of the packs in its name, and nothing in them may run when a program starts."""

import re
import shutil
import subprocess
import sys

OBJECT = re.compile(r"^(?:.*:)?(\S*_lanes([248])\.cpp\.o):$")


def problems(library):
    lines = subprocess.run(["nm", "--demangle", "--defined-only", library], check=True, capture_output=True, text=True).stdout.splitlines()
    name, width, objects, at_start = "", "", 0, []
    for line in lines:
        if line.endswith(":"):
            match = OBJECT.match(line)
            name, width = match.groups() if match else ("", "")
            objects += bool(match)
        elif name and (symbol := re.match(r"^[0-9a-f]+ (\w) (.*)$", line)):
            kind, what = symbol.groups()
            if kind in "TW" and f"Pack<{width}>" not in what and f"Mask<{width}>" not in what and not re.search(rf"_lanes{width}\(\)$|, {width}>\(\)$", what):
                yield f"{name} has a copy of {what}"
            if what.startswith("_GLOBAL__sub_I"):
                at_start.append(f"{name} runs code when a program starts")
    yield from at_start
    if objects == 0:
        yield f"{library} has no objects for lanes"


if not shutil.which("nm"):
    print("skipped: nm is not installed")
    sys.exit(77)
found = list(problems(sys.argv[1]))
print("\n".join(found) or "all functions of the objects for lanes have the width in their names")
sys.exit(1 if found else 0)
