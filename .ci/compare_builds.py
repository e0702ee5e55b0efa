#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares what two builds of the same sources, in the same folder one after the other, have made: compare_builds.py KEPT NEW

Objects, libraries, bitcode and programs must have the same bytes. Prints those that differ. Exit status 1 if there are any, or if there was nothing to
compare: then an earlier run kept an object that its sources do not give."""

import filecmp
import pathlib
import sys

MADE = {".o", ".a", ".so", ".bc", ".tactus", ".tactus-device"}


def made(build):
    """The files that compilers and linkers made, below the build folder."""
    for file in build.rglob("*"):
        if (file.suffix in MADE or file.parent.name == "bin") and file.is_file() and not file.is_symlink():
            yield file.relative_to(build)


def main():
    kept, new = map(pathlib.Path, sys.argv[1:])
    both = sorted(set(made(kept)) & set(made(new)))
    different = [file for file in both if not filecmp.cmp(kept / file, new / file, shallow=False)]
    for file in different:
        print(f"{file}: what was kept differs from what its sources give")
    print(f"{len(both)} objects, libraries and programs compared, {len(different)} differ")
    return 1 if different or not both else 0


sys.exit(main())
