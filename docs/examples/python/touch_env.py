#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""An environment with the API of Gymnasium: an agent moves a finger of 50 g, and learns to press a surface with a certain force while it slides.

    touch_env.py [GRAPH.json]     lets a simple controller play an episode, and prints its return

A step of the environment lasts 20 ms, and in it the finger moves in steps of 1 ms over the ticks of the graph. If gymnasium is installed, the environment is
a gymnasium.Env; otherwise it has the same functions and spaces of its own. Register it with gymnasium.register ("Touch-v0", TouchEnv, max_episode_steps=200).
"""

import importlib
import sys
from typing import Any, Dict, Optional, Tuple

import numpy as np
from numpy.typing import NDArray

import tactus

Array = NDArray[np.float64]
MASS, DAMPING = 0.05, 4.0         # of the finger, in kg and N s/m
STEP, SUBSTEP = 0.02, 0.001       # in s
MOST_FORCE = 2.0                  # of the agent, in N


class Box:
    """The part of gymnasium.spaces.Box that is used here."""

    def __init__(self, low: float, high: float, shape: Tuple[int, ...], dtype: Any = np.float64):
        self.low, self.high, self.shape, self.dtype = np.full(shape, low), np.full(shape, high), shape, dtype
        self.random = np.random.default_rng()

    def contains(self, x: Array) -> bool:
        return x.shape == self.shape and bool(np.all(x >= self.low) and np.all(x <= self.high))

    def sample(self) -> Array:
        return self.random.uniform(np.maximum(self.low, -1e3), np.minimum(self.high, 1e3))


class Env:
    """The part of gymnasium.Env that is used here."""

    np_random = np.random.default_rng()

    def reset(self, *, seed: Optional[int] = None, options: Optional[Dict[str, Any]] = None) -> Any:
        if seed is not None:
            self.np_random = np.random.default_rng(seed)


Base: Any = Env
try:
    gymnasium: Any = importlib.import_module("gymnasium")
    Base, Box = gymnasium.Env, gymnasium.spaces.Box   # type: ignore[misc]
except ImportError:
    pass


class TouchEnv(Base):   # type: ignore[misc]
    """action (3,): the force of the muscles, as a part of MOST_FORCE. observation (10,): position in mm, velocity in m/s, the force that is felt in N, the
    force to press with in N. reward: 1 less the error of the pressing force in N, and something for sliding along x. The episode terminates when the finger
    is 2 cm away from where it began, across the way of the slide, or when the guard has stopped the force: info["stop"] says why."""

    metadata: Dict[str, Any] = {"render_modes": []}
    render_mode = None

    def __init__(self, graph: str = "dry_wood.json", role: str = "stylus"):
        finger = tactus.PushedDevice(between="linear", step_effort="mean", guard={"max_force": "10 N"}, simulated=True)
        self.engine, self.role = tactus.Engine(tactus.Graph(graph), devices={role: finger}), role
        self.start = self.engine.save()
        self.action_space = Box(-1.0, 1.0, (3,), dtype=np.float64)
        self.observation_space = Box(-np.inf, np.inf, (10,), dtype=np.float64)

    def reset(self, *, seed: Optional[int] = None, options: Optional[Dict[str, Any]] = None) -> Tuple[Array, Dict[str, Any]]:
        super().reset(seed=seed)
        self.engine.restore(self.start)   # microseconds, instead of a new engine
        self.position, self.velocity, self.felt = np.array([0.0, 0.0, 1e-3]), np.zeros(3), np.zeros(3)
        self.wanted = float((options or {}).get("force", self.np_random.uniform(0.2, 1.0)))
        return self._observation(), {}

    def step(self, action: Array) -> Tuple[Array, float, bool, bool, Dict[str, Any]]:
        muscles = MOST_FORCE * np.clip(np.asarray(action, dtype=float), -1.0, 1.0)
        pressed, start = 0.0, self.position[0]
        count = round(STEP / SUBSTEP)
        for _ in range(count):
            self.engine.push(self.role, self.position)
            self.engine.step(SUBSTEP)
            effort = self.engine.take(self.role)
            self.felt = effort.force
            self.velocity = self.velocity + SUBSTEP / MASS * (muscles + self.felt - DAMPING * self.velocity)
            self.position = self.position + SUBSTEP * self.velocity
            pressed += self.felt[2] / count
        slid = min(abs(self.position[0] - start) / STEP, 0.1)   # m/s
        reward = 1.0 - abs(pressed - self.wanted) + 5.0 * slid
        terminated = bool(np.hypot(self.position[1], self.position[2]) > 0.02) or effort.stop != ""
        return self._observation(), float(reward), terminated, False, {"pressed": pressed, "stop": effort.stop}

    def close(self) -> None:
        self.engine.stop()

    def _observation(self) -> Array:
        return np.concatenate([1e3 * self.position, self.velocity, self.felt, [self.wanted]])


def main() -> None:
    env = TouchEnv(sys.argv[1] if len(sys.argv) > 1 else "dry_wood.json")
    observation, _ = env.reset(seed=1)
    total, pressed = 0.0, 0.0
    for k in range(200):
        push = -observation[9] / MOST_FORCE                           # as much as is wanted, and to and fro along x
        slide = 0.4 * np.sign(np.sin(2 * np.pi * k * STEP / 0.5))
        observation, reward, terminated, _, info = env.step(np.array([slide, 0.0, push]))
        total, pressed = total + reward, info["pressed"]
        if terminated:
            break
    print(f"return {total:.1f}; wanted {observation[9]:.2f} N, pressed {pressed:.2f} N")
    env.close()


if __name__ == "__main__":
    main()
