# SPDX-License-Identifier: MIT
"""Errors and warnings, in the form that all parts of Tactus use."""

from __future__ import annotations

import os
import sys
import warnings
from typing import NamedTuple, Sequence

_HERE = os.path.dirname(os.path.abspath(__file__))


class Message(NamedTuple):
    """An error or a warning.

    id is stable, such as "unit/mismatch". where is a JSON pointer into the graph, a file, or "". line and column count from 1, and are 0
    if unknown."""

    is_error: bool
    id: str
    where: str
    text: str
    remedy: str
    file: str = ""
    line: int = 0
    column: int = 0

    def __str__(self) -> str:
        place = f"{self.file}:{self.line}:{self.column}: " if self.line else ""
        return f"{place}{self.where + ': ' if self.where else ''}{self.text}{'; ' + self.remedy if self.remedy else ''} [{self.id}]"


class TactusWarning(UserWarning):
    """A warning of Tactus. Its attribute `message` is the Message."""

    def __init__(self, message: Message):
        super().__init__(str(message))
        self.message = message

    def __reduce__(self):
        return TactusWarning, (self.message,)


class Error(Exception):
    """What is wrong, where, and what to do about it.

    id, where, text, remedy: those of the first error. messages: all errors and warnings that were found together."""

    def __init__(self, messages: Sequence[Message]):
        self.messages = [Message(*m) for m in messages]
        first = next((m for m in self.messages if m.is_error), self.messages[0])
        self.id, self.where, self.text, self.remedy = first.id, first.where, first.text, first.remedy
        super().__init__("\n".join(str(m) for m in self.messages if m.is_error))

    def __reduce__(self):
        return Error, (self.messages,)


def fail(id: str, where: str, text: str, remedy: str):
    """Raises an Error with one message."""
    raise Error([Message(True, id, where, text, remedy)])


def _levels_above() -> int:
    """The stacklevel with which a warning points at the line of the user's code, not at a line of this package."""
    level, frame = 1, sys._getframe(1)
    while frame is not None and os.path.dirname(os.path.abspath(frame.f_code.co_filename)) == _HERE:
        level, frame = level + 1, frame.f_back
    return level


def report(messages: Sequence[tuple]) -> None:
    """Shows warnings, and raises Error if there are errors. The C++ side calls this."""
    all_of_them = [Message(*m) for m in messages]
    if any(m.is_error for m in all_of_them):
        raise Error(all_of_them)
    for m in all_of_them:
        warnings.warn(TactusWarning(m), stacklevel=_levels_above())
