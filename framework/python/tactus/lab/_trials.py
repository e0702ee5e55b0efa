# SPDX-License-Identifier: MIT
"""The order of texts and trials in an experiment. It follows from the protocol, the participant, the session and the answers alone, so the answers in a
journal give it again."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Generator, List, Optional, Tuple, Union

from ._draw import Draw, latin_square
from ._procedures import Constant, Psi, Track, start
from ._protocol import QUESTIONS, Block, Protocol

Answer = Union[str, float, None]


@dataclass(frozen=True)
class Interval:
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
        if answer is None or isinstance(answer, float):
            return answer
        return float(answer == self.expected)


@dataclass(frozen=True)
class Text:
    """A page to read."""

    text: str


Step = Union[Text, Trial]


class Plan:
    """A way through an experiment: `step` is the next text or trial, None at the end."""

    def __init__(self, protocol: Protocol, participant: str = "01", session: str = "01"):
        """participant, session: labels; a participant whose label is a number has that row of the latin square."""
        self._protocol, self._key = protocol, (protocol.seed, participant, session)
        self._row = int(participant) - 1 if participant.isdigit() else Draw(participant).below(1000)
        self._number, self._now = 0, 0
        self._tracks: List[List[Tuple[str, int, Track]]] = [[] for _ in protocol.blocks]
        self._steps = self._run()
        self.step: Optional[Step] = next(self._steps, None)

    def answer(self, answer: Answer = None) -> Optional[Step]:
        """Takes the answer to the step, and returns the next one. Texts need none; a trial that counts is repeated if it has none."""
        try:
            self.step = self._steps.send(answer)
        except StopIteration:
            self.step = None
        return self.step

    def left(self) -> int:
        """The largest number of trials that are left, without practice and catch trials."""
        begun = {i for i, tracks in enumerate(self._tracks) if tracks}
        return sum(track.left() for tracks in self._tracks for _, _, track in tracks if track.level() is not None) + sum(
            track.left() for i in range(len(self._tracks)) if i not in begun for _, _, track in self._start(i))

    def _run(self) -> Generator[Step, Answer, None]:
        if self._protocol.instructions:
            yield Text(self._protocol.instructions)
        count = len(self._protocol.blocks)
        order = {"given": list(range(count)), "random": Draw(*self._key, "blocks").order(range(count)), "latin_square": latin_square(count, self._row)}
        for index in order[self._protocol.order]:
            yield from self._block(index)

    def _start(self, index: int) -> List[Tuple[str, int, Track]]:
        block = self._protocol.blocks[index]
        names = block.conditions or [c.name for c in self._protocol.all_conditions()]
        return [(name, i, track) for name in names for i, track in enumerate(start(block.procedure, Draw(*self._key, block.name, name)))]

    def _block(self, index: int) -> Generator[Step, Answer, None]:
        block, draw = self._protocol.blocks[index], Draw(*self._key, self._protocol.blocks[index].name)
        tracks = self._start(index)
        self._tracks[index] = tracks
        if block.instructions:
            yield Text(block.instructions)
        for _ in range(block.practice):
            name, number, track = tracks[draw.below(len(tracks))]
            yield self._trial(block, "practice", name, number, self._practice_level(block, draw))
        if block.practice:
            yield Text("The practice is over.")
        count = rested = 0
        while still := [each for each in tracks if each[2].level() is not None]:
            if block.break_every and count > rested and count % block.break_every == 0:
                rested = count   # a trial without an answer brings no second break
                yield Text("Take a break.")
            if draw.uniform() < block.catch / (1.0 - block.catch):
                yield self._trial(block, "catch", still[draw.below(len(still))][0], 0, block.varies.standard)
            name, number, track = still[draw.below(len(still))] if not isinstance(block.procedure, Constant) else self._by_what_is_left(still, draw)
            level = track.level()
            assert level is not None
            trial = self._trial(block, "main", name, number, level)
            outcome = trial.outcome((yield trial))
            if outcome is not None:
                track.answer(level, outcome)
                count += 1

    def _by_what_is_left(self, tracks: List[Tuple[str, int, Track]], draw: Draw) -> Tuple[str, int, Track]:
        """A track, drawn so that all remaining trials are equally likely: the conditions stay mixed up to the end."""
        at = draw.below(sum(track.left() for _, _, track in tracks))
        for each in tracks:
            at -= each[2].left()
            if at < 0:
                return each
        raise AssertionError

    def _practice_level(self, block: Block, draw: Draw) -> float:
        levels = block.procedure.levels if isinstance(block.procedure, (Constant, Psi)) else (block.procedure.start,)
        return levels[draw.below(len(levels))]

    def _trial(self, block: Block, kind: str, condition: str, track: int, level: float) -> Trial:
        self._number += 1
        draw, standard = Draw(*self._key, "trial", self._number), block.varies.standard
        swapped = draw.below(2) == 1
        if block.task in ("2ifc", "greater"):
            levels, expected = ((level, standard), "first") if swapped else ((standard, level), "second")
        elif block.task == "abx":
            pair = (level, standard) if swapped else (standard, level)
            last = draw.below(2)
            levels, expected = (*pair, pair[last]), "ab"[last]   # type: ignore[assignment]
        elif block.task == "match":
            levels, expected = (standard, level), ""
        else:
            levels, expected = (level,), "yes" if block.task == "yes_no" else ""   # type: ignore[assignment]
        labels = ("", "") if len(levels) == 1 else ("standard", "yours") if block.task == "match" else ("1", "2", "3")
        return Trial(self._number, block, kind, condition, track, level, tuple(Interval(a, b) for a, b in zip(labels, levels)), expected)
