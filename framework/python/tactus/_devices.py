# SPDX-License-Identifier: MIT
"""Devices that the program of the caller is: it pushes readings, and takes efforts."""

from __future__ import annotations

import difflib
import json
from typing import Any, Dict, Mapping, NamedTuple, NoReturn, Optional, Sequence

from . import _checks
from ._checks import Array
from ._messages import fail
from ._records import to_json

_CHANNELS = 32   # of a device, as in tactus.h


class PushedDevice(NamedTuple):
    """A device of your own: push its readings into the engine, and take the efforts. Until the first reading, and when readings stop for
    longer than the guard's watchdog, the effort is zero.

    axes: names of the axes whose positions it reads. efforts: names of the axes that its motors push. buttons: names of its buttons. guard:
    limits as in docs/safety.md: {"max_force": "3 N", "watchdog": "20 ms"}. brake: the largest damping of its brake on the tool, N s/m; 0: it
    has none.

    between, step_effort: for Engine.step(dt), whose steps last longer than a tick. between: where the tool is on tick i of n: "hold": at the new
    reading; "linear": i/n of the way from the last one to the new one; "by_velocity": where the new one and its velocity lead in i - 1 periods.
    step_effort: what `take` returns after the step: "last": the effort of the last tick; "mean": the mean over the step. docs/steps.md has the delay of
    each. Engine.step(n=…) uses neither: its ticks get the reading as it is.

    simulated: True if your program simulates the device, and no person holds it. Only then can Engine.save and Engine.restore be used, because a state may
    step the effort."""

    axes: Sequence[str] = ()
    efforts: Sequence[str] = ()
    buttons: Sequence[str] = ()
    signal_inputs: int = 0
    signal_outputs: int = 0
    guard: Optional[Mapping[str, Any]] = None
    brake: float = 0.0
    between: str = "hold"
    step_effort: str = "last"
    simulated: bool = False


class Effort(NamedTuple):
    """What a device should apply, after the guard. force (3,), on the tool, N. torque (3,), on the tool, N m. axes, N or N m, in the order
    of PushedDevice.efforts. signals: the signal outputs, channel 1 first. brake: damping of the brake on the tool, N s/m, at least 0. stop: why the
    guard withholds the effort now, or "": "speed", "impulse", "energy" and "emergency" last until Engine.rearm(); "not_finite", "stale", "starved",
    "released" and "halted" end with their cause."""

    force: Array
    torque: Array
    axes: Array
    signals: Array
    brake: float
    stop: str = ""


def described(role: str, device: PushedDevice) -> Dict[str, Any]:
    """A device of the caller, as the C++ side reads it."""
    at = f"devices[{role!r}]"
    names = {key: _checks.texts(f"{at}.{key}", getattr(device, key), "['x', 'y']") for key in ("axes", "efforts", "buttons")}
    for key, some in names.items():
        if len(some) > _CHANNELS:
            fail("argument/value", f"{at}.{key}", f"there are {len(some)} names", f"give at most {_CHANNELS}")
    counts = {key: _checks.whole(f"{at}.{key}", getattr(device, key), "give a number of signals, from 0", high=_CHANNELS)
              for key in ("signal_inputs", "signal_outputs")}
    brake = _checks.number(f"{at}.brake", device.brake, "give the largest damping in N s/m, or 0 for a device without a brake", low=0.0)
    rules = {key: _choice(f"{at}.{key}", getattr(device, key), choices)
             for key, choices in (("between", ("hold", "linear", "by_velocity")), ("step_effort", ("last", "mean")))}
    guard = device.guard if device.guard is None else _checks.mapping(f"{at}.guard", device.guard, "{'max_force': '3 N'}")
    if not isinstance(device.simulated, bool):
        _checks.refuse(f"{at}.simulated", device.simulated, "True or False", "give True only if no person holds the device")
    return {**names, **counts, **rules, "simulated": device.simulated, "brake": brake, "guard": json.loads(to_json(guard, f"{at}.guard"))}


def _choice(argument: str, value: Any, choices: Sequence[str]) -> int:
    """The number of a choice, as in tactus.h."""
    if value not in choices:
        meant = "_".join(value.lower().split()) if isinstance(value, str) else ""   # "by velocity"
        near = difflib.get_close_matches(meant, choices, 1)
        _checks.refuse(argument, value, "one of " + ", ".join(choices), f"write {near[0]!r}" if near else f"write {choices[0]!r} or {choices[1]!r}")
    return choices.index(value)


def explain_push(role: Any, position: Any, rotation: Any, pressure: Any, buttons: Any, axes: Any, signals: Any, age: Any,
                 velocity: Any, angular_velocity: Any, why: Exception) -> NoReturn:
    """Says which part of a reading cannot be used."""
    _checks.text("role", role, "give the name of a role, such as 'stylus'")
    vectors = {"position": position, "rotation": rotation, "velocity": velocity, "angular_velocity": angular_velocity}
    for name, values in {**vectors, "axes": axes, "signals": signals}.items():
        if values is None and "velocity" in name:
            continue
        if _checks.array(name, values).ndim != 1:
            remedy = "give x, y and z" if name in vectors else "give one number for each"
            fail("device/reading", name, f"{_checks.shown(values)} is not a list of numbers", remedy)
    for name, value in (("pressure", pressure), ("age", age)):
        if _checks.array(name, value).ndim != 0:
            fail("device/reading", name, f"{_checks.shown(value)} is not a number", "give a number")
    _checks.whole("buttons", buttons, "give a whole number, whose bit i means that button i is down", high=2**32 - 1)
    fail("device/reading", role, f"the reading cannot be used: {why}", "give numbers, as the documentation of push says")
