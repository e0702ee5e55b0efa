# SPDX-License-Identifier: MIT
"""Studies: renders of one graph at the points of a design, and what is kept of each."""

from __future__ import annotations

import hashlib
import json
import os
import pathlib
import pickle
from dataclasses import dataclass, field
from typing import Any, Callable, Dict, List, Literal, Mapping, Optional, Sequence, Tuple, Union

import numpy as np

from .. import _tactus
from .._assets import Assets, reader
from .._graph import Graph
from .._library import live
from .._messages import fail
from .._presets import graph_file
from . import _design, _points, _schema
from ._design import Design, Factor, FromTable, Grid, Latin, Sobol
from ._drive import drive
from ._points import Measure, digest_of, simulated
from ._procedures import note
from ._results import Path, Results, merge

Functions = Mapping[str, Callable[..., Any]]


@dataclass(frozen=True)
class Map:
    """A heat map of the report: a measure over two factors."""

    of: str = field(metadata=note("the column of a measure"))
    x: str = field(metadata=note("a factor"))
    y: str = field(metadata=note("another factor"))
    limits: bool = field(default=False, metadata=note("draw the limits that `tactus limits` computes"))


@dataclass(frozen=True)
class Study:
    """A study: a graph, the factors that vary, and what to keep of each render."""

    name: str = field(metadata=note("its name, letters and digits"))
    graph: str = field(metadata=note("a graph file relative to this one, or the name of a preset"))
    factors: List[Factor] = field(metadata=note("what varies", fewest=1))
    measures: List[Measure] = field(default_factory=list, metadata=note("the numbers to keep"))
    format: Literal["tactus-study"] = field(default="tactus-study", metadata=note("the format of the file"))
    version: Literal[1] = field(default=1, metadata=note("the version of the format"))
    about: str = field(default="", metadata=note("what it is about, and its sources"))
    design: Union[Grid, Latin, Sobol, FromTable] = field(default_factory=Grid, metadata=note("which points of the ranges are rendered"))
    duration: float = field(default=0.0, metadata=note("of each render, in s; 0: as long as the recording or the path of the hand", low=0.0, high=1e9))
    rate: float = field(default=0.0, metadata=note("in Hz; 0: that of the recording or of the graph", low=0.0, high=1e9))
    set: Dict[str, Any] = field(default_factory=dict, metadata=note("values of parameters and controls that all points share"))
    devices: Dict[str, Any] = field(default_factory=dict, metadata=note("simulated devices of roles: gesture:NAME, trace:FILE.csv, or a description"))
    feed: Dict[str, Any] = field(default_factory=dict, metadata=note("what drives ports while a recording runs: a column of it, or a number, as in "
                                                                     "{\"drag.position.x\": \"x\", \"drag.normal_force\": 1}"))
    keep: List[str] = field(default_factory=list, metadata=note("ports whose records are kept, tick by tick"))
    maps: List[Map] = field(default_factory=list, metadata=note("the heat maps of the report; without any, one of each measure over the first two factors"))
    worst: str = field(default="", metadata=note("the column whose largest values the report lists; -NAME: the smallest; without it, the last measure"))
    folder: str = field(default="", compare=False, repr=False, metadata=note("of files with relative paths; the file's own, if it is left out"))

    @staticmethod
    def load(path: Path) -> "Study":
        """Reads and checks a file. Errors name the place in it as a JSON pointer."""
        return _schema.load(Study, path)

    def text(self) -> str:
        """The study as the text of a file."""
        return _schema.text(self)

    @property
    def columns(self) -> List[str]:
        """The columns of the measures."""
        return [name for measure in self.measures for name in measure.columns]

    @property
    def units(self) -> Dict[str, str]:
        """The units of the columns that have one."""
        return {**{factor.vary: factor.unit for factor in self.factors}, **{measure.columns[0]: measure.unit for measure in self.measures}}

    def prepare(self, functions: Optional[Functions] = None, graph: Optional[Graph] = None, assets: Optional[Assets] = None) -> "Prepared":
        """The study with its graph and files, ready for workers. `run` says what the arguments are."""
        return Prepared(self, functions or {}, graph, assets)

    def run(self, out: Path, executor: Any = None, workers: int = 1, functions: Optional[Functions] = None, graph: Optional[Graph] = None,
            assets: Optional[Assets] = None, resume: bool = False, mixed: bool = False) -> Results:
        """Renders all points, and merges their results in the folder `out`.

        executor: None: this process. Or any executor of concurrent.futures, that of dask.distributed, or that of mpi4py.futures.
        workers: how many processes the executor has; so many chunks are on their way, twice.
        functions: the functions in Python that measures name. They get the Records and a dict with the values of the point.
        graph: instead of the one that the study names. assets: as for Graph.render; for workers, a dict.
        resume: go on in a folder that has results. mixed: also with those of other versions of Tactus or other computers; they are marked."""
        prepared = self.prepare(functions, graph, assets)
        drive(prepared, out, (lambda: executor) if executor is not None else None, workers, resume=resume, mixed=mixed)
        return merge(prepared, out, mixed)


def schema() -> Dict[str, Any]:
    """The JSON schema of study files, made from the dataclasses."""
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", "title": "Study of tactus.lab", **_schema.schema(Study)}


class Prepared:
    """A study with everything that a worker needs. It is pickled once, and sent once to each worker."""

    def __init__(self, study: Study, functions: Functions, graph: Optional[Graph], assets: Optional[Assets]):
        self.study, self.functions = study, functions
        if not study.name.isalnum() or not study.name.isascii():
            fail("study/value", "/name", f"'{study.name}' has other characters than letters and digits", "choose a name for files, such as 'wall'")
        _points.checked(study.measures)
        beside = os.path.join(study.folder, study.graph)
        self.file = "" if graph is not None else beside if os.path.isfile(beside) else graph_file(study.graph)
        self.graph = graph if graph is not None else Graph(self.file)
        self.assets = assets if assets is None or callable(assets) else dict(assets)
        self.design: Design = _design.make(study.design, study.factors, study.folder)
        self.names = self.design.names
        self.fast = [i for i, name in enumerate(self.names) if ":" not in name and name not in ("rate", "recording", "seed")]   # set between renders
        self.slow = [i for i, name in enumerate(self.names) if i not in self.fast and name != "seed"]
        self.records = list(dict.fromkeys([*study.keep, *(port for m in study.measures if m.kind not in ("stable", "function")
                                                          for port in (m.port, m.position) if port)]))
        self.described: Dict[str, Any] = json.loads(self.graph.text).get("devices", {})
        self.devices = {role: simulated(role, given, f"/devices/{role}") for role, given in study.devices.items()}
        self._check_names()
        self.files = self._files()
        # Recordings are not sent: workers read them, and compare their hashes.
        self.recordings = {name: digest_of(os.path.join(study.folder, name)) for name in self.design.values("recording")}
        self.context = self._context()

    def _check_names(self) -> None:
        """Refuses names that no point could use."""
        study, names = self.study, self.names
        if any(measure.kind == "misfit" for measure in study.measures) and (study.rate or "rate" in names):
            fail("study/value", "/rate", "a misfit compares tick by tick, so the rate is that of the recording", "leave `rate` out")
        if "recording" in names and not study.feed:
            fail("study/missing", "/feed", "recordings drive no port", "add `feed`: {\"drag.position.x\": \"x\"}")
        if any(measure.kind == "stable" for measure in study.measures):
            live()   # the library that judges; an error at once, if it is missing
        for measure in study.measures:
            if measure.kind == "function" and not callable(self.functions.get(measure.function)):
                fail("study/no_function", f"/measures/{measure.name}", f"there is no function '{measure.function}'",
                     "give the file with it: --functions FILE.py; a study does not choose code that runs here")
        for i, name in enumerate(names):
            kind, _, rest = name.partition(":")
            if kind == "setting" and "." not in rest or kind not in ("setting", "device") and ":" in name or kind == "device" and not rest:
                fail("study/value", f"/factors/{i}/vary", f"'{name}' is not a factor", "write NODE.PARAM, a control, setting:NODE.SETTING or device:ROLE/KEY")
        used = [("/worst", study.worst.lstrip("-"), ["", *study.columns])]
        for i, each in enumerate(study.maps):
            used += [(f"/maps/{i}/of", each.of, study.columns), (f"/maps/{i}/x", each.x, names), (f"/maps/{i}/y", each.y, names)]
        for where, name, known in used:
            if name not in known:
                fail("study/value", where, f"there is no column '{name}'", f"one of {', '.join(known)}")

    def _files(self) -> Dict[str, bytes]:
        """The files that the graph reads, and those that factors and devices name, by absolute path."""
        asked: List[str] = []
        given = reader(self.assets)

        def find(kind: str, path: str) -> Optional[Dict[str, Any]]:
            supplied = given(kind, path) if given else None
            if supplied is None:
                asked.append(path)
            return supplied

        first = self.design.at(0)
        common = {name: _design.text_of(value) for name, value in self.study.set.items()}
        for fast in (self.fast, self.fast[:0]):   # with nothing, the graph reads all its files even if the point has errors
            names, records = [self.names[i] for i in fast], [*self.records, *self.study.feed] if fast else []
            tried = _tactus.Points(self.graph._graph, 0.0, records, common, names, None, find, 1e-9)
            rows, errors, _ = tried.render([[first[i] for i in fast]])
            for _, name, where, text in errors:
                if "unknown" in name and fast:   # at each point; other errors may be those of single points
                    fail(name, where, text, "correct the name in the study")
            for m in self.study.measures if fast and not errors else ():
                if m.kind != "misfit":   # it needs a recording
                    _points.KINDS.get(m.kind, lambda *_: None)(m, _points.Block(rows, tried.columns, tried.rate, {}))
        named = [value for name in self.names if name != "recording" for value in self.design.values(name)]
        for value in [*named, *self.devices.values(), *self.described.values()]:
            hand = value.get("hand") if isinstance(value, dict) else None
            for text in (value, *(each.get("path") for each in (value, hand) if isinstance(each, dict))):
                if isinstance(text, str) and text:
                    asked += [os.path.join(folder, text) for folder in (self.graph._graph.folder(), self.study.folder)]
        return {os.path.abspath(path): pathlib.Path(path).read_bytes() for path in asked if os.path.isfile(path)}

    def _context(self) -> bytes:
        """The hash of everything that the results of a point depend on, except its values, the version and the computer."""
        s = self.study
        code = [getattr(self.functions, "text", ""), *(_code_of(self.functions[m.function]) for m in s.measures if m.kind == "function")]
        base = os.path.dirname(self.file)
        files = {os.path.relpath(path, base or os.curdir) if not self.file or os.path.isabs(path) else path: hashlib.sha256(data).hexdigest()
                 for path, data in self.files.items()}
        held = pickle.dumps(self.assets, 4) if self.assets is not None and not callable(self.assets) else b""
        subgraphs = {path: Graph._of(file).text for path, file in self.graph._graph.files().items()}
        parts = ["tactus-study 1", self.graph.text, subgraphs, files, s.set, self.devices, s.duration, s.rate, s.feed, s.keep, self.names,
                 [{k: v for k, v in _schema.write(m).items() if k != "unit"} for m in s.measures], code, hashlib.sha256(held).hexdigest()]
        return hashlib.blake2b(_design.text_of(parts).encode(), digest_size=16).digest()

    def values(self, point: _design.Point, factors: Optional[Sequence[int]] = None) -> Dict[str, Any]:
        """The values of a point, of all factors or some."""
        return {self.names[k]: json.loads(point[k]) for k in (range(len(point)) if factors is None else factors)}

    def key(self, point: _design.Point) -> bytes:
        """The address of the result of a point, 16 bytes."""
        if self.recordings:
            point = *point, self.recordings[json.loads(point[self.names.index("recording")])]
        return hashlib.blake2b("\x1f".join(point).encode(), digest_size=16, key=self.context).digest()

    def keys(self, points: Sequence[_design.Point]) -> Any:
        """The addresses of the results of some points, shape (n,)."""
        return np.array([self.key(point) for point in points], "S16")

    def __getstate__(self) -> Dict[str, Any]:
        return {key: value for key, value in self.__dict__.items() if key != "design"}   # a worker gets points


class Source(Dict[str, Any]):
    """The functions of a Python file. A worker gets its text."""

    def __init__(self, text: str):
        super().__init__()
        self.text = text
        exec(compile(text, "functions.py", "exec"), self)

    def __reduce__(self) -> Tuple[Any, ...]:
        return Source, (self.text,)


def _code_of(function: Any) -> str:
    code, name = getattr(function, "__code__", None), f"{getattr(function, '__module__', '')}.{getattr(function, '__qualname__', '')}"
    return f"{name} {code.co_code.hex()} {[c for c in code.co_consts if not hasattr(c, 'co_code')]}" if code else name
