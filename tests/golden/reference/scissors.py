# SPDX-License-Identifier: MIT
"""Scissors that cut a plate: after Mahvash & Okamura 2005; Hayward 2007, section 3.

delta = h/2 - x tan(theta/2), U = k delta^2/2, T = k delta x/(2 cos^2(theta/2));
the crack front x grows where k delta tan(theta/2) would pass J_c h. The front
that an angle allows is largest at tan(theta/2) = 4 J_c/k. A jump over this
angle cuts like a slow motion.
"""

import math

import table
import vec

EPS_SLIP = 1e-9
DEFAULTS = {"thickness": 1e-3, "toughness": 2800.0, "stiffness": 1e6,
            "pivot_distance": 1.5e-3}


def peak(toughness, stiffness):
    """The angle that allows the longest crack."""
    return 2.0 * math.atan(4.0 * toughness / stiffness)


def steps(params, feed):
    """Latched parameters come from params; a feed contains only the angle."""
    now = {**DEFAULTS, **params}
    h, k, x = now["thickness"], now["stiffness"], now["pivot_distance"]
    cost, longest = now["toughness"] * h, peak(now["toughness"], k)
    before = None

    def result(torque, stored, state):
        return {"torque": torque, "crack_front": x, "stored_energy": stored,
                "dissipated_energy": cost * (x - now["pivot_distance"]),
                "state": state}

    for theta in feed["angle"]:
        if not vec.finite(theta):
            before = None
            yield result(0.0, 0.0, -1)
            continue
        if not 0.0 < theta < math.pi:
            before = None
            yield result(0.0, 0.0, 0)
            continue
        passes = before is not None and (before - longest) * (theta - longest) < 0.0
        before, start, delta = theta, x, 0.0
        for angle in ([longest] if passes else []) + [theta]:
            slope = math.tan(0.5 * angle)
            delta, critical = 0.5 * h - x * slope, cost / (k * slope)
            if delta > critical * (1.0 + EPS_SLIP):
                delta = critical
                x = (0.5 * h - delta) / slope
        if delta <= 0.0:
            yield result(0.0, 0.0, 4 if x > start else 0)
            continue
        yield result(0.5 * k * delta * x / math.cos(0.5 * theta) ** 2,
                     0.5 * k * delta ** 2, 4 if x > start else 3)


def run(params, feed):
    return table.collect(steps(params, feed))
