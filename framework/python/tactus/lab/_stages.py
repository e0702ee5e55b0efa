# SPDX-License-Identifier: MIT
"""Stages for stimuli: the devices of this computer, or none."""

from __future__ import annotations

import json
import math
import os
import queue
import time
from typing import Any, Dict, List, Mapping, NamedTuple, Optional, Tuple

from .._graph import Graph
from .._messages import fail
from .._play import Session, play
from .._views import wires_in
from ._protocol import Condition, Protocol, edited


class Moment(NamedTuple):
    """A point in time. tick: of the graph, None if none plays. wall: s since 1970 (UTC). monotonic: s of the clock of time.monotonic()."""

    tick: Optional[int]
    wall: float
    monotonic: float


Marks = queue.Queue[Tuple[str, str, Moment]]   # name, value, when


class Silent:
    """A stage without a graph: nothing is felt, and no time passes."""

    def show(self, condition: Condition, target: str, level: float) -> None:
        """Plays the condition from now on, with this level (in the unit of the target)."""

    def wait(self, duration: float) -> None:
        """Lets the participant feel it for a duration in s."""

    def now(self) -> Moment:
        """The present moment."""
        return Moment(None, time.time(), time.monotonic())

    def hand(self) -> Optional[str]:
        """The answer that the hand gives at this moment; None if it gives none."""
        return None

    def events(self) -> List[str]:
        """Ids of the messages since the last call: stops of the guards, trouble with devices."""
        return []

    def health(self) -> Dict[str, Any]:
        """The state of the run and of its devices, as JSON."""
        return {}

    def stop(self) -> None:
        """Takes all forces to zero, and keeps them there. [any thread]"""

    def close(self) -> None:
        """Ends the run: all forces go to zero first."""


FADE = 0.03   # s: an edited graph takes over the force in 10 ms, and nodes know the tool after a few ticks


def without_motors(graph: Graph) -> Graph:
    """A copy of a graph in which nothing is wired to its devices, except in files that it includes."""
    def unwire(whole: Dict[str, Any], part: Dict[str, Any]) -> None:
        sinks = {name for name, node in part.get("nodes", {}).items() if str(node.get("type")).startswith("device.")}
        part["wires"] = [wire for wire, view in zip(part.get("wires", []), wires_in(part)) if view.end.split(".")[0] not in sinks]
    return edited(graph, unwire)


def _shape(graph: Graph) -> Any:
    """A graph without the values of its parameters and controls, which ramp."""
    data = json.loads(graph.text)
    for part in (data, *data.get("graphs", {}).values()):
        for node in part.get("nodes", {}).values():
            node.pop("params", None)
        part.pop("controls", None)
    return data


class Live(Silent):
    """A stage on devices: a session of tactus.play. Parameters ramp to their new values. If a condition has other nodes or wires, the force fades to zero; then
    the graph is edited while it plays, and the force fades in."""

    def __init__(self, protocol: Protocol, log: Optional[str] = None, session: Optional[str] = None, device: Mapping[str, str] = {}):
        """log: the new file for the log of all inputs. session, device: as in tactus.play; `device` replaces those of the protocol."""
        self._protocol, self._session_file, self._log, self._device = protocol, session, log, dict(device)
        self._session: Optional[Session] = None
        self._graphs: Dict[str, Graph] = {}   # by condition: a file that changes in the middle of a session changes nothing
        self._playing = Graph()
        self._seen: List[str] = []

    def show(self, condition: Condition, target: str, level: float) -> None:
        graph = self._graphs.get(condition.name) or self._protocol.graph_of(condition)
        if graph is None:
            fail("lab/no_graph", f"condition {condition.name}", "there is no graph to play", "give the protocol a graph, or run it without devices")
        self._graphs[condition.name] = graph
        if self._session is None:
            if self._log is not None and os.path.exists(self._log):
                fail("lab/exists", self._log, "the log exists", "choose another file: a log is never replaced")
            self._session = play(graph, {**self._protocol.devices, **self._device}, session=self._session_file, log=self._log)
            if self._protocol.hand:
                self._session.probe(*sorted({answer.port for answer in self._protocol.hand.values()}))
        elif graph.text != self._playing.text:
            if _shape(graph) != _shape(self._playing):
                for quiet in (without_motors(self._playing), without_motors(graph)):
                    self._session.edit(quiet)
                    self.wait(FADE)
            self._session.edit(graph)
        self._playing = graph
        values, controls = self._protocol.values_of(condition)
        for name, value in [*values.items(), *controls.items(), (target, level)]:
            self._session.control(name, value) if name in graph.controls else self._session.set(name, value)

    def wait(self, duration: float) -> None:
        until = time.monotonic() + duration
        while (left := until - time.monotonic()) > 0.0:
            self._look()
            time.sleep(min(0.01, left))
        self._look()

    def _look(self) -> None:
        if self._session is None:
            return
        self._seen += [message.id for message in self._session.events()]
        status = self._session.status()
        if status.phase == "over" or status.is_emergency:
            fail("lab/stopped", "", "the forces are stopped: " + (", ".join(self._seen[-3:]) or "the run is over"), "find the cause, then resume the session")

    def now(self) -> Moment:
        before = time.monotonic()
        tick = self._session.status().ticks if self._session is not None else None
        return Moment(tick, time.time(), 0.5 * (before + time.monotonic()))

    def hand(self) -> Optional[str]:
        self._look()
        if self._session is None or not self._protocol.hand:
            return None
        values = self._session.values()
        return next((answer for answer, given in self._protocol.hand.items() if values.get(given.port, math.nan) > given.above), None)

    def events(self) -> List[str]:
        self._look()
        seen, self._seen = self._seen, []
        return seen

    def health(self) -> Dict[str, Any]:
        if self._session is None:
            return {}
        status = self._session.status()
        return {"phase": status.phase, "ticks": status.ticks, "late_ticks": status.late_ticks, "force_N": status.force, "peak_force_N": status.peak_force,
                "rate_hz": self._session.rate, "devices": [health._asdict() for health in self._session.health()]}

    def stop(self) -> None:
        if self._session is not None:
            self._session.emergency_stop()

    def close(self) -> None:
        if self._session is not None:
            self._session.close()
