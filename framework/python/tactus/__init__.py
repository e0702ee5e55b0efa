# SPDX-License-Identifier: MIT
"""Tactus from Python: load, edit and render graphs of physical models for haptics, or run them step by step.

    import tactus

    graph = tactus.Graph("graphs/dry_wood.json")
    run = graph.render(duration=1.0, record=["drag.force", "drag.state"])
    run["t"]            # shape (n,), s
    run["drag.force"]   # shape (n, 3), N

All values are in SI units. Axes are right-handed: x right, y away from the person, z up. The results are the same, bit for bit, as
those of `tactus render`. Problems raise tactus.Error; warnings are Python warnings of the class tactus.TactusWarning.
"""

from . import _tactus
from ._assets import Mesh, Signal, set_limits
from ._devices import Effort, PushedDevice
from ._engine import Engine, Status
from ._graph import Graph
from ._messages import Error, Message, TactusWarning
from ._nodes import nodes
from ._own import Node, choice, scalar, vector
from ._play import Health, Session, play
from ._plot import plot
from ._plugins import compile_node, load_plugins
from ._presets import presets
from ._records import Records
from ._reports import (Check, Condition, Conversion, Devices, Event, Fit, FitValue, Interval, Limits, Log, check, convert, devices, fit, limits, read_log,
                       replay)
from ._sweep import Point, sweep

__version__ = _tactus.version()

__all__ = ["Check", "Condition", "Conversion", "Devices", "Effort", "Engine", "Error", "Event", "Fit", "FitValue", "Graph", "Health", "Interval", "Limits", "Log",
           "Mesh", "Message", "Node", "Point", "PushedDevice", "Records", "Session", "Signal", "Status", "TactusWarning", "check", "choice",
           "compile_node", "convert", "devices", "fit", "limits", "load_plugins", "nodes", "play", "plot", "presets", "read_log", "replay", "scalar",
           "set_limits", "sweep", "vector"]
