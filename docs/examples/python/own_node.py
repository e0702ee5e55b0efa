#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A node of your own in Python: a magnet that pulls the tool towards a point. For trying out a model; it does not run live.

    own_node.py     prints the largest force (N) for three strengths
"""

from typing import Any, Dict

import numpy as np

import tactus


class Magnet(tactus.Node):
    """Pulls the tool towards a point, with the largest force at the distance `reach`."""

    id = "own.magnet"
    inputs = {"position": tactus.vector("m", "tool position")}
    params = {"pull": tactus.scalar("N", "largest force", default=1.0, hard=(0, None)),
              "reach": tactus.scalar("m", "distance at which the force is largest", default=1e-2, hard=(1e-6, None))}
    outputs = {"force": tactus.vector("N", "force on the tool")}

    def tick(self, inputs: Any, params: Any) -> Dict[str, Any]:
        r = inputs.position / params.reach
        return {"force": -params.pull * r * np.exp((1 - r @ r) / 2)}


def make_graph() -> tactus.Graph:
    graph = tactus.Graph(rate=4000)
    graph.add_node("hand", "device.position", role="stylus")
    graph.add_node("magnet", "own.magnet")
    graph.add_node("motor", "device.force", role="stylus")
    graph.connect("hand.position", "magnet.position")
    graph.connect("magnet.force", "motor.force")
    graph.set_device("stylus", {"driver": "sim", "mass": "50 g", "hand": {"stiffness": 200, "damping": 2, "path": "stroke"}})
    return graph


def main() -> None:
    for point in tactus.sweep(make_graph(), {"magnet.pull": [0.5, 1, 2]}, duration=1.0, nodes=[Magnet]):
        print(point.set, np.linalg.norm(point.result["motor.force"], axis=1).max())


if __name__ == "__main__":
    main()
