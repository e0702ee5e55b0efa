# SPDX-License-Identifier: MIT
"""Elastic deformation of a surface with contact: Hayward 2007, eq. (5) to (9).

At contact onset c is the point of the mesh nearest to p. With d = p - c and
d^nu = d . u^nu, f^nu = sum n_i f_i^nu(d^nu), the force on the tool is
-sum f^nu u^nu; c follows where |d_t| would pass mu_c d^z, once a tick, so that
c may still move on the ticks after a slip, and only as far as the stored energy
does not rise. Without friction, on a flat body whose frames lean, c is always the
nearest point, and -sum grad n_i Phi_i is added. A tool is inside if its way from
the last sample crosses the surface, and belongs to the side that it came through.

The chapter does not treat the rim of a surface. Here a contact on the rim of an
open mesh ends once p is further beyond the rim, along the triangle, than above or
below it.
"""

import math

import laws
import table
import vec

EPS_SLIP = 1e-9
ON_EDGE = 1e-9
PAST_RIM = 1e-3
LEAST = 1.0 / 1024.0
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
    return {"nodes": nodes, "triangles": surface["triangles"],
            "frames": frames, "curves": curves, "mu": surface["mu"]}


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


def frame(surface, triangle, weights):
    """Eq. (5): weighted, z made a unit vector, x at right angles to it, y = z x x."""
    corners = [surface["frames"][i] for i in surface["triangles"][triangle]]
    z = vec.unit(vec.combine(weights, [f[2] for f in corners]))
    x = vec.unit(vec.across(z, vec.combine(weights, [f[0] for f in corners])))
    return x, vec.cross(z, x), z


def tools(surface, tool):
    """Eq. (8): the two nearest tools and their weights."""
    last = len(surface["curves"]) - 1
    tool = min(max(tool, 0.0), float(last))
    low = min(int(tool), max(last - 1, 0))
    share = tool - low
    return [(low, 1.0 - share)] + ([(low + 1, share)] if share > 0.0 else [])


def responses(surface, contact, d):
    """Forces f^nu at the contact, and the potential Phi_i of each corner."""
    corners = surface["triangles"][contact["triangle"]]
    forces, potentials = [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]
    for tool, share in contact["tools"]:
        for i, node in enumerate(corners):
            laws_of_node = surface["curves"][tool][node]
            for axis in range(3):
                value = laws.odd(laws_of_node[axis], d[axis])
                forces[axis] += share * contact["weights"][i] * value
                potentials[i] += share * laws.energy(laws_of_node[axis],
                                                     abs(d[axis]))
    return forces, potentials


def gradients(surface, triangle):
    """grad n_i of a triangle: from an edge to its corner, over height squared."""
    at = [surface["nodes"][i] for i in surface["triangles"][triangle]]
    out = []
    for i in range(3):
        corner, b, c = at[i], at[(i + 1) % 3], at[(i + 2) % 3]
        height = vec.across(vec.unit(vec.sub(c, b)), vec.sub(corner, b))
        out.append(vec.scale(1.0 / vec.dot(height, height), height))
    return out


def touch(surface, p, near, latched):
    """The contact at the nearest point in `near`, and the deflection in its frame."""
    _, triangle, weights, c = near
    axes = frame(surface, triangle, weights)
    contact = {"triangle": triangle, "weights": weights, "c": c, "axes": axes,
               "tools": latched}
    return contact, deflection(contact, p)


def deflection(contact, p):
    away = vec.sub(p, contact["c"])
    return tuple(vec.dot(away, u) for u in contact["axes"])


def bound(surface, contact, depth):
    """mu_c d^z, with mu_c = sum n_i mu_i."""
    corners = surface["triangles"][contact["triangle"]]
    mus = [surface["mu"][i] for i in corners]
    mus = [laws.force(mu, depth) if isinstance(mu, dict) else mu for mu in mus]
    return depth * sum(w * mu for w, mu in zip(contact["weights"], mus))


def apart(p, state):
    return {"force": ZERO, "resistance": 0.0, "depth": 0.0, "contact": p,
            "triangle": -1, "stored_energy": 0.0, "state": state,
            "normal": ZERO, "edge": False, "shared": False}


def pressed(surface, contact, d, state, frictionless):
    forces, potentials = responses(surface, contact, d)
    f = vec.scale(-1.0, vec.combine(forces, contact["axes"]))
    if frictionless:
        slope = vec.combine(potentials, gradients(surface, contact["triangle"]))
        f = vec.sub(f, slope)
    stored = sum(w * phi for w, phi in zip(contact["weights"], potentials))
    return {"force": f, "resistance": forces[2], "depth": d[2],
            "contact": contact["c"], "triangle": contact["triangle"],
            "stored_energy": stored, "state": state,
            "normal": vec.scale(-1.0, contact["axes"][2]),
            "edge": on_edge(surface, contact),
            "shared": shared(surface, contact)}


def stored(surface, contact, d):
    _, potentials = responses(surface, contact, d)
    return sum(w * phi for w, phi in zip(contact["weights"], potentials))


def downhill(surface, contact, d, p, step):
    """Moves c along a step while the stored energy does not rise. Last value: whether c moved."""
    c, start = contact["c"], stored(surface, contact, d)
    inward, here = contact["axes"][2], contact["triangle"]
    facing = [t for t, corners in enumerate(surface["triangles"])
              if t == here or vec.dot(area_normal(surface, corners), inward) < 0.0]

    def after(share):
        near = [n for n in projections(surface, vec.add(c, vec.scale(share, step)))
                if n[1] in facing]
        there = touch(surface, p, near[0], contact["tools"])
        return stored(surface, *there), there

    energy, there = after(1.0)
    if energy <= start:
        return *there, True
    best, there = after(LEAST)
    if not best <= start:
        return contact, d, False
    slope, share = (best - start) / LEAST, 0.5
    while share > LEAST:
        energy, farther = after(share)
        if energy <= best:
            best, there = energy, farther
            break
        share *= 0.5
    else:
        return *there, True
    bend = ((energy - start) / share - slope) / (share - LEAST)
    lowest = 0.5 * (LEAST - slope / bend) if bend > 0.0 else 0.0
    if LEAST < lowest < 1.0:
        energy, farther = after(lowest)
        if energy <= best:
            there = farther
    return *there, True


def slipped(surface, contact, d, p):
    """Contact and deflection within the bound, whether c moved, and whether the bound was exceeded."""
    most, reach = bound(surface, contact, d[2]), math.hypot(d[0], d[1])
    if reach <= most * (1.0 + EPS_SLIP):
        return contact, d, False, False
    across = vec.combine(d[:2], contact["axes"][:2])
    return *downhill(surface, contact, d, p, vec.scale(1.0 - most / reach, across)), True


def area_normal(surface, corners):
    a, b, c = (surface["nodes"][i] for i in corners)
    return vec.cross(vec.sub(b, a), vec.sub(c, a))


def entered(surface, start, end):
    """The first triangle that the line from start to end crosses inwards, or None."""
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
    return found[1]


def came_in(surface, contact, d, last, p):
    """Contact and deflection on the side by which the tool came in, and whether it came in."""
    if last is None or entered(surface, last[0], p) is None:
        return contact, d, False
    way = vec.sub(p, last[0])
    facing = [near for near in projections(surface, p)
              if vec.dot(area_normal(surface, surface["triangles"][near[1]]), way) < 0.0]
    there, e = touch(surface, p, facing[0], contact["tools"])
    if d[2] <= 0.0 and math.hypot(e[0], e[1]) > e[2]:
        return contact, d, True
    return there, e, True


def is_open(surface):
    edges = [frozenset((t[i], t[(i + 1) % 3])) for t in surface["triangles"] for i in range(3)]
    return any(edges.count(edge) == 1 for edge in edges)


def on_edge(surface, contact):
    """Whether c is on the rim of its triangle, where the gradient is not defined."""
    heights = (1.0 / vec.norm(g) for g in
               gradients(surface, contact["triangle"]))
    return any(w * h < ON_EDGE for w, h in zip(contact["weights"], heights))


def shared(surface, contact):
    """Whether c is so close to a second triangle that either one is correct."""
    near = projections(surface, contact["c"])
    return len(near) > 1 and near[1][0] < ON_EDGE


def beyond_rim(surface, contact, p):
    """Whether c is on the rim and p is past it: farther from c along the triangle's plane than above or below it."""
    c, away = contact["c"], vec.sub(p, contact["c"])
    here = surface["triangles"][contact["triangle"]]
    corner = [i for i, w in zip(here, contact["weights"]) if w == 1.0]
    triangles = [t for t in surface["triangles"] if corner[0] in t] if corner else [here]
    for t in triangles:
        for k in range(3):
            i, j = t[(k + 1) % 3], t[(k + 2) % 3]
            if sum(i in u and j in u for u in surface["triangles"]) > 1:
                continue
            a, b, third = (surface["nodes"][n] for n in (i, j, t[k]))
            along = vec.sub(b, a)
            if vec.norm(vec.cross(along, vec.sub(c, a))) > ON_EDGE * vec.dot(along, along):
                continue
            inward = vec.across(vec.unit(along), vec.sub(third, a))
            up = vec.unit(vec.cross(along, inward))
            if (vec.dot(inward, away) < 0.0
                    and vec.norm(vec.across(up, away)) > 0.7071 * vec.norm(away)):
                return True
    return False


def leaves(surface, contact, d, p, pulled, frictionless):
    """Whether the contact has left the surface over the rim on this tick."""
    if frictionless:
        return beyond_rim(surface, contact, p)
    held = math.hypot(d[0], d[1]) > bound(surface, contact, d[2]) * (1.0 + PAST_RIM)
    return pulled and held and beyond_rim(surface, contact, p)


def steps(settings, params, feed):
    surface = placed(settings)
    frictionless = params.get("friction", "bound") == "frictionless"
    has_rim = is_open(surface)
    contact, last, behind = None, None, False   # last: position, and depth at the nearest point
    for p, tool in zip(feed["position"], feed["tool"]):
        if not vec.finite(p, tool):
            contact, last, behind = None, None, False
            yield apart(ZERO, -1)
            continue
        pulled, slips = False, frictionless
        if contact is None:
            contact, d = touch(surface, p, projections(surface, p)[0],
                               tools(surface, tool))
            contact, d, came = came_in(surface, contact, d, None if behind else last, p)
            past_rim = has_rim and last is not None and last[1] <= 0.0 and not came
            if d[2] <= 0.0:
                behind = False
            elif past_rim or beyond_rim(surface, contact, p):
                behind = True
            if d[2] <= 0.0 or behind:
                contact, last = None, (p, d[2])
                yield apart(p, 0)
                continue
        elif frictionless:
            contact, d = touch(surface, p, projections(surface, p)[0],
                               contact["tools"])
        else:
            d = deflection(contact, p)
        if d[2] > 0.0 and not frictionless:
            contact, d, slips, pulled = slipped(surface, contact, d, p)
        if d[2] <= 0.0 or leaves(surface, contact, d, p, pulled, frictionless):
            _, inside = touch(surface, p, projections(surface, p)[0], contact["tools"])
            behind = inside[2] > (vec.norm(vec.sub(p, last[0])) if last else 0.0)
            contact, last = None, (p, inside[2])
            yield apart(p, 0)
            continue
        last = p, d[2]
        yield pressed(surface, contact, d, 2 if slips else 1, frictionless)


def run(settings, params, feed):
    return table.collect(steps(settings, params, feed))
