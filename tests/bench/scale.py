#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks with callgrind that what changes little in a large graph costs little. No clock is involved, so the result is reproducible.

    scale.py PROGRAM [NODES]     PROGRAM is build/release/bin/scale

- the tick that takes over a plan, and the tick after a knob was turned, do not visit all nodes;
- compiling an edit of one wire costs at most 1/20 of compiling the whole graph;
- reading and compiling a graph costs at most so many instructions for each node.
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77
MOST_PER_NODE = 16_000   # the goal is 15 000; it was 14 900


def count(program, nodes):
    """Returns [(what, instructions)] in the order in which the program does it."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out"
        ran = subprocess.run(["valgrind", "--tool=callgrind", "--toggle-collect=counted_tick", "--toggle-collect=counted_compile",
                              "--toggle-collect=counted_load", "--dump-after=counted", f"--callgrind-out-file={out}", program, str(nodes)],
                             stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
        if ran.returncode != 0:
            sys.exit(ran.stderr)
        return [(what, int(re.search(r"^summary: (\d+)", pathlib.Path(f"{out}.{number}").read_text(), re.M)[1]))
                for number, what in enumerate(ran.stdout.splitlines(), start=1)]


def main():
    if shutil.which("valgrind") is None:
        print("skipped: valgrind is not installed")
        return SKIPPED
    program, nodes = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 10_000
    counted = count(program, nodes)
    for what, instructions in counted:
        print(f"{what:12} {instructions:12,}  {instructions / nodes:10.1f} for each node")
    of = dict(reversed(counted))   # the first of each kind
    takeovers = [i for what, i in counted if what == "takeover"]
    limits = [("a takeover, in ticks", max(takeovers) / of["tick"], 3.0), ("a turned knob, in ticks", of["knob"] / of["tick"], 1.1),
              ("a takeover, beyond a tick", max(takeovers) - of["tick"], nodes), ("a turned knob, beyond a tick", of["knob"] - of["tick"], nodes),
              ("an edit of one wire, in compilations", of["edit"] / of["compile"], 0.05), ("loading, for each node", of["load"] / nodes, MOST_PER_NODE)]
    failed = False
    for what, value, most in limits:
        failed = failed or value > most
        print(f"{what}: {value:.4g}, at most {most:g}{'   TOO MUCH' if value > most else ''}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
