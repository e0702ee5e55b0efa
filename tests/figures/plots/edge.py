# SPDX-License-Identifier: MIT
"""Section 3, Fig. 5: an edge at an angle, and a cut that stays where it was made."""

import numpy as np
from style import BLUE, GREEN, INK, PURPLE, VERMILION, axis, data, figure, name


def draw():
    fig, (tilt, place) = figure(2.9, 1, 2, sharey=True)

    run = data("edge_tilted")
    for edge, degrees, colour, at in (("level", 0, INK, (3.2, 5.8)), ("tilted", 10, BLUE, (1.6, 2.6)), ("steep", 20, PURPLE, (5.2, 1.9))):
        deepest = 1e3 * (0.01 * np.sin(np.radians(degrees)) - run["down.out"])
        inside = deepest >= -0.2
        tilt.plot(deepest[inside], run[f"{edge}.resistance"][inside], color=colour)
        name(tilt, *at, f"{degrees}°", colour)
    axis(tilt, "Pressed in at an angle", "depth of the lower end (mm)", "resistance (N)")
    tilt.set(xlim=(0, 13), ylim=(-0.15, 6.6))

    run = data("edge_moved")
    t, depth, force = run["t"], -1e3 * run["strokes.out"], run["moved.resistance"]
    for start, end, colour, style in ((0, 2, INK, "-"), (3, 5, GREEN, "-"), (6.5, 8.5, VERMILION, (0, (3, 1.6)))):
        part = (t >= start) & (t < end)
        place.plot(depth[part], force[part], color=colour, linestyle=style)
    name(place, 3.3, 6.0, "first cut", INK)
    name(place, 3.3, 5.4, "5 mm aside", VERMILION)
    name(place, 5.35, 1.2, "back in\nthe first cut", GREEN, ha="right")
    axis(place, "Pressed in three times", "depth (mm)", "")
    place.set(xlim=(0, 9))
    return fig
