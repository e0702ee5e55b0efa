# SPDX-License-Identifier: MIT
"""Sends the points of a study to an executor, in chunks of about a second, and keeps what comes back."""

from __future__ import annotations

import array
import concurrent.futures
import datetime
import os
import pickle
import shlex
import sys
import time
from concurrent.futures import BrokenExecutor, Future
from typing import TYPE_CHECKING, Any, Callable, Dict, List, Optional, Sequence, Set, TextIO, Tuple

import numpy as np

from .._messages import fail
from ._columns import BLOCK
from ._design import Point
from ._parts import Folder, Held, Part
from ._worker import Chunk, Worker, work

if TYPE_CHECKING:
    from ._study import Prepared

SECONDS = 1.0   # of a chunk
PATIENCE = 5.0   # seconds without a result until a driver asks whether the executor still works
TRIES = 3   # of executors that break, one after another, without a result in between

try:
    import fcntl
except ImportError:   # Windows
    fcntl = None   # type: ignore[assignment]


class Progress:
    """Lines about how far the study is, at most one a second."""

    def __init__(self, total: int, done: int, bad: int, to: Optional[TextIO], clock: Callable[[], float] = time.monotonic):
        self.total, self.done, self.bad, self._to, self._clock = total, done, bad, to, clock
        self._first, self._begin, self._next = done, clock(), clock() + 1.0

    def add(self, points: int, bad: int) -> None:
        """Some points are done."""
        self.done += points
        self.bad += bad
        if self._to is not None and (self._clock() >= self._next or self.done == self.total):
            self._next = self._clock() + 1.0
            print(self.line(), file=self._to, flush=True)

    def line(self) -> str:
        """How many points are done, how many have errors, and how long the others take."""
        fresh = self.done - self._first
        left = (self._clock() - self._begin) / fresh * (self.total - self.done) if fresh else 0.0
        errors = f", {self.bad} with errors" if self.bad else ""
        return f"{self.done} of {self.total} points{errors}" + (f", {datetime.timedelta(seconds=round(left))} left" if self.done < self.total and fresh else "")


class _Sizes:
    """How many points a chunk gets, by what points have cost so far."""

    def __init__(self, workers: int, left: int):
        self.workers, self.left, self.seconds, self.points = workers, left, 0.0, 0

    def next(self) -> int:
        """The size of the next chunk."""
        if self.points == 0:
            size = 1
        else:
            size = int(SECONDS / max(self.seconds / self.points, 1e-6))
            size = min(size, 8 * self.points)   # a few cheap points do not tell what all others cost
        if self.workers > 1:
            size = min(size, self.left // (2 * self.workers) + 1)   # so that all workers end at about the same time
        size = max(1, min(size, self.left))
        self.left -= size
        return size

    def learn(self, points: int, seconds: float) -> None:
        """Points have cost this much."""
        self.points += points
        self.seconds += seconds


def drive(prepared: "Prepared", out: Any, make: Optional[Callable[[], Any]] = None, workers: int = 1, shard: Tuple[int, int] = (0, 1),
          resume: bool = False, mixed: bool = False, report: Optional[TextIO] = None) -> Progress:
    """Renders the points that have no result yet.

    make: gives an executor; it is called again if that one breaks. None: this process. shard: (i, n): only each n-th point, from the i-th on."""
    folder = Folder(prepared, out, mixed, begin=True)
    lock = _lock(folder, is_shared=shard != (0, 1))
    try:
        held = folder.results()
        if len(held.keys) and not resume and shard == (0, 1):
            fail("study/exists", str(folder.path), f"the folder has the results of {len(held.keys)} points",
                 "go on with --resume, or choose another folder with --out")
        wanted = range(shard[0], prepared.design.count, shard[1])
        todo, bad = missing(prepared, held, wanted)
        progress = Progress(len(wanted), len(wanted) - len(todo), bad, report)
        del held
        if len(todo):
            _Driver(prepared, folder, progress, todo, max(1, workers)).run(make)
        return progress
    finally:
        os.close(lock)


def missing(prepared: "Prepared", held: Held, wanted: range) -> Tuple[Sequence[int], int]:
    """The points that have no result yet, and how many of the others have errors. Equal points are one."""
    design = prepared.design
    if not len(held.keys) and not design.repeats:
        return wanted, 0   # no point needs memory
    todo, bad, seen = array.array("q"), 0, set()
    for first in range(0, len(wanted), BLOCK):
        numbers = wanted[first:first + BLOCK]
        keys = prepared.keys([design.at(i) for i in numbers])
        at = held.find(keys)
        bad += int(np.isin(at, held.bad).sum())
        for number, key in ((numbers[k], keys[k]) for k in np.flatnonzero(at < 0)):
            if key not in seen:
                todo.append(number)
            if design.repeats:
                seen.add(key)
    return todo, bad


def _lock(folder: Folder, is_shared: bool) -> int:
    """Two processes do not render the same points; shards are different points."""
    lock = os.open(folder.path / "lock", os.O_RDWR | os.O_CREAT, 0o666)
    try:
        if fcntl is not None:
            fcntl.flock(lock, (fcntl.LOCK_SH if is_shared else fcntl.LOCK_EX) | fcntl.LOCK_NB)
    except OSError:
        os.close(lock)
        fail("study/busy", str(folder.path), "another process is working on this study", "wait until it ends, or end it")
    return lock


class _Driver:
    def __init__(self, prepared: "Prepared", folder: Folder, progress: Progress, todo: Sequence[int], workers: int):
        self.prepared, self.folder, self.progress, self.workers = prepared, folder, progress, workers
        self.todo, self.at = todo, 0
        self.sizes = _Sizes(workers, len(todo))
        self.parts: Dict[Tuple[str, str], Part] = {}
        self.told: set[str] = set()
        self.again: List[List[Point]] = []   # chunks that were lost with a worker
        self.pickled = b""

    def run(self, make: Optional[Callable[[], Any]]) -> None:
        try:
            if make is None:
                worker = Worker(self.prepared, is_far=False)
                while points := self._next():
                    self._keep(points, worker.render(points))
                return
            self.pickled = pickle.dumps(self.prepared, 4)
            tries = 0
            while True:
                done = self.progress.done
                try:
                    self._with(make())
                    return
                except BrokenExecutor as why:
                    tries = 1 if self.progress.done > done else tries + 1
                    if tries >= TRIES:
                        fail("study/workers", str(self.folder.path), f"workers were killed {TRIES} times without a result in between: {why}",
                             "look whether memory is short or a plugin crashes; then go on with --resume")
        finally:
            for part in self.parts.values():
                part.close()

    def _next(self) -> List[Point]:
        if self.again:
            return self.again.pop()
        size = self.sizes.next() if self.at < len(self.todo) else 0
        self.at += size
        return [self.prepared.design.at(i) for i in self.todo[self.at - size:self.at]]

    def _with(self, executor: Any) -> None:
        """Works on an executor until nothing is left, or until it breaks."""
        flying: Dict["Future[Optional[Chunk]]", List[Point]] = {}
        try:
            while True:
                while len(flying) < 2 * self.workers and (points := self._next()):
                    flying[executor.submit(work, self.prepared.context, None, points)] = points
                if not flying:
                    return
                for future in self._done(executor, flying):
                    result = self._result(future)
                    if result is None:   # this worker has not got the study yet
                        flying[executor.submit(work, self.prepared.context, self.pickled, flying[future])] = flying[future]
                    else:
                        self._keep(flying[future], result)
                    del flying[future]
        except BaseException:
            for future in flying:
                future.cancel()
            self.again += list(flying.values())
            raise

    def _done(self, executor: Any, flying: Dict["Future[Optional[Chunk]]", List[Point]]) -> "Set[Future[Optional[Chunk]]]":
        """The chunks that have come back, at least one. A pool of processes that breaks while it is given a chunk forgets that chunk (before Python 3.12),
        but it refuses the next one."""
        while True:
            done = concurrent.futures.wait(flying, PATIENCE, concurrent.futures.FIRST_COMPLETED).done
            if done:
                return done
            executor.submit(int)

    def _result(self, future: "Future[Optional[Chunk]]") -> Optional[Chunk]:
        try:
            return future.result()
        except BrokenExecutor:
            raise
        except concurrent.futures.CancelledError as why:
            raise BrokenExecutor("the executor has cancelled a chunk") from why
        except Exception as why:
            if type(why).__name__ in ("KilledWorker", "CommClosedError", "FutureCancelledError"):   # of dask.distributed
                raise BrokenExecutor(f"{type(why).__name__}: {why}") from why
            raise

    def _keep(self, points: List[Point], made: Chunk) -> None:
        if made.stamp not in self.parts:
            self.folder.accept(made.stamp, f"the worker on {made.host}")
            self.parts[made.stamp] = Part(self.folder.parts_path, self.prepared.context, made.stamp)
        self.parts[made.stamp].add(self.prepared.keys(points).tobytes(), made)
        self.sizes.learn(len(points), float(made.seconds.sum()))
        for kind, text in made.warnings.items():
            if kind not in self.told and len(self.told) < 20:
                self.told.add(kind)
                print(f"warning: {text}", file=sys.stderr)
        self.progress.add(len(points), len(made.problems))


def slurm_script(words: List[str], out: str, name: str, shards: int = 0) -> str:
    """A job that runs a command. shards: an array of jobs, each of which renders a shard."""
    path = f"export PYTHONPATH={shlex.quote(os.environ['PYTHONPATH'])}\n" if os.environ.get("PYTHONPATH") else ""
    array, log, more = (f"#SBATCH --array=0-{shards - 1}\n", "%A_%a", f' --shard "$SLURM_ARRAY_TASK_ID/{shards}"') if shards else ("", "%j", "")
    return (f"#!/bin/sh\n#SBATCH --job-name=tactus-{name}\n{array}#SBATCH --ntasks=1\n#SBATCH --cpus-per-task=1\n"
            f"#SBATCH --output={shlex.quote(out)}/slurm-{log}.log\n#SBATCH --open-mode=append\n#SBATCH --requeue\n{path}exec {shlex.join(words)}{more}\n")
