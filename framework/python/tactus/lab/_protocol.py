# SPDX-License-Identifier: MIT
"""An experiment as data: the protocol, in a JSON file or in Python; and the order of its texts and trials."""

from __future__ import annotations

import hashlib
import json
import os
import pathlib
from dataclasses import dataclass, field
from typing import Any, Callable, Dict, Generator, List, Literal, NamedTuple, Optional, Sequence, Tuple, Union, cast

from .._checks import Path
from .._graph import Graph
from .._messages import fail, placed
from . import _schema
from ._procedures import Constant, Draw, Procedure, Psi, check, latin_square, note, start

Task = Literal["yes_no", "2ifc", "greater", "abx", "magnitude", "adjust", "match"]
ANSWERS: Dict[str, Tuple[str, ...]] = {"yes_no": ("yes", "no"), "2ifc": ("first", "second"), "greater": ("first", "second"), "abx": ("a", "b"),
                                       "magnitude": (), "adjust": ("less", "more", "done"), "match": ("less", "more", "done")}
KEYS = {"yes": "y", "no": "n", "first": "1", "second": "2", "a": "1", "b": "2", "less": "-", "more": "+", "done": "Enter"}
QUESTIONS = {"yes_no": "Did you feel it?", "2ifc": "Which one was stronger?", "greater": "Which one was greater?",
             "abx": "Was the last one like the first or the second?", "magnitude": "How strong was it? Give any number.", "adjust": "Set it.",
             "match": "Make it like the other one."}


@dataclass(frozen=True)
class Condition:
    """A graph with values, which a participant feels."""

    name: str = field(metadata=note("its name, in tables"))
    graph: str = field(default="", metadata=note("a graph file, or the name of a preset; without it, that of the protocol"))
    set: Dict[str, Any] = field(default_factory=dict, metadata=note("values of parameters, as in a graph file: {\"drag.mu\": 0.3}"))
    controls: Dict[str, float] = field(default_factory=dict, metadata=note("values of controls, from 0 to 1"))
    snapshot: str = field(default="", metadata=note("\"1\" to \"9\": a snapshot of the window, in the graph file; or a JSON file with such "
                                                    "`set` and `controls`, relative to the protocol. Those given here come on top"))


@dataclass(frozen=True)
class Varies:
    """The target of the levels: a parameter or a control."""

    target: str = field(metadata=note("a parameter, such as \"wall.stiffness\", or a control of the graph"))
    unit: str = field(default="1", metadata=note("the unit of the levels, for tables and plots; levels of parameters are in SI units"))
    standard: float = field(default=0.0, metadata=note("the level of the other interval in comparisons, and of catch trials"))
    rest: Optional[float] = field(default=None, metadata=note("the level between intervals; without it, the last level stays"))


@dataclass(frozen=True)
class HandAnswer:
    """An answer by the hand itself: a port passes a value, such as a position that enters a region, or a button."""

    port: str = field(metadata=note("one component of a port: \"hand.position.x\""))
    above: float = field(metadata=note("the answer is given while the value is above this, in the unit of the port"))


@dataclass(frozen=True)
class Block:
    """A part of an experiment: trials of one task and one procedure."""

    name: str = field(metadata=note("its name, in tables"))
    task: Task = field(metadata=note("yes_no; 2ifc and greater: two intervals, in which one is stronger, or greater; abx; magnitude: a number; "
                                      "adjust: the participant sets the level; match: the same, to equal a standard"))
    procedure: Procedure = field(metadata=note("which level comes next"))
    varies: Varies = field(metadata=note("what a level sets"))
    conditions: List[str] = field(default_factory=list, metadata=note("names of conditions, each with a procedure of its own; without them, all"))
    question: str = field(default="", metadata=note("what the participant is asked"))
    instructions: str = field(default="", metadata=note("what the participant reads before the block"))
    practice: int = field(default=0, metadata=note("trials before the block, with feedback, which do not count", low=0, high=1000))
    catch: float = field(default=0.0, metadata=note("the share of additional trials at the standard, which do not count", low=0.0, high=0.5))
    break_every: int = field(default=0, metadata=note("a break after this many trials; 0: none", low=0))
    feedback: bool = field(default=False, metadata=note("whether the participant is told what was right"))
    interval: float = field(default=1.0, metadata=note("how long an interval lasts, in s", low=0.0, high=3600.0))
    gap: float = field(default=0.3, metadata=note("the time between intervals, in s", low=0.0, high=3600.0))
    time_limit: float = field(default=0.0, metadata=note("for an answer, in s; 0: none. A trial that counts is repeated if it has none", low=0.0, high=86400.0))
    step: float = field(default=0.0, metadata=note("of adjust and match: what one key press adds, in the unit of what varies", low=0.0))
    guess: Optional[float] = field(default=None, metadata=note("for the analysis: the rate of \"yes\" or right answers without a stimulus; "
                                                                "by default 0.5 for 2ifc and abx, else 0", low=0.0, high=0.99))

    @property
    def guess_rate(self) -> float:
        """The guess rate of the analysis."""
        return self.guess if self.guess is not None else 0.5 if self.task in ("2ifc", "abx") else 0.0


@dataclass(frozen=True)
class Triggers:
    """8-bit codes over a serial line, for EEG amplifiers and the like."""

    port: str = field(metadata=note("the serial line, such as \"/dev/ttyUSB0\""))
    baud: int = field(default=115200, metadata=note("bits per second", low=300, high=4000000))
    codes: Dict[str, int] = field(default_factory=lambda: {"trial": 1, "stimulus": 2, "answer": 4}, metadata=note("codes of marks, from 1 to 255"))


@dataclass(frozen=True)
class Protocol:
    """An experiment."""

    name: str = field(metadata=note("letters and digits, for the names of files"))
    blocks: List[Block] = field(metadata=note("its parts", fewest=1))
    format: Literal["tactus-experiment"] = field(default="tactus-experiment", metadata=note("the format of the file"))
    version: Literal[1] = field(default=1, metadata=note("the version of the format"))
    about: str = field(default="", metadata=note("what it is about, and its sources"))
    seed: int = field(default=1, metadata=note("the random orders follow from it, the participant and the session", low=0))
    graph: str = field(default="", metadata=note("a graph file relative to this one, or the name of a preset"))
    devices: Dict[str, str] = field(default_factory=dict, metadata=note("simulated devices of roles: gesture:NAME or trace:FILE.csv. Real ones are chosen by "
                                                                              "the person: --device, or the session"))
    conditions: List[Condition] = field(default_factory=list, metadata=note("what is compared; without any, there is one: the graph as it is"))
    order: Literal["given", "random", "latin_square"] = field(
        default="given", metadata=note("the order of the blocks; latin_square: balanced over participants with the labels 1, 2, 3, …"))
    instructions: str = field(default="", metadata=note("what the participant reads first"))
    keys: Dict[str, str] = field(default_factory=dict, metadata=note("other keys for answers: {\"first\": \"ArrowLeft\"}"))
    hand: Dict[str, HandAnswer] = field(default_factory=dict, metadata=note("answers that the hand gives itself"))
    triggers: Optional[Triggers] = field(default=None, metadata=note("codes that go out with marks"))
    folder: str = field(default="", compare=False, repr=False, metadata=note("of files with relative paths, seen from the folder of this file"))

    def condition(self, name: str) -> Condition:
        """The condition with this name."""
        return next(c for c in self.all_conditions() if c.name == name)

    def all_conditions(self) -> List[Condition]:
        """The conditions; if there are none, the graph as it is."""
        return self.conditions or [Condition(name="graph")]

    def graph_of(self, condition: Condition) -> Optional[Graph]:
        """The graph of a condition, with its values set; None if no graph is given."""
        named = condition.graph or self.graph
        if not named:
            return None
        beside = os.path.join(self.folder, named)
        graph = Graph(beside if os.path.isfile(beside) else named)
        if condition.snapshot.isdigit():
            graph = _recalled(graph, condition.snapshot)
        for name, value in self.values_of(condition)[0].items():
            with placed(f"condition {condition.name}: {name}"):
                set_param(graph, name, value)
        return graph

    def values_of(self, condition: Condition) -> Tuple[Dict[str, Any], Dict[str, float]]:
        """The values of parameters and of controls of a condition."""
        if not condition.snapshot or condition.snapshot.isdigit():
            return condition.set, condition.controls
        held = _schema.json_in(os.path.join(self.folder, condition.snapshot))
        kept = _schema.read(Condition, {"name": condition.name, **held}, condition.snapshot)
        return {**kept.set, **condition.set}, {**kept.controls, **condition.controls}

    def text(self) -> str:
        """The protocol as the text of a file."""
        return _schema.text(self)

    def save(self, path: Path) -> None:
        """Writes the file. If it names files by relative paths, they are found from its folder, as `folder` says."""
        data, to = json.loads(self.text()), os.path.relpath(self.folder or os.curdir, os.path.dirname(os.path.abspath(path)))
        named = [self.graph, *(name for c in self.conditions for name in (c.graph, c.snapshot))]
        if to != os.curdir and any(not os.path.isabs(name) and os.path.isfile(os.path.join(self.folder, name)) for name in named):
            data["folder"] = to
        pathlib.Path(path).write_text(json.dumps(data, indent=2, ensure_ascii=False) + "\n", encoding="utf-8")

    def hash(self) -> str:
        """sha256 of the text of the protocol: a session is resumed only with the protocol with which it began."""
        return hashlib.sha256(self.text().encode()).hexdigest()

    @staticmethod
    def load(path: Path) -> "Protocol":
        """Reads and checks a file. Errors name the place in it as a JSON pointer."""
        protocol = _schema.load(Protocol, path)
        with placed(os.fspath(path)):
            return checked(protocol)


def edited(graph: Graph, change: Callable[[Dict[str, Any], Dict[str, Any]], None]) -> Graph:
    """A copy of a graph. `change` edits it and each of its subgraphs as JSON; it gets the whole graph, and the part."""
    make, (text, *rest) = graph.__reduce__()
    data = json.loads(text)
    for part in (data, *data.get("graphs", {}).values()):
        change(data, part)
    return cast(Graph, make(json.dumps(data), *rest))


def _recalled(graph: Graph, number: str) -> Graph:
    """A copy of a graph with the values of a snapshot, as the window recalls it: only those of nodes and controls that it knows."""
    def recall(whole: Dict[str, Any], part: Dict[str, Any]) -> None:
        stored = whole.get("ui", {}).get("snapshots", {})
        if number not in stored:
            fail("lab/value", "snapshot", f"the graph has no snapshot {number}", f"its snapshots: {', '.join(stored) or 'none'}")
        name = next((name for name, one in whole.get("graphs", {}).items() if one is part), "")
        then = stored[number].get("graphs", {}).get(name, {}) if name else stored[number].get("nodes", {})
        for id, node in part.get("nodes", {}).items():
            if then.get(id, {}).get("type") == node.get("type"):
                node.update({key: then[id][key] for key in ("params", "overrides") if then[id].get(key) or key in node})
        for id, control in part.get("controls", {}).items():
            control["value"] = stored[number].get("controls", {}).get(id, control.get("value", 0.0))

    with placed(f"snapshot {number}"):
        return edited(graph, recall)


def set_param(graph: Graph, name: str, value: Any) -> None:
    node, _, param = name.rpartition(".")
    patch, _, inner = node.rpartition("/")
    graph.set_param(inner, param, value, patch=patch)


def checked(protocol: Protocol) -> Protocol:
    """The protocol, after checks that the types of single values cannot make: that names exist, and that a graph takes the levels."""
    if not protocol.name.isalnum() or not protocol.name.isascii():
        fail("lab/value", "/name", f"'{protocol.name}' has other characters than letters and digits", "choose a name for files, such as 'roughness'")
    known = [c.name for c in protocol.all_conditions()]
    for kind, names in (("conditions", known), ("blocks", [b.name for b in protocol.blocks])):
        if twice := [name for name in names if names.count(name) > 1]:
            fail("lab/value", f"/{kind}", f"there are two {kind} called '{twice[0]}'", "give each a different name")
    for i, block in enumerate(protocol.blocks):
        where = f"/blocks/{i}"
        check(block.procedure, f"{where}/procedure")
        for name in block.conditions:
            if name not in known:
                fail("lab/value", f"{where}/conditions", f"there is no condition '{name}'", f"the conditions: {', '.join(known)}")
        if block.task in ("magnitude", "adjust", "match") and not isinstance(block.procedure, Constant):
            fail("lab/value", f"{where}/procedure", f"the task {block.task} has no right answers that a {block.procedure.kind} could follow",
                 "use the procedure constant; for adjust and match, its levels are those to begin with")
        if block.task in ("adjust", "match") and block.step <= 0.0:
            fail("lab/missing", f"{where}/step", "the step of one key press is missing", "give a step above 0, in the unit of what varies")
    for role, words in protocol.devices.items():
        if not words.startswith(("gesture:", "trace:")):   # the file of a stranger never chooses a device that can push
            fail("lab/device", f"/devices/{role}", f"a protocol does not choose the device '{words}'",
                 f"start it with --device {role}={words}, or bind it in your session")
    for answer in protocol.hand:
        if answer not in KEYS:
            fail("lab/value", f"/hand/{answer}", f"there is no answer '{answer}'", f"the answers: {', '.join(KEYS)}")
    for name, code in (protocol.triggers.codes if protocol.triggers else {}).items():
        if not 1 <= code <= 255:
            fail("lab/value", f"/triggers/codes/{name}", f"{code} is not a code of 8 bits", "give a code from 1 to 255")
    for i, block in enumerate(protocol.blocks):
        _check_targets(protocol, block, f"/blocks/{i}")
    return protocol


def _check_targets(protocol: Protocol, block: Block, where: str) -> None:
    """Refuses controls and parameters that a graph has not, and levels that it refuses, as far as they are known before a block runs."""
    given, varies = block.procedure, block.varies
    known = [*(given.levels if isinstance(given, (Constant, Psi)) else (given.start, given.low, given.high)), varies.standard]
    known += [varies.rest] if varies.rest is not None else []
    for condition in (protocol.condition(name) for name in block.conditions or [c.name for c in protocol.all_conditions()]):
        if (graph := protocol.graph_of(condition)) is None:
            continue
        for name, value in [*protocol.values_of(condition)[1].items(), *((varies.target, level) for level in known)]:
            if name in graph.controls:
                if not 0.0 <= value <= 1.0:
                    fail("lab/value", where, f"the control {name} would be {value:g}", "give levels from 0 to 1")
            elif "." in name:
                with placed(f"{where}: {name}"):
                    set_param(graph, name, value)
            else:
                fail("lab/value", where, f"the graph of '{condition.name}' has no control '{name}'",
                     f"its controls: {', '.join(graph.controls) or 'none'}; a parameter is written NODE.PARAMETER")


def schema() -> Dict[str, Any]:
    """The JSON schema of protocol files, made from the dataclasses."""
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", "title": "Experiment of tactus.lab", **_schema.schema(Protocol)}


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
    """A way through an experiment: `step` is the next trial, or a text to read; None at the end. It follows from the protocol, the participant, the session
    and the answers alone, so the answers in a journal give it again."""

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
            "2ifc": of_two, "greater": of_two, "abx": ((*pair, pair[last]), "ab"[last], "123"), "yes_no": ((level,), "yes", ("",)),
            "match": ((standard, level), "", ("standard", "yours"))}
        levels, expected, labels = tasks.get(block.task, ((level,), "", ("",)))
        return Trial(self._number, block, kind, condition, track, level, tuple(Interval(a, b) for a, b in zip(labels, levels)), expected)
