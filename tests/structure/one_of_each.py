#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that what must be done in one way only is done in one place.

Usage: one_of_each.py [SOURCE_FOLDER]. Prints FILE:LINE for each problem. Exit status 1 if there are any.

Each row of ONLY is a step of a live run, a pattern of the code that takes it, and the files where this may be. Each pattern must occur in
the first file, so that a row cannot rot. A row of WALK is the same for walking a plan, and one
of JSON for reading and writing JSON text; without files, the pattern may be nowhere."""

import pathlib
import re
import sys

SESSION = "host/devices/live/live_session.cpp"
ONLY = [
    ("choosing a clock", r"host::chooseClock \(", ["host/devices/live/role_devices.cpp"]),
    ("opening the device of a session", r"host::openBound \(", ["host/devices/live/role_devices.cpp"]),
    ("opening a real device", r"hid::openDevice \(", ["host/devices/live/hardware.cpp", "host/devices/sessions/awaited_device.cpp"]),
    ("opening the devices of a live run", r"running->openDevices \(", [SESSION]),
    ("making the clock of a device", r"make_unique<RunClock>", [SESSION]),
    ("starting the ticks", r"running->start \(", [SESSION]),
    ("starting a log", r"startLog \(", [SESSION]),
    ("looking at alarms of the failsafe", r"Failsafe::alarms \(|Failsafe::alarms\(\)(?! noexcept)", [SESSION]),
    ("arming a device", r"= Failsafe::arm \(", ["host/devices/hid_link/hidapi_system.cpp", "host/devices/hid_link/wires.cpp", "host/devices/device_plugins/driver_about.cpp"]),
    ("rearming a run", r"engine\(\)\.rearm\(\)", [SESSION]),
    ("editing what a live run plays", r"\b(session->|live\.)edit \(", ["host/app/run/live_run.cpp", "host/devices/live/c_session.cpp"]),   # these, see force_causes.hpp
    ("turning a control of a live run", r"tactus::turnControl \(", ["host/app/run/live_run.cpp", "host/cli/play/remote.hpp", "host/devices/live/c_session.cpp"]),
    ("a hit in a live run", r"tactus::strike \(", ["host/app/run/live_run.cpp", "host/cli/play/remote.hpp", "host/devices/live/c_session.cpp"]),
    ("stopping an engine", r"engine\(\)\.emergencyStop\(\)", [SESSION]),
    ("watching the health of devices", r"= HealthWatch \{", [SESSION]),
    ("fusing what runs", r"fusing->poll \(", [SESSION]),
]

WALK = [
    ("telling what a record of a plan does", r"[!=]= ?&plan::\w+::\w+|\{ ?&plan::\w+::step", ["host/code/generate/walk/visit_record.hpp"]),
    ("ordering what the converters of a section do", r"each \(Action::", ["host/code/generate/walk/plan_walk.cpp"]),
    ("ordering what a driven node does", r"\bupdateIfMoved \(n", ["host/code/generate/walk/plan_walk.cpp"]),
    ("writing the inputs of a node in C++", r"inOrder \(std::move", ["host/code/generate/walk/cpp_walk.cpp"]),
]

TEXT, CLIPS = "framework/text/", "framework/file/clips/"
JSON = [
    ("a reader of JSON text", r"^\s*(class|struct) (?i:json)\w*(Reader|Parser|Scanner|Tokeni[sz]er|Lexer)\b",
     [TEXT + "json_reader.cpp", TEXT + "json_scanner.hpp"]),
    ("reading JSON text with the scanner", r"#include .*json_scanner\.hpp", [TEXT + "json_reader.cpp"]),
    ("understanding escapes in JSON text", r"(case|peek\(\) [=!]=) 'u'", [TEXT + "json_scanner.hpp"]),
    ("escaping characters in JSON text", r"\\\\u[0-9a-fA-F%]", [TEXT + "json_writer.cpp", TEXT + "json_reader.cpp"]),
    ("accepting what JSON does not allow", r"readRelaxedJson \(", [CLIPS + "relaxed_json.cpp", CLIPS + "relaxed_json.hpp", CLIPS + "clip_json.cpp"]),
    ("another library for JSON", r"juce::JSON|nlohmann|rapidjson|simdjson|boost/json|jsoncpp|json-c/", []),
]

# Each table, with the parts of the project that it is about.
TABLES = [(ONLY, ["host"]), (WALK, ["host"]), (JSON, ["framework", "nodes", "host"])]


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[2])
    found = []
    for table, parts in TABLES:
        texts = {path.relative_to(root).as_posix(): path.read_text(encoding="utf-8").splitlines()
                 for part in parts for path in (root / part).rglob("*.[ch]pp")}
        for what, pattern, allowed in table:
            if allowed and not any(re.search(pattern, line) for line in texts.get(allowed[0], [])):
                found.append(f"{allowed[0]}: {what} is no longer here; correct the row of one_of_each.py")
            for name, lines in sorted(texts.items()):
                found += [f"{name}:{number}: {what} belongs {'in ' + allowed[0] if allowed else 'nowhere'}" for number, line in enumerate(lines, 1)
                          if name not in allowed and re.search(pattern, line) and not line.lstrip().startswith("///")]
    print("\n".join(found) or f"{len(ONLY)} steps of a live run, {len(WALK)} of a walk over a plan and {len(JSON)} of JSON have one place each")
    return 1 if found else 0


sys.exit(main())
