# SPDX-License-Identifier: MIT
"""The command `tactus study`."""

from __future__ import annotations

import argparse
import contextlib
import importlib
import json
import multiprocessing
import multiprocessing.connection
import os
import pathlib
import re
import subprocess
import sys
import threading
from concurrent.futures import ProcessPoolExecutor
from typing import Any, Callable, Dict, Iterator, List, Optional, Tuple

from .._graph import Graph
from .._messages import fail
from . import _study_report
from ._design import values_of
from ._drive import drive, missing, slurm_script
from ._parts import Folder, merge
from ._study import Prepared, Study
from ._worker import Worker
from ._writers import Table, table_of


def add(commands: Any) -> None:
    """Adds the command."""
    study = commands.add_parser("study", help="render a graph at many points, on one computer or a cluster", description="Renders a graph at many points.")
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
    study = Study.load(given.file)
    try:
        source = pathlib.Path(given.functions).read_text(encoding="utf-8") if given.functions else ""
    except (OSError, ValueError) as why:
        raise ValueError(f"--functions: {given.functions} cannot be read: {why}") from None
    prepared = study.prepare(source=source)
    out = pathlib.Path(given.out or study.name)
    if given.status:
        return _status(prepared, out, given.mixed)
    if given.point >= 0:
        return _point(prepared, out, given.point)
    if given.executor == "slurm" and not given.merge and not given.shard:
        return _slurm(prepared, out, given)
    if not given.merge:
        shard = _shard(given.shard)
        with _executor(given.executor if not given.shard else "serial", given.workers, given.dask) as (make, workers):
            if workers == 0:
                return 0   # a worker of MPI, whose work is over
            progress = drive(prepared, out, make, workers, shard, given.resume or bool(given.shard), given.mixed, sys.stderr)
        if given.shard:
            print(f"shard {given.shard}: {progress.line()}")
            return 0
    results = merge(prepared, out, given.mixed, given.partial)
    if given.to:
        names = [name for name in results if name != "key" and not name.startswith("trace:")]
        table = Table({name: results[name] for name in names}, {entry["name"]: entry["unit"] for entry in results.about["columns"] if entry["unit"]})
        for each in given.to:
            table.write(out / f"results.{each}")
    words = ["tactus", "study", os.path.basename(given.file), *(["--functions", os.path.basename(given.functions)] if given.functions else [])]
    _study_report.write(prepared, results, out / "report.html", words)
    bad = sum(map(bool, results["error"]))
    print(f"{out}/results.tcol: {results.rows} points, {bad} with errors; report: {out}/report.html")
    return 0


def _shard(text: str) -> Tuple[int, int]:
    if not text:
        return 0, 1
    found = re.fullmatch(r"(\d{1,9})/(\d{1,9})", text)
    if not found or not int(found[1]) < int(found[2]):
        raise ValueError(f"--shard: '{text}' is not a shard; write I/N, such as 0/8 for the first of eight")
    return int(found[1]), int(found[2])


# ---------------------------------------------------------------------------- Executors

# A local cluster of dask looks at itself less often. With its defaults (each 10 to 500 ms), that is most of what it costs.
QUIET = {"distributed.worker.profile.enabled": False, "distributed.scheduler.active-memory-manager.start": False, "distributed.admin.tick.interval": "1s",
         "distributed.admin.system-monitor.interval": "5s", "distributed.worker.memory.monitor-interval": "1s"}


def end_with_parent() -> None:
    """A worker ends when the process that started it ends, also if that is killed."""
    def end(sentinel: int) -> None:
        multiprocessing.connection.wait([sentinel])
        os._exit(1)

    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=end, args=(parent.sentinel,), daemon=True).start()


@contextlib.contextmanager
def _executor(kind: str, workers: int, address: str) -> Iterator[Tuple[Optional[Callable[[], Any]], int]]:
    """A function that gives an executor, or None for this process, and the number of its workers. 0: this process has served others."""
    if kind == "serial" or kind == "local" and workers == 1:
        yield None, 1
    elif kind == "local":
        yield from _local(workers)
    elif kind == "dask":
        distributed, config = (_imported(name, "python3-distributed") for name in ("distributed", "dask.config"))
        made: Dict[str, Any] = {"address": address} if address else {"n_workers": workers, "threads_per_worker": 1, "dashboard_address": None}
        with config.set(QUIET), distributed.Client(**made) as client:
            yield client.get_executor, max(1, sum(client.ncores().values()))
    else:
        yield from _mpi()


def _local(workers: int) -> Iterator[Tuple[Callable[[], Any], int]]:
    pools: List[ProcessPoolExecutor] = []

    def make() -> ProcessPoolExecutor:
        end()
        pools.append(ProcessPoolExecutor(workers, mp_context=multiprocessing.get_context("spawn"), initializer=end_with_parent))
        return pools[-1]

    def end() -> None:
        for child in multiprocessing.active_children():   # a pool that is broken may wait for them
            child.kill()

    try:
        yield make, workers
        for pool in pools:
            pool.shutdown(wait=False, cancel_futures=True)
        for child in multiprocessing.active_children():
            child.join(5.0)   # so that a worker removes its files; a pool that broke at the very end would wait for ever
    finally:
        end()


def _mpi() -> Iterator[Tuple[Optional[Callable[[], Any]], int]]:
    MPI, futures = (_imported(name, "python3-mpi4py") for name in ("mpi4py.MPI", "mpi4py.futures"))
    size = MPI.COMM_WORLD.Get_size()
    if size == 1:
        yield None, 1
        return
    with futures.MPICommExecutor(MPI.COMM_WORLD, root=0) as executor:
        try:
            yield lambda: executor, size - 1 if executor else 0
        except BaseException as why:
            print(f"error: {why}", file=sys.stderr, flush=True)
            MPI.COMM_WORLD.Abort(1)   # the other processes would wait forever
            raise


def _imported(module: str, debian: str) -> Any:
    try:
        return importlib.import_module(module)
    except ImportError as why:
        fail("study/no_package", module, f"the package {module.partition('.')[0]} cannot be imported: {why}", f"install it; on Debian, {debian}")


def _slurm(prepared: Prepared, out: pathlib.Path, given: argparse.Namespace) -> int:
    shards = min(given.workers, prepared.design.count)
    whole = str(out.resolve())
    words = [sys.executable, "-m", "tactus.lab", "study", os.path.abspath(given.file), "--out", whole, *(["--mixed"] if given.mixed else []),
             *(["--functions", os.path.abspath(given.functions)] if given.functions else [])]
    script = slurm_script(words, whole, prepared.study.name, shards)
    print(script, end="", flush=True)
    if given.dry_run:
        return 0
    folder = Folder(prepared, out, given.mixed, begin=True)
    if len(folder.results().keys) and not given.resume:
        fail("study/exists", str(out), "the folder has results", "go on with --resume, or choose another folder with --out")
    job = _sbatch(out / "slurm.sh", script)
    merging = _sbatch(out / "slurm_merge.sh", slurm_script([*words, "--merge", "--partial"], whole, prepared.study.name), f"--dependency=afterany:{job}")
    print(f"submitted: job {job} with {shards} shards, and job {merging}, which merges their results; progress: --status")
    return 0


def _sbatch(path: pathlib.Path, script: str, *options: str) -> str:
    path.write_text(script, encoding="utf-8")
    try:
        done = subprocess.run(["sbatch", "--parsable", *options, str(path)], capture_output=True, text=True, check=False)
    except OSError as why:
        fail("study/no_slurm", "sbatch", f"the job cannot be submitted: {why.strerror}", "submit it on a computer with Slurm, or print it: --dry-run")
    if done.returncode != 0:
        fail("study/no_slurm", "sbatch", f"Slurm refuses the job: {done.stderr.strip()}",
             "correct what Slurm says; what was printed can be edited and submitted")
    return done.stdout.strip().split(";")[0]


# ---------------------------------------------------------------------------- Looking

def _status(prepared: Prepared, out: pathlib.Path, mixed: bool) -> int:
    folder = Folder(prepared, out, mixed, begin=False)
    held = folder.results()
    todo, bad = missing(prepared, held, range(prepared.design.count))
    done = prepared.design.count - len(todo)
    others = len(held.keys) - done
    print(f"{out}: {done} of {prepared.design.count} points, {bad} with errors" + (f"; {others} results of other points" if others > 0 else ""))
    print(f"Tactus {folder.about['tactus']}, computer {folder.about['computer']}")
    return 0


def _point(prepared: Prepared, out: pathlib.Path, number: int) -> int:
    """Writes the records of one point, and its graph for the window."""
    if number >= prepared.design.count:
        raise ValueError(f"--point: there is no point {number}; they are 0 to {prepared.design.count - 1}")
    point = prepared.design.at(number)
    worker = Worker(prepared, is_far=False)
    graph, devices, records = worker.one(point)
    out.mkdir(parents=True, exist_ok=True)
    table_of(records).write(out / f"point-{number}.csv")
    data = json.loads(graph.text)
    values = {**prepared.study.set, **values_of([prepared.names[k] for k in prepared.fast], tuple(point[k] for k in prepared.fast))}
    for name in [name for name in values if name in data.get("controls", {})]:
        data["controls"][name]["value"] = values.pop(name)
    data["rate_hz"] = records.rate_hz
    made = Graph.parse(json.dumps(data), worker.folders["graph"])
    for name, value in values.items():
        node, _, param = name.rpartition(".")
        patch, _, inner = node.rpartition("/")
        made.set_param(inner, param, value, patch)
    for role, text in devices.items():
        made.set_device(role, json.loads(text))
    made.save(out / f"point-{number}.json")
    print(f"{out}/point-{number}.csv: {len(records['t'])} ticks of {json.dumps(values_of(prepared.names, point))}")
    print(f"open it in the window: tactus-host {out}/point-{number}.json")
    return 0
