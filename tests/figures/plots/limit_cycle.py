# SPDX-License-Identifier: MIT
"""Section 1: a wall that is too stiff ends in a bounce."""

from style import BLUE, GREY, INK, PALE, VERMILION, WIDTH, axis, data, name, note, plt, zero


def draw():
    fig = plt.figure(figsize=(WIDTH, 3.3))
    grid = fig.add_gridspec(2, 2, width_ratios=[1.75, 1])
    nudged, dropped = fig.add_subplot(grid[0, 0]), fig.add_subplot(grid[1, 0])
    height = fig.add_subplot(grid[:, 1])

    for ax, run, colour, until in ((nudged, "limit_cycle_nudged", BLUE, 1400), (dropped, "limit_cycle_dropped", VERMILION, 1400)):
        record = data(run)
        part = record["t"] <= 1e-3 * until
        ax.axhspan(-0.8, 0, color=PALE, alpha=0.55, linewidth=0, zorder=0)
        zero(ax)
        ax.plot(1e3 * record["t"][part], 1e3 * record["hand.position.z"][part], color=colour, linewidth=0.8)
        ax.set(xlim=(0, until), xticks=[0, 200, 400, 600, 800, 1000, 1200, 1400])
        ax.set_ylabel("height (mm)")
    nudged.set(ylim=(-0.35, 0.3), yticks=[-0.2, 0, 0.2])
    dropped.set(ylim=(-0.8, 2.1), yticks=[0, 1, 2])
    nudged.tick_params(labelbottom=False)
    nudged.set_title("On a wall of 1.3 × 2B/T")
    dropped.set_xlabel("time (ms)")
    name(nudged, 20, -0.29, "in the wall", GREY, fontsize=8)
    name(nudged, 20, 0.22, "nudged by 10 µm", BLUE)
    name(dropped, 640, 1.4, "let go 2 mm above the wall", VERMILION)

    points = data("limit_cycle")
    for part in (points["factor"] < 1, points["factor"] > 1):
        height.plot(points["factor"][part], 1e3 * points["bounce"][part], "o-", color=INK, linewidth=0.9, markersize=4.5, markeredgecolor="white",
                    markeredgewidth=0.6, clip_on=False)
    height.axvline(1, color=PALE, linewidth=0.8, zorder=0)
    note(height, "at rest", (0.9, 0.0), (0.91, 0.08), ha="center", va="center")
    axis(height, "The bounce that is left", "stiffness / (2B/T)", "lowest to highest (mm)")
    height.set(xlim=(0.85, 1.55), ylim=(0, 0.52), xticks=[0.9, 1, 1.1, 1.3, 1.5], yticks=[0, 0.1, 0.2, 0.3, 0.4, 0.5])
    return fig
