#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the long tests, those with the tag [soak], side by side, each in a process of its own: soak.py PROGRAM...

TACTUS_SOAK_SECONDS and TACTUS_SOAK_TICKS say how long they are. None of them judges time, so they may take turns on few processors. Prints what each says,
how long it took and how much of a processor it needed. Exits with 1 if one of them fails."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from waiting import Stopwatch   # noqa: E402

names = []
for program in sys.argv[1:]:
    listed = subprocess.run([program, "[soak]", "--list-test-names-only"], stdout=subprocess.PIPE, text=True, check=False).stdout.splitlines()
    names += [(program, name.strip()) for name in listed if name.strip()]
if not names:
    sys.exit("there is no test with the tag [soak]")

watch = Stopwatch()
running = {}
for program, name in names:
    output = tempfile.TemporaryFile("w+")
    wanted = re.sub(r"([\\,\[])", r"\\\1", name)   # as Catch2 reads a name
    running[subprocess.Popen([program, wanted], stdout=output, stderr=subprocess.STDOUT).pid] = name, output

failed = 0
while running:
    pid, status, used = os.wait4(-1, 0)
    name, output = running.pop(pid)
    output.seek(0)
    text = output.read()
    passed = status == 0 and "All tests passed" in text
    failed += not passed
    print(f"{'passed' if passed else 'FAILED'} after {watch}, {used.ru_utime + used.ru_stime:.0f} s of a processor, "
          f"{used.ru_maxrss / 1024:.0f} MB at most: {name}")
    shown = [line for line in text.splitlines() if line.strip() and not line.startswith(("=", "All tests passed"))] if passed else text.splitlines()
    print("".join("    " + line + "\n" for line in shown), end="", flush=True)
sys.exit(1 if failed else 0)
