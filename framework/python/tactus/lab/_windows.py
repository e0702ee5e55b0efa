# SPDX-License-Identifier: MIT
"""Simulated observers, and the windows through which they or a person at a terminal answer. The window in the browser is in _web.py."""

from __future__ import annotations

import math
import os
import select
import sys
import time
from dataclasses import dataclass
from typing import Any, Callable, Dict, Optional, TextIO

from ._analysis import Function, probability
from ._draw import Draw
from ._protocol import ANSWERS
from ._stages import Marks, Moment, Silent
from ._trials import Answer, Trial

Hand = Callable[[], Answer]   # the answer of the hand or by OSC at this moment


class Aborted(Exception):
    """The end of a session before its last trial, by a person. It can be resumed."""


class Window:
    """The side of an experiment that participant and experimenter see; derived classes implement it. stop: takes all forces to zero [any thread]; set by the
    experiment."""

    stop: Callable[[], None] = staticmethod(lambda: None)
    now: Callable[[], Moment] = staticmethod(Silent().now)   # the clock of the experiment
    marks: Optional[Marks] = None                            # those that come through the window, if it takes any

    def show(self, text: str) -> None:
        """Shows a page, and returns when the participant has read it."""

    def say(self, text: str) -> None:
        """Shows a few words, such as the number of an interval, and goes on."""

    def ask(self, trial: Trial, level: float, keys: Dict[str, str], limit: float, hand: Hand) -> Answer:
        """Asks, and waits for the answer: one of `keys`, whose values are the keys of a keyboard, or a number for magnitude; None after `limit` (in s, 0
        without one). level: what is felt, in the unit of what varies. hand: the answer of the hand or by OSC, to be called regularly."""
        raise NotImplementedError

    def awaited(self, take: Callable[[], Answer], limit: float = 0.0, hand: Hand = lambda: None) -> Answer:
        """The first answer of the hand or from `take`, which gives None after a moment without any. None after the limit in s, 0 without one."""
        until = time.monotonic() + (limit or math.inf)
        while (answer := hand()) is None and (answer := take()) is None and time.monotonic() < until:
            pass
        return answer

    def report(self, state: Dict[str, Any]) -> None:
        """Shows the state of the experiment to the experimenter."""

    def close(self) -> None:
        """Shows that the experiment is over."""


@dataclass(frozen=True)
class Observer:
    """A simulated observer, whose answers depend only on its seed and the number of the trial. threshold, width, lapse: of its psychometric function, whose
    guess rate is that of the block; threshold and width are in the unit of what varies. For adjust and match, threshold is the level at which the observer is
    content, give or take `width` (standard deviation). For magnitude, the answer is gain * level^exponent, with a factor exp (noise * normal)."""

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
        return trial.expected if draw.uniform() < chance else next(answer for answer in ANSWERS[task] if answer != trial.expected)


class Simulated(Window):
    """An observer that needs no time."""

    def __init__(self, observer: Observer):
        self.observer = observer

    def ask(self, trial: Trial, level: float, keys: Dict[str, str], limit: float, hand: Hand) -> Answer:
        return self.observer.answer(trial, level)


class Terminal(Window):
    """Lines of text: an answer is its key or its name, then Enter; "stop" ends the session."""

    def __init__(self, source: TextIO = sys.stdin, out: TextIO = sys.stdout):
        self._source, self._out, self._held = source, out, b""

    def show(self, text: str) -> None:
        self.say(f"{text}\n(Enter goes on)")
        self.awaited(self._line)

    def say(self, text: str) -> None:
        print(text, file=self._out, flush=True)

    def ask(self, trial: Trial, level: float, keys: Dict[str, str], limit: float, hand: Hand) -> Answer:
        self.say(trial.question + (f" ({', '.join(f'{key}: {answer}' for answer, key in keys.items())})" if keys else ""))

        def take() -> Answer:
            line = self._line()
            answer = None if line is None else meant(line or "Enter", keys)
            if line is not None and answer is None:
                self.say("Give " + (f"one of {', '.join(keys.values())}" if keys else "a number"))
            return answer

        return self.awaited(take, limit, hand)

    def _line(self) -> Optional[str]:
        if b"\n" not in self._held:
            if select.select([self._source], [], [], 0.02)[0]:
                read = os.read(self._source.fileno(), 4096)
                if not read:
                    raise Aborted("the input has ended")
                self._held += read
            return None
        line, self._held = self._held.split(b"\n", 1)
        text = line.decode(errors="replace").strip()
        if text == "stop":
            raise Aborted("stopped at the terminal")
        return text


def meant(text: str, keys: Dict[str, str]) -> Answer:
    """The answer that a text gives: one of `keys` by its name, its key or its place (Pad0, Pad1, …); without any, a finite number, 0 or more. Else None."""
    if keys:
        return {**{f"Pad{i}": name for i, name in enumerate(keys)}, **{key: name for name, key in keys.items()}, **{name: name for name in keys}}.get(text)
    try:
        value = float(text.replace(",", "."))
    except ValueError:
        return None
    return value if math.isfinite(value) and value >= 0.0 else None
