#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks with callgrind that a small change of a large graph costs the tick little. No clock is involved, so the result is reproducible.

    scale.py PROGRAM [NODES]     PROGRAM is build/release/bin/scale

- the tick that takes over a plan, and the tick after a knob was turned, do not visit all nodes;
- reading and compiling a graph costs at most so many instructions for each node.
"""

import sys

import callgrind

MOST_PER_NODE = 16_000   # the goal is 15 000


def main():
    if callgrind.is_missing():
        return callgrind.SKIPPED
    program, nodes = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 10_000
    counted = callgrind.count(["counted_tick", "counted_compile", "counted_load"], program, str(nodes))
    for what, instructions in counted:
        print(f"{what:12} {instructions:12,}  {instructions / nodes:10.1f} for each node")
    of = dict(reversed(counted))   # the first of each kind
    takeovers = [i for what, i in counted if what == "takeover"]
    limits = [("a takeover, in ticks", max(takeovers) / of["tick"], 3.0), ("a turned knob, in ticks", of["knob"] / of["tick"], 1.1),
              ("a takeover, beyond a tick", max(takeovers) - of["tick"], nodes), ("a turned knob, beyond a tick", of["knob"] - of["tick"], nodes),
              ("loading, for each node", of["load"] / nodes, MOST_PER_NODE)]
    return callgrind.judge(limits)


if __name__ == "__main__":
    sys.exit(main())
