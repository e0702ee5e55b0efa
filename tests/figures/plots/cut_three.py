# SPDX-License-Identifier: MIT
"""Section 3, Fig. 7: three samples that are cut at the same force."""

from style import BLUE, GREEN, PALE, VERMILION, axis, data, figure, name, np


def draw():
    run = data("cut_three")
    depth = 1e3 * run["path.out"]

    fig, ax = figure(2.9)
    ax.axhline(4, color=PALE, linewidth=0.8, zorder=0)
    for sample, colour in (("skinned", VERMILION), ("soft", GREEN), ("crisp", BLUE)):
        force = run[f"{sample}.resistance"]
        part = (depth >= 0) & ((force > 0) | (depth < 5))
        ax.plot(depth[part], force[part], color=colour)
    name(ax, 2.75, 6.25, "crisp", BLUE, ha="right")
    name(ax, 5.2, 8.7, "under a tough skin", VERMILION, ha="left")
    name(ax, 7.4, 5.2, "soft", GREEN)
    name(ax, 14.2, 4, "f$_\\mathrm{cut}$")
    axis(ax, "Three samples with the same toughness, cut at the same force", "depth of the blade (mm)", "resistance (N)")
    ax.set(xlim=(0, 14), ylim=(-0.1, 9.6))
    return fig
