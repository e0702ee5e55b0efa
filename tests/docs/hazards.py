#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks the table in docs/hazards.md: at least 24 rows without an empty cell, each of which names a test that exists in its last
cell, or says "hardware" there and "only hardware" under detection. The cell before it must say "tried in wine" if all these tests run in wine, and else
"not tried". Checks also that the page shows the table of force_causes.hpp, that the code and the tests that this names exist, and that it lists every OSC
message but those of HARMLESS.

    hazards.py [ROOT] [--write]   ROOT is the repository, by default the one that contains this file; --write: puts the table and what was tried into the page
"""
import pathlib
import re
import sys

arguments = [a for a in sys.argv[1:] if a != "--write"]
ROOT = pathlib.Path(arguments[0]) if arguments else pathlib.Path(__file__).resolve().parents[2]
COLUMNS = ["component", "fault", "detection", "reaction", "time until zero", "Windows", "test"]
LEAST_ROWS = 24
CAUSES, OSC = "host/devices/live/force_causes.hpp", "host/devices/osc/remote_control.cpp"
HARMLESS = {"/tactus/" + name for name in ("hello", "stop", "emergency", "probe", "trigger", "status", "costs", "cost", "guard", "done", "error", "capture", "value")}
BEGIN, END = f"<!-- the table of {CAUSES} -->", "<!-- end of the table -->"

tests = {file.stem for pattern in ("**/*_test.cpp", "python/*_test.py", "host/devices/live/*_test.py", "guest/own_*", "site/*_test.*") for file in ROOT.glob("tests/" + pattern)}
page = (ROOT / "docs/hazards.md").read_text(encoding="utf-8")

sys.path.insert(0, str(ROOT / "tests/windows"))
from left_out import LEFT_OUT, TRIED   # noqa: E402

parts = (ROOT / "tests/windows/parts.cmake").read_text(encoding="utf-8")
refused = [re.compile(pattern.replace("/tests/", "")) for pattern in re.findall(r'EXCLUDE REGEX "([^"]*)"', parts)]
in_wine = {file.stem for pattern in TRIED for file in (ROOT / "tests").glob(pattern.replace("/*", "/**/*", 1))
           if file.stem not in LEFT_OUT and not any(each.search("/" + file.relative_to(ROOT / "tests").as_posix()) for each in refused)}


def tried(row):
    """What the column Windows must say of a row."""
    named = re.findall(r"`(\w+)`", row[-1])
    return "tried in wine" if named and all(test in in_wine for test in named) else "not tried"


def filled(line):
    row = [cell.strip() for cell in line.strip("|").split("|")]
    if not line.startswith("|") or len(row) != len(COLUMNS) or row[0] in (COLUMNS[0], "---"):
        return line
    return "| " + " | ".join([*row[:-2], tried(row), row[-1]]) + " |"


faults, _, rest = page.partition(BEGIN)
if "--write" in sys.argv:
    faults = "\n".join(map(filled, faults.split("\n")))
shown, _, after = rest.partition(END)
lines = [line for line in faults.splitlines() if line.startswith("|")]
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
    elif row[-2] != tried(row):
        problems.append(f"{where}: Windows must say {tried(row)!r}: run tests/docs/hazards.py --write")
    elif row[-1] == "hardware":
        if not row[2].startswith("only hardware"):
            problems.append(f"{where}: the detection must say what hardware does: only hardware: ...")
    else:
        named = re.findall(r"`(\w+)`", row[-1])
        problems += [f"{where}: there is no test {test}" for test in named if test not in tests]
        if not named:
            problems.append(f"{where}: no test is named")

cause = re.compile(r'\{' + ",".join([r'\s*"([^"]*)"'] * 5) + r"\s*\}")
causes = cause.findall((ROOT / CAUSES).read_text(encoding="utf-8"))
right = "\n".join(["", "", "| event | who may cause it | after which stops it works | code | test |", "|---|---|---|---|---|",
                   *(f"| {event} | {who} | {stops} | `{code.partition(': ')[0]}`: `{code.partition(': ')[2]}` | `{test}` |"
                     for event, who, stops, code, test in causes), "", ""])
if "--write" in sys.argv:
    (ROOT / "docs/hazards.md").write_text(faults + BEGIN + right + END + after, encoding="utf-8")
elif shown != right:
    problems.append(f"the page does not show the table of {CAUSES}: run tests/docs/hazards.py --write")
for event, _, _, code, test in causes:
    file, _, function = code.partition(": ")
    text = (ROOT / file).read_text(encoding="utf-8") if (ROOT / file).is_file() else ""
    if not re.search(rf"\b{re.escape(function.split('::')[-1])} ?\(", text):
        problems.append(f"{event}: there is no {function} in {file}")
    if test not in tests:
        problems.append(f"{event}: there is no test {test}")
listed = {event.strip("`") for event, *_ in causes if event.startswith("`/")}
used = {address for address in re.findall(r'"(/tactus/\w+/?)"', (ROOT / OSC).read_text(encoding="utf-8"))}
problems += [f"{address}: {CAUSES} does not list it, and it is not HARMLESS" for address in sorted(used - listed - HARMLESS)]
problems += [f"{address}: {OSC} has no such message" for address in sorted(listed - used)]

print("\n".join([*problems, f"{len(rows)} hazards, {sum(row[-2] == 'tried in wine' for row in rows)} of them tried in wine, {len(causes)} causes of a force, {len(problems)} problems"]))
sys.exit(1 if problems else 0)
