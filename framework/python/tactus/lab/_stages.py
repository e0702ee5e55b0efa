# SPDX-License-Identifier: MIT
"""Stages for stimuli: the devices of this computer, or none; marks from outside by OSC, and triggers over a serial line."""

from __future__ import annotations

import contextlib
import io
import json
import math
import os
import queue
import secrets
import socket
import socketserver
import struct
import threading
import time
from typing import Any, Callable, Dict, List, Mapping, NamedTuple, Optional, Tuple, Union

from .._graph import Graph
from .._messages import fail
from .._play import Session, play
from .._views import wires_in
from ._protocol import Condition, Protocol, Triggers, edited


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


PORT = 7771   # of experiments; 7770 is that of `tactus play`
NO_MESSAGE = ValueError, KeyError, struct.error   # what is wrong with a packet

Argument = Union[str, float, int]
_NUMBERS = {"i": ">i", "f": ">f", "h": ">q", "d": ">d"}


def osc(address: str, *arguments: Argument) -> bytes:
    """An OSC message with texts, whole numbers (32 bits) and other numbers (32 bits)."""
    kinds = ["s" if isinstance(each, str) else "i" if isinstance(each, int) else "f" for each in arguments]
    data = (_padded(each) if isinstance(each, str) else struct.pack(_NUMBERS[kind], each) for kind, each in zip(kinds, arguments))
    return b"".join([_padded(address), _padded("," + "".join(kinds)), *data])


def read_osc(packet: bytes) -> Tuple[str, List[Argument]]:
    """The address and the arguments of an OSC message. It raises one of NO_MESSAGE if the packet is not one."""
    address, rest = _text(packet)
    types, rest = _text(rest)
    if not address.startswith("/") or not types.startswith(","):
        raise ValueError("it is not a message")
    found: List[Argument] = []
    for kind in types[1:]:
        if kind == "s":
            value, rest = _text(rest)
        else:
            (value,), rest = struct.unpack_from(_NUMBERS[kind], rest), rest[struct.calcsize(_NUMBERS[kind]):]
        found.append(value)
    return address, found


def _padded(text: str) -> bytes:
    data = text.encode() + b"\0"
    return data + b"\0" * (-len(data) % 4)


def _text(data: bytes) -> Tuple[str, bytes]:
    end = data.index(b"\0")
    return data[:end].decode(), data[end + 4 - end % 4:]


class Receiver(socketserver.UDPServer):
    """Receives /tactus/mark (name, and perhaps a value) and /tactus/answer (an answer, and the token) on this computer, on a thread of its own. Both get
    /tactus/done back. A mark is only kept. An answer may raise the next level, and with it a force, so it needs the token that the experiment shows."""

    def __init__(self, port: int = PORT):
        """port: UDP port on 127.0.0.1; 0: any free one."""
        try:
            super().__init__(("127.0.0.1", port), socketserver.BaseRequestHandler)
        except OSError as why:
            fail("lab/port", str(port), f"the port cannot be opened: {why}", "choose another one with --osc, or 0 for any")
        self.token, self.port = secrets.token_hex(4), int(self.server_address[1])
        self.now: Callable[[], Moment] = Silent().now   # the clock of the experiment
        self.marks: Marks = queue.Queue(10000)
        self.answers: "queue.Queue[str]" = queue.Queue(100)
        self._thread = threading.Thread(target=self.serve_forever, kwargs={"poll_interval": 0.05}, name="tactus.lab marks", daemon=True)
        self._thread.start()

    def finish_request(self, request: Any, client_address: Any) -> None:
        """Takes a packet. One of a stranger does nothing."""
        with contextlib.suppress(*NO_MESSAGE, queue.Full, OSError):
            address, given = read_osc(request[0])
            if address == "/tactus/mark" and given:
                self.marks.put_nowait((str(given[0])[:1000], " ".join(map(str, given[1:]))[:1000], self.now()))
            elif address == "/tactus/answer" and len(given) == 2 and secrets.compare_digest(str(given[1]).encode(), self.token.encode()):
                self.answers.put_nowait(str(given[0])[:1000])
            else:
                return
            request[1].sendto(osc("/tactus/done", address, given[0]), client_address)

    def answer(self) -> Optional[str]:
        """The oldest answer that was not taken yet; None if there is none."""
        return None if self.answers.empty() else self.answers.get()

    def close(self) -> None:
        """Ends the thread."""
        self.shutdown()
        self._thread.join()
        self.server_close()


def mark(text: str, value: str = "", port: int = PORT, wait: float = 2.0) -> bool:
    """Sends a mark to the experiment that runs on this computer, as `tactus mark` does. wait: for its reply, in s. True if it replied."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as own:
        own.settimeout(wait)
        try:
            own.sendto(osc("/tactus/mark", text, *([value] if value else [])), ("127.0.0.1", port))
            return read_osc(own.recv(4096))[0] == "/tactus/done"
        except (OSError, *NO_MESSAGE):
            return False


class TriggerLine(io.FileIO):
    """A serial line that carries a byte for each mark."""

    def __init__(self, triggers: Triggers):
        import termios
        import tty

        self._codes = triggers.codes
        speed = getattr(termios, f"B{triggers.baud}", None)
        if speed is None:
            fail("lab/value", "/triggers/baud", f"serial lines of this system have no speed of {triggers.baud} bits per second",
                 "give a standard one, such as 115200")
        try:
            super().__init__(triggers.port, "wb", opener=lambda path, _: os.open(path, os.O_WRONLY | os.O_NOCTTY | os.O_NONBLOCK))
            tty.setraw(self.fileno())   # a file that is no serial line is refused here, before anything is written
            now = termios.tcgetattr(self)
            now[4] = now[5] = speed
            termios.tcsetattr(self, termios.TCSANOW, now)
        except (OSError, termios.error) as why:
            fail("lab/triggers", triggers.port, f"the serial line cannot be opened: {why}", "check /triggers/port of the protocol")

    def send(self, name: str) -> Optional[int]:
        """Sends the code of a mark; returns it, or None if the mark has none. A full line is an error, not a wait."""
        code = self._codes.get(name)
        if code is not None:
            try:
                os.write(self.fileno(), bytes([code]))
            except OSError as why:
                fail("lab/triggers", name, f"the trigger was not sent: {why}", "check the serial line, then resume the session")
        return code
