# SPDX-License-Identifier: MIT
"""The force of an impact: Hayward 2007, eq. (10) with the sign of Hunt & Crossley 1975.

N = K(d) + D(d) d', never below 0, -m d'' = N; S semi-implicit substeps a tick.
A contact of fewer than four ticks is solved on the hit, and each tick is its mean
force since the tick before, so that the impulse is right. dissipated_energy is the
work of D d', of all hits.
"""

import math

import laws
import table

DEFAULTS = {"hit": 0.0, "mass": 0.05, "gain": 1.0,
            "stiffness": {"power": [5e5, 1.5]}, "damping": {"dissipation": 1.0},
            "substeps": 8, "voices": 4}


FEW = 4   # ticks
USUAL_MASS = 0.05   # kg, for a mass of 0 if no device gives its own


def push(now, d, v):
    """The force, and its elastic part."""
    if d <= 0.0:
        return 0.0, 0.0
    k, damping = laws.force(now["stiffness"], d), now["damping"]
    if "dissipation" in damping:
        return max(0.0, k * (1.0 + damping["dissipation"] * v)), k
    return max(0.0, k + laws.force(damping, d) * v), k


def advance(now, voice, dt):
    """The force of a voice one tick later, the energy lost, and the voice, which is
    None if the mass has left the object."""
    if "score" in voice:
        force, lost = voice["score"][0]
        rest = voice["score"][1:]
        return force, lost, {"score": rest} if rest else None
    d, v, mass = voice["d"], voice["v"], voice["mass"]
    h, lost = dt / now["substeps"], 0.0
    for _ in range(now["substeps"]):
        n, k = push(now, d, v)
        before = v
        v -= h * n / mass
        d += h * v
        lost += max(0.0, 0.5 * h * (n - k) * (before + v))
        if d <= 0.0:
            return 0.0, lost, None
    return push(now, d, v)[0], lost, {"d": d, "v": v, "mass": mass}


def solve(now, mass, speed, dt, steps):
    """Duration, exit speed and the (depth, speed) at each tick of a contact of fewer
    than FEW ticks, in Runge-Kutta steps; None if it is longer."""
    def slope(d, v):
        return v, -push(now, d, v)[0] / mass

    d, v, h, ticks = 0.0, speed, dt / steps, []
    for n in range(1, FEW * steps + 1):
        a = slope(d, v)
        b = slope(d + 0.5 * h * a[0], v + 0.5 * h * a[1])
        c = slope(d + 0.5 * h * b[0], v + 0.5 * h * b[1])
        e = slope(d + h * c[0], v + h * c[1])
        e_d = d + h / 6.0 * (a[0] + 2.0 * (b[0] + c[0]) + e[0])
        e_v = v + h / 6.0 * (a[1] + 2.0 * (b[1] + c[1]) + e[1])
        if e_d <= 0.0:
            part = d / (d - e_d)
            return (n - 1 + part) * h, v + part * (e_v - v), ticks
        d, v = e_d, e_v
        if n % steps == 0:
            ticks.append((d, v))
    return None


def score(now, mass, speed, dt):
    """Mean force and energy lost for each tick of a short contact; None for a longer one."""
    found = solve(now, mass, speed, dt, 200)
    if found is None:
        return None
    if found[0] < 0.5 * dt:
        found = solve(now, mass, speed, dt, math.ceil(200 * dt / found[0]))
    out, d0, v0 = [], 0.0, speed
    for d, v in found[2] + [(0.0, found[1])]:
        stored = laws.energy(now["stiffness"], d) - laws.energy(now["stiffness"], d0)
        out.append((mass * (v0 - v) / dt,
                    max(0.0, 0.5 * mass * (v0 - v) * (v0 + v) - stored)))
        d0, v0 = d, v
    return out


def started(now, dt):
    mass = now["mass"] or USUAL_MASS
    short = score(now, mass, now["hit"], dt)
    if short:
        return {"score": short}
    return {"d": 0.0, "v": now["hit"], "mass": mass}


def steps(params, feed, dt):
    voices, dissipated = [], 0.0
    for k in range(table.rows(feed)):
        now = table.row(DEFAULTS, params, feed, k)
        ticks = [advance(now, v, dt) for v in voices]
        total = sum(force for force, _, _ in ticks)
        dissipated += sum(lost for _, lost, _ in ticks)
        voices = [voice for _, _, voice in ticks if voice]
        hit = now["hit"]
        if math.isfinite(hit) and hit > 0.0 and len(voices) < now["voices"]:
            voices.append(started(now, dt))
        yield {"resistance": now["gain"] * total, "dissipated_energy": dissipated}


def run(params, feed, dt):
    return table.collect(steps(params, feed, dt))
