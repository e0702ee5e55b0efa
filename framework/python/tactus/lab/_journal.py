# SPDX-License-Identifier: MIT
"""The journal of a session: one line of JSON for each event, on the disk before the next event. Lines are only added."""

from __future__ import annotations

import io
import json
import os
import pathlib
from typing import Any, BinaryIO, Dict, List, Optional

from .._messages import fail

try:
    import fcntl
except ImportError:   # Windows
    fcntl = None   # type: ignore[assignment]

Event = Dict[str, Any]


def read(path: pathlib.Path) -> List[Event]:
    """The events of a journal, the header first. A line that was cut off by a crash is left out: it is the last one, or a line `resumed` follows it."""
    events: List[Event] = []
    try:
        lines = [line for line in path.read_bytes().split(b"\n") if line]
    except OSError as why:
        fail("lab/journal", str(path), f"the journal cannot be read: {why.strerror}",
             "begin the session without --resume, or give its --out, --participant and --session")
    for number, (line, after) in enumerate(zip(lines, [*lines[1:], None]), 1):
        try:
            event = json.loads(line)
            if not isinstance(event, dict):
                raise ValueError("it is not an object")
        except ValueError as why:
            if after is None or after.startswith(b'{"event": "resumed"'):
                continue
            fail("lab/journal", f"{path}:{number}", f"the line cannot be read: {why}", "restore the file from a copy; lines of a journal must not be edited")
        events.append(event)
    if not events or events[0].get("format") != "tactus-journal" or events[0].get("version") != 1:
        fail("lab/journal", str(path), "the file is not a journal of version 1", "give the journal of a session")
    return events


def lock(file: BinaryIO, is_shared: bool = False) -> bool:
    """Keeps other processes away from a file until it is closed, or those that do not share it. False if one of them keeps it. Not on Windows."""
    try:
        if fcntl is not None:
            fcntl.flock(file, (fcntl.LOCK_SH if is_shared else fcntl.LOCK_EX) | fcntl.LOCK_NB)
    except OSError:
        return False
    return True


class Journal(io.FileIO):
    """A journal to which events are added, by one process at a time."""

    def __init__(self, path: pathlib.Path, header: Optional[Event]):
        """header: the first line of a new file; None to go on with one."""
        try:
            super().__init__(path, "xb" if header is not None else "ab")
        except FileExistsError:
            fail("lab/exists", str(path), "the session already exists", "resume it (--resume), or choose another session")
        if not lock(self):
            self.close()
            fail("lab/busy", str(path), "another process is running this session", "wait until it ends, or end it")
        if header is None:
            if path.read_bytes()[-1:] != b"\n":   # a crash has cut the last line off
                self.write(b"\n")
        else:
            self.add({"format": "tactus-journal", "version": 1, **header})
            if os.name == "posix":
                folder = os.open(path.parent, os.O_RDONLY)
                os.fsync(folder)   # the name of the file, too
                os.close(folder)

    def add(self, event: Event) -> None:
        """Writes an event; returns once it is on the disk."""
        data = json.dumps(event, ensure_ascii=False, allow_nan=False).encode() + b"\n"
        while data:
            data = data[self.write(data):]
        os.fsync(self.fileno())
