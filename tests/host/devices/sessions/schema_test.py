#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks host/devices/sessions/session.schema.json: it accepts the example in the manual, and refuses each bad session.

Usage: schema_test.py SOURCE_FOLDER. Exit status 77 means skipped: python3-jsonschema is not installed."""

import pathlib
import sys

source = pathlib.Path(sys.argv[1])
sys.path.insert(0, str(source / "tests/support"))
sys.dont_write_bytecode = True
from schema_check import SchemaCheck, first_example   # noqa: E402

check = SchemaCheck(source / "host/devices/sessions/session.schema.json")
example = first_example(source / "docs/sessions.md")

# A path into the example and the bad value there; None removes the key.
bad = [
    (["format"], "tactus-graph"), (["version"], 2), (["version"], None),
     (["clock"], "A clock"), (["clock"], 3), (["roles"], []), (["roles", "Stylus"], {"driver": "sim"}),
    (["roles", "stylus"], "hid"), (["roles", "stylus", "driver"], None), (["roles", "stylus", "profile"], 3), (["roles", "stylus", "workspace", "scale"], 0),
    (["roles", "stylus", "workspace", "scale"], [2]),
     (["roles", "stylus", "workspace", "offset"], [0, 0]), (["roles", "stylus", "workspace", "offset", 2], "1 N"),
    (["roles", "stylus", "workspace", "axes"], ["x", "y"]), (["roles", "stylus", "workspace", "axes"], ["x", "y", "w"]),
    (["roles", "stylus", "workspace", "axes"], [[1, 0], "y", "z"]), (["roles", "stylus", "workspace", "clutch"], 3),
    (["roles", "stylus", "workspace", "angle"], 1), (["roles", "stylus", "guard"], 3), (["roles", "thumb", "path"], None), (["audio"], 3),
]

check.must_fit("the manual's example", example)
check.must_refuse("the manual's example with", example, bad)
check.must_fit("an unknown key", {**example, "tomorrow": 1, "audio": {"any": "thing"}})

check.finish(f"{len(bad)} invalid sessions")
