#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Prints how many lines of code each language has, against the last release: lines.py [--release VERSION] [ROOT]

Warns of each language that has grown by more than 5 %. Exit status 1 if all together have more than `most` in lines.json. With --release, notes
the lines of today as those of this version in lines.json; do this at a release."""

import argparse
import json
import os
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
GROWTH = 0.05
LANGUAGES = {"C": ("c", "h"), "C++": ("cpp", "hpp"), "Python": ("py", "pyi"), "shell": ("sh",), "JavaScript": ("js", "mjs", "cjs"), "CMake": ("cmake",)}
LANGUAGE = {f".{ending}": language for language, endings in LANGUAGES.items() for ending in endings}


def counted(root):
    """The lines of each language, without those of the folders that a build or git makes."""
    lines = dict.fromkeys(LANGUAGES, 0)
    for folder, inside, files in os.walk(root):
        inside[:] = [name for name in inside if name not in (".git", "__pycache__") and not (name == "build" and pathlib.Path(folder) == root)]
        for name in files:
            language = "CMake" if name == "CMakeLists.txt" else LANGUAGE.get(pathlib.Path(name).suffix)
            if language:
                lines[language] += pathlib.Path(folder, name).read_bytes().count(b"\n")
    return lines


def report(now, known):
    """The table, the warnings, and whether there are too many lines."""
    before, most = known["lines"], known["most"]
    rows = [(language, before.get(language, 0), now[language]) for language in now]
    rows.append(("all", sum(before.values()), sum(now.values())))
    text = [f"{'lines':12}{known['version']:>10}{'now':>10}"]
    text += [f"{name:12}{old:10}{new:10}{f'{100 * (new / old - 1):+9.1f} %' if old else ''}" for name, old, new in rows]
    text += [f"warning: {name} has grown by more than {100 * GROWTH:g} % since {known['version']}" for name, old, new in rows if new > (1 + GROWTH) * old]
    too_many = rows[-1][2] - most
    if too_many > 0:
        text.append(f"error: {too_many} lines more than the {most} of tests/structure/lines.json; delete what nobody needs, or change `most` and say why")
    return "\n".join(text), too_many > 0


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
        return 0
    text, too_many = report(now, known)
    print(text)
    return int(too_many)


if __name__ == "__main__":
    sys.exit(main())
