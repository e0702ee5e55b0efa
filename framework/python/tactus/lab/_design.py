# SPDX-License-Identifier: MIT
"""The points of a study: grids, Latin hypercubes, Sobol sequences and tables of values. A point is a tuple of texts, one JSON value for each factor."""

from __future__ import annotations

import contextlib
import csv
import functools
import glob
import json
import math
import operator
import os
from dataclasses import dataclass, field
from typing import Any, Callable, Dict, List, Literal, Optional, Sequence, Tuple, Union

import numpy as np

from .._messages import fail
from ._procedures import Draw, note

Point = Tuple[str, ...]


@dataclass(frozen=True)
class Factor:
    """Something that varies from point to point, and its values: a list, or a range."""

    vary: str = field(metadata=note("a parameter (\"drag.mu\"), a control (\"roughness\"), \"setting:NODE.SETTING\", \"device:ROLE\" or a key of its "
                                    "description (\"device:ROLE/hand/stiffness\"), \"rate\" in Hz, \"recording\" (files that feed the graph), or \"seed\", "
                                    "which functions get"))
    values: List[Any] = field(default_factory=list, metadata=note("its values; recordings may have patterns such as \"data/*.csv\""))
    low: Optional[float] = field(default=None, metadata=note("the low end of a range, in SI units"))
    high: Optional[float] = field(default=None, metadata=note("the high end of a range"))
    count: int = field(default=10, metadata=note("the number of steps of a range in a grid", low=2))
    log: bool = field(default=False, metadata=note("the steps of the range have equal ratios"))
    unit: str = field(default="", metadata=note("the unit, for tables and the report"))


@dataclass(frozen=True)
class Grid:
    """All combinations of the values; the last factor changes fastest."""

    kind: Literal["grid"] = "grid"


@dataclass(frozen=True)
class Latin:
    """A Latin hypercube: each of `points` equal parts of each range has one point."""

    kind: Literal["latin"] = "latin"
    points: int = field(default=100, metadata=note("the number of points", low=1, high=10**7))
    seed: int = field(default=1, metadata=note("the random orders follow from it", low=0))


@dataclass(frozen=True)
class Sobol:
    """The first points of a Sobol sequence, which fills the ranges evenly; for at most 10 factors."""

    kind: Literal["sobol"] = "sobol"
    points: int = field(default=128, metadata=note("the number of points, best a power of two", low=1, high=2**30))


@dataclass(frozen=True)
class FromTable:
    """The rows of a CSV file, whose columns are named like the factors."""

    kind: Literal["table"] = "table"
    path: str = field(default="", metadata=note("the file, relative to that of the study"))


Kind = Union[Grid, Latin, Sobol, FromTable]


def text_of(value: Any) -> str:
    """A value as JSON that is the same for equal values: 1 and 1.0, objects in any order."""
    def same(v: Any) -> Any:
        if isinstance(v, float) and v.is_integer() and abs(v) < 2**53:
            return int(v)
        if isinstance(v, dict):
            return {str(key): same(each) for key, each in v.items()}
        return [same(each) for each in v] if isinstance(v, (list, tuple)) else v
    try:
        return json.dumps(same(value), sort_keys=True, ensure_ascii=False, allow_nan=False)
    except (TypeError, ValueError, RecursionError) as why:
        fail("study/value", "/", f"a value cannot be in a study: {why}", "give finite numbers, texts, lists or objects")


class Design:
    """Points by their number. They are made when they are asked for, so a large grid or sequence takes no memory."""

    def __init__(self, names: Sequence[str], count: int, at: Callable[[int], Point], levels: Sequence[Sequence[str]], repeats: bool):
        """levels: of each factor, the values that it may have; none for a range. repeats: some points may be equal."""
        self.names, self.count, self.at, self.repeats = list(names), count, at, repeats
        self._levels = {name: {text: json.loads(text) for text in texts} for name, texts in zip(names, levels)}

    def values(self, name: str) -> List[Any]:
        """The values that a factor may have; none for a range."""
        return list(self._levels.get(name, {}).values())

    def columns(self, points: Sequence[Point]) -> Dict[str, Any]:
        """The values of some points by factor: arrays of numbers, or of texts."""
        found: Dict[str, Any] = {}
        for name, texts in zip(self.names, zip(*points)):
            known = self._levels[name]
            if all(map(_is_number, known.values())):
                found[name] = np.array([known[text] if known else float(text) for text in texts], float)
            else:
                found[name] = np.array([known[text] if isinstance(known[text], str) else text for text in texts], object)
        return found


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def make(kind: Kind, factors: Sequence[Factor], folder: str) -> Design:
    """The design of a study whose relative paths begin at `folder`."""
    names = [factor.vary for factor in factors]
    for i, name in enumerate(names):
        if name in names[:i]:
            fail("study/value", f"/factors/{i}", f"'{name}' varies twice", "name each factor once")
    if isinstance(kind, FromTable):
        cells = _table(kind, names, folder)
        return Design(names, len(cells[0]), lambda index: tuple([column[index] for column in cells]), cells, True)
    levels = [[text_of(value) for value in _levels(factor, f"/factors/{i}", folder)] for i, factor in enumerate(factors)]
    if isinstance(kind, Grid):
        steps = [each or [_between(factor, k / (factor.count - 1)) for k in range(factor.count)] for each, factor in zip(levels, factors)]
        sizes = [len(each) for each in steps]
        parts = [(each, math.prod(sizes[k + 1:]), len(each)) for k, each in enumerate(steps)]
        return Design(names, math.prod(sizes), lambda index: tuple([each[index // step % size] for each, step, size in parts]), levels,
                      any(len(set(each)) < len(each) for each in steps))
    columns = _latin(kind, len(factors)) if isinstance(kind, Latin) else _sobol(len(factors))

    def at(index: int) -> Point:
        return tuple([each[min(int(u * len(each)), len(each) - 1)] if each else _between(factor, u)
                      for each, factor, u in zip(levels, factors, columns(index))])

    return Design(names, kind.points, at, levels, all(levels))


def _levels(factor: Factor, where: str, folder: str) -> List[Any]:
    """The listed values of a factor; empty for a range."""
    if factor.values:
        if factor.low is not None or factor.high is not None:
            fail("study/value", where, f"'{factor.vary}' has both values and a range", "give `values`, or `low` and `high`")
        if factor.vary != "recording":
            return factor.values
        found: List[str] = []
        for pattern in factor.values:
            files = sorted(glob.glob(os.path.join(folder, str(pattern)), recursive=True))
            if not files:
                fail("study/no_recording", where, f"no file fits '{pattern}'", "give paths or patterns relative to the study, such as data/*.csv")
            found += [os.path.relpath(file, folder or os.curdir) for file in files]
        return found
    if factor.low is None or factor.high is None or not factor.low < factor.high or (factor.log and factor.low <= 0.0):
        fail("study/value", where, f"'{factor.vary}' has neither values nor a range of values", "give `values`, or `low` below `high`; above 0 for `log`")
    return []


def _between(factor: Factor, u: float) -> str:
    """The value at a part u of the range. Rounded, so that it does not depend on how a computer computes a logarithm."""
    low, high = float(factor.low or 0.0), float(factor.high or 0.0)
    return text_of(float(f"{math.exp(math.log(low) * (1.0 - u) + math.log(high) * u) if factor.log else low + (high - low) * u:.12g}"))


def _latin(kind: Latin, width: int) -> Callable[[int], List[float]]:
    draws = [Draw("study", kind.seed, k) for k in range(width)]
    columns = [(np.array(draw.order(range(kind.points)), float) + [draw.uniform() for _ in range(kind.points)]) / kind.points for draw in draws]
    return lambda index: [float(column[index]) for column in columns]


# Primitive polynomials (degree, coefficients) and first direction numbers: the file new-joe-kuo-6.21201 of Joe and Kuo (2008).
_DIRECTIONS = [(1, 0, [1]), (2, 1, [1, 3]), (3, 1, [1, 3, 1]), (3, 2, [1, 1, 1]), (4, 1, [1, 1, 3, 3]), (4, 4, [1, 3, 5, 13]), (5, 2, [1, 1, 5, 5, 17]),
               (5, 4, [1, 1, 5, 5, 5]), (5, 7, [1, 1, 7, 11, 19])]
_BITS = 30


def _sobol(width: int) -> Callable[[int], List[float]]:
    if width > len(_DIRECTIONS) + 1:
        fail("study/value", "/design", f"a Sobol sequence of {width} factors is not known", f"use at most {len(_DIRECTIONS) + 1}, or the design latin")
    table = [[1] * _BITS]
    for degree, polynomial, first in _DIRECTIONS[:width - 1]:
        m = list(first)
        for k in range(degree, _BITS):
            terms = (m[k - j] << j for j in range(1, degree) if polynomial >> (degree - 1 - j) & 1)
            m.append(functools.reduce(operator.xor, terms, m[k - degree] ^ (m[k - degree] << degree)))
        table.append(m)

    def at(index: int) -> List[float]:
        chosen = [k for k in range(_BITS) if (index ^ (index >> 1)) >> k & 1]
        return [functools.reduce(operator.xor, (m[k] << (_BITS - 1 - k) for k in chosen), 0) / 2.0**_BITS for m in table]

    return at


def _table(kind: FromTable, names: Sequence[str], folder: str) -> List[List[str]]:
    try:
        with open(os.path.join(folder, kind.path), encoding="utf-8-sig", newline="") as file:
            rows = list(csv.DictReader(file))
    except (OSError, ValueError, csv.Error) as why:
        fail("study/unreadable", "/design/path", f"the table '{kind.path}' cannot be read: {why}", "give a CSV file, relative to the study")
    for number, row in enumerate(rows or [{}], 2):
        if None in row or None in row.values() or not set(names) <= set(row):
            fail("study/value", f"{kind.path}:{number}", f"the row has more or fewer values than the header, or none for one of {', '.join(names)}",
                 "give a header with the names of the factors, and a row for each point")
    return [[_cell(row[name]) for row in rows] for name in names]


def _cell(text: str) -> str:
    with contextlib.suppress(ValueError):
        return text_of(json.loads(text, parse_constant=str))
    return text_of(text)
