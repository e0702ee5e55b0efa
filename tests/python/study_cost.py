# SPDX-License-Identifier: MIT
"""What a study costs beside a plain loop in C over the same renders, in memory and in processor time, in turn. Judges nothing.

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


def spent(words, **environment):
    """The processor time of a program and its children, in s, and the most memory of one process, in MB."""
    process = subprocess.Popen(list(map(str, words)), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env={**os.environ, **environment})
    _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise subprocess.CalledProcessError(process.returncode, words)
    return used.ru_utime + used.ru_stime, used.ru_maxrss / 1024


def main(build, count=100000, rounds=5):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        compiled = {"PYTHONPYCACHEPREFIX": str(folder / "cache"), "PYTHONDONTWRITEBYTECODE": ""}   # as in an installed package
        numbers = iter(range(10**6))

        def study(points, duration=0.25, executor="serial"):
            file = folder / f"{points}-{duration}.json"
            file.write_text(lab.Study(
                name="cost", graph=str(GRAPH), duration=duration, rate=1000.0,
                factors=[lab.Factor("wall.stiffness", low=500.0, high=8000.0, count=points // 100), lab.Factor("wall.damping", low=0.0, high=20.0, count=100)],
                measures=[lab.Measure(kind, kind, port="motor.force", position="hand.position") for kind in ("peak", "given")]).text())
            return spent([sys.executable, "-m", "tactus.lab", "study", file, "--out", folder / f"out{next(numbers)}", "--executor", executor, "--workers", 2],
                         **compiled)

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
        compare(f"{count} renders, and a loop in C", lambda: (study(count)[0], spent([folder / "loop", GRAPH, count])[0]))
        for by in ("local", "dask"):   # 25 s of a wall, 4000 of them more
            compare(by, lambda: [study(5000, 25.0, each)[0] - study(1000, 25.0, each)[0] for each in (by, "serial")])


if __name__ == "__main__":
    main(sys.argv[1], *map(int, sys.argv[2:]))
