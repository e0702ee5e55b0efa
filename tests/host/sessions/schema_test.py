#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks host/sessions/session.schema.json: the example of the manual fits it, and each bad one does not.

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
schema = json.loads((source / "host/sessions/session.schema.json").read_text(encoding="utf-8"))
jsonschema.Draft202012Validator.check_schema(schema)
validator = jsonschema.Draft202012Validator(schema)
example = json.loads((source / "docs/sessions.md").read_text(encoding="utf-8").split("```json")[1].split("```")[0])

failures = [f"the manual's example: {e.json_path}: {e.message}" for e in validator.iter_errors(example)]
bad = [
    (["format"], "tactus-graph"), (["version"], 2), (["version"], None), (["clock"], "A clock"), (["clock"], 3), (["roles"], []), (["roles", "Stylus"], {"driver": "sim"}),
    (["roles", "stylus"], "hid"), (["roles", "stylus", "driver"], None), (["roles", "stylus", "profile"], 3), (["roles", "stylus", "workspace", "scale"], 0),
    (["roles", "stylus", "workspace", "scale"], [2]), (["roles", "stylus", "workspace", "offset"], [0, 0]), (["roles", "stylus", "workspace", "offset", 2], "1 N"),
    (["roles", "stylus", "workspace", "angle"], 1), (["roles", "stylus", "guard"], 3), (["roles", "thumb", "path"], None), (["audio"], 3),
]
for path, value in bad:
    changed = copy.deepcopy(example)
    inner = changed
    for key in path[:-1]:
        inner = inner[key]
    if value is None:
        del inner[path[-1]]
    else:
        inner[path[-1]] = value
    if validator.is_valid(changed):
        failures.append(f"fits although it is wrong: {path} = {value!r}")
known = {**example, "tomorrow": 1, "audio": {"any": "thing"}}
if not validator.is_valid(known):
    failures.append("a key that is not known yet does not fit")

print("\n".join(failures + [f"{len(bad)} bad ones, {len(failures)} failures"]))
sys.exit(1 if failures else 0)
