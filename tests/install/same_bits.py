# SPDX-License-Identifier: MIT
"""Compares what `tactus render` wrote with what another program computed: the same bits, however the numbers are spelled.

same_bits.py RENDERED.csv OTHER.csv
"""
import csv
import sys

rendered, other = (list(csv.reader(open(name, encoding="utf-8"))) for name in sys.argv[1:])
assert rendered[0] == other[0], (rendered[0], other[0])
assert len(rendered) == len(other) == 4001, (len(rendered), len(other))
for x, y in zip(rendered[1:], other[1:]):
    assert [float(v) for v in x[1:]] == [float(v) for v in y[1:]], (x, y)
print("4000 ticks equal `tactus render`, bit for bit")
