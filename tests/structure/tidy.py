#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Looks for mistakes with clang-tidy: ./test.sh --tidy

Usage: tidy.py BUILD [PART/PARTS | FILE...]. BUILD has compile_commands.json. Checks all files of the repository that are compiled, or every PARTS-th
of them from the PART-th on, or these files. .clang-tidy has the checks, and reasons for those that are off. Prints each problem once. Exit status 1
if there are any."""

import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOUND = re.compile(r"^(.*?):(\d+):\d+: (?:warning|error): ", re.MULTILINE)


def chosen(build, wanted):
    commands = json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))
    files = sorted({pathlib.Path(c["directory"], c["file"]).resolve() for c in commands})
    files = [f for f in files if f.is_relative_to(ROOT) and not f.is_relative_to(build)]
    part = re.fullmatch(r"(\d+)/(\d+)", wanted[0]) if wanted else None
    if part:
        return files[int(part[1]) - 1 :: int(part[2])]
    return [pathlib.Path(f).resolve() for f in wanted] or files


def check(build, file):
    ran = subprocess.run(["clang-tidy-14", "-p", str(build), "--quiet", str(file)], capture_output=True, text=True, check=False)
    return file, ran.stdout if FOUND.search(ran.stdout) else ran.stderr if ran.returncode != 0 else ""


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    files = chosen(build, sys.argv[2:])
    seen, failed = set(), False
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for number, (file, text) in enumerate(pool.map(lambda f: check(build, f), files), 1):
            print(f"{number} of {len(files)}: {file.relative_to(ROOT)}", file=sys.stderr, flush=True)
            if text and not FOUND.search(text):
                print(text)
                failed = True
            starts = [m.start() for m in FOUND.finditer(text)] + [len(text)]
            for begin, end in zip(starts, starts[1:]):
                problem = text[begin:end]
                place = FOUND.match(problem)
                if (place[1], place[2]) not in seen:
                    print(problem.replace(f"{ROOT}/", ""), end="")
                seen.add((place[1], place[2]))
    print(f"{len(files)} files, {len(seen)} problems")
    return 1 if seen or failed else 0


sys.exit(main())
