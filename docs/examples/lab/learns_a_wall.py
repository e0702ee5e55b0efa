# SPDX-License-Identifier: MIT
"""A participant that learns a wall: it aims at a force of 1 N, presses as deep as it believes to be right, feels the force of the graph, and corrects its
belief of the stiffness."""

from typing import List

import numpy as np
import tactus
from tactus import lab

AIM = 1.0   # N


def wall(stiffness: float) -> tactus.Graph:
    graph = tactus.Graph(name="wall", rate=1000)
    graph.add_node("wall", "deform.plane", {"stiffness": stiffness, "dissipation": 0.0})
    return graph


def press(graph: tactus.Graph, depth: float) -> float:
    """The force in N at a depth in m."""
    run = graph.render(feed={"wall.position": np.tile([0.0, 0.0, -depth], (20, 1))}, record=["wall.force"])
    return float(run["wall.force"][-1, 2])


def learn(trials: int = 12, rate: float = 0.5) -> List[float]:
    """The forces in N of all trials; the wall becomes stiffer in the middle."""
    belief, forces = 200.0, []
    for trial in range(trials):
        depth = AIM / belief
        forces.append(press(wall(500.0 if trial < trials // 2 else 900.0), depth))
        belief *= (forces[-1] / AIM) ** rate
    return forces


if __name__ == "__main__":
    found = learn()
    print(lab.Table({"trial": np.arange(1, len(found) + 1), "force": np.array(found)}, {"force": "N"})._repr_html_())
