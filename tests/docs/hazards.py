#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks the table in docs/hazards.md: at least 24 rows without an empty cell, each of which names a test that exists in its last
cell, or says "hardware" there and "only hardware" under detection.

    hazards.py [ROOT]     ROOT is the repository, by default the one that contains this file
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[2]
COLUMNS = ["component", "fault", "detection", "reaction", "time until zero", "test"]
LEAST_ROWS = 24

tests = {file.stem for pattern in ("**/*_test.cpp", "python/*_test.py", "guest/own_*", "site/*_test.*") for file in ROOT.glob("tests/" + pattern)}
lines = [line for line in (ROOT / "docs/hazards.md").read_text(encoding="utf-8").splitlines() if line.startswith("|")]
table = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
problems = []
if not table or table[0] != COLUMNS:
    problems.append(f"the table must have the columns {COLUMNS}")
rows = table[2:]
if len(rows) < LEAST_ROWS:
    problems.append(f"there are {len(rows)} hazards, fewer than {LEAST_ROWS}")
for row in rows:
    where = " / ".join(row[:2])
    if len(row) != len(COLUMNS) or not all(row):
        problems.append(f"{where}: a cell is missing or empty")
    elif row[-1] == "hardware":
        if not row[2].startswith("only hardware"):
            problems.append(f"{where}: the detection must say what hardware does: only hardware: ...")
    else:
        named = re.findall(r"`(\w+)`", row[-1])
        problems += [f"{where}: there is no test {test}" for test in named if test not in tests]
        if not named:
            problems.append(f"{where}: no test is named")

print("\n".join([*problems, f"{len(rows)} hazards, {len(problems)} problems"]))
sys.exit(1 if problems else 0)
