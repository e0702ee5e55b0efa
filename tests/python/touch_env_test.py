#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The example of an environment has the API of Gymnasium: what its checker asks of reset, step, spaces and seeds. The checker itself is not in Debian."""

import inspect
import subprocess
import sys
import unittest

import numpy as np
from support import GRAPHS, ROOT, TestCase, quiet

sys.path.insert(0, str(ROOT / "docs/examples/python"))
import touch_env   # noqa: E402

WOOD = str(GRAPHS / "dry_wood.json")


def episode(env, seed, steps=30):
    """What an episode of fixed actions gives."""
    found = [quiet(env.reset, seed=seed)[0]]
    for action in np.random.default_rng(7).uniform(-1, 1, (steps, 3)):
        observation, reward, terminated, truncated, info = env.step(action)
        found.append(np.append(observation, [reward, terminated, truncated, info["pressed"]]))
    return np.concatenate(found)


class Environment(TestCase):
    def setUp(self):
        self.env = quiet(touch_env.TouchEnv, WOOD)
        self.addCleanup(self.env.close)

    def test_the_api(self):
        self.assertEqual(list(inspect.signature(self.env.reset).parameters), ["seed", "options"])
        self.assertTrue(all(p.kind is p.KEYWORD_ONLY for p in inspect.signature(self.env.reset).parameters.values()))
        observation, info = quiet(self.env.reset, seed=1)
        self.assertIsInstance(info, dict)
        self.assertTrue(self.env.observation_space.contains(observation))
        self.assertEqual(observation.dtype, self.env.observation_space.dtype)
        for _ in range(5):
            action = self.env.action_space.sample()
            self.assertTrue(self.env.action_space.contains(action))
            observation, reward, terminated, truncated, info = self.env.step(action)
            self.assertTrue(self.env.observation_space.contains(observation))
            self.assertTrue(np.all(np.isfinite(observation)))
            self.assertEqual((type(reward), type(terminated), type(truncated), type(info)), (float, bool, bool, dict))
        self.assertIn("render_modes", self.env.metadata)

    def test_a_seed_gives_the_same_episode_bit_for_bit(self):
        first = episode(self.env, 3)
        self.same_bits(first, episode(self.env, 3))
        self.same_bits(first, episode(quiet(touch_env.TouchEnv, WOOD), 3))
        self.assertFalse(np.array_equal(first, episode(self.env, 4)))

    def test_a_stop_of_the_guard_ends_the_episode(self):
        quiet(self.env.reset, seed=1)
        info = self.env.step(np.zeros(3))[4]
        self.assertEqual(info["stop"], "")
        self.env.engine.emergency_stop()
        terminated, truncated, info = self.env.step(np.zeros(3))[2:]
        self.assertEqual((terminated, truncated, info["stop"]), (True, False, "emergency"))

    def test_the_finger_presses_as_hard_as_it_is_pushed(self):
        observation, _ = quiet(self.env.reset, seed=1, options={"force": 0.5})
        self.assertEqual(observation[9], 0.5)
        for _ in range(50):
            info = self.env.step(np.array([0.0, 0.0, -0.25]))[4]
        self.assertAlmostEqual(info["pressed"], 0.5, delta=0.02)

    def test_the_episode_ends_when_the_finger_leaves(self):
        quiet(self.env.reset, seed=1)
        self.assertTrue(any(self.env.step(np.array([0.0, 0.0, 1.0]))[2] for _ in range(50)))

    def test_the_program(self):
        done = subprocess.run([sys.executable, "-B", touch_env.__file__, WOOD], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"^return [\d.]+; wanted [\d.]+ N, pressed [\d.]+ N\n$")


if __name__ == "__main__":
    unittest.main()
