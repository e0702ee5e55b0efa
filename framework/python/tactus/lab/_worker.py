# SPDX-License-Identifier: MIT
"""Renders chunks of points. A worker gets the study once; then it is only told its hash."""

from __future__ import annotations

import atexit
import copy
import functools
import json
import os
import pathlib
import pickle
import shutil
import socket
import tempfile
import threading
import time
import traceback
import types
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
from ._results import Chunk, Stamp, row_type
from ._study import Prepared, bits, digest_of, simulated

ROOM = 2**18   # numbers of records that are held at the same time, if more than one point has them


class _Group(NamedTuple):
    """Points that differ in parameters and controls only."""

    graph: Graph   # with the settings and devices of the points
    recording: Dict[str, Array]
    run: "_tactus.Points"


@functools.lru_cache(maxsize=None)
def stamp() -> Stamp:
    """The version of Tactus, and the mark of this computer."""
    return _tactus.version(), bits()


class Worker:
    """A study in one thread."""

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
        rows = np.zeros(len(points), row_type(len(self.study.columns)))
        rows["key"], rows["numbers"] = self.prepared.keys(points), np.nan
        made, traces = Chunk(rows, stamp(), f"{socket.gethostname()} {os.getpid()}"), {}
        groups: Dict[Tuple[str, ...], List[int]] = {}
        for i, point in enumerate(points):
            groups.setdefault(tuple([point[k] for k in self.prepared.slow]), []).append(i)
        for slow, members in groups.items():
            try:
                group = self._group(slow)
                while members:
                    some = members[:max(1, ROOM // max(1, group.run.ticks * len(group.run.columns)) if group.run.ticks else 1)]
                    traces.update(self._some(group, points, some, made))
                    members = members[len(some):]
            except Error as why:
                made.problems.update({i: self._problem(why.id, why.where, why.text) for i in members})
        rows["numbers"][list(made.problems)] = np.nan
        if traces:
            made.traces = np.concatenate([traces[i] for i in sorted(traces)])
            rows["ticks"][list(traces)] = [len(each) for each in traces.values()]
        return made

    def _problem(self, name: str, where: str, text: str) -> Tuple[str, str, str]:
        for folder in sorted(filter(None, self.hidden), key=len, reverse=True):   # so that the text is the same on each worker
            text, where = text.replace(folder + os.sep, ""), where.replace(folder + os.sep, "")
        return name, where, text

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

    def _values(self, point: Point) -> List[str]:
        return [point[k] for k in self.prepared.fast]

    def one(self, point: Point) -> Tuple[Graph, Records]:
        """One point to look at: the graph with its settings and devices, and the records of its ports and sinks."""
        group = self._group(tuple([point[k] for k in self.prepared.slow]))
        rows, errors, _ = group.run.render([self._values(point)])
        for _, name, where, text in errors:
            fail(name, where, text, "this point of the study has an error; correct the study, or leave it as it is")
        return group.graph, self._records(group, rows[0])

    def _records(self, group: _Group, rows: Array) -> Records:
        return Layout(group.run.columns, group.run.units, self.prepared.records, group.run.rate).records(rows)

    def _some(self, group: _Group, points: Sequence[Point], members: List[int], made: Chunk) -> Dict[int, Array]:
        """Renders points of one group. Returns their traces."""
        begin = time.perf_counter()
        rows, errors, warnings = group.run.render([self._values(points[i]) for i in members])
        made.warnings.update(warnings)
        for k, name, where, text in errors:
            if name == "api/no_memory":   # another try may not have it
                raise MemoryError(text)
            made.problems[members[k]] = self._problem(name, where, text)
        good = [(k, i) for k, i in enumerate(members) if i not in made.problems]
        block, at = _measures.Block(rows, group.run.columns, group.run.rate, group.recording), 0
        numbers = np.full((len(members), len(self.study.columns)), np.nan)
        for m in self.study.measures if good else ():
            if m.kind in _measures.KINDS:
                with np.errstate(all="ignore"):
                    numbers[:, at] = _measures.KINDS[m.kind](m, block)
            else:
                for k, i in good:
                    numbers[k, at:at + len(m.columns)] = self._of_point(m, group, points[i], rows[k], made, i)
            at += len(m.columns)
        made.rows["numbers"][members] = numbers
        kept = [c for c, name in enumerate(group.run.columns) if name in self.study.keep or name[:-2] in self.study.keep] if self.study.keep and good else []
        made.kept = [group.run.columns[c] for c in kept] or made.kept
        made.rows["seconds"][members] = (time.perf_counter() - begin) / len(members)
        return {i: rows[k][:, kept] for k, i in good if kept and i not in made.problems}

    def _of_point(self, m: _measures.Measure, group: _Group, point: Point, rows: Array, made: Chunk, i: int) -> Sequence[float]:
        """The numbers of a measure that is not computed for many points at once."""
        try:
            if m.kind == "function":
                return _measures.returned(m, self._records(group, rows), values_of(self.prepared.names, point), self.functions)
            values = values_of([self.prepared.names[k] for k in self.prepared.fast], tuple(self._values(point)))
            return _measures.stable(group.graph, {**self.study.set, **values}, group.run.rate, self.study.duration)
        except Error as why:
            problem = why.id, why.where, why.text
        except (MemoryError, KeyboardInterrupt):
            raise
        except Exception as why:   # of a function of the user
            frame = traceback.extract_tb(why.__traceback__)[-1]
            problem = "study/function", f"{os.path.basename(frame.filename)}:{frame.lineno}", f"{type(why).__name__}: {why}"
        made.problems.setdefault(i, self._problem(*problem))
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
