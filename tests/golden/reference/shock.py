# SPDX-License-Identifier: MIT
"""The force of an impact: Hayward 2007, eq. (10) with the sign of Hunt & Crossley 1975.

N = K(d) + D(d) d', never below 0, -m d'' = N; S semi-implicit substeps a tick.
"""

import math

import laws
import table

DEFAULTS = {"hit": 0.0, "mass": 0.05, "gain": 1.0,
            "stiffness": {"power": [5e5, 1.5]}, "damping": {"dissipation": 1.0},
            "substeps": 8, "voices": 4}


def push(now, d, v):
    if d <= 0.0:
        return 0.0
    k, damping = laws.force(now["stiffness"], d), now["damping"]
    if "dissipation" in damping:
        return max(0.0, k * (1.0 + damping["dissipation"] * v))
    return max(0.0, k + laws.force(damping, d) * v)


def advance(now, voice, dt):
    """The voice one tick later, or None if the tool has left the object."""
    d, v, mass = voice
    h = dt / now["substeps"]
    for _ in range(now["substeps"]):
        v -= h * push(now, d, v) / mass
        d += h * v
        if d <= 0.0:
            return None
    return d, v, mass


def steps(params, feed, dt):
    voices = []
    for k in range(table.rows(feed)):
        now = table.row(DEFAULTS, params, feed, k)
        voices = [v for v in (advance(now, v, dt) for v in voices) if v]
        total = sum(push(now, d, v) for d, v, _ in voices)
        hit = now["hit"]
        if math.isfinite(hit) and hit > 0.0 and len(voices) < now["voices"]:
            voices.append((0.0, hit, now["mass"]))
        yield {"resistance": now["gain"] * total}


def run(params, feed, dt):
    return table.collect(steps(params, feed, dt))
