#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Prints how many lines of code each part has, against the last release: lines.py [--release VERSION] [ROOT]

Warns of each part that has grown by more than 5 %, and if all together have more than `most` in lines.json. With --release, notes the lines of
today as those of this version in lines.json; do this at a release."""

import argparse
import json
import os
import pathlib

HERE = pathlib.Path(__file__).resolve().parent
GROWTH = 0.05
PARTS = ("framework", "nodes", "host", "tests", "docs")
ENDINGS = {".c", ".h", ".cpp", ".hpp", ".py", ".pyi", ".sh", ".js", ".mjs", ".cjs", ".cmake"}


def counted(root):
    """The lines of each part, without those of the folders that a build or git makes."""
    lines = dict.fromkeys((*PARTS, "the rest"), 0)
    for folder, inside, files in os.walk(root):
        at = pathlib.Path(folder).relative_to(root)
        inside[:] = [name for name in inside if name not in (".git", "__pycache__") and not (at == pathlib.Path() and name.startswith(("build", "out")))]
        part = at.parts[0] if at.parts and at.parts[0] in PARTS else "the rest"
        for name in files:
            if name == "CMakeLists.txt" or pathlib.Path(name).suffix in ENDINGS:
                lines[part] += pathlib.Path(folder, name).read_bytes().count(b"\n")
    return lines


def report(now, known):
    """The table and the warnings."""
    before, most = known["lines"], known["most"]
    rows = [(part, before.get(part, 0), now[part]) for part in now]
    rows.append(("all", sum(before.values()), sum(now.values())))
    text = [f"{'lines':12}{known['version']:>10}{'now':>10}"]
    text += [f"{name:12}{old:10}{new:10}{f'{100 * (new / old - 1):+9.1f} %' if old else ''}" for name, old, new in rows]
    text += [f"warning: {name} has grown by more than {100 * GROWTH:g} % since {known['version']}" for name, old, new in rows if new > (1 + GROWTH) * old]
    if (too_many := rows[-1][2] - most) > 0:
        text.append(f"warning: {too_many} lines more than the {most} of tests/structure/lines.json")
    return "\n".join(text)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--release", metavar="VERSION")
    arguments.add_argument("root", nargs="?", type=pathlib.Path, default=HERE.parents[1])
    given = arguments.parse_args()
    table = HERE / "lines.json"
    known = json.loads(table.read_text(encoding="utf-8"))
    now = counted(given.root.resolve())
    if given.release:
        table.write_text(json.dumps({"version": given.release, "most": known["most"], "lines": now}, indent=2) + "\n", encoding="utf-8")
    else:
        print(report(now, known))


if __name__ == "__main__":
    main()
