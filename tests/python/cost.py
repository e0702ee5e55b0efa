#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Prints what Python costs: a whole render against the program's, and a step from Python.

    cost.py [--strict]     PYTHONPATH and TACTUS_PROGRAM as for the tests; --strict: exit status 1 if Graph.render takes more than 1.1
                           times the program's time
    cost.py --study BUILD [POINTS [ROUNDS]]     what a study costs beside a plain loop in C over the same renders, and its memory

Renders alternate with those of the program, and the median of the ratios of processor time counts, so that other load on the computer
slows both alike. The program is measured as a whole. Graph.render is measured from the call to the arrays; what an interpreter needs to
start, to import numpy and tactus, and to save the arrays is printed on its own, because a session pays it once.
"""

import itertools
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import tactus
from support import GRAPHS, PROGRAM, ROOT
from tactus import lab

GRAPH, SECONDS, ROUNDS = GRAPHS / "dry_wood.json", 120, 7
SCRIPT = """
import sys, numpy, tactus
run = tactus.Graph(sys.argv[1]).render(duration=float(sys.argv[2]))
numpy.savez(sys.argv[3], **run)
"""


def spent(command, **environment):
    """The processor time of a process and its children, in s, and the most memory of one of them, in MB."""
    process = subprocess.Popen(list(map(str, command)), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env={**os.environ, **environment})
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise RuntimeError(f"{command[0]} failed")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def took(command):
    """The processor time of a process, in s."""
    return spent(command)[0]


def per_call(function, count=20000):
    """The processor time of one call, in us: the median over ten rounds."""
    rounds = []
    for _ in range(10):
        start = time.process_time()
        for _ in range(count // 10):
            function()
        rounds.append((time.process_time() - start) / (count // 10))
    return 1e6 * statistics.median(rounds)


def renders():
    """The ratios of processor time: an interpreter that saves the arrays, and Graph.render alone, against the program."""
    whole, alone = {"csv": [], "wav": []}, {"csv": [], "wav": []}
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(ROUNDS):
            python = took([sys.executable, "-c", SCRIPT, str(GRAPH), str(SECONDS), f"{folder}/a.npz"])
            start = time.process_time()
            tactus.Graph(GRAPH).render(duration=SECONDS)
            inside = time.process_time() - start
            for kind in whole:
                program = took([PROGRAM, "render", str(GRAPH), "--duration", str(SECONDS), "--out", f"{folder}/a.{kind}"])
                whole[kind].append(python / program)
                alone[kind].append(inside / program)
    return {kind: (statistics.median(whole[kind]), statistics.median(alone[kind])) for kind in whole}


class Gain(tactus.Node):
    id = "own.gain"
    inputs = {"in": tactus.scalar("1")}
    outputs = {"out": tactus.scalar("1")}

    def tick(self, inputs, params):
        return {"out": 2 * getattr(inputs, "in")}


LOOP = r"""
#include <tactus/tactus.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
int main (int count, char** words)
{
    tactus_messages* messages = tactus_messages_create();
    tactus_graph* graph = tactus_graph_load (words[1], messages);
    char a[64], b[64];
    const char *ports[] = { "motor.force", "hand.position" }, *sets[] = { a, b };
    tactus_run_options options = TACTUS_RUN_OPTIONS;
    options.rate_hz = 1000.0;
    options.records = ports;
    options.sets = sets;
    options.record_count = options.set_count = 2;
    const int n = atoi (words[2]) * (count == 3);
    double sum = 0.0;
    for (int i = 0; i < n; ++i)
    {
        snprintf (a, sizeof a, "wall.stiffness=%.17g", 500.0 + 7500.0 * (i / 100) / (n / 100));
        snprintf (b, sizeof b, "wall.damping=%.17g", 20.0 * (i % 100) / 99.0);
        tactus_run* run = tactus_run_create (graph, &options, messages);
        if (tactus_run_open (run, messages) != TACTUS_OK) return 1;
        double peak = 0.0, work = 0.0, given = 0.0, r[6], before[6];
        for (int k = 0; k < 250; ++k)
        {
            tactus_run_tick (run);
            tactus_run_get_records (run, r);
            peak = fmax (peak, sqrt (r[0] * r[0] + r[1] * r[1] + r[2] * r[2]));
            for (int j = 0; j < 6; before[j] = r[j], ++j)
                if (k > 0 && j < 3) work += before[j] * (r[3 + j] - before[3 + j]);
            given = fmax (given, work);
        }
        sum += peak + given;
        tactus_run_free (run);
        tactus_messages_clear (messages);
    }
    return ! (sum > 0.0);
}
"""


def study_cost(build, count=100000, rounds=5):
    wall, numbers = ROOT / "docs/figures/stiffness_limit.json", itertools.count()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)

        def study(points, duration=0.25, executor="serial"):
            file = folder / f"{points}-{duration}.json"
            file.write_text(lab.Study(
                name="cost", graph=str(wall), duration=duration, rate=1000.0,
                factors=[lab.Factor("wall.stiffness", low=500.0, high=8000.0, count=points // 100), lab.Factor("wall.damping", low=0.0, high=20.0, count=100)],
                measures=[lab.Measure(kind, kind, port="motor.force", position="hand.position") for kind in ("peak", "given")]).text())
            return spent([sys.executable, "-m", "tactus.lab", "study", file, "--out", folder / f"out{next(numbers)}", "--executor", executor, "--workers", 2],
                         PYTHONPYCACHEPREFIX=str(folder / "cache"), PYTHONDONTWRITEBYTECODE="")   # compiled, as in an installed package

        def compare(what, measure):
            ratios = []
            for _ in range(rounds):
                ours, alone = measure()
                ratios.append(ours / alone)
                print(f"{what}: {ours:.2f} s, alone {alone:.2f} s, ratio {ratios[-1]:.3f}; load {os.getloadavg()[0]:.1f}", flush=True)
            print(f"{what}: median ratio {statistics.median(ratios):.3f}")

        (folder / "loop.c").write_text(LOOP)
        subprocess.run(["cc", "-O2", "-o", folder / "loop", folder / "loop.c", f"-I{build}/include", f"-L{build}", "-ltactus", "-lm",
                        f"-Wl,-rpath,{pathlib.Path(build).resolve()}"], check=True)
        study(200)   # compiles Python
        for points in (1000, 10000, 100000):
            print(f"{points} points: {study(points)[1]:.1f} MB")
        compare(f"{count} renders, and a loop in C", lambda: (study(count)[0], took([folder / "loop", wall, count])))
        for by in ("local", "dask"):   # 4000 more renders of 25 s
            compare(by, lambda: [study(5000, 25.0, each)[0] - study(1000, 25.0, each)[0] for each in (by, "serial")])


def main():
    if "--study" in sys.argv:
        return study_cost(sys.argv[2], *map(int, sys.argv[3:]))
    ratios = renders()
    for kind, (whole, alone) in ratios.items():
        print(f"{GRAPH.stem} for {SECONDS} s, against `tactus render --out a.{kind}`: {alone:.2f} by Graph.render, "
              f"{whole:.2f} by a new interpreter that imports numpy and tactus, renders and saves .npz")
    start = statistics.median(took([sys.executable, "-c", "import tactus"]) for _ in range(5))
    numpy = statistics.median(took([sys.executable, "-c", "import numpy"]) for _ in range(5))
    print(f"an interpreter that imports numpy: {1e3 * numpy:.0f} ms; that imports tactus too: {1e3 * start:.0f} ms")

    engine = tactus.Engine(tactus.Graph(GRAPH), feed={"drag.mu": 0.4}, record=["motor.force"])
    row = engine.step({"drag.mu": 0.4})["t"].reshape(1, 1)
    block = 1000
    tick = per_call(lambda: engine.step_rows(row.repeat(block, 0), block), 200) / block
    print(f"one tick: {tick:.2f} us within a block of {block}, {per_call(lambda: engine.step_rows(row)):.2f} us by step_rows, "
          f"{per_call(lambda: engine.step({'drag.mu': 0.4})):.2f} us by step")
    own = tactus.Graph(rate=4000)
    own.add_node("gain", "own.gain")
    slow = tactus.Engine(own, feed={"gain.in": 1.0}, nodes=[Gain])
    print(f"a node in Python: {per_call(lambda: slow.step(n=block), 50) / block:.2f} us a tick")
    return 1 if "--strict" in sys.argv and max(alone for _, alone in ratios.values()) > 1.1 else 0


if __name__ == "__main__":
    sys.exit(main())
