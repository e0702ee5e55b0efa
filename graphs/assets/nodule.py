#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws nodule.obj: a flat piece of skin, in mm, with rings of nodes about the place of a nodule.

    python3 nodule.py > nodule.obj
    python3 nodule.py --curves      the curves at its nodes, for nodule_under_skin.json

The nodule is stiff up to a radius of 4 mm, and gone at 9 mm. The weights of a node reach 1.6 edges far, so the cells are even from the middle to
beyond the nodule, and three of them lie over the rise.
"""
import math
import sys

CELL, EVEN = 5.0 / 3.0, 7       # mm; rings with this distance and with 6 nodes more each
OUTER = (15.5, 22.0, 31.0, 45.0)   # radii in mm of rings with as many nodes as the last even one
SOFT, STIFF = 300.0, 1500.0     # N/m along the normal
ACROSS = 0.6                    # of that, sideways


def rings():
    """The radius and the number of nodes of each ring."""
    return [(CELL * k, 6 * k) for k in range(1, EVEN + 1)] + [(radius, 6 * EVEN) for radius in OUTER]


def between(inner, outer, first, second):
    """The triangles between a ring of `inner` nodes from number `first` and one of `outer` nodes from `second`."""
    i = k = 0
    while i < inner or k < outer:
        a, b = first + i % inner, second + k % outer
        if i < inner and (i + 1) * outer <= (k + 1) * inner and k > 0:
            yield a, b, first + (i + 1) % inner
            i += 1
        else:
            yield a, b, second + (k + 1) % outer
            k += 1


def stiffness(radius):
    x = min(1.0, max(0.0, (9.0 - radius) / 5.0))
    return SOFT + (STIFF - SOFT) * x * x * (3.0 - 2.0 * x)


def curves():
    for radius, count in [(0.0, 1)] + rings():
        along = round(stiffness(radius))
        across = f'{{ "power": [{ACROSS * along:g}, 1] }}'
        for _ in range(count):
            print(f'              [{across}, {across}, {{ "power": [{along}, 1] }}],')


def mesh():
    print("# Skin over a nodule at the origin, drawn by nodule.py. Units: mm.")
    print("v 0.000 0.000 0.000")
    for radius, count in rings():
        for k in range(count):
            a = 2.0 * math.pi * k / count
            print(f"v {radius * math.cos(a):.3f} {radius * math.sin(a):.3f} 0.000")
    for k in range(6):
        print(f"f 1 {2 + k} {2 + (k + 1) % 6}")
    first, inner = 2, 6
    for _, outer in rings()[1:]:
        for triangle in between(inner, outer, first, first + inner):
            print("f", *triangle)
        first, inner = first + inner, outer


if __name__ == "__main__":
    curves() if "--curves" in sys.argv[1:] else mesh()
