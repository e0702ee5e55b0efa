#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the paths of the hands that cut: potato_edge.csv and liver_cut.csv, in m and s.

Each row of a table is a time and a place in mm, at rest. In between the hand moves with minimum jerk.

    python3 knife_paths.py
"""
import pathlib

PATHS = {
    # Down, out, aside, down, out, back, down into the first cut, out.
    "potato_edge": [(0.0, 0, 0, 10), (1.8, 0, 0, -16), (2.5, 0, 0, 10), (3.1, 0, 15, 10),
                    (4.9, 0, 15, -16), (5.6, 0, 15, 10), (6.2, 0, 0, 10), (8.0, 0, 0, -16), (8.8, 0, 0, 10), (9.0, 0, 0, 10)],
    # Press, push aside until the edge slips, press until it bursts, draw along the edge, out, back into the cut,
    # which is where the flesh has slid back to, out.
    "liver_cut": [(0.0, -12, -8, 10), (1.0, -12, -8, -9), (2.2, -12, 4, -9), (3.4, -12, 4, -22), (5.2, 12, 4, -22), (6.2, 12, 4, 12),
                  (6.8, 0, 0.9, 12), (7.8, 0, 0.9, -16), (8.8, 0, 0.9, 12), (9.0, 0, 0.9, 12)],
}
STEP = 0.01  # s


def along(rests, t):
    for (t0, *a), (t1, *b) in zip(rests, rests[1:]):
        if t <= t1:
            u = (t - t0) / (t1 - t0)
            s = u ** 3 * (10 + u * (6 * u - 15))
            return [p + (q - p) * s for p, q in zip(a, b)]
    return rests[-1][1:]


def main():
    folder = pathlib.Path(__file__).parent
    for name, rests in PATHS.items():
        rows = ["t,x,y,z"]
        for k in range(round(rests[-1][0] / STEP) + 1):
            numbers = [k * STEP, *(1e-3 * v for v in along(rests, k * STEP))]
            rows.append(",".join(f"{v:.6f}".rstrip("0").rstrip(".").replace("-0,", "0,") for v in numbers))
        (folder / f"{name}.csv").write_text("\n".join(rows) + "\n")


if __name__ == "__main__":
    main()
