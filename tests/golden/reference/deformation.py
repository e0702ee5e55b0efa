# SPDX-License-Identifier: MIT
"""Elastic deformation of a surface with contact: Hayward 2007, eq. (5) to (9), with two points.

The foot r is the nearest point of the smooth body (foot.py), and w the distance below
it. The sideways stretch from the anchor c is s^nu = (r - c) . u^nu, and
U = sum n_i (F_i^z(w) + F_i^x(s^x) + F_i^y(s^y)). The force is -dU/dp with c fixed, here by
differences: the foot is found again at each displaced p. c follows where |s| would pass
mu_c w, and comes as deep as the tool; without friction it is r. A touch begins where the way of the tool crosses the
body from outside, and ends where w is not above 0, or where the foot passes the rim.
"""

import math

import foot
import laws
import table
import vec

EPS_SLIP = 1e-9
ON_EDGE = 1e-9
APART = 1e-7
ZERO = (0.0, 0.0, 0.0)


def placed(settings):
    """The surface in world coordinates, with its curves as [tool][node][axis]."""
    surface = settings["surface"]
    turn = vec.rotation(tuple(settings.get("rotation", ZERO)))
    origin = tuple(settings.get("origin", ZERO))
    size = settings.get("scale", 1.0)
    nodes = [vec.add(origin, vec.times(turn, vec.scale(size, tuple(x))))
             for x in surface["nodes"]]
    frames = [[vec.times(turn, tuple(u)) for u in f] for f in surface["frames"]]
    curves = [tool if isinstance(tool[0], list) else [tool] * len(nodes)
              for tool in surface["curves"]]
    return foot.prepared({"nodes": nodes, "triangles": surface["triangles"],
                           "frames": frames, "curves": curves, "mu": surface["mu"]})


def nearest_weights(a, b, c, p):
    """Weights of the point of a triangle nearest to p (Ericson 2005, 5.1.5)."""
    ab, ac, ap = vec.sub(b, a), vec.sub(c, a), vec.sub(p, a)
    d1, d2 = vec.dot(ab, ap), vec.dot(ac, ap)
    if d1 <= 0.0 and d2 <= 0.0:
        return 1.0, 0.0, 0.0
    bp = vec.sub(p, b)
    d3, d4 = vec.dot(ab, bp), vec.dot(ac, bp)
    if d3 >= 0.0 and d4 <= d3:
        return 0.0, 1.0, 0.0
    vc = d1 * d4 - d3 * d2
    if vc <= 0.0 <= d1 and d3 <= 0.0:
        t = d1 / (d1 - d3)
        return 1.0 - t, t, 0.0
    cp = vec.sub(p, c)
    d5, d6 = vec.dot(ab, cp), vec.dot(ac, cp)
    if d6 >= 0.0 and d5 <= d6:
        return 0.0, 0.0, 1.0
    vb = d5 * d2 - d1 * d6
    if vb <= 0.0 <= d2 and d6 <= 0.0:
        t = d2 / (d2 - d6)
        return 1.0 - t, 0.0, t
    va = d3 * d6 - d5 * d4
    if va <= 0.0 and d4 - d3 >= 0.0 and d5 - d6 >= 0.0:
        t = (d4 - d3) / ((d4 - d3) + (d5 - d6))
        return 0.0, 1.0 - t, t
    total = va + vb + vc
    return va / total, vb / total, vc / total


def projections(surface, p):
    """Returns (distance, triangle, weights, point) for every triangle, the nearest first."""
    found = []
    for index, corners in enumerate(surface["triangles"]):
        at = [surface["nodes"][i] for i in corners]
        weights = nearest_weights(*at, p)
        point = vec.combine(weights, at)
        found.append((vec.norm(vec.sub(p, point)), index, weights, point))
    return sorted(found)


def tools(surface, tool):
    """Eq. (8): the two nearest tools and their weights."""
    last = len(surface["curves"]) - 1
    tool = min(max(tool, 0.0), float(last))
    low = min(int(tool), max(last - 1, 0))
    share = tool - low
    return [(low, 1.0 - share)] + ([(low + 1, share)] if share > 0.0 else [])


def apart(p, state):
    return {"force": ZERO, "resistance": 0.0, "depth": 0.0, "contact": p,
            "triangle": -1, "stored_energy": 0.0, "state": state,
            "normal": ZERO, "shared": False}


def felt(surface, contact, p):
    """Forces along the axes, their stored energy, and what they come from."""
    there = contact["foot"]
    n, axes = foot.shares(surface, there), foot.frame(surface, there)
    pulled = vec.sub(there, there if contact["anchor"] is None else contact["anchor"])
    d = (vec.dot(pulled, axes[0]), vec.dot(pulled, axes[1]), foot.depth(surface, there, p))
    forces, stored = [0.0, 0.0, 0.0], 0.0
    for tool, share in contact["tools"]:
        for node, weight in enumerate(n):
            for axis, law in enumerate(surface["curves"][tool][node] if weight > 0.0 else ()):
                forces[axis] += share * weight * laws.odd(law, d[axis])
                stored += share * weight * laws.energy(law, abs(d[axis]))
    return {"d": d, "forces": forces, "stored": stored, "axes": axes, "n": n,
            "place": there, "height": vec.dot(pulled, axes[2])}


def follow(surface, contact, p):
    found, _ = foot.find(surface, contact["foot"], p)
    return None if foot.past_rim(surface, found) else dict(contact, foot=found)


def force(surface, contact, p):
    """-dU/dp with the anchor fixed, by differences of fourth order."""
    _, tangents = foot.find(surface, contact["foot"], p)

    def stored(axis, change):
        q = tuple(x + change * (i == axis) for i, x in enumerate(p))
        there, _ = foot.find(surface, contact["foot"], q, tangents)
        return felt(surface, dict(contact, foot=there), q)["stored"]

    return tuple(-(8.0 * (stored(i, APART) - stored(i, -APART))
                   - (stored(i, 2.0 * APART) - stored(i, -2.0 * APART))) / (12.0 * APART)
                 for i in range(3))


def bound(surface, contact, now):
    """mu_c w, with mu_c = sum n_i mu_i."""
    w = now["d"][2]
    mus = [laws.force(mu, w) if isinstance(mu, dict) else mu for mu in surface["mu"]]
    return w * sum(n * mu for n, mu in zip(now["n"], mus))


def slipped(surface, contact, now):
    """The contact with its anchor within the bound, and whether it slips."""
    most, reach = bound(surface, contact, now), math.hypot(*now["d"][:2])
    if contact["anchor"] is None or reach <= most * (1.0 + EPS_SLIP):
        return contact, contact["anchor"] is None
    share, deep = most / reach, now["d"][2]
    height = share * (now["height"] + contact["deep"]) - deep
    d = (share * now["d"][0], share * now["d"][1], height)
    return dict(contact, anchor=vec.sub(now["place"], vec.combine(d, now["axes"]))), True


def pressed(surface, contact, p, slips):
    now = felt(surface, contact, p)
    point = now["place"] if contact["anchor"] is None else contact["anchor"]
    near = projections(surface, point)
    return {"force": force(surface, contact, p), "resistance": now["forces"][2],
            "depth": now["d"][2], "contact": near[0][3], "triangle": near[0][1],
            "stored_energy": now["stored"], "state": 2 if slips else 1,
            "normal": vec.scale(-1.0, now["axes"][2]),
            "shared": len(near) > 1 and near[1][0] < near[0][0] + ON_EDGE}


def begun(surface, latched, found, p, frictionless):
    """A contact at the foot of p, without stretch."""
    contact = follow(surface, {"foot": found, "anchor": None, "tools": latched}, p)
    if contact is None or frictionless:
        return contact
    return dict(contact, anchor=p, deep=foot.depth(surface, contact["foot"], p))


def nearest(surface, p):
    """The foot of p, also beyond the rim, and its depth."""
    found, _ = foot.find(surface, projections(surface, p)[0][3], p)
    return found, foot.depth(surface, found, p)


def touch(surface, tool, last, p, frictionless):
    """The contact that begins on the way from the last sample to p, if any."""
    found, deep = nearest(surface, p)
    if deep <= 0.0 or nearest(surface, last)[1] > 0.0:
        return None
    low, high, at = 0.0, 1.0, p
    for _ in range(60):
        middle = 0.5 * (low + high)
        at = vec.add(last, vec.scale(middle, vec.sub(p, last)))
        found, _ = foot.find(surface, found, at)
        if foot.depth(surface, found, at) > 0.0:
            high = middle
        else:
            low = middle
    return begun(surface, tools(surface, tool), found, at, frictionless)


def steps(settings, params, feed):
    surface = placed(settings)
    frictionless = params.get("friction", "bound") == "frictionless"
    contact, last, resumes = None, None, None
    for p, tool in zip(feed["position"], feed["tool"]):
        if not vec.finite(p, tool):
            if contact is not None:
                resumes = contact["foot"]
            contact, last = None, None
            yield apart(ZERO, -1)
            continue
        if contact is None and resumes is not None:
            contact = begun(surface, tools(surface, tool), resumes, p, frictionless)
            resumes = None
            if contact is not None and felt(surface, contact, p)["d"][2] <= 0.0:
                contact = None
            slips = frictionless
        else:
            if contact is None and last is not None:
                contact = touch(surface, tool, last, p, frictionless)
            slips = False
            if contact is not None:
                contact = follow(surface, contact, p)
            if contact is not None:
                now = felt(surface, contact, p)
                contact, slips = slipped(surface, contact, now)
                contact = dict(contact, deep=now["d"][2])
                if now["d"][2] <= 0.0:
                    contact = None
        last = p
        yield apart(p, 0) if contact is None else pressed(surface, contact, p, slips)


def run(settings, params, feed):
    return table.collect(steps(settings, params, feed))
