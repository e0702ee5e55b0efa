# SPDX-License-Identifier: MIT
"""Compares what `tactus render` wrote with what another program computed: the same bits, however the numbers are spelled.

same_bits.py RENDERED.csv OTHER.csv [TICKS]

TICKS is how many rows there must be: 4000 without it.
"""
import csv
import sys

rendered, other = (list(csv.reader(open(name, encoding="utf-8"))) for name in sys.argv[1:3])
ticks = int(sys.argv[3]) if len(sys.argv) > 3 else 4000
assert rendered[0] == other[0], (rendered[0], other[0])
assert len(rendered) == len(other) == ticks + 1, (len(rendered), len(other))
for x, y in zip(rendered[1:], other[1:]):
    assert [float(v) for v in x[1:]] == [float(v) for v in y[1:]], (x, y)
print(f"{ticks} ticks equal `tactus render`, bit for bit")
