# SPDX-License-Identifier: MIT
"""Files of columns: what a study writes. docs/studies.md describes the format, with a reader of its own."""

from __future__ import annotations

import json
import os
import pathlib
import struct
from typing import Any, BinaryIO, Dict, List, Mapping, Sequence, Tuple, Union

import numpy as np

from .._messages import fail

MAGIC = b"TACTCOL1"
Values = Any   # an array of numbers, shape (n,) or (n, k); or a list of texts; or a list of arrays


def _packed(name: str, values: Values, unit: str) -> Tuple[Dict[str, Any], List[bytes]]:
    """The entry of a column in the header, without its place, and its bytes."""
    if isinstance(values, list):
        is_text = not values or isinstance(values[0], str)
        each = [v.encode() for v in values] if is_text else [np.ascontiguousarray(v, "<f8").tobytes() for v in values]
        ends = np.concatenate([[0], np.cumsum([len(data) for data in each], dtype="<u8")]).astype("<u8")
        return {"name": name, "type": "text" if is_text else "list", "unit": unit}, [(ends if is_text else ends // 8).astype("<u8").tobytes(), *each]
    array = np.ascontiguousarray(values)
    kind = {"f": "<f8", "i": "<i4", "u": "|u1"}[array.dtype.kind]
    return {"name": name, "type": kind, "unit": unit, "shape": list(array.shape)}, [array.astype(kind, copy=False).tobytes()]


def write(path: pathlib.Path, columns: Mapping[str, Values], about: Mapping[str, Any], units: Mapping[str, str]) -> None:
    """Writes columns of one length. After a crash, either the old file or the new one exists."""
    entries, parts, at = [], [], 0
    for name, values in columns.items():
        entry, data = _packed(name, values, units.get(name, ""))
        size = sum(map(len, data))
        entries.append({**entry, "at": at, "bytes": size})
        parts += [*data, bytes(-size % 64)]
        at += size + -size % 64
    header = json.dumps({**about, "columns": entries}, ensure_ascii=False, sort_keys=True).encode()
    header += b" " * (-(len(header) + 16) % 64)

    def put(file: BinaryIO) -> None:
        file.write(MAGIC + struct.pack("<Q", len(header)) + header)
        file.writelines(parts)

    replace(path, put)


def replace(path: pathlib.Path, put: Any) -> None:
    """Writes a file that takes the place of an old one when it is complete and on the disk."""
    part = path.with_name(f"{path.name}.{os.getpid()}.new")
    try:
        with open(part, "wb") as file:
            put(file)
            file.flush()
            os.fsync(file.fileno())
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)


def read(path: Union[str, "os.PathLike[str]"]) -> Tuple[Dict[str, Values], Dict[str, Any]]:
    """The columns of a file by name, and its header."""
    try:
        data = pathlib.Path(path).read_bytes()
        if data[:8] != MAGIC:
            raise ValueError("it does not begin with TACTCOL1")
        start = 16 + struct.unpack_from("<Q", data, 8)[0]
        about: Dict[str, Any] = json.loads(data[16:start].decode())
        columns: Dict[str, Values] = {}
        for entry in about["columns"]:
            at, n = start + entry["at"], about["rows"]
            if at + entry["bytes"] > len(data):
                raise ValueError("it was cut off")
            if entry["type"] in ("text", "list"):
                ends = np.frombuffer(data, "<u8", n + 1, at).astype(np.int64)
                at += 8 * (n + 1)
                if entry["type"] == "text":
                    columns[entry["name"]] = [data[at + a:at + b].decode() for a, b in zip(ends, ends[1:])]
                else:
                    columns[entry["name"]] = [np.frombuffer(data, "<f8", b - a, at + 8 * a) for a, b in zip(ends, ends[1:])]
            else:
                columns[entry["name"]] = np.frombuffer(data, entry["type"], int(np.prod(entry["shape"])), at).reshape(entry["shape"])
        return columns, about
    except (OSError, ValueError, KeyError, TypeError, struct.error) as why:
        fail("study/unreadable", os.fspath(path), f"the file of columns cannot be read: {why}", "merge the study again")


def numbers_or_texts(texts: Sequence[str]) -> Values:
    """JSON values as an array if all are numbers, otherwise as texts."""
    known: Dict[str, Any] = {text: json.loads(text) for text in set(texts)}
    if all(isinstance(v, (int, float)) and not isinstance(v, bool) for v in known.values()):
        return np.array([known[text] for text in texts], "<f8")
    return [known[text] if isinstance(known[text], str) else text for text in texts]
