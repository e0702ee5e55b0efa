# SPDX-License-Identifier: MIT
"""What a study costs beside a plain loop in C over the same renders. Measures processor times in turn, and judges none.

    PYTHONPATH=build/release/python python3 tests/python/study_cost.py build/release [POINTS [ROUNDS]]"""

import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile

from support import ROOT
from tactus import lab

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
    const int n = atoi (words[2]);
    double sum = 0.0;
    for (int i = 0; i < n; ++i)
    {
        char a[64], b[64];
        const char* sets[] = { a, b };
        snprintf (a, sizeof a, "wall.stiffness=%.17g", 500.0 + 7500.0 * (i / 100) / (n / 100));
        snprintf (b, sizeof b, "wall.damping=%.17g", 20.0 * (i % 100) / 99.0);
        tactus_run_options options = TACTUS_RUN_OPTIONS;
        options.rate_hz = 1000.0;
        options.records = ports;
        options.record_count = 2;
        options.sets = sets;
        options.set_count = 2;
        tactus_run* run = tactus_run_create (graph, &options, messages);
        if (tactus_run_open (run, messages) != TACTUS_OK) return 1;
        double peak = 0.0, work = 0.0, given = 0.0, r[6], before[6];
        for (int k = 0; k < 250; ++k)
        {
            tactus_run_tick (run);
            tactus_run_get_records (run, r);
            const double size = sqrt (r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
            if (size > peak) peak = size;
            for (int j = 0; k > 0 && j < 3; ++j)
                work += before[j] * (r[3 + j] - before[3 + j]);
            for (int j = 0; j < 6; ++j)
                before[j] = r[j];
            if (work > given) given = work;
        }
        sum += peak + given;
        tactus_run_free (run);
        tactus_messages_clear (messages);
    }
    printf ("%.17g\n", sum);
    return count < 0;
}
"""


def children_s():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def main(build, count=10000, rounds=5):
    graph = ROOT / "docs/figures/stiffness_limit.json"
    study = lab.Study(name="cost", graph=str(graph), duration=0.25, rate=1000.0,
                      factors=[lab.Factor("wall.stiffness", low=500.0, high=8000.0, count=count // 100),
                               lab.Factor("wall.damping", low=0.0, high=20.0, count=100)],
                      measures=[lab.Measure("peak", "peak", port="motor.force"), lab.Measure("given", "given", port="motor.force", position="hand.position")])
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "loop.c").write_text(LOOP)
        subprocess.run(["cc", "-O2", "-o", folder / "loop", folder / "loop.c", f"-I{build}/include", f"-L{build}", "-ltactus", "-lm",
                        f"-Wl,-rpath,{pathlib.Path(build).resolve()}"], check=True)
        (folder / "s.json").write_text(study.text())
        ratios = []
        for k in range(rounds):
            a = children_s()
            subprocess.run([folder / "loop", graph, str(count)], check=True, stdout=subprocess.DEVNULL)
            b = children_s()
            subprocess.run([sys.executable, "-m", "tactus.lab", "study", folder / "s.json", "--out", folder / f"out{k}", "--executor", "serial"],
                           check=True, capture_output=True)
            c = children_s()
            subprocess.run([sys.executable, "-m", "tactus.lab", "study", folder / "s.json", "--out", folder / f"out{k}", "--status"],
                           check=True, capture_output=True)
            d = children_s()
            ratios.append((c - b) / (b - a))
            print(f"{count} renders: loop in C {b - a:.2f} s, study {c - b:.2f} s, of which start of Python and counting {d - c:.2f} s; ratio {ratios[-1]:.3f}",
                  flush=True)
        print(f"median ratio {statistics.median(ratios):.3f}; most memory of a child {resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024:.0f} MB")


if __name__ == "__main__":
    main(sys.argv[1], *map(int, sys.argv[2:]))
