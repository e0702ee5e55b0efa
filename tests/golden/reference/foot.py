# SPDX-License-Identifier: MIT
"""The place of a triangle mesh under a tool, and what its nodes say there.

The weights n_i of a place are those of Clough & Tocher 1965 with gradient 0 at the
nodes and slope 0 across the edges. Between nodes that are not level, the body is
rounded off: see place(). The foot of a tool at p is where p - place is along u^z.
"""


import vec

GENTLE, NARROW = 0.2, 0.4
STEP = 1e-6


def corners(surface, triangle):
    return [surface["nodes"][i] for i in surface["triangles"][triangle]]


def normal(at):
    return vec.cross(vec.sub(at[1], at[0]), vec.sub(at[2], at[0]))


def neighbour(surface, triangle, corner):
    """The triangle beyond the edge opposite a corner, or None at the rim."""
    ends = set(surface["triangles"][triangle]) - {surface["triangles"][triangle][corner]}
    for other, nodes in enumerate(surface["triangles"]):
        if other != triangle and ends <= set(nodes):
            return other
    return None


def de_casteljau(net, l):
    """The value of a cubic with ordinates net[i, j, k], i + j + k = 3."""
    for order in (2, 1, 0):
        net = {(i, j, order - i - j): l[0] * net[i + 1, j, order - i - j]
               + l[1] * net[i, j + 1, order - i - j] + l[2] * net[i, j, order + 1 - i - j]
               for i in range(order + 1) for j in range(order + 1 - i)}
    return net[0, 0, 0]


def weights(surface, triangle, l):
    """The smooth weights of the corners, from the barycentric ones."""
    at = corners(surface, triangle)
    centre = vec.scale(1.0 / 3.0, vec.add(vec.add(at[0], at[1]), at[2]))
    out = []
    for own in range(3):
        f = [float(i == own) for i in range(3)]
        beside = []   # ordinate 111, by the corner opposite the edge
        for i in range(3):
            a, b = (i + 1) % 3, (i + 2) % 3
            edge = vec.sub(at[b], at[a])
            t = vec.dot(edge, vec.sub(centre, at[a])) / vec.dot(edge, edge)
            t = min(max(t, 0.0), 1.0)
            beside.append((1.0 - t) * f[a] + t * f[b])
        inner = [(f[i] + beside[(i + 1) % 3] + beside[(i + 2) % 3]) / 3.0 for i in range(3)]
        i = min(range(3), key=lambda k: l[k])
        a, b = (i + 1) % 3, (i + 2) % 3
        net = {(3, 0, 0): f[a], (2, 1, 0): f[a], (1, 2, 0): f[b], (0, 3, 0): f[b],
               (2, 0, 1): f[a], (0, 2, 1): f[b], (1, 1, 1): beside[i],
               (1, 0, 2): inner[a], (0, 1, 2): inner[b], (0, 0, 3): sum(inner) / 3.0}
        out.append(de_casteljau(net, (l[a] - l[i], l[b] - l[i], 3.0 * l[i])))
    return out


def frame(surface, triangle, n):
    """Eq. (5): weighted, z made a unit vector, x at right angles to it, y = z x x."""
    given = [surface["frames"][i] for i in surface["triangles"][triangle]]
    z = vec.unit(vec.combine(n, [f[2] for f in given]))
    x = vec.unit(vec.across(z, vec.combine(n, [f[0] for f in given])))
    return x, vec.cross(z, x), z


def away(start, edge, point):
    return vec.across(vec.unit(edge), vec.sub(point, start))


def roundings(surface, triangle):
    """By corner: how far the body rises beside the opposite edge, and over what width."""
    at, out = corners(surface, triangle), []
    for i in range(3):
        first, second = at[(i + 1) % 3], at[(i + 2) % 3]
        edge, other = vec.sub(second, first), neighbour(surface, triangle, i)
        if other is None:
            out.append(None)
            continue
        mine = away(first, edge, at[i])
        theirs = next(q for q in corners(surface, other) if q not in (first, second))
        total = vec.add(vec.unit(mine), vec.unit(away(first, edge, theirs)))
        slope = 0.5 * vec.norm(total)
        width = min(max(GENTLE / max(slope, GENTLE), NARROW), 1.0)
        rise = vec.scale(-0.5 * vec.norm(mine), total)
        out.append((rise, width) if slope > 5e-10 else None)
    return out


def place(surface, triangle, l):
    """The point of the rounded body: on the edges, that of the mesh; beside an edge, it
    goes on in the direction between both triangles."""
    point = vec.combine(l, corners(surface, triangle))
    near = [(l[1] * l[2]) ** 2, (l[2] * l[0]) ** 2, (l[0] * l[1]) ** 2]
    if sum(near) <= 0.0:
        return point
    for share, x, rounding in zip(near, l, surface["roundings"][triangle]):
        if rounding and x < rounding[1]:
            part = share / sum(near) * x * (1.0 - x / rounding[1]) ** 2
            point = vec.add(point, vec.scale(part, rounding[0]))
    return point


def depth(surface, triangle, l, z, p):
    """Depth below the rounded body, which fades out towards the triangle."""
    at, there = corners(surface, triangle), place(surface, triangle, l)
    deep = vec.dot(vec.sub(p, there), z)
    n, point = normal(at), vec.combine(l, at)
    facing = vec.dot(n, z)
    if there == point or facing >= 0.0:
        return deep
    w = vec.dot(n, vec.sub(p, point)) / facing
    b = deep - w
    return w + b * w * w / (w * w + 4.0 * b * b)


def off(surface, triangle, l, p):
    x, y, _ = frame(surface, triangle, weights(surface, triangle, l))
    aside = vec.sub(p, place(surface, triangle, l))
    return vec.dot(aside, x), vec.dot(aside, y)


def moved(l, k, change):
    out = list(l)
    out[k] += change
    out[0] -= change
    return out


def across(surface, triangle, l, corner):
    other = neighbour(surface, triangle, corner)
    of = dict(zip(surface["triangles"][triangle], l))
    return other, [of[i] if i in of and i != surface["triangles"][triangle][corner] else 0.0
                   for i in surface["triangles"][other]]


def find(surface, triangle, l, p):
    """The foot of p, by Newton's method from a place near it. None if it is past the rim."""
    l = list(l)
    for _ in range(200):
        here = off(surface, triangle, l, p)
        (a, c), (b, d) = (
            [(more - less) / (2.0 * STEP) for more, less in
             zip(off(surface, triangle, moved(l, k, STEP), p),
                 off(surface, triangle, moved(l, k, -STEP), p))] for k in (1, 2))
        det = a * d - b * c
        second, third = -(d * here[0] - b * here[1]) / det, -(a * here[1] - c * here[0]) / det
        step = (-second - third, second, third)
        if sum(map(abs, step)) <= 1e-13:
            return triangle, l
        share, edge = 1.0, None
        for k in range(3):
            if l[k] + share * step[k] < 0.0:
                share, edge = max(0.0, l[k] / -step[k]), k
        at_once = share <= 1e-12
        l = [max(0.0, x + share * s) for x, s in zip(l, step)]
        if edge is not None:
            l[edge] = 0.0
            if neighbour(surface, triangle, edge) is None:
                if at_once:
                    return None
                continue
            triangle, l = across(surface, triangle, l, edge)
    return None


def prepared(surface):
    surface["roundings"] = [roundings(surface, t) for t in range(len(surface["triangles"]))]
    return surface
