#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs test programs of Windows in wine, and the tests of the command line, which are a program of Linux, on tactus.exe: tests.py LINUX WINDOWS WINE
[PART...]. LINUX and WINDOWS are the folders build/release and build/windows. PART: framework, device, cli; by default, those that are built. Prints
how many cases pass, and what is left out, and why. Exit status 1 if one fails, but for the command line if more than a tenth does."""

import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from left_out import FEWER, LEFT_OUT   # noqa: E402
from wine import add_port, restart   # noqa: E402

RESULT = re.compile(r"All tests passed \(.* in (\d+) test case|test cases: +(\d+) \|(?: +(\d+) passed)?")
LONGEST = 900   # seconds for a file


def files_of(program, environment):
    """The files of the tests in this program that are not hidden, by their names without folders and ending."""
    said = subprocess.run([*program, "--filenames-as-tags", "--list-tags", "~[.]"], capture_output=True, text=True, check=False, env=environment).stdout
    return re.findall(r"\[#([^\]]+)\]", said)


def run_file(program, file, environment):
    """The cases of a file that run, and those that pass; and what the program prints."""
    without = "".join('~"' + re.sub(r"([\\,\[])", r"\\\1", name) + '"' for name in LEFT_OUT.get(file, {}))   # as Catch2 reads a name
    command = [*program, "--filenames-as-tags", f"[#{file}]~[.]{without}", "--durations", "yes"]   # names the last case that ended
    if file in FEWER:
        environment = {**environment, "TACTUS_ROUNDS": str(FEWER[file])}
    try:
        ran = subprocess.run(command, capture_output=True, text=True, errors="replace", check=False, env=environment, timeout=LONGEST)
        text = ran.stdout + ran.stderr
    except subprocess.TimeoutExpired as late:
        text = (late.stdout or b"").decode(errors="replace") + f"\nended after {LONGEST} s"
    if "No test cases matched" in text or "No tests ran" in text:
        return 0, 0, text
    found = RESULT.search(text)
    if not found:
        return 1, 0, text + "\nthe program died"
    count = int(found.group(1) or found.group(2))
    return count, count if found.group(1) else int(found.group(3) or 0), text


def main():
    linux, windows, wine = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve(), sys.argv[3]
    programs = {"framework": [wine, str(windows / "bin/tactus_framework_tests.exe")], "device": [wine, str(windows / "bin/tactus_device_tests.exe")],
                "cli": [str(linux / "bin/tactus_cli_tests")]}
    environment = {**os.environ, "RC_PARAMS": os.environ.get("RC_PARAMS", "seed=1")}
    tactus = windows / "tried/tactus"   # the tests of the command line start it as they start tactus
    tactus.parent.mkdir(parents=True, exist_ok=True)
    tactus.write_text(f'#!/bin/sh\nexec {wine} {windows}/bin/tactus.exe "$@"\n')
    tactus.chmod(0o755)
    line = tactus.with_name("line_COM20")
    add_port(wine, "COM20", line)
    restart(wine)
    wrong = 0
    for part in sys.argv[4:] or [name for name, program in programs.items() if pathlib.Path(program[-1]).exists()]:
        more = {"TACTUS_TESTED_PROGRAM": str(tactus), "TACTUS_TESTED_LINE": str(line)} if part == "cli" else {}
        files = files_of(programs[part], environment)
        count = passed = 0
        run = [file for file in files if "" not in LEFT_OUT.get(file, {})]
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            results = pool.map(lambda file: run_file(programs[part], file, {**environment, **more}), run)
            for file, (ran, good, text) in zip(run, results):
                count, passed = count + ran, passed + good
                if good < ran:
                    print(f"== {part}: {file}: {good} of {ran} pass\n{text[-6000:]}", flush=True)
        enough = passed == count if part != "cli" else passed >= 0.9 * count
        wrong += not (enough and count > 0)
        print(f"{part}: {passed} of {count} cases pass in {len(run)} files", flush=True)
    for file, percent in FEWER.items():
        print(f"fewer rounds: {file}: {percent} %")
    for file, cases in LEFT_OUT.items():
        for case, why in cases.items():
            print(f"left out: {file}{': ' if case else ''}{case}: {why}")
    return 1 if wrong else 0


sys.exit(main())
