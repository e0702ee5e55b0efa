# SPDX-License-Identifier: MIT
"""The results of a study in a folder: each process adds to a file of its own, chunk by chunk, and a merge makes one table of them.

A part is a sequence of frames: length and CRC-32 of the rest (4 bytes each, little endian), then the rest. The first frame is JSON about the process, each
other one a chunk: an .npz of numpy. A frame that was cut off by a crash is left out when it is read."""

from __future__ import annotations

import contextlib
import io
import json
import os
import pathlib
import socket
import struct
import uuid
import zlib
from typing import TYPE_CHECKING, Any, Callable, Dict, Iterator, List, NamedTuple, Optional, Sequence, Tuple

import numpy as np

from .._messages import fail
from ._columns import BLOCK, Results, Writer
from ._worker import Chunk, Stamp, stamp

if TYPE_CHECKING:
    from ._study import Prepared

MAGIC = b"TACTPRT1"
_load: Any = np.load   # numpy has no types for it


class DiskError(Exception):
    """The results cannot be written."""

    def __init__(self, folder: pathlib.Path, what: str, why: OSError, kept: str):
        super().__init__(f"{folder}: the results cannot be {what}: {why.strerror}; {kept}\n    make room, and go on with --resume")


class Part:
    """A part that this process adds to."""

    def __init__(self, folder: pathlib.Path, context: bytes, mark: Stamp):
        host = "".join(c if c.isalnum() else "_" for c in socket.gethostname())[:40]
        self.path = folder / f"{host}-{os.getpid()}-{uuid.uuid4().hex}.part"
        self._size = self.points = 0
        try:
            self._file = open(self.path, "xb", buffering=0)
        except OSError as why:
            raise DiskError(folder, "written", why, "no point of this process is on the disk") from None
        self._put(MAGIC, json.dumps({"study": context.hex(), "tactus": mark[0], "computer": mark[1]}).encode())

    def add(self, keys: bytes, chunk: Chunk) -> None:
        """Adds a chunk; returns once it is on the disk."""
        about = {"problems": chunk.problems, "host": chunk.host, "process": chunk.process, "kept": chunk.kept}
        data, traces = io.BytesIO(), [np.zeros((0, len(chunk.kept))), *filter(len, chunk.traces)]
        np.savez(data, about=np.bytes_(json.dumps(about)), keys=np.frombuffer(keys, "S16"), numbers=chunk.numbers, seconds=chunk.seconds,
                 ticks=np.array([len(trace) for trace in chunk.traces], int), traces=np.concatenate(traces))
        self._put(b"", data.getvalue())
        self.points += len(chunk.seconds)

    def _put(self, before: bytes, data: bytes) -> None:
        frame = memoryview(before + struct.pack("<II", len(data), zlib.crc32(data)) + data)
        try:
            at = 0
            while at < len(frame):
                at += self._file.write(frame[at:]) or 0
            os.fsync(self._file.fileno())
        except OSError as why:
            with contextlib.suppress(OSError):   # a reader leaves out what was cut off
                os.ftruncate(self._file.fileno(), self._size)
            raise DiskError(self.path.parent, "written", why, f"{self.points} points of this process are on the disk") from None
        self._size += len(frame)

    def close(self) -> None:
        """Closes the part."""
        self._file.close()


class Frame(NamedTuple):
    """Where a chunk is, and whose it is."""

    path: pathlib.Path
    at: int
    size: int
    first: int   # the number of its first result in the folder
    mark: Stamp
    worker: Tuple[str, int]   # host and process
    kept: List[str]


def bodies(path: pathlib.Path) -> Iterator[Tuple[int, bytes]]:
    """The frames of a part, and where they are. Ends at the first one that is not whole."""
    with open(path, "rb") as file:
        begin = file.read(len(MAGIC) + 1)
        if len(begin) <= len(MAGIC):
            return
        if begin[:-1] != MAGIC:
            fail("study/part", str(path), "the file is not a part of a study", "take it out of the folder")
        file.seek(len(MAGIC))
        while len(head := file.read(8)) == 8:
            size, check = struct.unpack("<II", head)
            body = file.read(size)
            if len(body) != size or zlib.crc32(body) != check:
                return
            yield file.tell() - size, body


_MARKS: List[Callable[[Frame], Any]] = [lambda frame: frame.mark, lambda frame: frame.worker, lambda frame: frame.path.name]


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
        self.accept(stamp(), "this process")

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

    def accept(self, mark: Stamp, who: str) -> None:
        """Refuses the results of another version, or of a computer that computes differently."""
        begun = self.about["tactus"], self.about["computer"]
        if begun == mark or self.mixed:
            return
        what = f"Tactus {mark[0]}, and the study began with {begun[0]}" if begun[0] != mark[0] else \
            f"a computer that computes differently ({mark[1]}), and the study began on {begun[1]}"
        fail("study/other_version", str(self.path), f"{who} has {what}, so its results may have other bits",
             "use what the study began with, choose another folder, or take and mark such results with --mixed")

    def results(self) -> "Held":
        """All results that are there."""
        frames, keys, bad = [], bytearray(), []
        for path in sorted(self.parts_path.glob("*.part")):
            mark: Optional[Stamp] = None
            for at, body in bodies(path):
                if mark is None:
                    header = json.loads(body)
                    if header["study"] != self.prepared.context.hex():
                        break
                    mark = header["tactus"], header["computer"]
                    self.accept(mark, path.name)
                    continue
                with _load(io.BytesIO(body)) as held:
                    about = json.loads(held["about"].item())
                    bad += [len(keys) // 16 + problem[0] for problem in about["problems"]]
                    frames.append(Frame(path, at, len(body), len(keys) // 16, mark, (about["host"], about["process"]), about["kept"]))
                    keys += held["keys"].tobytes()
        return Held(frames, keys, bad)


class Held:
    """The results in a folder, numbered from 0 in the order of their parts. Of each result, its address and its number are in memory (24 bytes), to find it;
    its values are read when they are asked for."""

    def __init__(self, frames: Sequence[Frame], keys: bytearray, bad: List[int]):
        self.frames, self.bad = frames, np.array(bad, int)   # bad: the results with errors
        self._starts = np.array([frame.first for frame in frames], int)
        self.keys = np.frombuffer(keys, "S16")
        self._order = np.argsort(self.keys, kind="stable")
        self._read: Dict[int, Chunk] = {}

    def chunk(self, number: int) -> Chunk:
        """The chunk of a frame. A few that were read last are kept, as points that follow each other are often in one."""
        if number not in self._read:
            frame = self.frames[number]
            with open(frame.path, "rb") as file:
                file.seek(frame.at)
                with _load(io.BytesIO(file.read(frame.size))) as held:
                    traces = np.split(held["traces"], np.cumsum(held["ticks"])[:-1])
                    self._read[number] = Chunk(held["numbers"], held["seconds"], json.loads(held["about"].item())["problems"], traces)
            for old in list(self._read)[:-4]:
                del self._read[old]
        return self._read[number]

    def find(self, keys: Any) -> Any:
        """By key: the number of its first result; -1 if there is none."""
        if len(self.keys) == 0:
            return np.full(len(keys), -1)
        at = self._order[np.minimum(np.searchsorted(self.keys, keys, sorter=self._order), len(self.keys) - 1)]
        return np.where(self.keys[at] == keys, at, -1)

    def place(self, at: Any) -> Tuple[Any, Any]:
        """By number: the number of its frame, and its row there."""
        frame = np.searchsorted(self._starts, at, "right") - 1
        return frame, at - self._starts[frame]

    def twice(self) -> Iterator[Tuple[int, int]]:
        """Pairs of results of one point on equal computers."""
        first: Dict[Tuple[bytes, Stamp], int] = {}
        for at in range(0, len(self.keys), BLOCK):
            some = self._order[at:at + BLOCK + 1]
            same = self.keys[some[1:]] == self.keys[some[:-1]]
            for k in np.union1d(some[1:][same], some[:-1][same]).tolist():
                other = first.setdefault((self.keys[k].tobytes(), self.frames[self.place(k)[0]].mark), k)
                if other != k:
                    yield other, k

    def result(self, number: int) -> Tuple[Any, ...]:
        """The values that must be the same in two results of one point."""
        frame, row = self.place(number)
        chunk = self.chunk(int(frame))
        return chunk.numbers[row].tobytes(), [p[1:] for p in chunk.problems if p[0] == row], chunk.traces[row].tobytes() if len(chunk.traces) > row else b""


def load(path: Any) -> Results:
    """The results of a study: its folder, or the file results.tcol in it."""
    given = pathlib.Path(path)
    return Results(given / "results.tcol" if given.is_dir() else given)


def merge(prepared: "Prepared", out: Any, mixed: bool = False, partial: bool = False) -> Results:
    """Makes results.tcol, sorted by point, and times.tcol. partial: also if points are missing; they have the error study/missing."""
    folder = Folder(prepared, out, mixed, begin=False)
    held = folder.results()
    for a, b in held.twice():
        if held.result(a) != held.result(b):
            fail("study/differs", str(folder.path), f"a point was rendered twice, and its results differ (key {held.keys[a].hex()})",
                 "a function of the study may depend on more than its arguments; correct it, and begin in another folder")
    count, missing = prepared.design.count, 0
    origins, workers, parts = (sorted({getter(frame) for frame in held.frames}) for getter in _MARKS)
    results, times = Writer(folder.path / "results.tcol"), Writer(folder.path / "times.tcol")
    try:
        for first in range(0, count, BLOCK):
            points = [prepared.design.at(i) for i in range(first, min(first + BLOCK, count))]
            keys = prepared.keys(points)
            at = held.find(keys)
            missing += int((at < 0).sum())
            rows = _rows(prepared, held, at, [origins, workers, parts])
            times.add({name: rows.pop(name) for name in ("seconds", "part", "worker")})
            results.add({"key": keys.view("|u1").reshape(-1, 16), **prepared.design.columns(points), **rows})
        if missing and not partial:
            fail("study/missing", str(folder.path), f"{missing} of {count} points have no results yet",
                 "go on with --resume, or merge what is there with --partial")
        times.close({"format": "tactus-study-times", "parts": parts, "workers": [{"host": h, "process": p} for h, p in workers]}, {"seconds": "s"})
        results.close({"format": "tactus-study-results", "version": 1, "name": prepared.study.name, "study": prepared.context.hex(), "factors": prepared.names,
                       "measures": prepared.study.columns, "origins": [{"tactus": t, "computer": c} for t, c in origins]}, prepared.study.units)
    except OSError as why:
        raise DiskError(folder.path, "merged", why, "none is lost") from None
    return Results(folder.path / "results.tcol", keeps=False)


def _rows(prepared: "Prepared", held: Held, at: Any, known: List[List[Any]]) -> Dict[str, Any]:
    """The columns of some points; `at` has the numbers of their results."""
    n = len(at)
    kept: List[str] = next((frame.kept for frame in held.frames if frame.kept), [])
    numbers, seconds, marks = np.full((n, len(prepared.study.columns)), np.nan), np.full(n, np.nan), np.full((3, n), -1)
    problems: List[Any] = [(0, "study/missing", "", "the point has no result yet") if k < 0 else None for k in at.tolist()]
    traces = [np.zeros((0, len(kept)))] * n
    frames, row = held.place(at) if held.frames else (at, at)
    for number in np.unique(frames[at >= 0]).tolist():
        chunk, mine = held.chunk(number), np.flatnonzero((frames == number) & (at >= 0))
        numbers[mine], seconds[mine] = chunk.numbers[row[mine]], chunk.seconds[row[mine]]
        marks[:, mine] = [[each.index(getter(held.frames[number]))] for each, getter in zip(known, _MARKS)]
        bad = {problem[0]: problem for problem in chunk.problems}
        for i in mine.tolist() if bad or kept else ():
            problems[i] = bad.get(row[i])
            traces[i] = chunk.traces[row[i]].reshape(-1, len(kept)) if kept else traces[i]
    origin, worker, part = marks.astype("<i4")
    return {**{name: numbers[:, i] for i, name in enumerate(prepared.study.columns)}, "error": [f"{p[1]}: {p[3]}" if p else "" for p in problems],
            "error_place": [p[2] if p else "" for p in problems], "origin": origin,
            **{f"trace:{name}": [trace[:, c] for trace in traces] for c, name in enumerate(kept)}, "seconds": seconds, "part": part, "worker": worker}
