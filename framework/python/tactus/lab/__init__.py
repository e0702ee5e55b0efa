# SPDX-License-Identifier: MIT
"""Experiments with graphs: protocols, procedures, sessions that survive a crash, analysis, and files that labs read (docs/lab.md); and studies of many
renders, on one computer or on a cluster (docs/studies.md).

    from tactus import lab

    protocol = lab.Protocol.load("roughness.json")
    data = lab.Experiment(protocol, "data", window=lab.Simulated(lab.Observer(threshold=0.3, width=0.1))).run()
    data.fit()               # threshold and width with intervals
    data.trials["level"]     # shape (n,)

Levels are in the unit of what varies, times in s. Problems raise tactus.Error.
"""

from ._analysis import (Detection, Interval, PowerLaw, Psychometric, d_prime_of_two_intervals, detection, plot_staircase, power_law, probability,
                        psychometric, save_plot)
from ._experiment import Experiment
from ._design import Factor, FromTable, Grid, Latin, Sobol
from ._points import Measure
from ._procedures import Constant, Psi, Staircase, mean_of_turns
from ._protocol import Block, Condition, HandAnswer, Plan, Protocol, Trial, Triggers, Varies, schema
from ._results import Results
from ._stages import Live, Moment, Receiver, Silent, mark
from ._study import Map, Study
from ._tables import SessionData, Table, load, table_of
from ._windows import Aborted, Browser, Observer, Simulated, Terminal, Window

load_results = Results

__all__ = ["Aborted", "Block", "Browser", "Condition", "Constant", "Detection", "Experiment", "Factor", "FromTable", "Grid", "HandAnswer", "Interval",
           "Latin", "Live", "Map", "Measure", "Moment", "Observer", "Plan", "PowerLaw", "Protocol", "Psi", "Psychometric", "Receiver", "Results", "SessionData",
           "Silent", "Simulated", "Sobol", "Staircase", "Study", "Table", "Terminal", "Trial", "Triggers", "Varies", "Window", "d_prime_of_two_intervals",
           "detection", "load", "load_results", "mark", "mean_of_turns", "plot_staircase", "power_law", "probability", "psychometric", "save_plot", "schema",
           "table_of"]
