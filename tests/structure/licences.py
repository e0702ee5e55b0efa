#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that code under the MIT licence does not depend on code under the GPL: docs/decisions/mit_below_gpl.md.

Usage: licences.py [SOURCE_FOLDER]. Prints FILE: PROBLEM for each problem. Exit status 1 if there are any.

- Every source file has an SPDX line with one of the two licences. framework/, nodes/, graphs/ and docs/ are MIT.
- In host/ each folder is MIT or GPL as a whole, but for MIXED, where each file counts.
- tests/ is MIT, but for the tests of a folder under the GPL, and for files that include JUCE or a header under the GPL.
- A file under the MIT licence includes neither JUCE nor a header under the GPL. CARDS may include the modules of JUCE that are under the ISC
  licence."""

import pathlib
import re
import sys

MIT_PARTS = ["code", "devices", "drivers"]   # of host
MIT_ROOMS = ["base/command_line", "base/platform", "base/windows", "tools/check_plugin", "tools/fitting", "tools/reports"]
MIXED = ["base/assets", "base/files", "devices/osc", "tools/figures"]
GPL_TESTS = ["app", "cli", "tools/bench"]
CARDS = "host/devices/audio/juce_cards.cpp"
ISC = ("juce_core", "juce_events", "juce_audio_basics", "juce_audio_devices")
SOURCES = (".c", ".cpp", ".hpp", ".h", ".cmake", ".py", ".sh")
INCLUDE = re.compile(r'^\s*#\s*include\s*(?:"([^"]+)"|<([^>]+)>)', re.MULTILINE)


def licence(path):
    head = path.read_text(encoding="utf-8", errors="replace")[:300]
    found = re.search(r"SPDX-License-Identifier: (\S+)", head)
    return found[1] if found else ""


def should_be(root, path):
    """The licence that the folder asks for; "" if each file decides."""
    parts = path.parts
    if parts[0] == "tests":
        of_gpl = parts[1] == "host" and any(path.is_relative_to("tests/host/" + room) for room in GPL_TESTS)
        return "GPL-3.0-or-later" if of_gpl or any(is_gpl(root, what) for what in included(root, path)) else "MIT"
    if parts[0] in ("framework", "nodes", "graphs", "docs"):
        return "MIT"
    if parts[0] == "host" and len(parts) > 2:
        room = "/".join(parts[1:3])
        return "" if room in MIXED else "MIT" if parts[1] in MIT_PARTS or room in MIT_ROOMS else "GPL-3.0-or-later"
    return ""


def included(root, path):
    """What a file includes: a path in the sources, or the name of a foreign header."""
    for quoted, bracketed in INCLUDE.findall((root / path).read_text(encoding="utf-8", errors="replace")):
        name = quoted or bracketed
        for candidate in ([path.parent / quoted] if quoted else []) + [pathlib.PurePath(name)]:
            if (root / candidate).is_file():
                yield candidate
                break
        else:
            yield name


def is_gpl(root, what):
    """True for a header of JUCE or one under the GPL."""
    return licence(root / what) == "GPL-3.0-or-later" if isinstance(what, pathlib.PurePath) else what.split("/")[0].lower().startswith("juce")


def problems(root):
    for path in sorted(p.relative_to(root) for part in ("framework", "nodes", "host", "graphs", "docs", "tests") for p in (root / part).rglob("*")):
        if path.suffix not in SOURCES and path.name != "CMakeLists.txt" or not (root / path).is_file():
            continue
        own = licence(root / path)
        if own not in ("MIT", "GPL-3.0-or-later"):
            yield path, "has no SPDX line with MIT or GPL-3.0-or-later"
            continue
        if should_be(root, path) not in ("", own):
            yield path, f"is {own}, but should be {should_be(root, path)}"
        if own != "MIT" or path.suffix not in (".c", ".cpp", ".hpp", ".h"):
            continue
        for what in included(root, path):
            name = str(what)
            if "juce" in name.split("/")[0].lower() and not (str(path) == CARDS and name.split("/")[0] in ISC):
                yield path, f"includes {name}, which is JUCE's"
            elif isinstance(what, pathlib.PurePath) and licence(root / what) == "GPL-3.0-or-later":
                yield path, f"is MIT and includes {name}, which is under the GPL"


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[2])
    found = list(problems(root))
    for path, what in found:
        print(f"{path}: {what}")
    if not found:
        print("no file under the MIT licence depends on one under the GPL")
    return 1 if found else 0


sys.exit(main())
