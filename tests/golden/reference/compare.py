#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Holds `tactus render` to an independent implementation of the models.

compare.py --program PATH [--seeds N] [--first SEED] [--model NAME]...
    random sets, each a graph and a feed, of each model;
compare.py --golden
    the implementation itself, against the golden sets.

Prints a line a model: number of sets, worst error in units of its tolerance.
Exit status 1 if anything differs; its graph and feed are kept and named.
"""

import argparse
import csv
import json
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile

import golden
import sets
import tolerance


def write_graph(set_, path):
    path.write_text(json.dumps({
        "format": "tactus-graph", "version": 1, "name": "Random set",
        "rate_hz": set_.rate, "devices": set_.devices, "nodes": set_.nodes,
        "wires": set_.wires}, indent=1))


def write_feed(set_, path):
    with open(path, "w", newline="") as file:
        out = csv.writer(file)
        out.writerow(set_.feed)
        out.writerows(map(repr, row) for row in zip(*set_.feed.values()))


def render(program, set_, folder):
    """The recorded columns; a sentence instead where the program refuses."""
    graph, feed, table = (folder / f for f in ("graph.json", "feed.csv", "out.csv"))
    write_graph(set_, graph)
    command = [program, "render", str(graph), "--out", str(table), "--record",
               ",".join(e.column for e in set_.expected)]
    if set_.feed:
        write_feed(set_, feed)
        command += ["--feed", str(feed)]
    else:
        command += ["--duration", repr(set_.rows * set_.dt)]
    ran = subprocess.run(command, capture_output=True, text=True)
    if ran.returncode != 0:
        return f"status {ran.returncode}: {ran.stderr.strip()}"
    with open(table, newline="") as file:
        header, *body = list(csv.reader(file))
    return dict(zip(header, zip(*([float(x) for x in row] for row in body))))


def judge(set_, got):
    """(error in units of its tolerance, sentence) of the worst column."""
    if isinstance(got, str):
        return float("inf"), got
    found = (0.0, "")
    for wanted in set_.expected:
        actual = got[wanted.column]
        if len(actual) != set_.rows:
            return float("inf"), f"{len(actual)} rows instead of {set_.rows}"
        most, row = tolerance.worst(wanted.values, actual, wanted.tolerance,
                                    wanted.free)
        if most > found[0]:
            found = most, (f"{wanted.column} row {row}: {actual[row]!r} instead "
                           f"of {wanted.values[row]!r}, {most:.3g} x tolerance")
    return found


def one(program, model, seed):
    """Renders and compares one set; keeps its folder where it differs."""
    set_ = sets.MODELS[model](random.Random(f"{model} {seed}"))
    folder = pathlib.Path(tempfile.mkdtemp(prefix=f"tactus_{model}_{seed}_"))
    error, sentence = judge(set_, render(program, set_, folder))
    if error <= 1.0:
        shutil.rmtree(folder)
        return error, None
    return error, f"  seed {seed}: {sentence}\n    kept in {folder}"


def unknown_type(program, model):
    """A node type of the model that the program does not have."""
    types = {node["type"] for node in
             sets.MODELS[model](random.Random(model)).nodes.values()}
    return next((kind for kind in sorted(types) if subprocess.run(
        [program, "nodes", kind], capture_output=True).returncode), None)


def compare(program, model, seeds):
    """Whether all sets of a model agree."""
    missing = unknown_type(program, model)
    if missing:
        print(f"skipped: {model}, for there is no {missing}")
        return True
    results = [one(program, model, seed) for seed in seeds]
    wrong = [sentence for _, sentence in results if sentence]
    worst = max(error for error, _ in results)
    print(f"{model}: {len(results)} sets, {len(wrong)} differ, "
          f"worst error {worst:.2g} of its tolerance")
    for sentence in wrong:
        print(sentence)
    return not wrong


def compare_golden():
    """Whether the implementation meets every golden set."""
    right = True
    for name in golden.MODELS:
        most, column, row = golden.check(name)
        right = right and most <= 1.0
        print(f"{name}: worst error {most:.2g} of its tolerance "
              f"({column}, row {row})")
    return right


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--program", help="path of tactus")
    parser.add_argument("--seeds", type=int, default=20, help="sets a model (20)")
    parser.add_argument("--first", type=int, default=1, help="first seed (1)")
    parser.add_argument("--model", action="append", choices=sorted(sets.MODELS))
    parser.add_argument("--golden", action="store_true",
                        help="check the implementation on the golden sets")
    given = parser.parse_args()
    if not given.golden and not given.program:
        parser.error("--program or --golden is needed")
    right = compare_golden() if given.golden else True
    if given.program:
        seeds = range(given.first, given.first + given.seeds)
        for model in given.model or sets.MODELS:
            right = compare(given.program, model, seeds) and right
    return 0 if right else 1


if __name__ == "__main__":
    sys.exit(main())
