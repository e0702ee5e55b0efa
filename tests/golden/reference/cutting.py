# SPDX-License-Identifier: MIT
"""A blade that ruptures and cuts: Hayward 2007, section 3; Mahvash & Hayward 2001.

Virgin f = g0(delta); at f_rupture a crack c1 opens, G0(d_r) = G1(d_r - c1) + R c1
with R = J_c w; then f = g1(delta - c), and the crack grows where g1 would pass R.
"""

import laws
import table
import vec

EPS_SLIP = 1e-9
DEFAULTS = {"depth": 0.0, "width": 0.02, "toughness": 200.0,
            "rupture_force": 6.0, "thickness": 0.0,
            "law": {"power": [2000.0, 1.0]}, "cracked_law": None}


def first_crack(g0, g1, d_r, e_c, resistance):
    """Length of the crack at rupture, and the remaining energy."""
    given = laws.energy(g0, d_r)

    def missing(c):
        return laws.energy(g1, d_r - c) + resistance * c - given

    if missing(d_r) <= 0.0:
        return d_r, -missing(d_r)
    low, high = max(0.0, d_r - e_c), d_r
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if missing(middle) > 0.0 else (middle, high)
    return 0.5 * (low + high), 0.0


def steps(params, feed):
    """Latched parameters come from params; a feed contains only the depth."""
    now = {**DEFAULTS, **params}
    g0, g1 = now["law"], now["cracked_law"] or now["law"]
    resistance = now["toughness"] * now["width"]
    thickness = now["thickness"]
    e_c = laws.inverse(g1, resistance)
    d_r = laws.inverse(g0, now["rupture_force"])
    c1, excess = first_crack(g0, g1, d_r, e_c, resistance)

    crack, spent, broken, through = 0.0, 0.0, False, False

    def result(f, stored, state):
        return {"resistance": f, "crack": crack, "stored_energy": stored,
                "dissipated_energy": spent, "state": state}

    for delta in feed["depth"]:
        if not vec.finite(delta):
            yield result(0.0, 0.0, -1)
            continue
        if not broken and delta < d_r:
            yield result(laws.force(g0, delta), laws.energy(g0, delta),
                         1 if delta > 0.0 else 0)
            continue
        ruptures, cuts = not broken, False
        if ruptures:
            broken, crack, spent = True, c1, resistance * c1 + excess
            if thickness and c1 >= thickness:
                through, crack, spent = True, thickness, laws.energy(g0, d_r)
        if not through and delta - crack > e_c * (1.0 + EPS_SLIP):
            cuts, grown = True, delta - e_c
            if thickness and grown >= thickness:
                through, grown = True, thickness
                spent += laws.energy(g1, e_c)
            spent += resistance * (grown - crack)
            crack = grown
        e = 0.0 if through else delta - crack
        state = 5 if through else 4 if cuts else 3 if e > 0.0 else 0
        yield result(resistance if cuts and not through else laws.force(g1, e),
                     laws.energy(g1, e), 2 if ruptures else state)


def run(params, feed):
    return table.collect(steps(params, feed))
