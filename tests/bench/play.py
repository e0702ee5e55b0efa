#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Measures what `tactus play` costs with simulated devices: processor time per tick, user and system, without that of the start; and how late its
ticks begin. The table is in docs/bench.md.

play.py TACTUS [GRAPH] [SECONDS]   TACTUS is build/release/bin/tactus; without more, Dry wood for 10 s"""

import pathlib
import re
import resource
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]


def played(program, graph, lasts_s):
    """Processor time in s, and the last line that the program says about its ticks."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    said = subprocess.run([program, "play", graph, "--osc", "off", "--duration", str(lasts_s)], capture_output=True, text=True, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, re.split(r"[\r\n]+", (said.stdout + said.stderr).strip())[-1]


def main():
    program = pathlib.Path(sys.argv[1]).resolve()
    graph = sys.argv[2] if len(sys.argv) > 2 else ROOT / "graphs/dry_wood.json"
    lasts_s = float(sys.argv[3]) if len(sys.argv) > 3 else 10.0
    short_s = 0.5  # a run that costs little more than the start
    start, said = played(program, graph, short_s)
    whole, last = played(program, graph, short_s + lasts_s)
    ticks = [int(re.search(r"missed \d+ of (\d+) ticks", line)[1]) for line in (said, last)]
    print(f"| start and {short_s} s | {start:.2f} s of processor time |")
    print(f"| a tick | {1e6 * (whole - start) / (ticks[1] - ticks[0]):.1f} us of processor time |")
    print(f"| lateness | {last.split('N')[-1].split('late')[-1].strip()} |")


main()
