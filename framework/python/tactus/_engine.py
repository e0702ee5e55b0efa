# SPDX-License-Identifier: MIT
"""An engine that Python ticks step by step, or that ticks live on its own thread."""

from __future__ import annotations

import json
import numbers
import os
import weakref
from typing import Any, Dict, List, Mapping, NamedTuple, Optional, Sequence, Tuple, Type, Union, overload

import numpy as np

from . import _checks, _tactus
from ._assets import Assets, reader
from ._checks import Array, Numbers
from ._devices import Effort, PushedDevice, described, explain_push
from ._ending import when_main_ends
from ._graph import Graph, checked_graph
from ._messages import fail, placed, report
from ._own import Node, describe
from ._records import Layout, Records, names_of, table_of, to_json


class Status(NamedTuple):
    """phase: "idle" (ticked by you), "running", "halting" (the forces are falling to zero) or "over". late_ticks began at least one period
    late. force, peak_force: the largest force of all roles in N, now and since the start. In your own loop, all numbers are 0."""

    phase: str
    ticks: int
    late_ticks: int
    force: float
    peak_force: float
    is_emergency: bool


class Engine:
    """Plays a graph: step by step in your own loop, or live.

        engine = tactus.Engine(graph, feed={"drag.position": (0, 0, 0)}, record=["drag.force"])
        engine.step({"drag.position": (1e-4, 0, 0)})["drag.force"]   # one tick: shape (1, 3), N

    The graph may be edited afterwards; `edit` passes the edited graph on. Several threads may share an engine: a call waits until calls
    from other threads are over, except `push` and `take` (one thread per role), `emergency_stop` and `rearm`, which wait for
    nothing."""

    @_checks.arguments
    def __init__(self, graph: Graph, feed: Optional[Mapping[str, Any]] = None, record: Sequence[str] = (), rate: Optional[float] = None,
                 set: Optional[Mapping[str, Any]] = None, devices: Optional[Mapping[str, Any]] = None, nodes: Sequence[Type[Node]] = (),
                 assets: Optional[Assets] = None):
        """feed: the ports that you drive, with their first values: a number for a scalar, three for a vector, SI.
        record: ports; without any, the inputs of all sinks.
        rate: in Hz; without it, that of the graph.
        set: values of parameters, by name; a run starts with them.
        devices: by role: a PushedDevice, text ("sim", "trace:FILE.csv", "gesture:NAME", "FILE.json"), or a description
            as in a graph file ({"driver": "sim", …}), whose files are relative to the current folder. Real devices belong to the
            host.
        nodes: classes derived from tactus.Node that the graph uses; such an engine runs offline only.
        assets: what you supply instead of files that settings name. Tables and meshes are read from their files; pictures and
            recordings are not, so supply them. A dict by path, or by the last parts of a path: for a picture an array of shape
            (rows, columns) or (rows, columns, colours), of uint8, uint16, or floats from 0 (black) to 1 (white), top row first; for a
            recording a tactus.Signal; for a table an array of shape (rows, columns); for a mesh a tactus.Mesh. Or a function that gets the kind
            ("image", "signal", "table", "mesh") and the path, and returns one of these, or None to read the file."""
        self._collected = 0
        self._fed: Dict[str, int] = {}
        values = {port: _checks.array(f"feed[{port!r}]", value) for port, value in _checks.mapping("feed", feed, _FEED).items()}
        for port, value in values.items():
            self._fed[port] = _width(port, value)
        self._values = np.concatenate([np.ravel(v) for v in values.values()]) if values else np.zeros(0)
        names = [name for port, width in self._fed.items() for name in names_of(port, width)]
        self._make(graph, names, record, rate, set, devices, nodes, None, assets)

    @classmethod
    def _offline(cls, graph: Graph, feed: Optional[Mapping[str, Any]], record: Sequence[str], rate: Optional[float],
                 set: Optional[Mapping[str, Any]], devices: Optional[Mapping[str, Any]], nodes: Sequence[Type[Node]],
                 assets: Optional[Assets]) -> "Engine":
        """An engine that is fed with a table from its first tick on."""
        engine = cls.__new__(cls)
        engine._collected, engine._fed, engine._values = 0, {}, np.zeros(0)
        table = None if feed is None else table_of(_checks.mapping("feed", feed, "{'drag.position': path}, an array of shape (n, 3)"))
        engine._make(graph, [], record, rate, set, devices, nodes, table, assets)
        return engine

    def _make(self, graph: Graph, feeds: List[str], record: Sequence[str], rate: Optional[float], set: Optional[Mapping[str, Any]],
              devices: Optional[Mapping[str, Any]], nodes: Sequence[Type[Node]], table: Optional[Tuple[List[str], Array]],
              assets: Optional[Assets]) -> None:
        hz = 0.0 if rate is None else _checks.rate(rate)
        asked = _checks.texts("record", record, "record=['drag.force']")
        values = {name: to_json(value, f"set[{name!r}]") for name, value in _checks.mapping("set", set, "set={'drag.mu': 0.3}").items()}
        self._run = _tactus.Run(checked_graph(graph)._graph, hz, feeds, asked, values, describe(nodes), table, reader(assets))
        for role, device in _checks.mapping("devices", devices, "devices={'stylus': 'gesture:circle'}").items():
            self._give(role, device)
        self._run.open()
        self._layout = Layout(self._run.columns(), self._run.units(), asked, self._run.rate())

    _between = ""   # a role whose device has rules for step(dt)

    def __repr__(self) -> str:
        return f"<tactus.Engine at {self.rate:g} Hz: {self.ticks} ticks in its own loop>"

    def _give(self, role: str, device: Any) -> None:
        if isinstance(device, PushedDevice):
            if (device.between, device.step_effort) != ("hold", "last"):
                self._between = role
            self._run.pushed_device(role, json.dumps(described(role, device)))
        elif isinstance(device, Mapping):
            self._run.describe_device(role, to_json(dict(device), f"devices[{role!r}]"), "")
        elif isinstance(device, (str, os.PathLike)):
            self._run.device(role, _checks.path(f"devices[{role!r}]", device))
        else:
            fail("device/kind", f"devices[{role!r}]", f"{_checks.shown(device)} is not a device",
                 "give text such as 'sim' or 'gesture:circle', a description such as {'driver': 'sim'}, or a tactus.PushedDevice")

    def __enter__(self) -> "Engine":
        return self

    def __exit__(self, *_: Any) -> None:
        self.stop()

    # ------------------------------------------------------------------------ Properties

    @property
    def rate(self) -> float:
        """The tick rate in Hz."""
        return self._layout.rate_hz

    @property
    def roles(self) -> List[str]:
        """The roles of devices in the graph."""
        return self._run.roles()

    @property
    def columns(self) -> List[str]:
        """The recorded components, in the order of step_rows."""
        return self._run.columns()

    @property
    def units(self) -> Dict[str, str]:
        """The SI unit of each recorded port; "" if it is unknown."""
        return dict(self._layout.units)

    @property
    def ticks(self) -> int:
        """How many ticks your own loop has run."""
        return self._run.ticks()

    # ------------------------------------------------------------------------ In your own loop

    @overload
    def step(self, feed: Optional[Mapping[str, Any]] = None, n: Optional[int] = None) -> Records: ...

    @overload
    def step(self, feed: float) -> int: ...

    def step(self, feed: Union[None, float, Mapping[str, Any]] = None, n: Optional[int] = None) -> Union[int, Records]:
        """Runs n ticks, by default 1 or as many as the arrays are long.

        step(dt), with a time in s, runs the ticks that are due dt after the last such step, and returns how many: for loops with steps longer than a tick,
        such as physics at 500 Hz. `push` the reading of a PushedDevice first, and `take` its effort afterwards. What remains of a period is kept. Its ticks of
        the ports that `record` names are kept for `collect`, up to 10 s; `lost` counts the others.

        Only step(dt) uses `between` and `step_effort` of a PushedDevice. With n, each tick gets the reading as it is, and `take` gives the last effort.

        feed: values of fed ports: a number or (n,) for a scalar, (3,) or (n, 3) for a vector. A single
            value holds for all n ticks and stays set afterwards. Ports that are left out keep their last value.
        Returns what was recorded: "t" (n,) in s since the first tick, scalars (n,), vectors (n, 3)."""
        if type(feed) is float or isinstance(feed, numbers.Real):
            return self._run.step_for(feed if type(feed) is float and n is None and 0.0 < feed <= 1.0 else _step(feed, n))
        rows = self._rows(_checks.mapping("feed", feed, _FEED), None if n is None else _checked(n))
        count = _checked(n) if n is not None else 1 if rows is None else len(rows)
        if count > 1 and self._between:
            self._warn_of_rules(count)
        first, done = self._run.steps(count, rows)
        return self._layout.records(done, first)

    def _warn_of_rules(self, count: int) -> None:
        role, self._between = self._between, ""
        report([(False, "step/rules", f"/devices/{role}", f"step(n={count}) does not use `between` and `step_effort` of '{role}': all its ticks get the "
                 "same reading", f"give the length of the step in s: step({count / self.rate:g})")])

    def save(self) -> bytes:
        """The state of the run: nodes, parameters, delays, guards, controls and simulated devices. For rollouts, for undo, and for a reset that takes
        microseconds. A device or a node whose state cannot be saved is refused by name."""
        return self._run.save()

    def restore(self, state: bytes) -> None:
        """Goes back, or on, to a state of this engine or of another one with the same graph and devices, in any process with the same version of Tactus:
        the next ticks have the same bits. What does not fit is refused, and changes nothing. Limits, a halt and an emergency stop stay. `ticks` and the
        times of records go on. Restore only what you have saved."""
        if not isinstance(state, bytes):
            _checks.refuse("state", state, "the state of a run, as bytes", "give what save() returned")
        self._run.restore(state)

    def step_rows(self, rows: Optional[Array] = None, n: int = 1) -> Array:
        """The same for arrays, at a lower cost: rows has shape (n, fed components), or (1, fed components) for all ticks; the result has
        shape (n, recorded components), in the order of `columns`."""
        try:
            return self._run.steps(n, rows)[1]
        except (TypeError, ValueError):   # looked at only now, because this call should cost little
            _checks.array("rows", rows) if rows is not None else None
            _checked(n)
            raise

    def _rows(self, feed: Mapping[str, Any], n: Optional[int]) -> Optional[Array]:
        """One row of values per tick, or one row for all; None if nothing is fed."""
        if unknown := [port for port in feed if port not in self._fed]:
            fail("feed/unknown", unknown[0], f"the engine is not fed through '{unknown[0]}'",
                 "name the port when you make the engine: feed={'" + unknown[0] + "': …}")
        if not self._fed:
            return None
        given = {port: _checks.array(f"feed[{port!r}]", value) for port, value in feed.items()}
        per_tick = {port: a for port, a in given.items() if a.ndim == (1 if self._fed[port] == 1 else 2)}
        count = n if n is not None else max((len(a) for a in per_tick.values()), default=1)
        rows = np.tile(self._values, (count if per_tick else 1, 1))   # one row holds for all ticks
        at = 0
        for port, width in self._fed.items():
            if port in given:
                value = given[port]
                if value.shape not in ((), (count,)) if width == 1 else value.shape not in ((3,), (count, 3)):
                    fail("feed/shape", port, f"the values have the shape {value.shape}, and there are {count} ticks",
                         "give a number or (n,) for a scalar, (3,) or (n, 3) for a vector")
                rows[:, at:at + width] = value.reshape(-1, width)
            at += width
        if len(rows) > 0:
            self._values = rows[-1].copy()
        return rows

    # ------------------------------------------------------------------------ Devices of your own

    def push(self, role: str, position: Numbers = (0, 0, 0), rotation: Numbers = (0, 0, 0), pressure: float = 0.0,
             buttons: int = 0, axes: Numbers = (), signals: Numbers = (), age: float = 0.0, valid: bool = True,
             velocity: Optional[Numbers] = None, angular_velocity: Optional[Numbers] = None) -> None:
        """The reading of a PushedDevice that the next ticks use.

        position (3,), m. rotation (3,), rotation vector, rad. pressure, N. buttons: bit i means that button i is down. axes, signals: in
        the order of the device. age: time since the device took the reading, s. valid: False if it has nothing to report; then the force
        is zero. velocity, angular_velocity: (3,), m/s and rad/s, for between="by_velocity"; without them, the way since the last step counts.
        [one thread per role; waits for nothing]"""
        reading = {"position": position, "rotation": rotation, "pressure": pressure, "buttons": buttons, "axes": axes, "signals": signals, "age": age,
                   "valid": valid}
        if velocity is not None or angular_velocity is not None:
            reading.update(velocity=(0, 0, 0) if velocity is None else velocity,
                           angular_velocity=(0, 0, 0) if angular_velocity is None else angular_velocity)
        try:
            self._run.push(role, reading)
        except (TypeError, ValueError, RuntimeError) as why:   # looked at only now, because this call should cost little
            explain_push(role, position, rotation, pressure, buttons, axes, signals, age, velocity, angular_velocity, why)

    def take(self, role: str) -> Effort:
        """What a PushedDevice should apply since the latest tick, after the guard. [one thread per role; waits for nothing]"""
        return Effort(**self._run.take(_checks.text("role", role, "give the name of a role, such as 'stylus'")))

    # ------------------------------------------------------------------------ While it runs

    @_checks.arguments
    def set(self, param: str, value: Any) -> None:
        """Sets a parameter ("drag.mu", "finger[*]/drag.mu"). Before the first tick, the value changes at once; later, it ramps."""
        with placed(_checks.text("param", param, _PARAM)):
            self._run.set(param, to_json(value, param))

    def control(self, name: str, value: float) -> None:
        """Turns a control of the graph, 0 to 1."""
        with placed(_checks.text("name", name, _CONTROL)):
            self._run.control(name, _checks.number("value", value, "give a number from 0 to 1"))

    def hit(self, port: str, speed: float) -> None:
        """Triggers a hit input on the next tick. speed: in m/s."""
        with placed(_checks.text("port", port, _HIT)):
            self._run.hit(port, _checks.number("speed", speed, "give a speed in m/s"))

    def edit(self, graph: Graph) -> None:
        """Plays an edited graph from the next tick on. Nodes that both graphs contain keep their state, and no force jumps."""
        self._run.edit(checked_graph(graph)._graph)

    def emergency_stop(self) -> None:
        """Fades all forces to zero and keeps them there until rearm(). [any thread; waits for nothing]"""
        self._run.emergency_stop()

    def rearm(self) -> None:
        """Ends emergency stops, and all other stops of the guards. Only a person should decide this. [any thread; waits for nothing]"""
        self._run.rearm()

    def status(self) -> Status:
        """How the run is doing."""
        return Status(**self._run.status())

    # ------------------------------------------------------------------------ Live

    @_checks.arguments
    def start(self, duration: Optional[float] = None, core: Optional[int] = None, buffer: float = 10.0) -> None:
        """Ticks in real time on its own thread, which Python never delays, until stop() or for the ticks of `duration`, in s.

        core: the CPU core of the tick thread. buffer: how many s of records are kept until you collect them; 0 for none. Call collect()
        several times a second: it also frees memory that the tick thread no longer uses."""
        length = 0.0 if duration is None else _checks.duration(duration)
        on = -1 if core is None else _checks.whole("core", core, "give the number of a CPU core, from 0", high=4095)
        kept = _checks.number("buffer", buffer, "give a time in s, from 0", low=0.0, high=_checks.MOST)
        self._run.start(int(round(length * self.rate)), on, int(round(kept * self.rate)))
        _live.add(self)

    def collect(self) -> Records:
        """The ticks recorded since the last call, the oldest first: those of a live run, and those of step(dt). "t" counts only collected ticks, not
        `lost` ones."""
        rows = self._run.collect()
        first, self._collected = self._collected, self._collected + len(rows)
        return self._layout.records(rows, first)

    @property
    def lost(self) -> int:
        """Recorded ticks that were lost because the buffer was full."""
        return self._run.lost()

    def stop(self) -> None:
        """Brings all forces to zero and ends the live run; waits for both. What was recorded can still be collected."""
        if self in _live:
            self._run.stop()
            _live.discard(self)


_live: "weakref.WeakSet[Engine]" = weakref.WeakSet()


@when_main_ends
def _stop_all() -> None:
    """A tick thread must not outlive the interpreter."""
    for engine in list(_live):
        engine.stop()


_FEED = "{'drag.position': (0, 0, 0)}"
_PARAM = "name a parameter, such as 'drag.mu'"
_CONTROL = "name a control of the graph, such as 'roughness'"
_HIT = "name an input for hits, such as 'hold.hit'"


def _checked(n: Any) -> int:
    """A number of ticks."""
    if isinstance(n, (int, np.integer)) and n < 0:
        fail("run/length", "n", f"{n} is not a number of ticks", "give 0 or more")
    return _checks.whole("n", n, "give a number of ticks, from 0")


def _width(port: str, value: Array) -> int:
    if value.shape not in ((), (3,)):
        fail("feed/shape", f"feed[{port!r}]", f"the first value has the shape {value.shape}", "give a number for a scalar, or three for a vector")
    return 1 if value.ndim == 0 else 3


def _step(dt: Any, n: Optional[int]) -> float:
    """The length of a step, in s."""
    if n is not None:
        fail("argument/value", "n", "a step has a length in s or a number of ticks, not both", "give step(dt), or step(n=8)")
    return _checks.number("feed", dt, "give the length of the step in s, more than 0 and at most 1; step(n=8) runs 8 ticks", above=0.0, high=1.0)
