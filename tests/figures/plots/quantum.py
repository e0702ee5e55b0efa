# SPDX-License-Identifier: MIT
"""Section 1: the energy of one step of the sensor, and the friction that takes it."""

from style import BLUE, GREY, INK, PALE, SKY, VERMILION, WIDTH, axis, data, name, plt


def draw():
    run = data("quantum")
    p, f = 1e6 * run["press.out"], 1e3 * run["spring.resistance"]
    fig = plt.figure(figsize=(WIDTH, 3.1))
    grid = fig.add_gridspec(2, 2, width_ratios=[1, 1.1])
    ax = fig.add_subplot(grid[:, 0])
    hunts, rests = fig.add_subplot(grid[0, 1]), fig.add_subplot(grid[1, 1])

    ax.fill([0, 10, 10], [0, 0, 20], color=SKY, alpha=0.35, linewidth=0)
    ax.fill([0, 0, 10], [0, 20, 20], color=VERMILION, alpha=0.22, linewidth=0)
    ax.plot([0, 10], [0, 20], color=GREY, linewidth=0.9)
    ax.plot([0, 10], [10, 10], color=INK, linewidth=0.8, linestyle=(0, (4, 3)))
    ax.step(p[:21], f[:21], where="post", color=BLUE)
    ax.step(p[20:], f[20:], where="post", color=VERMILION)
    name(ax, 9.7, 2.2, "in: too weak, ½ σδ²", BLUE, ha="right")
    name(ax, 0.3, 18.2, "out: too strong, ½ σδ²", VERMILION)
    name(ax, 0.3, 11.3, "σδ/2", INK)
    name(ax, 7.3, 13.4, "the spring", GREY, fontsize=8)
    axis(ax, "One step of the sensor, in and out", "position (µm)", "force (mN)")
    ax.set(xlim=(-0.4, 10.6), ylim=(-1, 22), xticks=[0, 5, 10], yticks=[0, 5, 10, 15, 20])

    for place, run, colour, text in ((hunts, "quantum_hunts", VERMILION, "friction of 9.9 mN: it hunts"), (rests, "quantum_rests", BLUE, "10.1 mN: it rests")):
        record = data(run)
        part = (record["t"] > 0.2) & (record["t"] < 0.3)
        z = 1e6 * (record["hand.position.z"][part] + 0.01)
        place.step(1e3 * record["t"][part], z, where="post", color=colour, linewidth=0.8)
        place.set(xlim=(230, 280), ylim=(-23, 12), yticks=[-20, -10, 0], ylabel="position (µm)")
        place.grid(axis="y", color=PALE, linewidth=0.6)
        name(place, 279, 7, text, colour, ha="right")
    hunts.tick_params(labelbottom=False)
    hunts.set_title("A tool between two steps")
    rests.set_xlabel("time (ms)")
    return fig
