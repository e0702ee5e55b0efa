#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes docs/instructions.md: the instructions per tick of each node, and of a whole tick of the reference graph, counted by callgrind.
No clock is involved, so the result is reproducible.

    instructions.py BUILD     BUILD is a release build, such as build/release
"""

import json
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

import callgrind

ROOT = pathlib.Path(__file__).resolve().parents[2]


def count(program, *arguments):
    """Returns [(id, instructions per tick or None, problem)]. The first entry is a tick that does nothing."""
    rows = []
    for line, total in callgrind.count(["ticked"], program, *arguments):
        node, ticks, problem = (line.split(" ", 2) + [""])[:3]
        rows.append((node, total / int(ticks) if int(ticks) else None, problem))
    return rows


def whole_tick(program, graph, ticks=4000):
    """Returns the instructions per tick of a graph: all of them, and those of its parts, which call each other but do not overlap."""
    parts = {"nodes": "tactus::NodeCosts::tick", "guard": "tactus::Guard::operator()", "reading": "tactus::SimulatedDevice::read",
             "writing": "tactus::SimulatedDevice::write"}
    with tempfile.TemporaryDirectory() as folder:
        out = f"{folder}/out"
        ran = subprocess.run(["valgrind", "--tool=callgrind", "--toggle-collect=whole_tick", f"--callgrind-out-file={out}", program, graph, str(ticks)],
                             stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
        if ran.returncode != 0:
            sys.exit(ran.stderr)
        text = subprocess.run(["callgrind_annotate", "--inclusive=yes", "--threshold=100", out], capture_output=True, text=True, check=True).stdout
    ticked = int(ran.stdout)   # more than asked for: the forces fall to zero first

    def counted(what):
        return int(re.search(r"^ *([\d,]+) .*" + re.escape(what), text, re.M)[1].replace(",", "")) / ticked
    return counted("PROGRAM TOTALS"), {part: counted(function + ("" if function.endswith(")") else "(")) for part, function in parts.items()}


def whole_tick_lines(program):
    total, part = whole_tick(program, str(ROOT / "graphs" / "padded_bench.json"))
    device = part["reading"] + part["writing"]
    rest = total - part["nodes"] - part["guard"] - device
    return ["", "## A whole tick", "",
            "The table shows a tick of `graphs/padded_bench.json` with all parts of a run. The guard has the limits of the preset.", "",
            "| part | instructions |", "|---|---:|",
            f"| nodes | {part['nodes']:.0f} |", f"| simulated hand and tool | {device:.0f} |", f"| guard | {part['guard']:.0f} |",
            f"| engine, times, status for other threads | {rest:.0f} |", f"| all | {total:.0f} |"]


def compiled(build):
    """Returns the compiler and the flags that affect the generated code; nodes and everything else use the same."""
    entries = json.loads((build / "compile_commands.json").read_text())
    command = next(shlex.split(e["command"]) for e in entries if "nodes_friction_elasto_plastic" in e["file"])
    command = command[next(i for i, word in enumerate(command) if word.endswith("++")):]   # drops ccache
    version = subprocess.run([command[0], "--version"], capture_output=True, text=True, check=True).stdout.splitlines()[0]
    flags = [f for f in command[1:] if re.match(r"-(O|m|f|std=)|-DNDEBUG", f)]
    return re.sub(r"^c\+\+", "g++", version), " ".join(flags)


def main():
    build = pathlib.Path(sys.argv[1])
    version, flags = compiled(build)
    (_, nothing, _), *nodes = count(str(build / "bin" / "instructions"))

    lines = [
        "# Instructions per tick", "",
        "This page lists how many instructions one tick of each node takes. `./test.sh --figures` generates it.", "",
        f"The instructions were counted by callgrind with {version}, `{flags}`. The input lasts one second at 4 kHz: "
        f"the hand strokes and presses three times, a hit arrives every 0.1 s, and other inputs oscillate. Parameters and settings "
        f"have their defaults. The numbers are means over all ticks. They include gathering "
        f"the inputs and writing the outputs, but not the call itself ({nothing:.0f} instructions).", "",
        "| family | node | instructions |", "|---|---|---:|",
    ]
    family = None
    for node, mean, problem in nodes:
        its = node.split(".")[0]
        lines.append(f"| {its if its != family else ''} | `{node}` | {f'{mean - nothing:.0f}' if mean is not None else f'not counted: {problem}'} |")
        family = its
    lines += whole_tick_lines(str(build / "bin" / "whole_tick"))
    (ROOT / "docs" / "instructions.md").write_text("\n".join(lines) + "\n")
    print(f"docs/instructions.md: {len(nodes)} nodes")


if __name__ == "__main__":
    main()
