#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks the machine code of the libraries.

Usage: symbols.py NODES_LIBRARY OTHER_LIBRARY... Prints what is wrong. Exit status 77 if this computer has no nm or objdump.

- The library of the nodes calls no elementary function of the C library. Header functions of other libraries count, too.
- No library has a fused multiply-add: it rounds once where two operations round twice, and not every processor has it."""

import re
import shutil
import subprocess
import sys

MATH = re.compile(r"^(?:__)?(sin|cos|tan|asin|acos|atan|atan2|sinh|cosh|tanh|asinh|acosh|atanh|exp|exp2|exp10|expm1|log|log2|log10|log1p|pow|cbrt|"
                  r"hypot|fmod|remainder|remquo|erf|erfc|tgamma|lgamma|sincos|csin|ccos|cexp|clog|cpow|cabs|carg|fma)[fl]?(?:_finite)?$")
FUSED = re.compile(r"\t(vfn?m(?:add|sub)\w*|fn?m(?:add|sub|la|ls))\s")


def lines(*command):
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as program:
        yield from program.stdout
    if program.returncode != 0:
        sys.exit(f"{command[0]} failed")


def called(library):
    """Each undefined elementary function, with the object that calls it."""
    member = library
    for line in lines("nm", "--undefined-only", library):
        if line.endswith(":\n"):
            member = line[:-2]
        elif line.strip() and MATH.match(name := line.split()[-1].split("@")[0]):
            yield f"{member} calls {name} of the C library"


def fused(library):
    """The functions with fused multiply-adds."""
    function = ""
    for line in lines("objdump", "--disassemble", "--demangle", "--no-show-raw-insn", library):
        if line.endswith(">:\n"):
            function = line.split("<", 1)[1][:-3]
        elif match := FUSED.search(line):
            yield f"{function} has {match[1]}"


if not shutil.which("nm") or not shutil.which("objdump"):
    print("skipped: nm and objdump are not installed")
    sys.exit(77)
found = list(called(sys.argv[1]))
found += sorted({problem for library in sys.argv[1:] for problem in fused(library)})
print("\n".join(found) or "the nodes call no elementary function of the C library, and there is no fused multiply-add")
sys.exit(1 if found else 0)
