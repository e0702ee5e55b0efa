#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks the schema that `tactus schema` prints: it accepts every graph of the project that `tactus validate` accepts, and refuses bad
examples of its own and most of 36 mistakes in the meaning of a graph.

Usage: schema_test.py SOURCE_FOLDER TACTUS. Exit status 77 means skipped: python3-jsonschema is not installed."""

import copy
import json
import pathlib
import re
import subprocess
import sys
import tempfile

source, tactus = pathlib.Path(sys.argv[1]), sys.argv[2]
sys.path.insert(0, str(source / "tests/support"))
sys.dont_write_bytecode = True
from schema_check import SchemaCheck, changed, read_json   # noqa: E402

scratch = tempfile.TemporaryDirectory()
folder = pathlib.Path(scratch.name)
(folder / "graph.schema.json").write_text(subprocess.run([tactus, "schema"], check=True, capture_output=True, text=True).stdout, encoding="utf-8")
check = SchemaCheck(folder / "graph.schema.json")


def validated(path):
    """What `tactus validate` says about a file: True if there are no errors, and its messages."""
    ran = subprocess.run([tactus, "validate", path], capture_output=True, text=True, errors="replace")
    return ran.returncode == 0, ran.stderr


# The structure of a file.

good = {
    "$schema": "graph.schema.json", "format": "tactus-graph", "version": 2, "name": "Dry wood", "tags": ["wood"], "rate_hz": 4000,
    "devices": {"stylus": {"driver": "sim"}},
    "nodes": {
        "hand": {"type": "device.position", "role": "stylus", "colour": "red"},
        "grain": {"type": "graph:grain", "count": 2, "roles": {"tip": ["thumb", "index"], "base": "palm"},
                  "overrides": {"wave.phase": 1, "[1]/wave.phase": "3 rad"}, "every": 2, "hold": "linear"},
        "other": {"type": "file:parts/other.json"},
    },
    "wires": ["hand.position -> grain.position", "grain[1]/wave.value -> [2] -> (+) grain.amplitude",
              {"wire": "mix.in[2].x->grain.x", "gain": "1e-4 m/N", "enabled": False, "ui": {}}],
    "controls": {"roughness": {"name": "Roughness", "value": 0.5, "to": {"grain.amplitude": [0, "0.12 N"]}}},
    "graphs": {"grain": {"nodes": {"wave": {"type": "texture.grating"}}, "wires": [],
                         "expose": {"inputs": {"position": "wave.position"}, "params": {"amplitude": "wave.amplitude"}}}},
    "ui": {}, "notes of mine": "kept",
}

# A path into the good example and the bad value there; None removes the key.
bad = [
    (["format"], "other"), (["format"], None), (["version"], 1), (["version"], None), (["name"], 3), (["tags"], "wood"),
    (["rate_hz"], 0), (["rate_hz"], "4 kHz"), (["devices", "Left"], {}), (["devices", "stylus"], "sim"), (["nodes"], []),
    (["nodes", "Hand"], {"type": "x"}), (["nodes", "hand", "type"], None), (["nodes", "hand", "type"], "graph:No"),
    (["nodes", "hand", "type"], "file:"), (["nodes", "hand", "role"], "Left"), (["nodes", "hand", "params"], {"d max": 1}),
    (["nodes", "grain", "count"], 0), (["nodes", "grain", "hold"], "slow"), (["nodes", "grain", "times"], 2), (["nodes", "grain", "bypass"], 1),
    (["nodes", "grain", "roles", "tip"], 3), (["nodes", "grain", "overrides", "phase"], 1), (["wires", 0], "a -> b"),
    (["wires", 0], "a.out => b.in"), (["wires", 0], "a.out -> [0] -> b.in"), (["wires", 2, "wire"], None),
    (["wires", 2, "gain"], "much"), (["wires", 2, "enabled"], 1), (["controls", "roughness", "value"], 2),
    (["controls", "roughness", "to", "amplitude"], [0, 1]), (["controls", "roughness", "to", "grain.amplitude"], [0]),
    (["graphs", "grain", "nodes", "wave"], {}), (["graphs", "grain", "expose", "inputs", "position"], "wave"),
    (["graphs", "Grain"], {}), (["ui"], 3), (["$schema"], 2),
]

check.must_fit("the good example", good)
check.must_refuse("the good example with", good, bad)

# Mistakes in the meaning. `tactus validate` finds all of them.

plain = {
    "format": "tactus-graph", "version": 2, "name": "Board",
    "devices": {"stylus": {"driver": "sim", "mass": "50 g", "damping": 2.0, "hand": {"stiffness": 100, "path": "stroke"},
                           "guard": {"max_force": "3 N", "watchdog": "50 ms"}}},
    "nodes": {
        "hand": {"type": "device.position", "role": "stylus"},
        "board": {"type": "deform.plane", "params": {"stiffness": "2 N/mm", "damping": "2 N*s/m", "normal": [0, 0, 1]},
                  "settings": {"window": "1 ms"}},
        "drag": {"type": "friction.elasto_plastic", "params": {"mu": 0.4, "d_max": "0.4 mm", "adhesion": "stick"}},
        "sum": {"type": "signal.mix", "settings": {"inputs": 2}},
        "motor": {"type": "device.force", "role": "stylus"},
    },
    "wires": ["hand.position -> board.position", "hand.position -> drag.position", "board.resistance -> sum.in[0]", "sum.out -> drag.normal_force",
              "board.force -> motor.force", "drag.force -> motor.force"],
    "controls": {"dry": {"value": 0.5, "to": {"drag.mu": [0.2, 0.6]}}},
}

nested = copy.deepcopy(plain)
nested["nodes"]["grain"] = {"type": "graph:grain", "params": {"amplitude": "60 mN"}, "overrides": {"wave.phase": 1}}
nested["wires"] += ["hand.position -> grain.position", "grain.force -> motor.force"]
nested["graphs"] = {"grain": {"nodes": {"wave": {"type": "texture.grating", "params": {"spatial_frequency": "600 1/m"}}}, "wires": [],
                              "expose": {"inputs": {"position": "wave.position"}, "outputs": {"force": "wave.force"},
                                         "params": {"amplitude": "wave.amplitude"}}}}

board, drag, stylus = ["nodes", "board"], ["nodes", "drag"], ["devices", "stylus"]
seen_by_the_schema = [
    ("a type that is misspelt", plain, drag + ["type"], "friction.elastoplastic"),
    ("a type in the wrong case", plain, board + ["type"], "deform.Plane"),
    ("a parameter that is misspelt", plain, drag + ["params"], {"dmax": "0.4 mm"}),
    ("a parameter of another type", plain, drag + ["params", "damping"], 1.0),
    ("a setting among the parameters", plain, board + ["params", "window"], "1 ms"),
    ("a parameter among the settings", plain, board + ["settings", "offset"], 0.0),
    ("a setting that is misspelt", plain, board + ["settings"], {"windows": "1 ms"}),
    ("a unit that is misspelt", plain, drag + ["params", "d_max"], "0.4 milimeter"),
    ("a force for a stiffness", plain, board + ["params", "stiffness"], "2 N"),
    ("a stiffness for a damping", plain, board + ["params", "damping"], "2 N/m"),
    ("a negative friction", plain, drag + ["params", "mu"], -0.4),
    ("a stretch of nothing", plain, drag + ["params", "d_max"], 0),
    ("a choice that is misspelt", plain, drag + ["params", "adhesion"], "stik"),
    ("a choice by number", plain, drag + ["params", "adhesion"], 1),
    ("a vector of two numbers", plain, board + ["params", "normal"], [0, 1]),
    ("a word for a number", plain, drag + ["params", "mu"], "high"),
    ("half an input", plain, ["nodes", "sum", "settings", "inputs"], 2.5),
    ("an unknown law", plain, board + ["settings", "law"], {"pow": [2000, 1]}),
    ("a device node without a role", plain, ["nodes", "motor", "role"], None),
    ("instances of a plain node", plain, board + ["count"], 2),
    ("a rate for a plain node", plain, board + ["every"], 2),
    ("a driver that is misspelt", plain, stylus + ["driver"], "simm"),
    ("a gesture that is misspelt", plain, stylus + ["hand", "path"], "strok"),
    ("a key of a device that is misspelt", plain, stylus + ["dampening"], 2.0),
    ("a mass in newtons", plain, stylus + ["mass"], "50 N"),
    ("a limit that is misspelt", plain, stylus + ["guard"], {"maxforce": "3 N"}),
    ("a limit of energy without its time", plain, stylus + ["guard", "max_energy"], "50 mJ"),
    ("a wire from an output that no node has", plain, ["wires", 5], "drag.forse -> motor.force"),
    ("a control of a parameter that no node has", plain, ["controls", "dry", "to"], {"drag.muu": [0.2, 0.6]}),
]
seen_by_validate_alone = [
    ("a wire from an unknown node", plain, ["wires", 0], "hnad.position -> board.position"),
    ("a position for a force", plain, ["wires", 5], "hand.position -> motor.force"),
    ("a vector for a number", plain, ["wires", 3], "board.force -> drag.normal_force"),
    ("a role without a device", plain, ["nodes", "motor", "role"], "stilus"),
    ("a subgraph that is misspelt", nested, ["nodes", "grain", "type"], "graph:grian"),
    ("an override that is misspelt", nested, ["nodes", "grain", "overrides"], {"wave.phas": 1}),
    ("a control in other units", nested, ["controls", "dry", "to"], {"grain.amplitude": [0, "1 mm"]}),
]

for name, graph in (("plain", plain), ("nested", nested)):
    check.must_fit(name, graph)
    (folder / "graph.json").write_text(json.dumps(graph), encoding="utf-8")
    if validated(folder / "graph.json") != (True, ""):
        check.complain(f"the graph of the mistakes has some of its own: {name}: {validated(folder / 'graph.json')}")

mistakes, seen = seen_by_the_schema + seen_by_validate_alone, 0
for name, graph, path, value in mistakes:
    wrong = changed(graph, path, value)
    (folder / "wrong.json").write_text(json.dumps(wrong), encoding="utf-8")
    if validated(folder / "wrong.json") == (True, ""):
        check.complain(f"`tactus validate` accepts {name}")
    caught = not check.validator.is_valid(wrong)
    seen += caught
    if caught != ((name, graph, path, value) in seen_by_the_schema):
        check.complain(f"the schema {'refuses' if caught else 'accepts'} {name}")
if len(mistakes) != 36 or seen < 25:
    check.complain(f"the schema sees {seen} of {len(mistakes)} mistakes; 25 of 36 should be seen")

# Units: the schema accepts the strings that are quantities of the right dimension.

for row, right, wrong in [
        (board + ["params", "stiffness"], ["2 N/mm", "2N/mm", "1e3 N/m", "+2 kN/m", "2 kg/s2", "2 kg*s^-2", "2 J/m2", "2 N*mm/mm2", "2 1/m N", ".5 N/m", "2. N/m"],
         ["2 N", "2 N*m", "2 N/mn", "N/mm", "2 N//mm", "2,5 N/mm", "-2 N/mm", "2 Hz"]),
        (drag + ["params", "d_max"], ["0.4 mm", "400 um", "400 \u00b5m", "400 \u03bcm", "4e-4 m", "1 m2/m", "1 m/s s", "1 N/Pa/m", "5 m %", "1 m^1", "4e5 mm3/mm2", "1 m/rad"],
         ["4e-4", "0.4 mn", "0.4 N", "4 1/m", "4 m2", "0.4 inch", "", "-1 mm"]),
        (drag + ["params", "mu"], ["0.4", "40 %", "1 mm/mm", "0.4 N/N"], ["0.4 N", "40 percent"]),
        (["devices", "stylus", "guard", "max_force"], ["3 N", "3000 mN", 3, "3 kg m/s2", "3 J/m"], ["3 kg", "3 N/m", -3, True]),
]:
    for value in right:
        check.must_fit(f"{row[-1]} = {value!r}", changed(plain, row, value))
        (folder / "unit.json").write_text(json.dumps(changed(plain, row, value)), encoding="utf-8")
        if not validated(folder / "unit.json")[0]:
            check.complain(f"`tactus validate` refuses {row[-1]} = {value!r}")
    check.must_refuse("a unit:", plain, [(row, value) for value in wrong])

# No false alarm: every graph of the project without errors fits, also those in the pages.

graphs = 0
for path in sorted(path for top in ("graphs", "docs", "tests", "host") for path in (source / top).rglob("*.json")):
    content = read_json(path) if b"tactus-graph" in path.read_bytes()[:2000] else None
    if isinstance(content, dict) and content.get("format") == "tactus-graph" and "corpus" not in path.parts and validated(path)[0]:
        graphs += 1
        check.must_fit(path.relative_to(source), content)
        if found := re.findall(r".*\[(?:param/unusual|node/no_effect)\]", validated(path)[1]):
            check.complain(f"{path}: {found}")
for page in sorted([*(source / "docs").rglob("*.md"), source / "README.md"]):
    for block in re.findall(r"```json\n(.*?)```", page.read_text(encoding="utf-8"), re.S):
        if '"tactus-graph"' not in block:
            continue
        (folder / "page.json").write_text(block, encoding="utf-8")
        if validated(folder / "page.json")[0]:
            graphs += 1
            check.must_fit(page.name, json.loads(block))
kept = 0
for path in sorted((source / "tests/fuzz/corpus/graph").iterdir()):   # files that once broke the readers; some are graphs
    try:
        content = json.loads(path.read_bytes().decode())
    except (ValueError, RecursionError):
        continue
    if isinstance(content, dict) and content.get("version") == 2 and validated(path) == (True, ""):
        kept += 1
        check.must_fit(path.relative_to(source), content)

check.finish(f"{graphs} graphs and {kept} inputs of fuzzers fit, {len(bad)} bad examples, {seen} of {len(mistakes)} mistakes are seen")
