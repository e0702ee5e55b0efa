# SPDX-License-Identifier: MIT
"""Logs of runs: what they say about each tick, as arrays, and what the run felt like, played again."""

from __future__ import annotations

import json
import math
from typing import Any, Dict, List, Mapping, NamedTuple, Optional, Sequence, Tuple

import numpy as np

from . import _checks, _tactus
from ._assets import Assets, reader
from ._checks import Array, Path
from ._graph import Graph, checked_graph
from ._records import Layout, Records, to_json
from ._views import plain


class Event(NamedTuple):
    """Something in a log that is no reading. kind: "turn" (name: a parameter), "hit" (name: an input; value in m/s), "graph", "halt", "rearm",
    "emergency", "tightened" (name: a role), "late", "end" or "broken"."""

    tick: int
    kind: str
    name: str
    value: Any

    def __repr__(self) -> str:
        return f"<tactus.Event at tick {self.tick}: {plain(self.kind)} {plain(self.name)}>"


class Log(Records):
    """What a log says about each tick: arrays by role and field, "stylus.position" of shape (n, 3) in m. "passed" is the time since the previous tick in s
    by the wall clock.

    events: what was turned, hit and stopped. wall, monotonic: when tick 0 began, in s since 1970 (UTC) and by time.monotonic(); None if the run was not in
    real time. program: what wrote the log. is_cut_off: the program died."""

    def __init__(self, rows: Records, about: Dict[str, Any]):
        super().__init__(rows, units=rows.units, rate_hz=rows.rate_hz)
        head, clocks = about["head"], about["head"]["clocks"] or {}
        self.events = [Event(int(e["tick"]), str(e["kind"]), str(e["name"]), e["value"]) for e in about["events"]]
        self.wall: Optional[float] = clocks.get("wall")
        self.monotonic: Optional[float] = clocks.get("monotonic")
        self.program, self.is_cut_off = str(head["program"]), bool(about["is_cut_off"])

    def at(self, time: float) -> float:
        """The tick, with its fraction, at a monotonic time in s, such as that of a mark or of another recording on this computer. The ticks are those of this
        log; before and after them, it is not a number."""
        if self.monotonic is None:
            return math.nan
        begun = self.monotonic + np.concatenate(([0.0], np.cumsum(self["passed"][1:])))
        return float(np.interp(time, begun, np.arange(len(begun), dtype=np.float64), math.nan, math.nan))


@_checks.arguments
def read_log(log: Path, *, start: float = 0.0, until: Optional[float] = None) -> Log:
    """Reads a log of `tactus play`, of a session or of an engine, packed or not. Nothing is played.

    start, until: the part that is read, in s of ticks; without `until`, to the end. A long log needs tactus.set_limits("numbers=1G")."""
    return Log(*_read(_tactus.read_log(_checks.path("log", log), *_part(start, until))))


@_checks.arguments
def replay(log: Path, graph: Optional[Graph] = None, *, record: Optional[Sequence[str]] = None, set: Optional[Mapping[str, Any]] = None,
           start: float = 0.0, until: Optional[float] = None, assets: Optional[Assets] = None) -> Records:
    """Plays a logged run again, as `tactus render` does, with the same bits. No device moves.

    graph: played instead of that of the log. record: ports; without any, the inputs of all sinks. set: values of parameters. start, until: the ticks that
    are returned, in s; all before them are played, too. assets: as in Graph.render."""
    ports = [] if record is None else _checks.texts("record", record, "['drag.force']")
    values = {name: to_json(value, name) for name, value in _checks.mapping("set", set, "{'drag.mu': 0.3}").items()}
    played = None if graph is None else checked_graph(graph)._graph
    begin, end = _part(start, until)
    return _read(_tactus.replay(_checks.path("log", log), played, ports, values, reader(assets), begin, end), ports)[0]


def _part(start: Any, until: Any) -> Tuple[float, float]:
    begin = _checks.number("start", start, "give a time in s", low=0.0)
    return begin, math.inf if until is None else _checks.number("until", until, "give a time in s after the start", above=begin)


def _read(table: Tuple[int, List[str], List[str], Array, str], asked: Sequence[str] = ()) -> Tuple[Records, Dict[str, Any]]:
    first, names, units, values, text = table
    about: Dict[str, Any] = json.loads(text)
    rate = float(about["rate_hz"] if "rate_hz" in about else about["head"]["rate_hz"])
    return Layout(names, units, asked, rate).records(values, first), about
