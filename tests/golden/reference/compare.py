#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares `tactus render` with an independent implementation of the models.

compare.py --program PATH [--seeds N] [--first SEED] [--model NAME]...
    random sets (a graph and a feed) for each model;
compare.py --golden
    compares the implementation itself with the golden sets.

Prints one line per model: the number of sets, and the worst error in units of its tolerance.
A model that the program lacks is skipped.
Exits with status 1 if anything differs, and prints where the graph and the feed are stored.
"""

import argparse
import csv
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

import golden
import sets
import tolerance


def write_graph(set_, path):
    rate = set_.rate if set_.clock == "graph" else 1000.0
    path.write_text(json.dumps({
        "format": "tactus-graph", "version": 2, "name": "Random set",
        "rate_hz": rate, "devices": set_.devices, "nodes": set_.nodes,
        "wires": set_.wires}, indent=1))


def write_feed(set_, path):
    columns = dict(set_.feed)
    if set_.clock == "time":
        columns = {"t": [k * set_.dt for k in range(set_.rows)], **columns}
    with open(path, "w", newline="") as file:
        out = csv.writer(file)
        out.writerow(columns)
        out.writerows(map(repr, row) for row in zip(*columns.values()))


def render(program, set_, folder):
    """Returns the recorded columns, or a message if the program refuses the graph."""
    graph, feed, table = (folder / f for f in ("graph.json", "feed.csv", "out.csv"))
    write_graph(set_, graph)
    command = [program, "render", str(graph), "--out", str(table), "--record",
               ",".join(e.column for e in set_.expected)]
    if set_.feed:
        write_feed(set_, feed)
        command += ["--feed", str(feed)]
    else:
        command += ["--duration", repr(set_.rows * set_.dt)]
    if set_.clock == "option":
        command += ["--rate", repr(set_.rate)]
    ran = subprocess.run(command, capture_output=True, text=True)
    if ran.returncode != 0:
        return f"status {ran.returncode}: {ran.stderr.strip()}"
    with open(table, newline="") as file:
        header, *body = list(csv.reader(file))
    return dict(zip(header, zip(*([float(x) for x in row] for row in body))))


def restless(set_, got):
    """Describes the first output that changes while all inputs of its node repeat, if there is one."""
    for name in set_.nodes:
        fed = list(zip(*(column for port, column in set_.feed.items()
                         if port.startswith(name + "."))))
        rests = [k for k in range(1, set_.rows) if fed[k] == fed[k - 1]]
        for port, column in got.items():
            if not port.startswith(name + ".") or port.endswith(".state"):
                continue
            for k in rests:
                if column[k] != column[k - 1]:
                    return (f"{port} row {k}: {column[k]!r} after "
                            f"{column[k - 1]!r}, although the sample repeats")
    return ""


def judge(set_, got):
    """Returns (error in units of its tolerance, message) for the worst column."""
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
    moved = restless(set_, got) if set_.time_free and found[0] <= 1.0 else ""
    return (float("inf"), moved) if moved else found


def one(program, model, seed):
    """Renders and compares one set. Keeps its folder if the results differ."""
    set_ = sets.make(model, seed)
    folder = pathlib.Path(tempfile.mkdtemp(prefix=f"tactus_{model}_{seed}_"))
    error, sentence = judge(set_, render(program, set_, folder))
    if error <= 1.0:
        shutil.rmtree(folder)
        return error, None
    return error, f"  seed {seed}: {sentence}\n    stored in {folder}"


def unknown_type(program, model):
    """Returns a node type of the model that the program does not have, or None."""
    types = {node["type"] for node in sets.make(model, 1).nodes.values()}
    return next((kind for kind in sorted(types) if subprocess.run(
        [program, "nodes", kind], capture_output=True).returncode), None)


def compare(program, model, seeds):
    """Returns whether all sets of a model agree."""
    missing = unknown_type(program, model)
    if missing:
        print(f"skipped: {model}: the program has no node type {missing}")
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
    """Returns whether the implementation reproduces every golden set."""
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
    parser.add_argument("--seeds", type=int, default=20, help="number of sets per model; default: 20")
    parser.add_argument("--first", type=int, default=1, help="first seed; default: 1")
    parser.add_argument("--model", action="append", choices=sorted(sets.MODELS))
    parser.add_argument("--golden", action="store_true",
                        help="check the implementation on the golden sets")
    given = parser.parse_args()
    if not given.golden and not given.program:
        parser.error("either --program or --golden is required")
    right = compare_golden() if given.golden else True
    if given.program:
        seeds = range(given.first, given.first + given.seeds)
        for model in given.model or sets.MODELS:
            right = compare(given.program, model, seeds) and right
    return 0 if right else 1


if __name__ == "__main__":
    sys.exit(main())
