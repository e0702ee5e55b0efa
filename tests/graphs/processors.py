#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that all presets render the same bits on processors with and without AVX and FMA.

Usage: processors.py TACTUS GRAPHS. TACTUS is the program, GRAPHS the folder of the presets. Prints the presets that differ. Exit status 77 if
glibc does not choose functions by processor here, or the processor has nothing to hide.

GLIBC_TUNABLES hides features of the processor from glibc, which then takes the functions for older processors. That this works is tested with
the elementary functions of glibc itself, which Python calls."""

import concurrent.futures
import hashlib
import os
import pathlib
import subprocess
import sys
import tempfile

FEATURES = ["AVX", "AVX2", "FMA", "FMA4", "AVX512F"]   # glibc 2.33 and later; earlier ones add _Usable
OLD = {**os.environ, "GLIBC_TUNABLES": "glibc.cpu.hwcaps=" + ",".join(f"-{f},-{f}_Usable" for f in FEATURES)}
NEW = {**os.environ}
NEW.pop("GLIBC_TUNABLES", None)
GLIBC = "import math; print(hash(tuple(math.sin(0.37 * i) + math.exp(-0.11 * i) for i in range(2000))))"
SECONDS = 4.0


def output(command, environment):
    return subprocess.run(command, env=environment, check=True, capture_output=True, text=True).stdout


def rendered(program, graph, environment):
    """The hash of all forces of a preset, as text that reads back to the same bits."""
    with tempfile.TemporaryDirectory() as folder:
        table = pathlib.Path(folder) / "table.csv"
        output([program, "render", str(graph), "--duration", str(SECONDS), "--out", str(table)], environment)
        return hashlib.sha256(table.read_bytes()).hexdigest(), table.read_bytes().count(b"\n")


def main():
    program, graphs = sys.argv[1:]
    if output([sys.executable, "-c", GLIBC], OLD) == output([sys.executable, "-c", GLIBC], NEW):
        print("skipped: glibc takes the same functions with and without AVX and FMA")
        return 77
    presets = sorted(pathlib.Path(graphs).glob("*.json"))
    differ = []
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        for preset, old, new in zip(presets, pool.map(lambda p: rendered(program, p, OLD), presets), pool.map(lambda p: rendered(program, p, NEW), presets)):
            if old != new or old[1] < 100:
                differ.append(preset.name)
    print("\n".join(f"{name} renders other bits without AVX and FMA" for name in differ) or f"{len(presets)} presets render the same bits")
    return 1 if differ or not presets else 0


sys.exit(main())
