# SPDX-License-Identifier: MIT
"""Renders chunks of points. A worker gets the study once; then it is only told its hash."""

from __future__ import annotations

import atexit
import collections
import csv
import functools
import json
import os
import pickle
import shutil
import socket
import tempfile
import threading
import traceback
import types
from dataclasses import dataclass, field
from typing import Any, Dict, List, NamedTuple, Optional, Sequence, Tuple

import numpy as np

from .. import _tactus
from .._assets import reader
from .._checks import Array
from .._graph import Graph, _restored
from .._messages import Error, fail
from .._records import Layout, Records, table_of
from . import _measures
from ._design import Point, text_of, values_of
from ._study import Prepared, bits, digest_of, simulated

Problem = Tuple[int, str, str, str]   # the number of the point in its chunk, id, place, text
Stamp = Tuple[str, str]   # the version of Tactus, and the mark of the computer
AT_ONCE = 64   # renders whose records are held at the same time
NOT_OF_A_POINT = ("api/no_memory",)   # an error that another try may not have


@dataclass
class Chunk:
    """What is kept of some points."""

    numbers: Array   # shape (n, columns of measures)
    seconds: Array   # shape (n,), of the renders
    problems: List[Problem] = field(default_factory=list)
    traces: List[Array] = field(default_factory=list)   # for each point, shape (ticks, columns of kept ports)
    kept: List[str] = field(default_factory=list)   # the columns of traces
    warnings: Dict[str, str] = field(default_factory=dict)   # one of each kind and place
    host: str = ""
    process: int = 0
    stamp: Stamp = ("", "")


class _Group(NamedTuple):
    """Points that differ in parameters and controls only."""

    graph: Graph
    devices: Dict[str, str]
    rate: float
    recording: Dict[str, Array]
    feed: Optional[Tuple[List[str], Array]]


@functools.lru_cache(maxsize=None)
def stamp() -> Stamp:
    """The version of Tactus, and the mark of this computer."""
    return _tactus.version(), bits()


class Worker:
    """A study in one process."""

    def __init__(self, prepared: Prepared, is_far: bool):
        """is_far: the files of the graph may not be where they were, so they are written into a folder of this process."""
        self.prepared, self.study = prepared, prepared.study
        text, folder, subgraphs, plugins = prepared.graph.__reduce__()[1]
        self.folders: Dict[str, str] = {"graph": folder, "study": self.study.folder}
        self.hidden: List[str] = [folder, self.study.folder]
        if is_far and prepared.files:
            self._unpack()
        self._parts = (text, self.folders["graph"], subgraphs, plugins)
        self.functions = dict(prepared.functions) or self._load()
        self.assets = reader(prepared.assets)
        self.common = {name: text_of(value) for name, value in self.study.set.items() if name not in prepared.names}
        measures = self.study.measures
        self.gauges = [m for m in measures if not m.needs_records and m.kind != "stable"]
        self.places = next((m.places for m in measures if m.kind == "stable"), 0)
        self.keeps = bool(self.study.keep) or any(m.needs_records for m in measures)
        self._lock = threading.Lock()
        self._groups: "collections.OrderedDict[Tuple[str, ...], _Group]" = collections.OrderedDict()

    def _unpack(self) -> None:
        held = self.prepared.files
        root = os.path.commonpath([*(os.path.dirname(path) for path in held), *(os.path.abspath(f or os.curdir) for f in self.folders.values())])
        made = tempfile.mkdtemp(prefix="tactus-study-")
        atexit.register(shutil.rmtree, made, ignore_errors=True)
        for path, data in held.items():
            target = os.path.join(made, os.path.relpath(path, root))
            os.makedirs(os.path.dirname(target), exist_ok=True)
            with open(target, "wb") as file:
                file.write(data)
        self.folders = {name: os.path.normpath(os.path.join(made, os.path.relpath(os.path.abspath(f or os.curdir), root))) for name, f in self.folders.items()}
        self.hidden += [*self.folders.values(), made]

    def _load(self) -> Dict[str, Any]:
        if not self.prepared.source:
            return {}
        module = types.ModuleType("tactus_study_functions")
        exec(compile(self.prepared.source, "functions.py", "exec"), module.__dict__)
        for m in self.study.measures:
            if m.kind == "function" and not callable(module.__dict__.get(m.function)):
                fail("study/no_function", f"/measures/{m.name}", f"the file has no function '{m.function}'", "write the name of a function of the file")
        return module.__dict__

    def render(self, points: Sequence[Point]) -> Chunk:
        """The results of some points, in their order."""
        n = len(points)
        made = Chunk(np.full((n, len(self.study.columns)), np.nan), np.zeros(n), traces=[np.zeros((0, 0))] * n if self.study.keep else [],
                     host=socket.gethostname(), process=os.getpid(), stamp=stamp())
        groups: Dict[Tuple[str, ...], List[int]] = {}
        for i, point in enumerate(points):
            groups.setdefault(tuple(point[k] for k in self.prepared.slow), []).append(i)
        for slow, members in groups.items():
            try:
                group = self._group(slow)
            except Error as why:
                made.problems += [self._problem(i, why.id, why.where, why.text) for i in members]
                continue
            step = AT_ONCE if self.keeps else len(members)
            for at in range(0, len(members), step):
                self._some(group, points, members[at:at + step], made)
        made.problems.sort()
        return made

    def _problem(self, i: int, name: str, where: str, text: str) -> Problem:
        for folder in sorted(filter(None, self.hidden), key=len, reverse=True):   # so that the text is the same on each worker
            text, where = text.replace(folder + os.sep, ""), where.replace(folder + os.sep, "")
        return i, name, where, text

    def _group(self, slow: Tuple[str, ...]) -> _Group:
        with self._lock:   # an executor of threads shares the worker
            if slow not in self._groups:
                self._groups[slow] = self._made(slow)
            self._groups.move_to_end(slow)
            if len(self._groups) > 4:
                self._groups.popitem(last=False)
            return self._groups[slow]

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
                if isinstance(value, bool) or not isinstance(value, (int, float)) or not value > 0.0:
                    fail("run/rate", "rate", f"{value} is not a rate", "give rates in Hz")
                rate = float(value)
            else:
                recording = self._recording(value)
        feed = {"t": recording["t"]} if "t" in recording else {}
        for port, column in self.study.feed.items() if recording else ():
            feed[port] = recording[column] if isinstance(column, str) else np.full(len(next(iter(recording.values()))), float(column))
        return _Group(graph, {role: json.dumps(d) for role, d in devices.items()}, rate, recording, table_of(feed) if feed else None)

    def _describe(self, devices: Dict[str, Dict[str, Any]], name: str, value: Any) -> None:
        role, _, key = name.partition("/")
        if not key:
            devices[role] = simulated(role, value, f"device:{role}")
            return
        base = devices.get(role) or self.prepared.described.get(role)
        if base is None or base.get("driver") not in ("sim", "gesture", "trace"):
            fail("study/device", f"device:{name}", f"the role '{role}' has no simulated device that could be changed", "describe it in `devices`")
        changed = json.loads(json.dumps(base))
        inside = changed
        *path, last = key.split("/")
        for each in path:
            inside = inside.setdefault(each, {})
            if not isinstance(inside, dict):
                fail("study/device", f"device:{name}", f"'{each}' is not an object", "name a key of the description, such as hand/stiffness")
        inside[last] = value
        devices[role] = changed

    def _recording(self, name: str) -> Dict[str, Array]:
        path = os.path.join(self.study.folder, name)
        if digest_of(path) != self.prepared.recordings.get(name):
            fail("study/recording", name, "the recording has changed since the study began", "restore it, or begin the study in another folder")
        try:
            with open(path, encoding="utf-8-sig", newline="") as file:
                header = [column.strip() for column in next(csv.reader(file))]
                rows = np.loadtxt(file, delimiter=",", ndmin=2)
        except (OSError, ValueError, StopIteration) as why:
            fail("study/recording", name, f"the recording cannot be read: {str(why) or 'it is empty'}", "give a CSV file with a header and numbers")
        if rows.shape[0] == 0 or rows.shape[1] != len(header):
            fail("study/recording", name, f"the header names {len(header)} columns, and there are {rows.shape[1]} in {rows.shape[0]} rows", "correct the file")
        for column in self.study.feed.values():
            if isinstance(column, str) and column not in header:
                fail("study/recording", name, f"the recording has no column '{column}'", f"its columns: {', '.join(header)}")
        return {column: rows[:, i] for i, column in enumerate(header)}

    def _call(self, group: _Group, points: Sequence[Point], gauges: List[_measures.Measure], keeps: bool, places: int) -> Dict[str, Any]:
        return _tactus.render_points(
            group.graph._graph, group.rate, self.prepared.records, self.common, [self.prepared.names[k] for k in self.prepared.fast],
            [[point[k] for k in self.prepared.fast] for point in points], group.devices, self.folders["study"], group.feed, self.assets, self.study.duration,
            [_measures.gauge(m, group.recording) for m in gauges], keeps, places)

    def one(self, point: Point) -> Tuple[Graph, Dict[str, str], Records]:
        """One point to look at: the graph with its settings, the devices as JSON, and the records of its ports and sinks."""
        group = self._group(tuple(point[k] for k in self.prepared.slow))
        done = self._call(group, [point], [], True, 0)
        for _, name, where, text in done["errors"]:
            fail(name, where, text, "this point of the study has an error; correct the study, or leave it as it is")
        return group.graph, group.devices, Layout(done["columns"], done["units"], self.prepared.records, done["rate"]).records(done["rows"][0])

    def _some(self, group: _Group, points: Sequence[Point], members: List[int], made: Chunk) -> None:
        """Renders points of one group."""
        try:
            done = self._call(group, [points[i] for i in members], self.gauges, self.keeps, self.places)
        except Error as why:
            made.problems += [self._problem(i, why.id, why.where, why.text) for i in members]
            return
        made.seconds[members] = done["seconds"]
        made.warnings.update(done["warnings"])
        failed = set()
        for k, name, where, text in done["errors"]:
            if name in NOT_OF_A_POINT:
                raise MemoryError(text)
            failed.add(k)
            made.problems.append(self._problem(members[k], name, where, text))
        from_run, column = 0, 0
        for m in self.study.measures:
            at = slice(column, column := column + len(m.columns))
            if m.kind == "stable":
                made.numbers[members, at] = done["numbers"][:, len(self.gauges):]
            elif not m.needs_records:
                made.numbers[members, at.start] = done["numbers"][:, from_run]
                from_run += 1
        for k, i in enumerate(members if self.keeps else ()):
            if k not in failed and (problem := self._afterwards(points[i], done["rows"][k], done, made, i)):
                made.problems.append(self._problem(i, *problem))
                made.numbers[i] = np.nan

    def _afterwards(self, point: Point, rows: Array, done: Dict[str, Any], made: Chunk, i: int) -> Optional[Tuple[str, str, str]]:
        """Fills in what is computed from the records of a point; or says what is wrong: id, place and text."""
        records, column = Layout(done["columns"], done["units"], self.prepared.records, done["rate"]).records(rows), 0
        try:
            for m in self.study.measures:
                if m.needs_records:
                    values = values_of(self.prepared.names, point)
                    made.numbers[i, column:column + len(m.columns)] = _measures.afterwards(m, records, values, self.functions)
                column += len(m.columns)
        except Error as why:
            return why.id, why.where, why.text
        except (MemoryError, KeyboardInterrupt):
            raise
        except Exception as why:   # of a function of the user
            frame = traceback.extract_tb(why.__traceback__)[-1]
            return "study/function", f"{os.path.basename(frame.filename)}:{frame.lineno}", f"{type(why).__name__}: {why}"
        if self.study.keep:
            width = 0
            for port in self.study.keep:
                width += 1 if done["columns"][width] == port else 3
            made.kept = done["columns"][:width]
            made.traces[i] = np.ascontiguousarray(rows[:, :width])
        return None


_known: Dict[bytes, Worker] = {}


def work(context: bytes, pickled: Optional[bytes], points: Sequence[Point]) -> Optional[Chunk]:
    """The results of some points, on any worker. None: this worker does not have the study yet, so send it."""
    worker = _known.get(context)
    if worker is None:
        if pickled is None:
            return None
        worker = Worker(pickle.loads(pickled), is_far=True)
        _known.clear()   # one study at a time, so that memory stays flat
        _known[context] = worker
    return worker.render(points)
