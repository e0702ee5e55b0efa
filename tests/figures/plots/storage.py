# SPDX-License-Identifier: MIT
"""Section 4: an elastic body stores its surface."""

import numpy as np
from style import BLUE, GREY, INK, axis, data, figure, name


def draw():
    points = data("storage")
    n, size = points["cells"], points["bytes"] / 1e6
    each = float(points["bytes"][-1] / points["surface"][-1]) / 1e6
    line = np.geomspace(4, 64, 100)
    fig, ax = figure(2.9)
    ax.plot(line, each * (line + 1) ** 3, color=GREY, linewidth=0.9, linestyle=(0, (4, 3)))
    ax.plot(line, each * (6 * line ** 2 + 2), color=BLUE, linewidth=0.9)
    ax.plot(n, size, "o", color=BLUE, markersize=4.5, markeredgecolor="white", markeredgewidth=0.6)
    ax.set_xscale("log", base=2)
    ax.set_yscale("log")
    ax.minorticks_off()
    name(ax, 24, 1.1, "measured, and 6n² + 2 nodes", BLUE, ha="left")
    name(ax, 38, float(each * 39 ** 3) * 1.7, "if every node of the solid had curves", GREY, ha="right")
    for k in (0, len(n) - 1):
        name(ax, n[k] * 1.02, size[k] / 1.9, f"{size[k]:.2g} MB", INK, fontsize=8, ha="left" if k == 0 else "center")
    axis(ax, "A cube of n × n × n cells", "cells along an edge, n", "storage (MB)")
    ax.set(xlim=(3.6, 72), ylim=(0.03, 300), yticks=[0.1, 1, 10, 100], yticklabels=["0.1", "1", "10", "100"], xticks=[4, 8, 16, 32, 64], xticklabels=["4", "8", "16", "32", "64"])
    return fig
