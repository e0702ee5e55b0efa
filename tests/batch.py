#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the tests of every PARTS-th file of a Catch2 program, from the PART-th on, in one process. Under a sanitizer, a process takes longer to
start than most tests take to run.

Usage: batch.py PROGRAM TESTS PART PARTS. TESTS is a test spec of Catch2 without commas. Exit status: the program's."""

import re
import subprocess
import sys

program, tests, part, parts = sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4])
command = [program, "--filenames-as-tags"]
tags = subprocess.run([*command, tests, "--list-tags"], capture_output=True, text=True, check=False).stdout
files = sorted(set(re.findall(r"\[#[^]]+\]", tags)))
sys.exit(subprocess.run([*command, ",".join(file + tests for file in files[part - 1 :: parts])], check=False).returncode)
