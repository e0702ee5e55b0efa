#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks framework/file/graph.schema.json: every preset and good example fits it, and each bad example does not.

Usage: schema_test.py SOURCE_FOLDER. Exit status 77 means skipped: python3-jsonschema is not installed."""

import copy
import json
import pathlib
import sys

try:
    import jsonschema
except ImportError:
    print("skipped: python3-jsonschema is not installed")
    sys.exit(77)

source = pathlib.Path(sys.argv[1])
schema = json.loads((source / "framework/file/graph.schema.json").read_text(encoding="utf-8"))
jsonschema.Draft202012Validator.check_schema(schema)
validator = jsonschema.Draft202012Validator(schema)

good = {
    "format": "tactus-graph", "version": 1, "name": "Dry wood", "tags": ["wood"], "rate_hz": 4000,
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
    "ui": {},
}

# A path into the good example, and what makes it bad there; None removes the key.
bad = [
    (["format"], "other"), (["format"], None), (["version"], 2), (["version"], None), (["name"], 3), (["tags"], "wood"),
    (["rate_hz"], 0), (["rate_hz"], "4 kHz"), (["devices", "Left"], {}), (["devices", "stylus"], "sim"), (["nodes"], []),
    (["nodes", "Hand"], {"type": "x"}), (["nodes", "hand", "type"], None), (["nodes", "hand", "type"], "graph:No"),
    (["nodes", "hand", "type"], "file:"), (["nodes", "hand", "role"], "Left"), (["nodes", "hand", "params"], {"d max": 1}),
    (["nodes", "grain", "count"], 0), (["nodes", "grain", "hold"], "slow"), (["nodes", "grain", "times"], 2), (["nodes", "grain", "bypass"], 1),
    (["nodes", "grain", "roles", "tip"], 3), (["nodes", "grain", "overrides", "phase"], 1), (["wires", 0], "a -> b"),
    (["wires", 0], "a.out => b.in"), (["wires", 0], "a.out -> [0] -> b.in"), (["wires", 2, "wire"], None),
    (["wires", 2, "gain"], "much"), (["wires", 2, "enabled"], 1), (["controls", "roughness", "value"], 2),
    (["controls", "roughness", "to", "amplitude"], [0, 1]), (["controls", "roughness", "to", "grain.amplitude"], [0]),
    (["graphs", "grain", "nodes", "wave"], {}), (["graphs", "grain", "expose", "inputs", "position"], "wave"),
    (["graphs", "Grain"], {}), (["ui"], 3),
]

failures = 0


def complain(text):
    global failures
    failures += 1
    print(text)


for error in validator.iter_errors(good):
    complain(f"the good example: {error.json_path}: {error.message}")

for path, value in bad:
    example = copy.deepcopy(good)
    inner = example
    for key in path[:-1]:
        inner = inner[key]
    if value is None:
        del inner[path[-1]]
    else:
        inner[path[-1]] = value
    if validator.is_valid(example):
        complain(f"fits although it is wrong: {path} = {value!r}")

presets = sorted((source / "graphs").rglob("*.json"))
for preset in presets:
    content = json.loads(preset.read_text(encoding="utf-8"))
    if content.get("format") != "tactus-graph":
        continue   # an asset of a preset, such as a table
    for error in validator.iter_errors(content):
        complain(f"{preset}: {error.json_path}: {error.message}")

print(f"{len(presets)} files in graphs/, {len(bad)} bad examples, {failures} failures")
sys.exit(1 if failures else 0)
