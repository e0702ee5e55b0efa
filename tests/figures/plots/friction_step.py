# SPDX-License-Identifier: MIT
"""Section 2, Fig. 3: how one step of the tool moves its contact point."""

from style import BLUE, GREY, INK, VERMILION, data, figure, name, np

TURN = np.linspace(0, 2 * np.pi, 200)


def line(ax, start, end, colour):
    ax.plot(*np.array([start, end]).T, color=colour, linewidth=0.8)


def circle(ax, at):
    ax.plot(at[0] + np.cos(TURN), at[1] + np.sin(TURN), color=GREY, linewidth=0.7, linestyle=(0, (4, 3)))
    to = at + (np.cos(2.2), np.sin(2.2))
    line(ax, at, to, GREY)
    name(ax, *(at + to) / 2 + (0.08, 0.12), "d$_\\mathrm{max}$", GREY)


def dot(ax, at, colour, face=None):
    ax.plot(*at, "o", markersize=5, color=colour, markerfacecolor=face or colour, zorder=5)


def arrow(ax, start, end, colour, width):
    ax.annotate("", xy=end, xytext=start, zorder=4, arrowprops={
        "arrowstyle": "-|>", "color": colour, "linewidth": width, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 9})


def frame(ax, title, x, y):
    ax.set_title(title)
    ax.set(aspect="equal", xlim=x, ylim=y)
    ax.axis("off")


def draw():
    run = data("friction_step")
    p = 1e3 * np.c_[run["tool.out.x"], run["tool.out.y"]]
    c = p - 1e3 * np.c_[run["contact.deflection.x"], run["contact.deflection.y"]]
    slid = run["contact.state"] == 2

    fig, (sticks, slips, turns) = figure(2.0, 1, 3, gridspec_kw={"width_ratios": [2.4, 3.2, 4.4]})

    circle(sticks, p[1])
    line(sticks, p[1], c[1], BLUE)
    arrow(sticks, p[1], p[1] + 0.65 * (c[1] - p[1]), BLUE, 1.6)
    dot(sticks, p[1], INK)
    dot(sticks, c[1], BLUE)
    name(sticks, *p[1] + (0.12, 0.0), "p$_1$")
    name(sticks, *c[1] + (0.04, -0.27), "c$_1$ = c$_0$", BLUE)
    name(sticks, *p[1] + (-0.2, -0.3), "f", BLUE)
    frame(sticks, "A step that sticks", (-0.5, 1.9), (-0.9, 2.05))

    circle(slips, p[2])
    line(slips, p[2], c[1], GREY)
    arrow(slips, c[1], c[2], GREY, 0.8)
    arrow(slips, p[2], p[2] + 0.85 * (c[2] - p[2]), VERMILION, 1.6)
    dot(slips, p[2], INK)
    dot(slips, c[1], GREY, "white")
    dot(slips, c[2], VERMILION)
    name(slips, *p[2] + (0.12, 0.0), "p$_2$")
    name(slips, *c[1] + (0.0, -0.27), "c$_1$", GREY, ha="center")
    name(slips, *c[2] + (-0.12, 0.24), "c$_2$", VERMILION, ha="right")
    name(slips, *p[2] + (-0.25, -0.35), "f", VERMILION)
    frame(slips, "A step that slips", (-0.2, 3.0), (-0.9, 2.05))

    turns.plot(*p.T, color=INK, linewidth=0.9)
    turns.plot(*c.T, color=GREY, linewidth=0.8, linestyle=(0, (2, 1.5)))
    away = ((-0.12, 0.2), (0.0, 0.24), (0.1, 0.2), (0.16, 0.12), (0.18, 0), (0.14, -0.16), (-0.2, -0.12))
    for k, shift in enumerate(away):
        colour = VERMILION if slid[k] else BLUE
        line(turns, p[k], c[k], colour)
        dot(turns, p[k], INK)
        dot(turns, c[k], colour)
        name(turns, *p[k] + shift, str(k), ha="center", fontsize=7.5)
    frame(turns, "Six steps", (-0.4, 4.0), (-1.55, 1.4))
    return fig
