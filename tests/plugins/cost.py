#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares what a tick costs in a plugin and compiled in: instructions, counted by callgrind.

    cost.py BUILD PLUGIN...     BUILD is a release build, such as build/release; the plugins contain nodes of the catalogue

Prints each node, and the sum of all. The ratio is not judged."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "bench"))
import instructions   # noqa: E402


def main():
    program = str(pathlib.Path(sys.argv[1]) / "bin" / "instructions")
    compiled_in = {node: mean for node, mean, _ in instructions.count(program)}
    total = {"compiled in": 0.0, "plugin": 0.0}
    print(f"{'':32} compiled in     plugin    ratio")
    for node, mean, _ in instructions.count(program, *sys.argv[2:]):
        own = compiled_in.get(node)
        if node == "nothing" or not mean or not own:
            continue
        print(f"{node:32} {own:11.1f} {mean:10.1f} {mean / own:8.3f}")
        total["compiled in"] += own
        total["plugin"] += mean
    ratio = total["plugin"] / total["compiled in"]
    print(f"{'all':32} {total['compiled in']:11.1f} {total['plugin']:10.1f} {ratio:8.3f}")


main()
