# SPDX-License-Identifier: MIT
"""Random parameters and trajectories: strokes, jumps, repeats, nan, hits."""

import math

import vec

BAD = (math.nan, math.inf, -math.inf)


def spread(rng, low, high):
    """A log-uniform random number."""
    return math.exp(rng.uniform(math.log(low), math.log(high)))


def rate(rng):
    return float(round(spread(rng, 500.0, 20000.0)))


def chance(rng, share):
    return rng.random() < share


def stroke(rng, rows, size):
    """A smooth back-and-forth motion of about this size."""
    waves = [(rng.uniform(0.3, 1.0) * size / (i + 1),
              rng.uniform(0.3, 3.0) * (i + 1), rng.uniform(0.0, 2.0 * math.pi))
             for i in range(3)]
    return [sum(a * math.sin(2.0 * math.pi * w * k / rows + phase)
                for a, w, phase in waves) for k in range(rows)]


def ramps(rng, rows, size):
    """Back and forth at a constant speed, so that sliding becomes steady too."""
    top, count = rng.uniform(0.3, 1.0) * size, rng.randint(1, 4)
    return [top * abs((4.0 * count * k / rows) % 4.0 - 2.0) - top
            for k in range(rows)]


def steps_in(rng, rows, size, count):
    """A staircase of random jumps, some of them a hundred times this size."""
    level, out = 0.0, []
    at = set(rng.sample(range(1, rows), count))
    for k in range(rows):
        if k in at:
            far = 100.0 if chance(rng, 0.2) else 1.0
            level = rng.uniform(-1.0, 1.0) * size * far
        out.append(level)
    return out


def hold(rng, columns, pauses=4):
    """Repeats samples: all columns keep their values for a while."""
    rows = len(columns[0])
    for _ in range(rng.randint(0, pauses)):
        start = rng.randrange(rows - 1)
        for k in range(start + 1, min(rows, start + rng.randint(2, 20))):
            for column in columns:
                column[k] = column[start]


def spoil(rng, column, most=3):
    """Puts nan or inf into a column now and then."""
    for _ in range(rng.randint(0, most)):
        at = rng.randrange(len(column))
        value = rng.choice(BAD)
        if isinstance(column[at], tuple):
            i = rng.randrange(3)
            value = column[at][:i] + (value,) + column[at][i + 1:]
        column[at] = value


def motion(rng, rows, size, pauses=4):
    """A stroke on a line, sometimes with tremor, jumps, repeats and quanta."""
    out = rng.choice((stroke, stroke, ramps))(rng, rows, size)
    if chance(rng, 0.4):
        out = [x + rng.gauss(0.0, 0.02 * size) for x in out]
    if chance(rng, 0.5):
        jumps = steps_in(rng, rows, size, rng.randint(1, 6))
        out = [x + jump for x, jump in zip(out, jumps)]
    if chance(rng, 0.25):
        quantum = size * spread(rng, 1e-4, 0.05)
        out = [quantum * math.floor(x / quantum + 0.5) for x in out]
    hold(rng, [out], pauses)
    return out


def motion3(rng, rows, size):
    axes = [motion(rng, rows, size, 0) for _ in range(3)]
    hold(rng, axes)
    return list(zip(*axes))


def direction(rng):
    while True:
        v = tuple(rng.uniform(-1.0, 1.0) for _ in range(3))
        if 0.2 < vec.norm(v) < 1.0:
            return vec.unit(v)


def normals(rng, rows):
    """A vector of any length that rotates, and jumps now and then."""
    start, axis = direction(rng), direction(rng)
    wobble = stroke(rng, rows, rng.choice((0.0, 0.3, 1.5)))
    length = rng.choice((1.0, 1.0, 7.5, 0.02))
    jump = rng.randrange(rows)
    out = []
    for k, angle in enumerate(wobble):
        angle += 1.0 if k >= jump else 0.0
        turn = vec.rotation(vec.scale(angle, axis))
        out.append(vec.scale(length, vec.times(turn, start)))
    return out


def hits(rng, rows, share):
    """Impact speeds: 0 on most ticks; some are negative, nan or infinite."""
    out = [0.0] * rows
    for k in range(rows):
        if chance(rng, share):
            out[k] = rng.uniform(0.02, 0.8)
            if chance(rng, 0.1):
                out[k] = rng.choice((-0.3, *BAD))
    return out


def law(rng, force, depth, kinds=("power", "exponential", "table")):
    """A rising law that gives about this force at about this depth."""
    kind = rng.choice(kinds)
    if kind == "power":
        n = rng.uniform(1.0, 2.0)
        return {"power": [force / depth ** n, n]}
    if kind == "exponential":
        b = rng.uniform(0.3, 2.0) / depth
        return {"exponential": [force / math.expm1(b * depth), b]}
    count = rng.randint(2, 5)
    slopes = sorted(rng.uniform(0.3, 2.0) for _ in range(count))
    es, fs = [0.0], [0.0]
    for slope in slopes:
        step = rng.uniform(0.2, 0.6)
        es.append(es[-1] + step)
        fs.append(fs[-1] + slope * step)
    start = rng.choice((0, 1))
    return {"table": [[e * depth for e in es[start:]],
                      [f * force for f in fs[start:]]]}


def weaker(law_, share):
    """The same law, with its force multiplied by a factor."""
    if "power" in law_:
        k, n = law_["power"]
        return {"power": [k * share, n]}
    if "exponential" in law_:
        a, b = law_["exponential"]
        return {"exponential": [a * share, b]}
    es, fs = law_["table"]
    return {"table": [es, [f * share for f in fs]]}
