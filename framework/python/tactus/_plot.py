# SPDX-License-Identifier: MIT
"""Quick figures with matplotlib."""

from __future__ import annotations

import importlib
from typing import Any, Dict, List, Mapping, Optional, Sequence

import numpy as np

from . import _checks
from ._checks import Array
from ._messages import fail


def plot(records: Mapping[str, Any], ports: Optional[Sequence[str]] = None, over: str = "t", axes: Any = None) -> Any:
    """Draws recorded ports over time, or over another port, and returns the matplotlib figure.

    records: what render or step returned. ports: by default all of them; a component is "drag.force.x". over: a scalar port or a
    component. axes: matplotlib axes to draw into; without them, ports of the same unit share axes in a new figure."""
    if not isinstance(records, Mapping):
        _checks.refuse("records", records, "what render or step returned", "give tactus.plot(graph.render(…))")
    _checks.text("over", over, "name a recorded port, such as 't'")
    units = getattr(records, "units", {})
    chosen = [p for p in (_checks.texts("ports", ports, "['drag.force']") if ports is not None else records) if p not in ("t", over)]
    by_unit: Dict[str, List[str]] = {}
    for port in chosen:
        by_unit.setdefault(units.get(port, units.get(port[:-2], "")), []).append(port)
    if axes is None:
        figure, grid = subplots(max(len(by_unit), 1), 1, sharex=True, squeeze=False)
        all_axes: List[Any] = list(grid[:, 0])
    else:
        figure, all_axes = axes.figure, [axes] * len(by_unit)
    x = _column(records, over)
    if x.ndim != 1:
        fail("plot/over", over, "a vector cannot be the horizontal axis", f"give one component, such as {over}.x")
    for ax, (unit, some) in zip(all_axes, by_unit.items()):
        for port in some:
            y = _column(records, port)
            for label, line in [(port, y)] if y.ndim == 1 else [(f"{port}.{axis}", y[:, i]) for i, axis in enumerate("xyz")]:
                ax.plot(x, line, label=label, linewidth=1)
        ax.set_ylabel(unit or "value")
        ax.legend(frameon=False, fontsize="small")
    if all_axes:
        all_axes[-1].set_xlabel(f"{over} ({units.get(over, units.get(over[:-2], ''))})")
    return figure


def subplots(*shape: int, **options: Any) -> Any:
    """The figure and the axes of matplotlib.pyplot."""
    try:
        pyplot: Any = importlib.import_module("matplotlib.pyplot")
    except ImportError:
        fail("plot/no_matplotlib", "", "matplotlib is not installed", "install it: on Debian, python3-matplotlib")
    return pyplot.subplots(*shape, constrained_layout=True, **options)


def axes_of(axes: Any) -> Any:
    """The given axes, or those of a new figure."""
    return subplots()[1] if axes is None else axes


def _column(records: Mapping[str, Any], name: str) -> Array:
    if name in records:
        return np.asarray(records[name])
    if name[-2:] in (".x", ".y", ".z") and name[:-2] in records:
        return np.asarray(records[name[:-2]])[:, "xyz".index(name[-1])]
    fail("plot/unknown", name, f"'{name}' was not recorded", f"use one of {', '.join(records)}")
