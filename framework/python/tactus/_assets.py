# SPDX-License-Identifier: MIT
"""What a program supplies instead of the files that settings name."""

from __future__ import annotations

import os
from typing import Any, Callable, Dict, Mapping, NamedTuple, Optional, Union

import numpy as np

from . import _checks, _tactus
from ._checks import Array
from ._messages import fail


class Signal(NamedTuple):
    """A recording. samples: shape (n,), or (n, channels). rate: in Hz."""

    samples: Any
    rate: float

    def __repr__(self) -> str:
        return f"<tactus.Signal {np.shape(self.samples)} at {self.rate} Hz>"


class Mesh(NamedTuple):
    """Triangles. points: shape (n, 3), as they would be in a file. triangles: shape (m, 3), numbers of points from 0, counter-clockwise
    as seen from outside."""

    points: Any
    triangles: Any

    def __repr__(self) -> str:
        return f"<tactus.Mesh of {len(self.points)} points and {len(self.triangles)} triangles>"


Assets = Union[Mapping[str, Any], Callable[[str, str], Any]]


def set_limits(limits: str) -> None:
    """Sets what files may cost, for all graphs of this process: "points=1M,memory=2GB". Limits that the text does not name keep their defaults."""
    _tactus.set_limits(_checks.text("limits", limits, "give text, such as 'points=1M,memory=2GB'"))


def reader(assets: Optional[Assets]) -> Optional[Callable[[str, str], Optional[Dict[str, Any]]]]:
    """The function that the C++ side asks about each file. It is given the kind and the path."""
    if assets is None:
        return None
    if callable(assets):
        find = assets
    else:
        known = _checks.mapping("assets", assets, "assets={'leather.png': picture}, or a function")
        find = lambda _, path: _found(known, path)   # noqa: E731

    forms = {"signal": _signal, "image": _image, "table": _table, "mesh": _mesh}

    def read(kind: str, path: str) -> Optional[Dict[str, Any]]:
        given = find(kind, path)
        return None if given is None else forms[kind](given, path)

    return read


def _found(assets: Mapping[str, Any], path: str) -> Any:
    """The asset whose name is the path, or the end of the path. The longest name wins."""
    there = os.path.normpath(path).split(os.sep)
    named = {name: os.path.normpath(name).split(os.sep) for name in assets}
    fitting = [name for name, parts in named.items() if there[-len(parts):] == parts]
    return assets[max(fitting, key=lambda name: len(named[name]))] if fitting else None


def _signal(given: Any, path: str) -> Dict[str, Any]:
    if not (isinstance(given, tuple) and len(given) == 2):
        fail("asset/shape", path, "a recording needs a sample rate", "give a tactus.Signal(samples, rate)")
    samples = _numbers(given[0], path)
    if samples.ndim not in (1, 2):
        fail("asset/shape", path, f"the samples have the shape {samples.shape}", "give (n,), or (n, channels)")
    rate = _checks.number(f"{path}: rate", given[1], "give the sample rate in Hz", above=0.0, high=_checks.MOST)
    return {"values": _rows(samples.reshape(len(samples), -1)), "rate": rate}


def _image(given: Any, path: str) -> Dict[str, Any]:
    pixels = np.asarray(given)
    if pixels.ndim not in (2, 3) or (pixels.ndim == 3 and not 1 <= pixels.shape[2] <= 4):
        fail("asset/shape", path, f"the pixels have the shape {pixels.shape}", "give (rows, columns), or (rows, columns, colours)")
    if pixels.dtype == np.uint8 or pixels.dtype == bool:
        white = 65535.0
        pixels = pixels.astype(float) * (257.0 if pixels.dtype == np.uint8 else white)
    elif pixels.dtype.kind == "f":
        white = 1.0
    elif pixels.dtype == np.uint16:
        white = 65535.0
    else:
        fail("asset/shape", path, f"pixels of the type {pixels.dtype} have no white", "give uint8, uint16, or floats from 0 (black) to 1 (white)")
    pixels = _numbers(pixels, path)
    if pixels.ndim == 3:
        pixels = _grey(pixels)
    return {"values": _rows(pixels / white), "rate": 0.0}


def _grey(pixels: Array) -> Array:
    """The luminance of colours, by the formula and with the bits of the program. Transparency is ignored."""
    if pixels.shape[2] < 3:
        return pixels[:, :, 0]
    red, green, blue = (pixels[:, :, i] for i in range(3))
    return np.where((red == green) & (green == blue), red, 0.299 * red + 0.587 * green + 0.114 * blue)


def _table(given: Any, path: str) -> Dict[str, Any]:
    numbers = _numbers(given, path)
    if numbers.ndim not in (1, 2):
        fail("asset/shape", path, f"the table has the shape {numbers.shape}", "give (rows, columns), or (n,) for one row")
    return {"values": _rows(np.atleast_2d(numbers)), "rate": 0.0}


def _mesh(given: Any, path: str) -> Dict[str, Any]:
    if not (isinstance(given, tuple) and len(given) == 2):
        fail("asset/shape", path, "a mesh needs points and triangles", "give a tactus.Mesh(points, triangles)")
    points, triangles = _numbers(given[0], path), np.asarray(given[1])
    for name, array in (("points", points), ("triangles", triangles)):
        if array.ndim != 2 or array.shape[1] != 3:
            fail("asset/shape", path, f"the {name} have the shape {array.shape}", "give (n, 3)")
    if triangles.dtype.kind not in "iu":
        fail("asset/shape", path, f"the triangles are of the type {triangles.dtype}", "give whole numbers of points, from 0")
    if len(triangles) and not (0 <= triangles.min() and triangles.max() < len(points)):
        fail("mesh/no_such_point", path, f"a triangle refers to a point that is not among the {len(points)} points", "number the points from 0")
    return {"points": _rows(points), "triangles": np.ascontiguousarray(triangles, dtype=np.int32)}


def _numbers(given: Any, path: str) -> Array:
    try:
        return np.asarray(given, dtype=float)
    except (TypeError, ValueError) as why:
        fail("asset/shape", path, f"it is not an array of numbers: {why}", "give an array of numbers")


def _rows(numbers: Array) -> Array:
    return np.ascontiguousarray(numbers, dtype=float)
