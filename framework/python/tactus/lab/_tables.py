# SPDX-License-Identifier: MIT
"""The data of a session: its trials and marks as tables, made from its journal."""

from __future__ import annotations

import json
import math
import pathlib
from typing import Any, Dict, Iterator, List, Optional, Tuple, Union

import numpy as np

from .._checks import Path
from .._messages import fail
from . import _journal
from ._analysis import Detection, Function, PowerLaw, Psychometric, detection, power_law, psychometric
from ._procedures import Constant, Psi, Staircase, StaircaseTrack
from ._protocol import Block, Protocol
from ._schema import read
from ._writers import Table

_TRIAL_UNITS = {"onset": "s", "duration": "s", "response_time": "s", "begin_wall": "s", "begin_monotonic": "s"}
_EVENT_UNITS = {"onset": "s", "duration": "s", "wall": "s", "monotonic": "s"}


class SessionData:
    """The results of a session. trials, events: tables; `write` writes them beside the journal, with names after BIDS."""

    def __init__(self, folder: pathlib.Path, stem: str, events: List[_journal.Event], protocol: Protocol):
        self.folder, self.stem, self.protocol, self.header, self._events = folder, stem, protocol, events[0], events
        self.is_complete = any(event.get("event") == "end" for event in events)
        about = {{"protocol": "protocol_sha256"}.get(key, key): value for key, value in self.header.items() if key not in ("format", "version")}
        units = {block.varies.unit for block in protocol.blocks}
        of_levels = {"level": units.pop()} if len(units) == 1 else {}   # blocks may vary different things
        self.trials = _table([self._trial_row(event, onset) for event, onset in self._timed("trial")], {**_TRIAL_UNITS, **of_levels}, about)
        self.events = _table([{"onset": onset, "duration": 0.0, "trial_type": event["name"], "value": event["value"] or "n/a", "code": event.get("code"),
                               **{key: event[key] for key in ("tick", "wall", "monotonic")}} for event, onset in self._timed("mark")], _EVENT_UNITS, about)

    def _timed(self, kind: str) -> Iterator[Tuple[_journal.Event, float]]:
        """The events of a kind, with the time since the session began, in s. It is taken from the monotonic clock within a run, which may begin anew
        between runs."""
        begun = run = self.header["started"]
        for event in self._events:
            if event.get("event") == "mark" and event["name"] == "run":
                run = event
            if event.get("event") == kind:
                yield event, float(run["wall"] - begun["wall"] + event.get("begin", event)["monotonic"] - run["monotonic"])

    def _trial_row(self, event: _journal.Event, onset: float) -> Dict[str, Any]:
        begin = event["begin"]
        return {"onset": onset, "duration": event["end"]["monotonic"] - begin["monotonic"],
                **{key: event[key] for key in ("number", "block", "kind", "condition", "track", "level")},
                "intervals": " ".join(map(repr, event["intervals"])), "expected": event["expected"] or "n/a",
                "answer": "n/a" if event["answer"] is None else str(event["answer"]), "outcome": event["outcome"],
                "response_time": event["response_time"], "guard": " ".join(event["guard"]) or "n/a", "guard_count": len(event["guard"]),
                "tick": begin["tick"], "begin_wall": begin["wall"], "begin_monotonic": begin["monotonic"]}

    def write(self, *formats: str) -> List[pathlib.Path]:
        """Writes _beh.tsv (trials) and _events.tsv with sidecars, and the same in further formats: "csv", "h5", "mat", "xdf". They are made from the journal,
        so writing them again loses nothing. Returns the files."""
        written = []
        for name, table in (("beh", self.trials), ("events", self.events)):
            for extension in ("tsv", *formats):
                copy = "_copy" if extension == "csv" else ""   # with a sidecar of its own
                written.append(self.folder / f"{self.stem}_{name}{copy}.{extension}")
                table.write(written[-1])
        top = self.folder.parents[2] / "dataset_description.json"
        if not top.exists():
            top.write_text(json.dumps({"Name": self.protocol.name, "BIDSVersion": "1.8.0", "DatasetType": "raw", "GeneratedBy": [{"Name": "tactus.lab"}]},
                                      indent=2) + "\n", encoding="utf-8")
        return written

    def _block(self, name: Optional[str]) -> Block:
        for block in self.protocol.blocks:
            if name in (None, block.name):
                return block
        fail("lab/unknown", "block", f"there is no block '{name}'", f"the blocks: {', '.join(b.name for b in self.protocol.blocks)}")

    def chosen(self, block: Optional[str] = None, condition: Optional[str] = None, kind: str = "main") -> Dict[str, Any]:
        """Levels and outcomes (both of shape (n,)) of the answered trials of a block, by default the first; of one condition, by default all."""
        name = self._block(block).name
        rows = [(level, outcome) for b, k, c, level, outcome in zip(*(self.trials[key] for key in ("block", "kind", "condition", "level", "outcome")))
                if (b, k, c) == (name, kind, c if condition is None else condition) and not math.isnan(outcome)]
        levels, outcomes = np.array(rows, dtype=float).reshape(-1, 2).T
        return {"levels": levels, "outcomes": outcomes}

    def fit(self, block: Optional[str] = None, condition: Optional[str] = None, *, function: Optional[Function] = None,
            lapse: Optional[float] = None) -> Union[Psychometric, PowerLaw]:
        """The psychometric function of a block, with its guess rate, by the posterior after a staircase or psi; for magnitude estimation, the power law.
        Practice and catch trials do not count."""
        given, data = self._block(block), self.chosen(block, condition)
        if given.task == "magnitude":
            return power_law(data["levels"], data["outcomes"])
        if given.task in ("adjust", "match"):
            fail("lab/data", given.name, "a psychometric function cannot be fitted to adjusted levels", "take their mean: chosen(block)['outcomes']")
        used = function or (given.procedure.function if isinstance(given.procedure, Psi) else "logistic")
        return psychometric(data["levels"], data["outcomes"], function=used, guess=given.guess_rate, lapse=lapse, unit=given.varies.unit,
                            method="profile" if isinstance(given.procedure, Constant) else "posterior")

    def detection(self, block: Optional[str] = None, condition: Optional[str] = None) -> Detection:
        """d' and criterion of a block with the task yes_no: its trials are signals, its catch trials noise."""
        if self._block(block).task != "yes_no":
            fail("lab/data", self._block(block).name, "the task is not yes_no", "give a block with the task yes_no")
        signals, noises = self.chosen(block, condition)["outcomes"], self.chosen(block, condition, "catch")["outcomes"]
        return detection(int(signals.sum()), len(signals), int(noises.sum()), len(noises))

    def turns(self, block: Optional[str] = None) -> Dict[str, List[float]]:
        """The levels at the reversals of each staircase, by condition and track ("smooth/0"), in the unit of what varies."""
        given = self._block(block)
        if not isinstance(given.procedure, Staircase):
            fail("lab/data", given.name, "the procedure of this block is not a staircase", "give a block with a staircase")
        tracks: Dict[str, StaircaseTrack] = {}
        for b, kind, c, t, level, outcome in zip(*(self.trials[key] for key in ("block", "kind", "condition", "track", "level", "outcome"))):
            if b == given.name and kind == "main" and not math.isnan(outcome):
                tracks.setdefault(f"{c}/{int(t)}", StaircaseTrack(given.procedure)).answer(level, outcome)
        return {name: track.turns for name, track in tracks.items()}

    def _repr_html_(self) -> str:
        state = "complete" if self.is_complete else "not complete"
        return f"<p>{self.stem}: {self.trials.rows} trials, {state}</p>{self.trials._repr_html_()}"


def _table(rows: List[Dict[str, Any]], units: Dict[str, str], about: Dict[str, Any]) -> Table:
    return Table({name: [row[name] for row in rows] for name in (rows[0] if rows else units)}, units, about)


def load(folder: Path, name: str = "") -> SessionData:
    """The data of a session, complete or not, from its folder. name: of the experiment, if the folder has several."""
    place = pathlib.Path(folder)
    found = sorted(place.glob(f"*_task-{name or '*'}_journal.jsonl"))
    if len(found) != 1:
        fail("lab/journal", str(folder), f"there are {len(found)} journals here" + (f" of '{name}'" if name else ""),
             "give the folder of a session, such as data/sub-01/ses-01/beh, and the name of an experiment if there are several")
    stem = found[0].name[:-len("_journal.jsonl")]
    data = json.loads((place / f"{stem}_protocol.json").read_text(encoding="utf-8"))
    return SessionData(place, stem, _journal.read(found[0]), read(Protocol, data))
