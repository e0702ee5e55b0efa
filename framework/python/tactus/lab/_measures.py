# SPDX-License-Identifier: MIT
"""The numbers that a study keeps of each render."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Dict, List, Literal

import numpy as np

from .._checks import Array
from .._messages import fail
from .._records import Records
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
    places: int = field(default=16, metadata=note("the number of places of the motion at which slopes are measured", low=4, high=1000))
    function: str = field(default="", metadata=note("the name of a function of (records, point), in the file that --functions gives"))
    outputs: List[str] = field(default_factory=list, metadata=note("names of the numbers that the function returns, if there are several"))
    unit: str = field(default="", metadata=note("the unit, for tables and the report"))

    @property
    def columns(self) -> List[str]:
        """The columns that it fills."""
        if self.kind == "stable":
            return [self.name, f"{self.name}_margin"]
        return [f"{self.name}_{output}" for output in self.outputs] or [self.name]

    @property
    def needs_records(self) -> bool:
        """True if the number is computed after the render; the others are computed in it."""
        return self.kind in ("band", "function")


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


def gauge(measure: Measure, recording: Dict[str, Array]) -> Dict[str, Any]:
    """A measure as the C++ side computes it."""
    if measure.kind == "misfit" and measure.column not in recording:
        fail("study/no_column", f"/measures/{measure.name}", f"the recording has no column '{measure.column}'" if recording else "there is no recording",
             f"its columns: {', '.join(recording)}" if recording else "add the factor `recording`")
    return {**{name: getattr(measure, name) for name in ("kind", "port", "position", "level", "hold", "above")},
            "reference": recording[measure.column] if measure.kind == "misfit" else np.zeros(0)}


def band(values: Array, rate: float, low: float, high: float) -> float:
    """The rms of the part of a signal from low to high, in Hz; of a vector, that of its magnitude. values: shape (n,) or (n, 3)."""
    columns = values.reshape(len(values), -1)
    power = np.abs(np.fft.rfft(columns - columns.mean(axis=0), axis=0))**2
    at = np.fft.rfftfreq(len(columns), 1.0 / rate)
    weight = np.where((at == 0.0) | ((len(columns) % 2 == 0) & (at >= rate / 2 - 1e-9)), 1.0, 2.0)
    return float(np.sqrt((power.sum(axis=1) * weight)[(at >= low) & (at < high)].sum()) / len(columns))


def afterwards(measure: Measure, records: Records, point: Dict[str, Any], functions: Dict[str, Any]) -> List[float]:
    """The numbers of a measure that are computed from records."""
    if measure.kind == "band":
        if measure.port not in records:
            fail("study/measure", f"/measures/{measure.name}", f"no column of the run belongs to '{measure.port}'", "name a port")
        return [band(records[measure.port], records.rate_hz, measure.low, measure.high)]
    given = functions[measure.function](records, point)
    numbers = [float(given)] if not measure.outputs else [float(each) for each in given]
    if len(numbers) != len(measure.columns):
        fail("study/function", measure.function, f"the function has returned {len(numbers)} numbers, and {len(measure.columns)} have names",
             "return as many numbers as `outputs` names")
    return numbers
