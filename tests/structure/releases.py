#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compiles the examples of the last release, as they were, against the headers of now, and runs the one in C.

Usage: releases.py SOURCE_FOLDER COMPILER C_COMPILER INCLUDE_FOLDER EIGEN_FOLDER LIBTACTUS FLAG... (those of tactus::node_flags). tests/releases has the
examples. A release replaces them by its own, so that each release compiles the examples of the one before."""

import pathlib
import subprocess
import sys
import tempfile


def said(*command):
    done = subprocess.run(command, capture_output=True, text=True)
    return "" if done.returncode == 0 else f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}\n"


def runs(program, graph, ticks):
    """The mistakes in the CSV that the example in C prints."""
    done = subprocess.run([program, graph, str(ticks)], capture_output=True, text=True)
    rows = [line.split(",") for line in done.stdout.splitlines()]
    if done.returncode != 0 or len(rows) != ticks + 1:
        return f"the program in C printed {len(rows)} lines, with the status {done.returncode}: {done.stderr}\n"
    felt = any(float(value) != 0.0 for row in rows[1:] for value in row[1:])
    return "" if felt else "the program in C felt no force\n"


def main(source, compiler, c_compiler, include, eigen, library, *flags):
    source, library = pathlib.Path(source), pathlib.Path(library)
    releases = sorted((source / "tests/releases").iterdir())
    assert len(releases) == 1, releases
    files = sorted(releases[0].rglob("*.[ch]*"))
    assert len(files) == 6, files
    problems = ""
    with tempfile.TemporaryDirectory() as folder:
        # Headers of nodes are read as tactus_add_nodes would: each in a file of its own.
        headers = [path for path in files if path.suffix == ".hpp"]
        for number, header in enumerate(headers):
            pathlib.Path(folder, f"{number}.cpp").write_text(f'#include "{header}"\n', encoding="utf-8")
        units = [path for path in files if path.suffix == ".cpp"] + sorted(pathlib.Path(folder).glob("*.cpp"))
        problems += said(compiler, "-std=c++20", "-fsyntax-only", *flags, f"-I{include}", "-isystem", eigen, *units)
        for path in (path for path in files if path.suffix == ".c"):
            program = pathlib.Path(folder, "program")
            wrong = said(c_compiler, "-std=c99", "-Wall", "-Wextra", "-Werror", f"-I{include}", path, library, f"-Wl,-rpath,{library.parent}", "-o", program)
            problems += wrong or runs(program, source / "graphs/dry_wood.json", 2000)
    print(problems or f"the examples of {releases[0].name} compile, and the one in C runs")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
