# SPDX-License-Identifier: MIT
"""Tolerances of the golden columns.

The entry of the golden JSON with the longest matching prefix applies.
"""

import json
import math
import pathlib

GOLDEN = pathlib.Path(__file__).resolve().parent.parent


def about(name):
    return json.loads((GOLDEN / f"{name}.json").read_text())


def entry(golden, column):
    """The tolerance of a column; {} if it must be exact."""
    table = golden["tolerance"]
    fitting = [p for p in table if p == "*" or column.startswith(p)]
    best = max(fitting, key=lambda p: 0 if p == "*" else len(p), default=None)
    found = table.get(best, {"abs": 0.0})
    return {} if isinstance(found, str) else found


def error(expected, actual, allowed, peak):
    """The error in units of the tolerance; more than 1 is too large."""
    if math.isnan(expected) and math.isnan(actual):
        return 0.0
    off = abs(expected - actual)
    limit = (allowed.get("abs", allowed.get("abs_x", 0.0))
             + allowed.get("rel", 0.0) * abs(expected)
             + allowed.get("rel_of_peak", 0.0) * peak)
    if off == 0.0:
        return 0.0
    return off / limit if limit and not math.isnan(off) else math.inf


def worst(expected, actual, allowed, skip=()):
    """The largest error in a column, and its row."""
    peak = max((abs(x) for x in expected if math.isfinite(x)), default=0.0)
    errors = [(error(x, y, allowed, peak), -k)
              for k, (x, y) in enumerate(zip(expected, actual)) if k not in skip]
    most, row = max(errors, default=(0.0, 0))
    return most, -row
