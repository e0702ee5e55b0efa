# SPDX-License-Identifier: MIT
"""Laws of force against depth, their energies and inverses.

power k e^n; exponential a (e^(b e) - 1); table from (0, 0), linear, the last
slope continued. All are 0 for e <= 0.
"""

import math


def points(law):
    es, fs = law["table"]
    both = list(zip(es, fs))
    return both if es[0] == 0.0 else [(0.0, 0.0)] + both


def pieces(law):
    """(start, force at the start, slope, end) of each straight piece of a table."""
    at = points(law)
    for i in range(len(at) - 1):
        (e0, f0), (e1, f1) = at[i], at[i + 1]
        end = e1 if i + 2 < len(at) else math.inf
        yield e0, f0, (f1 - f0) / (e1 - e0), end


def force(law, e):
    if e <= 0.0:
        return 0.0
    if "power" in law:
        k, n = law["power"]
        return k * e ** n
    if "exponential" in law:
        a, b = law["exponential"]
        return a * math.expm1(b * e)
    for start, f, slope, end in pieces(law):
        if e <= end:
            return f + slope * (e - start)


def energy(law, e):
    """The integral of the force from 0 to e."""
    if e <= 0.0:
        return 0.0
    if "power" in law:
        k, n = law["power"]
        return k * e ** (n + 1.0) / (n + 1.0)
    if "exponential" in law:
        a, b = law["exponential"]
        return a * (math.expm1(b * e) / b - e)
    total = 0.0
    for start, f, slope, end in pieces(law):
        step = min(e, end) - start
        if step <= 0.0:
            break
        total += (f + 0.5 * slope * step) * step
    return total


def inverse(law, f):
    """The depth at which a rising law gives this force."""
    if "power" in law:
        k, n = law["power"]
        return (f / k) ** (1.0 / n)
    if "exponential" in law:
        a, b = law["exponential"]
        return math.log1p(f / a) / b
    for start, f0, slope, end in pieces(law):
        if end == math.inf or f <= f0 + slope * (end - start):
            return start + (f - f0) / slope


def odd(law, d):
    return math.copysign(force(law, abs(d)), d)


def linear(curve, x):
    """A curve [[x...], [y...]]: linear in between, held beyond the ends."""
    xs, ys = curve
    if x <= xs[0]:
        return ys[0]
    for i in range(len(xs) - 1):
        if x <= xs[i + 1]:
            return ys[i] + (ys[i + 1] - ys[i]) * (x - xs[i]) / (xs[i + 1] - xs[i])
    return ys[-1]
