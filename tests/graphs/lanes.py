#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that graphs with instances render the same bits in 1, 2, 4 and 8 lanes (docs/lanes.md).

Usage: lanes.py TACTUS GRAPHS. TACTUS is the program, GRAPHS the folder of the presets. Renders all presets with a count, and glove.json in this
folder. Prints the graphs that differ. On a processor without AVX-512 or AVX2, the wider lanes are as wide as it has them."""

import os
import pathlib
import subprocess
import sys
import tempfile

SECONDS = 2.0


def rendered(program, graph, lanes):
    with tempfile.TemporaryDirectory() as folder:
        table = pathlib.Path(folder) / "table.csv"
        subprocess.run([program, "render", str(graph), "--duration", str(SECONDS), "--out", str(table)], env={**os.environ, "TACTUS_LANES": str(lanes)},
                       check=True, capture_output=True)
        return table.read_bytes()


def main():
    program, graphs = sys.argv[1:]
    all_graphs = [preset for preset in sorted(pathlib.Path(graphs).glob("*.json")) if '"count"' in preset.read_text(encoding="utf-8")]
    all_graphs.append(pathlib.Path(__file__).parent / "glove.json")
    wrong = []
    for graph in all_graphs:
        single = rendered(program, graph, 1)
        wrong += [f"{graph.name} renders other bits in {lanes} lanes" for lanes in (2, 4, 8) if rendered(program, graph, lanes) != single]
        if single.count(b"\n") < 100:
            wrong.append(f"{graph.name} renders next to nothing")
    print("\n".join(wrong) or f"{len(all_graphs)} graphs render the same bits in 1, 2, 4 and 8 lanes")
    return 1 if wrong or len(all_graphs) < 2 else 0


sys.exit(main())
