#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Prints what Python costs: a whole render against the program's, and a step from Python.

    cost.py [--strict]     PYTHONPATH and TACTUS_PROGRAM as for the tests; --strict: exit status 1 if Graph.render takes more than 1.1
                           times the program's time

Renders alternate with those of the program, and the median of the ratios of processor time counts, so that other load on the computer
slows both alike. The program is measured as a whole. Graph.render is measured from the call to the arrays; what an interpreter needs to
start, to import numpy and tactus, and to save the arrays is printed on its own, because a session pays it once.
"""

import os
import statistics
import subprocess
import sys
import tempfile
import time

import tactus
from support import GRAPHS, PROGRAM

GRAPH, SECONDS, ROUNDS = GRAPHS / "dry_wood.json", 120, 7
SCRIPT = """
import sys, numpy, tactus
run = tactus.Graph(sys.argv[1]).render(duration=float(sys.argv[2]))
numpy.savez(sys.argv[3], **run)
"""


def took(command):
    """The processor time of a process, in s."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise RuntimeError(f"{command[0]} failed")
    return usage.ru_utime + usage.ru_stime


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


def main():
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
