#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the tests of a build folder, except those that passed before with the same inputs: remember.py tests BUILD [--all] [CTEST OPTION...]
Runs a command, except if it succeeded before with the same inputs:                       remember.py once BUILD NAME INPUT... -- COMMAND...

The inputs of a test are its command, what the command names of the repository and of the build folder, the files that tests/CMakeLists.txt names for
it (tactus_remember), and the seed. Contents count, not times. A test without the label `remembered` runs always. With --all, all tests run.

BUILD/passed.json holds a hash of the inputs for each test that passed. Without it, all tests run."""

import collections
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
LINES = 40   # of each test that failed, from its end
TEST = re.compile(r"^\d+/\d+ Testing: (.*?)\n.*?\nOutput:\n-+\n(.*?)<end of output>\nTest time = .*?\n-+\n(Test [A-Z][a-z]+)", re.MULTILINE | re.DOTALL)
CLOSING = re.compile(r" tests passed, ")
SKIPPED = re.compile(r"^\s*(skipped: .*)", re.MULTILINE)


class Inputs:
    """Hashes of files and folders, each read once."""

    def __init__(self):
        self.known = {}

    def of(self, path):
        if path not in self.known:
            self.known[path] = self.read(path)
        return self.known[path]

    def read(self, path):
        digest = hashlib.sha256()
        if path.is_dir():
            for folder, folders, files in os.walk(path):
                folders[:] = sorted(f for f in folders if f != "__pycache__" and pathlib.Path(folder, f) != ROOT / "build")
                for file in sorted(files):
                    digest.update(str(pathlib.Path(folder, file).relative_to(path)).encode("utf-8", "surrogateescape") + b"\0")
                    digest.update(self.of(pathlib.Path(folder, file)).encode())
        elif path.exists():
            digest.update(path.read_bytes())
        else:
            digest.update(b"missing")
        return digest.hexdigest()

    def key(self, *parts, paths):
        digest = hashlib.sha256(json.dumps([parts, settings()], sort_keys=True).encode())
        for path in sorted(set(paths)):
            digest.update(f"{path}\0{self.of(path)}\0".encode("utf-8", "surrogateescape"))
        return digest.hexdigest()


def settings():
    """What the environment tells tests: seeds, rounds, paths of data."""
    return {name: value for name, value in os.environ.items() if name == "RC_PARAMS" or (name.startswith("TACTUS_") and name != "TACTUS_CI_KEEP")}


def named(command):
    """The files that a command names, and the folders, except for the repository and a build folder as a whole."""
    for word in command:
        path = pathlib.Path(word)
        if path.is_relative_to(ROOT) and path.exists() and path != ROOT and path.parent != ROOT / "build":
            yield path


class Memory:
    """What passed with these seeds; a run with new seeds leaves what passed with the usual ones."""

    def __init__(self, build):
        self.file, self.seeds = build / "passed.json", os.environ.get("RC_PARAMS", "")
        try:
            self.all = json.loads(self.file.read_text(encoding="utf-8"))
        except (OSError, ValueError):
            self.all = {}
        self.passed = self.all.get(self.seeds, {})

    def write(self):
        usual = {seeds: passed for seeds, passed in self.all.items() if re.match(r"seed=1\b", seeds)}
        new = self.file.with_suffix(".new")
        new.write_text(json.dumps({**usual, self.seeds: self.passed}, indent=0, sort_keys=True), encoding="utf-8")
        new.replace(self.file)   # a run that is ended here leaves the old memory


def listed(build, options):
    """The tests that ctest would run, each with its properties."""
    shown = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1", *options], stdout=subprocess.PIPE, text=True, check=True).stdout
    for test in json.loads(shown)["tests"]:
        yield test["name"], test.get("command", []), {p["name"]: p["value"] for p in test.get("properties", [])}


def key(inputs, name, test):
    command, properties = test
    paths = [*named(command), *map(pathlib.Path, properties.get("REQUIRED_FILES", []))]
    return inputs.key(name, command, properties.get("ENVIRONMENT"), paths=paths)


def part(name):
    return name.split(": ")[0] if re.match(r"[a-z]+: ", name) else "others"


def tests(build, options):
    everything = "--all" in options
    options = [o for o in options if o != "--all"]
    memory, inputs = Memory(build), Inputs()
    remembered, keys, numbers, same = {}, {}, [], collections.Counter()
    for number, (name, command, properties) in enumerate(listed(build, options), 1):
        if "remembered" in properties.get("LABELS", []):
            remembered[name] = command, properties
            keys[name] = key(inputs, name, remembered[name])
            if not everything and memory.passed.get(name) == keys[name]:
                same[part(name)] += 1
                continue
        numbers.append(number)
    if same:
        print(f"{sum(same.values())} of {sum(same.values()) + len(numbers)} tests passed before, and nothing that they read has changed: "
              + ", ".join(f"{p} {n}" for p, n in sorted(same.items())), flush=True)
    if not numbers:
        return 0

    for name in keys:   # until it passes again
        if memory.passed.get(name) != keys[name] or everything:
            memory.passed.pop(name, None)
    memory.write()
    status, closing = run_ctest(build, ["-I", ",".join(map(str, [numbers[0], numbers[0], 1, *numbers[1:]])), *options])
    log = (build / "Testing" / "Temporary" / "LastTest.log").read_text(encoding="utf-8", errors="replace")
    skipped, failed, passed = [], [], []
    for name, text, result in TEST.findall(log):
        said = list(dict.fromkeys(SKIPPED.findall(text)))
        skipped += [f"{name}: {sentence}" for sentence in said]
        if result != "Test Passed":
            failed.append((name, text))
        elif not said and name in keys:
            passed.append(name)
    inputs = Inputs()
    memory.passed.update({name: keys[name] for name in passed if key(inputs, name, remembered[name]) == keys[name]})   # unless a file changed in the meantime
    memory.write()
    if skipped:
        print(f"\n{len(skipped)} tests said why they were skipped:", *skipped, sep="\n  ")
    if status:   # once more, after the lines of hundreds of tests that passed
        for name, text in failed:
            print(f"\n== Failed: {name}", *text.splitlines()[-LINES:], sep="\n")
    if skipped or status:
        print("", *closing, sep="", end="", flush=True)
    return status


def run_ctest(build, options):
    """The exit status of ctest, and its closing lines."""
    # One test more than processors, because some tests wait.
    command = ["ctest", "--test-dir", build, "--output-on-failure", "--no-label-summary", "--parallel", str((os.cpu_count() or 1) + 1), *options]
    closing = []
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, errors="replace") as ctest:
        for line in ctest.stdout:
            print(line, end="", flush=True)
            if closing or CLOSING.search(line):
                closing.append(line)
    return ctest.returncode, closing


def once(build, arguments):
    at = arguments.index("--")
    name, paths, command = arguments[0], [ROOT / p for p in arguments[1:at]], arguments[at + 1 :]
    memory = Memory(build)
    key = Inputs().key(name, command, paths=paths)
    if memory.passed.get(name) == key:
        print("It succeeded before, and nothing that it reads has changed")
        return 0
    status = subprocess.run(command, check=False).returncode
    memory = Memory(build)
    memory.passed.pop(name, None)
    if status == 0:
        memory.passed[name] = key
    memory.write()
    return status


def main():
    what, build, *rest = sys.argv[1:]
    return {"tests": tests, "once": once}[what](pathlib.Path(build).resolve(), rest)


sys.exit(main())
