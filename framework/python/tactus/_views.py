# SPDX-License-Identifier: MIT
"""What a graph contains, to look at: graph.nodes, graph.wires, graph.controls. Edits go through the functions of the graph."""

from __future__ import annotations

import html
import re
from typing import TYPE_CHECKING, Any, Dict, Iterable, Iterator, List, Mapping, NamedTuple, NoReturn, Optional, Sequence, Tuple, TypeVar

from ._messages import fail

V = TypeVar("V")


class View(Mapping[str, V]):
    """A dict that cannot be changed. `what` says what it holds, and `edit` how to change that."""

    def __init__(self, what: str, values: Mapping[str, V], edit: str):
        self._what, self._values, self._edit = what, dict(values), edit

    def __getitem__(self, name: str) -> V:
        return self._values[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def __repr__(self) -> str:
        return f"<{plain(self._what)}: {shortened(list(self._values)) or 'none'}>"

    if not TYPE_CHECKING:   # type checkers refuse these by themselves

        def __setitem__(self, name: Any, value: Any) -> NoReturn:
            fail("view/read_only", f"[{name!r}]", f"the {self._what} are a view, which cannot be changed", f"edit the graph: {self._edit}")

        def __delitem__(self, name: Any) -> NoReturn:
            self[name] = None


class NodeView(NamedTuple):
    """A node of a graph. params, settings: as written in the graph file: 0.4 (SI), "20 um". What is not written has its default. keys: all other keys,
    such as "count" or "bypass"."""

    name: str
    type: str
    role: str
    params: View[Any]
    settings: View[Any]
    keys: View[Any]

    def __repr__(self) -> str:
        return f"<node {plain(self.name)}: {plain(self.type)}{' of ' + plain(self.role) if self.role else ''}>"


class WireView(NamedTuple):
    """A wire of a graph. start, end: ports. delay: in ticks. gain: as written, or None. adds: adds to a parameter instead of replacing it."""

    start: str
    end: str
    delay: int
    gain: Any
    adds: bool
    is_enabled: bool

    def __str__(self) -> str:
        return f"{self.start} -> {f'[{self.delay}] -> ' if self.delay else ''}{'(+) ' if self.adds else ''}{self.end}"

    def __repr__(self) -> str:
        return f"<wire {plain(self, 100)}{'' if self.gain is None else f', gain {plain(self.gain)}'}{'' if self.is_enabled else ', disabled'}>"


class ControlView(NamedTuple):
    """A control of a graph. value: 0 to 1. to: what it moves: {"drag.mu": [0.2, 0.6]}."""

    id: str
    name: str
    value: float
    to: View[Any]

    def __repr__(self) -> str:
        return f"<control {plain(self.id)}: {self.value:g}, moves {shortened(list(self.to)) or 'nothing'}>"


class Wires(Tuple[WireView, ...]):
    """The wires of a graph, which cannot be changed."""

    def __repr__(self) -> str:
        return f"<wires: {shortened([str(w) for w in self]) or 'none'}>"


def plain(text: Any, most: int = 40) -> str:
    """Text of a file for a repr: short, and without characters that steer a terminal or turn text around."""
    whole = str(text)
    shown = whole if len(whole) <= most else whole[:most - 1] + "…"
    return "".join(c if c.isprintable() else "\ufffd" for c in shown)


def html_text(text: Any) -> str:
    """Text of a file for a notebook, where it never becomes markup."""
    return html.escape(plain(text, 1000))


def html_table(head: Sequence[str], rows: Iterable[Sequence[Any]]) -> str:
    """A table for notebooks."""
    lines = [f"<th>{'</th><th>'.join(map(html_text, head))}</th>", *(f"<td>{'</td><td>'.join(map(html_text, row))}</td>" for row in rows)]
    return f"<table><tr>{'</tr><tr>'.join(lines)}</tr></table>"


def with_unit(value: Optional[float], unit: str) -> str:
    """A number for a person."""
    return "" if value is None else f"{value:.4g}{'' if unit in ('', '1') else ' ' + unit}"


def shortened(names: List[str], most: int = 6) -> str:
    """A list for a repr."""
    some = ", ".join(plain(name) for name in names[:most])
    return some + (f", … ({len(names)} in all)" if len(names) > most else "")


def nodes_in(graph: Mapping[str, Any]) -> View[NodeView]:
    """The nodes of a graph file that was read."""
    def view(name: str, node: Mapping[str, Any]) -> NodeView:
        edit = f"graph.set_%s({name!r}, NAME, VALUE)"
        rest = {key: value for key, value in node.items() if key not in ("type", "role", "params", "settings")}
        return NodeView(name, str(node.get("type", "")), str(node.get("role", "")), View(f"params of {name}", node.get("params", {}), edit % "param"),
                        View(f"settings of {name}", node.get("settings", {}), edit % "setting"), View(f"keys of {name}", rest, edit % "key"))

    return View("nodes", {name: view(name, node) for name, node in graph.get("nodes", {}).items()}, "graph.add_node(NAME, TYPE), graph.remove_node(NAME)")


def wires_in(graph: Mapping[str, Any]) -> Wires:
    return Wires(_wire(wire) for wire in graph.get("wires", []))


def _wire(wire: Any) -> WireView:
    whole: Dict[str, Any] = wire if isinstance(wire, dict) else {"wire": wire}
    parts = [part.strip() for part in str(whole.get("wire", "")).split("->")]
    delay = re.fullmatch(r"\[(\d+)\]", parts[1]) if len(parts) == 3 else None
    end = parts[-1]
    adds = end.startswith("(+)")
    return WireView(parts[0], end[3:].strip() if adds else end, int(delay[1]) if delay else 0, whole.get("gain"), adds, bool(whole.get("enabled", True)))


def controls_in(graph: Mapping[str, Any]) -> View[ControlView]:
    edit = "edit graph.text, and read it with tactus.Graph.parse; while it plays, use control()"
    return View("controls", {id: ControlView(id, str(c.get("name", id)), float(c.get("value", 0.0)), View(f"targets of {id}", c.get("to", {}), edit))
                             for id, c in graph.get("controls", {}).items()}, edit)
