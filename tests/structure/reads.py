#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares the files that tests open with those that tests/CMakeLists.txt names for them: reads.py BUILD [REGEX]

A test whose files have not changed is not run again (.ci/remember.py), so a file that is not named is a change that no test sees. This runs each
remembered test, or those whose names match, under strace. Prints each file of the repository and each program of the build folder that a test opens
and that is not named for it. Exit status 1 if there are any, 77 without strace. Tests that fail under strace, since they trace or count system calls
themselves, are listed: what they opened until then is compared."""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
OPENED = re.compile(r'^\d+ +(?:open|openat|execve)\((?:AT_FDCWD, |\d+, )?"(/[^"]*)"(.*)$', re.MULTILINE)
WRITES = re.compile(r"O_(WRONLY|RDWR|CREAT)")


def opened(command, environment):
    """The paths that a command and its children opened, and whether it succeeded."""
    with tempfile.NamedTemporaryFile("r", errors="replace") as log:
        call = ["strace", "-f", "--seccomp-bpf", "-qq", "-y", "-s", "4096", "-e", "trace=open,openat,execve", "-e", "signal=none", "-o", log.name, *command]
        ran = subprocess.run(call, env={**os.environ, **environment}, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
        paths = {pathlib.Path(os.path.realpath(path)) for path, rest in OPENED.findall(re.sub(r"AT_FDCWD<[^>]*>", "AT_FDCWD", log.read()))
                 if " = -1 " not in rest and not WRITES.search(rest)}
    return paths, ran.returncode in (0, 77)


def strange(build, path):
    """A file that no list has to name: outside of the repository, or made by the build or by a test."""
    if path.is_relative_to(build):
        return not (path.parent == build / "bin" or path.suffix in (".so", ".tactus", ".tactus-device"))
    return not path.is_relative_to(ROOT) or path.is_relative_to(ROOT / "build") or "__pycache__" in path.parts or path.suffix == ".pyc" or path == ROOT


def main():
    build, wanted = pathlib.Path(sys.argv[1]).resolve(), re.compile(sys.argv[2] if len(sys.argv) > 2 else "")
    if shutil.which("strace") is None:
        print("skipped: strace is not installed")
        return 77
    shown = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], stdout=subprocess.PIPE, text=True, check=True).stdout
    missing, failed, compared = 0, [], 0
    for test in json.loads(shown)["tests"]:
        properties = {p["name"]: p["value"] for p in test.get("properties", [])}
        if "remembered" not in properties.get("LABELS", []) or not wanted.search(test["name"]):
            continue
        named = [pathlib.Path(os.path.realpath(p)) for p in [*test["command"], *properties.get("REQUIRED_FILES", [])] if p.startswith("/")]
        named = [p for p in named if p not in (ROOT, build)]
        environment = dict(e.split("=", 1) for e in properties.get("ENVIRONMENT", []))
        paths, passed = opened(test["command"], environment)
        compared += 1
        if not passed:
            failed.append(test["name"])
        for path in sorted(p for p in paths if not strange(build, p) and not any(p == n or p.is_relative_to(n) for n in named)):
            print(f"{test['name']}: opens {path.relative_to(ROOT)}, which is not named for it")
            missing += 1
    if failed:
        print(f"{len(failed)} tests fail under strace; compared is what they opened until then:", *failed, sep="\n  ")
    print(f"{compared} tests compared, {missing} files that are not named")
    return 1 if missing else 0


sys.exit(main())
