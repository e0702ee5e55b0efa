# SPDX-License-Identifier: MIT
"""libtactus_live through ctypes: the structures of its C API (tactus_live.h), its messages, and graphs in it."""

from __future__ import annotations

import ctypes
import os
from typing import Any, List, Optional, Sequence, Union

from ._checks import Path
from ._graph import Graph
from ._messages import Message, fail, report, translated
from ._presets import graph_file


class MessageStruct(ctypes.Structure):
    _fields_ = [("size", ctypes.c_uint32), ("is_error", ctypes.c_int32)] + \
        [(name, ctypes.c_char_p) for name in ("id", "where", "text", "remedy", "file")] + [("line", ctypes.c_int32), ("column", ctypes.c_int32)]


TEXTS = ctypes.POINTER(ctypes.c_char_p)


class OptionsStruct(ctypes.Structure):
    _fields_ = [("size", ctypes.c_uint32), ("devices", TEXTS), ("device_count", ctypes.c_size_t), ("session", ctypes.c_char_p),
                ("clock", ctypes.c_char_p), ("rate_hz", ctypes.c_double), ("duration_s", ctypes.c_double), ("core", ctypes.c_int32),
                ("is_strict", ctypes.c_int32), ("fuses", ctypes.c_int32), ("sets", TEXTS), ("set_count", ctypes.c_size_t),
                ("records", TEXTS), ("record_count", ctypes.c_size_t), ("buffer_s", ctypes.c_double), ("log", ctypes.c_char_p),
                ("assets", ctypes.c_void_p), ("asset_context", ctypes.c_void_p)]


class StatusStruct(ctypes.Structure):
    _fields_ = [("size", ctypes.c_uint32), ("phase", ctypes.c_int32), ("ticks", ctypes.c_uint64), ("late_ticks", ctypes.c_uint64),
                ("force", ctypes.c_double), ("peak_force", ctypes.c_double), ("is_emergency", ctypes.c_int32)]


class HealthStruct(ctypes.Structure):
    _fields_ = [("size", ctypes.c_uint32), ("role", ctypes.c_char_p), ("profile", ctypes.c_char_p), ("is_connected", ctypes.c_int32),
                ("age_s", ctypes.c_double), ("oldest_s", ctypes.c_double), ("rate_hz", ctypes.c_double), ("reports", ctypes.c_uint64),
                ("lost", ctypes.c_uint64), ("departures", ctypes.c_uint64), ("trouble", ctypes.c_char_p)]


_loaded: Optional[ctypes.CDLL] = None


def live() -> ctypes.CDLL:
    """libtactus_live: in this package, as in a wheel; next to the programs in a build folder; under the prefix of this package; or that of the system."""
    global _loaded
    if _loaded is None:
        name = "libtactus_live.so.0"
        here = os.path.dirname(os.path.abspath(__file__))
        path = next((os.path.normpath(p) for p in (f"{here}/{name}", f"{here}/../../bin/{name}", f"{here}/../../../{name}") if os.path.exists(p)), name)
        try:
            library = ctypes.CDLL(path, mode=ctypes.RTLD_GLOBAL)   # global, because code of fused graphs calls its functions
        except OSError as why:
            fail("live/library", name, f"real devices, checks and fits need this library, and it cannot be loaded: {why}",
                 "install the Debian package libtactus-live0, the component `live` of a build, or what the message names")
        for function in ("messages_create", "graph_load", "graph_parse", "session_open", "nodes_json", "check", "limits", "fit", "convert", "devices"):
            getattr(library, "tactus_" + function).restype = ctypes.c_void_p
        for function in ("messages_count", "session_events", "session_record_count", "session_probe_count", "session_collect",
                         "session_health_count"):
            getattr(library, "tactus_" + function).restype = ctypes.c_size_t
        for function in ("session_record_name", "session_record_unit", "session_probe_name", "session_clock"):
            getattr(library, "tactus_" + function).restype = ctypes.c_char_p
        library.tactus_session_rate.restype = ctypes.c_double
        library.tactus_session_lost.restype = ctypes.c_uint64
        _loaded = library
    return _loaded


class Messages:
    """A list of messages of the library, which report() turns into an exception and warnings."""

    def __init__(self) -> None:
        self.handle = ctypes.c_void_p(live().tactus_messages_create())

    def __enter__(self) -> "Messages":
        return self

    def __exit__(self, *_: Any) -> None:
        live().tactus_messages_free(self.handle)

    def take(self) -> List[Message]:
        found = []
        for i in range(live().tactus_messages_count(self.handle)):
            m = MessageStruct(size=ctypes.sizeof(MessageStruct))
            live().tactus_messages_get(self.handle, ctypes.c_size_t(i), ctypes.byref(m))
            parts = [(t or b"").decode(errors="replace") for t in (m.id, m.where, m.text, m.remedy, m.file)]
            found.append(translated([bool(m.is_error), *parts, m.line, m.column], "device"))
        live().tactus_messages_clear(self.handle)
        return found

    def check(self, is_done: bool) -> None:
        """Shows the warnings, and raises Error if the call has failed."""
        found = self.take()
        if not is_done and not any(m.is_error for m in found):
            fail("session/closed", "", "the session is closed, or it belongs to the process that forked this one", "open another session")
        report(found)


def texts(given: Sequence[str]) -> Any:
    """An array of texts."""
    return (ctypes.c_char_p * len(given))(*(t.encode() for t in given))


class Opened:
    """A graph of the library: a copy of a Graph, or a file."""

    def __init__(self, graph: Union[Graph, Path]):
        self._graph = graph

    def __enter__(self) -> ctypes.c_void_p:
        library = live()
        with Messages() as messages:
            if isinstance(self._graph, Graph):
                text = self._graph.text.encode()
                handle = library.tactus_graph_parse(text, ctypes.c_size_t(len(text)), self._graph._graph.folder().encode(), messages.handle)
                for path, file in self._graph._graph.files().items() if handle else ():
                    with Opened(Graph._of(file)) as included:
                        library.tactus_graph_set_file(ctypes.c_void_p(handle), path.encode(), included, messages.handle)
            else:
                handle = library.tactus_graph_load(graph_file(self._graph).encode(), messages.handle)
            messages.check(bool(handle))
        self._handle = ctypes.c_void_p(handle)
        return self._handle

    def __exit__(self, *_: Any) -> None:
        live().tactus_graph_free(self._handle)
