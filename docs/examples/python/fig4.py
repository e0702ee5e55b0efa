#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws Fig. 4 of Hayward, "Physically-Based Haptic Synthesis" (2007): a tool moved over a surface, and the leash to its contact point.

    fig4.py [PICTURE.png]     the notebook fig4.ipynb does the same step by step
"""

import importlib
import sys
from typing import Any

import numpy as np

import tactus


def make_graph() -> tactus.Graph:
    """A path with sharp turns and loops, and the contact that follows it on a leash of 1 mm."""
    graph = tactus.Graph(name="A tool led over a surface", rate=2000)
    for name, frequency, amplitude, phase in (("sweep_x", "0.25 Hz", "9 mm", 0), ("sweep_y", "0.5 Hz", "4 mm", 0),
                                              ("curl_x", "1.75 Hz", "1.4 mm", 0), ("curl_y", "1.75 Hz", "1.4 mm", "90 deg")):
        graph.add_node(name, "signal.lfo", {"frequency": frequency, "amplitude": amplitude, "phase": phase})
    for name in ("hand", "curl"):
        graph.add_node(name, "vector.join")
    graph.add_node("tool", "vector.add")
    graph.add_node("contact", "friction.elasto_plastic", {"mu": 0.5, "d_max": "1 mm"})
    for wire in ("sweep_x.out -> hand.x", "sweep_y.out -> hand.y", "curl_x.out -> curl.x", "curl_y.out -> curl.y",
                 "hand.out -> tool.in[0]", "curl.out -> tool.in[1]", "tool.out -> contact.position"):
        graph.connect(wire)
    return graph


def draw(run: tactus.Records, ax: Any) -> None:
    tool = 1e3 * run["tool.out"][:, :2]                                # (n, 2), mm
    contact = tool - 1e3 * run["contact.deflection"][:, :2]
    slips = run["contact.state"] == 2
    for k in range(0, len(tool), 16):
        ax.plot(*np.stack([tool[k], contact[k]], axis=1), color="tab:red" if slips[k] else "tab:blue", linewidth=0.6)
    ax.plot(*tool.T, color="black", linewidth=0.9)
    ax.set(title="The contact point sticks (blue) or is dragged along (red)", xlabel="x (mm)", ylabel="y (mm)", aspect="equal")


def main() -> None:
    run = make_graph().render(duration=4.0, record=["tool.out", "contact.deflection", "contact.state"])
    pyplot: Any = importlib.import_module("matplotlib.pyplot")   # it has no types

    figure, ax = pyplot.subplots(figsize=(6, 3.7), constrained_layout=True)
    draw(run, ax)
    figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "fig4.png", dpi=200)


if __name__ == "__main__":
    main()
