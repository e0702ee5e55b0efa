# SPDX-License-Identifier: MIT
"""Section 2: strokes that gain energy if the stiffness of friction follows the load."""

from style import BLUE, GREY, INK, VERMILION, axis, data, figure, name, zero

STROKE = 400  # ticks


def draw():
    run = data("load_strokes")
    one = slice(0, STROKE + 1)
    x, drag = 1e6 * run["hand.out.x"], -1e3 * run["scale.force.x"]
    fig, (loop, energy) = figure(3.1, 1, 2, gridspec_kw={"width_ratios": [1.15, 1]})
    loop.fill(x[one], drag[one], color=VERMILION, alpha=0.18, linewidth=0)
    loop.plot(x[one], drag[one], color=VERMILION)
    loop.plot(x[one], -1e3 * run["bound.force.x"][one], color=BLUE, linewidth=1.2)
    name(loop, 4.2, 30, "1 pull, at 0.5 N", INK, fontsize=8)
    name(loop, 8.15, 560, "2 press,\nto 3 N", INK, fontsize=8)
    name(loop, 4.4, 590, "3 let go, at 3 N", INK, ha="right", fontsize=8)
    name(loop, 0.2, 960, "scale: 3.2 µJ", VERMILION)
    name(loop, 5.0, 205, "bound", BLUE, ha="right")
    axis(loop, "One stroke", "position (µm)", "drag (mN)")
    loop.set(xlim=(-0.2, 10.4), ylim=(-20, 1040), xticks=[0, 2, 4, 6, 8], yticks=[0, 250, 500, 750, 1000])

    strokes = run["t"]
    zero(energy)
    for rule, colour, y, text in (("scale", VERMILION, 0.118, "scale"), ("passive", GREY, -0.118, "passive"), ("bound", BLUE, 0.012, "bound")):
        energy.plot(strokes[::40], -1e3 * run[f"{rule}.dissipated_energy"][::40], color=colour, linewidth=1.1)
        name(energy, 31, y, text, colour, ha="right")
    axis(energy, "What the hand has gained", "strokes", "energy (mJ)")
    energy.set(xlim=(0, 50), ylim=(-0.18, 0.18), xticks=[0, 10, 20, 30, 40, 50], yticks=[-0.16, -0.08, 0, 0.08, 0.16])
    return fig
