# SPDX-License-Identifier: MIT
"""Section 6, eq. (10): the loop of an impact, and the fraction of speed that comes back."""

from style import BLUE, GREEN, INK, VERMILION, axis, data, figure, name, np


def draw():
    fig, (loop, returned) = figure(3.0, 1, 2)
    for run, colour, text, x, y in (("slow", GREEN, "0.5 m/s", 0.87, 19), ("middle", BLUE, "1 m/s", 1.47, 27), ("fast", VERMILION, "2 m/s", 2.25, 52)):
        record = data(f"restitution_{run}")
        depth, force = 1e3 * record["wall.depth"], record["wall.resistance"]
        loop.plot(depth[depth > 0][::2], force[depth > 0][::2], color=colour)
        name(loop, x, y, text, colour, fontsize=8)
    axis(loop, "Into the wall and out again", "depth (mm)", "resistance (N)")
    loop.set(xlim=(0, 2.65), ylim=(0, None))

    law, points = data("restitution_law"), data("restitution")
    returned.plot(np.append(0, law["v"]), np.append(1, law["e"]), color=INK, linewidth=0.9)
    returned.plot(points["v"], points["felt"], "o", color=BLUE, markersize=5, markeredgecolor="white", markeredgewidth=0.6)
    returned.plot(points["v"], points["played"], ".", color=VERMILION, markersize=3.5)
    for y, marker, size, colour, text in ((0.94, "o", 5, BLUE, "felt: deform.plane"), (0.86, ".", 3.5, VERMILION, "played: shock.hunt_crossley")):
        returned.plot(1.35, y, marker, color=colour, markersize=size, markeredgewidth=0)
        name(returned, 1.5, y, text, colour, fontsize=8)
    returned.plot([1.2, 1.42], [0.78, 0.78], color=INK, linewidth=0.9)
    name(returned, 1.5, 0.78, "the closed form", fontsize=8)
    axis(returned, "What is left of its speed", "speed of impact (m/s)", "restitution e")
    returned.set(xlim=(0, 4.2), ylim=(0, 1), yticks=[0, 0.25, 0.5, 0.75, 1])
    return fig
