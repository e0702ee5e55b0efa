# SPDX-License-Identifier: MIT
"""Friction on a grain, and friction of a soft tip.

On a grain, the stretches at which the contact slides lie on two half ellipses.
A slip moves the stretch to the nearest point of this curve, which is found here
by bisection over the direction of its normal. The other adhesion functions yield
by dd = dp - Z h (dp) A^-1 d, with Z held over a step.

A soft tip is a stack of bristles of friction.py.
"""

import math

import friction
import table
import vec

DEFAULTS = {"position": friction.ZERO, "normal": (0.0, 0.0, 1.0), "grain": (1.0, 0.0, 0.0), "normal_force": 1.0, "mu_along": 0.3, "mu_against": 0.6,
            "mu_across": 0.4, "d_max": 1e-4, "static_ratio": 1.0,
            "break_away": 0.7, "stiffness": 0.0, "adhesion": "stick",
            "reference_load": 1.0}
COEFFICIENTS = ("mu_along", "mu_against", "mu_across")
NUMBERS = ("position", "normal", "grain", "normal_force", *COEFFICIENTS,
           "d_max", "static_ratio", "break_away", "stiffness", "reference_load")


def axes(reach, x):
    """The half axes on the side of x."""
    return reach[1] if x < 0.0 else reach[0], reach[2]


def share(reach, d):
    a, b = axes(reach, d[0])
    return math.hypot(d[0] / a, d[1] / b)


def normal_at(reach, n):
    """The point of the bound with this outer normal."""
    a, b = axes(reach, n[0])
    h = math.hypot(a * n[0], b * n[1])
    return a * a * n[0] / h, b * b * n[1] / h


def nearest(reach, d):
    """The normal of the bound at its point nearest to d, which lies outside."""
    signs = math.copysign(1.0, d[0]), math.copysign(1.0, d[1])
    low, high = 0.0, 0.5 * math.pi
    for _ in range(80):
        middle = 0.5 * (low + high)
        n = signs[0] * math.cos(middle), signs[1] * math.sin(middle)
        at = normal_at(reach, n)
        way = d[0] - at[0], d[1] - at[1]
        turns = signs[0] * signs[1] * (n[0] * way[1] - n[1] * way[0])
        low, high = (middle, high) if turns > 0.0 else (low, middle)
    angle = 0.5 * (low + high)
    return signs[0] * math.cos(angle), signs[1] * math.sin(angle)


def stick(reach, ratio, d):
    """The stretch that is left of d, and whether it has slipped."""
    if share(reach, d) <= ratio * (1.0 + friction.EPS_SLIP):
        return d, False
    n = nearest(reach, d)
    least = normal_at(reach, n)
    rest = 0.0
    if ratio > 1.0 + friction.EPS_SLIP:
        tooth, step = 0.0, sum(reach) * ratio
        while step > 0.0 and tooth + step != tooth:
            there = least[0] + (tooth + step) * n[0], least[1] + (tooth + step) * n[1]
            if share(reach, there) <= ratio:
                tooth += step
            step *= 0.5
        way = (d[0] - least[0]) * n[0] + (d[1] - least[1]) * n[1]
        rest = math.fmod(max(0.0, way - tooth), tooth)
    return (least[0] + rest * n[0], least[1] + rest * n[1]), True


def pace(now, s):
    """The adhesion function, over the stretch divided by the bound."""
    return friction.zeta({**now, "d_max": 1.0}, s)


def cut(now, reach, d):
    if now["adhesion"] == "stick":
        return stick(reach, now["static_ratio"], d)
    z = pace(now, share(reach, d))
    if z * share(reach, d) <= 1.0 + friction.EPS_SLIP:
        return d, False
    larger = [a / z for a in reach]
    return normal_at(larger, nearest(larger, d)), True


def stretch(now, reach, d, dp):
    pulled = d[0] + dp[0], d[1] + dp[1]
    if now["adhesion"] == "stick":
        return stick(reach, now["static_ratio"], pulled)
    a, b = axes(reach, dp[0])
    travel = pace(now, share(reach, pulled)) * math.hypot(a * dp[0], b * dp[1])
    if travel == 0.0:
        return pulled, False
    after = []
    for half, d_, dp_ in zip(axes(reach, pulled[0]), d, dp):
        x = travel / half ** 2
        after.append(d_ * math.exp(-x) - dp_ * math.expm1(-x) / x)
    return cut(now, reach, tuple(after))[0], True


def steps(params, feed):
    stored, last = {**DEFAULTS, **params}, None
    for k in range(table.rows(feed)):
        now = table.row(DEFAULTS, params, feed, k)
        if not vec.finite(*(now[name] for name in NUMBERS)):
            last = None
            yield friction.result(0.0, friction.ZERO, -1)
            continue
        if now["normal_force"] <= 0.0:
            last = None
            yield friction.result(0.0, friction.ZERO, 0)
            continue
        p, n = now["position"], vec.unit(now["normal"])
        sigma = now["stiffness"] or (max(stored[m] for m in COEFFICIENTS)
                                     * now["reference_load"] / stored["d_max"])
        p0, home, d, sigma = last or (p, n, friction.ZERO, sigma)
        if vec.dot(n, home) < 0.0:
            n = vec.scale(-1.0, n)
        along = vec.unit(friction.turned(vec.across(n, now["grain"]), n, home))
        across = vec.cross(home, along)
        reach = [now[m] * now["normal_force"] / sigma * now["d_max"] / stored["d_max"]
                 for m in COEFFICIENTS]
        dp = friction.turned(vec.across(n, vec.sub(p, p0)), n, home)
        flat = vec.dot(d, along), vec.dot(d, across)
        flat, lets_go = cut(now, reach, flat)
        flat, slips = stretch(now, reach, flat, (vec.dot(dp, along), vec.dot(dp, across)))
        d = vec.combine(flat, (along, across))
        there = friction.turned(d, home, n)
        if vec.dot(n, home) < friction.HOMING:
            home, d = n, there
        last = p, home, d, sigma
        yield friction.result(sigma, there, 2 if slips or lets_go else 1)


def run(params, feed):
    return table.collect(steps(params, feed))


# The polygon with six sides that is nearest to Mindlin's curve: where it bends, and by how much its slope falls there.
BENDS = (0.193218312512252, 0.40525215979453, 0.599775761491485,
         0.772879501918572, 0.917231877436259, 1.0)
FALLS = (0.183599604136652, 0.198179602274617, 0.218900517988660,
         0.252523482000644, 0.327639333644924)


def soft_tip(params, feed):
    """Friction of a soft tip as six bristles of friction.py."""
    now = {"mu": 0.5, "s_max": 1e-3, "stiffness": 0.0, "reference_load": 1.0, **params}
    sigma = now["stiffness"] or now["mu"] * now["reference_load"] / now["s_max"]
    falls = (*FALLS, 1.0 - sum(a * b for a, b in zip(FALLS, BENDS)))
    runs = []
    for bend, fall in zip(BENDS, falls):
        own = {**feed, "mu": [bend * fall * mu for mu in feed["mu"]]} if "mu" in feed else feed
        runs.append(friction.run({"mu": bend * fall * now["mu"], "d_max": 1.0,
                                  "stiffness": fall * sigma}, own))
    rows = range(table.rows(feed))
    ones = [1.0] * len(runs)
    force = [vec.combine(ones, [r["force"][k] for r in runs]) for k in rows]
    return {"force": force,
            "deflection": [vec.scale(-1.0 / sigma, f) for f in force],
            "stored_energy": [sum(r["stored_energy"][k] for r in runs) for k in rows],
            "state": [min(r["state"][k] for r in runs) for k in rows]}
