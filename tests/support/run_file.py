#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the tests of one file of a Catch2 program in one process: run_file.py PROGRAM FILE, where FILE is a name without folders and ending.

If the process dies before it has told its results, each test of the file runs once more in a process of its own, so that one crash hides no
other failure. Exit status: 0 if all passed, 1 if not."""

import os
import re
import signal
import subprocess
import sys

LONGEST = 1400   # seconds, so that a test that hangs is ended here, with all processes that it started
ENDED = re.compile(r"^(All tests passed|test cases: )", re.MULTILINE)


def run(program, spec):
    """The exit status of a process and what it printed; None if it died or did not end."""
    process = subprocess.Popen([program, "--filenames-as-tags", spec], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True)
    try:
        text = process.communicate(timeout=LONGEST)[0].decode("utf-8", "replace")
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        return None, process.communicate()[0].decode("utf-8", "replace") + f"\nended after {LONGEST} s\n"
    return (process.returncode if ENDED.search(text) else None), text


def names(program, spec):
    listed = subprocess.run([program, "--filenames-as-tags", spec, "--list-test-names-only"], stdout=subprocess.PIPE, text=True, check=False).stdout
    return [line.strip() for line in listed.splitlines() if line.strip()]


def one_by_one(program, spec):
    for name in names(program, spec):
        status, text = run(program, re.sub(r"([\\,\[])", r"\\\1", name))   # as Catch2 reads a name
        if status is None:
            print(f"== died: {name}\n{text}")
        elif status != 0:
            print(f"== failed: {name}\n{text}")


def main():
    program, file = sys.argv[1:]
    spec = f"[#{file}]~[.]"
    status, text = run(program, spec)
    if status is None:
        if not names(program, spec):
            print(f"{program} has no test in {file}.cpp that is not hidden")
            return 1
        print(text, "== The process died. Each test in a process of its own:", sep="\n")
        one_by_one(program, spec)
        return 1
    print(text, end="")
    return 1 if status else 0


sys.exit(main())
