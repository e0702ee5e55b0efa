#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Replays commits one after the other in a kept folder, and prints what each run costs: runs.py COUNT [--end COMMIT] [--with COMMIT]

Runs .ci/run for COUNT commits up to COMMIT (HEAD), after a run of the one before them that is not counted. With --with, commits from before the kept
folder get the scripts and the lists of CMake of that commit. Prints for each the seconds of a processor, those by the clock, how many tests ran, and at
the end mean and median. Takes hours."""

import argparse
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPTS = [".ci", "test.sh", "CMakeLists.txt", "CMakePresets.json", "host/CMakeLists.txt", "host/install.cmake", "tests/CMakeLists.txt", "tests/parts.cmake",
           "tests/join.cmake", "tests/support/run_file.py", "tests/host/app/CMakeLists.txt", "tests/python/CMakeLists.txt", "tests/live_edits/CMakeLists.txt",
           "tests/newcomer/run.sh", "tests/docs/blocks.py", "host/base/packaging/program_help.py"]
RAN = re.compile(r"(\d+) tests failed out of (\d+)")


def git(*arguments, folder=ROOT):
    return subprocess.run(["git", "-C", folder, *arguments], stdout=subprocess.PIPE, text=True, check=True).stdout.strip()


def run(checkout, keep, log):
    begin = time.monotonic()
    with subprocess.Popen([checkout / ".ci/run"], stdout=log, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                          env={**os.environ, "CI": "true", "TACTUS_CI_KEEP": str(keep)}) as process:
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    return process.returncode, used.ru_utime + used.ru_stime, time.monotonic() - begin


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("count", type=int)
    parser.add_argument("--end", default="HEAD")
    parser.add_argument("--with", dest="scripts")
    parser.add_argument("--keep", type=pathlib.Path, help="a kept folder, so that the first run is short, too")
    wanted = parser.parse_args()
    commits = git("rev-list", "--first-parent", f"--max-count={wanted.count + 1}", wanted.end).split()[::-1]
    costs = []
    with tempfile.TemporaryDirectory() as folder:
        top, keep = pathlib.Path(folder), (wanted.keep or pathlib.Path(folder, "kept")).resolve()
        checkout = top / "tactus"
        git("clone", "--quiet", "--shared", ROOT, checkout)
        if (ROOT.parent / "shared").is_dir():
            (top / "shared").symlink_to((ROOT.parent / "shared").resolve())
        print(f"{'commit':10} {'CPU s':>6} {'s':>6} {'tests':>6}  failed", flush=True)
        for number, commit in enumerate(commits):
            git("checkout", "--quiet", "--force", commit, folder=checkout)
            git("clean", "-fdq", folder=checkout)
            if wanted.scripts:
                git("checkout", "--quiet", git("rev-parse", wanted.scripts), "--", *SCRIPTS, folder=checkout)
            with tempfile.TemporaryFile("w+", errors="replace") as log:
                status, cpu, wall = run(checkout, keep, log)
                log.seek(0)
                text = log.read()
            ran = RAN.findall(text)
            failed, tests = ran[-1] if ran else ("-", "-")
            print(f"{commit[:10]} {cpu:6.0f} {wall:6.0f} {tests:>6}  {failed if status == 0 else f'{failed}, exit status {status}'}"
                  f"{' (not counted)' if number == 0 else ''}  {git('log', '-1', '--format=%s', commit)[:70]}", flush=True)
            if status:
                print("\n".join("    " + line for line in text.splitlines()[-15:]))
            if number:
                costs.append(cpu)
    print(f"{len(costs)} runs: mean {statistics.mean(costs):.0f} s of a processor, median {statistics.median(costs):.0f}")
    return 0


sys.exit(main())
