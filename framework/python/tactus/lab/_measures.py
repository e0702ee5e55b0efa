# SPDX-License-Identifier: MIT
"""The numbers that a study keeps of each render."""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass, field
from typing import Any, Callable, Dict, List, Literal, NamedTuple, Tuple

import numpy as np

from .._checks import Array
from .._graph import Graph
from .._messages import TactusWarning, fail
from .._records import Records
from .._reports import check
from ._procedures import note

Kind = Literal["peak", "max", "min", "mean", "rms", "last", "work", "given", "reach", "misfit", "band", "stable", "function"]
NEEDS: Dict[str, List[str]] = {"work": ["port", "position"], "given": ["port", "position"], "misfit": ["port", "column"], "band": ["port"], "reach": ["port"],
                               "stable": [], "function": ["function"]}


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
    seen: Dict[str, int] = {}
    for i, measure in enumerate(measures):
        for name in measure.columns:
            if not name or name in seen:
                fail("study/value", f"/measures/{i}", f"the column '{name}' is there twice" if name else "a measure has no name", "give each measure a name")
            seen[name] = i
        for key in NEEDS.get(measure.kind, ["port"]):
            if not getattr(measure, key):
                fail("study/missing", f"/measures/{i}/{key}", f"the measure '{measure.name}' ({measure.kind}) needs `{key}`", "add it")
        if measure.kind == "band" and not measure.low < measure.high:
            fail("study/value", f"/measures/{i}", f"the band ends at {measure.high:g} Hz, before it begins", "give `low` below `high`")
    if sum(measure.kind == "stable" for measure in measures) > 1:
        fail("study/value", "/measures", "there are two measures `stable`", "one is enough")


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
        found = self.components(port)
        if len(found) > 1:
            fail("study/measure", port, f"'{port}' is a vector", f"name a component, such as {port}.z")
        return found[0]


# The bits of a number must not depend on how many points are in its block. So sums are made tick by tick, and numpy may choose the order of no other sum.
def _sum(values: Array) -> Array:
    return np.asarray(np.cumsum(values, axis=1)[:, -1])


def _squares(m: Measure, block: Block) -> Array:
    """Of the magnitude of the port."""
    return np.asarray(sum(each * each for each in block.components(m.port)))


def _work(m: Measure, block: Block) -> Array:
    """Of the force on the position, so far."""
    forces, places = block.components(m.port), block.components(m.position)
    if len(forces) != len(places):
        fail("study/measure", m.name, f"'{m.port}' and '{m.position}' have different shapes", "give a force and a position, both vectors or both components")
    steps: Any = sum(force[:, :-1] * (place[:, 1:] - place[:, :-1]) for force, place in zip(forces, places))
    return np.cumsum(np.concatenate([0.0 * forces[0][:, :1], steps], axis=1), axis=1)


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
    "work": lambda m, block: _work(m, block)[:, -1],
    "given": lambda m, block: _work(m, block).max(axis=1),
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


def returned(measure: Measure, records: Records, point: Dict[str, Any], functions: Dict[str, Any]) -> List[float]:
    """The numbers that a function of the user returns."""
    given = functions[measure.function](records, point)
    numbers = [float(each) for each in given] if measure.outputs else [float(given)]
    if len(numbers) != len(measure.columns):
        fail("study/function", measure.function, f"the function has returned {len(numbers)} numbers, and {len(measure.columns)} have names",
             "return as many numbers as `outputs` names")
    return numbers
