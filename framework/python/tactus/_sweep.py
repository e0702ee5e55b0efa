# SPDX-License-Identifier: MIT
"""Renders the same graph with many sets of values."""

from __future__ import annotations

import concurrent.futures
import itertools
from typing import Any, Callable, Dict, Iterable, List, Mapping, NamedTuple, Optional, Sequence

from . import _checks
from ._graph import Graph, checked_graph
from ._records import Records


class Point(NamedTuple):
    """One point of a sweep: the values that were set, by parameter, and what was recorded or measured with them."""

    set: Dict[str, Any]
    result: Any


@_checks.arguments
def sweep(graph: Graph, values: Mapping[str, Sequence[Any]], executor: Optional[concurrent.futures.Executor] = None,
          measure: Optional[Callable[[Records], Any]] = None, **options: Any) -> List[Point]:
    """Renders a graph with every combination of values: {"drag.mu": [0.2, 0.4], "drag.d_max": ["20 um", "40 um"]} makes four renders.

    executor: any executor of concurrent.futures, or dask.distributed's Client.get_executor(). The graph is sent to its workers, which need
        the package tactus. Without an executor, the renders run one after another. The results have the same bits either way.
    measure: a function that the worker calls with the Records; its result is sent back instead of the Records. If workers are
        processes, the function must be picklable: a function of a module.
    options: those of Graph.render; `set` holds values that all points have in common.

    Returns the points in order: the last parameter changes fastest. An Error of a render is raised."""
    checked_graph(graph)
    example = "{'drag.mu': [0.2, 0.4]}"
    common = dict(_checks.mapping("set", options.pop("set", None), "{'drag.mu': 0.3}"))
    for name, some in _checks.mapping("values", values, example).items():
        if isinstance(some, (str, bytes, Mapping)) or not isinstance(some, Iterable):
            _checks.refuse(f"values[{name!r}]", some, "a list of values", f"give the values of each parameter as a list: {example}")
    if measure is not None and not callable(measure):
        _checks.refuse("measure", measure, "a function", "give a function that takes the Records")
    if executor is not None and not hasattr(executor, "submit"):
        _checks.refuse("executor", executor, "an executor", "give one of concurrent.futures, such as ProcessPoolExecutor()")
    points = [dict(zip(values, combination)) for combination in itertools.product(*values.values())]
    jobs = [(graph, {**common, **point}, measure, options) for point in points]
    if executor is None:
        results = [_render(*job) for job in jobs]
    else:
        futures = [executor.submit(_render, *job) for job in jobs]
        results = [future.result() for future in futures]
    return [Point(*pair) for pair in zip(points, results)]


def _render(graph: Graph, values: Dict[str, Any], measure: Optional[Callable[[Records], Any]], options: Dict[str, Any]) -> Any:
    records = graph.render(set=values, **options)
    return records if measure is None else measure(records)
