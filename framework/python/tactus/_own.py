# SPDX-License-Identifier: MIT
"""Nodes written in Python, to try out a model. Offline only: Python can stop a tick for milliseconds."""

from __future__ import annotations

import base64
import json
import math
from collections import deque
from types import SimpleNamespace
from typing import Any, Dict, Iterable, List, Mapping, NamedTuple, Optional, Sequence, Tuple, Type

import numpy as np

from . import _checks, _tactus
from ._messages import fail

_QUANTITIES = {"m": "length", "rad": "angle", "m/s": "speed", "N": "force", "N*m": "torque", "J": "energy", "kg": "mass", "N/m": "stiffness",
               "N*s/m": "damping", "Hz": "frequency", "1/s": "rate", "1/m": "spatial_frequency"}


Range = Tuple[Optional[float], Optional[float]]   # None: no limit


class Port(NamedTuple):
    """A row of a datasheet. Make it with scalar, vector or choice."""

    width: int
    unit: str
    about: str
    default: Tuple[float, ...]
    hard: Tuple[float, float]
    usual: Tuple[float, float]
    quantity: str
    choices: Tuple[str, ...]

    def __repr__(self) -> str:
        kind = f"choice of {', '.join(self.choices)}" if self.choices else f"{'scalar' if self.width == 1 else 'vector'} in {self.unit}"
        return f"<tactus port: {kind[:100]}>"


def _range(limits: Optional[Range], otherwise: Tuple[float, float]) -> Tuple[float, float]:
    if limits is None:
        return otherwise
    if not isinstance(limits, (tuple, list)) or len(limits) != 2:
        _checks.refuse("range", limits, "a pair", "give (low, high); None for no limit")
    low, high = limits
    return (-math.inf if low is None else float(low), math.inf if high is None else float(high))


@_checks.arguments
def scalar(unit: str = "1", about: str = "", default: float = 0.0, hard: Optional[Range] = None, usual: Optional[Range] = None,
           quantity: str = "") -> Port:
    """A number. unit: SI without a prefix ("N/m"; "1" for a ratio). default: only for a parameter; an unwired input is 0.

    hard: (low, high), None for no limit; outside it the model has no meaning, so files are refused and wires are clamped. usual: what a
    slider shows. quantity: where the unit does not say it: "hit", "gain", "state"."""
    limits = _range(hard, (-math.inf, math.inf))
    _checks.text("unit", unit, "give an SI unit, such as 'N/m'")
    _checks.number("default", default, "give a number")
    return Port(1, unit, about, (float(default),), limits, _range(usual, limits), quantity or _QUANTITIES.get(unit, "any"), ())


@_checks.arguments
def vector(unit: str = "1", about: str = "", default: _checks.Numbers = (0.0, 0.0, 0.0), quantity: str = "") -> Port:
    """A vector (x, y, z); tick gets an array of shape (3,)."""
    if _checks.array("default", default).shape != (3,):
        fail("node/default", "default", f"the default {default!r} is not a vector", "give x, y and z")
    anything = (-math.inf, math.inf)
    return Port(3, unit, about, tuple(float(v) for v in default), anything, anything, quantity or _QUANTITIES.get(unit, "any"), ())


@_checks.arguments
def choice(names: Sequence[str], about: str = "", default: Optional[str] = None) -> Port:
    """A parameter with named alternatives; tick gets the name of the chosen one."""
    known = _checks.texts("names", names, "['smooth', 'rough']")
    if not known or (default is not None and default not in known):
        fail("node/default", "default", f"{default!r} is not one of the names", f"give one of {', '.join(known)}" if known else "give at least one name")
    at = known.index(default) if default is not None else 0
    anything = (-math.inf, math.inf)
    return Port(1, "1", about, (float(at),), anything, anything, "any", tuple(known))


class Node:
    """Derive a class from this, and pass it to Graph.render (nodes=[…]) or Engine (nodes=[…]). Offline only.

        class Wall (tactus.Node):
            id = "own.wall"
            inputs = {"position": tactus.vector("m", "tool position")}
            params = {"stiffness": tactus.scalar("N/m", "slope of the force", default=500, hard=(0, None))}
            outputs = {"force": tactus.vector("N", "force on the tool")}

            def tick(self, inputs, params):
                return {"force": (0, 0, params.stiffness * max(0.0, -inputs.position[2]))}

    inputs and params have one attribute per port: a float, an array (3,), or the name of a choice. All outputs must be returned. Keep
    state in attributes that __init__ or prepare sets, and name in `state` those that tick changes, so that Engine.save works: state = ("past",), or
    state = () if there are none. Such an attribute is a number, a text, None, an array of numbers, or a list, tuple, deque or dict of these; for
    anything else, name a property that reads and sets it. The same inputs must give the same outputs in every run: use no clock, and no random
    generator without a fixed seed.

    Non-finite numbers: if an input, a parameter or an output is not finite, all outputs of this tick are 0 (-1 for the quantity "state"), and
    the node starts again with a new object. An exception in tick ends the run and is raised."""

    id: str = ""
    name: str = ""
    summary: str = ""
    source: str = "a node in Python"
    inputs: Mapping[str, Port] = {}
    params: Mapping[str, Port] = {}
    outputs: Mapping[str, Port] = {}
    state: Optional[Sequence[str]] = None

    def __repr__(self) -> str:
        return f"<{type(self).__name__}, a tactus.Node: {self.id!r}>"

    def __init_subclass__(cls, **arguments: Any) -> None:
        super().__init_subclass__(**arguments)
        if isinstance(cls.id, str) and cls.id:
            _tactus.know_own_type(cls.id)   # graphs can have such nodes from now on

    def prepare(self, rate_hz: float) -> None:
        """Called before the first tick, with the tick rate."""

    def tick(self, inputs: Any, params: Any) -> Mapping[str, Any]:
        """One sample: returns the value of each output by its name."""
        raise NotImplementedError(f"{type(self).__name__} has no tick")


class _Running:
    """The Python side of one node: turns numbers into what tick expects, and back, and handles non-finite numbers."""

    def __init__(self, kind: Type[Node]):
        self.kind = kind
        self.rate_hz = 0.0
        self.node = kind()
        self.fault = [-1.0 if _quantity(name, port) == "state" else 0.0 for name, port in kind.outputs.items() for _ in range(port.width)]

    def prepare(self, rate_hz: float) -> None:
        self.rate_hz = rate_hz
        self.node.prepare(rate_hz)

    def tick(self, numbers: Tuple[float, ...]) -> List[float]:
        if not all(map(math.isfinite, numbers)):
            return self.start_again()
        inputs, next_one = _namespace(self.kind.inputs, numbers, 0)
        params, _ = _namespace(self.kind.params, numbers, next_one)
        results = self.flat(self.node.tick(inputs, params))
        return results if all(map(math.isfinite, results)) else self.start_again()

    def start_again(self) -> List[float]:
        self.node = self.kind()
        self.node.prepare(self.rate_hz)
        return self.fault

    def flat(self, given: Mapping[str, Any]) -> List[float]:
        if not isinstance(given, Mapping) or set(given) != set(self.kind.outputs):
            raise TypeError(f"tick of {self.kind.id} must return a dict with {', '.join(self.kind.outputs)}, not {given!r}")
        numbers: List[float] = []
        for name, port in self.kind.outputs.items():
            values = [float(given[name])] if port.width == 1 else [float(v) for v in given[name]]
            if len(values) != port.width:
                raise TypeError(f"the output {name} of {self.kind.id} must have {port.width} components, not {len(values)}")
            numbers += values
        return numbers


    def save(self) -> bytes:
        return json.dumps({name: _plain(getattr(self.node, name)) for name in self.names()}).encode()

    def restore(self, given: bytes) -> None:
        try:
            values = {name: _restored(value) for name, value in json.loads(given).items()}
            if set(values) != set(self.names()):
                raise ValueError(f"it has {', '.join(values)}, and the class names {', '.join(self.names())}")
            for name, value in values.items():
                setattr(self.node, name, value)
        except Exception as why:
            raise ValueError(f"does not take its state: {_checks.shown(why)}") from None

    def names(self) -> Sequence[str]:
        names = self.kind.state
        if not isinstance(names, (tuple, list)) or not all(isinstance(name, str) for name in names):
            raise ValueError(f'has a state that cannot be saved: its class {self.kind.__name__} does not name it, as in state = ("past",)')
        return names


def _plain(value: Any) -> Any:
    """A part of a state as JSON, which gets back its exact type. Restoring it runs no code, whatever it contains."""
    kind = type(value)
    if (kind is np.ndarray or isinstance(value, np.generic)) and value.dtype.kind in "biufc":
        return {"array": value.dtype.str, "shape": value.shape if kind is np.ndarray else None, "bytes": base64.b64encode(value.tobytes()).decode()}
    if value is None or kind in (bool, int, float, str):
        return value
    if kind in (list, tuple, deque):
        return {"list": kind.__name__, "values": [_plain(v) for v in value], "most": getattr(value, "maxlen", None)}
    if kind is dict:
        return {"dict": [[_plain(key), _plain(v)] for key, v in value.items()]}
    raise TypeError(f"has a state that cannot be saved: {_checks.shown(value)} is neither a number, a text, an array of numbers, nor a list or dict of these")


def _restored(part: Any) -> Any:
    if not isinstance(part, dict):
        return part
    if "array" in part:
        kind = np.dtype(part["array"])
        if kind.kind not in "biufc":
            raise ValueError("has an array of things that are not numbers")
        numbers = np.frombuffer(base64.b64decode(part["bytes"]), kind)
        return numbers[0] if part["shape"] is None else numbers.reshape(part["shape"]).copy()
    if "dict" in part:
        return {_restored(key): _restored(value) for key, value in part["dict"]}
    values = map(_restored, part["values"])
    return deque(values, part["most"]) if part["list"] == "deque" else {"list": list, "tuple": tuple}[part["list"]](values)


def _namespace(ports: Mapping[str, Port], numbers: Tuple[float, ...], at: int) -> Tuple[SimpleNamespace, int]:
    values: Dict[str, Any] = {}
    for name, port in ports.items():
        if port.choices:
            values[name] = port.choices[int(numbers[at])]
        else:
            values[name] = numbers[at] if port.width == 1 else np.array(numbers[at:at + 3])
        at += port.width
    return SimpleNamespace(**values), at


def _quantity(name: str, port: Port) -> str:
    return "state" if name == "state" and port.quantity == "any" else port.quantity


def describe(kinds: Sequence[Type[Node]]) -> List[Dict[str, Any]]:
    """What the C++ side needs to know of node classes."""
    if isinstance(kinds, type) or not isinstance(kinds, Iterable):
        _checks.refuse("nodes", kinds, "a list of classes", "give the classes in a list: nodes=[Wall]")
    kinds = list(kinds)
    for kind in kinds:
        if not (isinstance(kind, type) and issubclass(kind, Node)):
            fail("node/kind", "nodes", f"{_checks.shown(kind)} is not a class derived from tactus.Node", "give the class, not an object of it")
    ids = [kind.id for kind in kinds]
    if twice := [id for id in ids if ids.count(id) > 1]:
        fail("node/id_taken", twice[0], f"two nodes have the id '{twice[0]}'", "give each class its own id")
    return [_describe(kind) for kind in kinds]


def _describe(kind: Type[Node]) -> Dict[str, Any]:
    if not kind.id:
        fail("node/id", kind.__name__, "the node has no id", 'give it one: id = "own.wall"')
    if choices := [name for ports in (kind.inputs, kind.outputs) for name, port in ports.items() if port.choices]:
        fail("node/choice", f"{kind.id}.{choices[0]}", "only a parameter can be a choice", "move it to params")

    def rows(ports: Mapping[str, Port]) -> List[Dict[str, Any]]:
        return [{**port._asdict(), "id": name, "quantity": _quantity(name, port), "choices": list(port.choices), "default": list(port.default)}
                for name, port in ports.items()]

    return {"id": kind.id, "name": kind.name or kind.__name__, "summary": kind.summary or (kind.__doc__ or kind.__name__).split("\n")[0],
            "source": kind.source, "inputs": rows(kind.inputs), "params": rows(kind.params), "outputs": rows(kind.outputs),
            "factory": lambda: _Running(kind)}
