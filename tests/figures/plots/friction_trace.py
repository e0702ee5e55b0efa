# SPDX-License-Identifier: MIT
"""Section 2, Fig. 4: a tool moved over a surface, and the leash to its contact point."""

import numpy as np
from matplotlib.collections import LineCollection
from style import BLUE, INK, VERMILION, axis, data, figure, name, note


def draw():
    run = data("friction_trace")
    p = 1e3 * np.c_[run["tool.out.x"], run["tool.out.y"]]
    c = p - 1e3 * np.c_[run["contact.deflection.x"], run["contact.deflection.y"]]
    slips = run["contact.state"] == 2

    fig, ax = figure(3.7)
    every = np.arange(0, len(p), 16)
    for some, colour in ((every[slips[every]], VERMILION), (every[~slips[every]], BLUE)):
        ax.add_collection(LineCollection(np.stack([p, c], axis=1)[some], colors=colour, linewidths=0.6, alpha=0.8))
    ax.plot(*p.T, color=INK, linewidth=0.9)

    note(ax, "it sticks: the contact point\nstays, the leash swings", (3.15, 1.72), (-0.1, 3.6), colour=BLUE, ha="center", va="bottom")
    note(ax, "it slips: the contact point\nis dragged along", (6.7, -5.2), (0.6, -4.3), colour=VERMILION, ha="center", va="center")
    ax.plot(*np.array([p[-1], c[-1]]).T, color=BLUE, linewidth=2)
    ax.plot(*p[-1], "o", markersize=4, color=INK, zorder=5)
    note(ax, "it ends stuck", p[-1], (-5.2, -5.35), colour=BLUE, ha="left", va="center")
    name(ax, *p[0] + (0, -0.35), "start", INK, ha="center")
    note(ax, "the tool", (-3.27, 1.6), (-1.3, 1.9), colour=INK, ha="left", va="center")
    axis(ax, "A leash of 1 mm between the tool and its contact point", "x (mm)", "y (mm)")
    ax.set(xticks=[-10, -5, 0, 5, 10], yticks=[-4, -2, 0, 2, 4])
    ax.set_aspect("equal")
    return fig
