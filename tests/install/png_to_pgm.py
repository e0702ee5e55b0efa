#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Converts an 8-bit grey PNG to PGM: png_to_pgm.py IN.png OUT.pgm"""
import pathlib
import struct
import sys
import zlib


def pixels(path):
    """The rows of an 8-bit PNG that is grey and not interlaced, as lists of numbers."""
    data, at, packed = pathlib.Path(path).read_bytes(), 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        chunk = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            columns, rows, *form = struct.unpack(">IIBBBBB", chunk)
            assert form == [8, 0, 0, 0, 0], f"{path} is not 8-bit grey"
        packed += chunk if kind == b"IDAT" else b""
        at += 12 + length
    unpacked = zlib.decompress(packed)
    assert len(unpacked) == rows * (columns + 1)
    above, image = [0] * (columns + 1), []
    for y in range(rows):
        line = unpacked[y * (columns + 1):(y + 1) * (columns + 1)]
        row = [0]   # a column to the left
        for x in range(1, columns + 1):
            left, up, corner = row[x - 1], above[x], above[x - 1]
            nearest = min((left, up, corner), key=lambda v: abs(left + up - corner - v))
            row.append((line[x] + (0, left, up, (left + up) // 2, nearest)[line[0]]) % 256)
        image.append(row[1:])
        above = row
    return image


if __name__ == "__main__":
    image = pixels(sys.argv[1])
    with open(sys.argv[2], "wb") as out:
        out.write(b"P5 %d %d 255\n" % (len(image[0]), len(image)) + bytes(v for row in image for v in row))
