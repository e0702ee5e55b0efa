# SPDX-License-Identifier: MIT
"""What a study costs beside a plain loop in C over the same renders. Measures processor times in turn, and judges none.

    PYTHONPATH=build/release/python python3 tests/python/study_cost.py build/release [POINTS [ROUNDS]]"""

import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

from support import ROOT
from tactus import lab

GRAPH = ROOT / "docs/figures/stiffness_limit.json"
LOOP = r"""
#include <tactus/tactus.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
int main (int count, char** words)
{
    tactus_messages* messages = tactus_messages_create();
    tactus_graph* graph = tactus_graph_load (words[1], messages);
    const char* ports[] = { "motor.force", "hand.position" };
    char a[64], b[64];
    const char* sets[] = { a, b };
    tactus_run_options options = TACTUS_RUN_OPTIONS;
    options.rate_hz = 1000.0;
    options.records = ports;
    options.sets = sets;
    options.record_count = options.set_count = 2;
    const int n = atoi (words[2]);
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
    printf ("%.17g\n", sum);
    return count < 0;
}
"""


def spent(words, **environment):
    """The processor time of a program and its children, in s, and the most memory of one process, in MB."""
    process = subprocess.Popen(list(map(str, words)), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env={**os.environ, **environment})
    _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise subprocess.CalledProcessError(process.returncode, words)
    return used.ru_utime + used.ru_stime, used.ru_maxrss / 1024


def main(build, count=10000, rounds=5):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        compiled = {"PYTHONPYCACHEPREFIX": str(folder / "cache"), "PYTHONDONTWRITEBYTECODE": ""}   # as in an installed package
        numbers = iter(range(10**6))

        def study(points, duration, executor="serial"):
            file = folder / f"{points}-{duration}.json"
            file.write_text(lab.Study(
                name="cost", graph=str(GRAPH), duration=duration, rate=1000.0,
                factors=[lab.Factor("wall.stiffness", low=500.0, high=8000.0, count=points // 100), lab.Factor("wall.damping", low=0.0, high=20.0, count=100)],
                measures=[lab.Measure(kind, kind, port="motor.force", position="hand.position") for kind in ("peak", "given")]).text())
            return spent([sys.executable, "-m", "tactus.lab", "study", file, "--out", folder / f"out{next(numbers)}", "--executor", executor, "--workers", 2],
                         **compiled)

        (folder / "loop.c").write_text(LOOP)
        subprocess.run(["cc", "-O2", "-o", folder / "loop", folder / "loop.c", f"-I{build}/include", f"-L{build}", "-ltactus", "-lm",
                        f"-Wl,-rpath,{pathlib.Path(build).resolve()}"], check=True)
        start, _ = min(study(200, 0.25) for _ in range(3))
        ratios = []
        for _ in range(rounds):
            loop, _ = spent([folder / "loop", GRAPH, count])
            whole, memory = study(count, 0.25)
            ratios.append(whole / loop)
            print(f"{count} renders: loop in C {loop:.2f} s, study {whole:.2f} s, of which start {start:.2f} s; ratio {ratios[-1]:.3f}; {memory:.0f} MB",
                  flush=True)
        few = study(count // 5, 0.25)[1]
        print(f"median ratio {statistics.median(ratios):.3f}; most memory with {count // 5} points {few:.0f} MB, with {count} {memory:.0f} MB")
        for executor in ("local", "dask"):
            ratios = []
            for _ in range(rounds):
                few, many, plain_few, plain_many = (study(points, 25.0, by)[0] for by in (executor, "serial") for points in (1000, 5000))
                ratios.append((many - few) / (plain_many - plain_few))
                print(f"{executor}: 4000 more renders take {many - few:.2f} s, alone {plain_many - plain_few:.2f} s; ratio {ratios[-1]:.3f}", flush=True)
            print(f"{executor}: median ratio {statistics.median(ratios):.3f}")


if __name__ == "__main__":
    main(sys.argv[1], *map(int, sys.argv[2:]))
