# SPDX-License-Identifier: MIT
"""Section 2: stick-slip that does not depend on time."""

from style import BLUE, INK, PALE, axis, data, figure, name, np


def draw():
    slow, fast = data("stick_slip_slow"), data("stick_slip_fast")
    fig, ax = figure(2.5)
    ax.plot(1e3 * slow["hand.out.x"], -slow["contact.force.x"], color=BLUE, linewidth=2.4)
    ax.plot(1e3 * fast["hand.out.x"], -fast["contact.force.x"], color=INK, linewidth=0.9)
    name(ax, 1.01, 0.80, "2 mm/s", BLUE)
    name(ax, 1.01, 0.66, "20 mm/s", INK)
    for level, text in ((1.0, r"µ$_\mathrm{s}$ f$_\mathrm{n}$"), (0.4, r"µ$_\mathrm{k}$ f$_\mathrm{n}$")):
        ax.axhline(level, color=PALE, linewidth=0.8, zorder=0)
        name(ax, 1.01, level, text)
    ax.annotate("", xy=(0.40, 0.28), xytext=(0.55, 0.28), arrowprops={"arrowstyle": "<->", "color": INK, "linewidth": 0.7, "shrinkA": 0, "shrinkB": 0})
    name(ax, 0.475, 0.19, r"d$_\mathrm{stick}$ − d$_\mathrm{max}$", ha="center")
    axis(ax, "Teeth at the same places at any speed", "displacement (mm)", "drag (N)")
    ax.set(xlim=(0, 1), ylim=(0, 1.08), xticks=np.arange(0, 1.01, 0.25))
    return fig
