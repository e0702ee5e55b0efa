# SPDX-License-Identifier: MIT
"""A session of an experiment: it shows stimuli, asks, and writes the folder of the session."""

from __future__ import annotations

import contextlib
import hashlib
import math
import pathlib
import platform
import time
from typing import Dict, List, Mapping, Optional

import numpy as np

from .. import _tactus
from .._checks import Path
from .._messages import Error, fail
from .._views import with_unit
from . import _journal, _tables
from ._analysis import psychometric
from ._protocol import ANSWERS, KEYS, Answer, Plan, Protocol, Trial, checked
from ._stages import Live, Moment, Receiver, Silent, TriggerLine
from ._windows import Aborted, Simulated, Window, meant


class Experiment:
    """A session of a participant. Each mark and each trial is in its journal before the next one begins, so at most the current trial is lost if the process
    is killed; `resume` goes on with that trial, in the same order."""

    def __init__(self, protocol: Protocol, out: Path, participant: str = "01", session: str = "01", *, window: Window, stage: Optional[Silent] = None,
                 resume: bool = False, receiver: Optional[Receiver] = None, device: Mapping[str, str] = {}, devices: Optional[str] = None,
                 packed: bool = False):
        """out: the folder of the study; the session has the folder sub-PARTICIPANT/ses-SESSION/beh in it. participant, session: letters and digits.
        stage: where stimuli are felt; without it, on devices if the protocol has a graph, else nowhere. receiver: of marks and answers by OSC. device:
        devices of roles, as in tactus.play; devices: the session file that binds other roles, or "off". packed: the log of the inputs is packed, which
        takes less space (docs/replay.md)."""
        self.protocol, self.window, self.receiver = checked(protocol), window, receiver
        for name, label in (("participant", participant), ("session", session)):
            if not label.isalnum() or not label.isascii():
                fail("lab/value", name, f"'{label}' has characters that are not letters or digits", "give a label such as '01'")
        self.participant, self.session = participant, session
        self.folder = pathlib.Path(out) / f"sub-{participant}" / f"ses-{session}" / "beh"
        self.stem = f"sub-{participant}_ses-{session}_task-{protocol.name}"
        self.plan = Plan(protocol, participant, session)
        path = self.folder / f"{self.stem}_journal.jsonl"
        past = _journal.read(path) if resume else []
        self._replay(past)
        bound = {**protocol.devices, **device}
        if not resume:
            self.folder.mkdir(parents=True, exist_ok=True)
        with contextlib.ExitStack() as used:   # a session without triggers does not begin
            self._triggers = used.enter_context(contextlib.closing(TriggerLine(protocol.triggers))) if protocol.triggers else None
            self._journal = used.enter_context(contextlib.closing(_journal.Journal(path, None if resume else {**self._header(), "devices": bound})))
            self._used = used.pop_all()
        if resume:
            self._journal.add({"event": "resumed", "devices": bound, **Silent().now()._asdict()})
        own = self.folder / f"{self.stem}_protocol.json"
        if not resume or not own.exists():   # a session may end between its first line and this file
            protocol.save(own)
        self.run_number = 1 + sum(event.get("event") == "resumed" for event in past) + bool(resume)
        self.log = self.folder / f"{self.stem}_run-{self.run_number:02d}_log.{'tlog' if packed else 'jsonl'}"
        self.stage = stage if stage is not None else Live(protocol, str(self.log), devices, device) if protocol.graph or protocol.conditions else Silent()
        window.stop, window.now = self.stage.stop, self.stage.now
        if receiver is not None:
            receiver.now = self.stage.now
        self._trials = [event for event in past if event.get("event") == "trial"]

    def _header(self) -> _journal.Event:
        felt = {condition.name: graph for condition in self.protocol.all_conditions() if (graph := self.protocol.graph_of(condition)) is not None}
        return {"protocol": self.protocol.hash(), "name": self.protocol.name, "participant": self.participant, "session": self.session,
                "seed": self.protocol.seed, "graphs": {name: hashlib.sha256(graph.text.encode()).hexdigest() for name, graph in felt.items()},
                "rates_hz": {name: graph.rate for name, graph in felt.items()},
                "versions": {"tactus": _tactus.version(), "python": platform.python_version(), "numpy": np.__version__},
                "started": {"wall": time.time(), "monotonic": time.monotonic()}}

    def _replay(self, past: List[_journal.Event]) -> None:
        """Goes to the end of the journal."""
        if past and past[0]["protocol"] != self.protocol.hash():
            fail("lab/protocol", str(self.folder), "the session began with another protocol",
                 f"give the file with which it began, or {self.stem}_protocol.json in this folder")
        for event in past:
            if event.get("event") == "end":
                fail("lab/exists", str(self.folder), "the session is complete", "choose another session")
            if event.get("event") != "trial":
                continue
            while isinstance(self.plan.step, str):
                self.plan.answer()
            trial, said = self.plan.step, tuple(event[key] for key in ("number", "block", "kind", "condition"))
            if trial is None or said != (trial.number, trial.block.name, trial.kind, trial.condition) or not math.isclose(
                    trial.level, event["level"], abs_tol=1e-9):
                fail("lab/order", str(self.folder), f"trial {event['number']} of the journal is not the one that follows from its answers",
                     "resume with the version of tactus with which the session began")
            self.plan.answer(event["answer"])

    def run(self) -> "_tables.SessionData":
        """Runs the session to its end, and returns its data. If a window raises Aborted, the data so far are returned. After each
        exception, the journal stays, and the forces go to zero."""
        why = "error"
        try:
            self.mark("run", str(self.run_number))
            while (step := self.plan.step) is not None:
                if isinstance(step, str):
                    self.window.show(step)
                    self.plan.answer()
                else:
                    self._trial(step)
            why = "end"
        except (Aborted, KeyboardInterrupt) as left:
            why = "aborted"
            if isinstance(left, KeyboardInterrupt):
                raise
        finally:
            self.stage.close()
            self._journal.add({"event": why, **Silent().now()._asdict()})
            self._used.close()
            self.window.close()
        data = _tables.load(self.folder, self.protocol.name)
        data.write()
        return data

    def _trial(self, trial: Trial) -> None:
        self._report(trial)
        self._take_marks()
        self.stage.events()   # earlier ones do not belong to this trial
        condition, varies = self.protocol.condition(trial.condition), trial.block.varies
        begin = self.mark("trial", str(trial.number))
        for i, interval in enumerate(trial.intervals):
            if i > 0 and trial.block.gap > 0.0:
                if varies.rest is not None:
                    self.stage.show(condition, varies.target, varies.rest)
                self.window.say("")
                self.stage.wait(trial.block.gap)
            self.stage.show(condition, varies.target, interval.level)
            self.window.say(interval.label)
            self.mark("stimulus", f"{interval.level!r}")
            self.stage.wait(trial.block.interval)
        if varies.rest is not None and trial.block.task not in ("adjust", "match"):
            self.stage.show(condition, varies.target, varies.rest)
        while self.receiver is not None and self.receiver.answer() is not None:
            pass   # sent before the question
        asked = self.stage.now().monotonic
        answer = self._answer(trial, trial.level)
        end = self.mark("answer", "" if answer is None else str(answer))
        outcome = trial.outcome(answer)
        event = {"event": "trial", "number": trial.number, "block": trial.block.name, "kind": trial.kind, "condition": trial.condition, "track": trial.track,
                 "level": trial.level, "intervals": [interval.level for interval in trial.intervals], "expected": trial.expected, "answer": answer,
                 "outcome": outcome, "response_time": end.monotonic - asked, "guard": self.stage.events(), "begin": begin._asdict(), "end": end._asdict()}
        self._journal.add(event)
        self._trials.append(event)
        self.plan.answer(answer)
        if trial.expected and (trial.kind == "practice" or trial.block.feedback):
            self.window.say("No answer" if answer is None else "Right" if outcome else "Wrong")
            self.stage.wait(trial.block.gap)

    def _answer(self, trial: Trial, level: float) -> Answer:
        keys = {name: self.protocol.keys.get(name, KEYS[name]) for name in ANSWERS[trial.block.task]}
        condition, block = self.protocol.condition(trial.condition), trial.block
        while True:
            answer = self.window.ask(trial, level, keys, block.time_limit, lambda: self._by_hand(keys))
            if block.task not in ("adjust", "match") or answer is None:
                return answer
            if answer == "done":
                return float(level)
            moved = level + (block.step if answer == "more" else -block.step)
            try:
                self.stage.show(condition, block.varies.target, moved)
            except Error:   # out of the range of the parameter
                if isinstance(self.window, Simulated):
                    return float(level)   # would ask for the same again, for ever
                self.window.say("no further")
                continue
            level = moved
            self.mark("stimulus", f"{level!r}")

    def _by_hand(self, keys: Dict[str, str]) -> Answer:
        """The answer of the hand or by OSC. What is none is left out."""
        self._take_marks()
        return meant(self.stage.hand() or (self.receiver.answer() if self.receiver else None) or "", keys)

    def mark(self, name: str, value: str = "", at: Optional[Moment] = None) -> Moment:
        """Writes a mark with the tick and the wall and monotonic time (in s), and sends its trigger if it has one. at: its moment; without it, now.
        Returns the moment."""
        code = self._triggers.send(name) if self._triggers else None
        now = at if at is not None else self.stage.now()
        self._journal.add({"event": "mark", "name": name, "value": value, **({"code": code} if code is not None else {}), **now._asdict()})
        return now

    def _take_marks(self) -> None:
        for marks in (self.receiver.marks if self.receiver else None, self.window.marks):
            while marks is not None and not marks.empty():
                self.mark(*marks.get())

    def _report(self, trial: Trial) -> None:
        block, fit = trial.block, ""
        history = [(event["level"], event["outcome"]) for event in self._trials
                   if event["block"] == block.name and event["kind"] == "main" and event["outcome"] is not None]
        if len(history) >= 10 and trial.expected and not isinstance(self.window, Simulated):
            with contextlib.suppress(Error):   # one level so far
                found = psychometric(*np.array(history).T, guess=block.guess_rate, method="posterior")
                low, high = found.threshold_interval
                fit = f"threshold {with_unit(found.threshold, block.varies.unit)} ({low:.4g} to {high:.4g}), all conditions together"
        self.window.report({"name": self.protocol.name, "participant": self.participant, "session": self.session, "block": block.name, "kind": trial.kind,
                            "trial": trial.number, "done": len(self._trials), "left": self.plan.left(), "level": with_unit(trial.level, block.varies.unit),
                            "last": {key: self._trials[-1][key] for key in ("number", "answer", "outcome")} if self._trials else {},
                            "health": self.stage.health(), "history": history, "fit": fit})
