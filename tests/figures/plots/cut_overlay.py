# SPDX-License-Identifier: MIT
"""Section 3, Fig. 7: three noisy responses over one synthesis."""

from style import BLUE, GREEN, GREY, INK, PALE, PURPLE, axis, data, figure, name


def draw():
    run = data("cut_overlay")
    depth, inwards = 1e3 * run["path.out"], run["t"] <= 6

    fig, ax = figure(2.9)
    ax.axhline(4, color=PALE, linewidth=0.8, zorder=0)
    for response, colour in (("response_1", BLUE), ("response_2", PURPLE), ("response_3", GREEN)):
        ax.plot(depth[inwards], run[f"{response}.out"][inwards], color=colour, linewidth=0.7)
    ax.plot(depth[inwards], run["synthesis.resistance"][inwards], color=INK)
    name(ax, 10.1, 4, "f$_\\mathrm{cut}$")
    name(ax, 3.3, 6.2, "synthesis", INK)
    name(ax, 3.3, 5.6, "three responses, made up", GREY)
    axis(ax, "Three noisy responses over one synthesis", "depth of the blade (mm)", "resistance (N)")
    ax.set(xlim=(0, 10), ylim=(-0.4, 7))
    return fig
