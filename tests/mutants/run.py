#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that the selected tests (.ci/remember.py) find the mutants of mutants.json, small faults in the sources, exactly as all tests do.

    run.py BUILD [--all [--to-the-end]] [NAME...] [-- CTEST OPTION...]
    run.py --check

For each mutant, or those with these names: puts the fault into its source, builds, runs the tests whose inputs have changed, and takes the fault
out again. With --all, it then runs all tests, too. Tests stop at the first failure; with --to-the-end they do not, and both runs must have the same
failures. Exit status 1 if a mutant does not compile or is not found, or if the two runs differ. What the build and the tests print goes to
BUILD.mutants/NAME.txt.

BUILD is a configured build folder of this checkout. Before the first mutant and after the last one, it is built without any, and at first the tests
must pass: what they leave in BUILD/passed.json is what every mutant begins with, so that each is measured against the original and not against the
mutant before it. A run of some hours; `-- --label-exclude whole` leaves out the tests that take minutes each.

If a run is killed, its fault stays in the source, and the next run takes it out: BUILD.mutants/original.json holds the text without it.

--check needs no build: each mutant still fits its source, and the test that is said to find it exists."""

import contextlib
import fcntl
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
LIST = HERE / "mutants.json"
KEYS = ["name", "file", "from", "to", "about", "found_by"]
FEWEST = 40
CHECK_TEST = "each mutant still fits its source"   # it fails with every mutant, so it must not count

RAN = re.compile(r"^ *\d+/\d+ Test +#(\d+): ", re.MULTILINE)
FAILED = re.compile(r"^\s+\d+ - (.*) \((?!Skipped\)|Disabled\))[^()]*\)", re.MULTILINE)


class Broken(Exception):
    """Something other than a test has failed."""


def text_of(path):
    return path.read_bytes().decode("utf-8")   # keeps the ends of lines


#==============================================================================
# The list

def problems(mutants):
    if len(mutants) < FEWEST:
        yield f"there are {len(mutants)} mutants, fewer than {FEWEST}"
    names = [m.get("name") for m in mutants]
    for m in mutants:
        name = m.get("name")
        if list(m) != KEYS or not all(isinstance(m[key], str) for key in KEYS):
            yield f"{name}: it must have the texts {', '.join(KEYS)}, in this order"
            continue
        if not re.fullmatch("[a-z][a-z0-9_]*", name) or names.count(name) > 1:
            yield f"{name}: a name is unique, in lower case and with underscores"
        if not m["about"] or m["from"] == m["to"]:
            yield f"{name}: it changes nothing, or does not say what"
        if not (ROOT / m["file"]).is_file():
            yield f"{name}: there is no {m['file']}"
        elif (count := text_of(ROOT / m["file"]).count(m["from"])) != 1:
            yield f"{name}: `from` occurs {count} times in {m['file']}"
        if not m["found_by"].startswith("tests/") or not (ROOT / m["found_by"]).is_file():
            yield f"{name}: there is no test {m['found_by']}"


def check(mutants):
    found = [*problems(mutants)]
    print(*found, f"{len(mutants)} mutants, {len(found)} problems", sep="\n")
    return 1 if found else 0


#==============================================================================
# Faults in sources

class Fault:
    """Puts a mutant into its source, and takes it out again. A note beside the build folder outlives a killed run."""

    def __init__(self, notes):
        self.note = notes / "original.json"

    @contextlib.contextmanager
    def of(self, mutant):
        path = ROOT / mutant["file"]
        original = text_of(path)
        changed = original.replace(mutant["from"], mutant["to"])
        new = self.note.with_suffix(".new")
        new.write_text(json.dumps({"name": mutant["name"], "file": mutant["file"], "original": original, "changed": changed}), encoding="utf-8")
        new.replace(self.note)
        try:
            path.write_bytes(changed.encode("utf-8"))
            yield
        finally:
            self.take_out()

    def take_out(self):
        """Restores the source of the note, if there is one. Its new time makes the next build compile it again. Returns the name of the mutant."""
        if not self.note.exists():
            return None
        note = json.loads(self.note.read_text(encoding="utf-8"))
        path = ROOT / note["file"]
        now = text_of(path) if path.exists() else ""
        # A run that was killed while it wrote leaves a part of a text.
        if now != note["original"]:
            if now != note["changed"] and not note["changed"].startswith(now) and not note["original"].startswith(now):
                raise Broken(f"{note['file']} was edited while it had the mutant {note['name']}: change it back yourself, then delete {self.note}")
            path.write_bytes(note["original"].encode("utf-8"))
        self.note.unlink()
        return note["name"]


def is_clean(file):
    said = subprocess.run(["git", "-C", ROOT, "status", "--porcelain", "--", file], stdout=subprocess.PIPE, text=True, check=False)
    return said.returncode == 0 and not said.stdout


#==============================================================================
# Building and testing

def run(command, log, lock):
    """The exit status of a command, and what it printed. If this is interrupted, no compiler that it started is left: one that has read a mutant
    must not write an object that is newer than the restored source. Therefore a command also holds the lock: after kill -9, its compilers go on."""
    lines = []
    with subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace", start_new_session=True,
                          pass_fds=[lock.fileno()]) as process:
        try:
            for line in process.stdout:
                lines.append(line)
                log.write(line)
                log.flush()
            return process.wait(), "".join(lines)
        except BaseException:
            end(process)
            raise


def end(process):
    """Ends a process and all others of its group."""
    for how, patience in (signal.SIGINT, 60), (signal.SIGKILL, 5):   # at SIGINT, ninja ends its compilers and removes what they wrote
        with contextlib.suppress(ProcessLookupError):   # none is left
            os.killpg(process.pid, how)
            late = time.monotonic() + patience
            while time.monotonic() < late:
                process.poll()
                os.killpg(process.pid, 0)
                time.sleep(0.05)


class Bench:
    def __init__(self, build, notes, lock, options):
        self.build, self.notes, self.lock, self.options = build, notes, lock, options
        self.memory = build / "passed.json"

    def compiles(self, log):
        return run(["cmake", "--build", self.build], log, self.lock)[0] == 0

    def test(self, log, *options):
        """The names of the tests that failed, how many ran, and how long they took."""
        begin = time.monotonic()
        command = [sys.executable, "-B", ROOT / ".ci" / "remember.py", "tests", self.build, *options, *self.options, "--exclude-regex", f"^{CHECK_TEST}$"]
        status, said = run(command, log, self.lock)
        failed = set(FAILED.findall(said))
        if (status != 0) != bool(failed):
            raise Broken(f"the tests ended with status {status} and {len(failed)} failures; see {log.name}")
        return failed, len(set(RAN.findall(said))), time.monotonic() - begin

    def begin(self):
        """The memory of tests that passed with the sources as they are."""
        with self.log("original") as log:
            if not self.compiles(log):
                raise Broken(f"the sources do not compile without a mutant; see {log.name}")
            failed, count, seconds = self.test(log)
        if failed:
            raise Broken(f"without a mutant, these tests fail: {', '.join(sorted(failed))}")
        print(f"Without a mutant, {count} tests ran in {seconds:.0f} s and passed", flush=True)
        return self.memory.read_bytes()

    def log(self, name):
        return open(self.notes / f"{name}.txt", "w", encoding="utf-8")


def test_of(found_by):
    """The name of a test file in the names of tests, as tests/parts.cmake makes it."""
    return re.sub(r"^(framework|nodes|plugins|host/(?:app|cli|base|code|devices|drivers|tools))/|_test\.cpp$", "", found_by.removeprefix("tests/"))


def examine(mutant, bench, remembered, everything, to_the_end):
    """What the tests say about a mutant that is in its source: a sentence, and what is wrong, if anything is."""
    stop = [] if to_the_end else ["--stop-on-failure"]
    with bench.log(mutant["name"]) as log:
        begin = time.monotonic()
        if not bench.compiles(log):
            return f"does NOT compile; see {log.name}", "does not compile"
        built = time.monotonic() - begin
        bench.memory.write_bytes(remembered)
        failed, count, seconds = bench.test(log, *stop)
        sentence = f"{'found' if failed else 'NOT found'} by the selected tests ({count} ran in {seconds:.0f} s, built in {built:.0f} s)"
        wrong = "" if failed else "not found"
        if everything:
            of_all, count, seconds = bench.test(log, "--all", *stop)
            sentence += f", {'found' if of_all else 'NOT found'} by all ({count} in {seconds:.0f} s)"
            if bool(failed) != bool(of_all):
                wrong = "selected and all disagree"
            elif to_the_end and failed != of_all:
                wrong = "selected and all disagree"
                sentence += f"; only selected: {sorted(failed - of_all)}; only all: {sorted(of_all - failed)}"
    if failed:
        sentence += f": {', '.join(sorted(failed)[:3])}{' ...' if len(failed) > 3 else ''}"
        if to_the_end and not any(test_of(mutant["found_by"]) in name.partition(": ")[2].split(", ") for name in failed):
            sentence += f"; but not by {mutant['found_by']}"
    return sentence, wrong


def examine_all(mutants, build, options, everything, to_the_end):
    notes = build.with_name(build.name + ".mutants")
    notes.mkdir(exist_ok=True)
    with open(notes / "lock", "w", encoding="utf-8") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as busy:
            raise Broken(f"another run uses {build}, or compilers that it has started") from busy
        fault, bench = Fault(notes), Bench(build, notes, lock, options)
        if left := fault.take_out():
            print(f"The mutant {left} was left in its source by a run that was killed; it is taken out", flush=True)
        unclean = [m["file"] for m in mutants if not is_clean(m["file"])]
        if unclean:
            raise Broken(f"these sources have changes that are not committed, or git cannot tell: {', '.join(sorted(set(unclean)))}")

        remembered = bench.begin()
        wrong = {}
        try:
            for number, mutant in enumerate(mutants, 1):
                if not is_clean(mutant["file"]):
                    raise Broken(f"{mutant['file']} was edited during the run")
                with fault.of(mutant):
                    try:
                        sentence, why = examine(mutant, bench, remembered, everything, to_the_end)
                    except Broken as reason:
                        sentence = why = str(reason)
                print(f"{number}/{len(mutants)} {mutant['name']}: {sentence}", flush=True)
                if why:
                    wrong[mutant["name"]] = why
        finally:
            bench.memory.write_bytes(remembered)   # of the original, as the sources are again
        with bench.log("original") as log:
            if not bench.compiles(log):
                raise Broken(f"the sources do not compile after the mutants; see {log.name}")
    print(f"{len(mutants) - len(wrong)} of {len(mutants)} mutants are found" + (" by the selected tests exactly as by all" if everything else ""))
    for name, why in wrong.items():
        print(f"  {name}: {why}")
    return 1 if wrong else 0


def main():
    words = sys.argv[1:]
    at = words.index("--") if "--" in words else len(words)
    words, options = words[:at], words[at + 1 :]
    mutants = json.loads(LIST.read_text(encoding="utf-8"))
    if words == ["--check"]:
        return check(mutants)
    flags, rest = [w for w in words if w.startswith("-")], [w for w in words if not w.startswith("-")]
    if not rest or not set(flags) <= {"--all", "--to-the-end"} or ("--to-the-end" in flags and "--all" not in flags):
        print(__doc__, file=sys.stderr)
        return 2
    build, names = pathlib.Path(rest[0]).resolve(), rest[1:]
    unknown = [name for name in names if name not in [m["name"] for m in mutants]]
    if unknown or not (build / "CMakeCache.txt").is_file():
        print(f"no mutants: {', '.join(unknown)}" if unknown else f"{build} is not a build folder", file=sys.stderr)
        return 2
    os.environ.setdefault("RC_PARAMS", "seed=1")   # as ./test.sh has it, which is part of what is remembered
    for ending in signal.SIGTERM, signal.SIGHUP:
        signal.signal(ending, lambda number, frame: sys.exit(128 + number))
    try:
        return examine_all([m for m in mutants if not names or m["name"] in names], build, options, "--all" in flags, "--to-the-end" in flags)
    except Broken as why:
        print(why, file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130


sys.exit(main())
