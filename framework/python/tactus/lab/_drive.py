# SPDX-License-Identifier: MIT
"""Sends the points of a study to an executor, in chunks of about a second, and keeps what comes back."""

from __future__ import annotations

import array
import concurrent.futures
import contextlib
import datetime
import itertools
import pathlib
import pickle
import sys
import time
from concurrent.futures import BrokenExecutor, Future
from typing import TYPE_CHECKING, Any, Callable, Dict, Iterator, List, Optional, Sequence, Set, TextIO, Tuple

import numpy as np

from .._messages import Error, fail
from ._design import Point
from ._journal import Journal, lock
from ._results import BLOCK, Chunk, Held, Path, Stamp, accept, disk, part
from ._points import Worker, stamp, work

if TYPE_CHECKING:
    from ._study import Prepared

SECONDS = 1.0   # of a chunk
PATIENCE = 5.0   # seconds without a result until a driver asks whether the executor still works
TRIES = 3   # of executors that break, one after another, without a result in between


class Progress:
    """Lines about how far the study is, at most one a second; and from that, how many points a chunk gets."""

    def __init__(self, total: int, done: int, bad: int, to: Optional[TextIO], clock: Callable[[], float] = time.monotonic):
        self.total, self.done, self.bad, self.fresh, self.seconds, self._to, self._clock = total, done, bad, 0, 0.0, to, clock
        self._begin, self._next = clock(), clock() + 1.0

    def add(self, points: int, bad: int, seconds: float) -> None:
        """Some points are done. seconds: what they have cost."""
        self.done, self.bad, self.fresh, self.seconds = self.done + points, self.bad + bad, self.fresh + points, self.seconds + seconds
        if self._to is not None and (self._clock() >= self._next or self.done == self.total):
            self._next = self._clock() + 1.0
            print(self.line(), file=self._to, flush=True)

    def line(self) -> str:
        """How many points are done, how many have errors, and how long the others take."""
        left = (self._clock() - self._begin) / max(1, self.fresh) * (self.total - self.done)
        errors = f", {self.bad} with errors" if self.bad else ""
        more = f", {datetime.timedelta(seconds=round(left))} left" if self.done < self.total and self.fresh else ""
        return f"{self.done} of {self.total} points{errors}{more}"

    def chunk(self, left: int, workers: int) -> int:
        """How many of the points that are left the next chunk gets."""
        size = min(int(SECONDS * self.fresh / max(self.seconds, 1e-9)), 8 * self.fresh)   # a few cheap points do not tell what all others cost
        return max(1, min(size, BLOCK, left // (2 * workers) + 1 if workers > 1 else left))   # all workers end at about the same time


def drive(prepared: "Prepared", out: Path, make: Optional[Callable[[], Any]] = None, workers: int = 1, shard: Tuple[int, int] = (0, 1),
          resume: bool = False, mixed: bool = False, report: Optional[TextIO] = None) -> Progress:
    """Renders the points that have no result yet.

    make: gives an executor; it is called again if that one breaks. None: this process. shard: (i, n): only each n-th point, from the i-th on."""
    folder, wanted, tries, told = pathlib.Path(out), range(shard[0], prepared.design.count, shard[1]), 0, set[str]()
    parts: Dict[Stamp, Journal] = {}

    def keep(made: Chunk) -> None:
        with disk(folder, f"{progress.fresh} points of this process are on the disk"):
            if made.stamp not in parts:
                accept(folder, {stamp(), made.stamp}, mixed)
                parts[made.stamp] = used.enter_context(contextlib.closing(part(folder, prepared.context, made.stamp)))
            parts[made.stamp].add(made.to_json())
        for kind in [kind for kind in made.warnings if kind not in told][:20 - len(told)]:
            told.add(kind)
            print(f"warning: {made.warnings[kind]}", file=sys.stderr)
        progress.add(len(made.rows), len(made.errors), float(made.rows["seconds"].sum()))

    with contextlib.ExitStack() as used:
        with disk(folder, "the study has not begun"):
            (folder / "parts").mkdir(parents=True, exist_ok=True)
            file = used.enter_context(open(folder / "lock", "ab"))
        if not lock(file, is_shared=shard != (0, 1)):   # two processes do not render the same points; shards are different points
            fail("study/busy", str(folder), "another process is working on this study", "wait until it ends, or end it")
        todo, bad, count = missing(prepared, folder, mixed, {stamp()}, wanted)
        if count and not resume and shard == (0, 1):
            fail("study/exists", str(folder), f"the folder has the results of {count} points", "go on with --resume, or choose another folder with --out")
        progress = Progress(len(wanted), len(wanted) - len(todo), bad, report)
        while len(todo):
            done = progress.done
            try:
                for made in _rendered(prepared, _chunks(prepared, todo, progress, workers), make() if make else None, workers):
                    keep(made)
                break
            except BrokenExecutor as why:
                tries = 1 if progress.done > done else tries + 1
                if tries >= TRIES:
                    fail("study/workers", str(folder), f"workers have ended {TRIES} times without a result in between: {why}",
                         "look whether memory is short or a plugin crashes; then go on with --resume")
                todo, _, _ = missing(prepared, folder, mixed, {stamp()}, wanted)
    return progress


def missing(prepared: "Prepared", folder: pathlib.Path, mixed: bool, stamps: Set[Stamp], wanted: range) -> Tuple[Sequence[int], int, int]:
    """The points that have no result yet, how many of the others have errors, and how many results there are. Equal points are one."""
    design, held = prepared.design, Held(prepared, folder, mixed, stamps)
    if held.count == 0 and not design.repeats:
        return wanted, 0, 0   # no point needs memory
    todo, bad, seen = array.array("q"), 0, set()
    for first in range(0, len(wanted), BLOCK):
        numbers = wanted[first:first + BLOCK]
        keys = prepared.keys([design.at(i) for i in numbers])
        known, rows = held.find(keys)
        bad += int(held.rows(rows[known])["bad"].sum())
        for number, key in ((numbers[k], keys[k]) for k in np.flatnonzero(~known)):
            if key not in seen:
                todo.append(number)
            if design.repeats:
                seen.add(key)
    return todo, bad, held.count


def _chunks(prepared: "Prepared", todo: Sequence[int], progress: Progress, workers: int) -> Iterator[List[Point]]:
    at = 0
    while at < len(todo):
        size = progress.chunk(len(todo) - at, workers)
        yield [prepared.design.at(i) for i in todo[at:at + size]]
        at += size


def _rendered(prepared: "Prepared", chunks: Iterator[List[Point]], executor: Any, workers: int) -> Iterator[Chunk]:
    """The results of chunks of points, as they come, until an executor breaks. None: in this process."""
    if executor is None:
        yield from map(Worker(prepared, is_far=False).render, chunks)
        return
    context, pickled = prepared.context, pickle.dumps(prepared, 4)
    flying: Dict["Future[Optional[Chunk]]", List[Point]] = {}
    try:
        while True:
            for points in itertools.islice(chunks, 2 * workers - len(flying)):
                flying[executor.submit(work, context, None, points)] = points
            if not flying:
                return
            # A pool of processes that breaks while it is given a chunk forgets that chunk (before Python 3.12), but it refuses the next one.
            while not (done := concurrent.futures.wait(flying, PATIENCE, concurrent.futures.FIRST_COMPLETED).done):
                executor.submit(int)
            for future in done:
                points = flying.pop(future)
                try:
                    made = future.result()
                except (Error, MemoryError):
                    raise
                except Exception as why:   # it was killed or cancelled; each executor has its own exceptions for that
                    raise BrokenExecutor(f"{type(why).__name__}: {why}") from why
                if made is None:   # this worker has not got the study yet
                    flying[executor.submit(work, context, pickled, points)] = points
                else:
                    yield made
    finally:
        for future in flying:
            future.cancel()
