# SPDX-License-Identifier: MIT
"""An edge that cuts a half-space: Hayward 2007, section 3, Fig. 5.

The energy of the edge in the plane of its cut is E = sum_j (h / L) w_j V (delta_j, c_j), with means
over hat functions. Forces are its numerical derivatives while the cracks stay, so this shares
no formula of forces with the node.
"""

import math

import cutting
import laws
import table
import vec

DEFAULTS = {**{k: v for k, v in cutting.DEFAULTS.items() if k != "depth"},
            "grid": 1e-3, "normal": (0.0, 0.0, 1.0), "offset": 0.0}
CUTS, LONGEST, NUDGE = 16, 250, 1e-8
WHOLE = (0.0, True, False)  # crack, virgin, in two


class Strip:
    """How the sample responds to a level edge."""

    def __init__(self, now):
        self.g0, self.g1 = now["law"], now["cracked_law"] or now["law"]
        self.cost = now["toughness"] * now["width"]
        self.last = now["thickness"] or math.inf
        self.e_c = laws.inverse(self.g1, self.cost)
        self.d_r = laws.inverse(self.g0, now["rupture_force"])
        c1, excess = cutting.first_crack(self.g0, self.g1, self.d_r, self.e_c, self.cost)
        self.first, self.loss = (c1, self.cost * c1 + excess) if c1 < self.last else (
            self.last, laws.energy(self.g0, self.d_r))

    def press(self, column, delta):
        """Returns the column afterwards, its elastic energy, the energy lost, and what happened."""
        crack, virgin, in_two = column
        lost, bursts, cuts = 0.0, False, False
        if in_two or delta <= crack:
            return column, 0.0, 0.0, ""
        if virgin and delta >= self.d_r:
            crack, virgin, lost, bursts = self.first, False, self.loss, True
            in_two = crack >= self.last
        if not virgin and not in_two and delta - crack > self.e_c * (1.0 + cutting.EPS_SLIP):
            grown = min(delta - self.e_c, self.last)
            if grown > crack:
                lost, crack, cuts = lost + self.cost * (grown - crack), grown, True
                if crack >= self.last:
                    in_two, lost = True, lost + laws.energy(self.g1, self.e_c)
        e = 0.0 if in_two else delta - crack
        stored = laws.energy(self.g0 if virgin else self.g1, e)
        what = "bursts" if bursts else "cuts" if cuts and not in_two else ""
        return (crack, virgin, in_two), stored, lost, what


def hat_mean(a, b):
    """The integral of the hat function 1 - |u| from a to b, and the mean of u weighted by it."""
    stops = [a, *(u for u in (-1.0, 0.0, 1.0) if a < u < b), b]
    area = moment = 0.0
    for low, high in zip(stops, stops[1:]):
        middle, step = 0.5 * (low + high), high - low
        values = [max(0.0, 1.0 - abs(u)) for u in (low, middle, high)]
        area += step / 6.0 * (values[0] + 4.0 * values[1] + values[2])
        moment += step / 6.0 * (values[0] * low + 4.0 * values[1] * middle + values[2] * high)
    return area, moment / area if area > 0.0 else 0.0


def covered(x, depth, h):
    """Yields (column, share, mean depth) for the columns under the line from (x[0], depth[0]) to (x[1], depth[1])."""
    (low, d_low), (high, d_high) = sorted(zip(x, depth))
    for j in range(math.floor(low / h), math.ceil(high / h) + 1):
        share, middle = hat_mean(low / h - j, high / h - j)
        if share > 1e-9:
            part = ((middle + j) * h - low) / (high - low)
            yield j, share, d_low + part * (d_high - d_low)


def energy(line, cut, strip, width):
    h = cut["spacing"]
    total = 0.0
    for j, share, delta in covered(line[:2], line[2:], h):
        _, stored, lost, _ = strip.press(cut["columns"].get(j, WHOLE), delta)
        total += h / width * share * (stored + lost)
    return total


def slopes(line, cut, strip, width, floats):
    """The derivatives of the energy by the places and depths of the ends. A cut that floats follows the middle of the edge."""
    out = []
    for i in range(4):
        back = 0.5 if floats and i < 2 else 0.0
        ends = [[v + step * ((1.0 if k == i else 0.0) - (back if k < 2 else 0.0)) for k, v in enumerate(line)]
                for step in (NUDGE, -NUDGE)]
        out.append((energy(ends[0], cut, strip, width) - energy(ends[1], cut, strip, width)) / (2.0 * NUDGE))
    return out


class Body:
    def __init__(self, now):
        self.now, self.strip, self.width = now, Strip(now), now["width"]
        self.n = vec.unit(now["normal"])
        self.cuts, self.inside, self.floats, self.follows = [], None, False, set()
        self.crack = self.spent = 0.0

    def find(self, a, b):
        def off(cut):
            return max(abs(vec.dot(cut["aside"], vec.sub(p, cut["origin"]))) for p in (a, b))
        near = [cut for cut in self.cuts if off(cut) <= cut["spacing"]]
        return min(near, key=off) if near else None

    def begin(self):
        cut = {"columns": {}, "spacing": max(self.now["grid"], self.width / LONGEST)}
        self.cuts = self.cuts[-(CUTS - 1):] + [cut]
        return cut

    def follow(self, cut, a, b):
        """Moves a cut that has no crack yet to where the edge is."""
        along = vec.unit(vec.across(self.n, vec.unit(vec.sub(b, a))))
        cut.update(origin=vec.scale(0.5, vec.add(a, b)), along=along, aside=vec.cross(self.n, along))

    def leave(self):
        if self.floats:
            self.cuts.remove(self.inside)
        self.inside, self.floats, self.follows = None, False, set()

    def fault(self):
        self.leave()
        return self.result((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), 0.0, 0.0, -1)

    def result(self, force, torque, resistance, stored, state):
        return {"force": force, "torque": torque, "resistance": resistance, "crack": self.crack,
                "stored_energy": stored, "dissipated_energy": self.spent, "state": state}

    def step(self, p, turn):
        if not vec.finite(p, turn):
            return self.fault()
        edge = vec.times(vec.rotation(turn), (1.0, 0.0, 0.0))
        a, b = (vec.add(p, vec.scale(s * 0.5 * self.width, edge)) for s in (-1.0, 1.0))
        depth = [self.now["offset"] - vec.dot(self.n, q) for q in (a, b)]
        enters = self.inside is None and max(depth) > 0.0
        if max(depth) <= 0.0:
            self.leave()
        cut = self.inside or self.find(a, b)
        if enters:
            self.floats, cut = cut is None, cut or self.begin()
            self.cuts = [c for c in self.cuts if c is not cut] + [cut]
            self.inside = cut
        if cut is None:
            self.crack = 0.0
            return self.result((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), 0.0, 0.0, 0)
        if self.floats:
            self.follow(cut, a, b)
        x = [vec.dot(cut["along"], vec.sub(q, cut["origin"])) for q in (a, b)]
        return self.press(cut, x, depth, edge, enters)

    def press(self, cut, x, depth, edge, enters):
        columns, h = cut["columns"], cut["spacing"]
        under = list(covered(x, depth, h))
        happened, pressing, after = set(), [], set()
        for j, share, delta in under if self.inside else ():
            old = columns.get(j, WHOLE)
            pressed = not old[2] and delta > old[0]
            new, _, lost, what = self.strip.press(old, delta)
            if enters or j in self.follows or share >= 1.0 or delta <= old[0]:
                after.add(j)
                happened.add(what)
                self.spent += h / self.width * share * lost
                columns[j] = new
            if pressed and not new[2] and delta > new[0]:
                pressing.append(not new[1])
        self.follows = after
        self.floats = self.floats and "bursts" not in happened
        found = [columns.get(j, WHOLE) for j, _, _ in under]
        self.crack = max((c[0] for c in found), default=0.0)

        line, stored, by = [*x, *depth], 0.0, [0.0] * 4
        if self.inside:
            stored = energy(line, cut, self.strip, self.width)
            by = slopes(line, cut, self.strip, self.width, self.floats)
        ends = [vec.sub(vec.scale(by[2 + i], self.n), vec.scale(by[i], cut["along"])) for i in (0, 1)]
        torque = vec.scale(0.5 * self.width, vec.cross(edge, vec.sub(ends[1], ends[0])))
        state = (2 if "bursts" in happened else 4 if "cuts" in happened else
                 (3 if any(pressing) else 1) if pressing else
                 5 if found and all(c[2] for c in found) else 0)
        return self.result(vec.add(*ends), torque, by[2] + by[3], stored, state)


def run(params, feed):
    body = Body({**DEFAULTS, **params})
    return table.collect(body.step(p, turn) for p, turn in zip(feed["position"], feed["rotation"]))
