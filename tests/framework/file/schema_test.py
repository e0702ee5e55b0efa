#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks framework/file/graph.schema.json: it accepts every preset and a good example, and refuses each bad example.

Usage: schema_test.py SOURCE_FOLDER. Exit status 77 means skipped: python3-jsonschema is not installed."""

import pathlib
import sys

source = pathlib.Path(sys.argv[1])
sys.path.insert(0, str(source / "tests/support"))
sys.dont_write_bytecode = True
from schema_check import SchemaCheck, read_json   # noqa: E402

check = SchemaCheck(source / "framework/file/graph.schema.json")

good = {
    "format": "tactus-graph", "version": 2, "name": "Dry wood", "tags": ["wood"], "rate_hz": 4000,
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
    (["graphs", "Grain"], {}), (["ui"], 3),
]

check.must_fit("the good example", good)
check.must_refuse("the good example with", good, bad)

presets = sorted((source / "graphs").rglob("*.json"))
for preset in presets:
    content = read_json(preset)
    if content.get("format") == "tactus-graph":   # all other files are assets of a preset, such as tables
        check.must_fit(preset, content)

check.finish(f"{len(presets)} files in graphs/, {len(bad)} bad examples")
