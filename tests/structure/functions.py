#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that what ticks, or prepares numbers for a tick, calls no elementary function of the C library.

Usage: functions.py [SOURCE_FOLDER]. Prints FILE:LINE for each problem. Exit status 1 if there are any.

The last bits of these functions differ between libraries, and in glibc even between kinds of processor. Those of
framework/kit/math/math.hpp have
the same bits everywhere. Allowed are the functions of <cmath> that are not in INEXACT: IEEE 754 defines their results exactly."""

import pathlib
import re
import sys

FOLDERS = ["nodes", "framework/kit", "framework/node", "framework/plan", "framework/run", "framework/plugin", "host/devices/hid", "host/devices/audio"]
EXEMPT = {"framework/run/clock/tick_account.cpp": "it counts how long ticks take, and no tick reads the counts"}
INEXACT = """sin cos tan asin acos atan atan2 sinh cosh tanh asinh acosh atanh exp exp2 expm1 log log2 log10 log1p pow cbrt hypot
    fmod remainder remquo erf erfc tgamma lgamma sincos polar arg fma exp10 pow10 sinpi cospi
    beta assoc_laguerre assoc_legendre legendre laguerre hermite riemann_zeta comp_ellint_1 comp_ellint_2 comp_ellint_3 ellint_1 ellint_2 ellint_3
    expint cyl_bessel_i cyl_bessel_j cyl_bessel_k cyl_neumann sph_bessel sph_legendre sph_neumann""".split()

names = "|".join(sorted(INEXACT, key=len, reverse=True))
RULES = [
    (re.compile(rf"(?<![\w:])(?:std::|::)({names})[fl]?\b"), "std::{0} has other bits elsewhere"),
    (re.compile(rf"(?<![\w:.>~])({names})[fl]?\s?\((?!\*|std::move)"), "{0} without math:: may be that of the C library"),
    (re.compile(rf"\.({names})\s?\(\)"), "the function {0} of Eigen calls the C library"),
    (re.compile(r"\b(AngleAxis[df]?|slerp|angularDistance)\b"), "{0} of Eigen calls the C library; kit/rotation.hpp has rotationMatrix"),
    (re.compile(r"\bstd::(\w+_distribution)\b"), "std::{0} gives other numbers in other standard libraries; kit/random.hpp has Random"),
    (re.compile(r"\b(__builtin_(?:" + names + r")[fl]?)\b"), "{0} calls the C library"),
]
INSTEAD = "; call math::… of <tactus/kit/math/math.hpp>"
IGNORED = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"', re.S)


def problems(root):
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*.[hc]pp")):
            name = path.relative_to(root).as_posix()
            if name.startswith(("framework/kit/math/", "framework/kit/single/")) or name in EXEMPT:
                continue
            code = IGNORED.sub(lambda m: re.sub(r"[^\n]", " ", m[0]), path.read_text(encoding="utf-8"))
            for number, line in enumerate(code.splitlines(), 1):
                for rule, why in RULES:
                    for match in rule.finditer(line):
                        yield f"{name}:{number}: {why.format(match[1])}{INSTEAD}"


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parents[2]).resolve()
    stale = [f"{name}: is exempt, but does not exist" for name in EXEMPT if not (root / name).is_file()]
    found = [*problems(root), *stale]
    print("\n".join(found) if found else "no tick calls an elementary function of the C library")
    return 1 if found else 0


sys.exit(main())
