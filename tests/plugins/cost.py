#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares what a tick costs in a plugin and compiled in: instructions, counted by callgrind.

    cost.py BUILD PLUGIN...     BUILD is a release build, such as build/release; the plugins together contain all nodes of the catalogue

Prints each node, and the sum of all. Exit status 1 if a tick of any node costs more than MOST times what it costs compiled in, or if a
node is missing. All counts include the call, as in a run."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "bench"))
import instructions   # noqa: E402

MOST = 1.05


def main():
    program = str(pathlib.Path(sys.argv[1]) / "bin" / "instructions")
    compiled_in = {node: mean for node, mean, _ in instructions.count(program) if mean and node != "nothing"}
    in_plugins = {node: mean for node, mean, _ in instructions.count(program, *sys.argv[2:]) if mean}
    if missing := compiled_in.keys() - in_plugins.keys():
        sys.exit(f"no plugin contains {', '.join(sorted(missing))}")
    print(f"{'':32} compiled in     plugin    ratio")
    for node, own in compiled_in.items():
        print(f"{node:32} {own:11.1f} {in_plugins[node]:10.1f} {in_plugins[node] / own:8.3f}")
    dear = [f"{node} {in_plugins[node] / own:.3f}" for node, own in compiled_in.items() if in_plugins[node] > MOST * own]
    own, plugin = sum(compiled_in.values()), sum(in_plugins[node] for node in compiled_in)
    ratio = plugin / own
    print(f"{'all':32} {own:11.1f} {plugin:10.1f} {ratio:8.3f}")
    print(f"above {MOST}: {', '.join(dear) or 'none'}")
    if dear:
        sys.exit(f"a tick in a plugin may cost at most {MOST} times as much as compiled in (docs/plugins.md)")


main()
