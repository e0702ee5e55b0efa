# SPDX-License-Identifier: MIT
"""Pictures of graphs for notebooks. All text in them may come from strangers, so it is escaped, and none of it becomes a tag, an attribute or a style."""

from __future__ import annotations

import re
from html import escape
from typing import Any, Dict, List, Mapping, Sequence, Set, Tuple, Union

from ._views import NodeView, WireView

_WIDTH, _HEIGHT, _APART, _ABOVE = 150, 40, 60, 16   # of a node, between columns, and between rows; in px
_LANE = 14                                           # height of a wire that passes a column, in px
_MOST_LANES = 2000                                   # with more of them, wires run behind nodes
_MOST, _MOST_WIRES = 200, 2000                       # a larger picture helps nobody
_NOT_IN_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]|[\u202a-\u202e\u2066-\u2069]")   # the latter turn text around


def clean(text: Any, most: int = 200) -> str:
    """Text of a file as text in a picture."""
    plain = _NOT_IN_XML.sub("\ufffd", str(text))
    return escape(plain if len(plain) <= most else plain[:most - 1] + "…")


def node_of(port: str) -> str:
    """The node that a port of a wire belongs to: "finger[3].force.x" is of finger."""
    return re.split(r"[.\[/]", port, maxsplit=1)[0]


def svg(nodes: Mapping[str, NodeView], wires: Sequence[WireView]) -> str:
    """Nodes as boxes, signals from left to right, wires with a delay dashed."""
    shown = dict(list(nodes.items())[:_MOST])
    ends = [(node_of(wire.start), node_of(wire.end), wire) for wire in wires]
    ends = [(a, b, wire) for a, b, wire in ends if a in shown and b in shown][:_MOST_WIRES]
    layout = _Layout(list(shown), [(a, b) for a, b, wire in ends if not wire.delay and a != b])
    left_out = len(nodes) - len(shown)
    height = layout.height + (20 if left_out else 0)
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="-1 -1 {layout.width} {height}" width="{layout.width}" '
             f'style="max-width:100%;height:auto" font-family="sans-serif" font-size="11" fill="currentColor">']
    parts += [f'<path d="{d}" fill="none" stroke="currentColor"/>' for d in layout.bundles()]
    parts += [_wire(layout.path(a, b), wire) for a, b, wire in ends]
    parts += [_box(node, *layout.places[name]) for name, node in shown.items()]
    if left_out:
        parts.append(f'<text x="0" y="{height - 8}">and {left_out} more nodes</text>')
    return "".join(parts) + "</svg>"


def html(name: str, rate: float, nodes: Mapping[str, NodeView], wires: Sequence[WireView]) -> str:
    about = f"{len(nodes)} nodes, {len(wires)} wires, {rate:g} Hz"
    return f'<div><p><b>{clean(name) or "Graph"}</b>: {about}</p>{svg(nodes, wires)}</div>'


Lane = Tuple[str, int]   # what wires of a node share where they pass a column


class _Layout:
    """Where nodes and wires are. A node is one column to the right of the last node that feeds it. A wire that passes a column has a lane there."""

    def __init__(self, names: List[str], links: Sequence[Tuple[str, str]]):
        self.feeders: Dict[str, List[str]] = {name: [] for name in names}
        fed: Dict[str, List[str]] = {name: [] for name in names}
        for a, b in links:
            self.feeders[b].append(a)
            fed[a].append(b)
        self.column = _columns(names, self.feeders, fed)
        self.ends = {a: max((self.column[b] for b in fed[a]), default=0) for a in names}   # the last column that each node feeds
        lanes = [(a, c) for a in names for c in range(self.column[a] + 1, self.ends[a])]
        self.lanes: Set[Lane] = set(lanes) if len(lanes) <= _MOST_LANES else set()
        self.middle: Dict[Union[str, Lane], int] = {}   # y
        self.height = 0
        rows: Dict[int, List[Union[str, Lane]]] = {}
        items: List[Union[str, Lane]] = [*names]
        items += [lane for lane in lanes if lane in self.lanes]
        for item in items:
            rows.setdefault(item[1] if isinstance(item, tuple) else self.column[item], []).append(item)
        for c in sorted(rows):
            y = 0
            for item in sorted(rows[c], key=self._wish):
                tall = _LANE if isinstance(item, tuple) else _HEIGHT
                self.middle[item] = y + tall // 2
                y += tall + (0 if isinstance(item, tuple) else _ABOVE)
            self.height = max(self.height, y)
        self.width = (max(rows, default=0) + 1) * (_WIDTH + _APART) - _APART + 2
        self.places = {name: (self.column[name] * (_WIDTH + _APART), self.middle[name] - _HEIGHT // 2) for name in names}

    def _wish(self, item: Union[str, Lane]) -> float:
        """The height at which an item is nearest to what feeds it."""
        c, feeders = (item[1], [item[0]]) if isinstance(item, tuple) else (self.column[item], self.feeders[item])
        known = [self.middle[p] for f in feeders if (p := self._before(f, c)) in self.middle]
        return sum(known) / len(known) if known else 0.0

    def _before(self, a: str, c: int) -> Union[str, Lane]:
        """Where the wires of a node come from when they enter a column."""
        return (a, c - 1) if (a, c - 1) in self.lanes else a

    def _from(self, item: Union[str, Lane]) -> Tuple[int, int]:
        c = item[1] if isinstance(item, tuple) else self.column[item]
        return c * (_WIDTH + _APART) + _WIDTH, self.middle[item]

    def path(self, a: str, b: str) -> str:
        """The last part of a wire, as the d of a path."""
        x, y = self._from(self._before(a, self.column[b]))
        to_x, to_y = self.places[b][0], self.middle[b]
        bend = _APART if to_x > x else _APART + 20
        return f"M{x} {y}C{x + bend} {y} {to_x - bend} {to_y} {to_x} {to_y}"

    def bundles(self) -> List[str]:
        """The lanes, each with the part of the wire that leads to it."""
        parts = []
        for a, c in sorted(self.lanes):
            x, y = self._from(self._before(a, c))
            to_x, to_y = c * (_WIDTH + _APART), self.middle[(a, c)]
            parts.append(f"M{x} {y}C{x + _APART} {y} {to_x - _APART} {to_y} {to_x} {to_y}h{_WIDTH}")
        return parts


def _columns(names: List[str], feeders: Dict[str, List[str]], fed: Dict[str, List[str]]) -> Dict[str, int]:
    missing = {name: len(feeders[name]) for name in names}
    ready = [name for name in names if missing[name] == 0]
    column: Dict[str, int] = {}
    left = dict.fromkeys(names)
    while left:
        name = ready.pop(0) if ready else next(iter(left))   # of a loop, one node comes first
        if name not in left:
            continue
        del left[name]
        column[name] = max((column[f] + 1 for f in feeders[name] if f in column), default=0)
        for to in fed[name]:
            missing[to] -= 1
            if missing[to] == 0:
                ready.append(to)
    return column


def _box(node: NodeView, x: int, y: int) -> str:
    values = "\n".join(f"{key}: {value}" for key, value in list(node.params.items())[:20])
    type_of = node.type + (f" ({node.role})" if node.role else "")
    return (f'<g><title>{clean(node.name + ": " + node.type + chr(10) + values, 600)}</title>'
            f'<rect x="{x}" y="{y}" width="{_WIDTH}" height="{_HEIGHT}" rx="4" fill="#8884" stroke="currentColor"/>'
            f'<text x="{x + 8}" y="{y + 17}" font-weight="bold">{clean(node.name, 20)}</text>'
            f'<text x="{x + 8}" y="{y + 32}" font-size="10">{clean(type_of, 26)}</text></g>')


def _wire(d: str, wire: WireView) -> str:
    look = (' stroke-dasharray="4 3"' if wire.delay else "") + ("" if wire.is_enabled else ' opacity="0.3"')
    gain = "" if wire.gain is None else f", gain {wire.gain}"
    return f'<path d="{d}" fill="none" stroke="currentColor"{look}><title>{clean(f"{wire}{gain}", 400)}</title></path>'
