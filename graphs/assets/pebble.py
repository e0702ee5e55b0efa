#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws pebble.obj: an ellipsoid of 32 x 26 x 20 mm, in mm, with its top at the origin.

    python3 pebble.py > pebble.obj
"""
from liver import icosphere

AXES = 16.0, 13.0, 10.0


def main():
    points, triangles = icosphere(2)
    print("# A pebble of 32 x 26 x 20 mm, drawn by pebble.py. Units: mm.")
    for point in points:
        x, y, z = (a * p for a, p in zip(AXES, point))
        print(f"v {x:.3f} {y:.3f} {z - AXES[2]:.3f}")
    for a, b, c in triangles:
        print(f"f {a + 1} {b + 1} {c + 1}")


if __name__ == "__main__":
    main()
