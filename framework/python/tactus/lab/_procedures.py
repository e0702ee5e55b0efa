# SPDX-License-Identifier: MIT
"""Procedures that choose the next level: constant stimuli, staircases, and the psi method (QUEST+); and draws that are the same on every computer."""

from __future__ import annotations

import hashlib
import math
import random
import statistics
from dataclasses import dataclass, field
from typing import Any, List, Literal, Optional, Sequence, Tuple, TypeVar, Union

import numpy as np

from .._checks import Array
from .._messages import fail
from ._analysis import Function, probability

T = TypeVar("T")


class Draw:
    """Random numbers from a key, such as a seed, a participant and a block. Only random.random() is used, which Python promises to keep the same for a
    seed; the order of random.shuffle is not promised."""

    def __init__(self, *key: object):
        """key: parts whose texts, together, are the seed."""
        self._random = random.Random(int.from_bytes(hashlib.sha256(repr([str(part) for part in key]).encode()).digest(), "big"))

    def uniform(self) -> float:
        """A number from 0 (included) to 1 (not included)."""
        return self._random.random()

    def below(self, count: int) -> int:
        """A whole number from 0 to count - 1."""
        return int(self._random.random() * count)

    def normal(self) -> float:
        """A number of the standard normal distribution."""
        return statistics.NormalDist().inv_cdf(max(self._random.random(), 2.0 ** -54))

    def order(self, items: Sequence[T]) -> List[T]:
        """The items in a random order (Fisher and Yates)."""
        mixed = list(items)
        for i in range(len(mixed) - 1, 0, -1):
            k = self.below(i + 1)
            mixed[i], mixed[k] = mixed[k], mixed[i]
        return mixed


def latin_square(count: int, row: int) -> List[int]:
    """A row of a balanced square (Williams 1949): over `count` rows, each item comes once at each place, and with an even count each item follows each other
    one once; an odd count needs the mirrored rows too, so there are 2 * count of them."""
    row %= count if count % 2 == 0 else 2 * count
    found = [((i + 1 if i % 2 else -i) // 2 + row) % count for i in range(count)]
    return found[::-1] if row >= count else found


def note(text: str, **more: Any) -> Any:
    """The metadata of a field: what it means, and its bounds, for the schema."""
    return {"about": text, **more}


@dataclass(frozen=True)
class Constant:
    """Constant stimuli: every level `repeats` times, in rounds; each round has every level once, in a random order."""

    kind: Literal["constant"] = field(default="constant", metadata=note("constant stimuli"))
    levels: Tuple[float, ...] = field(default=(), metadata=note("levels of the stimulus, in the unit of what varies", fewest=1))
    repeats: int = field(default=10, metadata=note("trials of each level", low=1, high=10000))


@dataclass(frozen=True)
class Staircase:
    """An up-down staircase (Levitt 1971; weighted: Kaernbach 1991). After `down` answers in a row that are right or "yes", the level falls by a step; after
    `up` other answers in a row, it rises by up_factor steps. 1 up, 1 down converges to 50 %, or with weights to up_factor / (1 + up_factor); 1 up, 2 down
    converges to 70.7 %."""

    kind: Literal["staircase"] = field(default="staircase", metadata=note("an up-down staircase"))
    start: float = field(default=1.0, metadata=note("the first level, in the unit of what varies"))
    steps: Tuple[float, ...] = field(default=(0.1,), metadata=note("the size of a step before the first reversal, after it, …; the last one stays. "
                                                                    "With the scale linear, a difference; with ratio, a factor above 1", fewest=1))
    up: int = field(default=1, metadata=note("wrong answers in a row for a step up", low=1, high=10))
    down: int = field(default=2, metadata=note("right answers in a row for a step down", low=1, high=10))
    up_factor: float = field(default=1.0, metadata=note("a step up, in steps down", above=0.0, high=100.0))
    scale: Literal["linear", "ratio"] = field(default="linear", metadata=note("linear: steps are added; ratio: levels are multiplied"))
    low: float = field(default=0.0, metadata=note("the lowest level"))
    high: float = field(default=1e300, metadata=note("the highest level"))
    reversals: int = field(default=0, metadata=note("it ends after this many reversals; 0: not by reversals", low=0, high=1000))
    trials: int = field(default=80, metadata=note("it ends after this many trials", low=1, high=100000))
    tracks: int = field(default=1, metadata=note("interleaved staircases of each condition", low=1, high=20))


@dataclass(frozen=True)
class Psi:
    """The psi method (Kontsevich and Tyler 1999), also with lapses as in QUEST+ (Watson 2017): each trial has the level after which the expected entropy
    of threshold, width and lapse rate is least."""

    kind: Literal["psi"] = field(default="psi", metadata=note("the psi method, QUEST+"))
    levels: Tuple[float, ...] = field(default=(), metadata=note("the levels to choose from, in the unit of what varies", fewest=2))
    thresholds: Tuple[float, ...] = field(default=(), metadata=note("possible thresholds, in the same unit; without them, the levels"))
    widths: Tuple[float, ...] = field(default=(), metadata=note("possible widths of the function, in the same unit (for weibull: exponents)", fewest=1))
    lapses: Tuple[float, ...] = field(default=(0.02,), metadata=note("possible lapse rates", fewest=1))
    guess: float = field(default=0.5, metadata=note("the rate of \"yes\" or right answers without a stimulus", low=0.0, high=0.99))
    function: Function = field(default="logistic", metadata=note("the psychometric function"))
    trials: int = field(default=60, metadata=note("it ends after this many trials", low=1, high=100000))


Procedure = Union[Constant, Staircase, Psi]


def check(procedure: Procedure, where: str) -> None:
    """Refuses fields that do not fit together."""
    if isinstance(procedure, Staircase):
        if not procedure.low <= procedure.start <= procedure.high:
            fail("lab/value", f"{where}/start", f"the level {procedure.start:g} is not between low ({procedure.low:g}) and high ({procedure.high:g})",
                 "give a start between them")
        if procedure.scale == "ratio" and (min(procedure.steps) <= 1.0 or procedure.start <= 0.0):
            fail("lab/value", f"{where}/steps", "steps of the scale ratio are factors above 1, and levels are above 0",
                 "give factors such as 1.25, or scale linear")
        if procedure.scale == "linear" and min(procedure.steps) <= 0.0:
            fail("lab/value", f"{where}/steps", "the steps are not all above 0", "give steps above 0")
    if isinstance(procedure, Psi):
        positive = (*procedure.widths, *((*procedure.levels, *procedure.thresholds) if procedure.function == "weibull" else ()))
        if min(positive) <= 0.0:
            fail("lab/value", where, "widths, and levels and thresholds of the function weibull, are above 0", "leave out what is 0 or less")
        if not all(0.0 <= lapse < 1.0 - procedure.guess for lapse in procedure.lapses):
            fail("lab/value", f"{where}/lapses", "a lapse rate is less than 0, or guess and lapse are 1 or more together", "give lapse rates such as [0, 0.02]")


class Track:
    """A procedure that runs: here, through a list of levels. Derived classes choose the levels."""

    def __init__(self, most: int, levels: Sequence[float] = ()):
        self._most, self._done, self._levels = most, 0, levels

    def level(self) -> Optional[float]:
        """The level of the next trial, in the unit of what varies; None once the procedure is over. Asking changes nothing."""
        return self._levels[self._done] if self.left() else None

    def answer(self, level: float, outcome: float) -> None:
        """Takes the outcome of a trial at this level: 1 for "yes" or right, 0 for the others."""
        self._done += 1

    def left(self) -> int:
        """The largest number of trials that are left."""
        return self._most - self._done


class StaircaseTrack(Track):
    """A running staircase. turns: the levels at which the direction changed."""

    def __init__(self, given: Staircase):
        super().__init__(given.trials)
        self._given, self._level, self._right, self._wrong, self._direction = given, given.start, 0, 0, 0
        self.turns: List[float] = []

    def level(self) -> Optional[float]:
        return None if self.left() <= 0 or 0 < self._given.reversals <= len(self.turns) else self._level

    def answer(self, level: float, outcome: float) -> None:
        super().answer(level, outcome)
        self._right, self._wrong = (self._right + 1, 0) if outcome else (0, self._wrong + 1)
        if self._right == self._given.down:
            self._move(-1)
        elif self._wrong == self._given.up:
            self._move(1)

    def _move(self, direction: int) -> None:
        self._right = self._wrong = 0
        if self._direction == -direction:
            self.turns.append(self._level)
        self._direction = direction
        step = self._given.steps[min(len(self.turns), len(self._given.steps) - 1)]
        count = self._given.up_factor if direction > 0 else 1.0
        moved = self._level * step ** (direction * count) if self._given.scale == "ratio" else self._level + direction * count * step
        self._level = min(max(moved, self._given.low), self._given.high)


class PsiTrack(Track):
    """A running psi method. posterior: shape (thresholds, widths, lapses), its sum is 1."""

    def __init__(self, given: Psi):
        super().__init__(given.trials, given.levels)
        axes = np.array(given.thresholds or given.levels)[:, None, None], np.array(given.widths)[None, :, None], np.array(given.lapses)[None, None, :]
        self._yes = np.stack([probability(given.function, np.array(x), axes[0], axes[1], given.guess, axes[2]) for x in given.levels])
        self.posterior: Array = np.full(self._yes.shape[1:], 1.0 / self._yes[0].size)
        self._next: Optional[float] = None

    def level(self) -> Optional[float]:
        if self.left() <= 0:
            return None
        if self._next is None:
            expected = np.zeros(len(self._levels))   # entropy after a trial at each level, in nats
            for yes in (self._yes, 1.0 - self._yes):
                joint = yes * self.posterior
                expected += -_times_log(joint).sum(axis=(1, 2, 3)) + _times_log(joint.sum(axis=(1, 2, 3)))
            self._next = float(self._levels[int(np.argmin(np.round(expected, 12)))])   # so that a tie does not depend on the computer's rounding
        return self._next

    def answer(self, level: float, outcome: float) -> None:
        yes = self._yes[int(np.argmin(np.abs(np.subtract(self._levels, level))))]
        self.posterior = self.posterior * (yes if outcome else 1.0 - yes)
        self.posterior = self.posterior / self.posterior.sum()
        super().answer(level, outcome)
        self._next = None


def _times_log(p: Array) -> Array:
    """p log p, 0 for 0."""
    return np.asarray(p * np.log(np.where(p > 0.0, p, 1.0)))


def start(procedure: Procedure, draw: Draw) -> List[Track]:
    """The tracks of a procedure for one condition."""
    if isinstance(procedure, Constant):
        levels = [level for _ in range(procedure.repeats) for level in draw.order(procedure.levels)]
        return [Track(len(levels), levels)]
    if isinstance(procedure, Staircase):
        return [StaircaseTrack(procedure) for _ in range(procedure.tracks)]
    return [PsiTrack(procedure)]


def mean_of_turns(levels: Sequence[float], drop: int = 2, ratio: bool = False) -> float:
    """The classic estimate of a staircase: the mean of the levels at its reversals, geometric with `ratio`, without the first `drop`. If an odd number
    remains, one more is left out. NaN if none is left."""
    kept = list(levels)[drop + (len(levels) - drop) % 2:]
    if not kept:
        return math.nan
    return float(np.exp(np.mean(np.log(kept))) if ratio else np.mean(kept))
