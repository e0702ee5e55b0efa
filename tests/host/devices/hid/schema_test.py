#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks host/devices/profiles/profile.schema.json: it accepts every profile and the example in the manual, and refuses each bad profile.

Usage: schema_test.py SOURCE_FOLDER. Exit status 77 means skipped: python3-jsonschema is not installed."""

import pathlib
import sys

source = pathlib.Path(sys.argv[1])
sys.path.insert(0, str(source / "tests/support"))
sys.dont_write_bytecode = True
from schema_check import SchemaCheck, first_example, read_json   # noqa: E402

folder = source / "host/devices/profiles"
check = SchemaCheck(folder / "profile.schema.json")

# For each profile: a path into it and the bad value there; None removes the key.
bad = {
    "tactus_board": [
        (["format"], "other"), (["version"], 2), (["id"], "Board"), (["id"], None), (["name"], ""), (["match", 0, "vid"], "16c0"),
        (["match", 0, "bus"], "serial"), (["match", 0], {"pid": 3}), (["inputs", 0, "length"], 0), (["inputs", 0, "length"], "64"),
         (["inputs", 0, "verified"], None),
        (["inputs", 0, "why_not"], None), (["inputs", 0, "fields", 0, "type"], "u33"), (["inputs", 0, "fields", 0, "type"], "u12be"),
        (["inputs", 0, "fields", 0, "type"], "f32"), (["inputs", 0, "fields", 0, "at"], -1), (["inputs", 0, "fields", 0, "name"], None),
        (["inputs", 0, "fields", 0, "colour"], "red"), (["inputs", 0, "fields", 0, "unwrap"], 1), (["outputs", 0, "neutral"], None),
        (["outputs", 0, "neutral"], "5"), (["outputs", 0, "neutral"], "zz"), (["outputs", 0, "fields", 0, "source"], "input"),
        (["outputs", 0, "fields", 2, "name"], None), (["outputs", 0, "crc32", "at"], None), (["position"], ["x", "y"]), (["position", 0], 3),
        (["limits", "max_forse"], "3 N"), (["limits", "max_force"], [3]), (["sources"], []), (["samples", 0, "input"], []), (["samples", 0, "input"], ["0"]),
        (["axes"], ["x", "y", "up"]), (["colour"], "red"),
        (["wires"], {}), (["wires", "smoke"], {}), (["wires", "serial", "filler"], -1), (["wires", "serial", "framing"], None), (["wires", "serial", "framing"], "slip"),
        (["wires", "serial", "baud"], "fast"), (["wires", "udp"], 9750),
        (["alarms", 0, "field"], None), (["alarms", 0, "means"], "smoke"), (["alarms", 0, "means"], None), (["alarms", 2, "is"], -1), (["alarms", 0, "if"], 1),
    ],
    "woodenhaptics_usb": [
        (["match"], None),
        (["kinematics", "serial", "links"], [1, 2]), (["kinematics", "serial", "links", 0], 0), (["kinematics", "serial", "drives", 0, "body"], None),
        (["kinematics", "linear"], {"matrix": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}), (["kinematics", "serial", "drives", 0, "counts_per_turn"], None),
    ],
    "switch_controllers": [
        (["outputs", 0, "sequences", 0, "modulo"], 10), (["outputs", 0, "fields", 0, "table"], "amplitude"),
         (["tables", "amplitude", "x"], None), (["init", 0, "bytes"], None),
        (["init", 0, "kind"], "input"),
    ],
    "numbers_only": [
        (["physics"], None), (["physics"], {}), (["physics", "weight"], "75 g"), (["physics", "mass"], [1]), (["physics", "damping", "guess"], False),
        (["physics", "damping", "value"], None), (["physics", "damping", "colour"], "red"), (["physics", "workspace", "min"], None),
        (["physics", "workspace", "source"], None), (["match"], [{"vid": "0x1209"}]),
    ],
    "dualsense_bluetooth_samples": [
        (["outputs", 1, "stream", "channels"], []), (["outputs", 1, "stream", "type"], "s12"), (["inputs", 0, "fields", 7, "hat"], ["up"]),
    ],
}

profiles = {path.stem: read_json(path) for path in sorted(folder.glob("*.json")) if path.stem != "profile.schema"}
if not profiles:
    check.complain(f"there are no profiles in {folder}")
profiles["numbers_only"] = {
    "format": "tactus-profile", "version": 1, "id": "arm", "name": "Arm", "sources": ["a test"],
    "physics": {"mass": "75 g", "damping": {"value": 0.1, "guess": True}, "workspace": {"min": [0, 0, 0], "max": [1, 1, 1], "source": "a test"}},
}
profiles["docs/devices.md"] = first_example(source / "docs/devices.md")
for name, profile in profiles.items():
    check.must_fit(name, profile)
for name, changes in bad.items():
    check.must_refuse(name, profiles[name], changes)

check.finish(f"{len(profiles)} profiles, {sum(map(len, bad.values()))} invalid profiles")
