# SPDX-License-Identifier: MIT
"""Nodes of your own, in plugins. libtactus_live finds, checks and loads them; this module then gives them to the C++ side of this package, too."""

from __future__ import annotations

import atexit
import ctypes
import json
import os
import shutil
import tempfile
from typing import Any, Dict, Iterable, List, Optional

from . import _checks, _tactus
from ._checks import Path

_known: Dict[str, str] = {}   # the plugins of nodes in both libraries, by id
_folder = ""                  # of what compile_node has made
_compiled = 0


@_checks.arguments
def load_plugins(path: Optional[Path] = None) -> List[str]:
    """Loads nodes from plugins, for graphs that are made, rendered, stepped or played from now on. The rules of trust are those of `tactus play`.

    path: a plugin, or a folder of plugins, whose device drivers `play` then finds, too. Without it, those that `tactus play` loads: in the folders
        of the environment variable TACTUS_PLUGINS, in that of the user, and in that of the system.

    Returns the ids of the nodes that are new. What was refused is an Error, and the rest is loaded; without a path, it is a warning. Engines and
    sessions that exist keep their nodes. Call it while no other thread uses this package. A graph that is sent to another process, such as a worker of
    `sweep`, loads there the plugins that it needs, so their files must be there."""
    where = None if path is None else _checks.path("path", path).encode()
    return _load("tactus_plugins_load", where)


@_checks.arguments
def compile_node(header: Path) -> str:
    """Compiles the header of a node in C++, which ends with a line TACTUS_NODE (docs/plugins.md), and loads it. Returns the id of the node.

    It replaces a node of the same id, such as an earlier version of itself, for graphs that are compiled from now on. If it fails, graphs still get the
    version that was loaded last. It needs a C++ compiler and the development files of Tactus, and takes some seconds of a processor. The compiled file
    exists until the program ends."""
    from ._library import Messages, live

    global _folder, _compiled
    if not _folder:
        _folder = tempfile.mkdtemp(prefix="tactus-nodes-")
        atexit.register(_remove, _folder, os.getpid())
    source = _checks.path("header", header)
    _compiled += 1   # a new file each time, because the system does not load a file twice
    plugin = os.path.join(_folder, f"{os.path.splitext(os.path.basename(source))[0]}-{_compiled}.tactus")
    with Messages() as messages:
        done = live().tactus_plugins_compile(os.fsencode(source), os.fsencode(plugin), messages.handle)
        messages.check(done == 0)
    return _load("tactus_plugins_replace", os.fsencode(plugin))[0]


def plugins_of(texts: Iterable[str]) -> List[str]:
    """The plugins whose nodes these graphs use, by their text."""
    return sorted({file for id, file in _known.items() if any(json.dumps(id) in text for text in texts)})


def need(plugins: Iterable[str]) -> None:
    """Loads the plugins that this process lacks."""
    for file in plugins:
        if file not in _known.values():
            _load("tactus_plugins_replace", os.fsencode(file))


def _load(function: str, path: Optional[bytes]) -> List[str]:
    from ._library import Messages, live

    with Messages() as messages:
        done = getattr(live(), function)(path, messages.handle)
        new = _share()
        messages.check(done == 0)
    return new


def _share() -> List[str]:
    """Gives the nodes that libtactus_live has from plugins to the C++ side of this package."""
    from ._library import live

    library = live()
    text = library.tactus_nodes_json()
    try:
        sheets: List[Dict[str, Any]] = json.loads(ctypes.string_at(text)) if text else []
    finally:
        library.tactus_text_free(ctypes.c_void_p(text))
    files: Dict[str, List[str]] = {}
    for sheet in sheets:
        if "plugin" in sheet and _known.get(sheet["id"]) != sheet["plugin"]:
            files.setdefault(sheet["plugin"], []).append(sheet["id"])
    for file, ids in files.items():
        _tactus.load_plugin(file, ids)
        _known.update(dict.fromkeys(ids, file))
    return sorted(id for ids in files.values() for id in ids)


def _remove(folder: str, process: int) -> None:
    if os.getpid() == process:   # not the child of a fork
        shutil.rmtree(folder, ignore_errors=True)
