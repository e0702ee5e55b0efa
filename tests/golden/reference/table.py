# SPDX-License-Identifier: MIT
"""What drives a reference (columns of a feed, else constants) and what it gives.

A column is a list with one number (or vector) a tick; it replaces the
parameter of its name for that tick.
"""


def rows(feed):
    return len(next(iter(feed.values())))


def row(defaults, params, feed, k):
    """All inputs and parameters of tick k."""
    now = {**defaults, **params}
    now.update((name, column[k]) for name, column in feed.items())
    return now


def collect(steps):
    """Columns from the dictionaries that a model gives, one a tick."""
    out = {}
    for step in steps:
        for name, value in step.items():
            out.setdefault(name, []).append(value)
    return out


def each(tick, defaults, params, feed):
    """Columns from a model that is asked tick by tick."""
    return collect(tick(row(defaults, params, feed, k))
                   for k in range(rows(feed)))
