# SPDX-License-Identifier: MIT
"""Simulated observers: they answer by a psychometric function, or by a power law. Their answers depend only on their seed and the number of the trial."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ._draw import Draw
from ._functions import Function, probability
from ._protocol import ANSWERS
from ._trials import Answer, Trial


@dataclass(frozen=True)
class Observer:
    """A simulated observer. threshold, width, lapse: of its psychometric function, whose guess rate is that of the block; threshold and
    width are in the unit of what varies. For adjust and match, threshold is the level at which the observer is content, give or take `width` (standard
    deviation). For magnitude, the answer is gain * level^exponent, with a factor exp (noise * normal)."""

    threshold: float
    width: float
    lapse: float = 0.0
    function: Function = "logistic"
    gain: float = 10.0
    exponent: float = 1.0
    noise: float = 0.1
    seed: int = 1

    def answer(self, trial: Trial, level: float) -> Answer:
        """The answer to a trial; `level` is the one that is felt, which adjust and match change."""
        draw = Draw(self.seed, "observer", trial.number)
        task = trial.block.task
        if task == "magnitude":
            return float(self.gain * max(level, 0.0) ** self.exponent * math.exp(self.noise * draw.normal()))
        if task in ("adjust", "match"):
            off = level - (self.threshold + self.width * draw.normal())
            return "done" if abs(off) <= 0.5 * trial.block.step else "less" if off > 0.0 else "more"
        chance = float(probability(self.function, level, self.threshold, self.width, trial.block.guess_rate, self.lapse))
        wrong = next(answer for answer in ANSWERS[task] if answer != trial.expected)
        return trial.expected if draw.uniform() < chance else wrong
