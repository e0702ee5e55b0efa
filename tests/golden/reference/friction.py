# SPDX-License-Identifier: MIT
"""Elasto-plastic friction of a point: Hayward 2007, eq. (1) to (4), Fig. 2.

dc = zeta(|d|) |dp| d, with d = p - c and f = -sigma d, sigma = mu f_n / d_max.
Adhesion "stick" follows eq. (3). The others follow eq. (4) with a factor that
is at most 1 ("euler"), or eq. (2) solved over each straight step
("exponential"): d = d0 e^(-z |dp|) + u (1 - e^(-z |dp|)) / z.

d is kept in the tangent plane of a normal `home`, and turned to that of n.
"""

import math

import laws
import table
import vec

EPS_SLIP = 1e-9
HOMING = 0.5  # cosine of the angle beyond which `home` follows the normal
ZERO = (0.0, 0.0, 0.0)
DEFAULTS = {"position": ZERO, "normal": (0.0, 0.0, 1.0), "normal_force": 1.0,
            "mu": 0.4, "d_max": 1e-4, "static_ratio": 1.0, "break_away": 0.7,
            "stiffness": 0.0, "adhesion": "stick",
            "integrator": "exponential", "load": "bound",
            "reference_load": 1.0, "adhesion_curve": None}
NUMBERS = ("position", "normal", "normal_force", "mu", "d_max",
           "static_ratio", "break_away", "stiffness", "reference_load")


def zeta(now, r):
    """The adhesion function of Fig. 2, in 1/m; r = |d|."""
    d_max = now["d_max"]
    d_stick, d_ba = now["static_ratio"] * d_max, now["break_away"] * d_max
    kind = now["adhesion"]
    if kind == "dahl":
        return 1.0 / d_max
    if kind == "ramp":
        return min(r / d_stick, 1.0) / d_max
    if kind == "curve":
        return laws.linear(now["adhesion_curve"], r / d_max) / d_max
    if r <= d_ba:
        return 0.0
    if r >= d_stick:
        return 1.0 / d_max
    middle, width = 0.5 * (d_stick + d_ba), d_stick - d_ba
    return 0.5 / d_max * (1.0 + math.sin(math.pi * (r - middle) / width))


def stiffness(now, stored, touching):
    """sigma; touching is sigma at the previous sample, None at the first touch."""
    if now["load"] != "bound":
        return now["stiffness"] or now["mu"] * now["normal_force"] / now["d_max"]
    if touching is not None:
        return touching
    return now["stiffness"] or stored["mu"] * now["reference_load"] / stored["d_max"]


def bound(now, stored, sigma):
    """The stretch at which the contact slides."""
    if now["load"] != "bound":
        return now["d_max"]
    return (now["mu"] * now["normal_force"] / sigma
            * now["d_max"] / stored["d_max"])


def slip(now, r):
    """What is left of a stretch r that exceeds d_stick. With stick-slip, it is the stretch that a slow hand would have at the same place."""
    d_max, d_stick = now["d_max"], now["static_ratio"] * now["d_max"]
    if now["static_ratio"] <= 1.0 + EPS_SLIP:
        return d_max
    return d_max + math.fmod(r - d_stick, d_stick - d_max)


def let_go(now, d):
    """The stretch, cut back if the bound has fallen below it, and whether it was."""
    if now["adhesion"] == "stick" or now["integrator"] == "euler":
        return d, False
    excess = zeta(now, vec.norm(d)) * vec.norm(d)
    if excess > 1.0 + EPS_SLIP:
        return vec.scale(1.0 / excess, d), True
    return d, False


def stretch(now, d0, dp):
    """The new deflection, and whether the contact point has moved."""
    d = vec.add(d0, dp)
    r, step = vec.norm(d), vec.norm(dp)
    if now["adhesion"] == "stick":
        slips = r > now["static_ratio"] * now["d_max"] * (1.0 + EPS_SLIP)
        return (vec.scale(slip(now, r) / r, d) if slips else d), slips
    z = zeta(now, r)
    if now["integrator"] == "euler":
        if z * r > 1.0 + EPS_SLIP:
            return vec.scale(now["d_max"] / r, d), True
        return vec.scale(1.0 - min(1.0, step * z), d), step * z > 0.0
    if step == 0.0:
        return d0, False
    reach = -math.expm1(-z * step) / z if z > 0.0 else step
    return vec.add(vec.scale(math.exp(-z * step), d0),
                   vec.scale(reach / step, dp)), step * z > 0.0


def turned(v, a, b):
    """v in the plane with unit normal a, turned with this plane by the smallest
    angle into the plane with unit normal b."""
    axis = vec.cross(a, b)
    if vec.norm(axis) == 0.0:
        return v
    angle = math.atan2(vec.norm(axis), vec.dot(a, b))
    return vec.times(vec.rotation(vec.scale(angle / vec.norm(axis), axis)), v)


def result(sigma, d, state):
    return {"force": vec.scale(-sigma, d), "deflection": d,
            "stored_energy": 0.5 * sigma * vec.dot(d, d), "state": state}


def steps(params, feed):
    last, stored = None, {**DEFAULTS, **params}
    for k in range(table.rows(feed)):
        now = table.row(DEFAULTS, params, feed, k)
        if not vec.finite(*(now[name] for name in NUMBERS)):
            last = None
            yield result(0.0, ZERO, -1)
            continue
        if now["normal_force"] <= 0.0:
            last = None
            yield result(0.0, ZERO, 0)
            continue
        p, n = now["position"], vec.unit(now["normal"])
        p0, home, d, sigma0, s0 = last or (p, n, ZERO, None, 0.0)
        if vec.dot(n, home) < 0.0:
            n = vec.scale(-1.0, n)
        sigma = stiffness(now, stored, sigma0)
        now["d_max"] = bound(now, stored, sigma)
        slips = lets_go = False
        if last:
            if now["load"] == "passive" and sigma > sigma0:
                d = vec.scale(sigma0 / sigma, d)
            if now["d_max"] < s0:
                d, lets_go = let_go(now, d)
            dp = vec.across(n, vec.sub(p, p0))
            d, slips = stretch(now, d, turned(dp, n, home))
        there = turned(d, home, n)
        if vec.dot(n, home) < HOMING:
            home, d = n, there
        last = p, home, d, sigma, now["d_max"]
        yield result(sigma, there, 2 if slips or lets_go else 1)


def run(params, feed):
    return table.collect(steps(params, feed))
