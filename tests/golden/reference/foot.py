# SPDX-License-Identifier: MIT
"""The smooth body through the nodes of a mesh, and the foot of a tool on it.

Each node has a polynomial of degree 4 over its tangent plane, fitted to the nodes of
three rings. g is the mean of the heights over these polynomials, weighted with
Wendland's functions. The body is where g = 0, and the foot is its nearest point.
"""

import itertools
import math

import vec

RINGS, REACH, DAMPING = 3, 1.6, 0.01
POWERS = [(n - j, j) for n in range(1, 5) for j in range(n + 1)]
STEP = 1e-6


def corners(surface, triangle):
    return [surface["nodes"][i] for i in surface["triangles"][triangle]]


def normal(at):
    return vec.cross(vec.sub(at[1], at[0]), vec.sub(at[2], at[0]))


def solved(rows, right):
    """The solution of a square system, by elimination with the largest pivots."""
    rows, n = [list(r) + [b] for r, b in zip(rows, right)], len(rows)
    for i in range(n):
        pivot = max(range(i, n), key=lambda k: abs(rows[k][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for k in range(i + 1, n):
            f = rows[k][i] / rows[i][i]
            if f:
                rows[k] = [a - f * b for a, b in zip(rows[k], rows[i])]
    out = [0.0] * n
    for i in reversed(range(n)):
        done = math.fsum(rows[i][k] * out[k] for k in range(i + 1, n))
        out[i] = (rows[i][n] - done) / rows[i][i]
    return out


def neighbours(surface):
    out = [set() for _ in surface["nodes"]]
    for t in surface["triangles"]:
        for a, b in itertools.permutations(t, 2):
            out[a].add(b)
    return out


def term(power, x, y):
    i, j = power
    return math.sqrt(math.comb(i + j, i)) * x ** i * y ** j


def fitted(surface, beside, node):
    """Axes, radius and coefficients of the polynomial of a node."""
    nodes, at = surface["nodes"], surface["nodes"][node]
    z = (0.0, 0.0, 0.0)
    for t in surface["triangles"]:
        if node in t:
            k = t.index(node)
            a, b = (vec.sub(nodes[t[(k + i) % 3]], at) for i in (1, 2))
            n = vec.cross(a, b)
            z = vec.add(z, vec.scale(math.atan2(vec.norm(n), vec.dot(a, b)), vec.unit(n)))
    z = vec.unit(z)
    x = vec.unit(vec.across(z, min(((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
                                   key=lambda e: abs(vec.dot(e, z)))))
    y = vec.cross(z, x)
    edges = [vec.norm(vec.sub(nodes[i], at)) for i in sorted(beside[node])]
    mean = math.fsum(edges) / len(edges)
    near, front = {node}, {node}
    for _ in range(RINGS):
        front = {j for i in front for j in beside[i]} - near
        near |= front
    square = [[DAMPING ** 2 * (i == j) for j in range(len(POWERS))]
              for i in range(len(POWERS))]
    right = [0.0] * len(POWERS)
    for i in sorted(near - {node}):
        d = vec.sub(nodes[i], at)
        weight = math.exp(-vec.dot(d, d) / mean ** 2)
        row = [term(p, vec.dot(d, x) / mean, vec.dot(d, y) / mean) for p in POWERS]
        for j, a in enumerate(row):
            right[j] += weight * a * vec.dot(d, z)
            for k, b in enumerate(row):
                square[j][k] += weight * a * b
    return {"at": at, "axes": (x, y, z), "radius": REACH * max(edges), "mean": mean,
            "c": solved(square, right), "shift": 0.0}


def wendland(fit, d):
    """The weight of a node at a vector from it, and the gradient of the weight."""
    r = vec.norm(d) / fit["radius"]
    if r >= 1.0:
        return 0.0, (0.0, 0.0, 0.0)
    return ((1.0 - r) ** 4 * (4.0 * r + 1.0),
            vec.scale(-20.0 * (1.0 - r) ** 3 / fit["radius"] ** 2, d))


def height(fit, d):
    """The height over a polynomial, and its gradient."""
    mean, axes = fit["mean"], fit["axes"]
    x, y, z = (vec.dot(d, axis) for axis in axes)
    u, v = x / mean, y / mean
    value, by_x, by_y = fit["shift"], 0.0, 0.0
    for c, (i, j) in zip(fit["c"], POWERS):
        c *= math.sqrt(math.comb(i + j, i))
        value += c * u ** i * v ** j
        by_x += c * i * u ** max(i - 1, 0) * v ** j / mean
        by_y += c * j * u ** i * v ** max(j - 1, 0) / mean
    return z - value, vec.sub(axes[2], vec.add(vec.scale(by_x, axes[0]),
                                               vec.scale(by_y, axes[1])))


def shares(surface, x):
    """n_i: by node, the weights that mix what the nodes say."""
    weights = [wendland(fit, vec.sub(x, fit["at"]))[0] for fit in surface["fits"]]
    total = math.fsum(weights)
    return [w / total for w in weights]


def jet(surface, x):
    """g, and its gradient."""
    total, sum_, slope = 0.0, 0.0, (0.0, 0.0, 0.0)
    falls = (0.0, 0.0, 0.0)
    for fit in surface["fits"]:
        d = vec.sub(x, fit["at"])
        w, fall = wendland(fit, d)
        if w > 0.0:
            h, rise = height(fit, d)
            total, sum_ = total + w, sum_ + w * h
            slope = vec.add(slope, vec.add(vec.scale(w, rise), vec.scale(h, fall)))
            falls = vec.add(falls, fall)
    g = sum_ / total
    return g, vec.scale(1.0 / total, vec.sub(slope, vec.scale(g, falls)))


def bend(surface, x):
    """The second derivatives of g, by differences of its gradient."""
    out = []
    for i in range(3):
        more, less = (jet(surface, tuple(a + h * (k == i) for k, a in enumerate(x)))[1]
                      for h in (STEP, -STEP))
        out.append(vec.scale(0.5 / STEP, vec.sub(more, less)))
    return out


def find(surface, x, p, tangents=None):
    """The foot of p near x: x - p + l grad g = 0, g = 0. Newton's method, with the second
    derivatives of the first step, or those given: (the foot, the second derivatives)."""
    g, n = jet(surface, x)
    pull = vec.dot(vec.sub(p, x), n) / vec.dot(n, n)
    for step in range(60):
        if tangents is None or (step > 0 and step % 6 == 0):
            tangents = bend(surface, x)
        rows = [[(i == j) + pull * tangents[i][j] for j in range(3)] + [n[i]]
                for i in range(3)] + [list(n) + [0.0]]
        rest = vec.add(vec.sub(x, p), vec.scale(pull, n))
        *move, change = solved(rows, [-a for a in rest] + [-g])
        x, pull = vec.add(x, tuple(move)), pull + change
        g, n = jet(surface, x)
        if vec.norm(move) < 1e-15:
            break
    return x, tangents


def past_rim(surface, x):
    """Whether x is beyond all triangles, seen along their normals."""
    for index in range(len(surface["triangles"])):
        at = corners(surface, index)
        n = normal(at)
        inside = [vec.dot(vec.cross(vec.sub(at[(i + 2) % 3], at[(i + 1) % 3]),
                                    vec.sub(x, at[(i + 1) % 3])), n) for i in range(3)]
        if min(inside) >= -1e-9 * vec.dot(n, n):
            return False
    return True


def frame(surface, x):
    """u^z into the body, u^x mixed from the nodes and put at right angles to it, u^y = u^z x u^x."""
    z = vec.scale(-1.0, vec.unit(jet(surface, x)[1]))
    u = vec.unit(vec.across(z, vec.combine(shares(surface, x),
                                           [f[0] for f in surface["frames"]])))
    return u, vec.cross(z, u), z


def depth(surface, x, p):
    away = vec.sub(p, x)
    return -math.copysign(vec.norm(away), vec.dot(away, jet(surface, x)[1]))


def prepared(surface):
    beside = neighbours(surface)
    surface["fits"] = [fitted(surface, beside, i) for i in range(len(surface["nodes"]))]
    nodes = surface["nodes"]
    off = [jet(surface, x)[0] for x in nodes]
    for fit, shift in zip(surface["fits"], solved([shares(surface, x) for x in nodes], off)):
        fit["shift"] = shift
    return surface
