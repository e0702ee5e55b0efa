# SPDX-License-Identifier: MIT
"""Counts instructions with callgrind, for scripts that compare them. No clock is involved, so the counts are reproducible."""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77


def is_missing():
    """Prints a message if callgrind is not installed."""
    missing = shutil.which("valgrind") is None
    if missing:
        print("skipped: valgrind is not installed")
    return missing


def count(functions, program, *arguments):
    """Runs a program that calls `counted` after each thing that it does, and prints a line for it.

    Returns [(line, instructions within these functions)], in the order in which the program does it."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out"
        ran = subprocess.run(["valgrind", "--tool=callgrind", *(f"--toggle-collect={f}" for f in functions), "--dump-after=counted",
                              f"--callgrind-out-file={out}", program, *arguments],
                             stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
        if ran.returncode != 0:
            sys.exit(ran.stderr)
        return [(line, int(re.search(r"^summary: (\d+)", pathlib.Path(f"{out}.{number}").read_text(), re.M)[1]))
                for number, line in enumerate(ran.stdout.splitlines(), start=1)]


def judge(limits):
    """Prints each (what, value, most). Returns 1, the exit status, if a value is above its limit, otherwise 0."""
    for what, value, most in limits:
        print(f"{what}: {value:.4g}, at most {most:g}{'   TOO MUCH' if value > most else ''}")
    return int(any(value > most for _, value, most in limits))
