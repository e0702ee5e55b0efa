# SPDX-License-Identifier: MIT
"""One random set for each model: a graph, its feed, and the expected output."""

import dataclasses
import math
import random

import cutting
import deformation
import draw
import edge
import friction
import grain
import laws
import meshes
import safety
import scissors
import shock
import texture
import tolerance
import vec
import vibration
import wall


@dataclasses.dataclass
class Expected:
    """A recorded column. `free` lists the rows that the model leaves undefined."""
    column: str
    values: list
    tolerance: dict
    free: set = dataclasses.field(default_factory=set)


@dataclasses.dataclass
class Set:
    """`clock` says where the program reads the rate: the graph, the option --rate, or
    the times of the feed. Time-free outputs stay bit-identical while
    their inputs repeat."""
    rate: float
    rows: int
    clock: str = "graph"
    time_free: bool = False
    nodes: dict = dataclasses.field(default_factory=dict)
    wires: list = dataclasses.field(default_factory=list)
    devices: dict = dataclasses.field(default_factory=dict)
    feed: dict = dataclasses.field(default_factory=dict)
    expected: list = dataclasses.field(default_factory=list)

    @property
    def dt(self):
        return 1.0 / self.rate

    def node(self, name, kind, params=None, settings=None, feed=None):
        """Adds a node, with inputs and parameters driven by columns of a feed."""
        self.nodes[name] = {"type": kind, "params": params or {},
                            "settings": settings or {}}
        for port, column in (feed or {}).items():
            self.drive(f"{name}.{port}", column)

    def drive(self, port, column):
        self.feed.update(parts(port, column))

    def expect(self, port, column, golden, like, free=(), allowed=None):
        """Compares a port with a column, using `allowed` or the tolerance of a golden column."""
        allowed = allowed or tolerance.entry(tolerance.about(golden), like)
        for name, values in parts(port, column).items():
            self.expected.append(Expected(name, values, allowed, set(free)))

    def within(self, port, column, allowed):
        """Compares a port with a column, using the tolerance `allowed`."""
        for name, values in parts(port, column).items():
            self.expected.append(Expected(name, values, allowed))


def parts(port, column):
    """A column of vectors as three columns of numbers."""
    if not isinstance(column[0], tuple):
        return {port: column}
    return {f"{port}.{axis}": [v[i] for v in column]
            for i, axis in enumerate("xyz")}


def load(rng, rows):
    """A normal force: constant, varying, or one that opens the contact."""
    mean = rng.uniform(0.1, 5.0)
    depth = rng.choice((0.0, 0.5, 1.5))
    out = [mean + x for x in draw.stroke(rng, rows, depth * mean)]
    if depth and draw.chance(rng, 0.3):
        out = [mean * math.floor(4.0 * x / mean) / 4.0 for x in out]
    return out


def friction_params(rng):
    params = {"mu": rng.uniform(0.05, 1.5),
              "d_max": draw.spread(rng, 2e-6, 5e-3),
              "adhesion": rng.choice(("stick", "dupont", "ramp", "dahl", "curve")),
              "integrator": rng.choice(("exponential", "euler")),
              "load": rng.choice(("bound", "passive", "scale")),
              "break_away": rng.uniform(0.1, 0.95)}
    if draw.chance(rng, 0.4):
        params["static_ratio"] = rng.uniform(1.0, 3.0)
    if params["load"] == "bound":
        params["reference_load"] = draw.spread(rng, 0.1, 10.0)
    if draw.chance(rng, 0.25):
        params["stiffness"] = draw.spread(rng, 100.0, 5e4)
    return params


def moving(rng, params, name, rows):
    """A parameter that changes over time. The specification leaves two cases open:
    what a falling d_max does to a step solved by eq. (2) if load is not "bound",
    and whether load "scale" applies to a stiffness that is given."""
    out = [params[name] * (1.0 + 0.5 * math.tanh(x))
           for x in draw.stroke(rng, rows, 1.0)]
    if params["load"] == "bound":
        return out
    if name == "d_max" and params["integrator"] == "exponential":
        return out if params["adhesion"] == "stick" else sorted(out)
    if name == "stiffness" and params["load"] == "scale":
        return sorted(out, reverse=True)
    return out


def friction_set(rng):
    rows = 400
    set_ = Set(draw.rate(rng), rows, time_free=True)
    size = draw.spread(rng, 1e-5, 1e-2)
    feed = {"position": draw.motion3(rng, rows, size),
            "normal_force": load(rng, rows)}
    golden = "friction_3d"
    if draw.chance(rng, 0.3):
        feed["position"] = [(p[0], 0.0, 0.0) for p in feed["position"]]
        golden = "friction_1d"
    else:
        feed["normal"] = draw.normals(rng, rows)
    draw.hold(rng, list(feed.values()))
    for column in feed.values():
        draw.spoil(rng, column)
    for i in range(4):
        name, params, settings, own = f"drag{i}", friction_params(rng), {}, dict(feed)
        params["d_max"] = size * draw.spread(rng, 0.02, 3.0)
        for moved in ("mu", "d_max", "stiffness"):
            if moved in params and draw.chance(rng, 0.2):
                own[moved] = moving(rng, params, moved, rows)
        if params["adhesion"] == "curve":
            settings["adhesion_curve"] = [[0.0, 0.4, 0.9, 1.3], sorted(
                rng.uniform(0.0, 1.0) for _ in range(3)) + [1.0]]
        set_.node(name, "friction.elasto_plastic", params, settings, own)
        got = friction.run({**params, **settings}, own)
        for port, like in (("force", "f_eq3"), ("deflection", "d_eq3"),
                           ("stored_energy", "f_eq3"), ("state", "state_eq3")):
            set_.expect(f"{name}.{port}", got[port], golden, like)
    return set_


def grain_set(rng):
    rows = 400
    set_ = Set(draw.rate(rng), rows, time_free=True)
    size = draw.spread(rng, 1e-5, 1e-2)
    turned = draw.normals(rng, rows)
    feed = {"position": draw.motion3(rng, rows, size), "normal": turned,
            "normal_force": load(rng, rows)}
    draw.hold(rng, list(feed.values()))
    # The grain is never along the normal, where it has no direction.
    feed["grain"] = [vec.across(vec.unit(n), side) if vec.norm(vec.cross(vec.unit(n), side)) > 0.1
                     else vec.cross(n, (1.0, 0.0, 0.0)) for n, side in
                     zip(feed["normal"], [draw.direction(rng)] * rows)]
    for column in feed.values():
        draw.spoil(rng, column)
    for i in range(4):
        name, own = f"pile{i}", dict(feed)
        params = {"adhesion": rng.choice(("stick", "dupont", "ramp", "dahl")),
                  "d_max": size * draw.spread(rng, 0.02, 3.0),
                  "break_away": rng.uniform(0.1, 0.95),
                  "reference_load": draw.spread(rng, 0.1, 10.0)}
        for mu in grain.COEFFICIENTS:
            params[mu] = draw.spread(rng, 0.1, 1.5)
            if draw.chance(rng, 0.2):
                own[mu] = moving(rng, {**params, "load": "bound"}, mu, rows)
        if draw.chance(rng, 0.4):
            params["static_ratio"] = rng.uniform(1.0, 3.0)
        if draw.chance(rng, 0.25):
            params["stiffness"] = draw.spread(rng, 100.0, 5e4)
        set_.node(name, "friction.anisotropic", params, {}, own)
        got = grain.run(params, own)
        for port, like in (("force", "f_"), ("deflection", "d_"),
                           ("stored_energy", "f_"), ("state", "state_stick")):
            set_.expect(f"{name}.{port}", got[port], "friction_grain", like)
    return set_


def soft_tip_set(rng):
    rows = 400
    set_ = Set(draw.rate(rng), rows, time_free=True)
    size = draw.spread(rng, 1e-5, 1e-2)
    feed = {"position": draw.motion3(rng, rows, size), "normal": draw.normals(rng, rows),
            "normal_force": load(rng, rows)}
    draw.hold(rng, list(feed.values()))
    for column in feed.values():
        draw.spoil(rng, column)
    params = {"mu": rng.uniform(0.05, 1.5), "s_max": size * draw.spread(rng, 0.02, 3.0),
              "reference_load": draw.spread(rng, 0.1, 10.0)}
    if draw.chance(rng, 0.25):
        params["stiffness"] = draw.spread(rng, 100.0, 5e4)
    if draw.chance(rng, 0.5):
        feed["mu"] = moving(rng, {**params, "load": "bound"}, "mu", rows)
    set_.node("tip", "friction.partial_slip", params, {}, feed)
    got = grain.soft_tip(params, feed)
    for port, like in (("force", "f_"), ("deflection", "d_"),
                       ("stored_energy", "f_"), ("state", "state_stick")):
        set_.expect(f"tip.{port}", got[port], "friction_grain", like)
    return set_


def latch(rng, value, states):
    """A feed with arbitrary values during contact, because the parameter is latched."""
    out = [value]
    for before in states[:-1]:
        wild = before > 0 and draw.chance(rng, 0.3)
        out.append(value * rng.uniform(1.0, 3.0) if wild else value)
    return out


def cutting_set(rng):
    rows = 500
    set_ = Set(draw.rate(rng), rows, time_free=True)
    params = {"width": draw.spread(rng, 0.002, 0.05),
              "toughness": draw.spread(rng, 50.0, 3000.0)}
    resistance = params["width"] * params["toughness"]
    depth = draw.spread(rng, 5e-4, 1e-2)
    settings = {"law": draw.law(rng, resistance, depth)}
    params["rupture_force"] = resistance * rng.uniform(1.0, 3.5)
    if draw.chance(rng, 0.4):
        settings["cracked_law"] = draw.weaker(settings["law"], rng.uniform(0.3, 1.0))
    d_r = laws.inverse(settings["law"], params["rupture_force"])
    if draw.chance(rng, 0.4):
        params["thickness"] = d_r * rng.uniform(0.3, 4.0)
    deep = d_r * rng.choice((0.5, 2.0, 4.0))
    feed = [0.5 * deep + x for x in draw.motion(rng, rows, deep)]
    draw.spoil(rng, feed)
    got = cutting.run({**params, **settings}, {"depth": feed})
    set_.node("blade", "cut.blade", params, settings, {"depth": feed})
    if draw.chance(rng, 0.5):
        name = rng.choice(sorted(params))
        set_.drive(f"blade.{name}", latch(rng, params[name], got["state"]))
    for port, like in (("resistance", "f"), ("crack", "crack"),
                       ("stored_energy", "U"), ("state", "state"),
                       ("dissipated_energy", "dissipated")):
        set_.expect(f"blade.{port}", got[port], "cutting", like)
    return set_


def edge_set(rng):
    """An edge that is pressed in, tilted, moved along the surface, and lifted."""
    rows = 300
    set_ = Set(draw.rate(rng), rows, time_free=True)
    params = {"width": draw.spread(rng, 0.003, 0.03),
              "toughness": draw.spread(rng, 50.0, 2000.0)}
    cost = params["width"] * params["toughness"]
    depth = draw.spread(rng, 1e-3, 5e-3)
    normal = draw.direction(rng)
    settings = {"law": draw.law(rng, cost, depth), "normal": list(normal),
                "offset": rng.uniform(-0.05, 0.05),
                "grid": params["width"] * rng.uniform(0.03, 0.4)}
    params["rupture_force"] = cost * rng.uniform(1.0, 3.0)
    if draw.chance(rng, 0.4):
        settings["cracked_law"] = draw.weaker(settings["law"], rng.uniform(0.3, 1.0))
    deep = 2.0 * laws.inverse(settings["law"], params["rupture_force"])
    if draw.chance(rng, 0.3):
        params["thickness"] = deep * rng.uniform(0.2, 1.0)
    surface = vec.scale(settings["offset"], normal)
    aside = draw.chance(rng, 0.7)
    wander = draw.motion3(rng, rows, params["width"] * rng.uniform(0.1, 0.8))
    wander = [vec.across(normal, w) if aside else (0.0, 0.0, 0.0) for w in wander]
    down = [-0.3 * deep + x for x in draw.motion(rng, rows, deep)]
    positions = [vec.add(surface, vec.sub(w, vec.scale(d, normal))) for w, d in zip(wander, down)]
    flat = vec.unit(vec.cross(normal, draw.direction(rng)))
    start = vec.scale(math.acos(flat[0]), vec.unit(vec.cross((1.0, 0.0, 0.0), flat)))
    size = rng.choice((0.0, 0.1, 0.5))
    turns = [vec.add(start, vec.scale(size, t)) for t in zip(*(draw.stroke(rng, rows, 1.0) for _ in range(3)))]
    draw.hold(rng, [positions, turns])
    draw.spoil(rng, positions)
    feed = {"position": positions, "rotation": turns}
    got = edge.run({**params, **settings, "normal": normal}, feed)
    set_.node("edge", "cut.edge", params, settings, feed)
    for port, like in (("crack", "crack"), ("stored_energy", "U"),
                       ("dissipated_energy", "dissipated"), ("state", "state")):
        set_.expect(f"edge.{port}", got[port], "cutting", like)
    # The model differentiates numerically, also across the kinks of V.
    near = {"abs": 1e-6, "rel_of_peak": 2e-5}
    for port in ("force", "torque", "resistance"):
        for name, values in parts(f"edge.{port}", got[port]).items():
            set_.expected.append(Expected(name, values, near))
    return set_


def slow_opening(params, feed):
    """Stops opening blades at the angle of the longest crack: the specification
    does not say what a jump over this angle cuts on opening."""
    peak = scissors.peak(params["toughness"], params["stiffness"])
    out = feed[:1]
    for theta in feed[1:]:
        passes = 0.0 < out[-1] < peak < theta < math.inf
        out.append(peak if passes else theta)
    return out


def scissors_set(rng):
    rows = 500
    set_ = Set(draw.rate(rng), rows, time_free=True)
    params = {"thickness": draw.spread(rng, 2e-4, 4e-3),
              "toughness": draw.spread(rng, 100.0, 5000.0),
              "stiffness": draw.spread(rng, 1e5, 5e6),
              "pivot_distance": draw.spread(rng, 5e-4, 3e-2)}
    touch = params["thickness"] / params["pivot_distance"]
    wide = min(1.5, touch * rng.choice((0.3, 1.0, 2.0)))
    feed = [0.7 * wide + x for x in draw.motion(rng, rows, wide)]
    draw.spoil(rng, feed)
    feed = slow_opening(params, feed)
    got = scissors.run(params, {"angle": feed})
    set_.node("scissors", "cut.scissors", params, feed={"angle": feed})
    if draw.chance(rng, 0.5):
        name = rng.choice(sorted(params))
        set_.drive(f"scissors.{name}", latch(rng, params[name], got["state"]))
    for port, like in (("torque", "torque"), ("crack_front", "crack"),
                       ("stored_energy", "U"), ("dissipated_energy", "dissipated")):
        set_.expect(f"scissors.{port}", got[port], "scissors", like)
    set_.expect("scissors.state", got["state"], "cutting", "state")
    return set_


def texture_set(rng):
    """A grating in the plane; a grating on a line, with guard, window and filter;
    friction with a grating as d_max."""
    rows = 400
    set_ = Set(draw.rate(rng), rows)
    k = draw.spread(rng, 20.0, 3000.0)
    size = draw.spread(rng, 0.2, 30.0) / k
    feed = {"position": draw.motion3(rng, rows, size)}
    draw.spoil(rng, feed["position"])
    depths = [2e-4 + x for x in draw.motion(rng, rows, 6e-4)]
    draw.spoil(rng, depths)
    wave = {"spatial_frequency": k, "angle": rng.uniform(-3.0, 3.0)}
    grating = {**wave, "amplitude": rng.uniform(0.0, 1.0),
               "phase": rng.uniform(-3.0, 3.0)}
    guard = {**wave, "f_max": set_.rate * rng.uniform(0.02, 0.5)}
    width, cutoff = draw.spread(rng, 1e-5, 2e-3), set_.rate * rng.uniform(0.005, 0.4)

    set_.node("wave", "texture.grating", grating, feed=feed)
    set_.node("guard", "texture.antialias", guard, feed=feed)
    set_.node("window", "contact.window", {"window": width},
              feed={"depth": depths})
    set_.node("product", "signal.multiply", {}, {"inputs": 3})
    set_.node("filter", "filter.butterworth2", {"cutoff": cutoff})
    set_.wires = ["wave.value -> product.in[0]", "guard.gain -> product.in[1]",
                  "window.gain -> product.in[2]", "product.out -> filter.in"]

    ridges = texture.grating(grating, feed)
    guards = texture.antialias(guard, feed, set_.dt)
    gains = texture.window(depths, width)
    product = [a * b * c for a, b, c in
               zip(ridges["value"], guards["gain"], gains)]
    for port, column in (("wave.value", ridges["value"]),
                         ("wave.force", ridges["force"]),
                         ("guard.gain", guards["gain"]),
                         ("guard.speed", guards["speed"]),
                         ("product.out", product),
                         ("filter.out",
                          texture.butterworth2(product, cutoff, set_.dt))):
        set_.expect(port, column, "texture", "*")
    ridged_friction(rng, set_, feed["position"], k)
    return set_


def ridged_friction(rng, set_, positions, k):
    """Friction of constant stiffness, d_max (1 + m sin(2 pi k x))."""
    mean, m = draw.spread(rng, 1e-5, 1e-3), rng.uniform(0.0, 0.9)
    params = {"mu": 0.4, "d_max": mean, "stiffness": 0.4 / mean,
              "load": rng.choice(("bound", "passive"))}
    xs = [p[0] if math.isfinite(p[0]) else 0.0 for p in positions]
    feed = {"position": positions, "d_max": [
        mean * (1.0 + m * math.sin(2.0 * math.pi * k * x)) for x in xs]}
    set_.node("drag", "friction.elasto_plastic", params, feed=feed)
    set_.expect("drag.force", friction.run(params, feed)["force"],
                "texture", "f_friction_mod")


def shock_set(rng):
    rows = 600
    set_ = Set(draw.rate(rng), rows)
    mass, speed = draw.spread(rng, 0.005, 0.5), 0.4
    contact = rng.choice((rng.uniform(8.0, 60.0), rng.uniform(0.1, 3.0))) * set_.dt
    depth = speed * contact / math.pi
    force = mass * speed * math.pi / contact
    settings = {"stiffness": draw.law(rng, force, depth),
                "substeps": rng.randint(1, 16), "voices": rng.randint(1, 5)}
    if draw.chance(rng, 0.6):
        settings["damping"] = {"dissipation": rng.uniform(0.0, 2.0)}
    else:
        settings["damping"] = draw.law(rng, force * rng.uniform(0.0, 1.0), depth)
    hits = draw.hits(rng, rows, rng.choice((0.01, 0.05, 0.3)))
    feed = {"hit": hits}
    if draw.chance(rng, 0.4):
        feed["gain"] = draw.stroke(rng, rows, 2.0)
    if draw.chance(rng, 0.4):
        feed["mass"] = [mass * rng.uniform(1.0, 2.0) for _ in range(rows)]
    set_.node("shock", "shock.hunt_crossley", {"mass": mass}, settings,
              feed=feed)
    got = shock.run({"mass": mass, **settings}, feed, set_.dt)
    if contact > 4.0 * set_.dt:
        set_.expect("shock.resistance", got["resistance"], "shock", "f_semi_implicit")
    else:
        set_.within("shock.resistance", got["resistance"], {"rel_of_peak": 2e-3})
    arrived = 0.5 * mass * 0.4 ** 2 * sum(1 for v in hits if 0.0 < v < math.inf)
    set_.within("shock.dissipated_energy", got["dissipated_energy"],
                {"rel": 2e-3, "abs": 1e-4 * arrived})
    return set_


def modes(rng, rate):
    return [{"frequency": rate * draw.spread(rng, 0.005, 0.7),
             "decay": draw.spread(rng, 0.5, 0.2 * rate),
             "amplitude": rng.uniform(-1.0, 1.0)}
            for _ in range(rng.randint(1, 6))]


def factors(rng, rows, names):
    """Constants or columns with values around 1 for these parameters."""
    params, feed = {}, {}
    for name in names:
        if draw.chance(rng, 0.3):
            params[name] = rng.uniform(0.5, 2.0)
        elif draw.chance(rng, 0.3):
            feed[name] = [1.0 + 0.4 * math.tanh(x) for x in draw.stroke(rng, rows, 1.0)]
    return params, feed


def modal_set(rng):
    rows = 800
    set_ = Set(draw.rate(rng), rows)
    params, feed = factors(rng, rows, ("gain", "damping"))
    if draw.chance(rng, 0.4):
        params["pitch"] = rng.uniform(0.5, 2.0)
    feed["hit"] = draw.hits(rng, rows, rng.choice((0.01, 0.1)))
    bank = {"modes": modes(rng, set_.rate)}
    set_.node("bar", "vibration.modal", params, bank, feed=feed)
    got = vibration.modal({**params, **bank}, feed, set_.dt)
    set_.expect("bar.value", got["value"], "modal", "y_modal")
    return set_


def low(mode, rate):
    """The mode lowered to 0.4 of its frequency, unless it is mute. The specification leaves open
    what else becomes mute when the pitch is raised."""
    mute = mode["frequency"] >= 0.5 * rate
    return mode if mute else {**mode, "frequency": 0.4 * mode["frequency"]}


def wavetable_set(rng):
    rows = 600
    set_ = Set(draw.rate(rng), rows)
    params, feed = factors(rng, rows, ("gain", "pitch"))
    feed["hit"] = draw.hits(rng, rows, rng.choice((0.01, 0.1)))
    voices, rate = rng.randint(1, 8), set_.rate * rng.uniform(0.5, 8.0)
    wave = {"modes": modes(rng, set_.rate), "rate": rate,
            "length": rng.randint(20, 800)}
    if "pitch" in params or "pitch" in feed:
        wave["modes"] = [low(mode, set_.rate) for mode in wave["modes"]]
    set_.node("bar", "vibration.wavetable", params,
              {"voices": voices, "table": wave}, feed=feed)
    got = vibration.wavetable({**params, "voices": voices, "rate": rate,
                               "samples": vibration.entries(wave, set_.dt)},
                              feed, set_.dt)
    set_.expect("bar.value", got["value"], "modal", "y_wavetable")
    return set_


def contacts(rng, rows):
    level = rng.uniform(-0.8, 0.2)
    return [float(x > level) for x in draw.stroke(rng, rows, 1.0)]


def passivity_set(rng):
    """A held spring, which generates energy, and an arbitrary force."""
    rows = 500
    set_ = Set(draw.rate(rng), rows)
    size = draw.spread(rng, 1e-4, 1e-2)
    positions = draw.motion3(rng, rows, size)
    k = draw.spread(rng, 100.0, 5000.0)
    late = rng.randint(0, 3)
    forces = [vec.scale(-k, positions[max(0, i - late)]) for i in range(rows)]
    if draw.chance(rng, 0.3):
        forces = draw.motion3(rng, rows, rng.uniform(0.1, 5.0))
    draw.spoil(rng, positions)
    draw.spoil(rng, forces)
    feed = {"position": positions, "force": forces}
    if draw.chance(rng, 0.4):
        feed["contact"] = contacts(rng, rows)
    for pairing in ("zoh", "backward"):
        mass = draw.spread(rng, 0.02, 0.5)
        params = {"mass": mass, "pairing": pairing,
                  "alpha_max": rng.choice((0.0, 1.8, 1.0, 0.2)) * mass * set_.rate}
        set_.node(pairing, "safety.passivity", params, feed=feed)
        got = safety.passivity(params, feed, set_.dt)
        for port in ("force", "energy", "alpha"):
            set_.expect(f"{pairing}.{port}", got[port], "passivity", "*")
    return set_


def hold_set(rng):
    rows = 300
    set_ = Set(draw.rate(rng), rows)
    feed = {"in": draw.motion3(rng, rows, rng.uniform(0.5, 5.0))}
    draw.spoil(rng, feed["in"])
    if draw.chance(rng, 0.6):
        feed["contact"] = contacts(rng, rows)
    params = {"limit": rng.choice((100.0, 3.0, 0.5))}
    set_.node("ahead", "hold.predictive", params, feed=feed)
    set_.expect("ahead.out", safety.hold(params, feed)["out"],
                "passivity", "f_predictive")
    return set_


def coupling_params(rng):
    return {"stiffness": draw.spread(rng, 100.0, 5000.0),
            "damping": rng.choice((0.0, 0.1, 0.5, 2.0)),
            "wall_stiffness": draw.spread(rng, 1e3, 1e8)}


def coupling_set(rng):
    rows = 400
    set_ = Set(draw.rate(rng), rows)
    size = draw.spread(rng, 1e-4, 1e-2)
    params = {**coupling_params(rng), "offset": rng.uniform(-size, size)}
    feed = {"position": draw.motion3(rng, rows, size)}
    turned = draw.normals(rng, rows)
    if draw.chance(rng, 0.3):
        feed["normal"] = turned
    else:
        params["normal"] = list(turned[0])
    draw.spoil(rng, feed["position"])
    set_.node("wall", "coupling.virtual", params, feed=feed)
    got = safety.coupling({**params, "normal": tuple(turned[0])}, feed, set_.dt)
    for port, like in (("proxy", "x_vc"), ("force", "f_vc"), ("depth", "x_vc")):
        set_.expect(f"wall.{port}", got[port], "wallsim", like)
    set_.expect("wall.state", got["state"], "cutting", "state")
    return set_


def plane_params(rng):
    params = {"stiffness": draw.spread(rng, 100.0, 3000.0)}
    if draw.chance(rng, 0.5):
        params["damping"] = rng.uniform(0.0, 1.0)
    if draw.chance(rng, 0.5):
        params["dissipation"] = rng.uniform(0.0, 3.0)
    settings = {}
    if draw.chance(rng, 0.5):
        settings["law"] = draw.law(rng, 2.0, 2e-3)
    return params, settings


def plane_set(rng):
    rows = 400
    set_ = Set(draw.rate(rng), rows)
    params, settings = plane_params(rng)
    params["offset"] = rng.uniform(-1e-3, 1e-3)
    feed = {"position": [tuple(max(-0.01, min(0.01, x)) for x in p)
                         for p in draw.motion3(rng, rows, 1e-3)]}
    turned = draw.normals(rng, rows)
    if draw.chance(rng, 0.3):
        feed["normal"] = turned
    else:
        params["normal"] = list(turned[0])
    draw.spoil(rng, feed["position"])
    set_.node("wall", "deform.plane", params, settings, feed=feed)
    got = wall.plane({**params, **settings, "normal": tuple(turned[0])},
                     feed, set_.dt)
    for port, like in (("force", "f_smooth"), ("resistance", "f_smooth"),
                       ("depth", "x_smooth"), ("stored_energy", "x_smooth"),
                       ("dissipated_energy", "x_smooth")):
        set_.expect(f"wall.{port}", got[port], "wallsim", like)
    set_.expect("wall.state", got["state"], "cutting", "state")
    return set_


def wall_set(rng):
    """The closed loop of a simulated tool with a wall, or with a coupling to one."""
    rows = 300
    set_ = Set(draw.rate(rng), rows)
    normal, mass = draw.direction(rng), draw.spread(rng, 0.02, 0.3)
    device = {"mass": mass, "damping": rng.choice((0.0, 0.5, 2.0)),
              "position": vec.add(vec.scale(rng.uniform(0.0, 1e-3), normal),
                                  vec.scale(1e-3, draw.direction(rng))),
              "velocity": vec.add(vec.scale(rng.uniform(-0.2, 0.0), normal),
                                  vec.scale(0.02, draw.direction(rng))),
              "hand_force": vec.scale(rng.uniform(-1.0, 0.0), normal)}
    if draw.chance(rng, 0.3):
        device["delay"] = rng.randint(1, 3)
    if draw.chance(rng, 0.3):
        device["quantum"] = draw.spread(rng, 1e-6, 5e-5)
    settings = {}
    if draw.chance(rng, 0.6):
        kind, defaults, tick = "deform.plane", wall.PLANE, wall.plane_tick(set_.dt)
        params, settings = plane_params(rng)
    else:
        kind, defaults, tick = ("coupling.virtual", safety.COUPLING,
                                safety.coupling_tick(set_.dt))
        params = coupling_params(rng)
    set_.node("hand", "device.position")
    set_.node("truth", "device.truth")
    set_.node("motor", "device.force")
    set_.node("wall", kind, {**params, "normal": list(normal)}, settings)
    for name in ("hand", "truth", "motor"):
        set_.nodes[name]["role"] = "tool"
    set_.wires = ["hand.position -> wall.position", "wall.force -> motor.force"]
    set_.devices = {"tool": {"driver": "sim", **{
        key: list(value) if isinstance(value, tuple) else value
        for key, value in device.items()}}}
    got = wall.simulate(device, tick, defaults,
                        {**params, **settings, "normal": normal}, rows, set_.dt)
    free = past_tie(got["position"], device.get("quantum", 0.0), rows)
    for port, column, like in (("truth.position", "position", "x_smooth"),
                               ("truth.velocity", "velocity", "v_smooth"),
                               ("motor.force", "force", "f_smooth")):
        set_.expect(port, got[column], "wallsim", like, free)
    return set_


def past_tie(positions, quantum, rows):
    """The rows from the first value on that is so close to half a quantum that the last bit decides how it is rounded."""
    if not quantum:
        return ()
    for k, p in enumerate(positions):
        if any(abs((x / quantum) % 1.0 - 0.5) * quantum < 1e-12 for x in p):
            return range(k, rows)
    return ()


def deformation_set(rng):
    rows = 200
    set_ = Set(draw.rate(rng), rows)
    settings, positions = meshes.body(rng, rows)
    tool = [float(rng.randrange(3))] * rows
    if draw.chance(rng, 0.7):
        tool = [1.0 + x for x in draw.stroke(rng, rows, 0.8)]
    draw.spoil(rng, positions)
    draw.spoil(rng, tool, 1)
    feed = {"position": positions, "tool": tool}
    for friction_ in ("bound", "frictionless"):
        params = {"friction": friction_}
        set_.node(friction_, "deform.surface", params, settings, feed=feed)
        got = deformation.run(settings, params, feed)
        shared = {k for k in range(rows) if got["shared"][k]}
        for port, like in (("force", "f_"), ("resistance", "f_"), ("depth", "c_"),
                           ("contact", "c_"), ("stored_energy", "U")):
            by_differences = {"abs": 1e-6} if port == "force" else None   # steep laws
            set_.expect(f"{friction_}.{port}", got[port], "deformation", like, (),
                        by_differences)
        apart = {k for k, state in enumerate(got["state"]) if state <= 0}
        set_.expect(f"{friction_}.normal", got["normal"], "deformation", "c_", apart)
        set_.expect(f"{friction_}.triangle", got["triangle"], "deformation", "tri",
                    shared)
        set_.expect(f"{friction_}.state", got["state"], "deformation", "state")
    return set_


MODELS = {"friction": friction_set, "grain": grain_set,
          "soft_tip": soft_tip_set, "cutting": cutting_set,
          "edge": edge_set, "scissors": scissors_set, "texture": texture_set,
          "shock": shock_set, "modal": modal_set,
          "wavetable": wavetable_set, "passivity": passivity_set,
          "hold": hold_set, "coupling": coupling_set,
          "plane": plane_set, "wall": wall_set,
          "deformation": deformation_set}


def make(model, seed):
    rng = random.Random(f"{model} {seed}")
    set_ = MODELS[model](rng)
    set_.clock = rng.choice(("graph", "option", "time"))
    if set_.clock == "time" and not set_.feed:
        set_.clock = "option"
    return set_
