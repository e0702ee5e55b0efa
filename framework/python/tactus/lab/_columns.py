# SPDX-License-Identifier: MIT
"""Files of columns: what a study writes. docs/studies.md describes the format, with a reader of its own."""

from __future__ import annotations

import json
import os
import pathlib
import shutil
import struct
import tempfile
from typing import Any, BinaryIO, Callable, Dict, Iterator, List, Mapping, Union

import numpy as np

from .._messages import fail

MAGIC = b"TACTCOL1"
BLOCK = 4096   # rows of a large table that are in memory at a time
Values = Any   # an array of numbers, shape (n,) or (n, k); or a list of texts; or a list of arrays


class _Column:
    """A column that is being written: its type, and its bytes in files that vanish. Texts and lists have one more file, of where each ends."""

    def __init__(self, values: Values, folder: pathlib.Path):
        if isinstance(values, list):
            self.about: Dict[str, Any] = {"type": "text" if isinstance(values[0], str) else "list"}
        else:
            self.about = {"type": {"f": "<f8", "i": "<i4", "u": "|u1"}[values.dtype.kind], "shape": list(values.shape[1:])}
        self.files: List[Any] = [tempfile.TemporaryFile(dir=folder) for _ in range(2 if isinstance(values, list) else 1)]
        self.end = 0
        if isinstance(values, list):
            self.files[0].write(bytes(8))

    def add(self, values: Values) -> None:
        if not isinstance(values, list):
            self.files[0].write(values.astype(self.about["type"], copy=False).tobytes())
            return
        is_text = self.about["type"] == "text"
        each = [v.encode(errors="replace") for v in values] if is_text else [np.ascontiguousarray(v, "<f8").tobytes() for v in values]
        ends = self.end + np.cumsum([len(data) if is_text else len(data) // 8 for data in each], dtype="<u8")
        self.files[0].write(ends.tobytes())
        self.files[1].writelines(each)
        self.end = int(ends[-1])


class Writer:
    """Writes columns of one length, some rows at a time, so that few of them are in memory."""

    def __init__(self, path: pathlib.Path):
        self._path, self._rows = path, 0
        self._columns: Dict[str, _Column] = {}

    def add(self, columns: Mapping[str, Values]) -> None:
        """Adds rows, at least one."""
        for name, values in columns.items():
            self._columns.setdefault(name, _Column(values, self._path.parent) if name not in self._columns else self._columns[name]).add(values)
        self._rows += len(next(iter(columns.values())))

    def close(self, about: Mapping[str, Any], units: Mapping[str, str]) -> None:
        """Makes the file. After a crash, either the old file or the new one exists."""
        entries, at = [], 0
        for name, column in self._columns.items():
            size = sum(file.tell() for file in column.files)
            if "shape" in column.about:
                column.about["shape"].insert(0, self._rows)
            entries.append({**column.about, "name": name, "unit": units.get(name, ""), "at": at, "bytes": size})
            at += size + -size % 64
        header = json.dumps({**about, "rows": self._rows, "columns": entries}, ensure_ascii=False, sort_keys=True).encode()
        header += b" " * (-(len(header) + 16) % 64)

        def put(out: BinaryIO) -> None:
            out.write(MAGIC + struct.pack("<Q", len(header)) + header)
            for column in self._columns.values():
                for file in column.files:
                    file.seek(0)
                    shutil.copyfileobj(file, out)
                    file.close()
                out.write(bytes(-out.tell() % 64))

        replace(self._path, put)


def replace(path: pathlib.Path, put: Callable[[BinaryIO], Any]) -> None:
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


class Results(Mapping[str, Values]):
    """The merged results of a study: columns by name, one row for each point. about: the header of their file."""

    def __init__(self, path: Union[str, "os.PathLike[str]"], keeps: bool = True):
        """keeps: all columns are read at once, and kept; otherwise each is read whenever it is asked for."""
        self.path = pathlib.Path(path)
        try:
            with open(path, "rb") as file:
                start = file.read(16)
                if start[:8] != MAGIC:
                    raise ValueError("it does not begin with TACTCOL1")
                self._start = 16 + struct.unpack_from("<Q", start, 8)[0]
                self.about: Dict[str, Any] = json.loads(file.read(self._start - 16).decode())
                self._entries = {entry["name"]: entry for entry in self.about["columns"]}
                if any(self._start + entry["at"] + entry["bytes"] > os.fstat(file.fileno()).st_size for entry in self.about["columns"]):
                    raise ValueError("it was cut off")
            self._kept: Dict[str, Values] = {}
            self._kept = dict(self) if keeps else {}
        except (OSError, ValueError, KeyError, TypeError, OverflowError, struct.error) as why:
            fail("study/unreadable", os.fspath(path), f"the file of columns cannot be read: {why}", "merge the study again")

    @property
    def rows(self) -> int:
        """The number of points."""
        return int(self.about["rows"])

    def __iter__(self) -> Iterator[str]:
        return iter(self._entries)

    def __len__(self) -> int:
        return len(self._entries)

    def __getitem__(self, name: str) -> Values:
        if name in self._kept:
            return self._kept[name]
        entry = self._entries[name]
        with open(self.path, "rb") as file:
            file.seek(self._start + entry["at"])
            if "shape" in entry:
                return np.fromfile(file, entry["type"], int(np.prod(entry["shape"]))).reshape(entry["shape"])
            ends = np.fromfile(file, "<u8", self.rows + 1)
            if entry["type"] == "list":
                return np.split(np.fromfile(file, "<f8", ends[-1]), ends[1:-1])
            return [file.read(size).decode() if size else "" for size in np.diff(ends)]
