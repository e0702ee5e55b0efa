# SPDX-License-Identifier: MIT
"""Section 4, Fig. 8: how the size of a tool changes the response."""

from style import BLUE, GREY, VERMILION, axis, data, figure, name


def draw():
    run = data("tools")
    depth = 1e3 * run["depth"]
    part = (depth >= 0.05) & (depth <= 4.5)

    fig, ax = figure(2.9)
    for between, share in (("quarter", "¼"), ("half", "½"), ("three_quarters", "¾")):
        ax.plot(depth[part], run[between][part], color=GREY, linewidth=0.8)
    for tool, colour, text in (("thin", BLUE, "thin tool"), ("wide", VERMILION, "four times as wide")):
        ax.plot(depth[part], run[tool][part], color=colour)
        name(ax, 4.57, run[tool][part][-1], text, colour)
    name(ax, 4.57, run["quarter"][part][-1], "between them", GREY)
    axis(ax, "Two tools on the same pad", "depth (mm)", "resistance (N)")
    ax.set(xlim=(0, 4.5), yscale="log", ylim=(1e-4, 20), yticks=[1e-4, 1e-3, 1e-2, 1e-1, 1, 10],
           yticklabels=["0.1 mN", "1 mN", "10 mN", "0.1 N", "1 N", "10 N"], ylabel="resistance")
    ax.minorticks_off()
    return fig
