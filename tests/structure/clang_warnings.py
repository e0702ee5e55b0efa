#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Reads the host and the tests of its window with clang, as far as another build with clang leaves it out, for warnings and errors. Makes no objects.

Usage: clang_warnings.py BUILD OTHER. Both have compile_commands.json. Exit status 1 if clang refuses anything."""

import concurrent.futures
import pathlib
import resource
import subprocess
import sys

from commands import ROOT, cover, cpus, read


def wanted(source):
    """The bench is left to ./test.sh --tidy: its files are single, and so take long."""
    folders = source.relative_to(ROOT).parts
    return (folders[0] == "host" and folders[1] != "bench") or folders[:3] == ("tests", "host", "app")


def run(arguments, directory):
    ran = subprocess.run(arguments, cwd=directory, capture_output=True, text=True, check=False)
    if ran.returncode != 0:
        print(ran.stderr, end="", flush=True)
    return ran.returncode != 0


def main():
    build, other = (pathlib.Path(b).resolve() for b in sys.argv[1:])
    commands = read(build)
    known = set().union(*(c.sources for c in read(other)))
    left = cover([c for c in commands if {s for s in c.sources - known if wanted(s)}])
    needed = {a for c in left for a in c.arguments if a.endswith(".pch")}
    headers = [c for c in commands if c.makes_header and str(pathlib.Path(c.directory, c.object())) in needed]
    with concurrent.futures.ThreadPoolExecutor(cpus()) as pool:
        failed = sum(pool.map(lambda c: run(c.arguments, c.directory), headers))
        failed += sum(pool.map(lambda c: run([*c.without_object(), "-fsyntax-only"], c.directory), left))
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    print(f"{sum(len(c.sources) for c in left)} sources in {len(left)} batches, {used.ru_utime + used.ru_stime:.0f} s of a processor")
    return 1 if failed else 0


sys.exit(main())
