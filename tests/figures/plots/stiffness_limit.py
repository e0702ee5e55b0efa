# SPDX-License-Identifier: MIT
"""Section 1: how stiff a wall can be."""

from style import BLUE, GREEN, INK, VERMILION, WIDTH, axis, data, name, plt, zero


def draw():
    fig = plt.figure(figsize=(WIDTH, 3.1))
    grid = fig.add_gridspec(2, 2, width_ratios=[1, 1])
    above = fig.add_subplot(grid[0, 0])
    below, limit = fig.add_subplot(grid[1, 0], sharex=above, sharey=above), fig.add_subplot(grid[:, 1])

    for ax, run, factor, colour in ((above, "stiffness_limit_above", 1.15, VERMILION), (below, "stiffness_limit_below", 0.85, BLUE)):
        record = data(run)
        part = record["t"] <= 0.3
        zero(ax)
        ax.plot(1e3 * record["t"][part], 1e6 * (record["hand.position.z"][part] + 20.0 / (4000.0 * factor)), color=colour, linewidth=0.9)
        name(ax, 300, 23, f"{factor} × 2B/T", colour, ha="right")
        ax.set(xlim=(0, 300), ylim=(-20, 27), yticks=[-10, 0, 10], ylabel="swing (µm)")
    above.tick_params(labelbottom=False)
    above.set_title("Nudged, leaning on a wall")
    below.set_xlabel("time (ms)")

    points = data("stiffness_limit")
    for delay, colour, text, dy, side in ((0, INK, "2B/T", 0, "left"), (1, GREEN, "a tick late: 2B/3T", 0.55, "right"),
                                          (2, BLUE, "two ticks late: 2B/5T", -1.36, "right")):
        mine = points["delay"] == delay
        law = 2.0 / (2 * delay + 1)
        limit.plot([0, 4.2], [0, 4.2 * law], color=colour, linewidth=0.9)
        limit.plot(points["damping"][mine], points["measured"][mine] / 1e3, "o", color=colour, markersize=4.5, markeredgecolor="white", markeredgewidth=0.6)
        name(limit, 4.25, 4.2 * law + dy, text, colour, ha=side)
    axis(limit, "The stiffest wall that comes to rest", "damping B of the device (N s/m)", "stiffness (N/mm)")
    limit.set(xlim=(0, 4.6), ylim=(0, 9), xticks=[0, 1, 2, 3, 4])
    return fig
