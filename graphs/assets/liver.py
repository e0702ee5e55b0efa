#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws liver.obj: a body with the size and shape of a liver, in mm, with its top at the origin.

An icosahedron is subdivided three times, flattened to 220 x 140 x 63 mm, and thinned on one side like
the left lobe. Not an anatomical model: the dimensions are round numbers near those of an adult's organ.

    python3 liver.py > liver.obj
"""
import math


def icosphere(divisions):
    """Points on the unit sphere and triangles, counter-clockwise seen from outside."""
    t = (1 + math.sqrt(5)) / 2
    points = [(-1, t, 0), (1, t, 0), (-1, -t, 0), (1, -t, 0), (0, -1, t), (0, 1, t),
              (0, -1, -t), (0, 1, -t), (t, 0, -1), (t, 0, 1), (-t, 0, -1), (-t, 0, 1)]
    triangles = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4),
                 (11, 10, 2), (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8),
                 (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    points = [unit(p) for p in points]
    for _ in range(divisions):
        halves, smaller = {}, []

        def half(a, b):
            key = (min(a, b), max(a, b))
            if key not in halves:
                halves[key] = len(points)
                points.append(unit(tuple(x + y for x, y in zip(points[a], points[b]))))
            return halves[key]

        for a, b, c in triangles:
            ab, bc, ca = half(a, b), half(b, c), half(c, a)
            smaller += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
        triangles = smaller
    return points, triangles


def unit(p):
    length = math.sqrt(sum(x * x for x in p))
    return tuple(x / length for x in p)


def liver(direction):
    x, y, z = direction
    thin = 1.0 - 0.5 * max(x, 0.0) ** 2
    return 110 * x, 70 * y * thin, 35 * z * thin * (1.0 if z > 0 else 0.8)


def main():
    points, triangles = icosphere(3)
    placed = [liver(p) for p in points]
    top = max(z for x, y, z in placed)
    print("# A body of a liver's size, drawn by liver.py. Units: mm.")
    for x, y, z in placed:
        print(f"v {x:.3f} {y:.3f} {z - top:.3f}")
    for a, b, c in triangles:
        print(f"f {a + 1} {b + 1} {c + 1}")


if __name__ == "__main__":
    main()
