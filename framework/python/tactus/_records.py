# SPDX-License-Identifier: MIT
"""From columns of numbers to arrays by port, and back."""

from __future__ import annotations

import importlib
import json
from typing import Any, Dict, Iterable, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np

from ._checks import Array, array, shown
from ._messages import fail
from ._views import shortened


class Records(Dict[str, Array]):
    """What a run has recorded: arrays by port, with one row per tick.

    "t" has shape (n,) and is in s. A scalar port has shape (n,), a vector port (n, 3) with the columns x, y, z. `units` has the SI unit of
    each port, "" if it is unknown; `rate_hz` is the tick rate."""

    def __init__(self, *args: Any, units: Optional[Mapping[str, str]] = None, rate_hz: float = 0.0):
        super().__init__(*args)
        self.units: Dict[str, str] = dict(units or {})
        self.rate_hz = rate_hz

    def __repr__(self) -> str:
        ports = [f"{port}{f' ({unit})' if (unit := self.units.get(port, '')) not in ('', '1') else ''}" for port in self if port != "t"]
        return f"<tactus.Records of {len(self.get('t', ()))} ticks at {self.rate_hz:g} Hz: {shortened(ports) or 'nothing'}>"

    def to_dataframe(self) -> Any:
        """A pandas.DataFrame with one row per tick, indexed by t in s, and one column per component: "drag.force.x".

        Its attrs have "units", the SI unit of each column and of "t", and "rate_hz". pandas must be installed."""
        pandas = imported("pandas", "to_dataframe")
        columns, units = components(self._ports(), self.units)
        frame = pandas.DataFrame(columns, index=pandas.Index(self._t(), name="t"))
        frame.attrs.update(units={"t": "s", **units}, rate_hz=self.rate_hz)
        return frame

    def to_xarray(self) -> Any:
        """An xarray.Dataset with the dimension t in s and, for vectors, the dimension axis: "x", "y", "z".

        Each variable has its SI unit in attrs["units"], and the dataset has attrs["rate_hz"]. xarray must be installed."""
        xarray = imported("xarray", "to_xarray")
        coordinates: Dict[str, Any] = {"t": ("t", self._t(), {"units": "s"})}
        variables = {}
        for port, values in self._ports():
            dimensions = ("t",) if values.ndim == 1 else ("t", "axis")
            if values.ndim == 2:
                coordinates["axis"] = list("xyz")
            variables[port] = (dimensions, values, {"units": self.units.get(port, "")})
        return xarray.Dataset(variables, coords=coordinates, attrs={"rate_hz": self.rate_hz})

    def _t(self) -> Array:
        if "t" not in self:
            fail("records/shape", "t", "the records have no times", "keep the entry 't'")
        return self["t"]

    def _ports(self) -> List[Tuple[str, Array]]:
        """The ports with their values. A dict can be changed, so the shapes are checked."""
        ports = [(port, np.asarray(values)) for port, values in self.items() if port != "t"]
        for port, values in ports:
            if values.shape not in ((len(self._t()),), (len(self._t()), 3)):
                fail("records/shape", port, f"the array has the shape {values.shape}, and there are {len(self._t())} ticks", "keep one row per tick")
        return ports


def imported(name: str, where: str) -> Any:
    """A package that is needed only here."""
    try:
        return importlib.import_module(name)
    except ImportError as why:
        fail(f"records/no_{name}", where, f"the package {name} cannot be imported: {why}", f"install it: pip install {name}, or on Debian python3-{name}")


class Layout:
    """How the recorded columns of a run become arrays."""

    def __init__(self, columns: Sequence[str], units: Sequence[str], asked: Sequence[str], rate_hz: float):
        self.rate_hz = rate_hz
        self.ports: List[Tuple[str, Union[int, slice]]] = []
        self.units = {"t": "s"}
        at = 0
        while at < len(columns):
            port = columns[at][:-2]
            is_vector = list(columns[at:at + 3]) == [port + end for end in (".x", ".y", ".z")] and columns[at] not in asked
            name, width = (port, 3) if is_vector else (columns[at], 1)
            self.ports.append((name, slice(at, at + 3) if is_vector else at))
            self.units[name] = units[at]
            at += width

    def records(self, rows: Array, first_tick: int = 0) -> Records:
        """The records as arrays, which are views of `rows`."""
        t = np.arange(first_tick, first_tick + len(rows)) / self.rate_hz
        return Records({"t": t, **{name: rows[:, where] for name, where in self.ports}}, units=self.units, rate_hz=self.rate_hz)


def names_of(port: str, width: int) -> List[str]:
    """The columns of a port."""
    return [port] if width == 1 else [f"{port}.{axis}" for axis in "xyz"]


def components(ports: Iterable[Tuple[str, Array]], units: Mapping[str, str]) -> Tuple[Dict[str, Array], Dict[str, str]]:
    """The columns of ports by name, and their units."""
    columns, of_columns = {}, {}
    for port, values in ports:
        for i, name in enumerate(names_of(port, 1 if values.ndim == 1 else 3)):
            columns[name] = values if values.ndim == 1 else values[:, i]
            of_columns[name] = units.get(port, "")
    return columns, of_columns


def table_of(feed: Mapping[str, Any]) -> Tuple[List[str], Array]:
    """The columns of a feed, and an array of shape (n, columns)."""
    arrays = {port: array(f"feed[{port!r}]", values) for port, values in feed.items()}
    lengths = {len(a) for a in arrays.values() if a.ndim > 0}
    if len(lengths) != 1:
        each = ", ".join(f"{port} has {len(a)}" for port, a in arrays.items() if a.ndim > 0)
        fail("feed/shape", "feed", f"the arrays of the feed are not equally long: {each} rows" if lengths else "the feed has no array",
             "give each port an array with one row per tick; only a single number may be given for all ticks")
    count = lengths.pop()
    columns: List[str] = []
    parts: List[Array] = []
    for port, a in arrays.items():
        if a.ndim == 0:
            a = np.full(count, float(a))
        if a.ndim > 2 or (a.ndim == 2 and a.shape[1] != 3):
            fail("feed/shape", port, f"the array has the shape {a.shape}", "give (n,) for a scalar and (n, 3) for a vector")
        width = 1 if a.ndim == 1 else 3
        columns += names_of(port, width)
        parts.append(a.reshape(count, width))
    return columns, np.ascontiguousarray(np.hstack(parts))


def to_json(value: Any, where: str = "") -> str:
    """A value as JSON, as in a graph file. numpy arrays become lists, and numpy numbers become plain numbers."""
    def plain(v: Any) -> Any:
        if isinstance(v, (np.generic, np.ndarray)):
            return v.tolist()
        raise TypeError(f"{shown(v)} is not a number, text, list or dict")

    try:
        return json.dumps(value, allow_nan=False, default=plain)
    except (TypeError, ValueError, RecursionError) as why:
        fail("api/value", where, f"the value {shown(value)} cannot be in a graph: {why}", "give a finite number, text, a list or a dict")


def to_optional_json(value: Any, where: str = "") -> Optional[str]:
    return None if value is None else to_json(value, where)
