# SPDX-License-Identifier: MIT
"""Section 3, Fig. 6: the branches of a cut."""

import numpy as np
from style import BLUE, GREEN, PALE, VERMILION, axis, data, figure, name


def branch(ax, x, y, number, colour):
    ax.text(x, y, number, color="white", fontsize=8, fontweight="semibold", ha="center", va="center", zorder=6,
            bbox={"boxstyle": "circle,pad=0.25", "facecolor": colour, "edgecolor": "white", "linewidth": 1})


def draw():
    run = data("cut")
    depth, force, state = 1e3 * run["blade.depth"], run["blade.resistance"], run["blade.state"]
    burst = int(np.argmax(state == 2))
    after = np.arange(len(state)) >= burst
    inside = depth >= 0

    fig, ax = figure(3.1)
    ax.axhline(4, color=PALE, linewidth=0.8, zorder=0)
    name(ax, 9.05, 4, "f$_\\mathrm{cut}$ = J$_\\mathrm{c}$ w")
    ax.plot(depth[:burst], force[:burst], color=BLUE)
    ax.plot(depth[burst - 1:burst + 1], force[burst - 1:burst + 1], color=VERMILION, linestyle=(0, (2.2, 1.4)))
    ax.plot(depth, np.where(after & inside & (state != 4), force, np.nan), color=GREEN)
    cutting = np.where(after & (state == 4), force, np.nan)
    ax.plot(depth, cutting, color=VERMILION)

    branch(ax, 1.7, 3.4, "1", BLUE)
    branch(ax, 3.0, 4.55, "2", VERMILION)
    branch(ax, 2.5, 1.0, "3", GREEN)
    branch(ax, 5.25, 4.0, "4", VERMILION)
    branch(ax, 5.95, 2.9, "5", GREEN)
    branch(ax, 7.35, 4.0, "4", VERMILION)
    branch(ax, 7.2, 2.0, "6", GREEN)
    name(ax, 1.55, 3.75, "virgin", BLUE, ha="right")
    name(ax, 3.2, 5.0, "it bursts", VERMILION)
    name(ax, 3.0, 1.8, "drawn back,\nloaded again", GREEN, va="top")
    name(ax, 5.25, 4.45, "cut", VERMILION, ha="center")
    name(ax, 5.75, 3.05, "drawn out", GREEN, ha="right")
    name(ax, 5.35, 1.05, "and back in", GREEN)
    name(ax, 7.35, 4.45, "cut again", VERMILION, ha="center")
    name(ax, 7.42, 1.85, "drawn out\nagain", GREEN)
    name(ax, 2.35, 0.32, "no force in the crack", GREEN)
    axis(ax, "A blade pressed in, drawn out, and pressed in again", "depth of the blade (mm)", "resistance (N)")
    ax.set(xlim=(0, 9), ylim=(-0.15, 6.4))
    return fig
