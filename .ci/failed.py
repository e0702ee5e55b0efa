#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Prints once more, after thousands of lines of tests that passed, what each failed test printed: failed.py BUILD"""
import pathlib
import re
import sys

LINES = 40   # of each test, from its end

logs = pathlib.Path(sys.argv[1], "Testing", "Temporary")
failed = {line.split(":", 1)[1] for line in (logs / "LastTestsFailed.log").read_text(encoding="utf-8", errors="replace").splitlines()}
log = (logs / "LastTest.log").read_text(encoding="utf-8", errors="replace")
for name, said in re.findall(r"^\d+/\d+ Testing: (.*?)\n.*?\nOutput:\n-+\n(.*?)\n<end of output>", log, re.MULTILINE | re.DOTALL):
    if name in failed:
        print(f"\n== Failed: {name}", *said.splitlines()[-LINES:], sep="\n")
