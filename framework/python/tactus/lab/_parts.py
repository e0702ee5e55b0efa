# SPDX-License-Identifier: MIT
"""The results of a study in a folder: each process adds to a file of its own, chunk by chunk, and a merge makes one table of them.

A part is a sequence of frames: length and CRC-32 of the rest (4 bytes each, little endian), then the rest. The first frame is JSON about the process, each
other one a chunk: the length of its JSON (4 bytes), the JSON, keys (16 bytes a point), numbers and seconds (8 bytes each), and records. A frame that was cut
off by a crash is left out when it is read."""

from __future__ import annotations

import itertools
import json
import mmap
import os
import pathlib
import socket
import struct
import zlib
from typing import TYPE_CHECKING, Any, Dict, Iterator, List, NamedTuple, Optional, Tuple

import numpy as np

from .._checks import Array
from .._messages import fail
from . import _columns
from ._worker import Chunk, stamp

if TYPE_CHECKING:
    from ._study import Prepared

MAGIC = b"TACTPRT1"
Stamp = Tuple[str, str]


class Frame(NamedTuple):
    """A chunk in a part."""

    about: Dict[str, Any]
    keys: bytes
    numbers: Array
    seconds: Array
    traces: List[Array]


class Part:
    """A part that this process adds to."""

    def __init__(self, folder: pathlib.Path, context: bytes, mark: Stamp):
        host = "".join(c if c.isalnum() else "_" for c in socket.gethostname())[:40]
        for number in itertools.count():
            self.path = folder / f"{host}-{os.getpid()}-{number}.part"
            try:
                self._file = open(self.path, "xb", buffering=0)
                break
            except FileExistsError:
                continue
            except OSError as why:
                raise disk(folder, why, 0) from None
        self._size = self.points = 0
        try:
            self._put(MAGIC, json.dumps({"study": context.hex(), "tactus": mark[0], "computer": mark[1]}).encode())
        except OSError as why:
            raise disk(folder, why, 0) from None

    def add(self, keys: bytes, chunk: Chunk) -> None:
        """Adds a chunk; returns once it is on the disk."""
        about = {"n": len(chunk.seconds), "columns": chunk.numbers.shape[1], "problems": chunk.problems, "host": chunk.host, "process": chunk.process,
                 "kept": chunk.kept, "ticks": [len(trace) for trace in chunk.traces]}
        text = json.dumps(about, ensure_ascii=False).encode(errors="replace")
        data = b"".join([struct.pack("<I", len(text)), text, keys, chunk.numbers.astype("<f8").tobytes(), chunk.seconds.astype("<f8").tobytes(),
                         *(trace.astype("<f8").tobytes() for trace in chunk.traces)])
        try:
            self._put(b"", data)
        except OSError as why:
            raise disk(self.path.parent, why, self.points) from None
        self.points += len(chunk.seconds)

    def _put(self, before: bytes, data: bytes) -> None:
        frame = memoryview(before + struct.pack("<II", len(data), zlib.crc32(data)) + data)
        try:
            at = 0
            while at < len(frame):
                at += self._file.write(frame[at:]) or 0
            os.fsync(self._file.fileno())
        except OSError:
            try:
                os.ftruncate(self._file.fileno(), self._size)
            except OSError:
                pass   # a reader leaves out what was cut off
            raise
        self._size += len(frame)

    def close(self) -> None:
        """Closes the part."""
        self._file.close()


class DiskError(Exception):
    """The results cannot be written."""


def disk(folder: pathlib.Path, why: OSError, points: int) -> DiskError:
    return DiskError(f"{folder}: the results cannot be written: {why.strerror}; {points} points of this process are on the disk\n"
                     "    make room, and go on with --resume")


def frames(path: pathlib.Path) -> Iterator[Tuple[Dict[str, Any], Optional[Frame]]]:
    """The header of a part, once with None, and then its frames. Ends at the first one that is not whole."""
    with open(path, "rb") as file:
        if os.fstat(file.fileno()).st_size <= len(MAGIC):
            return
        data = memoryview(mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ))
    if data[:8] != MAGIC:
        fail("study/part", str(path), "the file is not a part of a study", "take it out of the folder")
    at, header = 8, None
    while at + 8 <= len(data):
        size, check = struct.unpack_from("<II", data, at)
        body = data[at + 8:at + 8 + size]
        if len(body) != size or zlib.crc32(body) != check:
            return
        at += 8 + size
        if header is None:
            header = json.loads(bytes(body).decode())
            yield header, None
            continue
        length = struct.unpack_from("<I", body, 0)[0]
        about = json.loads(bytes(body[4:4 + length]).decode())
        n, m, here = about["n"], about["columns"], 4 + length
        keys = bytes(body[here:here + 16 * n])
        here += 16 * n
        numbers = np.frombuffer(body, "<f8", n * m, here).reshape(n, m)
        seconds = np.frombuffer(body, "<f8", n, here + 8 * n * m)
        here += 8 * n * (m + 1)
        traces = []
        for ticks in about["ticks"]:
            width = len(about["kept"]) if ticks else 0
            traces.append(np.frombuffer(body, "<f8", ticks * width, here).reshape(ticks, width))
            here += 8 * ticks * width
        yield header, Frame(about, keys, numbers, seconds, traces)


class Folder:
    """The folder of a study."""

    def __init__(self, prepared: "Prepared", out: Any, mixed: bool, begin: bool):
        """begin: make the folder if it is not there."""
        self.prepared, self.path, self.mixed = prepared, pathlib.Path(out), mixed
        self.parts_path = self.path / "parts"
        mine = {"format": "tactus-study-results", "version": 1, "name": prepared.study.name, "study": prepared.context.hex(), "tactus": stamp()[0],
                "computer": stamp()[1]}
        try:
            if begin:
                self.parts_path.mkdir(parents=True, exist_ok=True)
                if not (self.path / "study.json").exists():
                    self._begin(mine)
            with open(self.path / "study.json", encoding="utf-8") as file:
                self.about: Dict[str, Any] = json.load(file)
        except OSError as why:
            fail("study/no_results", str(self.path), f"the folder has no results that can be read: {why.strerror}", "run the study first, or name its --out")
        except ValueError:
            fail("study/no_results", f"{self.path}/study.json", "the file is damaged", "restore it from a copy")
        if self.about.get("study") != mine["study"]:
            fail("study/other", str(self.path), "the folder has results of another study: the graph, its files, the measures or the names of factors differ",
                 "choose another folder with --out")
        self._check((self.about["tactus"], self.about["computer"]), stamp(), "this process")

    def _begin(self, about: Dict[str, Any]) -> None:
        new = self.path / f"study.json.{socket.gethostname()}.{os.getpid()}.new"
        with open(new, "w", encoding="utf-8") as file:
            file.write(json.dumps(about, indent=2) + "\n")
            file.flush()
            os.fsync(file.fileno())
        try:
            os.link(new, self.path / "study.json")   # only one of several processes makes it
        except FileExistsError:
            pass
        finally:
            new.unlink()

    def _check(self, begun: Stamp, mark: Stamp, who: str) -> None:
        if begun == mark or self.mixed:
            return
        what = f"Tactus {mark[0]}, and the study began with {begun[0]}" if begun[0] != mark[0] else \
            f"a computer that computes differently ({mark[1]}), and the study began on {begun[1]}"
        fail("study/other_version", str(self.path), f"{who} has {what}, so its results may have other bits",
             "use what the study began with, choose another folder, or take and mark such results with --mixed")

    def accept(self, mark: Stamp, host: str) -> None:
        """Refuses the results of a worker with another version, or on a computer that computes differently."""
        self._check((self.about["tactus"], self.about["computer"]), mark, f"the worker on {host}")

    def frames(self) -> Iterator[Tuple[Stamp, str, Frame]]:
        """What is there: the mark of each frame, the name of its part, and the frame."""
        for path in sorted(self.parts_path.glob("*.part")):
            for header, frame in frames(path):
                if header["study"] != self.prepared.context.hex():
                    break
                mark = (header["tactus"], header["computer"])
                self._check((self.about["tactus"], self.about["computer"]), mark, path.name)
                if frame is not None:
                    yield mark, path.name, frame

    def results(self) -> "Held":
        """All results that are there."""
        return Held(list(self.frames()))


class Held:
    """The results in a folder, numbered from 0 in the order of their parts."""

    def __init__(self, frames_: List[Tuple[Stamp, str, Frame]]):
        self.frames = frames_
        sizes = [frame.about["n"] for _, _, frame in frames_]
        self.frame = np.repeat(np.arange(len(sizes)), sizes)   # by result: the number of its frame, and its row there
        starts = np.cumsum([0, *sizes])
        self.row = np.arange(starts[-1]) - np.repeat(starts[:-1], sizes)
        self.keys = np.frombuffer(b"".join(frame.keys for _, _, frame in frames_), "S16")
        self.problems = {int(start) + p[0]: p for start, (_, _, frame) in zip(starts, frames_) for p in frame.about["problems"]}
        self._order = np.argsort(self.keys, kind="stable")

    def find(self, keys: Any) -> Any:
        """By key: the number of its first result; -1 if there is none."""
        if len(self.keys) == 0:
            return np.full(len(keys), -1)
        at = self._order[np.minimum(np.searchsorted(self.keys, keys, sorter=self._order), len(self.keys) - 1)]
        return np.where(self.keys[at] == keys, at, -1)

    def taken(self, at: Any, parts: List[Array], missing: float) -> Any:
        """Values of frames or of their rows, by point; `at` says which result a point has."""
        found = np.full((len(at), *(parts[0].shape[1:] if parts else ())), missing)
        if parts:
            found[at >= 0] = (np.concatenate(parts) if parts[0].ndim else np.array(parts)[self.frame])[at[at >= 0]]
        return found

    def twice(self) -> Iterator[Tuple[int, int]]:
        """Pairs of results of one point on equal computers."""
        ordered = self.keys[self._order]
        first: Dict[Tuple[bytes, Stamp], int] = {}
        for k in np.flatnonzero(np.isin(self.keys, ordered[1:][ordered[1:] == ordered[:-1]])).tolist():
            other = first.setdefault((self.keys[k].tobytes(), self.frames[self.frame[k]][0]), k)
            if other != k:
                yield other, k

    def result(self, number: int) -> Tuple[Any, ...]:
        """The values that must be the same in two results of one point."""
        frame, row = self.frames[self.frame[number]][2], self.row[number]
        return frame.numbers[row].tobytes(), self.problems.get(number, [0])[1:], frame.traces[row].tobytes() if frame.traces else b""


class Results(Dict[str, Any]):
    """The merged results of a study: columns by name, one row for each point. about: the header of their file."""

    def __init__(self, columns: Dict[str, Any], about: Dict[str, Any]):
        super().__init__(columns)
        self.about = about

    @property
    def rows(self) -> int:
        """The number of points."""
        return int(self.about["rows"])


def load(path: Any) -> Results:
    """The results of a study: its folder, or the file results.tcol in it."""
    given = pathlib.Path(path)
    return Results(*_columns.read(given / "results.tcol" if given.is_dir() else given))


def merge(prepared: "Prepared", out: Any, mixed: bool = False, partial: bool = False) -> Results:
    """Makes results.tcol, sorted by point, and times.tcol. partial: also if points are missing; they have the error study/missing."""
    folder = Folder(prepared, out, mixed, begin=False)
    held = folder.results()
    for a, b in held.twice():
        if held.result(a) != held.result(b):
            fail("study/differs", str(folder.path), f"a point was rendered twice, and its results differ (key {held.keys[a].hex()})",
                 "a function of the study may depend on more than its arguments; correct it, and begin in another folder")
    count = prepared.design.count
    keys = prepared.keys(range(count))
    at = held.find(keys)
    if (at < 0).any() and not partial:
        fail("study/missing", str(folder.path), f"{(at < 0).sum()} of {count} points have no results yet",
             "go on with --resume, or merge what is there with --partial")
    marks, parts = [mark for mark, _, _ in held.frames], [name for _, name, _ in held.frames]
    workers = [(frame.about["host"], frame.about["process"]) for _, _, frame in held.frames]
    origins = sorted({marks[f] for f in set(held.frame[at[at >= 0]].tolist())})

    def numbered(known: List[Any], each: List[Any]) -> Any:
        return held.taken(at, [np.array(known.index(v) if v in known else -1) for v in each], -1).astype("<i4")

    columns: Dict[str, Any] = {"key": keys.view("|u1").reshape(count, 16)}
    for c, name in enumerate(prepared.names):
        columns[name] = _columns.numbers_or_texts([prepared.design.at(i)[c] for i in range(count)])
    numbers = held.taken(at, [np.zeros((0, len(prepared.study.columns))), *(frame.numbers for _, _, frame in held.frames)], np.nan)
    columns.update({name: numbers[:, i] for i, name in enumerate(prepared.study.columns)})
    errors, places = [""] * count, [""] * count
    for row in np.flatnonzero((at < 0) | np.isin(at, list(held.problems))).tolist():
        _, name, places[row], text = held.problems.get(int(at[row]), (0, "study/missing", "", "the point has no result yet"))
        errors[row] = f"{name}: {text}"
    columns.update({"error": errors, "error_place": places, "origin": numbered(origins, marks)})
    for c, name in enumerate(next((frame.about["kept"] for _, _, frame in held.frames if frame.about["kept"]), [])):
        traces = [held.frames[held.frame[k]][2].traces[held.row[k]] if k >= 0 else np.zeros((0, 0)) for k in at]
        columns[f"trace:{name}"] = [np.ascontiguousarray(trace[:, c]) if trace.size else np.zeros(0) for trace in traces]
    about = {"format": "tactus-study-results", "version": 1, "name": prepared.study.name, "study": prepared.context.hex(), "rows": count,
             "factors": prepared.names, "measures": prepared.study.columns, "origins": [{"tactus": t, "computer": c} for t, c in origins]}
    used, known = sorted(set(parts)), sorted(set(workers))
    times = {"seconds": held.taken(at, [frame.seconds for _, _, frame in held.frames], np.nan), "part": numbered(used, parts), "worker": numbered(known, workers)}
    try:
        _columns.write(folder.path / "results.tcol", columns, about, prepared.study.units)
        _columns.write(folder.path / "times.tcol", times, {"format": "tactus-study-times", "rows": count, "parts": used,
                                                           "workers": [{"host": h, "process": p} for h, p in known]}, {"seconds": "s"})
    except OSError as why:
        raise DiskError(f"{folder.path}: the results cannot be merged: {why.strerror}\n    make room, and merge again; no result is lost") from None
    return Results(columns, about)


__all__ = ["DiskError", "Folder", "Part", "Results", "load", "merge"]
