#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks with callgrind what a haptic clip costs. No clock is involved, so the result is reproducible.

    clip.py PROGRAM     PROGRAM is build/release/bin/clip_cost

- loading a clip of 3 minutes takes time in proportion to the number of its events: an event costs as much in a clip of 10 000 as in one of 1000;
- at rest, a tick of signal.clip costs at most twice a tick of signal.constant.
"""

import sys

import callgrind

MOST_GROWTH, MOST_AT_REST = 1.1, 2.0


def main():
    if callgrind.is_missing():
        return callgrind.SKIPPED
    counted = dict(callgrind.count(["counted_load", "counted_tick"], sys.argv[1]))
    limits = []
    for format_ in ("haptic", "ahap", "hjif", "json"):
        few, many = counted[f"load {format_} 1000"] / 1000, counted[f"load {format_} 10000"] / 10_000
        print(f"{format_:7} {many:9.0f} instructions for each of 10 000 events")
        limits.append((f"{format_}: an event of 10 000, in events of 1000", many / few, MOST_GROWTH))
    clip, constant = (counted[f"rest signal.{node} 1000"] / 1000 for node in ("clip", "constant"))
    print(f"at rest {clip:9.1f} instructions per tick, signal.constant {constant:.1f}")
    limits.append(("a clip at rest, in ticks of signal.constant", clip / constant, MOST_AT_REST))
    return callgrind.judge(limits)


if __name__ == "__main__":
    sys.exit(main())
