#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes tests/golden/flexible_tool.csv and .json: a tool on a structure that
bends, with Coulomb friction at the motor, pushed by forces that are held.

  m_m v_m' = F_m - B v_m - f_f sgn (v_m) + k s + c (v_e - v_m), s = x_e - x_m
  m_e v_e' = F_h - k s - c (v_e - v_m)
  k = m_e (2 pi F_0)^2, c = 2 zeta m_e 2 pi F_0

Integrated by scipy's DOP853, phase by phase: the motor sticks, or slips in one
direction. Needs scipy. Usage: flexible_tool.py [FOLDER]
"""

import json
import math
import pathlib
import random
import sys

from scipy.integrate import solve_ivp

T, ROWS = 1e-3, 240
CASES = {
    "soft": {"M": 0.08, "end_mass": 0.03, "B": 0.2, "coulomb": 0.4, "F0": 30.0,
             "zeta": 0.05, "x": 0.01, "v": 0.0},
    "stiff": {"M": 0.1, "end_mass": 0.05, "B": 2.0, "coulomb": 0.6, "F0": 400.0,
              "zeta": 0.02, "x": -0.02, "v": 0.05},
    "heavy": {"M": 0.1, "end_mass": 0.08, "B": 0.0, "coulomb": 0.7, "F0": 150.0,
              "zeta": 0.3, "x": 0.0, "v": -0.1},
}


class Tool:
    def __init__(self, M, end_mass, B, coulomb, F0, zeta, x, v):
        self.m, self.e, self.b, self.f = M - end_mass, end_mass, B, coulomb
        w = 2.0 * math.pi * F0
        self.k, self.c = end_mass * w * w, 2.0 * zeta * end_mass * w
        self.y = [x, v, 0.0, v]   # motor position and speed, stretch, end speed

    def load(self, y, motor):
        return motor + self.k * y[2] + self.c * (y[3] - y[1]) - self.b * y[1]

    def rates(self, y, way, motor, hand):
        elastic = self.k * y[2] + self.c * (y[3] - y[1])
        push = 0.0 if way == 0 else (self.load(y, motor) - way * self.f) / self.m
        return [y[1], push, y[3] - y[1], (hand - elastic) / self.e]

    def way(self, motor):
        """1 or -1 if the motor slips in this direction, 0 if it sticks."""
        if self.y[1] != 0.0:
            return math.copysign(1, self.y[1])
        load = self.load(self.y, motor)
        return 0 if abs(load) <= self.f else math.copysign(1, load)

    def tick(self, motor, hand):
        t, way = 0.0, self.way(motor)
        while t < T:
            def end(_, y, way=way):
                return way * y[1] if way else self.f - abs(self.load(y, motor))
            end.terminal, end.direction = True, -1
            run = solve_ivp(lambda _, y, way=way: self.rates(y, way, motor, hand),
                            (t, T), self.y, method="DOP853", rtol=1e-13,
                            atol=1e-15, max_step=T / 8, events=end)
            t, self.y = run.t[-1], list(run.y[:, -1])
            if run.status != 1:
                return
            if way:
                self.y[1] = 0.0
                way = self.way(motor)
            else:
                way = math.copysign(1, self.load(self.y, motor))


def forces():
    """A push that grows and falls, a tremor on top, and some sudden changes."""
    dice, level = random.Random(7), 0.0
    for k in range(ROWS):
        if k % 40 == 0:
            level = dice.uniform(-1.0, 1.0)
        yield (level + 0.4 * math.sin(0.21 * k) if k < 200 else 0.0,
               0.3 * math.cos(0.13 * k) + dice.uniform(-0.2, 0.2))


def main():
    folder = pathlib.Path(__file__).parent.parent
    if len(sys.argv) > 1:
        folder = pathlib.Path(sys.argv[1])
    tools = {name: Tool(**case) for name, case in CASES.items()}
    columns = [f"{q}_{name}" for name in tools for q in ("x", "v", "s", "e")]
    lines = [",".join(["t", "motor", "hand", *columns])]
    for k, (motor, hand) in enumerate(forces()):
        cells = [k * T, motor, hand, *(a for tool in tools.values() for a in tool.y)]
        lines.append(",".join(f"{a:.17g}" for a in cells))
        for tool in tools.values():
            tool.tick(motor, hand)
    about = {
        "name": "flexible_tool", "model": "flexible_tool", "T": T, "rows": ROWS,
        "params": {f"{key}_{name}": value for name, case in CASES.items() for key, value in case.items()},
        "inputs": ["motor", "hand"], "expected": columns,
        "tolerance": {"x_": {"abs": 1e-11}, "v_": {"abs": 1e-8},
                      "s_": {"abs": 1e-11}, "e_": {"abs": 1e-8}},
        "notes": "state at the start of each tick (x, v: motor; s: stretch; e: speed "
                 "of the end), forces held over the tick; tests/golden/reference/"
                 "flexible_tool.py",
    }
    (folder / "flexible_tool.csv").write_text("\n".join(lines) + "\n")
    (folder / "flexible_tool.json").write_text(json.dumps(about, indent=1) + "\n")


if __name__ == "__main__":
    main()
