# SPDX-License-Identifier: MIT
"""Section 5, Fig. 10: what a texture over a surface does to the tool."""

import numpy as np
from style import BLUE, GREY, PALE, VERMILION, axis, data, figure, name, zero


def draw():
    run = data("texture_surface")
    t = 1e3 * run["t"]
    fig, (force, shaken) = figure(3.8, 2, 1, sharex=True)
    force.plot(t, -run["drag.force.x"], color=GREY, linewidth=0.9)
    force.plot(t, -run["motor.force.x"], color=VERMILION, linewidth=0.9)
    name(force, 398, 0.57, "friction and ridges", VERMILION, ha="right")
    axis(force, "A tool of 100 g is pulled over a surface with ridges 2 mm apart", "", "drag (N)")
    force.set(ylim=(0, 0.65), yticks=[0, 0.2, 0.4, 0.6])

    zero(shaken)
    for sign in (1, -1):
        shaken.axhline(sign, color=PALE, linewidth=0.8, zorder=0)
    shaken.plot(t[:-1], 4000 * np.diff(run["tip.velocity.x"]), color=BLUE, linewidth=0.9)
    name(shaken, 398, 1.45, "± 0.1 N / 100 g", GREY, ha="right")
    axis(shaken, "Its acceleration", "time (ms)", "acceleration (m/s²)")
    shaken.set(xlim=(0, 400), ylim=(-1.5, 7), xticks=[0, 100, 200, 300, 400], yticks=[-1, 0, 1, 2, 4, 6])
    return fig
