#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes reference.csv next to this file: values of elementary functions, for math_test.cpp.

    reference.py           needs mpmath (Debian: python3-mpmath)

Each row has a function, its arguments, the double that is closest to the exact value, and the difference from the exact value, in units of
the last place of that double."""

import math
import pathlib
import random
import sys

import mpmath
from mpmath import mp, mpf

mp.prec = 1300   # an angle of 2^1024 leaves 200 bits
SIZE = 24        # random arguments per function and kind


def unit(value):
    """The unit of the last place of a double."""
    return mpf(2) ** max(math.frexp(value)[1] - 53, -1074)


def row(name, exact, *arguments):
    nearest = float(exact)
    if math.isinf(nearest):
        return None
    missing = float((exact - mpf(nearest)) / unit(nearest))
    return ",".join([name, *(a.hex() for a in arguments), *([""] * (2 - len(arguments))), nearest.hex(), f"{missing:.4f}"])


def anywhere(dice, least=-1074, most=1023):
    return math.ldexp(dice.uniform(1, 2), dice.randint(least, most)) * dice.choice([-1, 1])


def near_half_turns(dice):
    """Doubles close to multiples of pi/2; the first one is the closest of all (Muller, "Elementary Functions", 2016, section 11.3)."""
    yield math.ldexp(6381956970095103.0, 797)
    yield 45.553093477052   # the closest one below 51471
    for _ in range(SIZE):
        yield float(dice.randint(1, 40000) * mpmath.pi / 2)


def angles(dice):
    yield from (dice.uniform(-8, 8) for _ in range(SIZE))
    yield from (dice.uniform(-60000, 60000) for _ in range(SIZE))
    yield from (anywhere(dice) for _ in range(SIZE))
    yield from near_half_turns(dice)


def positive(dice):
    yield from (abs(anywhere(dice)) for _ in range(SIZE))
    yield from (dice.uniform(0.4, 2.5) for _ in range(SIZE))
    yield from (1 + anywhere(dice, -52, -10) for _ in range(SIZE))


def exponents(dice):
    yield from (dice.uniform(-746, 710) for _ in range(SIZE))
    yield from (dice.uniform(-1, 1) for _ in range(SIZE))
    yield from (anywhere(dice, -60, 9) for _ in range(SIZE))


def sines(dice):
    yield from (dice.uniform(-1, 1) for _ in range(2 * SIZE))
    yield from (math.copysign(1 - abs(anywhere(dice, -53, -2)), dice.uniform(-1, 1)) for _ in range(SIZE))
    yield from (anywhere(dice, -1074, -1) for _ in range(SIZE))


def points(dice):
    yield from ((dice.uniform(-2, 2), dice.uniform(-2, 2)) for _ in range(2 * SIZE))
    yield from ((anywhere(dice), anywhere(dice)) for _ in range(SIZE))
    for _ in range(SIZE):
        x = anywhere(dice, -500, 500)
        yield x, x * dice.uniform(0.3, 3)


def powers(dice):
    yield from ((dice.uniform(0, 3), dice.uniform(-300, 300)) for _ in range(2 * SIZE))
    yield from ((1 + anywhere(dice, -40, -8), anywhere(dice, 4, 30)) for _ in range(SIZE))
    for _ in range(SIZE):
        x = abs(anywhere(dice))
        yield x, dice.uniform(-1100, 1100) / max(abs(math.log2(x)), 1e-9)


FUNCTIONS = {
    "exp": (mpmath.exp, exponents), "exp2": (lambda x: mpf(2) ** x, exponents), "expm1": (mpmath.expm1, exponents), "log": (mpmath.log, positive),
    "log1p": (mpmath.log1p, lambda dice: (x for x in [*exponents(dice), *positive(dice)] if x > -1)),
    "log2": (lambda x: mpmath.log(x) / mpmath.log(2), positive), "log10": (mpmath.log10, positive), "pow": (mpmath.power, powers),
    "sin": (mpmath.sin, angles), "cos": (mpmath.cos, angles), "tan": (mpmath.tan, angles),
    "asin": (mpmath.asin, sines), "acos": (mpmath.acos, sines), "atan": (mpmath.atan, lambda dice: [*sines(dice), *positive(dice)]),
    "atan2": (mpmath.atan2, points), "hypot": (mpmath.hypot, points),
}


def main():
    rows = []
    for name, (function, arguments) in FUNCTIONS.items():
        for given in arguments(random.Random(name)):
            given = given if isinstance(given, tuple) else (given,)
            rows.append(row(name, function(*(mpf(a) for a in given)), *given))
    path = pathlib.Path(__file__).with_name("reference.csv")
    path.write_text("\n".join(["function,x,y,value,missing", *filter(None, rows)]) + "\n")
    print(f"{path.name}: {len(rows)} values")
    return 0


sys.exit(main())
