#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that programs are hardened.

Usage: hardening.py PROGRAM... Prints what is missing. Exit status 77 if this computer has no readelf or objdump.

- All symbols are resolved at the start, and the table of addresses is read-only from then on (full RELRO).
- The program is position independent.
- Functions with buffers check their stack, and copies of known size check their bounds (_FORTIFY_SOURCE).
- Indirect jumps land only where a function begins (x86: endbr64)."""

import platform
import re
import shutil
import subprocess
import sys


def output(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def missing(program):
    headers = output("readelf", "--wide", "--file-header", "--program-headers", "--dynamic", program)
    symbols = output("readelf", "--wide", "--dyn-syms", program)
    if "GNU_RELRO" not in headers:
        yield "RELRO"
    if not re.search(r"BIND_NOW|FLAGS_1.*NOW", headers):
        yield "immediate binding"
    if not re.search(r"Type:\s+DYN", headers):
        yield "position independence"
    if "__stack_chk_fail" not in symbols:
        yield "a stack protector"
    if not re.search(r"__\w+_chk@", symbols):
        yield "_FORTIFY_SOURCE"
    if platform.machine() in ("x86_64", "AMD64") and "endbr64" not in output("objdump", "--disassemble=main", program):
        yield "control-flow protection"


if not shutil.which("readelf") or not shutil.which("objdump"):
    print("skipped: readelf and objdump are not installed")
    sys.exit(77)
problems = [f"{program} has no {what}" for program in sys.argv[1:] for what in missing(program)]
print("\n".join(problems) or f"{len(sys.argv) - 1} programs are hardened")
sys.exit(1 if problems else 0)
