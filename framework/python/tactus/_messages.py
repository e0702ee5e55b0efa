# SPDX-License-Identifier: MIT
"""Errors and warnings, in the form that all parts of Tactus use."""

from __future__ import annotations

import os
import sys
import warnings
from contextlib import contextmanager
from types import FrameType
from typing import Any, Iterator, List, NamedTuple, NoReturn, Optional, Sequence, Tuple

from ._words import in_python

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

    def __repr__(self) -> str:
        return f"<tactus.Message {self.id}{' at ' + self.where[:60] if self.where else ''}: {self.text[:80]}>"


class TactusWarning(UserWarning):
    """A warning of Tactus. Its attribute `message` is the Message."""

    def __init__(self, message: Message):
        super().__init__(str(message))
        self.message = message

    def __reduce__(self) -> Tuple[Any, ...]:
        return TactusWarning, (self.message,)

    def __repr__(self) -> str:
        return f"TactusWarning({self.message!r})"


class Error(Exception):
    """What is wrong, where, and what to do about it.

    id, where, text, remedy: those of the first error. messages: all errors and warnings that were found together."""

    def __init__(self, messages: Sequence[Tuple[Any, ...]]):
        self.messages: List[Message] = [Message(*m) for m in messages]
        first = next((m for m in self.messages if m.is_error), self.messages[0])
        self.id, self.where, self.text, self.remedy = first.id, first.where, first.text, first.remedy
        super().__init__("\n".join(str(m) for m in self.messages if m.is_error))

    def __reduce__(self) -> Tuple[Any, ...]:
        return Error, (self.messages,)

    def __repr__(self) -> str:
        return f"tactus.Error({self.id!r}, {self.where[:60]!r}, {self.text[:80]!r})"


def fail(id: str, where: str, text: str, remedy: str) -> NoReturn:
    """Raises an Error with one message."""
    raise Error([Message(True, id, where, text, remedy)])


@contextmanager
def placed(where: str) -> Iterator[None]:
    """Gives a place to an Error that has none."""
    try:
        yield
    except Error as why:
        if why.where:
            raise
        raise Error([m if m.where else m._replace(where=where) for m in why.messages]) from None


def _levels_above() -> int:
    """The stacklevel with which a warning points at the line of the user's code, not at a line of this package."""
    level = 1
    frame: Optional[FrameType] = sys._getframe(1)
    while frame is not None and os.path.dirname(os.path.abspath(frame.f_code.co_filename)) == _HERE:
        level, frame = level + 1, frame.f_back
    return level


def translated(m: Sequence[Any], devices: str = "devices") -> Message:
    """A message of the C++ side, in the words of Python."""
    is_error, id, where, text, remedy, *place = m
    return Message(is_error, id, in_python(where, devices), in_python(text, devices), in_python(remedy, devices), *place)


def report(messages: Sequence[Sequence[Any]]) -> None:
    """Shows warnings, and raises Error if there are errors. The C++ side calls this."""
    all_of_them = [translated(m) for m in messages]
    if any(m.is_error for m in all_of_them):
        raise Error(all_of_them)
    for each in all_of_them:
        warnings.warn(TactusWarning(each), stacklevel=_levels_above())
