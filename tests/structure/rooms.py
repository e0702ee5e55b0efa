#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that includes follow the order of the folders.

Usage: rooms.py [SOURCE_FOLDER]. Prints FILE:LINE for each problem. Exit status 1 if there are any.

- host includes nodes and framework, and nodes includes framework, never the other way round.
- Within framework/, includes point downwards only, in the order of LAYERS.
- The parts of host include those that HOST lists for them, and no others. A driver includes no more of Tactus than DRIVERS lists.
- Folders do not form a ring. A folder such as framework/plan, nodes/cut or host/devices/hid counts as one, together with its rooms, which are
  its subfolders. host/cli counts as one.
- docs/architecture.md, "Rooms and doors": if it lists a room of a folder, it lists all of them, each with its doors, which are the headers that
  others include. The doors of a folder such as host/devices/hid are the headers that other parts of host include. The page also lists the
  folders that have more than MOST_FILES files.
- The folders of MODELS include no header of a component.
- A panel of the window is a folder of host/app with a file panel.cpp, which defines a function `Panel NAME (Desk&)`. The list PANELS names each of
  these functions once, and no other file of host does. No panel includes another panel, and no other folder includes a component of a panel."""

import pathlib
import re
import sys

LAYERS = ["text", "kit", "fit", "node", "plugin", "examine", "graph", "plan", "file", "run", "check", "capi", "python"]   # lowest first
PARTS = ["framework", "nodes", "host"]                             # the same for the parts of the project
HOST = {"base": set(), "code": {"base"}, "devices": {"base", "code"}, "drivers": {"base", "devices"}, "tools": {"base", "code", "devices", "drivers"},
        "cli": {"base", "code", "devices", "drivers", "tools"}, "app": {"base", "code", "devices", "drivers", "tools"}}
DRIVERS = ["base/platform/peer_lock.hpp", "base/platform/wire_file.hpp", "devices/device_plugins/driver_answer.hpp", "devices/device_plugins/tactus_device.h",
           "devices/hid/calibration.hpp", "devices/hid/usb_adapter.hpp", "devices/hid/vibration_tracker.hpp"]
MODELS = {pathlib.PurePath("host/app", name) for name in ("model", "run", "storage", "text")}   # what runs without a component
PANELS = pathlib.PurePath("host/app/window/panels.hpp")
PAGE = "docs/architecture.md"
MOST_FILES = 40

INCLUDE = re.compile(r'^\s*#\s*include\s*(?:"([^"]+)"|<([^>]+)>)')


def sources(root):
    for part in PARTS:
        for path in sorted((root / part).rglob("*")):
            if path.suffix in (".hpp", ".cpp"):
                yield path.relative_to(root)


def includes(root, file):
    """Each included file of the project, with its line."""
    for number, line in enumerate((root / file).read_text(encoding="utf-8").splitlines(), 1):
        match = INCLUDE.match(line)
        if not match:
            continue
        quoted, bracketed = match.groups()
        candidates = [file.parent / quoted, pathlib.PurePath(quoted)] if quoted else [in_the_tree(bracketed)]
        for candidate in candidates:
            target = (root / candidate).resolve()
            if target.is_file() and root in target.parents:
                yield number, target.relative_to(root)
                break


def in_the_tree(header):
    """The path in the sources of a header that an installed Tactus has under this name."""
    if header.startswith("tactus/nodes/"):
        return pathlib.PurePath(header.removeprefix("tactus/"))
    return pathlib.PurePath("framework" + header.removeprefix("tactus") if header.startswith("tactus/") else header)


def house(path):
    """What counts as one folder: a folder with its rooms, in framework/, nodes/ and in the parts of host."""
    return pathlib.PurePath(*path.parent.parts[:3 if path.parts[0] == "host" and path.parts[1] != "cli" else 2])


def part(path):
    """The part of host that a file belongs to, such as host/devices."""
    return pathlib.PurePath(*path.parts[:2])


def level(path, order, depth):
    name = path.parts[depth] if len(path.parts) > depth + 1 else None
    return order.index(name) if name in order else None


def points_upwards(file, target):
    """The reason why an include is not allowed, or None."""
    here, there = PARTS.index(file.parts[0]), PARTS.index(target.parts[0]) if target.parts[0] in PARTS else None
    if there is None:
        return f"{file.parts[0]} must not include {target.parts[0]}"
    if there > here:
        return f"{PARTS[here]} must not include {PARTS[there]}"
    if file.parts[0] == "host" and target.parts[0] == "host":
        return not_for_part(file, target)
    if file.parts[0] != "framework" or target.parts[0] != "framework":
        return None
    below, above = level(file, LAYERS, 1), level(target, LAYERS, 1)
    if below is None or above is None:
        return "framework/ has a folder that LAYERS does not list; add it to LAYERS in rooms.py"
    return f"{LAYERS[below]} must not include {LAYERS[above]}" if above > below else None


def not_for_part(file, target):
    """The reason why a file of host may not include another one, or None."""
    here, there = file.parts[1], target.parts[1]
    if here not in HOST:
        return f"host/ has a part that HOST does not list: {here}; put the file into one of {', '.join(HOST)}"
    if here != there and there not in HOST[here]:
        return f"host/{here} must not include host/{there}"
    if here == "drivers" != there and target.relative_to("host").as_posix() not in DRIVERS:
        return "a driver needs tactus_device.h and the headers of DRIVERS in rooms.py"
    return None


def shortest_ring(start, edges):
    """The folders of the shortest ring through a folder, or None."""
    reached_from = {}
    queue = [start]
    for folder in queue:
        for target in sorted(edges.get(folder, {})):
            if target == start:
                ring = [folder]
                while ring[-1] != start:
                    ring.append(reached_from[ring[-1]])
                return ring[::-1]
            if target not in reached_from:
                reached_from[target] = folder
                queue.append(target)
    return None


def listed_rooms(root):
    """The rows of the two tables of the page: the doors of each room, and the folders that may be large; each with its line."""
    rooms, large, in_section = {}, {}, False
    for number, line in enumerate((root / PAGE).read_text(encoding="utf-8").splitlines(), 1):
        if line.startswith("## "):
            in_section = line == "## Rooms and doors"
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if not in_section or not cells[0].startswith("`"):
            continue
        folder = pathlib.PurePath(cells[0].strip("`"))
        if len(cells) == 3:
            rooms[folder] = number, set(re.findall(r"`([^`]+)`", cells[2]))
        elif cells[1]:
            large[folder] = number
    return rooms, large


def wrong_doors(root, files, all_includes):
    """What the page says about rooms that is not so."""
    rooms, large = listed_rooms(root)
    folders = {}
    for file in files:
        folders.setdefault(file.parent, []).append(file)
    problems = [] if rooms else [f"{PAGE}: no room is listed under \"Rooms and doors\""]
    for room, (line, doors) in rooms.items():
        inside = part(room) if len(room.parts) == 3 and room.parts[0] == "host" else room
        used = {target.relative_to(room).as_posix() for file, _, target in all_includes if room in target.parents and inside not in file.parents}
        problems += [f"{PAGE}:{line}: {room} has another door: {name}" for name in sorted(used - doors)]
        problems += [f"{PAGE}:{line}: no file outside of {inside} includes {name}" for name in sorted(doors - used)]
    with_rooms = {room.parent for room in rooms}
    problems += [f"{PAGE}: the room {folder} is not listed" for folder in sorted(folders)
                 if folder.parent in with_rooms and folder not in rooms]
    problems += [f"{PAGE}: {folder} has {len(inside)} files, more than {MOST_FILES}: make rooms, or list it with a reason"
                 for folder, inside in sorted(folders.items()) if len(inside) > MOST_FILES and folder not in large]
    problems += [f"{PAGE}:{line}: {folder} has no more than {MOST_FILES} files" for folder, line in large.items()
                 if len(folders.get(folder, [])) <= MOST_FILES]
    return problems


def wrong_panels(root, files, all_includes):
    """The places where a panel is known to more than the list."""
    text = {file: (root / file).read_text(encoding="utf-8") for file in files if file.parts[0] == "host"}
    makers, problems = {}, []   # the folder of a panel, and its function
    for file in text:
        if file.name == "panel.cpp" and file.parts[:2] == ("host", "app"):
            made = re.findall(r"^Panel (\w+) \(Desk&", text[file], re.M)
            problems += [] if len(made) == 1 else [f"{file}: it defines {len(made)} functions that return a Panel, instead of one"]
            makers[file.parent] = made[0] if made else ""
    problems += [] if makers else ["host/app has no panel"]
    for folder, maker in makers.items():
        named = {file: len(re.findall(rf"\b{maker}\b", text[file])) for file in text if maker and file != folder / "panel.cpp"}
        problems += [f"{file}: it names the panel {maker}; only {PANELS} may" for file, count in named.items() if count and file != PANELS]
        problems += [f"{PANELS}: it names the panel {maker} {named[PANELS]} times, instead of once"] if named.get(PANELS, 1) != 1 else []
    for file, line, target in all_includes:
        room = next((folder for folder in makers if folder in target.parents), None)
        if room is None or room in file.parents or file.parts[0] != "host":
            continue
        if any(folder in file.parents for folder in makers):
            problems.append(f"{file}:{line}: <{target}>: a panel must not include another panel")
        elif "public juce::Component" in text[target]:
            problems.append(f"{file}:{line}: <{target}>: it is a component of a panel, which only the panel may include")
    return problems


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parents[2]).resolve()
    files = list(sources(root))
    all_includes = [(file, line, target) for file in files for line, target in includes(root, file)]
    problems, edges = wrong_doors(root, files, all_includes) + wrong_panels(root, files, all_includes), {}
    for file, line, target in all_includes:
        if reason := points_upwards(file, target):
            problems.append(f"{file}:{line}: <{target}>: {reason}")
        if house(file) in MODELS and file.parent == house(file) and "public juce::Component" in (root / target).read_text(encoding="utf-8"):
            problems.append(f"{file}:{line}: <{target}>: {house(file)} must not include a component")
        if house(file) != house(target):
            edges.setdefault(house(file), {}).setdefault(house(target), f"{file}:{line}: <{target}>")

    in_ring = set()
    for folder in sorted(edges):
        ring = None if folder in in_ring else shortest_ring(folder, edges)
        if ring is None:
            continue
        in_ring.update(ring)
        problems.append(f"{edges[ring[0]][ring[1 % len(ring)]]}: these folders form a ring: {' -> '.join(map(str, ring + ring[:1]))}")
        problems += [f"{edges[a][b]}: part of the ring above" for a, b in zip(ring[1:], ring[2:] + ring[:1])]

    print("\n".join(problems) if problems else "all includes follow the order of the folders")
    return 1 if problems else 0


sys.exit(main())
