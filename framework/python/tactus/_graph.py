# SPDX-License-Identifier: MIT
"""Graphs: load, edit, save, render."""

from __future__ import annotations

import contextlib
import json
import math
from typing import TYPE_CHECKING, Any, Dict, Iterator, Mapping, Optional, Sequence, Tuple, Type

from . import _checks, _drawing, _tactus
from ._assets import Assets
from ._checks import Path
from ._messages import fail, placed
from ._own import Node
from ._plugins import need, plugins_of
from ._presets import graph_file
from ._records import Records, to_json, to_optional_json
from ._views import ControlView, NodeView, View, Wires, controls_in, nodes_in, wires_in

if TYPE_CHECKING:
    from ._engine import Engine

_MOST_TICKS = 10**10


class Graph:
    """A graph with its undo history.

    Graph(path) reads a file, Graph("dry_wood") a preset, Graph.parse(text) reads text, and Graph() makes an empty graph. Each edit is checked, is one undo step, and
    changes nothing if it fails. Values are written as in a graph file: 0.4 (SI), "20 um", [0, 0, 1]. `patch` is the name of a subgraph, or
    "" for the graph itself. Several threads may use one graph; their calls never overlap."""

    @_checks.arguments
    def __init__(self, path: Optional[Path] = None, *, name: str = "", rate: float = 4000.0):
        """path: a graph file, or the name of a preset (tactus.presets()); without it, the graph is empty, has this name, and is ticked at `rate` in
        Hz."""
        if path is None:
            hz = _checks.number("rate", rate, "give a rate in Hz, such as 4000")
            self._graph = _tactus.Graph.create(_checks.text("name", name, "give a name as text"), hz)
        else:
            file = graph_file(path)
            with placed(file):
                self._graph = _tactus.Graph.load(file)

    @classmethod
    def _of(cls, graph: "_tactus.Graph") -> "Graph":
        made = cls.__new__(cls)
        made._graph = graph
        return made

    @classmethod
    def parse(cls, text: str, folder: Path = "") -> "Graph":
        """Reads the text of a graph file. Files that it names are relative to `folder`; subgraphs in separate files are not read."""
        if not isinstance(text, str):
            _checks.refuse("text", text, "text", "give the text of a graph file; tactus.Graph(path) reads a file")
        return cls._of(_tactus.Graph.parse(text, _checks.path("folder", folder)))

    def __reduce__(self) -> Tuple[Any, ...]:
        files = {path: Graph._of(file) for path, file in self._graph.files().items()}
        return _restored, (self.text, self._graph.folder(), files, plugins_of([self.text]))

    def __repr__(self) -> str:
        return f"<tactus.Graph {self.name[:60]!r}: {len(self.nodes)} nodes, {len(self.wires)} wires, {self.rate:g} Hz>"

    def _repr_svg_(self) -> str:
        """A picture of the nodes and wires, for notebooks."""
        graph = self._read()
        return _drawing.svg(nodes_in(graph), wires_in(graph))

    def _repr_html_(self) -> str:
        """The picture with the name above it, for notebooks."""
        graph = self._read()
        return _drawing.html(self.name, self.rate, nodes_in(graph), wires_in(graph))

    def _read(self) -> Dict[str, Any]:
        read: Dict[str, Any] = json.loads(self.text)
        return read

    @property
    def nodes(self) -> View[NodeView]:
        """The nodes by name, to look at: graph.nodes["drag"].params["mu"]. Those of subgraphs are not included."""
        return nodes_in(self._read())

    @property
    def wires(self) -> Wires:
        """The wires, to look at. Those of subgraphs are not included."""
        return wires_in(self._read())

    @property
    def controls(self) -> View[ControlView]:
        """The controls by id, to look at."""
        return controls_in(self._read())

    @property
    def name(self) -> str:
        """The name of the graph."""
        return self._graph.name()

    @property
    def rate(self) -> float:
        """The tick rate in Hz."""
        return self._graph.rate()

    @property
    def text(self) -> str:
        """The graph as the text of a graph file."""
        return self._graph.text()

    @_checks.arguments
    def save(self, path: Path) -> None:
        """Writes the graph file. After a crash, either the old file or the new one exists."""
        self._graph.save(_checks.path("path", path))

    @_checks.arguments
    def add_node(self, name: str, type: str, params: Optional[Mapping[str, Any]] = None, settings: Optional[Mapping[str, Any]] = None,
                 role: str = "", patch: str = "") -> None:
        """Adds a node. type: an id of tactus.nodes(), "graph:NAME", or the id of a node in Python. role: for device nodes."""
        values = to_json(dict(_checks.mapping("params", params, "{'mu': 0.4}")), "params")
        shape = to_json(dict(_checks.mapping("settings", settings, "{'seed': 3}")), "settings")
        known = _checks.text("type", type, "give the id of a node type, as in tactus.nodes()")
        self._graph.add_node(_patch(patch), _name("name", name), known, values, shape, _checks.text("role", role, "give the name of a role, such as 'stylus'"))

    @_checks.arguments
    def remove_node(self, name: str, patch: str = "") -> None:
        """Removes a node, and everything that refers to it."""
        self._graph.remove_node(_patch(patch), _name("name", name))

    @_checks.arguments
    def rename_node(self, name: str, to: str, patch: str = "") -> None:
        """Renames a node, and everything that refers to it."""
        self._graph.rename_node(_patch(patch), _name("name", name), _name("to", to))

    @_checks.arguments
    def connect(self, start: str, end: Optional[str] = None, gain: Any = None, delay: int = 0, add: bool = False, patch: str = "") -> None:
        """Adds a wire: connect("drag.force", "motor.force"), or as in a graph file connect("drag.force -> motor.force").

        gain: a number, or text with a unit. delay: in ticks. add: the wire adds to the value of a parameter instead of replacing it."""
        self._graph.add_wire(_patch(patch), _wire(start, end, delay, add), to_optional_json(gain, "gain"))

    @_checks.arguments
    def disconnect(self, start: str, end: Optional[str] = None, delay: int = 0, add: bool = False, patch: str = "") -> None:
        """Removes a wire that was added with the same arguments."""
        self._graph.remove_wire(_patch(patch), _wire(start, end, delay, add))

    @_checks.arguments
    def set_param(self, node: str, param: str, value: Any, patch: str = "") -> None:
        """Sets a parameter; None means its default."""
        self._graph.set_param(_patch(patch), _name("node", node), _name("param", param), to_optional_json(value, f"{node}.{param}"))

    @_checks.arguments
    def set_setting(self, node: str, setting: str, value: Any, patch: str = "") -> None:
        """Sets a setting; None means its default."""
        self._graph.set_setting(_patch(patch), _name("node", node), _name("setting", setting), to_optional_json(value, f"{node}.{setting}"))

    @_checks.arguments
    def set_key(self, node: str, key: str, value: Any, patch: str = "") -> None:
        """Sets any other key of a node, such as "role" or "count"; None removes it."""
        self._graph.set_key(_patch(patch), _name("node", node), _name("key", key), to_optional_json(value, f"{node}.{key}"))

    @_checks.arguments
    def set_device(self, role: str, description: Optional[Mapping[str, Any]]) -> None:
        """Describes the device of a role, as in a graph file: {"driver": "sim", "mass": "50 g"}; None removes it."""
        known = None if description is None else dict(_checks.mapping("description", description, "{'driver': 'sim', 'mass': '50 g'}"))
        self._graph.set_device(_name("role", role), to_optional_json(known, "description"))

    @_checks.arguments
    @contextlib.contextmanager
    def edit(self, name: str = "edits") -> Iterator[Graph]:
        """Edits in a batch, which takes much less time than single edits: with graph.edit(): …

        The edits are one undo step, named `name`. Only their result is checked, so an edit may leave an error that a later one removes. If an edit
        fails, if the result has an error that the batch has added, or if another exception leaves the `with` statement, the graph is as it was
        before. An edit that has failed fails the batch, even if its exception is caught. Edits of other threads meanwhile join the batch."""
        self._graph.begin_batch(_checks.text("name", name, "give a name for the undo step"))
        try:
            yield self
        except BaseException:
            self._graph.abandon_batch()
            raise
        self._graph.finish_batch()

    def undo(self) -> bool:
        """False if there is nothing to undo."""
        return self._graph.undo()

    def redo(self) -> bool:
        """False if there is nothing to redo."""
        return self._graph.redo()

    @_checks.arguments
    def render(self, feed: Optional[Mapping[str, Any]] = None, record: Sequence[str] = (), rate: Optional[float] = None,
               duration: Optional[float] = None, set: Optional[Mapping[str, Any]] = None, devices: Optional[Mapping[str, Any]] = None,
               nodes: Sequence[Type[Node]] = (), assets: Optional[Assets] = None) -> Records:
        """Runs the graph offline, as `tactus render` does, with the same bits.

        feed: arrays by port, shape (n,) for a scalar and (n, 3) for a vector, in SI units; a single number holds for all ticks. "t", shape
            (n,), in s, is optional: without `rate`, the rate is 1/median dt, and with `rate`, rows are held to the tick grid.
        record: ports; without any, the inputs of all sinks.
        rate: in Hz; without it, that of the feed or of the graph.
        duration: in s; without it, the run ends with the feed, or with a trace or gesture of a device.
        set: values of parameters, by name: {"drag.mu": 0.3, "drag.d_max": "20 um"}.
        devices: by role, as for tactus.Engine.
        nodes: classes derived from tactus.Node that the graph uses.
        assets: what you supply instead of files that settings name, such as pictures, as for tactus.Engine.

        Returns a dict of arrays with one row per tick: "t" (n,), scalars (n,), vectors (n, 3). A port inside a `times` section gives the
        last sample of each tick. Ctrl-C ends the run. Other threads can run at the same time."""
        from ._engine import Engine

        seconds = None if duration is None else _checks.duration(duration)
        with Engine._offline(self, feed, record, rate, set, devices, nodes, assets) as engine:
            return engine.step(n=_ticks(engine, seconds, feed is not None))


def _restored(text: str, folder: str, files: Dict[str, Graph], plugins: Sequence[str] = ()) -> Graph:
    need(plugins)
    graph = Graph.parse(text, folder)
    return Graph._of(_tactus.Graph.with_files(graph._graph, {path: file._graph for path, file in files.items()})) if files else graph


def checked_graph(graph: Any) -> Graph:
    if not isinstance(graph, Graph):
        _checks.refuse("graph", graph, "a graph", "give a tactus.Graph; tactus.Graph(path) reads a file")
    return graph


def _name(argument: str, name: Any) -> str:
    return _checks.text(argument, name, "give a name, such as 'drag'")


def _patch(patch: Any) -> str:
    return _checks.text("patch", patch, "give the name of a subgraph, or '' for the graph itself")


def _wire(start: Any, end: Any, delay: Any, add: Any) -> str:
    example = "name two ports, 'drag.force' and 'motor.force', or write a wire: 'drag.force -> motor.force'"
    if end is None:
        return _checks.text("start", start, example)
    ticks = _checks.whole("delay", delay, "give a number of ticks; 0 for none")
    adds = "(+) " if _checks.truth("add", add) else ""
    return f"{_checks.text('start', start, example)} -> {f'[{ticks}] -> ' if ticks else ''}{adds}{_checks.text('end', end, example)}"


def _ticks(engine: "Engine", duration: Optional[float], is_fed: bool) -> int:
    """The length of a render, by the rules of `tactus render`."""
    by_feed = engine._run.feed_ticks()
    seconds = duration if duration is not None else engine._run.duration()
    if is_fed and duration is None:
        return by_feed
    if not seconds > 0.0:
        fail("run/no_length", "", "the length of the run is unknown: there is no feed, trace or gesture",
             "give duration in s, a feed, or devices={'ROLE': 'gesture:NAME'}")
    wanted = math.ceil(seconds * engine.rate - 1e-6) if seconds * engine.rate <= _MOST_TICKS else _MOST_TICKS + 1
    if wanted > _MOST_TICKS:
        fail("run/too_long", "", "a run of more than 10^10 ticks would take too long", "give a shorter duration or a lower rate")
    return min(by_feed, wanted) if is_fed else wanted
