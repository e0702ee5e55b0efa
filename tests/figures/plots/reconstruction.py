# SPDX-License-Identifier: MIT
"""Section 5: what a filter at the first resonance of a device is for."""

import numpy as np
from style import BLUE, GREY, PALE, VERMILION, WIDTH, axis, data, name, plt, zero

RATE = 4000.0


def reaching(run, tip, mass):
    return mass * RATE * np.diff(run[f"{tip}.velocity.x"])


def draw():
    fig = plt.figure(figsize=(WIDTH, 3.6))
    grid = fig.add_gridspec(2, 2, width_ratios=[1.5, 1])
    phantom = fig.add_subplot(grid[0, 0])
    pantograph, gain = fig.add_subplot(grid[1, 0], sharex=phantom), fig.add_subplot(grid[:, 1])

    for ax, profile, mass, filtered in ((phantom, "phantom_1_0", 0.075, True), (pantograph, "pantograph_mk2", 0.05, False)):
        run = data(f"reconstruction_{profile}")
        t = 1e3 * run["t"][:-1]
        zero(ax)
        ax.plot(t, run["command.out.x"][:-1], color=GREY, linewidth=0.9, zorder=4 if filtered else 2)
        ax.plot(t, reaching(run, "plain_tip", mass), color=VERMILION, linewidth=1.1)
        if filtered:
            ax.plot(t, reaching(run, "smooth_tip", mass), color=BLUE, linewidth=1.1)
        ax.set(xlim=(0, 200), xticks=[0, 50, 100, 150, 200], ylim=(-2.4, 2.7), yticks=[-2, -1, 0, 1, 2], ylabel="force (N)")
    phantom.set_title("PHANTOM, first mode 30 Hz")
    phantom.tick_params(labelbottom=False)
    pantograph.set_title("Pantograph, 400 Hz")
    pantograph.set_xlabel("time (ms)")
    name(pantograph, 198, 2.3, "sent, and at the tip", VERMILION, ha="right")
    name(phantom, 198, 2.3, "sent", GREY, ha="right")
    name(phantom, 198, 1.75, "at the tip", VERMILION, ha="right")
    name(phantom, 198, 1.2, "filtered, at the tip", BLUE, ha="right")

    points = data("reconstruction")
    for column, colour in (("plain", VERMILION), ("smooth", BLUE)):
        gain.plot(points["frequency"], points[column], "o-", color=colour, linewidth=0.9, markersize=3.5)
    gain.set_xscale("log")
    gain.set_yscale("log")
    gain.axhline(1, color=PALE, linewidth=0.8, zorder=0)
    gain.axvline(30, color=PALE, linewidth=0.8, zorder=0)
    name(gain, 27, 0.0035, "first mode", GREY, ha="right", fontsize=8)
    name(gain, 60, 4.5, "as it is", VERMILION)
    name(gain, 27, 0.3, "filtered", BLUE, ha="right")
    axis(gain, "A tone on the PHANTOM", "frequency (Hz)", "at the tip / sent")
    gain.minorticks_off()
    gain.set(xlim=(4.5, 230), xticks=[5, 10, 20, 50, 100, 200], xticklabels=["5", "10", "20", "50", "100", "200"], ylim=(0.0006, 12),
             yticks=[0.001, 0.01, 0.1, 1, 10], yticklabels=["0.001", "0.01", "0.1", "1", "10"])
    return fig
