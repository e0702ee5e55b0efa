# SPDX-License-Identifier: MIT
"""Section 4, Fig. 9: responses given at some points, and interpolated between them."""

import numpy as np
from style import GREY, INK, VERMILION, axis, data, figure, name

MARKS = "ABCDabc"


def draw():
    run = data("patch")
    places = [run["place"] == i for i in range(len(MARKS))]

    fig, (plan, curves) = figure(3.2, 1, 2, gridspec_kw={"width_ratios": [1, 1.35]})
    corner = np.array([[0, 0], [40, 0], [40, 40], [0, 40], [0, 0], [40, 40]])
    plan.plot(*corner.T, color=GREY, linewidth=0.8)
    for mark, mine in zip(MARKS, places):
        x, y = 1e3 * run["x"][mine][0], 1e3 * run["y"][mine][0]
        known = mark.isupper()
        colour = INK if known else VERMILION
        plan.plot(x, y, "o", color=colour, markersize=5, clip_on=False, zorder=4)
        dx = -3.2 if x == 0 or 32 < x < 40 else 3.2  # keeps the label clear of the sides
        name(plan, x + dx, y, mark, colour, ha="center", fontweight="semibold")

        depth, force = 1e3 * run["depth"][mine], run["resistance"][mine]
        part = depth <= 4
        curves.plot(depth[part], force[part], color=colour, linewidth=1.0 if known else 1.4)
        nearly_equal = {"c": 0.12, "A": -0.12}  # their labels would overlap
        name(curves, 4.06, force[part][-1] + nearly_equal.get(mark, 0), mark, colour, fontweight="semibold")
    name(plan, 20, -4, "40 mm", GREY, ha="center")
    plan.set(title="A patch of two triangles", aspect="equal", anchor="N", xlim=(-5, 45), ylim=(-7, 43))
    plan.axis("off")
    axis(curves, "Given at A–D, interpolated at a–c", "depth (mm)", "resistance (N)")
    curves.set(xlim=(0, 4), ylim=(0, None))
    return fig
