# SPDX-License-Identifier: MIT
"""Section 6: the ring that tells materials apart."""

from style import BLUE, GREEN, GREY, PALE, VERMILION, data, figure, name, zero


def draw():
    run = data("ring")
    t = 1e3 * run["t"]
    hits = [t[run[f"{h}.hit"] > 0][0] for h in ("first", "second")]

    fig, panels = figure(3.9, 3, 1, sharex=True)
    for ax, (material, colour, peak) in zip(panels, (("rubber", GREEN, 2), ("wood", BLUE, 4), ("aluminium", VERMILION, 8))):
        zero(ax)
        for hit in hits:
            ax.axvline(hit, color=PALE, linewidth=0.8, zorder=0)
        ax.plot(t, run[f"{material}.value"], color=colour, linewidth=1.1)
        ax.set(ylabel="force (N)", ylim=(-peak, peak), yticks=[-peak, 0, peak], xlim=(0, 80))
        name(ax, 80, 0.7 * peak, material, colour, ha="right", fontweight="semibold")
    panels[0].set_title("Tapped twice")
    for hit, speed in zip(hits, ("0.5 m/s", "0.25 m/s")):
        name(panels[0], hit + 0.8, 1.7, speed, GREY, fontsize=8)
    panels[-1].set_xlabel("time (ms)")
    return fig
