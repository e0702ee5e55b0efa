#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws nodule.obj: a flat piece of skin, in mm, with rings of nodes about the place of a nodule.

    python3 nodule.py > nodule.obj
"""
import math

RINGS, SECTORS = (4, 9, 25, 45), 12   # radii in mm: the nodule is stiff up to the first, and gone at the second


def main():
    print("# Skin over a nodule at the origin, drawn by nodule.py. Units: mm.")
    print("v 0.000 0.000 0.000")
    for radius in RINGS:
        for k in range(SECTORS):
            a = 2.0 * math.pi * k / SECTORS
            print(f"v {radius * math.cos(a):.3f} {radius * math.sin(a):.3f} 0.000")
    for k in range(SECTORS):
        inner, after = 2 + k, 2 + (k + 1) % SECTORS
        print(f"f 1 {inner} {after}")
        for _ in RINGS[1:]:
            outer, outer_after = inner + SECTORS, after + SECTORS
            print(f"f {inner} {outer} {outer_after}")
            print(f"f {inner} {outer_after} {after}")
            inner, after = outer, outer_after


if __name__ == "__main__":
    main()
