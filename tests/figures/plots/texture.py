# SPDX-License-Identifier: MIT
"""Section 5, Fig. 10: a texture on top of the force of a stroke."""

from style import BLUE, GREY, PALE, VERMILION, axis, data, figure, name, note


def draw():
    run = data("texture")
    x, t = 1e3 * run["hand.out.x"], run["t"]
    fig, (near, whole) = figure(4.0, 2, 1)

    part = x <= 22
    near.plot(x[part], -run["drag.force.x"][part], color=GREY, linewidth=0.9)
    near.plot(x[part], -run["felt.out.x"][part], color=BLUE, linewidth=1.2)
    note(near, "friction alone", (0.7, 0.4), (0.25, 0.56), ha="left", va="center")
    name(near, 5.3, 0.55, "with ridges 2 mm apart", BLUE)
    axis(near, "The first 22 mm of a stroke that speeds up", "position (mm)", "drag (N)")
    near.set(xlim=(0, 22), xticks=[0, 5, 10, 15, 20], ylim=(0, 0.6), yticks=[0, 0.2, 0.4, 0.6])

    f = 500 * run["guard.speed"]
    whole.plot(f, 1e3 * -(run["felt.out.x"] - run["drag.force.x"]), color=BLUE, linewidth=0.8)
    for sign in (1, -1):
        whole.plot(f, sign * 100 * run["guard.gain"], color=VERMILION, linewidth=1.0)
    name(whole, 60, 78, "the guard", VERMILION)
    for at in (40, 80):
        whole.axvline(at, color=PALE, linewidth=0.8, zorder=0)
    axis(whole, "The whole stroke: ridges that pass too fast are faded out", "ridges per second, k v (Hz)", "texture (mN)")
    whole.set(xlim=(0, 95), ylim=(-110, 110), xticks=[0, 20, 40, 60, 80],
              xticklabels=["0", "20", "40 = f$_\\mathrm{max}$/2", "60", "80 = f$_\\mathrm{max}$"], yticks=[-100, 0, 100])
    return fig
