# SPDX-License-Identifier: MIT
"""Small random surfaces, and strokes of a tool over them.

Bumps are low against the depth at which the foot of a tool would jump: the reference
follows no jumps.
"""

import draw
import vec

SIZE = 0.04


def grid(rng, bumpy):
    """A patch of triangles that face up, flat or a height field."""
    across, along = rng.randint(1, 3), rng.randint(1, 3)
    height = rng.uniform(0.0, 0.001) if bumpy else 0.0
    nodes = [(SIZE * i / across, SIZE * j / along, rng.uniform(-height, height))
             for j in range(along + 1) for i in range(across + 1)]
    triangles = []
    for j in range(along):
        for i in range(across):
            a = j * (across + 1) + i
            b, c, d = a + 1, a + across + 2, a + across + 1
            triangles += ([[a, b, c], [a, c, d]] if draw.chance(rng, 0.5)
                          else [[a, b, d], [b, c, d]])
    return nodes, triangles, [(0.0, 0.0, -1.0)] * len(nodes)


def tilted(rng, inward):
    """A frame (ux, uy, uz) about the inward normal, slightly tilted."""
    z = vec.unit(vec.add(inward, vec.scale(rng.uniform(0.0, 0.15),
                                           draw.direction(rng))))
    x = draw.direction(rng)
    while abs(vec.dot(x, z)) > 0.9:
        x = draw.direction(rng)
    x = vec.unit(vec.across(z, x))
    return [list(x), list(vec.cross(z, x)), list(z)]


def frames(rng, inward):
    """Frames that rotate little from node to node, apart from following the normal."""
    start = tilted(rng, inward[0])
    out = []
    for normal in inward:
        z = tilted(rng, normal)[2]
        x = vec.across(z, tuple(start[0]))
        if vec.norm(x) < 0.3:
            x = vec.across(z, tuple(start[1]))
        x = vec.unit(x)
        out.append([list(x), list(vec.cross(z, x)), list(z)])
    return out


def curves(rng, count, deep):
    """Curves of one tool: a triple for each node, or one for all."""
    def axes():
        return [draw.law(rng, rng.uniform(0.5, 1.5), 2e-3, ("power", "table")),
                draw.law(rng, rng.uniform(0.5, 1.5), 2e-3, ("power", "table")),
                draw.law(rng, rng.uniform(0.5, 2.0), deep)]

    return axes() if draw.chance(rng, 0.2) else [axes() for _ in range(count)]


def friction_of(rng):
    if draw.chance(rng, 0.3):
        return {"power": [rng.uniform(5.0, 20.0), rng.uniform(0.5, 1.0)]}
    return rng.uniform(0.2, 0.9)


def placement(rng):
    if draw.chance(rng, 0.5):
        return {}
    return {"origin": [rng.uniform(-0.1, 0.1) for _ in range(3)],
            "rotation": list(vec.scale(rng.uniform(0.0, 3.0), draw.direction(rng))),
            "scale": rng.choice((1.0, 1e-3))}


def path(rng, rows):
    """Positions inside and outside the body, before the body is placed."""
    wide = draw.spread(rng, 0.01, 0.35) * SIZE
    middle = rng.uniform(0.3, 0.7) * SIZE
    xs = [[middle + x for x in draw.stroke(rng, rows, wide)] for _ in range(2)]
    xs.append([x - 1.5e-3 for x in draw.stroke(rng, rows, 3e-3)])
    if draw.chance(rng, 0.5):
        for x, far in zip(xs, (0.3, 0.3, 0.05)):
            far *= SIZE
            jumps = draw.steps_in(rng, rows, far, 3)
            x[:] = [a + max(-far, min(far, b)) for a, b in zip(x, jumps)]
    draw.hold(rng, xs)
    return list(zip(*xs))


def body(rng, rows):
    """Settings for a random surface, and tool positions."""
    nodes, triangles, inward = grid(rng, draw.chance(rng, 0.6))
    placed = placement(rng)
    size = placed.get("scale", 1.0)
    turn = vec.rotation(tuple(placed.get("rotation", (0.0, 0.0, 0.0))))
    origin = tuple(placed.get("origin", (0.0, 0.0, 0.0)))
    surface = {"nodes": [list(vec.scale(1.0 / size, x)) for x in nodes],
               "triangles": triangles, "frames": frames(rng, inward),
               "curves": [curves(rng, len(nodes), 3e-3)
                          for _ in range(3)],
               "mu": [friction_of(rng) for _ in nodes]}
    positions = [vec.add(origin, vec.times(turn, p))
                 for p in path(rng, rows)]
    return {"surface": surface, **placed}, positions
