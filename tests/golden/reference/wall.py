# SPDX-License-Identifier: MIT
"""A plane, and a simulated tool pushed against an object.

N = max(0, K(depth) (1 + dissipation rate) + damping rate), Hayward 2007,
eq. (10). The tool is a mass with damping under a force that is held over each
tick, solved exactly: a = e^(-B T/M), g = M (1 - a)/B,
x += g v + (T - g)/B F, v = a v + (1 - a)/B F.
"""

import math

import laws
import table
import vec

ZERO = (0.0, 0.0, 0.0)
PLANE = {"position": ZERO, "normal": (0.0, 0.0, 1.0), "offset": 0.0,
         "stiffness": 1000.0, "damping": 0.0, "dissipation": 0.0, "law": None}
DEVICE = {"mass": 0.05, "damping": 0.0, "quantum": 0.0, "delay": 0,
          "position": ZERO, "velocity": ZERO, "hand_force": ZERO}


def lost(now, law, start, end, rate):
    """What the damping takes along a straight path; a wall that does not pull takes at
    most what its spring gives back."""
    start, end = max(0.0, start), max(0.0, end)
    stored = laws.energy(law, end) - laws.energy(law, start)
    taken = rate * (now["dissipation"] * stored + now["damping"] * (end - start))
    return max(0.0, min(taken, -stored) if rate < 0.0 else taken)


def plane_tick(dt):
    """A plane, evaluated tick by tick."""
    before, dissipated = None, 0.0

    def tick(now):
        nonlocal before, dissipated
        p, n = now["position"], now["normal"]
        if not vec.finite(p, n):
            before = None
            return {"force": ZERO, "resistance": 0.0, "depth": 0.0,
                    "stored_energy": 0.0, "dissipated_energy": dissipated,
                    "state": -1}
        n = vec.unit(n)
        law = now["law"] or {"power": [now["stiffness"], 1.0]}
        depth = now["offset"] - vec.dot(n, p)
        rate = 0.0 if before is None else (depth - before) / dt
        if before is not None:
            dissipated += lost(now, law, before, depth, rate)
        before, push = depth, 0.0
        if depth > 0.0:
            elastic = laws.force(law, depth) * (1.0 + now["dissipation"] * rate)
            push = max(0.0, elastic + now["damping"] * rate)
        return {"force": vec.scale(push, n), "resistance": push, "depth": depth,
                "stored_energy": laws.energy(law, depth),
                "dissipated_energy": dissipated,
                "state": 1 if depth > 0.0 else 0}

    return tick


def plane(params, feed, dt):
    return table.each(plane_tick(dt), PLANE, params, feed)


def quantised(x, quantum):
    return quantum * math.floor(x / quantum + 0.5) if quantum else x


def moved(device, x, v, f, dt):
    """Position and velocity one tick later, of one axis."""
    m, b = device["mass"], device["damping"]
    if b == 0.0:
        return x + dt * v + dt * dt * f / (2.0 * m), v + dt * f / m
    a = math.exp(-b * dt / m)
    g = m * (1.0 - a) / b
    return x + g * v + (dt - g) / b * f, a * v + (1.0 - a) / b * f


def simulate(device, tick, defaults, params, count, dt):
    """A tool from its initial state, against an object evaluated tick by tick."""
    device, fixed = {**DEVICE, **device}, {**defaults, **params}
    x, v = device["position"], device["velocity"]
    forces, out = [], []
    for k in range(count):
        measured = tuple(quantised(a, device["quantum"]) for a in x)
        forces.append(tick({**fixed, "position": measured})["force"])
        out.append({"position": x, "velocity": v, "force": forces[-1]})
        late = k - device["delay"]
        f = vec.add(device["hand_force"], forces[late] if late >= 0 else ZERO)
        x, v = zip(*(moved(device, *axis, dt) for axis in zip(x, v, f)))
    return table.collect(out)
