# SPDX-License-Identifier: MIT
"""Graphs on real devices: a session plays in real time on the devices of this computer. Built on the C API of libtactus_live (tactus_live.h)."""

from __future__ import annotations

import ctypes
import os
import threading
import time
import traceback
import warnings
from contextlib import contextmanager, suppress
from types import TracebackType
from typing import Any, Callable, Dict, Iterator, List, Mapping, NamedTuple, Optional, Sequence, Set, Type, Union

import numpy as np

from . import _checks
from ._callback import Caller
from ._checks import Path
from ._ending import main_has_ended, when_main_ends
from ._engine import Status
from ._graph import Graph, checked_graph
from ._library import HealthStruct, Messages, Opened, OptionsStruct, StatusStruct, live, texts
from ._messages import Error, Message, TactusWarning, fail, placed
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


class Session:
    """A graph that plays on the devices of this computer. `play` makes it. Use it in a `with` statement: at its end, after an exception too, all
    forces go to zero, and the devices are released. Without one, call close(); a session that is forgotten plays until the main thread ends, whatever other
    threads do. Several threads may share a session: a call waits until calls from other threads are over, except emergency_stop(), rearm() and status(),
    which wait for nothing, and stop() and close(), which bring the forces to zero first."""

    def __init__(self, graph: ctypes.c_void_p, options: OptionsStruct, keep: List[Any], asked: Sequence[str]):
        self._asked, self._collected = list(asked), 0
        self._probed: Optional[Layout] = None
        self._caller: Optional[Caller] = None
        self._session: Optional[ctypes.c_void_p] = None
        self._one_at_a_time = threading.RLock()
        self._free = threading.Condition()   # guards the next three
        self._calls: Dict[object, int] = {}   # those that go on, with their threads
        self._closes, self._is_released = False, False
        with Messages() as messages:
            handle = live().tactus_session_open(graph, ctypes.byref(options), messages.handle)
            if handle:
                self._session = ctypes.c_void_p(handle)
                _sessions.add(self)
            try:
                messages.check(bool(handle))   # a warning may be an exception, too
                if main_has_ended():
                    fail("session/main_thread", "", "the main thread of the program has ended", "let it wait for the other threads: call their join()")
            except BaseException:
                self.close()
                raise
        del keep

    @contextmanager
    def _handle(self, waits: bool = True, while_closing: bool = False) -> Iterator[ctypes.c_void_p]:
        """The session, which is not freed during the `with` statement. With `waits`, an exception of the callback is raised here."""
        if waits:
            self._raise_failure()
        call = object()
        try:
            with self._free:
                handle = self._session
                if handle is None or (self._closes and not while_closing):
                    fail("session/closed", "", "the session is closed", "open another one with tactus.play")
                self._calls[call] = threading.get_ident()
            if waits:
                with self._one_at_a_time:
                    yield handle
            else:
                yield handle
        finally:
            with self._free:
                self._calls.pop(call, None)
                self._free.notify_all()
            self._release()

    def _call(self, function: str, *arguments: Any, waits: bool = True) -> None:
        with self._handle(waits) as handle, Messages() as messages:
            messages.check(getattr(live(), "tactus_session_" + function)(handle, *arguments, messages.handle) == 0)

    def __enter__(self) -> "Session":
        return self

    def __exit__(self, kind: Optional[Type[BaseException]], why: Optional[BaseException], trace: Optional[TracebackType]) -> None:
        if kind is not None:
            with suppress(Error):   # it may be closed
                self.emergency_stop()
        self.close()

    def __repr__(self) -> str:
        try:
            now = self.status()
        except Error:
            return "<tactus.Session, closed>"
        return f"<tactus.Session, {now.phase}: {now.ticks} ticks, {now.force:.3g} N>"

    # ------------------------------------------------------------------------ The callback

    def _call_with_records(self, function: Callable[[Records], Any]) -> None:
        self._caller = Caller(function, self._take, self._halt)
        self._caller.start()

    def _halt(self) -> None:
        """Ends the run after an exception of the callback. [the thread of the callback]"""
        with suppress(Error):   # the caller may have closed the session meanwhile
            self.emergency_stop()
            self._call("stop", waits=False)

    def _raise_failure(self) -> None:
        """Raises what the callback has raised, once the forces are zero. The callback itself goes on."""
        if self._caller is None or self._caller.is_this_thread() or (why := self._caller.failure()) is None:
            return
        self._halt()
        raise why

    # ------------------------------------------------------------------------ What it does

    @property
    def rate(self) -> float:
        """The tick rate in Hz."""
        with self._handle() as handle:
            return float(live().tactus_session_rate(handle))

    @property
    def clock(self) -> str:
        """The role whose device ticks the run; "" if a timer does."""
        with self._handle() as handle:
            return (live().tactus_session_clock(handle) or b"").decode()

    def status(self) -> Status:
        """How the run is doing."""
        s = StatusStruct(size=ctypes.sizeof(StatusStruct))
        with self._handle(waits=False, while_closing=True) as handle:
            if live().tactus_session_status(handle, ctypes.byref(s)) != 0:
                fail("session/closed", "", "the session belongs to the process that forked this one", "open another session")
        return Status(_PHASES[s.phase], s.ticks, s.late_ticks, s.force, s.peak_force, bool(s.is_emergency))

    def health(self) -> List[Health]:
        """The state of the real devices, whether they are there or awaited."""
        all_of_them = []
        with self._handle() as handle:
            for i in range(live().tactus_session_health_count(handle)):
                h = HealthStruct(size=ctypes.sizeof(HealthStruct))
                if live().tactus_session_health(handle, ctypes.c_size_t(i), ctypes.byref(h)) == 0:
                    all_of_them.append(Health((h.role or b"").decode(), (h.profile or b"").decode(), bool(h.is_connected), h.age_s, h.oldest_s,
                                              h.rate_hz, h.reports, h.lost, h.departures, (h.trouble or b"").decode()))
        return all_of_them

    def events(self) -> List[Message]:
        """What has happened since the last call: alarms, stops of the guards, trouble with devices and the log."""
        with self._handle() as handle, Messages() as messages:
            live().tactus_session_events(handle, messages.handle)
            return messages.take()

    def wait(self, duration: Optional[float] = None) -> bool:
        """Waits for `duration` in s, or until the run is over; events become warnings. Returns whether the run is over."""
        until = None if duration is None else time.monotonic() + _checks.number("duration", duration, "give a time in s, from 0", low=0.0, high=_checks.MOST)
        while True:
            for message in self.events():
                warnings.warn(TactusWarning(message), stacklevel=2)
            if self.status().phase == "over":
                self._raise_failure()
                return True
            left = 0.05 if until is None else min(0.05, until - time.monotonic())
            if left <= 0.0:
                return False
            time.sleep(left)

    # ------------------------------------------------------------------------ While it plays

    def set(self, param: str, value: Any) -> None:
        """Sets a parameter: "drag.mu", "finger[*]/drag.mu". The value ramps."""
        name = _checks.text("param", param, "name a parameter, such as 'drag.mu'")
        with placed(name):
            self._call("set", name.encode(), (value if isinstance(value, str) else to_json(value, name)).encode())

    def control(self, name: str, value: float) -> None:
        """Turns a control of the graph, 0 to 1."""
        known = _checks.text("name", name, "name a control of the graph, such as 'roughness'")
        with placed(known):
            self._call("turn", known.encode(), ctypes.c_double(_checks.number("value", value, "give a number from 0 to 1")))

    def hit(self, port: str, speed: float) -> None:
        """Triggers a hit input on the next tick. speed: in m/s."""
        known = _checks.text("port", port, "name an input for hits, such as 'hold.hit'")
        with placed(known):
            self._call("hit", known.encode(), ctypes.c_double(_checks.number("speed", speed, "give a speed in m/s")))

    def edit(self, graph: Graph) -> None:
        """Plays an edited graph from the next tick on. Nodes that both graphs contain keep their state, and no force jumps."""
        with Opened(checked_graph(graph)) as opened:
            self._call("edit", opened)

    def probe(self, *ports: str) -> None:
        """From now on, `values` has the live values of these ports, instead of earlier ones."""
        _checks.texts("ports", ports, "probe('motor.force')")
        with self._handle() as handle:
            self._call("probe", texts(ports), ctypes.c_size_t(len(ports)))
            names = [live().tactus_session_probe_name(handle, ctypes.c_size_t(i)).decode() for i in range(live().tactus_session_probe_count(handle))]
            self._probed = Layout(names, [""] * len(names), ports, self.rate)

    def values(self) -> Dict[str, Any]:
        """The latest values of the probed ports: a number for a scalar, shape (3,) for a vector."""
        with self._handle() as handle:
            row = np.zeros(max(1, live().tactus_session_probe_count(handle)))
            live().tactus_session_probed(handle, row.ctypes.data_as(ctypes.c_void_p), ctypes.c_size_t(len(row)))
            return {name: row[where] for name, where in self._probed.ports} if self._probed else {}

    def collect(self) -> Records:
        """The ticks recorded since the last call, the oldest first. "t" counts only collected ticks, not `lost` ones. With a callback, that gets them."""
        if self._caller is not None:
            self._raise_failure()
            fail("session/callback", "collect", "the callback gets what is recorded", "use its records, or open the session without a callback")
        return self._take()

    def _take(self) -> Records:
        library = live()
        with self._handle() as handle:
            width = library.tactus_session_record_count(handle)
            indices = [ctypes.c_size_t(i) for i in range(width)]
            names = [library.tactus_session_record_name(handle, i).decode() for i in indices]
            units = [library.tactus_session_record_unit(handle, i).decode() for i in indices]
            parts, most = [np.zeros((0, width))], 4096
            while True:
                rows = np.zeros((most, width))
                count = library.tactus_session_collect(handle, rows.ctypes.data_as(ctypes.c_void_p), ctypes.c_size_t(most))
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
            return int(live().tactus_session_lost(handle))

    # ------------------------------------------------------------------------ Stops

    def emergency_stop(self) -> None:
        """Fades all forces to zero and keeps them there until rearm(). [any thread; waits for nothing]"""
        with self._handle(waits=False, while_closing=True) as handle:
            live().tactus_session_emergency_stop(handle)

    def rearm(self) -> None:
        """Ends emergency stops and all other latched stops. Only a person should decide this. Refused within a second of a stop. [any thread]"""
        self._call("rearm", waits=False)

    def stop(self) -> None:
        """Brings all forces to zero, ends the ticks, and completes the log; waits for it. What was recorded can still be collected. [any thread]"""
        self._raise_failure()
        self._call("stop", waits=False)

    def close(self) -> None:
        """Stops, and releases the devices. Waits until calls from other threads are over, and raises what the callback has raised. In a signal handler
        that has interrupted a call of this session, it stops, and the devices are released when that call is over. [any thread]"""
        with self._free:
            has_interrupted = threading.get_ident() in self._calls.values()   # a thread must not wait for itself, nor for those that wait for it
        with suppress(Error), self._handle(waits=False, while_closing=True) as handle:
            live().tactus_session_stop(handle, None)   # first the forces go to zero; then there is time for the callback and other calls
        note = None if self._caller is None or self._session is None else self._caller.end(waits=not has_interrupted)
        with self._free:
            if self._session is None:
                return
            self._closes = True
            if not has_interrupted:
                self._free.wait_for(lambda: not self._calls)
        self._release()
        if not has_interrupted:
            with self._free:
                self._free.wait_for(lambda: self._is_released)   # by the last call, perhaps
        if note is not None:
            warnings.warn(TactusWarning(note), stacklevel=2)
        self._raise_failure()

    def _release(self) -> None:
        """Frees the session once it is closed and no call uses it."""
        with self._free:
            if not self._closes or self._calls or self._session is None:
                return
            handle, self._session = self._session, None
        live().tactus_session_close(handle)
        _sessions.discard(self)
        with self._free:
            self._is_released = True
            self._free.notify_all()

    def _forget_threads(self) -> None:
        """In the child of a fork, the threads that call the session, or hold its locks, are not there."""
        self._one_at_a_time, self._free, self._calls, self._caller = threading.RLock(), threading.Condition(), {}, None


@_checks.arguments
def play(graph: Union[Graph, Path], device: Union[Sequence[str], Mapping[str, str]] = (), *, session: Optional[Path] = None, clock: Optional[str] = None,
         rate: Optional[float] = None, duration: Optional[float] = None, record: Sequence[str] = (), buffer: float = 10.0,
         set: Optional[Mapping[str, Any]] = None, log: Optional[Path] = None, core: Optional[int] = None, strict: bool = False,
         fuse: bool = False, callback: Optional[Callable[[Records], Any]] = None) -> Session:
    """Plays a graph on the devices of this computer, as `tactus play` does, with the same guards, failsafe and guardian process.

        with tactus.play("dry_wood", device={"stylus": "hid:auto"}) as session:
            session.probe("motor.force")
            session.wait(1.0)
            print(session.values()["motor.force"])   # shape (3,), N

    graph: a Graph, a file, or the name of a preset. device: devices of roles: a dict of text, or a list of text such as "stylus=hid:auto" or
    "stylus=gesture:circle". session: the file that binds other roles to devices, or "off"; without it, the user's. clock: what ticks the run: a role or
    "timer". rate: in Hz. duration: in s; without it, until it is stopped. record: ports; `buffer` s of them are kept until collect(). set: values of
    parameters. log: a file for the log of all inputs. strict: a missing device is an error. fuse: compiled code replaces the plan while it runs.

    callback: a function that is called with the Records of the recorded ports since its last call, every 20 ms or so, on a thread of its own. It may
    use the session. The ticks never wait for it: if it computes for too long, ticks that no longer fit into the buffer are dropped, and `lost` counts
    them. If it raises an exception, all forces go to zero, the run ends, and the next call of a function of the session, or the end of the `with`
    statement, raises the exception.

    The ticks never wait for Python. At the end of the `with` statement, after an exception, and at the end of the main thread, all forces go to zero."""
    devices = _devices(device)
    asked = _checks.texts("record", record, "record=['motor.force']")
    sets = [f"{name}={value if isinstance(value, str) else to_json(value, f'set[{name!r}]')}"
            for name, value in _checks.mapping("set", set, "set={'drag.mu': 0.3}").items()]
    _check_callback(callback, asked, buffer)
    keep = [texts(devices), texts(sets), texts(asked)]
    options = OptionsStruct(size=ctypes.sizeof(OptionsStruct), devices=keep[0], device_count=len(devices),
                       session=None if session is None else _checks.path("session", session, "give a session file, or 'off'").encode(),
                       clock=None if clock is None else _checks.text("clock", clock, "give the name of a role, or 'timer'").encode(),
                       rate_hz=0.0 if rate is None else _checks.rate(rate), duration_s=0.0 if duration is None else _checks.duration(duration),
                       core=0 if core is None else _checks.whole("core", core, "give the number of a CPU core, from 0", high=4095) + 1,
                       is_strict=_checks.truth("strict", strict), fuses=_checks.truth("fuse", fuse), sets=keep[1], set_count=len(sets), records=keep[2],
                       record_count=len(asked), buffer_s=_checks.number("buffer", buffer, "give a time in s, from 0", low=0.0, high=_checks.MOST),
                       log=None if log is None else _checks.path("log", log, "give a file, such as 'run.log'").encode())
    with Opened(graph) as opened, placed("play" if session is None else f"session {os.fspath(session)}"):
        made = Session(opened, options, keep, asked)
    try:
        made._call("start")
        if callback is not None:
            made._call_with_records(callback)
    except BaseException:
        made.close()
        raise
    return made


def _devices(given: Any) -> List[str]:
    """Devices as text: "stylus=hid:auto"."""
    example = "device={'stylus': 'hid:auto'}, or device=['stylus=hid:auto']"
    if isinstance(given, Mapping):
        return [f"{role}={_checks.text(f'device[{role!r}]', words, f'give {example}')}" for role, words in _checks.mapping("device", given, example).items()]
    return _checks.texts("device", given, example)


def _check_callback(callback: Any, record: Sequence[str], buffer: Any) -> None:
    if callback is None:
        return
    if not callable(callback):
        _checks.refuse("callback", callback, "a function", "give a function that takes the Records: callback=print")
    if not record:
        fail("argument/value", "callback", "the callback would get nothing, because nothing is recorded", "name ports, such as record=['motor.force']")
    _checks.number("buffer", buffer, "give a time in s, greater than 0, in which the callback is called again", above=0.0)


_sessions: Set[Session] = set()   # those that are open: what plays is not forgotten


@when_main_ends
def _close_all() -> None:
    """No force outlives the main thread."""
    for session in list(_sessions):   # all of them, before one takes its time
        with suppress(Error):
            session.emergency_stop()
    for session in list(_sessions):
        try:
            session.close()
        except BaseException:   # of a callback, or a second Ctrl-C; the other sessions are closed, too
            traceback.print_exc()


def _forget_all() -> None:
    """The sessions are those of the process that has forked this one."""
    for session in _sessions:
        session._forget_threads()
    _sessions.clear()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_forget_all)
