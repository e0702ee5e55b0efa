# SPDX-License-Identifier: MIT
"""Dataclasses as JSON: a strict reader, a writer, and the JSON schema of a dataclass."""

from __future__ import annotations

import dataclasses
import difflib
import json
import math
import os
import pathlib
import typing
from typing import Any, Dict, Literal, Mapping, Type, TypeVar, Union

from .._checks import shown
from .._messages import fail, placed

T = TypeVar("T")


def read(kind: Type[T], value: Any, where: str = "") -> T:
    """The dataclass for a JSON value. `where` is the JSON pointer of the value, which messages name."""
    return typing.cast(T, _read(kind, value, where, {}))


def write(value: Any) -> Any:
    """A dataclass as a JSON value, without what has its default; what says the kind stays."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return {f.name: write(getattr(value, f.name)) for f in dataclasses.fields(value) if f.name == "kind" or getattr(value, f.name) != _default(f)}
    if isinstance(value, (list, tuple)):
        return [write(each) for each in value]
    if isinstance(value, Mapping):
        return {key: write(each) for key, each in value.items()}
    return value


def json_in(path: Union[str, "os.PathLike[str]"]) -> Any:
    """The JSON in a file."""
    try:
        return json.loads(pathlib.Path(path).read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError) as why:
        fail("lab/unreadable", os.fspath(path), f"the file cannot be read: {why}", "give a JSON file")


def load(kind: Type[T], path: Union[str, "os.PathLike[str]"]) -> T:
    """The dataclass in a JSON file. Its field `folder` becomes that of the file, or one relative to it. Errors name the place in it as a JSON pointer."""
    data = json_in(path)
    if isinstance(data, dict):
        data["folder"] = os.path.join(os.path.dirname(os.path.abspath(path)), str(data.get("folder", "")))
    with placed(os.fspath(path)):
        return read(kind, data)


def text(value: Any) -> str:
    """A dataclass as the text of a file."""
    return json.dumps({"format": value.format, "version": value.version, **{k: v for k, v in write(value).items() if k != "folder"}},
                      indent=2, ensure_ascii=False) + "\n"


def schema(kind: Any, about: Mapping[str, Any] = {}) -> Dict[str, Any]:
    """The JSON schema (draft 2020-12) of a type."""
    origin, inner = typing.get_origin(kind), typing.get_args(kind)
    found: Dict[str, Any] = {"description": about["about"]} if "about" in about else {}
    if origin is Union:
        return {**found, **(schema(inner[0], about) if type(None) in inner else {"oneOf": [schema(each) for each in inner]})}
    if origin is Literal:
        return {**found, "enum": list(inner)}
    if origin in (list, tuple):
        return {**found, "type": "array", "items": schema(inner[0]), **({"minItems": about["fewest"]} if "fewest" in about else {})}
    if origin is dict:
        return {**found, "type": "object", "additionalProperties": schema(inner[1])}
    if dataclasses.is_dataclass(kind):
        hints = typing.get_type_hints(kind)
        fields = dataclasses.fields(kind)
        needed = [f.name for f in fields if f.name == "kind" or _default(f) is dataclasses.MISSING]
        return {**found, "type": "object", "description": " ".join((found.get("description") or kind.__doc__ or "").split()), "additionalProperties": False,
                "properties": {f.name: schema(hints[f.name], f.metadata) for f in fields}, **({"required": needed} if needed else {})}
    bounds = {name: about[key] for key, name in (("low", "minimum"), ("above", "exclusiveMinimum"), ("high", "maximum")) if key in about}
    types = {int: "integer", float: "number", str: "string", bool: "boolean"}
    return {**found, **({"type": types[kind]} if kind in types else {}), **bounds}


def _default(field: Any) -> Any:
    return field.default_factory() if field.default_factory is not dataclasses.MISSING else field.default


def _wrong(where: str, value: Any, what: str) -> typing.NoReturn:
    fail("lab/type", where or "/", f"{shown(value)} is not {what}", f"give {what}; `python3 -m tactus.lab schema` prints what is allowed")


def _read(kind: Any, value: Any, where: str, about: Mapping[str, Any]) -> Any:
    origin, inner = typing.get_origin(kind), typing.get_args(kind)
    if origin is Union:
        if type(None) in inner:   # Optional
            return None if value is None else _read(inner[0], value, where, about)
        kinds = {_default(dataclasses.fields(each)[0]): each for each in inner}   # the first field says the kind
        if not isinstance(value, Mapping) or value.get("kind") not in kinds:
            _wrong(where, value, f"an object whose kind is one of {', '.join(kinds)}")
        return _read(kinds[value["kind"]], value, where, about)
    if origin is Literal:
        if value not in inner or isinstance(value, bool):
            _wrong(where, value, f"one of {', '.join(map(str, inner))}")
        return value
    if origin in (list, tuple):
        if not isinstance(value, (list, tuple)) or len(value) < about.get("fewest", 0):
            _wrong(where, value, f"a list of at least {about['fewest']}" if "fewest" in about else "a list")
        return origin(_read(inner[0], each, f"{where}/{i}", {}) for i, each in enumerate(value))
    if origin is dict:
        if not isinstance(value, Mapping):
            _wrong(where, value, "an object with names")
        return {key: _read(inner[1], each, f"{where}/{key}", {}) for key, each in value.items()}
    if kind in (int, float):
        return _read_number(kind, value, where, about)
    if kind in (str, bool) and not isinstance(value, kind):
        _wrong(where, value, "text" if kind is str else "true or false")
    if not dataclasses.is_dataclass(kind):
        return value
    if not isinstance(value, Mapping):
        _wrong(where, value, f"an object ({kind.__name__})")
    fields, hints = {f.name: f for f in dataclasses.fields(kind)}, typing.get_type_hints(kind)
    for key in value:
        if key not in fields:
            near = difflib.get_close_matches(str(key), fields, 1)
            fail("lab/unknown_key", f"{where}/{key}", f"there is no key '{key}' here" + (f" (did you mean '{near[0]}'?)" if near else ""),
                 f"the keys: {', '.join(fields)}")
    for name, f in fields.items():
        if name not in value and _default(f) is dataclasses.MISSING:
            fail("lab/missing", where or "/", f"the key '{name}' is missing", f"{name}: {f.metadata.get('about', 'give it')}")
    return kind(**{name: _read(hints[name], value[name] if name in value else write(_default(f)), f"{where}/{name}", f.metadata) for name, f in fields.items()})


def _read_number(kind: Any, value: Any, where: str, about: Mapping[str, Any]) -> Any:
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) <= 1.7e308
    if not is_number or kind is int and value != int(value):
        _wrong(where, value, "a whole number" if kind is int else "a finite number")
    low, high, above = about.get("low", -math.inf), about.get("high", math.inf), about.get("above", -math.inf)
    if not (low <= value <= high and value > above):
        fail("lab/value", where, f"{value:g} is out of range", f"give a number {f'above {above:g}' if 'above' in about else f'from {low:g}'}"
             + (f", at most {high:g}" if high < math.inf else ""))
    return kind(value)
