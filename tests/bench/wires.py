#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Measures how long a report takes from the far end of each wire to the program and back, with our fakes. Must not run beside anything else. The table
is in docs/bench.md.

wires.py TACTUS_TESTS [REPORTS] [ROUNDS]   of each number, the median of the rounds"""

import os
import re
import statistics
import subprocess
import sys

LINE = re.compile(r"^(.+): (\d+) reports, p50 (\S+), p90 (\S+), p99 (\S+), p99\.9 (\S+), max (\S+) us", re.MULTILINE)


def main():
    program, reports, rounds = sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else "20000", int(sys.argv[3]) if len(sys.argv) > 3 else 3
    found = {}
    for _ in range(rounds):
        ran = subprocess.run([program, "[hops]"], capture_output=True, text=True, check=False, env={**os.environ, "TACTUS_HOPS": reports})
        if ran.returncode != 0:
            raise SystemExit(ran.stdout + ran.stderr)
        for wire, _, *times in LINE.findall(ran.stdout):
            found.setdefault(wire, []).append([float(t) for t in times])
    print("| wire | median | 90 % | 99 % | 99.9 % | worst |\n|---|---:|---:|---:|---:|---:|")
    for wire, all_rounds in found.items():
        print(f"| {wire} | " + " | ".join(f"{statistics.median(t):.0f} us" for t in zip(*all_rounds)) + " |")


if __name__ == "__main__":
    main()
