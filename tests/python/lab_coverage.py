#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How often nominal 95 % intervals of tactus.lab hold the truth, over simulated experiments.

    lab_coverage.py [--runs 2000] [--seed SEED] [METHOD...]

Without --seed, the seed is drawn. A method is PROCEDURE/FUNCTION: constant (7 levels of 40 trials), staircase or psi (both 80 trials in two intervals;
1 up, 2 down), logistic, normal or weibull; or detection (100 signals, 100 noises), or power (5 levels of 10 magnitudes). Each prints how many intervals
held the true threshold (or d', or exponent), and the true width (or criterion): by profile likelihood, and then of the posterior."""

import argparse
import math
import secrets

import numpy as np
from lab_protocol_test import block, protocol, walk
from tactus import lab
from tactus.lab import _analysis
from tactus.lab._procedures import Draw

THRESHOLD, WIDTH = 10.0, {"logistic": 1.0, "normal": 1.7, "weibull": 3.5}
LEVELS = (6.0, 7.5, 9.0, 10.0, 11.0, 12.5, 14.0)


def answered(procedure, function, seed):
    """The levels of an experiment, whether the answers of a simulated observer were right, and the guess rate."""
    task, given = {"constant": ("yes_no", lab.Constant(levels=LEVELS, repeats=40)),
                   "staircase": ("2ifc", lab.Staircase(start=16.0, steps=(2.0, 1.0, 0.5), low=0.5, high=40.0, trials=80)),
                   "psi": ("2ifc", lab.Psi(levels=tuple(range(2, 22)), widths=tuple(WIDTH[function] * 2.0 ** k for k in (-2, -1, 0, 1, 2)),
                                           lapses=(0.0, 0.03), function=function, trials=80))}[procedure]
    observer = lab.Observer(THRESHOLD, WIDTH[function], lapse=0.02, function=function, seed=seed)
    trials = walk(lab.Plan(protocol(block("main", task, given), seed=seed)), lambda trial: observer.answer(trial, trial.level))[1]
    return [t.level for t in trials], [t.outcome(observer.answer(t, t.level)) for t in trials], trials[0].block.guess_rate


def run(method, seed):
    """Whether the intervals of one experiment hold the truth."""
    draw = Draw(seed)
    if method == "detection":
        d, c = 1.5, 0.3
        hits, alarms = (sum(draw.uniform() < rate for _ in range(100)) for rate in lab.probability("normal", [0.5 * d - c, -0.5 * d - c], 0.0, 1.0))
        return [low <= truth <= high for (low, high), truth in zip(lab.detection(hits, 100, alarms, 100)[2:], (d, c))]
    if method == "power":
        levels = np.repeat([1.0, 2.0, 4.0, 8.0, 16.0], 10)
        answers = [5.0 * level ** 0.8 * math.exp(0.3 * draw.normal()) for level in levels]
        low, high = lab.power_law(levels, answers).exponent_interval
        return [low <= 0.8 <= high]
    procedure, function = method.split("/")
    levels, right, guess = answered(procedure, function, seed)
    given = _analysis._Likelihood(function, *_analysis._gathered(levels, right, None), guess, None)
    truths = THRESHOLD if function != "weibull" else math.log(THRESHOLD), math.log(WIDTH[function])
    return [low <= truth <= high for best in (given.best(), None) for (low, _, high), truth in zip(given.ends(0.95, best)[0], truths)]


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--runs", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=secrets.randbits(32))
    parser.add_argument("methods", nargs="*", default=[*(f"{p}/{f}" for p in ("constant", "staircase", "psi") for f in WIDTH), "detection", "power"])
    asked = parser.parse_args()
    for method in asked.methods:
        shares = np.mean([run(method, asked.seed + i) for i in range(asked.runs)], axis=0)
        print(f"{method}: " + ", ".join(f"{share:.1%}" for share in shares) + f" of {asked.runs} runs, seed {asked.seed}", flush=True)
