#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Looks for mistakes with clang-tidy: ./test.sh --tidy

Usage: tidy.py BUILD [PART/PARTS | --changed | FILE...]. BUILD has compile_commands.json. Checks all sources of the repository, in the batches in
which they are compiled; or every PARTS-th batch from the PART-th on; or what changed since the branch left origin/main, or since the last commit;
or these files. .clang-tidy has the checks, and reasons for those that are off. Prints each problem once. Exit status 1 if there are any."""

import concurrent.futures
import json
import pathlib
import re
import resource
import subprocess
import sys

from commands import ROOT, cover, cpus, read

FOUND = re.compile(r"^(/.*?):(\d+):\d+: (?:warning|error): ", re.MULTILINE)
MOST_FILES, MOST_SECONDS = 6, 90   # of a processor, for --changed


def git(*arguments):
    ran = subprocess.run(["git", "-c", "safe.directory=*", "-C", ROOT, *arguments], capture_output=True, text=True, check=False)
    return ran.stdout.split("\0") if ran.returncode == 0 else []


def changed(known):
    """The changed sources and headers. A clone without history cannot tell, so its commit picks some sources."""
    head = "".join(git("rev-parse", "HEAD")).strip()
    base = "".join(git("merge-base", "origin/main", "HEAD")).strip()
    if base in ("", head):
        base = "".join(git("rev-parse", "--verify", "--quiet", "HEAD~1")).strip()
    names = git("diff", "-z", "--name-only", "--diff-filter=d", base or "HEAD") + git("ls-files", "-z", "--others", "--exclude-standard")
    files = [ROOT / n for n in names if n]
    files = [f for f in files if f in known or (f.suffix == ".hpp" and f.relative_to(ROOT).parts[0] in ("framework", "nodes", "host"))]
    if base or files:
        return files
    every = -(-len(known) // MOST_FILES)
    return sorted(known)[int(head or "0", 16) % every :: every]


def one_by_one(build, commands):
    """Writes a command for each source, from which clang-tidy also infers those of headers, and returns where and which."""
    known = {}
    for command in commands:
        arguments = command.without_precompiled()
        for source in command.sources:
            each = [str(source) if a == str(command.file) else a for a in arguments]
            known.setdefault(source, {"directory": command.directory, "file": str(source), "arguments": each})
    folder = build / "each"
    folder.mkdir(exist_ok=True)
    (folder / "compile_commands.json").write_text(json.dumps(list(known.values())), encoding="utf-8")
    return folder, known


def batches(build, commands):
    folder = build / "batches"
    folder.mkdir(exist_ok=True)
    entries = [{"directory": c.directory, "file": str(c.file), "arguments": c.without_precompiled()} for c in commands]
    (folder / "compile_commands.json").write_text(json.dumps(entries), encoding="utf-8")
    return folder, [c.file for c in commands]


def check(folder, file):
    call = ["clang-tidy-14", "-p", folder, "--quiet", "--extra-arg=-Wno-pragma-once-outside-header", file]
    ran = subprocess.run(call, capture_output=True, text=True, check=False)
    return file, ran.stdout if FOUND.search(ran.stdout) else ran.stderr if ran.returncode != 0 else ""


def seconds():
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime


class Problems:
    def __init__(self):
        self.seen, self.failed = set(), False

    def add(self, text):
        if text and not FOUND.search(text):
            print(text)
            self.failed = True
        starts = [m.start() for m in FOUND.finditer(text)] + [len(text)]
        for begin, end in zip(starts, starts[1:]):
            place = FOUND.match(text, begin)
            file = pathlib.Path(place[1]).resolve()   # not through the links in BUILD/include
            if file.is_relative_to(ROOT) and not file.is_relative_to(ROOT / "build") and (file, place[2]) not in self.seen:
                print(text[begin:end].replace(place[1], str(file.relative_to(ROOT)), 1), end="", flush=True)
                self.seen.add((file, place[2]))


def chosen(build, wanted):
    commands = [c for c in read(build) if not c.makes_header]
    part = re.fullmatch(r"(\d+)/(\d+)", wanted[0]) if wanted else None
    if not wanted or part:
        folder, files = batches(build, cover(commands))
        return folder, files[int(part[1]) - 1 :: int(part[2])] if part else files
    folder, known = one_by_one(build, commands)
    return folder, changed(known) if wanted == ["--changed"] else [pathlib.Path(f).resolve() for f in wanted]


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    folder, files = chosen(build, sys.argv[2:])
    limited = sys.argv[2:] == ["--changed"]
    queue, checked, problems = (files[:MOST_FILES] if limited else files), 0, Problems()
    begin = seconds()
    with concurrent.futures.ThreadPoolExecutor(cpus()) as pool:
        while queue and not (limited and seconds() - begin > MOST_SECONDS):
            now = cpus() if limited else len(queue)
            for file, text in pool.map(lambda f: check(folder, f), queue[:now]):
                checked += 1
                print(f"{checked} of {len(files)}: {file.relative_to(ROOT)}", file=sys.stderr, flush=True)
                problems.add(text)
            queue = queue[now:]
    for file in files[checked:]:
        print(f"left for ./test.sh --tidy {file.relative_to(ROOT)}")
    print(f"{checked} files, {len(problems.seen)} problems")
    return 1 if problems.seen or problems.failed else 0


sys.exit(main())
