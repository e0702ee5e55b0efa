# SPDX-License-Identifier: MIT
"""The presets that come with the package."""

from __future__ import annotations

import difflib
import os
from typing import List, Tuple

from ._checks import Path, path
from ._messages import fail

_HERE = os.path.dirname(os.path.abspath(__file__))
_BESIDE = ("graphs", "../../../../share/tactus/graphs", "../../../../graphs")   # in a wheel, installed, in a build folder


def _folder() -> str:
    """Where the presets are; "" if nowhere."""
    if given := os.environ.get("TACTUS_PRESETS"):
        return given
    return next((found for place in _BESIDE if os.path.isdir(found := os.path.normpath(os.path.join(_HERE, place)))), "")


def presets() -> List[str]:
    """The names of the presets: tactus.Graph("dry_wood") reads the one called "dry_wood"."""
    try:
        return sorted(name[:-len(".json")] for name in os.listdir(_folder() or os.curdir) if name.endswith(".json")) if _folder() else []
    except OSError:
        return []


def graph_file(given: Path) -> str:
    """The file of a graph: the path itself or, for a bare name that is not a file, that of the preset."""
    name = path("path", given, "give the path of a graph file, or the name of a preset such as 'dry_wood'")
    known = presets()
    base = os.path.splitext(os.path.basename(name))[0]
    if base != name and base in known and not os.path.exists(name):
        fail("file/unreadable", name, "there is no such file", f"there is a preset of this name: tactus.Graph({base!r})")
    if not name or os.path.dirname(name) or os.path.splitext(name)[1] or os.path.exists(name):
        return name
    if name in known:
        return os.path.join(_folder(), name + ".json")
    near: Tuple[str, ...] = tuple(difflib.get_close_matches(name, known, 1))
    fail("file/unreadable", name, f"there is neither a file nor a preset called '{name}'" + (f" (did you mean '{near[0]}'?)" if near else ""),
         "give the path of a graph file, or one of tactus.presets()" if known else "give the path of a graph file; no presets are installed")
