#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Prints the coefficients of the polynomials in framework/kit/math, and the largest relative error that each causes.

    coefficients.py        needs mpmath (Debian: python3-mpmath)

Each polynomial is the best approximation in the sense of Chebyshev, found by the exchange algorithm of Remez (1934; Cheney, "Introduction to
Approximation Theory", 1966, chapter 3). The error printed is that of the coefficients rounded to double."""

from mpmath import atan, cos, expm1, fabs, log, log1p, lu_solve, matrix, mp, mpf, pi, sin, sqrt, tan

mp.prec = 240


def best(function, weight, low, high, powers):
    """The coefficients c of sum c[i] x^powers[i] for which the largest weight (x) |sum - function (x)| is smallest, and this error."""
    n = len(powers) + 1

    def spread(count):   # from low to high, closer to each other near the ends; not 0, where functions are 0/0
        least = (high - low) * mpf(2) ** -60
        spots = [(low + high) / 2 - (high - low) / 2 * cos(pi * i / (count - 1)) for i in range(count)]
        return [p if fabs(p) > least else least for p in spots]

    points, grid = spread(n), spread(601)
    for _ in range(12):
        rows = matrix(n, n)
        values = matrix(n, 1)
        for i, x in enumerate(points):
            for j, p in enumerate(powers):
                rows[i, j] = weight(x) * x ** p
            rows[i, n - 1] = (-1) ** i
            values[i] = weight(x) * function(x)
        solved = lu_solve(rows, values)
        coefficients = [solved[j] for j in range(n - 1)]

        def error(x):
            return weight(x) * (sum(c * x ** p for c, p in zip(coefficients, powers)) - function(x))

        errors = [error(x) for x in grid]
        largest = max(fabs(e) for e in errors)
        peaks = []   # the largest error between two changes of sign
        for x, e in zip(grid, errors):
            if peaks and (e > 0) == (peaks[-1][1] > 0):
                if fabs(e) > fabs(peaks[-1][1]):
                    peaks[-1] = (x, e)
            else:
                peaks.append((x, e))
        while len(peaks) > n:
            peaks.pop(0 if fabs(peaks[0][1]) < fabs(peaks[-1][1]) else -1)
        if len(peaks) < n or largest < fabs(solved[n - 1]) * (1 + mpf(1) / 1000):
            break
        points = [x for x, _ in peaks]
    return coefficients, largest


def rounded(name, function, weight, low, high, powers):
    """Prints the coefficients as doubles."""
    found, _ = best(function, weight, low, high, powers)
    fixed = [mpf(float(c)) for c in found]
    grid = [low + (high - low) * (i + mpf(1) / 2) / 2000 for i in range(2000)]
    worst = max(fabs(weight(x) * (sum(c * x ** p for c, p in zip(fixed, powers)) - function(x))) for x in grid)
    print(f"{name}: 2^{float(log(worst, 2)):.1f}")
    for c in fixed:
        print("   ", float(c).hex(), repr(float(c)))


def split(name, value, *bits):
    """Prints the value as a sum of doubles, each with the given number of bits."""
    for b in bits:
        scale = mpf(2) ** (b - 1 - int(mp.floor(log(fabs(value), 2))))
        part = mp.floor(value * scale + mpf(1) / 2) / scale
        assert mpf(float(part)) == part
        print(f"{name} ({b} bits): {float(part).hex()}")
        value -= part


def main():
    edge = log(2) / 2 * (1 + mpf(2) ** -20)
    rounded("exp (r) = 1 + r + r^2/2 + r^3 P(r)", lambda r: (expm1(r) - r - r ** 2 / 2) / r ** 3, lambda r: edge ** 3, -edge, edge, range(10))
    s = (sqrt(2) - 1) / (sqrt(2) + 1) * (1 + mpf(2) ** -20)

    def series(z):   # (atanh (s) - s) / s^3
        root = sqrt(z)
        return (log1p(2 * root / (1 - root)) / 2 - root) / root ** 3
    rounded("log ((1 + s)/(1 - s)) = 2 s + s z P(z), z = s^2", lambda z: 2 * series(z), lambda z: z / 2, mpf(0), s ** 2, range(7))
    rounded("log ((1 + s)/(1 - s)) = 2/3 s (3 + z + z^2 P(z)), z = s^2", lambda z: (3 * series(z) - 1) / z, lambda z: z ** 2 / 3, mpf(0), s ** 2, range(8))
    quarter = (pi / 4 * (1 + mpf(2) ** -20)) ** 2
    rounded("sin (y) = y + y z P(z), z = y^2", lambda z: (sin(sqrt(z)) / sqrt(z) - 1) / z, lambda z: z, mpf(0), quarter, range(6))
    rounded("cos (y) = 1 - z/2 + z^2 P(z), z = y^2", lambda z: (cos(sqrt(z)) - 1 + z / 2) / z ** 2, lambda z: z ** 2 / cos(sqrt(z)), mpf(0), quarter, range(6))
    eighth = (tan(pi / 8) * (1 + mpf(2) ** -20)) ** 2
    rounded("atan (t) = t + t z P(z), z = t^2", lambda z: (atan(sqrt(z)) / sqrt(z) - 1) / z, lambda z: z, mpf(0), eighth, range(12))
    split("ln 2", log(2), 42, 53)
    split("pi/2", pi / 2, 38, 38, 53)
    split("pi/2, for huge angles", pi / 2, 23, 53)
    split("pi/4", pi / 4, 50, 53)
    split("2/3", mpf(2) / 3, 26, 53)
    split("1/ln 10", 1 / log(10), 26, 53)
    split("1/ln 2", 1 / log(2), 26, 53)
    print("2/pi, words of 64 bits:")
    with mp.workprec(1400):
        bits = int(mp.floor(2 / mp.pi * mpf(2) ** (64 * 20)))
    for i in range(20):
        print(f"    0x{(bits >> (64 * (19 - i))) & (2 ** 64 - 1):016x}")


main()
