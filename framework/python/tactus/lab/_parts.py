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
from typing import TYPE_CHECKING, Any, Dict, Iterator, List, NamedTuple, Optional, Sequence, Tuple

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
    part: int   # the number of the part in the list of parts


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


def frames(path: pathlib.Path, number: int) -> Iterator[Tuple[Dict[str, Any], Optional[Frame]]]:
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
        yield header, Frame(about, keys, numbers, seconds, traces, number)


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
        for number, path in enumerate(sorted(self.parts_path.glob("*.part"))):
            for header, frame in frames(path, number):
                if header["study"] != self.prepared.context.hex():
                    break
                mark = (header["tactus"], header["computer"])
                self._check((self.about["tactus"], self.about["computer"]), mark, path.name)
                if frame is not None:
                    yield mark, path.name, frame

    def keys(self) -> Dict[bytes, bool]:
        """The points that have results; True for those with an error."""
        found: Dict[bytes, bool] = {}
        for _, _, frame in self.frames():
            bad = {problem[0] for problem in frame.about["problems"]}
            for i in range(frame.about["n"]):
                found[frame.keys[16 * i:16 * i + 16]] = i in bad
        return found


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
    held, marks, names = list(folder.frames()), [], []
    where: Dict[bytes, Tuple[int, int]] = {}
    for f, (mark, name, frame) in enumerate(held):
        marks.append(mark)
        names.append(name)
        for i in range(frame.about["n"]):
            key = frame.keys[16 * i:16 * i + 16]
            before = where.setdefault(key, (f, i))
            if before != (f, i) and marks[before[0]] == mark:
                _same(folder, held[before[0]][2], before[1], frame, i)
    count = prepared.design.count
    points = [prepared.design.at(i) for i in range(count)]
    keys = [prepared.key(point) for point in points]
    missing = sum(key not in where for key in keys)
    if missing and not partial:
        fail("study/missing", str(folder.path), f"{missing} of {count} points have no results yet",
             "go on with --resume, or merge what is there with --partial")
    sizes = [frame.about["n"] for _, _, frame in held]
    starts = np.concatenate([[0], np.cumsum(sizes)]).astype(int)
    at = np.array([starts[where[key][0]] + where[key][1] if key in where else -1 for key in keys], int)
    there, frame_of = at >= 0, np.repeat(np.arange(len(held)), sizes)

    def rows(parts: List[Array], width: Tuple[int, ...]) -> Array:
        found = np.full((count, *width), np.nan)
        if parts:
            found[there] = np.concatenate(parts)[at[there]]
        return found

    numbers = rows([frame.numbers for _, _, frame in held], (len(prepared.study.columns),))
    seconds = rows([frame.seconds for _, _, frame in held], ())
    origins = sorted({marks[f] for f in {f for f, _ in where.values()}})
    origin = np.array([origins.index(mark) for mark in marks] or [0])
    bad = {(f, p[0]): p for f, (_, _, frame) in enumerate(held) for p in frame.about["problems"]}
    errors, places = [""] * count, [""] * count
    for row, key in enumerate(keys) if bad or missing else ():
        if key not in where:
            errors[row] = "study/missing: the point has no result yet"
        elif where[key] in bad:
            _, name, place, text = bad[where[key]]
            errors[row], places[row] = f"{name}: {text}", place
    columns: Dict[str, Any] = {"key": np.frombuffer(b"".join(keys), "|u1").reshape(count, 16)}
    texts = list(zip(*points)) or [()] * len(prepared.names)
    columns.update({name: _columns.numbers_or_texts(column) for name, column in zip(prepared.names, texts)})
    columns.update({name: numbers[:, i] for i, name in enumerate(prepared.study.columns)})
    columns.update({"error": errors, "error_place": places, "origin": np.where(there, origin[frame_of[at]] if held else 0, -1).astype("<i4")})
    columns.update(_traces(prepared, held, where, keys))
    units = {**{f.vary: f.unit for f in prepared.study.factors}, **{n: m.unit for m in prepared.study.measures for n in m.columns[:1]}}
    about = {"format": "tactus-study-results", "version": 1, "name": prepared.study.name, "study": prepared.context.hex(), "rows": count,
             "factors": prepared.names, "measures": prepared.study.columns, "origins": [{"tactus": t, "computer": c} for t, c in origins]}
    used = sorted(set(names))
    try:
        _columns.write(folder.path / "results.tcol", columns, about, units)
        part = np.array([used.index(name) for name in names] or [0])
        hosts = sorted({(frame.about["host"], frame.about["process"]) for _, _, frame in held})
        host = np.array([hosts.index((frame.about["host"], frame.about["process"])) for _, _, frame in held] or [0])
        _columns.write(folder.path / "times.tcol", {
            "seconds": seconds, "part": np.where(there, part[frame_of[at]] if held else 0, -1).astype("<i4"),
            "worker": np.where(there, host[frame_of[at]] if held else 0, -1).astype("<i4")},
            {"format": "tactus-study-times", "rows": count, "parts": used, "workers": [{"host": h, "process": p} for h, p in hosts]}, {"seconds": "s"})
    except OSError as why:
        raise DiskError(f"{folder.path}: the results cannot be merged: {why.strerror}\n    make room, and merge again; no result is lost") from None
    return Results(columns, about)


def _same(folder: Folder, a: Frame, i: int, b: Frame, k: int) -> None:
    """Two results of one point on equal computers have the same bits, or something is broken."""
    problems = [[p[1:] for p in frame.about["problems"] if p[0] == row] for frame, row in ((a, i), (b, k))]
    traces = [frame.traces[row].tobytes() if frame.traces else b"" for frame, row in ((a, i), (b, k))]
    if a.numbers[i].tobytes() != b.numbers[k].tobytes() or problems[0] != problems[1] or traces[0] != traces[1]:
        fail("study/differs", str(folder.path), f"a point was rendered twice, and its results differ (key {a.keys[16 * i:16 * i + 16].hex()})",
             "a function of the study may depend on more than its arguments; correct it, and begin in another folder")


def _traces(prepared: "Prepared", held: Sequence[Tuple[Stamp, str, Frame]], where: Dict[bytes, Tuple[int, int]], keys: List[bytes]) -> Dict[str, Any]:
    kept: List[str] = next((frame.about["kept"] for _, _, frame in held if frame.about["kept"]), [])
    found: Dict[str, Any] = {}
    for c, name in enumerate(kept):
        rows = [held[where[key][0]][2].traces[where[key][1]] if key in where else np.zeros((0, 0)) for key in keys]
        found[f"trace:{name}"] = [np.ascontiguousarray(row[:, c]) if row.size else np.zeros(0) for row in rows]
    return found


__all__ = ["DiskError", "Folder", "Part", "Results", "load", "merge"]
