# SPDX-License-Identifier: MIT
"""The command `tactus study`."""

from __future__ import annotations

import argparse
import contextlib
import json
import multiprocessing
import multiprocessing.connection
import os
import pathlib
import re
import shlex
import subprocess
import sys
import threading
from concurrent.futures import ProcessPoolExecutor
from typing import Any, Callable, Iterator, List, Optional, Tuple

from .._graph import Graph
from .._messages import fail
from .._records import imported
from . import _study_report
from ._drive import drive, missing
from ._protocol import set_param
from ._results import Held, merge
from ._study import Prepared, Source, Study
from ._points import Worker
from ._tables import Table, table_of


def add(commands: Any) -> None:
    """Adds the command."""
    study = commands.add_parser("study", help="render a graph at many points, on one computer or a cluster", description="Renders a graph at many points.",
                                epilog="Example: tactus study wall.json --executor slurm --workers 100. See docs/studies.md.")
    study.add_argument("file", help="the study file")
    study.add_argument("--out", default="", help="the folder of results; default: the name of the study")
    study.add_argument("--executor", default="local", choices=["serial", "local", "dask", "mpi", "slurm"], help="what runs the renders; default: local")
    study.add_argument("--workers", type=int, default=os.cpu_count() or 1, help="how many processes, or shards of a Slurm job; default: one per processor")
    study.add_argument("--dask", default="", help="the address of a scheduler of dask.distributed; without it, a local cluster")
    study.add_argument("--shard", default="", help="I/N: only each N-th point, from the I-th on, from 0; does not merge")
    study.add_argument("--resume", action="store_true", help="go on with a folder that has results")
    study.add_argument("--mixed", action="store_true", help="also take results of other versions and other kinds of computers, and mark them")
    study.add_argument("--functions", default="", help="a Python file with the functions that the measures name")
    study.add_argument("--status", action="store_true", help="only say how far it is")
    study.add_argument("--merge", action="store_true", help="only merge the results, and make the report")
    study.add_argument("--partial", action="store_true", help="merge also if points are missing")
    study.add_argument("--point", type=int, default=-1, help="only render this point, from 0: its records as CSV, and its graph")
    study.add_argument("--dry-run", action="store_true", help="only print the script for Slurm")
    study.add_argument("--to", action="append", default=[], choices=["csv", "h5", "mat"], help="also write the results in this format")


def run(given: argparse.Namespace) -> int:
    """Runs the command."""
    if given.workers < 1:
        raise ValueError(f"--workers: {given.workers} is not a number of processes; give 1 or more")
    found = re.fullmatch(r"(\d{1,9})/(\d{1,9})", given.shard or "0/1")
    shard = (int(found[1]), int(found[2])) if found else (0, 0)
    if shard[0] >= shard[1]:
        raise ValueError(f"--shard: '{given.shard}' is not a shard; write I/N, such as 0/8 for the first of eight")
    try:
        functions = Source(pathlib.Path(given.functions).read_text(encoding="utf-8")) if given.functions else None
    except (OSError, ValueError, SyntaxError) as why:
        raise ValueError(f"--functions: {given.functions} cannot be read: {why}") from None
    prepared = Study.load(given.file).prepare(functions)
    out = pathlib.Path(given.out or prepared.study.name)
    if given.status:
        count = prepared.design.count
        todo, bad, held = missing(prepared, out, given.mixed, set(), range(count))
        print(f"{out}: {count - len(todo)} of {count} points, {bad} with errors; the folder has {held} results")
        return 0
    if given.point >= 0:
        return _point(prepared, out, given.point)
    if given.executor == "slurm" and not given.merge and not given.shard:
        return _slurm(prepared, out, given)
    if not given.merge:
        with _executor("serial" if given.shard else given.executor, given.workers, given.dask) as (make, workers):
            if workers == 0:
                return 0   # a worker of MPI, whose work is over
            progress = drive(prepared, out, make, workers, shard, given.resume or bool(given.shard), given.mixed, sys.stderr)
        if given.shard:
            print(f"shard {given.shard}: {progress.line()}")
            return 0
    results = merge(prepared, out, given.mixed, given.partial)
    for each in given.to:
        Table(results, prepared.study.units).write(out / f"results.{each}")
    words = ["tactus", "study", os.path.basename(given.file), *(["--functions", os.path.basename(given.functions)] if given.functions else [])]
    _study_report.write(prepared, results, out / "report.html", words)
    print(f"{results.path}: {results.rows} points, {(results['error'] != '').sum()} with errors; report: {out}/report.html")
    return 0


def _point(prepared: Prepared, out: pathlib.Path, number: int) -> int:
    """Writes the records of one point, and its graph for the window."""
    if number >= prepared.design.count:
        raise ValueError(f"--point: there is no point {number}; they are 0 to {prepared.design.count - 1}")
    point, worker = prepared.design.at(number), Worker(prepared, is_far=False)
    graph, records = worker.one(point)
    out.mkdir(parents=True, exist_ok=True)
    table_of(records).write(out / f"point-{number}.csv")
    data = json.loads(graph.text)
    values = {**prepared.study.set, **prepared.values(point, prepared.fast)}
    for name in [name for name in values if name in data.get("controls", {})]:
        data["controls"][name]["value"] = values.pop(name)
    data["rate_hz"] = records.rate_hz
    made = Graph.parse(json.dumps(data), worker.folders["graph"])
    for name, value in values.items():
        set_param(made, name, value)
    made.save(out / f"point-{number}.json")
    print(f"{out}/point-{number}.csv: {len(records['t'])} ticks of {json.dumps(prepared.values(point))}")
    print(f"open it in the window: tactus-host {out}/point-{number}.json")
    return 0


# ---------------------------------------------------------------------------- Executors

# A local cluster of dask looks at itself less often. With its defaults (each 10 to 500 ms), that is most of what it costs. And its workers keep freed
# memory for the next render: dask has it given back at once, so that the system would clear new pages for each one.
QUIET = {"distributed.worker.profile.enabled": False, "distributed.scheduler.active-memory-manager.start": False, "distributed.admin.tick.interval": "1s",
         "distributed.admin.system-monitor.interval": "5s", "distributed.worker.memory.monitor-interval": "1s",
         "distributed.nanny.pre-spawn-environ.MALLOC_TRIM_THRESHOLD_": 2**26, "distributed.nanny.pre-spawn-environ.MALLOC_MMAP_THRESHOLD_": 2**25}


@contextlib.contextmanager
def _executor(kind: str, workers: int, address: str) -> Iterator[Tuple[Optional[Callable[[], Any]], int]]:
    """A function that gives an executor, or None for this process, and the number of its workers. 0: this process has served others."""
    if kind == "serial" or kind == "local" and workers == 1:
        yield None, 1
    elif kind == "local":
        pools: List[ProcessPoolExecutor] = []

        def pool() -> ProcessPoolExecutor:
            _end_children(0.0)   # a pool that is broken may wait for them
            pools.append(ProcessPoolExecutor(workers, mp_context=multiprocessing.get_context("spawn"), initializer=end_with_parent))
            return pools[-1]

        try:
            yield pool, workers
            for each in pools:
                each.shutdown(wait=False, cancel_futures=True)
            _end_children(5.0)   # so that a worker removes its files; a pool that broke at the very end would wait for ever
        finally:
            _end_children(0.0)
    elif kind == "dask":
        distributed, config = imported("distributed", "--executor dask"), imported("dask", "--executor dask").config
        made: Any = {"address": address} if address else {"n_workers": workers, "threads_per_worker": 1, "dashboard_address": None}
        with config.set(QUIET), distributed.Client(**made) as client:
            yield client.get_executor, max(1, sum(client.ncores().values()))
    else:
        _, mpi, futures = (imported(name, "--executor mpi") for name in ("mpi4py", "mpi4py.MPI", "mpi4py.futures"))
        with futures.MPICommExecutor(mpi.COMM_WORLD, root=0) as executor:
            yield lambda: executor, max(1, mpi.COMM_WORLD.Get_size() - 1) if executor else 0


def _end_children(patience: float) -> None:
    for child in multiprocessing.active_children():
        child.join(patience)
        child.kill()


def end_with_parent() -> None:
    """A worker ends when the process that started it ends, also if that is killed."""
    def end() -> None:
        multiprocessing.connection.wait([process.sentinel for process in [multiprocessing.parent_process()] if process])
        os._exit(1)

    threading.Thread(target=end, daemon=True).start()


SCRIPT = """#!/bin/sh
#SBATCH --job-name=tactus-{name}
#SBATCH --array=0-{last}
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=1
#SBATCH --output={out}/slurm-%A_%a.log
#SBATCH --open-mode=append
#SBATCH --requeue
exec {words} --shard "$SLURM_ARRAY_TASK_ID/{shards}"
"""


def _slurm(prepared: Prepared, out: pathlib.Path, given: argparse.Namespace) -> int:
    """Prints a job array that renders the shards of the study, and submits it, and a job that merges."""
    shards, whole = min(given.workers, prepared.design.count), str(out.resolve())
    words = shlex.join([sys.executable, "-m", "tactus.lab", "study", os.path.abspath(given.file), "--out", whole, *(["--mixed"] if given.mixed else []),
                        *(["--functions", os.path.abspath(given.functions)] if given.functions else [])])
    script = SCRIPT.format(name=prepared.study.name, last=shards - 1, out=shlex.quote(whole), words=words, shards=shards)
    print(script, end="", flush=True)
    if given.dry_run:
        return 0
    (out / "parts").mkdir(parents=True, exist_ok=True)
    if Held(prepared, out, given.mixed, set()).count and not given.resume:
        fail("study/exists", str(out), "the folder has results", "go on with --resume, or choose another folder with --out")
    job = _sbatch(script)
    merging = _sbatch("", f"--dependency=afterany:{job}", f"--output={whole}/slurm-%j.log", f"--wrap={words} --merge --partial")
    print(f"submitted: job {job} with {shards} shards, and job {merging}, which merges their results; progress: --status")
    return 0


def _sbatch(script: str, *options: str) -> str:
    try:
        done = subprocess.run(["sbatch", "--parsable", *options], input=script, capture_output=True, text=True, check=False)
    except OSError as why:
        fail("study/no_slurm", "sbatch", f"the job cannot be submitted: {why.strerror}", "submit it on a computer with Slurm, or print it: --dry-run")
    if done.returncode != 0:
        fail("study/no_slurm", "sbatch", f"Slurm refuses the job: {done.stderr.strip()}",
             "correct what Slurm says; what was printed can be edited and submitted")
    return done.stdout.strip().split(";")[0]
