#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Renders a preset with many values on the workers of dask.distributed (Debian: python3-distributed).

    sweep_on_dask.py GRAPH.json [SCHEDULER]     without a scheduler, two workers are started on this computer
"""

import sys
from typing import Any, Dict, List

import numpy as np
from distributed import Client

import tactus


def rms(records: tactus.Records) -> float:
    """The root mean square of the force on the tool, in N. The workers compute it, so that only one number travels back."""
    return float(np.sqrt(np.mean(np.sum(records["motor.force"] ** 2, axis=1))))


def main() -> None:
    graph = tactus.Graph(sys.argv[1])
    where: Dict[str, Any] = {"address": sys.argv[2]} if len(sys.argv) > 2 else {"n_workers": 2, "threads_per_worker": 1, "dashboard_address": None}
    values: Dict[str, List[Any]] = {"drag.mu": [0.2, 0.4, 0.6], "drag.d_max": ["20 um", "50 um"]}
    client_type: Any = Client   # without types
    with client_type(**where) as client:
        for point in tactus.sweep(graph, values, executor=client.get_executor(), measure=rms, duration=2.0, record=["motor.force"]):
            print(point.set, point.result)


if __name__ == "__main__":
    main()
