#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A loop of your own around a preset: your simulator moves the tool, and Tactus says what force it feels.

    own_device.py [GRAPH.json]     prints where the tool comes to rest (mm)
"""

import sys

import numpy as np

import tactus


def main() -> None:
    graph = tactus.Graph(sys.argv[1] if len(sys.argv) > 1 else "granite_wall.json")
    engine = tactus.Engine(graph, devices={"stylus": tactus.PushedDevice(guard={"max_force": "5 N"})})
    dt, mass, damping, weight = 1 / engine.rate, 0.1, 3.0, np.array([0, 0, -1.0])
    position, velocity = np.array([0, 0, 2e-3]), np.zeros(3)
    for _ in range(int(engine.rate)):
        engine.push("stylus", position)
        engine.step_rows()
        force = engine.take("stylus").force
        velocity += dt / mass * (force + weight - damping * velocity)
        position = position + dt * velocity
    print(1e3 * position)


if __name__ == "__main__":
    main()
