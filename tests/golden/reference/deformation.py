# SPDX-License-Identifier: MIT
"""Elastic deformation of a surface with contact: Hayward 2007, eq. (5) to (9), with two points.

The foot r is the place under the tool: (p - r) . u^x = (p - r) . u^y = 0. The depth is
w = (p - r) . u^z, the sideways stretch from the anchor c is s^nu = (r - c) . u^nu, and
U = sum n_i (F_i^z(w) + F_i^x(s^x) + F_i^y(s^y)). The force is -dU/dp with c fixed, here by
differences: the foot is found again at each displaced p. c follows where |s| would pass
mu_c w; without friction it is r. A touch begins where the way of the tool crosses the
mesh from outside, and ends where w is not above 0, or where the foot passes the rim.
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


def gradients(surface, triangle):
    """grad n_i of a triangle: from an edge to its corner, over height squared."""
    at = [surface["nodes"][i] for i in surface["triangles"][triangle]]
    out = []
    for i in range(3):
        corner, b, c = at[i], at[(i + 1) % 3], at[(i + 2) % 3]
        height = vec.across(vec.unit(vec.sub(c, b)), vec.sub(corner, b))
        out.append(vec.scale(1.0 / vec.dot(height, height), height))
    return out


def apart(p, state):
    return {"force": ZERO, "resistance": 0.0, "depth": 0.0, "contact": p,
            "triangle": -1, "stored_energy": 0.0, "state": state,
            "normal": ZERO, "edge": False, "shared": False}


def area_normal(surface, corners):
    a, b, c = (surface["nodes"][i] for i in corners)
    return vec.cross(vec.sub(b, a), vec.sub(c, a))


def entered(surface, start, end):
    """The first triangle that the line from start to end crosses inwards, and where, or None."""
    way, found = vec.sub(end, start), (1.0 + ON_EDGE, None)
    for index, corners in enumerate(surface["triangles"]):
        normal, at = area_normal(surface, corners), [surface["nodes"][i] for i in corners]
        fall = -vec.dot(normal, way)
        if fall <= 0.0:
            continue
        share = vec.dot(normal, vec.sub(start, at[0])) / fall
        if not -ON_EDGE <= share < found[0]:
            continue
        there = vec.add(start, vec.scale(share, way))
        inside = [vec.dot(g, vec.sub(there, at[(i + 1) % 3]))
                  for i, g in enumerate(gradients(surface, index))]
        if min(inside) >= -ON_EDGE:
            found = share, index
    return None if found[1] is None else (found[1], found[0])


def felt(surface, contact, p):
    """Forces along the axes, their stored energy, and what they come from."""
    triangle, l = contact["foot"]
    n = foot.weights(surface, triangle, l)
    axes = foot.frame(surface, triangle, n)
    there = foot.place(surface, triangle, l)
    anchor = there if contact["anchor"] is None else contact["anchor"]
    pulled = vec.sub(there, anchor)
    d = (vec.dot(pulled, axes[0]), vec.dot(pulled, axes[1]),
         foot.depth(surface, triangle, l, axes[2], p))
    forces, stored = [0.0, 0.0, 0.0], 0.0
    for tool, share in contact["tools"]:
        for weight, node in zip(n, surface["triangles"][triangle]):
            for axis, law in enumerate(surface["curves"][tool][node]):
                forces[axis] += share * weight * laws.odd(law, d[axis])
                stored += share * weight * laws.energy(law, abs(d[axis]))
    return {"d": d, "forces": forces, "stored": stored, "axes": axes, "n": n,
            "place": there, "height": vec.dot(pulled, axes[2])}


def follow(surface, contact, p):
    found = foot.find(surface, *contact["foot"], p)
    return None if found is None else dict(contact, foot=found)


def force(surface, contact, p):
    """-dU/dp with the anchor fixed, by differences of fourth order."""
    def stored(axis, change):
        q = tuple(x + change * (i == axis) for i, x in enumerate(p))
        there = follow(surface, contact, q) or contact
        return felt(surface, there, q)["stored"]

    return tuple(-(8.0 * (stored(i, APART) - stored(i, -APART))
                   - (stored(i, 2.0 * APART) - stored(i, -2.0 * APART))) / (12.0 * APART)
                 for i in range(3))


def bound(surface, contact, now):
    """mu_c w, with mu_c = sum n_i mu_i."""
    nodes, w = surface["triangles"][contact["foot"][0]], now["d"][2]
    mus = [surface["mu"][i] for i in nodes]
    mus = [laws.force(mu, w) if isinstance(mu, dict) else mu for mu in mus]
    return w * sum(n * mu for n, mu in zip(now["n"], mus))


def slipped(surface, contact, now):
    """The contact with its anchor within the bound, and whether it slips."""
    most, reach = bound(surface, contact, now), math.hypot(*now["d"][:2])
    if contact["anchor"] is None or reach <= most * (1.0 + EPS_SLIP):
        return contact, contact["anchor"] is None
    share = most / reach
    d = (share * now["d"][0], share * now["d"][1], share * now["height"])
    return dict(contact, anchor=vec.sub(now["place"], vec.combine(d, now["axes"]))), True


def on_edge(surface, contact, p):
    """Whether the foot is so near an edge that the differences reach across it."""
    triangle, l = contact["foot"]
    at = foot.corners(surface, triangle)
    size = vec.norm(foot.normal(at)) / max(vec.norm(vec.sub(a, b)) for a in at for b in at)
    return min(l) * size < 10.0 * APART


def pressed(surface, contact, p, slips):
    now = felt(surface, contact, p)
    point = now["place"] if contact["anchor"] is None else contact["anchor"]
    near = projections(surface, point)
    return {"force": force(surface, contact, p), "resistance": now["forces"][2],
            "depth": now["d"][2], "contact": near[0][3], "triangle": near[0][1],
            "stored_energy": now["stored"], "state": 2 if slips else 1,
            "normal": vec.scale(-1.0, now["axes"][2]),
            "edge": on_edge(surface, contact, p),
            "shared": len(near) > 1 and near[1][0] < near[0][0] + ON_EDGE}


def begun(surface, latched, found, p, frictionless):
    """A contact at the foot of p, without stretch."""
    contact = follow(surface, {"foot": found, "anchor": None, "tools": latched}, p)
    if contact is None or frictionless:
        return contact
    return dict(contact, anchor=foot.place(surface, *contact["foot"]))


def touch(surface, tool, last, p, frictionless):
    """The contact that begins on the way from the last sample to p, if any."""
    crossed = entered(surface, last, p)
    if crossed is None:
        return None
    triangle, share = crossed
    at = vec.add(last, vec.scale(share, vec.sub(p, last)))
    spot = triangle, nearest_weights(*foot.corners(surface, triangle), at)
    return begun(surface, tools(surface, tool), spot, at, frictionless)


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
                if now["d"][2] <= 0.0:
                    contact = None
        last = p
        yield apart(p, 0) if contact is None else pressed(surface, contact, p, slips)


def run(settings, params, feed):
    return table.collect(steps(settings, params, feed))
