# SPDX-License-Identifier: MIT
"""Section 2, Fig. 2: the four adhesion functions, and how a contact behaves with each."""

import numpy as np
from style import BLUE, GREEN, INK, VERMILION, WIDTH, axis, data, name, plt, zero

FUNCTIONS = (("stick", INK, "1 stick"), ("dupont", BLUE, "2 dupont"), ("ramp", GREEN, "3 ramp"), ("dahl", VERMILION, "4 dahl"))
D_MAX = r"d$_\mathrm{max}$"


def draw():
    fig = plt.figure(figsize=(WIDTH, 4.6))
    grid = fig.add_gridspec(2, 2, height_ratios=[1.15, 1])
    zeta, loop, walk = fig.add_subplot(grid[0, 0]), fig.add_subplot(grid[0, 1]), fig.add_subplot(grid[1, :])

    points = data("adhesion_zeta")
    places = {"stick": (1.03, 0.5, "left"), "dupont": (0.80, 0.36, "right"), "ramp": (0.46, 0.56, "right"), "dahl": (0.12, 0.92, "left")}
    for at, (function, colour, text) in reversed(list(enumerate(FUNCTIONS, start=1))):
        mine = points["function"] == at
        corner = [1.0] if function != "stick" else [0.0, 1.0, 1.0]
        zeta.plot(np.append(points["r"][mine], [1.0, 1.0, 1.3][:len(corner)]), np.append(points["zeta"][mine], corner), color=colour)
        x, y, side = places[function]
        name(zeta, x, y, text, colour, ha=side)
    zeta.axvline(0.7, ymax=0.05, color=BLUE, linewidth=0.6)
    name(zeta, 0.7, 0.10, r"d$_\mathrm{ba}$", BLUE, ha="right", fontsize=8)
    axis(zeta, "How fast the contact yields", f"stretch |d| / {D_MAX}", f"ζ {D_MAX}")
    zeta.set(xlim=(0, 1.3), ylim=(-0.02, 1.08), yticks=[0, 0.5, 1], xticks=[0, 0.5, 1])

    run = data("adhesion")
    zero(loop)
    for function, colour, _ in FUNCTIONS:
        loop.plot(1e6 * run["hand.out.x"], -run[f"{function}.force.x"] / 0.5, color=colour, linewidth=1.1)
    axis(loop, "Dragged out, back, and out again", "displacement (µm)", r"drag / µ f$_\mathrm{n}$")
    loop.set(yticks=[-1, 0, 1], xticks=[-100, 0, 100, 200, 300, 400])

    run = data("adhesion_tremor")
    for function, colour, text in FUNCTIONS:
        walk.plot(run["t"], 1e6 * run[f"{function}_hand.position.x"], color=colour, linewidth=3.2 if function == "stick" else 1.1)
    end = {f: 1e6 * np.mean(run[f"{f}_hand.position.x"][-1000:]) for f, _, _ in FUNCTIONS}
    for function, colour, text in FUNCTIONS[2:]:
        name(walk, 4.05, end[function], text, colour)
    name(walk, 4.05, end["stick"] + 22, "1 stick", INK)
    name(walk, 4.05, end["stick"] - 22, "2 dupont", BLUE)
    axis(walk, "Pulled by a trembling force, at most half of what they hold", "time (s)", "position (µm)")
    walk.set(xlim=(0, 4), ylim=(-20, 510))
    return fig
