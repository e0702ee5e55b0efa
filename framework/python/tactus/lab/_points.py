# SPDX-License-Identifier: MIT
"""A point of a study: its render, and the numbers that are kept of it. A worker gets the study once; then it is only told its hash."""

from __future__ import annotations

import atexit
import copy
import functools
import hashlib
import json
import math
import os
import pathlib
import pickle
import platform
import shutil
import socket
import tempfile
import threading
import time
import traceback
import warnings
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Callable, Dict, List, Literal, NamedTuple, Optional, Sequence, Tuple

import numpy as np

from .. import _checks, _tactus
from .._assets import reader
from .._checks import Array
from .._graph import Graph, _restored
from .._messages import Error, TactusWarning, fail
from .._records import Layout, Records, table_of
from .._reports import check
from ._design import Point, text_of
from ._procedures import note
from ._results import Chunk, Stamp, row_type

if TYPE_CHECKING:
    from ._study import Prepared

ROOM = 2**16   # numbers of records that are held at the same time, if more than one point has them
Kind = Literal["peak", "max", "min", "mean", "rms", "last", "work", "given", "reach", "misfit", "band", "stable", "function"]
NEEDS: Dict[str, List[str]] = {**dict.fromkeys(("work", "given"), ["port", "position"]), "misfit": ["port", "column"], "stable": [], "function": ["function"]}


@dataclass(frozen=True)
class Measure:
    """A number about a render, or several."""

    name: str = field(metadata=note("the name of its column"))
    kind: Kind = field(metadata=note(
        "peak, rms: of the magnitude of the port. max, min, mean, last: of one component. work: of the force `port` on the position `position`, in J; a force "
        "is held until the next tick. given: the most that this work has been above 0 at any time. reach: the time at which a component passes `level` and "
        "stays there for `hold`, in s; not a number if it never does. misfit: rms of the difference between a component and a column of the recording. band: "
        "rms of the part of the port from `low` to `high`. stable: `tactus check` of stiffness and coupling: 2 passive along the motion, 1 stable, 0 neither; "
        "NAME_margin is how much stiffer it could be. function: a function in Python"))
    port: str = field(default="", metadata=note("a port, such as \"motor.force\", or a component of one"))
    position: str = field(default="", metadata=note("the port of the position, in m"))
    level: float = field(default=0.0, metadata=note("the level to reach, in the unit of the port"))
    hold: float = field(default=0.0, metadata=note("for how long it is held, in s", low=0.0))
    above: bool = field(default=True, metadata=note("false: the level is reached from above"))
    column: str = field(default="", metadata=note("the column of the recording"))
    low: float = field(default=40.0, metadata=note("the lowest frequency, in Hz", low=0.0))
    high: float = field(default=400.0, metadata=note("the frequency at which the band ends, in Hz", above=0.0))
    function: str = field(default="", metadata=note("the name of a function of (records, point), in the file that --functions gives"))
    outputs: List[str] = field(default_factory=list, metadata=note("names of the numbers that the function returns, if there are several"))
    unit: str = field(default="", metadata=note("the unit, for tables and the report"))

    @property
    def columns(self) -> List[str]:
        """The columns that it fills."""
        if self.kind == "stable":
            return [self.name, f"{self.name}_margin"]
        return [f"{self.name}_{output}" for output in self.outputs] or [self.name]


def checked(measures: List[Measure]) -> None:
    """Refuses measures that lack something."""
    names = [name for measure in measures for name in measure.columns]
    for i, measure in enumerate(measures):
        if any(not name or names.count(name) > 1 for name in measure.columns):
            fail("study/value", f"/measures/{i}", f"the column '{measure.name}' has no name, or is there twice", "give each measure a name of its own")
        for key in NEEDS.get(measure.kind, ["port"]):
            if not getattr(measure, key):
                fail("study/missing", f"/measures/{i}/{key}", f"the measure '{measure.name}' ({measure.kind}) needs `{key}`", "add it")
        if measure.kind == "band" and not measure.low < measure.high:
            fail("study/value", f"/measures/{i}", f"the band ends at {measure.high:g} Hz, before it begins", "give `low` below `high`")


class Block(NamedTuple):
    """Renders of some points that have equal columns and lengths."""

    rows: Array   # shape (points, ticks, columns); not numbers where a point has an error
    columns: List[str]
    rate: float
    recording: Dict[str, Array]

    def components(self, port: str) -> List[Array]:
        """The three components of a port, or its only one, each of shape (points, ticks)."""
        found = [self.rows[:, :, self.columns.index(name)] for name in (port, f"{port}.x", f"{port}.y", f"{port}.z") if name in self.columns]
        if not found:
            fail("study/measure", port, f"no column of the run belongs to '{port}'", "name a port of the graph")
        return found

    def component(self, port: str) -> Array:
        """The only component of a port."""
        first, *others = self.components(port)
        return fail("study/measure", port, f"'{port}' is a vector", f"name a component, such as {port}.z") if others else first


# The bits of a number must not depend on how many points are in its block. So sums are made tick by tick, and numpy may choose the order of no other sum.
def _sum(values: Array) -> Array:
    return np.asarray(np.cumsum(values, axis=1)[:, -1])


def _squares(m: Measure, block: Block) -> Array:
    """Of the magnitude of the port."""
    return np.asarray(sum(each * each for each in block.components(m.port)))


def _work(m: Measure, block: Block) -> Array:
    """Of the force on the position, from the second tick on."""
    forces, places = block.components(m.port), block.components(m.position)
    if len(forces) != len(places):
        fail("study/measure", m.name, f"'{m.port}' and '{m.position}' have different shapes", "give a force and a position, both vectors or both components")
    return np.cumsum(sum(force[:, :-1] * (place[:, 1:] - place[:, :-1]) for force, place in zip(forces, places)), axis=1)


def _reach(m: Measure, block: Block) -> Array:
    values = block.component(m.port)
    ticks = max(1, math.ceil((m.hold - 1e-9) * block.rate) + 1)   # that it must stay there
    count = np.cumsum(np.pad(values >= m.level if m.above else values <= m.level, ((0, 0), (1, ticks))), axis=1)
    stays = count[:, ticks:] - count[:, :-ticks] == ticks
    return np.where(stays.any(axis=1), stays.argmax(axis=1) / block.rate, np.nan)


def _misfit(m: Measure, block: Block) -> Array:
    if m.column not in block.recording:
        fail("study/no_column", f"/measures/{m.name}", f"the recording has no column '{m.column}'" if block.recording else "there is no recording",
             f"its columns: {', '.join(block.recording)}" if block.recording else "add the factor `recording`")
    rest: Array = block.component(m.port) - block.recording[m.column][:block.rows.shape[1]]
    return np.asarray(np.sqrt(_sum(rest * rest) / block.rows.shape[1]))


def band(values: Array, rate: float, low: float, high: float) -> float:
    """The rms of the part of a signal from low to high, in Hz; of a vector, that of its magnitude. values: shape (n,) or (n, 3)."""
    columns = values.reshape(len(values), -1)
    power = np.abs(np.fft.rfft(columns - columns.mean(axis=0), axis=0))**2
    at = np.fft.rfftfreq(len(columns), 1.0 / rate)
    weight = np.where((at == 0.0) | ((len(columns) % 2 == 0) & (at >= rate / 2 - 1e-9)), 1.0, 2.0)
    return float(np.sqrt((power.sum(axis=1) * weight)[(at >= low) & (at < high)].sum()) / len(columns))


KINDS: Dict[str, Callable[[Measure, Block], Any]] = {
    "peak": lambda m, block: np.sqrt(_squares(m, block).max(axis=1)),
    "rms": lambda m, block: np.sqrt(_sum(_squares(m, block)) / block.rows.shape[1]),
    "max": lambda m, block: block.component(m.port).max(axis=1),
    "min": lambda m, block: block.component(m.port).min(axis=1),
    "mean": lambda m, block: _sum(block.component(m.port)) / block.rows.shape[1],
    "last": lambda m, block: block.component(m.port)[:, -1],
    "work": lambda m, block: _work(m, block)[:, -1:].sum(axis=1),
    "given": lambda m, block: _work(m, block).max(axis=1, initial=0.0),
    "reach": _reach,
    "misfit": _misfit,
    "band": lambda m, block: [band(np.stack(each, axis=1), block.rate, m.low, m.high) for each in zip(*block.components(m.port))],
}
RANKS = {"passive": 2.0, "passive_here": 2.0, "stable": 1.0, "unstable": 0.0, "broken": 0.0}


def stable(graph: Graph, values: Dict[str, Any], rate: float, duration: float) -> Tuple[float, float]:
    """The worst verdict of the conditions `stiffness` and `coupling`, and their smallest known margin."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", TactusWarning)   # the render has told them
        judged = [c for c in check(graph, set=values, rate=rate, duration=duration or None).conditions if c.id in ("stiffness", "coupling")]
    ranks = [RANKS.get(c.verdict, np.nan) for c in judged] or [np.nan]
    margins = [np.nan if c.margin is None else c.margin for c in judged] or [np.nan]
    return 0.0 if 0.0 in ranks else float(np.min(ranks)), float(np.fmin.reduce(margins))   # what swings is certain, whatever else is unknown


# ---------------------------------------------------------------------------- Renders

@functools.lru_cache(maxsize=None)
def stamp() -> Stamp:
    """The version of Tactus, and a mark of how this computer computes: the hash of what its mathematical functions give. Equal marks make equal results
    likely; different marks mean that the last bits of results may differ."""
    x = np.linspace(0.01, 3.0, 1024)
    functions: List[Callable[[float], float]] = [math.exp, math.sin, math.cos, math.log, math.tanh, math.sqrt, math.expm1]
    parts = [np.exp(x), np.sin(x * 7.0), np.cos(x * 9.0), np.log(x), np.tanh(x), np.power(x, 1.7), np.arctan2(x, 1.3), np.fft.rfft(x), x.sum(), (x * x).mean(),
             *([f(v) for v in x.tolist()] for f in functions)]
    made = hashlib.blake2b(b"".join(np.asarray(part).tobytes() for part in parts), digest_size=6)
    return _tactus.version(), f"{platform.machine()}-{made.hexdigest()}"


def digest_of(path: str) -> str:
    """The hash of a file."""
    try:
        return hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest()
    except OSError as why:
        fail("study/no_recording", path, f"the file cannot be read: {why.strerror}", "check its name and permissions")


def simulated(role: str, given: Any, where: str) -> Dict[str, Any]:
    """The description of a simulated device. A study from a stranger never chooses a real one."""
    if isinstance(given, str):
        driver, _, path = given.partition(":")
        given = {"driver": driver, "path": path} if driver in ("gesture", "trace") and path else {"driver": given}
    if not isinstance(given, dict) or given.get("driver") not in ("sim", "gesture", "trace") or given == {"driver": "sim"}:
        fail("study/device", where, f"'{given if not isinstance(given, dict) else given.get('driver')}' is not a simulated device for the role '{role}'",
             "give gesture:NAME, trace:FILE.csv, or a description such as {\"driver\": \"sim\", \"mass\": \"50 g\"}")
    return dict(given)


class _Group(NamedTuple):
    """Points that differ in parameters and controls only."""

    graph: Graph   # with the settings and devices of the points
    recording: Dict[str, Array]
    run: "_tactus.Points"


class Worker:
    """A study in one thread."""

    def __init__(self, prepared: "Prepared", is_far: bool):
        """is_far: the files of the graph may not be where they were, so they are written into a folder of this process."""
        self.prepared, self.study = prepared, prepared.study
        text, folder, subgraphs, plugins = prepared.graph.__reduce__()[1]
        self.folders: Dict[str, str] = {"graph": folder, "study": self.study.folder}
        self.hidden: List[str] = [folder, self.study.folder]
        if is_far and prepared.files:
            self._unpack()
        self._parts = (text, self.folders["graph"], subgraphs, plugins)
        self.common = {name: text_of(value) for name, value in self.study.set.items() if name not in prepared.names}
        self._group = functools.lru_cache(4)(self._made)

    def _unpack(self) -> None:
        absolute = {name: os.path.abspath(folder or os.curdir) for name, folder in self.folders.items()}
        root = os.path.commonpath([*(os.path.dirname(path) for path in self.prepared.files), *absolute.values()])
        made = tempfile.mkdtemp(prefix="tactus-study-")
        atexit.register(shutil.rmtree, made, ignore_errors=True)
        for path, data in self.prepared.files.items():
            target = pathlib.Path(made, os.path.relpath(path, root))
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(data)
        self.folders = {name: os.path.normpath(os.path.join(made, os.path.relpath(folder, root))) for name, folder in absolute.items()}
        self.hidden += [*self.folders.values(), made]

    def render(self, points: Sequence[Point]) -> Chunk:
        """The results of some points, in their order."""
        rows = np.zeros(len(points), row_type(len(self.study.columns)))
        rows["key"], rows["numbers"] = self.prepared.keys(points), np.nan
        made = Chunk(rows, stamp(), f"{socket.gethostname()} {os.getpid()}")
        made.traces = [np.zeros(0)] * len(points) if self.study.keep else []
        groups: Dict[Tuple[str, ...], List[int]] = {}
        for i, point in enumerate(points):
            groups.setdefault(tuple([point[k] for k in self.prepared.slow]), []).append(i)
        for slow, members in groups.items():
            try:
                group = self._group(slow)
                while members:
                    some = members[:ROOM // (group.run.width or ROOM) or 1]
                    self._some(group, points, some, made)
                    members = members[len(some):]
            except Error as why:
                for i in members:
                    self._fail(made, i, why.id, why.where, why.text)
        rows["bad"][list(map(int, made.errors))] = True
        rows["numbers"][rows["bad"]] = np.nan
        rows["ticks"] = list(map(len, made.traces)) or 0
        return made

    def _fail(self, made: Chunk, i: int, name: str, where: str, text: str) -> None:
        for folder in sorted(filter(None, self.hidden), key=len, reverse=True):   # so that the text is the same on each worker
            text, where = text.replace(folder + os.sep, ""), where.replace(folder + os.sep, "")
        made.errors.setdefault(str(i), [f"{name}: {text}", where])

    def _made(self, slow: Tuple[str, ...]) -> _Group:
        graph, rate, devices = _restored(*self._parts), self.study.rate, dict(self.prepared.devices)
        recording: Dict[str, Array] = {}
        for name, value in ((self.prepared.names[k], json.loads(text)) for k, text in zip(self.prepared.slow, slow)):
            kind, _, rest = name.partition(":")
            if kind == "setting":
                node, _, setting = rest.rpartition(".")
                patch, _, inner = node.rpartition("/")
                graph.set_setting(inner, setting, value, patch)
            elif kind == "device":
                self._describe(devices, rest, value)
            elif kind == "rate":
                rate = _checks.number("rate", value, "give rates in Hz", above=0.0)
            else:
                recording = self._recording(value)
        feed = {"t": recording["t"]} if "t" in recording else {}
        for port, column in self.study.feed.items() if recording else ():
            feed[port] = recording[column] if isinstance(column, str) else np.full(len(next(iter(recording.values()))), float(column))
        for role, description in devices.items():
            graph.set_device(role, self._placed(description))
        run = _tactus.Points(graph._graph, rate, self.prepared.records, self.common, [self.prepared.names[k] for k in self.prepared.fast],
                             table_of(feed) if feed else None, reader(self.prepared.assets), self.study.duration)
        return _Group(graph, recording, run)

    def _placed(self, description: Dict[str, Any]) -> Dict[str, Any]:
        """The description of a device, with the places of files that are in the folder of the study."""
        found = {}
        for key, value in description.items():
            path = os.path.join(self.folders["study"], value) if key == "path" and isinstance(value, str) else ""
            found[key] = self._placed(value) if isinstance(value, dict) else path if os.path.isfile(path) else value
        return found

    def _describe(self, devices: Dict[str, Dict[str, Any]], name: str, value: Any) -> None:
        role, _, key = name.partition("/")
        if not key:
            devices[role] = simulated(role, value, f"device:{role}")
            return
        base = devices.get(role) or self.prepared.described.get(role) or {}
        if base.get("driver") not in ("sim", "gesture", "trace"):
            fail("study/device", f"device:{name}", f"the role '{role}' has no simulated device that could be changed", "describe it in `devices`")
        inside = devices[role] = copy.deepcopy(base)
        *path, last = key.split("/")
        for each in path:
            inside = inside.setdefault(each, {})
            if not isinstance(inside, dict):
                fail("study/device", f"device:{name}", f"'{each}' is not an object", "name a key of the description, such as hand/stiffness")
        inside[last] = value

    def _recording(self, name: str) -> Dict[str, Array]:
        path = os.path.join(self.study.folder, name)
        if digest_of(path) != self.prepared.recordings.get(name):
            fail("study/recording", name, "the recording has changed since the study began", "restore it, or begin the study in another folder")
        columns, rows = _tactus.read_table(path)
        for column in self.study.feed.values():
            if isinstance(column, str) and column not in columns:
                fail("study/recording", name, f"the recording has no column '{column}'", f"its columns: {', '.join(columns)}")
        return {column: rows[:, i] for i, column in enumerate(columns)}

    def one(self, point: Point) -> Tuple[Graph, Records]:
        """One point to look at: the graph with its settings and devices, and the records of its ports and sinks."""
        group = self._group(tuple([point[k] for k in self.prepared.slow]))
        rows, errors, _ = group.run.render([[point[k] for k in self.prepared.fast]])
        for _, name, where, text in errors:
            fail(name, where, text, "this point of the study has an error; correct the study, or leave it as it is")
        return group.graph, self._records(group, rows[0])

    def _records(self, group: _Group, rows: Array) -> Records:
        return Layout(group.run.columns, group.run.units, self.prepared.records, group.run.rate).records(rows)

    def _some(self, group: _Group, points: Sequence[Point], members: List[int], made: Chunk) -> None:
        """Renders points of one group."""
        begin, at, keep, fast = time.perf_counter(), 0, self.study.keep, self.prepared.fast
        rows, errors, told = group.run.render([[points[i][k] for k in fast] for i in members])
        made.warnings.update(told)
        for k, name, where, text in errors:
            if name == "api/no_memory":   # another try may not have it
                raise MemoryError(text)
            self._fail(made, members[k], name, where, text)
        good = [(k, i) for k, i in enumerate(members) if str(i) not in made.errors] if made.errors else list(enumerate(members))
        block = Block(rows, group.run.columns, group.run.rate, group.recording)
        numbers = np.full((len(members), len(self.study.columns)), np.nan)
        for m in self.study.measures if good else ():
            if m.kind in KINDS:
                with np.errstate(all="ignore"):
                    numbers[:, at] = KINDS[m.kind](m, block)
            for k, i in good if m.kind not in KINDS else ():
                numbers[k, at:at + len(m.columns)] = self._of_point(m, group, points[i], rows[k], made, i)
            at += len(m.columns)
        made.rows["numbers"][members] = numbers
        kept = [c for c, name in enumerate(block.columns) if name in keep or name[:-2] in keep] if keep else []
        made.kept = [block.columns[c] for c in kept] or made.kept
        for k, i in good if kept else ():
            made.traces[i] = rows[k][:, kept]
        made.rows["seconds"][members] = (time.perf_counter() - begin) / len(members)

    def _of_point(self, m: Measure, group: _Group, point: Point, rows: Array, made: Chunk, i: int) -> Sequence[float]:
        """The numbers of a measure that is not computed for many points at once."""
        try:
            if m.kind == "function":
                given = self.prepared.functions[m.function](self._records(group, rows), self.prepared.values(point))
                numbers = [float(each) for each in given] if m.outputs else [float(given)]
                if len(numbers) != len(m.columns):
                    fail("study/function", m.function, f"the function has returned {len(numbers)} numbers, and {len(m.columns)} have names",
                         "return as many numbers as `outputs` names")
                return numbers
            return stable(group.graph, {**self.study.set, **self.prepared.values(point, self.prepared.fast)}, group.run.rate, self.study.duration)
        except Error as why:
            self._fail(made, i, why.id, why.where, why.text)
        except (MemoryError, KeyboardInterrupt):
            raise
        except Exception as why:   # of a function of the user
            frame = traceback.extract_tb(why.__traceback__)[-1]
            self._fail(made, i, "study/function", f"{os.path.basename(frame.filename)}:{frame.lineno}", f"{type(why).__name__}: {why}")
        return [np.nan] * len(m.columns)


_mine = threading.local()   # the study that each thread has: one, so that memory stays flat


def work(context: bytes, pickled: Optional[bytes], points: Sequence[Point]) -> Optional[Chunk]:
    """The results of some points, on any worker. None: this worker does not have the study yet, so send it."""
    if getattr(_mine, "context", b"") != context:
        if pickled is None:
            return None
        _mine.worker, _mine.context = Worker(pickle.loads(pickled), is_far=True), context
    chunk: Chunk = _mine.worker.render(points)
    return chunk
