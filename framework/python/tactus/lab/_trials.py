# SPDX-License-Identifier: MIT
"""The order of texts and trials in an experiment. It follows from the protocol, the participant, the session and the answers alone, so the answers in a
journal give it again."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Dict, Generator, NamedTuple, Optional, Sequence, Tuple, Union

from ._procedures import Constant, Draw, Psi, latin_square, start
from ._protocol import QUESTIONS, Block, Protocol

Answer = Union[str, float, None]


class Interval(NamedTuple):
    """A stretch of time in which the participant feels one level, in the unit of what varies."""

    label: str
    level: float


@dataclass(frozen=True)
class Trial:
    """One question. kind: "main", "practice" or "catch". number: counted from 1 over the session. level: in the unit of what varies. expected: the answer
    whose outcome is 1; "" for magnitude, adjust and match, whose outcome is the number itself."""

    number: int
    block: Block
    kind: str
    condition: str
    track: int
    level: float
    intervals: Tuple[Interval, ...]
    expected: str

    @property
    def question(self) -> str:
        """The question to the participant."""
        return self.block.question or QUESTIONS[self.block.task]

    def outcome(self, answer: Answer) -> Optional[float]:
        """The value of an answer: 1 or 0, or the number; None without an answer."""
        return answer if answer is None or isinstance(answer, float) else float(answer == self.expected)


Step = Union[str, Trial, None]


class Plan:
    """A way through an experiment: `step` is the next trial, or a text to read; None at the end."""

    def __init__(self, protocol: Protocol, participant: str = "01", session: str = "01"):
        """participant, session: labels; a participant whose label is a number has that row of the latin square."""
        self._protocol, self._key = protocol, (protocol.seed, participant, session)
        self._row = int(participant) - 1 if participant.isdigit() else Draw(participant).below(1000)
        self._number = 0
        self._tracks = [[(name, i, track) for name in block.conditions or [condition.name for condition in protocol.all_conditions()]
                         for i, track in enumerate(start(block.procedure, Draw(*self._key, block.name, name)))] for block in protocol.blocks]
        self._steps = self._run()
        self.step: Step = next(self._steps)

    def answer(self, answer: Answer = None) -> None:
        """Takes the answer to the step. Texts need none; a trial that counts is repeated if it has none."""
        self.step = self._steps.send(answer)

    def left(self) -> int:
        """The largest number of trials that are left, without practice and catch trials."""
        return sum(track.left() for tracks in self._tracks for _, _, track in tracks if track.level() is not None)

    def _run(self) -> Generator[Step, Answer, None]:
        if self._protocol.instructions:
            yield self._protocol.instructions
        count = len(self._protocol.blocks)
        order = {"given": list(range(count)), "random": Draw(*self._key, "blocks").order(range(count)), "latin_square": latin_square(count, self._row)}
        for index in order[self._protocol.order]:
            yield from self._block(index)
        yield None

    def _block(self, index: int) -> Generator[Step, Answer, None]:
        block, tracks, draw = self._protocol.blocks[index], self._tracks[index], Draw(*self._key, self._protocol.blocks[index].name)
        if block.instructions:
            yield block.instructions
        levels = block.procedure.levels if isinstance(block.procedure, (Constant, Psi)) else (block.procedure.start,)
        for _ in range(block.practice):
            name, number, track = tracks[draw.below(len(tracks))]
            yield self._trial(block, "practice", name, number, levels[draw.below(len(levels))])
        if block.practice:
            yield "The practice is over."
        count = rested = 0
        while still := [each for each in tracks if each[2].level() is not None]:
            if block.break_every and count > rested and count % block.break_every == 0:
                rested = count   # a trial without an answer brings no second break
                yield "Take a break."
            if draw.uniform() < block.catch / (1.0 - block.catch):
                yield self._trial(block, "catch", still[draw.below(len(still))][0], 0, block.varies.standard)
            if isinstance(block.procedure, Constant):   # all remaining trials are equally likely, so the conditions stay mixed up to the end
                still = [each for each in still for _ in range(each[2].left())]
            name, number, track = still[draw.below(len(still))]
            level = track.level()
            assert level is not None
            trial = self._trial(block, "main", name, number, level)
            outcome = trial.outcome((yield trial))
            if outcome is not None:
                track.answer(level, outcome)
                count += 1

    def _trial(self, block: Block, kind: str, condition: str, track: int, level: float) -> Trial:
        self._number += 1
        draw, standard = Draw(*self._key, "trial", self._number), block.varies.standard
        is_first, last = draw.below(2), draw.below(2)
        pair = (level, standard) if is_first else (standard, level)
        of_two = pair, "first" if is_first else "second", "12"
        tasks: Dict[str, Tuple[Tuple[float, ...], str, Sequence[str]]] = {   # levels, what is expected, labels
            "2ifc": of_two, "greater": of_two, "abx": ((*pair, pair[last]), "ab"[last], "123"), "match": ((standard, level), "", ("standard", "yours")),
            "yes_no": ((level,), "yes", ("",))}
        levels, expected, labels = tasks.get(block.task, ((level,), "", ("",)))
        return Trial(self._number, block, kind, condition, track, level, tuple(Interval(a, b) for a, b in zip(labels, levels)), expected)
