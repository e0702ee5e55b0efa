# SPDX-License-Identifier: MIT
"""Graphs on real devices: a session plays in real time on the devices of this computer. Built on the C API of libtactus_live (tactus_live.h)."""

from __future__ import annotations

import atexit
import ctypes
import json
import os
import threading
import time
import warnings
from contextlib import contextmanager
from typing import Any, Dict, List, Mapping, NamedTuple, Optional, Sequence, Set, Union

import numpy as np

from ._engine import Status
from ._graph import Graph
from ._messages import Message, TactusWarning, fail, report
from ._records import Layout, Records, to_json

_PHASES = ("idle", "running", "halting", "over")


class Health(NamedTuple):
    """The state of a real device. age, oldest: of its readings, now and the oldest so far, in s. rate: of its reports, in Hz; 0 if unknown."""

    role: str
    profile: str
    is_connected: bool
    age: float
    oldest: float
    rate: float
    reports: int
    lost: int
    departures: int
    trouble: str


class _Message(ctypes.Structure):
    _fields_ = [("size", ctypes.c_uint32), ("is_error", ctypes.c_int32)] + \
        [(name, ctypes.c_char_p) for name in ("id", "where", "text", "remedy", "file")] + [("line", ctypes.c_int32), ("column", ctypes.c_int32)]


_TEXTS = ctypes.POINTER(ctypes.c_char_p)


class _Options(ctypes.Structure):
    _fields_ = [("size", ctypes.c_uint32), ("devices", _TEXTS), ("device_count", ctypes.c_size_t), ("session", ctypes.c_char_p),
                ("clock", ctypes.c_char_p), ("rate_hz", ctypes.c_double), ("duration_s", ctypes.c_double), ("core", ctypes.c_int32),
                ("is_strict", ctypes.c_int32), ("fuses", ctypes.c_int32), ("sets", _TEXTS), ("set_count", ctypes.c_size_t),
                ("records", _TEXTS), ("record_count", ctypes.c_size_t), ("buffer_s", ctypes.c_double), ("log", ctypes.c_char_p),
                ("assets", ctypes.c_void_p), ("asset_context", ctypes.c_void_p)]


class _Status(ctypes.Structure):
    _fields_ = [("size", ctypes.c_uint32), ("phase", ctypes.c_int32), ("ticks", ctypes.c_uint64), ("late_ticks", ctypes.c_uint64),
                ("force", ctypes.c_double), ("peak_force", ctypes.c_double), ("is_emergency", ctypes.c_int32)]


class _Health(ctypes.Structure):
    _fields_ = [("size", ctypes.c_uint32), ("role", ctypes.c_char_p), ("profile", ctypes.c_char_p), ("is_connected", ctypes.c_int32),
                ("age_s", ctypes.c_double), ("oldest_s", ctypes.c_double), ("rate_hz", ctypes.c_double), ("reports", ctypes.c_uint64),
                ("lost", ctypes.c_uint64), ("departures", ctypes.c_uint64), ("trouble", ctypes.c_char_p)]


_library: Optional[ctypes.CDLL] = None


def _live() -> ctypes.CDLL:
    """libtactus_live: next to the programs in a build folder, or the installed one."""
    global _library
    if _library is None:
        name = "libtactus_live.so.0"
        built = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "bin", name)
        path = os.path.normpath(built) if os.path.exists(built) else name
        try:
            library = ctypes.CDLL(path, mode=ctypes.RTLD_GLOBAL)   # global, because code of fused graphs calls its functions
        except OSError as why:
            fail("live/library", name, f"real devices need this library, and it cannot be loaded: {why}", "install the package libtactus-live0")
        for function in ("messages_create", "graph_load", "graph_parse", "session_open", "graph_file"):
            getattr(library, "tactus_" + function).restype = ctypes.c_void_p
        for function in ("messages_count", "session_events", "session_record_count", "session_probe_count", "session_collect",
                         "session_health_count"):
            getattr(library, "tactus_" + function).restype = ctypes.c_size_t
        for function in ("session_record_name", "session_record_unit", "session_probe_name", "session_clock"):
            getattr(library, "tactus_" + function).restype = ctypes.c_char_p
        library.tactus_session_rate.restype = ctypes.c_double
        library.tactus_session_lost.restype = ctypes.c_uint64
        _library = library
    return _library


class _Messages:
    """A list of messages of the library, which report() turns into an exception and warnings."""

    def __init__(self) -> None:
        self.handle = ctypes.c_void_p(_live().tactus_messages_create())

    def __enter__(self) -> "_Messages":
        return self

    def __exit__(self, *_: Any) -> None:
        _live().tactus_messages_free(self.handle)

    def take(self) -> List[Message]:
        found = []
        for i in range(_live().tactus_messages_count(self.handle)):
            m = _Message(size=ctypes.sizeof(_Message))
            _live().tactus_messages_get(self.handle, ctypes.c_size_t(i), ctypes.byref(m))
            found.append(Message(bool(m.is_error), *((t or b"").decode() for t in (m.id, m.where, m.text, m.remedy, m.file)), m.line, m.column))
        _live().tactus_messages_clear(self.handle)
        return found

    def check(self, is_done: bool) -> None:
        """Shows the warnings, and raises Error if the call has failed."""
        found = self.take()
        if not is_done and not any(m.is_error for m in found):
            fail("session/closed", "", "the session is closed, or it belongs to the process that forked this one", "open another session")
        report(found)


def _texts(texts: Sequence[str]) -> Any:
    return (ctypes.c_char_p * len(texts))(*(t.encode() for t in texts))


class Session:
    """A graph that plays on the devices of this computer. `play` makes it. Use it in a `with` statement: at its end, after an exception too, all
    forces go to zero, and the devices are released. Without one, call close(); a session that is forgotten plays until the program ends. Several threads may
    share a session: a call waits until calls from other threads are over, except emergency_stop(), rearm() and status(), which wait for nothing."""

    def __init__(self, graph: ctypes.c_void_p, options: _Options, keep: List[Any], asked: Sequence[str]):
        self._asked, self._collected, self._probed = list(asked), 0, None
        self._session: Optional[ctypes.c_void_p] = None
        self._one_at_a_time = threading.RLock()
        self._free = threading.Condition()   # guards the next two
        self._users, self._closes = 0, False
        with _Messages() as messages:
            handle = _live().tactus_session_open(graph, ctypes.byref(options), messages.handle)
            if handle:
                self._session = ctypes.c_void_p(handle)
                _sessions.add(self)
            try:
                messages.check(bool(handle))   # a warning may be an exception, too
            except BaseException:
                self.close()
                raise
        del keep

    @contextmanager
    def _handle(self, waits: bool = True):
        """The session, which is not freed during the `with` statement."""
        with self._free:
            if self._session is None or self._closes:
                fail("session/closed", "", "the session is closed", "open another one with tactus.play")
            self._users += 1
        try:
            if waits:
                with self._one_at_a_time:
                    yield self._session
            else:
                yield self._session
        finally:
            with self._free:
                self._users -= 1
                self._free.notify_all()

    def _call(self, function: str, *arguments: Any, waits: bool = True) -> None:
        with self._handle(waits) as handle, _Messages() as messages:
            messages.check(getattr(_live(), "tactus_session_" + function)(handle, *arguments, messages.handle) == 0)

    def __enter__(self) -> "Session":
        return self

    def __exit__(self, kind: Any, *_: Any) -> None:
        if kind is not None and self._session is not None:
            self.emergency_stop()
        self.close()

    # ------------------------------------------------------------------------ What it does

    @property
    def rate(self) -> float:
        """The tick rate in Hz."""
        with self._handle() as handle:
            return _live().tactus_session_rate(handle)

    @property
    def clock(self) -> str:
        """The role whose device ticks the run; "" if a timer does."""
        with self._handle() as handle:
            return (_live().tactus_session_clock(handle) or b"").decode()

    def status(self) -> Status:
        """How the run is doing."""
        s = _Status(size=ctypes.sizeof(_Status))
        with self._handle(waits=False) as handle:
            if _live().tactus_session_status(handle, ctypes.byref(s)) != 0:
                fail("session/closed", "", "the session belongs to the process that forked this one", "open another session")
        return Status(_PHASES[s.phase], s.ticks, s.late_ticks, s.force, s.peak_force, bool(s.is_emergency))

    def health(self) -> List[Health]:
        """The state of the real devices, whether they are there or awaited."""
        all_of_them = []
        with self._handle() as handle:
            for i in range(_live().tactus_session_health_count(handle)):
                h = _Health(size=ctypes.sizeof(_Health))
                if _live().tactus_session_health(handle, ctypes.c_size_t(i), ctypes.byref(h)) == 0:
                    all_of_them.append(Health((h.role or b"").decode(), (h.profile or b"").decode(), bool(h.is_connected), h.age_s, h.oldest_s,
                                              h.rate_hz, h.reports, h.lost, h.departures, (h.trouble or b"").decode()))
        return all_of_them

    def events(self) -> List[Message]:
        """What has happened since the last call: alarms, stops of the guards, trouble with devices and the log."""
        with self._handle() as handle, _Messages() as messages:
            _live().tactus_session_events(handle, messages.handle)
            return messages.take()

    def wait(self, duration: Optional[float] = None) -> bool:
        """Waits for `duration` in s, or until the run is over; events become warnings. Returns whether the run is over."""
        until = None if duration is None else time.monotonic() + duration
        while True:
            for message in self.events():
                warnings.warn(TactusWarning(message), stacklevel=2)
            if self.status().phase == "over":
                return True
            left = 0.05 if until is None else min(0.05, until - time.monotonic())
            if left <= 0.0:
                return False
            time.sleep(left)

    # ------------------------------------------------------------------------ While it plays

    def set(self, param: str, value: Any) -> None:
        """Sets a parameter: "drag.mu", "finger[*]/drag.mu". The value ramps."""
        self._call("set", param.encode(), (value if isinstance(value, str) else to_json(value)).encode())

    def control(self, name: str, value: float) -> None:
        """Turns a control of the graph, 0 to 1."""
        self._call("turn", name.encode(), ctypes.c_double(value))

    def hit(self, port: str, speed: float) -> None:
        """Triggers a hit input on the next tick. speed: in m/s."""
        self._call("hit", port.encode(), ctypes.c_double(speed))

    def edit(self, graph: Graph) -> None:
        """Plays an edited graph from the next tick on. Nodes that both graphs contain keep their state, and no force jumps."""
        with _Opened(graph) as opened:
            self._call("edit", opened)

    def probe(self, *ports: str) -> None:
        """From now on, `values` has the live values of these ports, instead of earlier ones."""
        with self._handle() as handle:
            self._call("probe", _texts(ports), ctypes.c_size_t(len(ports)))
            names = [_live().tactus_session_probe_name(handle, ctypes.c_size_t(i)).decode() for i in range(_live().tactus_session_probe_count(handle))]
            self._probed = Layout(names, [""] * len(names), ports, self.rate)

    def values(self) -> Dict[str, np.ndarray]:
        """The latest values of the probed ports: a number for a scalar, shape (3,) for a vector."""
        with self._handle() as handle:
            row = np.zeros(max(1, _live().tactus_session_probe_count(handle)))
            _live().tactus_session_probed(handle, row.ctypes.data_as(ctypes.c_void_p), ctypes.c_size_t(len(row)))
            return {name: row[where] for name, where in self._probed.ports} if self._probed else {}

    def collect(self) -> Records:
        """The ticks recorded since the last call, the oldest first. "t" counts only collected ticks, not `lost` ones."""
        live = _live()
        with self._handle() as handle:
            width = live.tactus_session_record_count(handle)
            indices = [ctypes.c_size_t(i) for i in range(width)]
            names = [live.tactus_session_record_name(handle, i).decode() for i in indices]
            units = [live.tactus_session_record_unit(handle, i).decode() for i in indices]
            parts, most = [np.zeros((0, width))], 4096
            while True:
                rows = np.zeros((most, width))
                count = live.tactus_session_collect(handle, rows.ctypes.data_as(ctypes.c_void_p), ctypes.c_size_t(most))
                parts.append(rows[:count])
                if count < most:
                    break
            table = np.concatenate(parts)
            first, self._collected = self._collected, self._collected + len(table)
            return Layout(names, units, self._asked, self.rate).records(table, first)

    @property
    def lost(self) -> int:
        """Recorded ticks that were lost because the buffer was full."""
        with self._handle() as handle:
            return _live().tactus_session_lost(handle)

    # ------------------------------------------------------------------------ Stops

    def emergency_stop(self) -> None:
        """Fades all forces to zero and keeps them there until rearm(). [any thread; waits for nothing]"""
        with self._handle(waits=False) as handle:
            _live().tactus_session_emergency_stop(handle)

    def rearm(self) -> None:
        """Ends emergency stops and all other latched stops. Only a person should decide this. Refused within a second of a stop. [any thread]"""
        self._call("rearm", waits=False)

    def stop(self) -> None:
        """Brings all forces to zero, ends the ticks, and completes the log; waits for it. What was recorded can still be collected."""
        self._call("stop")

    def close(self) -> None:
        """Stops, and releases the devices. Waits until calls from other threads are over."""
        with self._free:
            if self._session is None or self._closes:
                return
            self._closes = True
            try:
                self._free.wait_for(lambda: self._users == 0)
            except BaseException:   # such as KeyboardInterrupt
                self._closes = False
                raise
        _live().tactus_session_close(self._session)
        self._session = None
        _sessions.discard(self)


class _Opened:
    """A graph of the library: a copy of a Graph, or a file."""

    def __init__(self, graph: Union[Graph, str, os.PathLike]):
        self._graph = graph

    def __enter__(self) -> ctypes.c_void_p:
        live = _live()
        with _Messages() as messages:
            if isinstance(self._graph, Graph):
                text = self._graph.text.encode()
                handle = live.tactus_graph_parse(text, ctypes.c_size_t(len(text)), self._graph._graph.folder().encode(), messages.handle)
                for path, file in self._graph._graph.files().items() if handle else ():
                    with _Opened(Graph._of(file)) as included:
                        live.tactus_graph_set_file(ctypes.c_void_p(handle), path.encode(), included, messages.handle)
            else:
                file = live.tactus_graph_file(os.fspath(self._graph).encode())
                handle = live.tactus_graph_load(ctypes.cast(file, ctypes.c_char_p), messages.handle)
                live.tactus_text_free(ctypes.c_void_p(file))
            messages.check(bool(handle))
        self._handle = ctypes.c_void_p(handle)
        return self._handle

    def __exit__(self, *_: Any) -> None:
        _live().tactus_graph_free(self._handle)


def play(graph: Union[Graph, str, os.PathLike], device: Sequence[str] = (), *, session: Optional[str] = None, clock: Optional[str] = None,
         rate: Optional[float] = None, duration: Optional[float] = None, record: Sequence[str] = (), buffer: float = 10.0,
         set: Optional[Mapping[str, Any]] = None, log: Optional[str] = None, core: Optional[int] = None, strict: bool = False,
         fuse: bool = False) -> Session:
    """Plays a graph on the devices of this computer, as `tactus play` does, with the same guards, failsafe and guardian process.

        with tactus.play("dry_wood", device=["stylus=hid:auto"]) as session:
            session.probe("motor.force")
            session.wait(1.0)
            print(session.values()["motor.force"])   # shape (3,), N

    graph: a Graph, a file, or the name of a preset. device: devices of roles, as for the option --device. session: the file that binds other roles
    to devices, or "off"; without it, the user's. clock: what ticks the run: a role or "timer". rate: in Hz. duration: in s; without it, until it is
    stopped. record: ports; `buffer` s of them are kept until collect(). set: values of parameters. log: a file for the log of all inputs. strict: a
    missing device is an error. fuse: compiled code replaces the plan while it runs.

    The ticks never wait for Python. At the end of the `with` statement, after an exception, and at the end of the program, all forces go to zero."""
    if rate is not None and not rate > 0.0:
        fail("run/rate", "", f"{rate} is not a rate", "give a rate in Hz, or None for the usual one")
    devices = [device] if isinstance(device, str) else list(device)
    asked = [record] if isinstance(record, str) else list(record)
    sets = [f"{name}={value if isinstance(value, str) else json.dumps(json.loads(to_json(value)))}" for name, value in (set or {}).items()]
    keep = [_texts(devices), _texts(sets), _texts(asked)]
    with _Opened(graph) as opened:
        options = _Options(size=ctypes.sizeof(_Options), devices=keep[0], device_count=len(devices), session=session.encode() if session else None,
                           clock=clock.encode() if clock else None, rate_hz=rate or 0.0, duration_s=duration or 0.0,
                           core=0 if core is None else core + 1, is_strict=strict, fuses=fuse, sets=keep[1], set_count=len(sets), records=keep[2],
                           record_count=len(asked), buffer_s=buffer, log=os.fspath(log).encode() if log else None)
        made = Session(opened, options, keep, asked)
    try:
        made._call("start")
    except BaseException:
        made.close()
        raise
    return made


_sessions: Set[Session] = set()   # those that are open: what plays is not forgotten


@atexit.register
def _close_all() -> None:
    """No force outlives the program."""
    for session in list(_sessions):
        session.close()
