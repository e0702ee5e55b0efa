# SPDX-License-Identifier: MIT
"""Vectors of three numbers as tuples."""

import math


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scale(s, a):
    return (s * a[0], s * a[1], s * a[2])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1],
            a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0])


def norm(a):
    return math.sqrt(dot(a, a))


def unit(a):
    return scale(1.0 / norm(a), a)


def across(n, a):
    """(I - n n^T) a, for a unit vector n."""
    return sub(a, scale(dot(n, a), n))


def finite(*values):
    """Whether every number, and every component of a vector, is finite."""
    return all(math.isfinite(x) for value in values
               for x in (value if isinstance(value, tuple) else (value,)))


def combine(weights, vectors):
    total = (0.0, 0.0, 0.0)
    for weight, vector in zip(weights, vectors):
        total = add(total, scale(weight, vector))
    return total


def rotation(r):
    """The matrix (rows) of a rotation vector, axis times angle (Rodrigues)."""
    angle = norm(r)
    if angle == 0.0:
        return ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    axis = scale(1.0 / angle, r)

    def turned(a):
        along = scale(dot(axis, a) * (1.0 - math.cos(angle)), axis)
        return add(add(scale(math.cos(angle), a), along),
                   scale(math.sin(angle), cross(axis, a)))

    columns = [turned(e) for e in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    return tuple(zip(*columns))


def times(matrix, a):
    return tuple(dot(row, a) for row in matrix)
