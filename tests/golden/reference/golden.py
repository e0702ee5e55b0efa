# SPDX-License-Identifier: MIT
"""Runs the reference models on the golden sets.

`python3 golden.py deformation` makes the expected columns of this set again, on its
inputs, because its law has two points, and the law of the first vectors one.
"""

import csv
import math
import sys

import cutting
import deformation
import friction
import grain
import safety
import scissors
import shock
import texture
import tolerance
import vibration
import wall


def read(name):
    with open(tolerance.GOLDEN / f"{name}.csv", newline="") as file:
        header, *body = list(csv.reader(file))
    columns = zip(*([float(cell) for cell in row] for row in body))
    return dict(zip(header, map(list, columns)))


def on_x(values):
    return [(x, 0.0, 0.0) for x in values]


def vectors(set_, name):
    return list(zip(*(set_[f"{name}_{axis}"] for axis in "xyz")))


def part(vectors_, axis):
    return [v[axis] for v in vectors_]


def friction_1d(set_, about):
    feed = {"position": on_x(set_["p"]), "normal_force": set_["fn"]}
    forms = {"eq3": {}, "stickslip": {"static_ratio": 2.5},
             "euler2": {"adhesion": "dupont", "integrator": "euler"},
             "euler3": {"adhesion": "ramp", "integrator": "euler"},
             "euler4": {"adhesion": "dahl", "integrator": "euler"},
             "etd2": {"adhesion": "dupont"}, "etd4": {"adhesion": "dahl"},
             "passive": {"load": "passive"}}
    out = {}
    for name, form in forms.items():
        got = friction.run({"mu": 0.4, "d_max": 1e-5, "load": "scale", **form},
                           feed)
        out["d_" + name] = part(got["deflection"], 0)
        out["f_" + name] = part(got["force"], 0)
        out["state_" + name] = got["state"]
    return out


def friction_bound(set_, about):
    given = about["params"]
    feed = {"position": on_x(set_["p"]), "normal_force": set_["fn"],
            "mu": set_["mu"], "d_max": set_["d_max"]}
    forms = {"stick": {}, "dahl": {"adhesion": "dahl"},
             "slip": {"static_ratio": given["static_ratio_slip"]}}
    out = {}
    for name, form in forms.items():
        got = friction.run({"mu": given["mu"], "d_max": given["d_max"], **form}, feed)
        out["d_" + name] = part(got["deflection"], 0)
        out["f_" + name] = part(got["force"], 0)
        out["state_" + name] = got["state"]
    return out


def friction_3d(set_, about):
    feed = {"position": vectors(set_, "p"), "normal": vectors(set_, "n"),
            "normal_force": set_["fn"]}
    forms = {"eq3": {}, "euler2": {"adhesion": "dupont", "integrator": "euler"},
             "etd4": {"adhesion": "dahl"}}
    out = {}
    for name, form in forms.items():
        got = friction.run({"mu": 0.6, "d_max": 5e-5, "load": "scale", **form},
                           feed)
        for i, axis in enumerate("xyz"):
            out[f"f_{name}_{axis}"] = part(got["force"], i)
            out[f"d_{name}_{axis}"] = part(got["deflection"], i)
        out["state_" + name] = got["state"]
    return out


def friction_grain(set_, about):
    given = about["params"]
    feed = {"position": vectors(set_, "p"), "normal": vectors(set_, "n"),
            "grain": vectors(set_, "g"), "normal_force": set_["fn"]}
    common = {name: given[name] for name in ("d_max", "reference_load", *grain.COEFFICIENTS)}
    forms = {"stick": {}, "dahl": {"adhesion": "dahl"}, "dupont": {"adhesion": "dupont"},
             "slip": {"static_ratio": given["static_ratio_slip"]}}
    got = {name: grain.run({**common, **form}, feed) for name, form in forms.items()}
    got["tip"] = grain.soft_tip({"mu": given["mu_across"], "s_max": given["d_max"]}, feed)
    out = {}
    for name, run in got.items():
        for i, axis in enumerate("xyz"):
            out[f"f_{name}_{axis}"] = part(run["force"], i)
            out[f"d_{name}_{axis}"] = part(run["deflection"], i)
        out["state_" + name] = run["state"]
    return out


def cutting_(set_, about):
    got = cutting.run({}, {"depth": set_["delta"]})
    return {"f": got["resistance"], "crack": got["crack"], "state": got["state"],
            "U": got["stored_energy"], "dissipated": got["dissipated_energy"]}


def scissors_(set_, about):
    got = scissors.run({}, {"angle": set_["theta"]})
    return {"torque": got["torque"], "crack": got["crack_front"],
            "U": got["stored_energy"], "dissipated": got["dissipated_energy"]}


def texture_(set_, about):
    dt, given = about["T"], about["params"]
    feed = {"position": [(x, y, 0.0) for x, y in zip(set_["x"], set_["y"])]}
    on_line = {"position": on_x(set_["x"])}
    line = texture.grating({"amplitude": 0.3}, on_line)["value"]
    plane = texture.grating({"amplitude": 0.3, "spatial_frequency": 500.0,
                             "angle": math.atan2(400.0, 300.0)}, feed)["force"]
    guard = texture.antialias({}, on_line, dt)
    windowed = [w * g * y for w, g, y in zip(
        texture.window(set_["dz"], 5e-4), guard["gain"], line)]
    stretch = [given["d_max"] * (1.0 + given["mod"] * math.sin(400.0 * math.pi * x))
               for x in set_["x"]]
    drag = friction.run({"load": "passive", "stiffness": 0.4 / given["d_max"]},
                        {**on_line, "d_max": stretch,
                         "normal_force": [float(d > 0.0) for d in set_["dz"]]})
    return {"grating1d": line, "grating2d_x": part(plane, 0),
            "grating2d_y": part(plane, 1), "guard": guard["gain"],
            "v_diff": guard["speed"], "windowed": windowed,
            "filtered": texture.butterworth2(windowed, given["fc"], dt),
            "f_friction_mod": part(drag["force"], 0)}


def shock_(set_, about):
    got = shock.run({}, {"hit": set_["trigger_v"]}, about["T"])["resistance"]
    return {"f_semi_implicit": got, "f_exact": got}


def modal(set_, about):
    given, feed = about["params"], {"hit": set_["hit_v"]}
    modes = [{"amplitude": a, "decay": -b, "frequency": w / (2.0 * math.pi)}
             for a, b, w in given["modes_a_b_omega"]]
    wave = {"modes": modes, "rate": given["table_rate"],
            "length": given["table_length"]}
    table = {"samples": vibration.entries(wave, about["T"]), "rate": wave["rate"]}
    return {"y_modal": vibration.modal({"modes": modes}, feed, about["T"])["value"],
            "y_wavetable": vibration.wavetable(table, feed, about["T"])["value"]}


def passivity(set_, about):
    feed = {"position": on_x(set_["p"]), "force": on_x(set_["f_env"])}
    out = {"f_predictive": part(safety.hold({}, {"in": feed["force"]})["out"], 0)}
    for name, pairing in (("zoh", "zoh"), ("hr", "backward")):
        got = safety.passivity({"alpha_max": 12.0, "pairing": pairing}, feed,
                               about["T"])
        out["f_out_" + name] = part(got["force"], 0)
        out["E_" + name], out["alpha_" + name] = got["energy"], got["alpha"]
    return out


def wallsim(set_, about):
    dt, rows = about["T"], about["rows"]
    device = {"mass": 0.1, "damping": 2.0, "position": (-1e-3, 0.0, 0.0),
              "velocity": (0.1, 0.0, 0.0), "hand_force": (0.5, 0.0, 0.0)}
    facing = {"normal": (-1.0, 0.0, 0.0)}
    cases = {"smooth": ({}, {"stiffness": 3600.0}),
             "quant": ({"quantum": 1e-5}, {"stiffness": 1800.0}),
             "damped": ({}, {"stiffness": 1800.0, "damping": 0.4})}
    runs = {name: wall.simulate({**device, **extra}, wall.plane_tick(dt),
                                wall.PLANE, {**facing, **plane}, rows, dt)
            for name, (extra, plane) in cases.items()}
    coupled = {**facing, "stiffness": 2400.0, "damping": 0.2}
    runs["vc"] = wall.simulate(device, safety.coupling_tick(dt), safety.COUPLING,
                               coupled, rows, dt)
    out = {}
    for name, got in runs.items():
        for short, column in (("x", "position"), ("v", "velocity"), ("f", "force")):
            out[f"{short}_{name}"] = part(got[column], 0)
    return out


def deformation_(set_, about):
    given = about["params"]
    curves = [[[{law[0]: law[1:]} for law in node] for node in tool]
              for tool in given["curves_tool_node_axis"]]
    settings = {"surface": {"nodes": given["nodes"], "curves": curves,
                            "triangles": given["triangles"],
                            "frames": given["frames_rows_ux_uy_uz"],
                            "mu": given["mu_deflection"]}}
    feed = {"position": vectors(set_, "p"), "tool": set_["tool_weight"]}
    rubs = deformation.run(settings, {}, feed)
    slides = deformation.run(settings, {"friction": "frictionless"}, feed)
    out = {"tri": rubs["triangle"], "state": rubs["state"],
           "U": rubs["stored_energy"]}
    for i, axis in enumerate("xyz"):
        out["f_" + axis] = part(rubs["force"], i)
        out["c_" + axis] = part(rubs["contact"], i)
        out["g_" + axis] = part(slides["force"], i)
    return out


MODELS = {"friction_1d": friction_1d, "friction_bound": friction_bound,
          "friction_3d": friction_3d, "friction_grain": friction_grain,
          "cutting": cutting_, "scissors": scissors_, "texture": texture_,
          "shock": shock_, "modal": modal, "passivity": passivity,
          "wallsim": wallsim, "deformation": deformation_}
EXACT_ROWS = {"wallsim": 300}


def check(name):
    """Returns (worst error in units of its tolerance, column, row) for one golden set."""
    set_, about = read(name), tolerance.about(name)
    out = MODELS[name](set_, about)
    rows = EXACT_ROWS.get(name, about["rows"])
    found = []
    for column in about["expected"]:
        allowed = tolerance.entry(about, column)
        if "quant" in column:
            allowed = {"abs": 1e-6}
        most, row = tolerance.worst(set_[column][:rows], out[column][:rows],
                                    allowed)
        found.append((most, column, row))
    return max(found)


def remake(name):
    set_, about = read(name), tolerance.about(name)
    set_.update(MODELS[name](set_, about))
    columns = ["t", *about["inputs"], *about["expected"]]
    with open(tolerance.GOLDEN / f"{name}.csv", "w", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(columns)
        out.writerows([f"{x:.17g}" for x in row] for row in zip(*(set_[c] for c in columns)))


if __name__ == "__main__":
    for name_ in sys.argv[1:]:
        remake(name_)
