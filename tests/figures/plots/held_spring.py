# SPDX-License-Identifier: MIT
"""Section 1, Fig. 1: the force of a spring, held between samples, deviates from the spring itself."""

import numpy as np
from style import BLUE, GREY, INK, PALE, VERMILION, axis, data, figure, name, note

HOLD = 20  # ticks


def draw():
    run = data("held_spring")
    t, depth, force = 1e3 * run["t"], 1e3 * run["press.out"], run["spring.resistance"]
    turn = int(np.argmax(depth))
    into, out = slice(0, turn + 1), slice(turn, None)

    fig, (ax, leak) = figure(3.0, 1, 2, gridspec_kw={"width_ratios": [1.5, 1]})
    ax.fill(np.repeat(depth, 2)[1:], np.repeat(force, 2)[:-1], color=PALE, alpha=0.7, linewidth=0, zorder=0)
    ax.plot([0, 2.12], [0, 2.12], color=GREY, linewidth=0.9, zorder=1)
    ax.step(depth[into], force[into], where="post", color=BLUE, zorder=3)
    ax.step(depth[out], force[out], where="post", color=VERMILION, zorder=3)
    name(ax, 1.36, 0.80, "pressing", BLUE)
    name(ax, 0.66, 1.22, "release", VERMILION, ha="right")
    note(ax, "the spring itself", (1.90, 1.90), (0.95, 2.06), ha="center", va="center")
    axis(ax, "A spring of 1 N/mm, held for 1 ms", "depth (mm)", "force on the tool (N)")
    ax.set(xlim=(0, 2.15), ylim=(0, 2.2), xticks=[0, 0.5, 1, 1.5, 2], yticks=[0, 0.5, 1, 1.5, 2])

    seen = depth[::HOLD]
    leaked = np.concatenate([[0], np.cumsum(0.5 * np.diff(seen) ** 2)])  # mJ, at 1 N/mm
    returned = -float(np.sum(force[:-1] * np.diff(depth)))
    leak.plot(t[::HOLD], leaked, color=INK)
    leak.plot(t[-1], returned, "o", color=VERMILION, markersize=4.5, clip_on=False, zorder=5)
    name(leak, 10.2, 0.20, "½ K Σ Δp²", INK)
    note(leak, "what the loop has given", (20, returned), (19.2, 0.555), colour=VERMILION, ha="right", va="center")
    axis(leak, "The energy that leaks", "time (ms)", "energy (mJ)")
    leak.set(xlim=(0, 20), xticks=[0, 5, 10, 15, 20], ylim=(0, 0.6))
    return fig
