#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes docs/instructions.md: what a tick of each node costs, counted by callgrind. No clock, so the same each time.

    instructions.py BUILD     a release build, as build/release
"""

import json
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]


def count(program):
    """[(id, instructions per tick or None, what is wrong)], the first of a tick that does nothing."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out"
        ran = subprocess.run(["valgrind", "--tool=callgrind", "--toggle-collect=ticked", "--dump-after=counted", f"--callgrind-out-file={out}", program],
                             stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
        if ran.returncode != 0:
            sys.exit(ran.stderr)
        rows = []
        for number, line in enumerate(ran.stdout.splitlines(), start=1):
            node, ticks, problem = (line.split(" ", 2) + [""])[:3]
            total = int(re.search(r"^summary: (\d+)", (out.parent / f"out.{number}").read_text(), re.M)[1])
            rows.append((node, total / int(ticks) if int(ticks) else None, problem))
        return rows


def compiled(build):
    """The compiler and what decides on its code, of the nodes and of all else alike."""
    entries = json.loads((build / "compile_commands.json").read_text())
    command = next(shlex.split(e["command"]) for e in entries if "nodes_friction_elasto_plastic_hpp" in e["file"])
    version = subprocess.run([command[0], "--version"], capture_output=True, text=True, check=True).stdout.splitlines()[0]
    flags = [f for f in command[1:] if re.match(r"-(O|m|f|std=)|-DNDEBUG", f)]
    return re.sub(r"^c\+\+", "g++", version), " ".join(flags)


def main():
    build = pathlib.Path(sys.argv[1])
    version, flags = compiled(build)
    (_, nothing, _), *nodes = count(str(build / "bin" / "instructions"))

    lines = [
        "# Instructions per tick", "",
        "Generated: `./test.sh --figures` writes it anew.", "",
        f"Counted by callgrind with {version}, `{flags}`. A second at 4 kHz: the hand strokes and presses three times, a hit comes every 0.1 s, "
        f"other inputs swing; parameters and settings as delivered. The mean over all ticks, with the inputs gathered from where they are wired "
        f"and the outputs written, without the call itself ({nothing:.0f}). Functions of the C library are counted as this processor gets them.", "",
        "| family | node | instructions |", "|---|---|---:|",
    ]
    family = None
    for node, mean, problem in nodes:
        its = node.split(".")[0]
        lines.append(f"| {its if its != family else ''} | `{node}` | {f'{mean - nothing:.0f}' if mean is not None else f'not as delivered: {problem}'} |")
        family = its
    (ROOT / "docs" / "instructions.md").write_text("\n".join(lines) + "\n")
    print(f"docs/instructions.md: {len(nodes)} nodes")


main()
