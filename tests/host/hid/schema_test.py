#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks host/profiles/profile.schema.json: every profile and the example of the manual fit it, and each bad one does not.

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

folder = pathlib.Path(sys.argv[1]) / "host/profiles"
schema = json.loads((folder / "profile.schema.json").read_text(encoding="utf-8"))
jsonschema.Draft202012Validator.check_schema(schema)
validator = jsonschema.Draft202012Validator(schema)

# A profile, a path into it, and what makes it bad there; None removes the key.
bad = {
    "tactus_board": [
        (["format"], "other"), (["version"], 2), (["id"], "Board"), (["id"], None), (["name"], ""), (["match"], None), (["match", 0, "vid"], "16c0"),
        (["match", 0, "bus"], "serial"), (["match", 0], {"pid": 3}), (["inputs", 0, "length"], 0), (["inputs", 0, "length"], "64"), (["inputs", 0, "verified"], None),
        (["inputs", 0, "why_not"], None), (["inputs", 0, "fields", 0, "type"], "u33"), (["inputs", 0, "fields", 0, "type"], "u12be"),
        (["inputs", 0, "fields", 0, "type"], "f32"), (["inputs", 0, "fields", 0, "at"], -1), (["inputs", 0, "fields", 0, "name"], None),
        (["inputs", 0, "fields", 0, "colour"], "red"), (["inputs", 0, "fields", 0, "unwrap"], 1), (["outputs", 0, "neutral"], None),
        (["outputs", 0, "neutral"], "5"), (["outputs", 0, "neutral"], "zz"), (["outputs", 0, "fields", 0, "source"], "input"),
        (["outputs", 0, "fields", 2, "name"], None), (["outputs", 0, "crc32", "at"], None), (["position"], ["x", "y"]), (["position", 0], 3),
        (["limits", "max_forse"], "3 N"), (["limits", "max_force"], [3]), (["sources"], []), (["samples", 0, "input"], []), (["samples", 0, "input"], ["0"]),
        (["axes"], ["x", "y", "up"]), (["colour"], "red"),
    ],
    "woodenhaptics_usb": [
        (["kinematics", "serial", "links"], [1, 2]), (["kinematics", "serial", "links", 0], 0), (["kinematics", "serial", "drives", 0, "body"], None),
        (["kinematics", "linear"], {"matrix": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}), (["kinematics", "serial", "drives", 0, "counts_per_turn"], None),
    ],
    "switch_controllers": [
        (["outputs", 0, "sequences", 0, "modulo"], 10), (["outputs", 0, "fields", 0, "table"], "amplitude"), (["tables", "amplitude", "x"], None), (["init", 0, "bytes"], None),
        (["init", 0, "kind"], "input"),
    ],
    "dualsense_bluetooth_samples": [
        (["outputs", 1, "stream", "channels"], []), (["outputs", 1, "stream", "type"], "s12"), (["inputs", 0, "fields", 7, "hat"], ["up"]),
    ],
}

failures = 0


def complain(text):
    global failures
    failures += 1
    print(text)


def changed(profile, path, value):
    example = copy.deepcopy(profile)
    inner = example
    for key in path[:-1]:
        inner = inner[key]
    if value is None:
        del inner[path[-1]]
    else:
        inner[path[-1]] = value
    return example


profiles = {path.stem: json.loads(path.read_text(encoding="utf-8")) for path in sorted(folder.glob("*.json")) if path.stem != "profile.schema"}
manual = (folder.parents[1] / "docs/devices.md").read_text(encoding="utf-8")
profiles["docs/devices.md"] = json.loads(manual.split("```json")[1].split("```")[0])
for name, profile in profiles.items():
    for error in validator.iter_errors(profile):
        complain(f"{name}: {error.json_path}: {error.message}")

for name, changes in bad.items():
    for path, value in changes:
        if validator.is_valid(changed(profiles[name], path, value)):
            complain(f"fits although it is wrong: {name} {path} = {value!r}")

print(f"{len(profiles)} profiles, {sum(map(len, bad.values()))} bad ones, {failures} failures")
sys.exit(1 if failures or not profiles else 0)
