#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws leather.png: the grain of a hide, 128 x 128 points of 8 bits; white is high.

Pebbles around the points of a perturbed grid, with creases where two of them meet, and heights that
vary a little from pebble to pebble. Nothing was measured; the sizes are chosen to look like leather.

    python3 leather.py > leather.png
"""
import math
import random
import struct
import sys
import zlib

SIZE, PEBBLE = 128, 12.0


def heights():
    dice = random.Random(1)
    cells = range(-1, int(SIZE / PEBBLE) + 2)
    pebbles = [((i + 0.5 * (j % 2) + dice.uniform(-0.3, 0.3)) * PEBBLE, (j + dice.uniform(-0.3, 0.3)) * PEBBLE, dice.uniform(0.75, 1.0))
               for j in cells for i in cells]
    for y in range(SIZE):
        for x in range(SIZE):
            near, next_near = sorted((math.hypot(x - px, y - py), top) for px, py, top in pebbles)[:2]
            crease = min(1.0, (next_near[0] - near[0]) / (0.5 * PEBBLE))
            yield near[1] * math.sin(0.5 * math.pi * crease) ** 0.7 if crease > 0 else 0.0


def chunk(name, data):
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


def main():
    grey = [round(255 * h) for h in heights()]
    rows = b"".join(b"\0" + bytes(grey[y * SIZE:(y + 1) * SIZE]) for y in range(SIZE))
    sys.stdout.buffer.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", SIZE, SIZE, 8, 0, 0, 0, 0))
                            + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


main()
