#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the chart of docs/bench.md: how much longer a tick takes than its yardstick, with the interval of the median.

    tactus bench --json | chart.py docs/bench.svg
"""

import json
import math
import sys

ROWS = [   # key, first, yardstick
    ("export/hand", "exported code", "hand-written"), ("fused/hand", "reference graph, fused", "hand-written"),
    ("plan/hand", "reference graph", "hand-written"), ("dry_wood_plan/hand", "dry wood", "hand-written"),
    ("light_fused/hand", "light kernels, fused", "hand-written"), ("light_plan/hand", "light kernels", "hand-written"),
    ("export/faust_chain100", "exported chain of 100", "Faust"), ("plan/faust_chain100", "chain of 100", "Faust"),
    ("juce/plan", "reference graph in JUCE", "plan"), ("juce_tree100/plan", "tree of 100 in JUCE", "plan"),
]
LEFT, WIDTH, STEP, TOP, MOST = 300, 420, 28, 34, 32.0   # in px; MOST is the largest ratio that the axis shows


def x(ratio):
    return LEFT + WIDTH * math.log(min(max(ratio, 0.9), MOST) / 0.9) / math.log(MOST / 0.9)


def bar(row, name, yardstick, ratio):
    y = TOP + STEP * row
    colour = {"hand-written": "#4c78a8", "Faust": "#72a36b", "plan": "#c47f3e"}[yardstick]
    low, high, median = x(ratio["low"]), x(ratio["high"]), x(ratio["median"])
    begin, end = min(x(1), median), max(x(1), median)
    return [f'<text x="{LEFT - 12}" y="{y + 14}" text-anchor="end">{name} / {yardstick}</text>',
            f'<rect x="{begin:.1f}" y="{y + 2}" width="{max(end - begin, 1):.1f}" height="16" fill="{colour}"/>',
            f'<line x1="{low:.1f}" x2="{high:.1f}" y1="{y + 10}" y2="{y + 10}" stroke="#222" stroke-width="2"/>',
            f'<text x="{max(end, high) + 8:.1f}" y="{y + 14}">{ratio["median"]:.3g}</text>']


def main():
    ratios = json.load(sys.stdin)["ratios"]
    rows = [row for row in ROWS if row[0] in ratios]
    bottom = TOP + STEP * len(rows)
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{LEFT + WIDTH + 60}" height="{bottom + 34}" font-family="sans-serif" font-size="13">',
             "<title>Time of a tick, divided by that of its yardstick</title>", '<rect width="100%" height="100%" fill="white"/>',
             f'<text x="{LEFT}" y="18" font-weight="bold">time of a tick, divided by that of its yardstick</text>']
    for ratio in (1, 2, 4, 8, 16, 32):
        lines += [f'<line x1="{x(ratio):.1f}" x2="{x(ratio):.1f}" y1="{TOP - 4}" y2="{bottom}" stroke="{"#888" if ratio == 1 else "#ddd"}"/>',
                  f'<text x="{x(ratio):.1f}" y="{bottom + 16}" text-anchor="middle">{ratio}</text>']
    for number, (key, name, yardstick) in enumerate(rows):
        lines += bar(number, name, yardstick, ratios[key])
    with open(sys.argv[1], "w", encoding="utf-8") as file:
        file.write("\n".join(lines + ["</svg>"]) + "\n")


if __name__ == "__main__":
    main()
