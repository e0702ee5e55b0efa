# SPDX-License-Identifier: MIT
"""An engine that Python ticks step by step, or that ticks live on its own thread."""

from __future__ import annotations

import atexit
import json
import os
import weakref
from typing import Any, Dict, List, Mapping, NamedTuple, Optional, Sequence, Tuple, Type

import numpy as np

from . import _tactus
from ._assets import Assets, reader
from ._graph import Graph
from ._messages import fail
from ._own import Node, describe
from ._records import Layout, Records, names_of, table_of, to_json


class PushedDevice(NamedTuple):
    """A device of your own: push its readings into the engine, and take the efforts. Until the first reading, and when readings stop for
    longer than the guard's watchdog, the effort is zero.

    axes: names of the axes whose positions it reads. efforts: names of the axes that its motors push. buttons: names of its buttons. guard:
    limits as in docs/safety.md: {"max_force": "3 N", "watchdog": "20 ms"}."""

    axes: Sequence[str] = ()
    efforts: Sequence[str] = ()
    buttons: Sequence[str] = ()
    signal_inputs: int = 0
    signal_outputs: int = 0
    guard: Optional[Mapping[str, Any]] = None


class Effort(NamedTuple):
    """What a device should apply, after the guard. force (3,), on the tool, N. torque (3,), on the tool, N m. axes, N or N m, in the order
    of PushedDevice.efforts. signals: the signal outputs, channel 1 first."""

    force: np.ndarray
    torque: np.ndarray
    axes: np.ndarray
    signals: np.ndarray


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

    def __init__(self, graph: Graph, feed: Optional[Mapping[str, Any]] = None, record: Sequence[str] = (), rate: Optional[float] = None,
                 set: Optional[Mapping[str, Any]] = None, devices: Optional[Mapping[str, Any]] = None, nodes: Sequence[Type[Node]] = (),
                 assets: Optional[Assets] = None):
        """feed: the ports that you drive, with their first values: a number for a scalar, three for a vector, SI.
        record: ports; without any, the inputs of all sinks.
        rate: in Hz; without it, that of the graph.
        set: values of parameters, by name; a run starts with them.
        devices: by role: a PushedDevice, text as for --device ("sim", "trace:FILE.csv", "gesture:NAME", "FILE.json"), or a description
            as in a graph file ({"driver": "sim", …}), whose files are relative to the current folder. Real devices belong to the
            host.
        nodes: classes derived from tactus.Node that the graph uses; such an engine runs offline only.
        assets: what you supply instead of files that settings name. Tables and meshes are read from their files; pictures and
            recordings are not, so supply them. A dict by path, or by the last parts of a path: for a picture an array of shape
            (rows, columns) or (rows, columns, colours), of uint8, uint16, or floats from 0 (black) to 1 (white), top row first; for a
            recording a tactus.Signal; for a table an array of shape (rows, columns); for a mesh a tactus.Mesh. Or a function that gets the kind
            ("image", "signal", "table", "mesh") and the path, and returns one of these, or None to read the file."""
        self._begin()
        self._fed: Dict[str, int] = {}
        self._values = np.zeros(0)
        for port, value in (feed or {}).items():
            self._fed[port] = _width(port, np.asarray(value, dtype=float))
        self._values = np.concatenate([np.ravel(np.asarray(v, dtype=float)) for v in feed.values()]) if feed else self._values
        names = [name for port, width in self._fed.items() for name in names_of(port, width)]
        self._make(graph, names, record, rate, set, devices, nodes, None, assets)

    @classmethod
    def _offline(cls, graph: Graph, feed: Optional[Mapping[str, Any]], record: Sequence[str], rate: Optional[float],
                 set: Optional[Mapping[str, Any]], devices: Optional[Mapping[str, Any]], nodes: Sequence[Type[Node]],
                 assets: Optional[Assets]) -> "Engine":
        """An engine that is fed with a table from its first tick on."""
        engine = cls.__new__(cls)
        engine._begin()
        engine._fed, engine._values = {}, np.zeros(0)
        engine._make(graph, [], record, rate, set, devices, nodes, table_of(feed) if feed is not None else None, assets)
        return engine

    def _begin(self) -> None:
        self._collected = 0

    def _make(self, graph: Graph, feeds: List[str], record: Sequence[str], rate: Optional[float], set: Optional[Mapping[str, Any]],
              devices: Optional[Mapping[str, Any]], nodes: Sequence[Type[Node]], table: Optional[Tuple[List[str], np.ndarray]],
              assets: Optional[Assets]) -> None:
        if rate is not None and not rate > 0.0:
            fail("run/rate", "", f"{rate} is not a rate", "give a rate in Hz, or None for that of the graph")
        asked = [record] if isinstance(record, str) else list(record)
        values = {name: to_json(value) for name, value in (set or {}).items()}
        self._run = _tactus.Run(graph._graph, float(rate or 0.0), feeds, asked, values, describe(nodes), table, reader(assets))
        for role, device in (devices or {}).items():
            self._give(role, device)
        self._run.open()
        self._layout = Layout(self._run.columns(), self._run.units(), asked, self._run.rate())

    def _give(self, role: str, device: Any) -> None:
        if isinstance(device, PushedDevice):
            self._run.pushed_device(role, json.dumps({**device._asdict(), "guard": json.loads(to_json(device.guard))}))
        elif isinstance(device, Mapping):
            self._run.describe_device(role, to_json(dict(device)), "")
        elif isinstance(device, (str, os.PathLike)):
            self._run.device(role, os.fspath(device))
        else:
            fail("device/kind", f"/devices/{role}", f"{device!r} is not a device", "give a tactus.PushedDevice, text as for --device, or a description")

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

    def step(self, feed: Optional[Mapping[str, Any]] = None, n: Optional[int] = None) -> Records:
        """Runs n ticks, by default 1 or as many as the arrays are long.

        feed: values of fed ports: a number or (n,) for a scalar, (3,) or (n, 3) for a vector. A single
            value holds for all n ticks and stays set afterwards. Ports that are left out keep their last value.
        Returns what was recorded: "t" (n,) in s since the first tick, scalars (n,), vectors (n, 3)."""
        rows = self._rows(feed or {}, n)
        count = n if n is not None else 1 if rows is None else len(rows)
        first, done = self._run.steps(_checked(count), rows)
        return self._layout.records(done, first)

    def step_rows(self, rows: Optional[np.ndarray] = None, n: int = 1) -> np.ndarray:
        """The same for arrays, at a lower cost: rows has shape (n, fed components), or (1, fed components) for all ticks; the result has
        shape (n, recorded components), in the order of `columns`."""
        return self._run.steps(_checked(n), rows)[1]

    def _rows(self, feed: Mapping[str, Any], n: Optional[int]) -> Optional[np.ndarray]:
        """One row of values per tick, or one row for all; None if nothing is fed."""
        if unknown := [port for port in feed if port not in self._fed]:
            fail("feed/unknown", unknown[0], f"the engine is not fed through '{unknown[0]}'",
                 "name the port when you make the engine: feed={'" + unknown[0] + "': …}")
        if not self._fed:
            return None
        given = {port: np.asarray(value, dtype=float) for port, value in feed.items()}
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

    def push(self, role: str, position: Sequence[float] = (0, 0, 0), rotation: Sequence[float] = (0, 0, 0), pressure: float = 0.0,
             buttons: int = 0, axes: Sequence[float] = (), signals: Sequence[float] = (), age: float = 0.0, valid: bool = True) -> None:
        """The reading of a PushedDevice that the next ticks use.

        position (3,), m. rotation (3,), rotation vector, rad. pressure, N. buttons: bit i means that button i is down. axes, signals: in
        the order of the device. age: time since the device took the reading, s. valid: False if it has nothing to report; then the force
        is zero. [one thread per role; waits for nothing]"""
        self._run.push(role, {"position": position, "rotation": rotation, "pressure": pressure, "buttons": buttons, "axes": axes,
                              "signals": signals, "age": age, "valid": valid})

    def take(self, role: str) -> Effort:
        """What a PushedDevice should apply since the latest tick, after the guard. [one thread per role; waits for nothing]"""
        return Effort(**self._run.take(role))

    # ------------------------------------------------------------------------ While it runs

    def set(self, param: str, value: Any) -> None:
        """Sets a parameter ("drag.mu", "finger[*]/drag.mu"). Before the first tick, the value changes at once; later, it ramps."""
        self._run.set(param, to_json(value))

    def control(self, name: str, value: float) -> None:
        """Turns a control of the graph, 0 to 1."""
        self._run.control(name, value)

    def hit(self, port: str, speed: float) -> None:
        """Triggers a hit input on the next tick. speed: in m/s."""
        self._run.hit(port, speed)

    def edit(self, graph: Graph) -> None:
        """Plays an edited graph from the next tick on. Nodes that both graphs contain keep their state, and no force jumps."""
        self._run.edit(graph._graph)

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

    def start(self, duration: Optional[float] = None, core: Optional[int] = None, buffer: float = 10.0) -> None:
        """Ticks in real time on its own thread, which Python never delays, until stop() or for `duration` in s.

        core: the CPU core of the tick thread. buffer: how many s of records are kept until you collect them; 0 for none. Call collect()
        several times a second: it also frees memory that the tick thread no longer uses."""
        self._run.start(int(round((duration or 0.0) * self.rate)), -1 if core is None else core, int(round(buffer * self.rate)))
        _live.add(self)

    def collect(self) -> Records:
        """The ticks recorded since the last call, the oldest first. "t" counts only collected ticks, not `lost` ones."""
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


@atexit.register
def _stop_all() -> None:
    """A tick thread must not outlive the interpreter."""
    for engine in list(_live):
        engine.stop()


def _checked(n: int) -> int:
    if n < 0:
        fail("run/length", "", f"{n} is not a number of ticks", "give 0 or more")
    return n


def _width(port: str, value: np.ndarray) -> int:
    if value.shape not in ((), (3,)):
        fail("feed/shape", port, f"the first value has the shape {value.shape}", "give a number for a scalar, or three for a vector")
    return 1 if value.ndim == 0 else 3
