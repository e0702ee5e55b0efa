# SPDX-License-Identifier: MIT
"""Section 1: what a higher rate buys, and what it does not."""

import numpy as np
from style import BLUE, GREY, VERMILION, axis, data, figure, name


def draw():
    points = data("rate_limits")
    rate = points["rate"] / 1e3
    line = np.geomspace(1, 16, 200)
    fig, (stiff, damp) = figure(2.9, 1, 2)
    for ax in (stiff, damp):
        ax.set_xscale("log", base=2)
        ax.set(xlim=(0.9, 18), xticks=[1, 2, 4, 8, 16], xticklabels=["1", "2", "4", "8", "16"])
        ax.minorticks_off()

    stiff.plot(line, 4 * line, color=BLUE, linewidth=0.9)
    stiff.plot(rate, points["stiffness"] / 1e3, "o", color=BLUE, markersize=4.5, markeredgecolor="white", markeredgewidth=0.6)
    stiff.set_yscale("log", base=2)
    name(stiff, 6.6, 34, "2B/T", BLUE, ha="right")
    axis(stiff, "Stiffness: twice the rate, twice as stiff", "rate (kHz)", "stiffest wall (N/mm)")
    stiff.minorticks_off()
    stiff.set(ylim=(3, 80), yticks=[4, 8, 16, 32, 64], yticklabels=["4", "8", "16", "32", "64"])

    damp.axhline(2, color=GREY, linewidth=0.8)
    damp.plot(line, 2 - 0.5 / line, color=VERMILION, linewidth=0.9)
    damp.plot(rate, points["damping"], "o", color=VERMILION, markersize=4.5, markeredgecolor="white", markeredgewidth=0.6)
    name(damp, 1.0, 2.1, "B, the damping of the device", GREY)
    name(damp, 2.2, 1.62, "B − KT/2, at 1 N/mm", VERMILION)
    axis(damp, "Damping: no more than the device has", "rate (kHz)", "largest virtual damping (N s/m)")
    damp.set(ylim=(0, 2.4), yticks=[0, 0.5, 1, 1.5, 2])
    return fig
