#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs every PARTS-th test of a Catch2 program, from the PART-th on, in one process. Under a sanitizer, a process takes longer to start than most
tests take to run.

Usage: batch.py PROGRAM TESTS PART PARTS. Exit status: the program's."""

import subprocess
import sys
import tempfile

program, tests, part, parts = sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4])
names = subprocess.run([program, tests, "--list-test-names-only"], capture_output=True, text=True, check=False).stdout.splitlines()
with tempfile.NamedTemporaryFile("w", suffix=".txt", encoding="utf-8") as chosen:
    chosen.write("\n".join(name.replace("\\,", ",") for name in names[part - 1 :: parts]) + "\n")
    chosen.flush()
    sys.exit(subprocess.run([program, "--input-file", chosen.name], check=False).returncode)
