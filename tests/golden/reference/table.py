# SPDX-License-Identifier: MIT
"""Inputs of a reference model (columns of a feed, or constants) and its outputs.

A column is a list with one number (or vector) per tick. It replaces the
parameter of the same name.
"""


def rows(feed):
    return len(next(iter(feed.values())))


def row(defaults, params, feed, k):
    """All inputs and parameters of tick k."""
    now = {**defaults, **params}
    now.update((name, column[k]) for name, column in feed.items())
    return now


def collect(steps):
    """Columns from the dictionaries that a model returns, one per tick."""
    out = {}
    for step in steps:
        for name, value in step.items():
            out.setdefault(name, []).append(value)
    return out


def each(tick, defaults, params, feed):
    """Columns from a model that is evaluated tick by tick."""
    return collect(tick(row(defaults, params, feed, k))
                   for k in range(rows(feed)))
