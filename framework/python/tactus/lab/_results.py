# SPDX-License-Identifier: MIT
"""The results of a study in a folder. Each process adds chunks to a journal of its own, a part; a merge makes one table of them. docs/studies.md describes
it."""

from __future__ import annotations

import base64
import collections
import contextlib
import functools
import itertools
import json
import os
import pathlib
import shutil
import socket
import tempfile
import uuid
import zipfile
import zlib
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, IO, Any, BinaryIO, Callable, Dict, Iterator, List, Mapping, Set, Tuple, Union

import numpy as np

from .._messages import fail
from ._journal import Journal

if TYPE_CHECKING:
    from ._study import Prepared

BLOCK = 4096   # points that are in memory at a time
Path = Union[str, "os.PathLike[str]"]
Stamp = Tuple[str, str]   # the version of Tactus, and the mark of the computer
ENTRY = np.dtype([("key", "S16"), ("row", ">u4")])   # its bytes are in the order of addresses and rows
_load: Any = np.load   # numpy has no types for these
_format: Any = np.lib.format


@contextlib.contextmanager
def disk(folder: pathlib.Path, kept: str) -> Iterator[None]:
    """What cannot be written is an Error."""
    try:
        yield
    except OSError as why:
        fail("study/disk", str(folder), f"the results cannot be written: {why.strerror}; {kept}", "make room, and go on with --resume")


def row_type(columns: int) -> Any:
    """The type of the rows of a chunk. ticks: of the traces of the point. bad: it has an error."""
    return np.dtype([("key", "S16"), ("seconds", "<f8"), ("ticks", "<i8"), ("bad", "?"), ("numbers", "<f8", (columns,))])


@dataclass
class Chunk:
    """What is kept of some points."""

    rows: Any   # one of row_type() for each point
    stamp: Stamp
    worker: str   # host and process
    errors: Dict[str, List[str]] = field(default_factory=dict)   # by row: id and text, and the place
    kept: List[str] = field(default_factory=list)   # the columns of traces
    traces: List[Any] = field(default_factory=list)   # by row: shape (ticks, columns); or none at all
    warnings: Dict[str, str] = field(default_factory=dict)   # one of each kind and place

    def to_json(self) -> Any:
        """What is written of it."""
        rows, traces = (base64.b64encode(b"".join(each.tobytes() for each in arrays)).decode() for arrays in ([self.rows], self.traces))
        return checked({"rows": rows, "traces": traces, "worker": self.worker, "errors": self.errors, "kept": self.kept})

    @staticmethod
    def of_json(data: Any, stamp: Stamp, columns: int) -> "Chunk":
        """A chunk that was written."""
        rows, kept = np.frombuffer(base64.b64decode(data["rows"]), row_type(columns)), data["kept"]
        traces = np.split(np.frombuffer(base64.b64decode(data["traces"])).reshape(-1, len(kept)), np.cumsum(rows["ticks"])[:-1]) if kept else []
        return Chunk(rows, stamp, data["worker"], data["errors"], kept, traces)

    def result(self, row: int) -> Tuple[Any, ...]:
        """The values that must be the same in two results of one point."""
        return self.rows["numbers"][row].tobytes(), self.errors.get(str(row)), self.traces[row].tobytes() if self.traces else b""


def checked(data: Any) -> Dict[str, Any]:
    """A line of a part, with a checksum."""
    return {"data": data, "check": zlib.crc32(json.dumps(data).encode())}


def part(folder: pathlib.Path, context: bytes, stamp: Stamp) -> Journal:
    """A part that this process adds to."""
    return Journal(folder / "parts" / f"{socket.gethostname()}-{os.getpid()}-{uuid.uuid4().hex}.part", checked([context.hex(), *stamp]))


def lines(path: pathlib.Path) -> Iterator[Tuple[int, Any]]:
    """Where the lines of a part begin, and what they hold. What a crash has cut off or damaged is left out."""
    at = 0
    with open(path, "rb") as file:
        for line in file:
            with contextlib.suppress(ValueError, LookupError):
                found = json.loads(line)
                if checked(found["data"]).items() <= found.items():
                    yield at, found["data"]
            at += len(line)


def accept(folder: pathlib.Path, stamps: Set[Stamp], mixed: bool) -> None:
    """Refuses results of several versions, or of computers that compute differently."""
    if len(stamps) > 1 and not mixed:
        fail("study/other_version", str(folder), f"results from {' and '.join(f'Tactus {v} on {c}' for v, c in sorted(stamps))} may differ in their last bits",
             "use what the study began with, choose another folder, or take and mark such results with --mixed")


class Held:
    """The results in a folder. Their rows, and where the row of each address is, are in two files that vanish, so any number of points needs the same
    memory."""

    def __init__(self, prepared: "Prepared", folder: pathlib.Path, mixed: bool, stamps: Set[Stamp]):
        """stamps: of the process that will add to them."""
        self._folder, self._measures, self._type = folder, prepared.study.columns, row_type(len(prepared.study.columns))
        self.kept: List[str] = []   # the columns of traces
        if not (folder / "parts").is_dir():
            fail("study/no_results", str(folder), "the folder has no results", "run the study first, or name its --out")
        headers = sorted((data, path) for path in (folder / "parts").glob("*.part") for at, data in itertools.islice(lines(path), 1) if at == 0)
        if any(study != prepared.context.hex() for (study, *_), _ in headers):
            fail("study/other", str(folder), "the folder has results of another study: the graph, its files, the measures or the names of factors differ",
                 "choose another folder with --out")
        parts = [((version, computer), path) for (_, version, computer), path in headers]   # the results of equal computers follow each other
        accept(folder, {stamp for stamp, _ in parts} | stamps, mixed)
        self._chunks: List[Tuple[Stamp, pathlib.Path, int, str]] = []   # of whom, in which file, where, by which worker
        self._ends = [0]   # where the rows of each chunk end
        self.chunk = functools.lru_cache(4)(self._chunk)   # points that follow each other are often in one chunk
        with disk(folder, "none is lost"):
            self._rows, self._index = (tempfile.TemporaryFile(dir=folder) for _ in range(2))
            for chunk, path, at in ((Chunk.of_json(data, stamp, len(self._measures)), path, at) for stamp, path in parts for at, data in lines(path) if at > 0):
                entries = np.zeros(len(chunk.rows), ENTRY)
                entries["key"], entries["row"] = chunk.rows["key"], np.arange(self.count, self.count + len(entries))
                self._rows.write(chunk.rows.tobytes())
                self._index.write(entries.tobytes())
                self._chunks.append((chunk.stamp, path, at, chunk.worker))
                self._ends.append(self.count + len(entries))
                self.kept = self.kept or chunk.kept
            self._rows.write(bytes(self._type.itemsize))
            self._index.write(b"\xff" * 2 * ENTRY.itemsize)   # each search finds an address, and one after it
            self._rows.flush()
            self._index.flush()
            np.memmap(self._index, f"S{ENTRY.itemsize}", "r+").sort()

    @property
    def count(self) -> int:
        """The number of results."""
        return self._ends[-1]

    def _chunk(self, number: int) -> Chunk:
        stamp, path, at, _ = self._chunks[number]
        with open(path, "rb") as file:
            file.seek(at)
            return Chunk.of_json(json.loads(file.readline())["data"], stamp, len(self._measures))

    def _result(self, row: int) -> Tuple[Chunk, int]:
        number = int(np.searchsorted(self._ends, row, "right")) - 1
        return self.chunk(number), row - self._ends[number]

    def find(self, keys: Any) -> Tuple[Any, Any]:
        """By key: whether there is a result, and its row; of several, the first one, if those of equal computers are equal."""
        index = np.memmap(self._index, ENTRY, "r")
        at = np.searchsorted(index["key"], keys)
        known = index["key"][at] == keys
        for k in at[known & (index["key"][at + 1] == keys)].tolist():
            seen: Dict[Stamp, Any] = {}
            for entry in itertools.takewhile(lambda entry: entry["key"] == index["key"][k], index[k:]):
                chunk, row = self._result(int(entry["row"]))
                if seen.setdefault(chunk.stamp, chunk.result(row)) != chunk.result(row):
                    fail("study/differs", str(self._folder), f"a point was rendered twice, and its results differ (key {entry['key'].hex()})",
                         "a function of the study may depend on more than its arguments; correct it, and begin in another folder")
        return known, np.where(known, index["row"][at], self.count).astype(int)

    def rows(self, numbers: Any = slice(-1)) -> Any:
        """Some rows."""
        return np.asarray(np.memmap(self._rows, self._type, "r")[numbers])

    def columns(self, keys: Any) -> Dict[str, Any]:
        """The results of some points by column."""
        known, numbers = self.find(keys)
        rows, chunks = self.rows(numbers), np.searchsorted(self._ends, numbers, "right") - 1
        rows["numbers"][~known], rows["seconds"][~known] = np.nan, np.nan
        texts = {name: np.full(len(keys), "", object) for name in ("worker", "part", "error", "error_place", "origin")}
        texts["error"][~known] = "study/missing: the point has no result yet"
        for number in np.unique(chunks[known]).tolist():
            stamp, path, _, worker = self._chunks[number]
            for name, text in (("worker", worker), ("part", path.name), ("origin", " on ".join(stamp))):
                texts[name][chunks == number] = text
        traces = [np.zeros((0, len(self.kept)))] * len(keys)
        for k in np.flatnonzero(known if self.kept else known & rows["bad"]).tolist():
            chunk, row = self._result(int(numbers[k]))
            texts["error"][k], texts["error_place"][k] = chunk.errors.get(str(row), ["", ""])
            traces[k] = chunk.traces[row] if chunk.traces else traces[k]
        joined = np.concatenate(traces)
        return {"seconds": rows["seconds"], "worker": texts.pop("worker"), "part": texts.pop("part"),
                **{name: rows["numbers"][:, i] for i, name in enumerate(self._measures)}, **texts, **({"ticks": rows["ticks"]} if self.kept else {}),
                **{f"trace:{name}": joined[:, i] for i, name in enumerate(self.kept)}}


# ---------------------------------------------------------------------------- The table

class Writer:
    """Writes columns of one length into an .npz, some rows at a time, so that few of them are in memory. Of texts, it writes numbers, and each text once."""

    def __init__(self, folder: pathlib.Path):
        self._folder = folder
        self._columns: Dict[str, Tuple[Any, IO[bytes]]] = {}   # an empty array like it, and its bytes in a file that vanishes
        self._texts: Dict[str, Dict[str, int]] = {}

    def add(self, columns: Mapping[str, Any]) -> None:
        """Adds rows."""
        for name, values in columns.items():
            if values.dtype == object:
                known = self._texts.setdefault(name, collections.defaultdict(itertools.count().__next__))
                values = np.array(list(map(known.__getitem__, values)), "<i4")
            if name not in self._columns:
                self._columns[name] = values[:0], tempfile.TemporaryFile(dir=self._folder)
            self._columns[name][1].write(values.tobytes())

    def close(self, name: str, about: Mapping[str, Any]) -> None:
        """Makes the file."""
        replace(self._folder / name, lambda out: self._write(out, {**about, "texts": {name: list(known) for name, known in self._texts.items()}}))

    def _write(self, out: BinaryIO, about: Mapping[str, Any]) -> None:
        with zipfile.ZipFile(out, "w") as made:   # the dates of all members are 1980, so the bytes do not depend on the day
            made.writestr(zipfile.ZipInfo("about.json"), json.dumps(about, sort_keys=True))
            for name, (like, file) in self._columns.items():
                with made.open(zipfile.ZipInfo(f"{name}.npy"), "w", force_zip64=True) as member:
                    shape = (file.tell() // max(1, like.dtype.itemsize * int(np.prod(like.shape[1:]))), *like.shape[1:])
                    _format.write_array_header_1_0(member, {"descr": like.dtype.str, "fortran_order": False, "shape": shape})
                    file.seek(0)
                    shutil.copyfileobj(file, member)


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


def merge(prepared: "Prepared", out: Path, mixed: bool = False, partial: bool = False) -> "Results":
    """Makes results.npz, sorted by point, and times.npz. partial: also if points are missing; they have the error study/missing."""
    folder, study, count, missing = pathlib.Path(out), prepared.study, prepared.design.count, 0
    held = Held(prepared, folder, mixed, set())
    with disk(folder, "none is lost"):
        results, times = Writer(folder), Writer(folder)
        for first in range(0, count, BLOCK):
            points = [prepared.design.at(i) for i in range(first, min(first + BLOCK, count))]
            keys = prepared.keys(points)
            found = held.columns(keys)
            missing += int((found["origin"] == "").sum())
            times.add({name: found.pop(name) for name in ("seconds", "worker", "part")})
            results.add({"key": keys.view("|u1").reshape(-1, 16), **prepared.design.columns(points), **found})
        if missing and not partial:
            fail("study/missing", str(folder), f"{missing} of {count} points have no results yet",
                 "go on with --resume, or merge what is there with --partial")
        times.close("times.npz", {"format": "tactus-study-times", "rows": count, "units": {"seconds": "s"}})
        results.close("results.npz", {"format": "tactus-study-results", "version": 2, "name": study.name, "study": prepared.context.hex(), "rows": count,
                                      "factors": prepared.names, "measures": study.columns, "units": study.units})
    return Results(folder)


class Results(Mapping[str, Any]):
    """The merged results of a study: columns by name, one row for each point, read when they are asked for. Texts are an array of str. "key" and records,
    "trace:PORT", which are a list of arrays, are not in the list of names. about: the header of the file."""

    def __init__(self, path: Path):
        """path: the folder of a study, or the file."""
        given = pathlib.Path(path)
        self.path = given / "results.npz" if given.is_dir() else given
        with self._readable():
            self._file = _load(self.path)
            self.about: Dict[str, Any] = json.loads(self._file["about.json"])
            self._texts = {name: np.array(texts, object) for name, texts in self.about["texts"].items()}
        self._names = [name for name in self._file.files[1:] if name != "key" and not name.startswith("trace:")]   # the first one is the header
        self._read: Dict[str, Any] = {}

    @contextlib.contextmanager
    def _readable(self) -> Iterator[None]:
        try:
            yield
        except (OSError, ValueError, AttributeError, LookupError, EOFError, zipfile.BadZipFile) as why:
            fail("study/unreadable", str(self.path), f"the results cannot be read: {why}", "merge the study again")

    def __getitem__(self, name: str) -> Any:
        if name not in self._file:
            raise KeyError(name)
        if name not in self._read:
            with self._readable():
                values = self._file[name]
                self._read[name] = (np.split(values, np.cumsum(self["ticks"])[:-1]) if name.startswith("trace:") else
                                    self._texts[name][values] if name in self._texts else values)
        return self._read[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    @property
    def rows(self) -> int:
        """The number of points."""
        return int(self.about["rows"])

    def blocks(self, *names: str) -> Iterator[Tuple[int, Tuple[Any, ...]]]:
        """Some columns, so many rows at a time that they need little memory: the number of the first row, and the values."""
        with self._readable(), contextlib.ExitStack() as used:
            files = [used.enter_context(self._file.zip.open(f"{name}.npy")) for name in names]
            kinds = [_format.read_magic(file) and _format.read_array_header_1_0(file)[2] for file in files]
            for first in range(0, self.rows, BLOCK):
                found = [np.frombuffer(file.read(BLOCK * kind.itemsize), kind) for file, kind in zip(files, kinds)]
                yield first, tuple(self._texts[name][values] if name in self._texts else values for name, values in zip(names, found))
