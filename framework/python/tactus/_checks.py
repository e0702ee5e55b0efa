# SPDX-License-Identifier: MIT
"""Checks of arguments. What is wrong is an Error that names the argument, says what was given, and shows what to write."""

from __future__ import annotations

import difflib
import functools
import inspect
import math
import numbers
import os
import re
from typing import Any, Callable, Iterable, List, Mapping, NoReturn, Sequence, TypeVar, Union, cast

import numpy as np
from numpy.typing import NDArray

from ._messages import fail

Array = NDArray[np.float64]
Numbers = Union[Sequence[float], NDArray[Any]]
Path = Union[str, "os.PathLike[str]"]
_ADDRESS = re.compile(r" at 0x[0-9a-fA-F]+")
_SURROGATES = re.compile("[\ud800-\udfff]")
MOST = 1e9   # what a rate in Hz or a duration in s may be at most


F = TypeVar("F", bound=Callable[..., Any])


def arguments(function: F) -> F:
    """Refuses arguments that a function does not have, and a call without those that it needs, as an Error."""
    signature = inspect.signature(function)
    names = [name for name in signature.parameters if name not in ("self", "cls")]
    title = function.__qualname__.replace(".__init__", "")

    @functools.wraps(function)
    def call(*given: Any, **named: Any) -> Any:
        try:
            signature.bind(*given, **named)
        except TypeError as why:
            unknown = next((name for name in named if name not in names), None)
            if unknown is None:
                fail("argument/count", title, str(why), f"its arguments: {', '.join(names)}")
            near = difflib.get_close_matches(unknown, names, 1)
            meant = f" (did you mean '{near[0]}'?)" if near else ""
            fail("argument/unknown", unknown, f"{title} has no argument '{unknown}'{meant}", f"its arguments: {', '.join(names)}")
        return function(*given, **named)

    return cast(F, call)


def refuse(argument: str, value: Any, what: str, remedy: str) -> NoReturn:
    """The value has the wrong type."""
    fail("argument/type", argument, f"{shown(value)} is not {what}", remedy)


def shown(value: Any) -> str:
    """A value and its type, short enough for a message."""
    text = _ADDRESS.sub("", " ".join(repr(value).split()))
    return f"{text if len(text) <= 60 else text[:59] + '…'} ({type(value).__name__})"


def text(argument: str, value: Any, remedy: str) -> str:
    if not isinstance(value, str):
        refuse(argument, value, "text", remedy)
    if "\0" in value or not value.isprintable() and _SURROGATES.search(value):
        fail("argument/value", argument, f"{shown(value)} contains a null character, or half of a character", remedy)
    return value


def path(argument: str, value: Any, remedy: str = "give a path, such as 'drag.json'") -> str:
    if not isinstance(value, (str, os.PathLike)):
        refuse(argument, value, "a path", remedy)
    return text(argument, os.fspath(value), remedy)


def number(argument: str, value: Any, remedy: str, low: float = -math.inf, high: float = math.inf, above: float = -math.inf) -> float:
    """A finite number from low to high, greater than `above`."""
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        if not (isinstance(value, np.ndarray) and value.ndim == 0 and value.dtype.kind in "iuf"):
            refuse(argument, value, "a number", remedy)
    found = float(value)
    if not (math.isfinite(found) and low <= found <= high and found > above):
        bounds = [f"from {low:g}" if low > -math.inf else "", f"greater than {above:g}" if above > -math.inf else "",
                  f"at most {high:g}" if high < math.inf else ""]
        fail("argument/value", argument, f"{found:g} is not a finite number{' ' if any(bounds) else ''}{', '.join(b for b in bounds if b)}", remedy)
    return found


def duration(value: Any, argument: str = "duration") -> float:
    return number(argument, value, "give a duration in s, such as 2.0", above=0.0, high=MOST)


def rate(value: Any) -> float:
    if isinstance(value, numbers.Real) and not isinstance(value, bool) and not float(value) > 0.0:
        fail("run/rate", "rate", f"{value} is not a rate", "give a rate in Hz, or None for the usual one")
    return number("rate", value, "give a rate in Hz, such as 4000, or None for the usual one", above=0.0, high=MOST)


def whole(argument: str, value: Any, remedy: str, low: int = 0, high: int = 2**63 - 1) -> int:
    if isinstance(value, bool) or not isinstance(value, numbers.Integral):
        refuse(argument, value, "a whole number", remedy)
    if not low <= int(value) <= high:
        fail("argument/value", argument, f"{value} is not a whole number from {low} to {high}", remedy)
    return int(value)


def truth(argument: str, value: Any) -> bool:
    if not isinstance(value, (bool, np.bool_)):
        refuse(argument, value, "True or False", "give True or False")
    return bool(value)


def texts(argument: str, value: Any, example: str) -> List[str]:
    """A list of texts; one text is a list of one."""
    if isinstance(value, str):
        return [text(argument, value, example)]
    if isinstance(value, (Mapping, bytes)) or not isinstance(value, Iterable):
        refuse(argument, value, "a list of names", f"give a list, such as {example}")
    return [text(f"{argument}[{i}]", each, f"give a list of names, such as {example}") for i, each in enumerate(value)]


def mapping(argument: str, value: Any, example: str) -> Mapping[str, Any]:
    """A dict whose keys are names."""
    if value is None:
        return {}
    if not isinstance(value, Mapping):
        refuse(argument, value, "a dict", f"give a dict, such as {example}")
    for key in value:
        text(f"{argument}[{key!r}]", key, f"give names as keys, such as {example}")
    return value


def array(argument: str, value: Any) -> Array:
    """An array of floats. Numbers that are not finite are let through: they are what a lost sensor gives."""
    try:
        found = np.asarray(value)
        if found.dtype.kind in "OSUcMm":   # text is not read as numbers, and no imaginary part is lost
            raise ValueError(f"it holds {'text' if found.dtype.kind in 'SU' else 'values of the type ' + str(found.dtype)}")
        return found.astype(np.float64, copy=False)
    except (TypeError, ValueError) as why:
        fail("feed/type", argument, f"{shown(value)} is not an array of numbers: {why}", "give numbers, or an array of them")
