#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the command line on mutated files. Each must be accepted, or refused with an error, within the budgets of time and memory.

  whole_program.py TACTUS --kept                 the files in tests/fuzz/programs, which once broke something or are hard
  whole_program.py TACTUS --count 10000 --seed 1 mutations of the presets, sessions, profiles, logs and traces

A failure prints the command and keeps the file under --keep (default: build/fuzz/programs).
"""

import argparse
import concurrent.futures
import json
import os
import random
import resource
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tests/support"))
from waiting import Stopwatch   # noqa: E402

KINDS = ("graph", "session", "profile", "run_log", "trace")
LONGEST_CPU_S = 10        # twice the budget of time
MOST_BYTES = 700 << 20    # more than the budget of memory, as libraries and stacks count too
SUFFIX = {"graph": ".json", "session": ".json", "profile": ".json", "run_log": ".jsonl", "trace": ".csv"}

NUMBERS = ["0", "-1", "1e308", "-1e308", "1e-320", "0.1", "2147483648", "18446744073709551616", "1e999", "64", "1000000", "NaN", "3 N/mm", "\"inf\""]
WORDS = ["count", "times", "every", "include", "path", "x" * 300, "\u202e", "\x1b[2J", "../../../etc/passwd", "/dev/zero", "in[0]", "a.b.c", ""]


def seeds():
    """Files by kind: what the repository has, small enough to mutate."""
    found = {kind: [] for kind in KINDS}
    found["graph"] += sorted((ROOT / "graphs").glob("*.json"))
    found["profile"] += sorted((ROOT / "host/devices/profiles").glob("*_*.json"))
    corpus = ROOT / "tests/fuzz/corpus"
    for kind, folder in (("graph", "graph"), ("session", "session"), ("profile", "profile"), ("run_log", "run_log"), ("trace", "csv")):
        found[kind] += [p for p in sorted((corpus / folder).iterdir()) if p.stat().st_size < 60000]
    return found


def mutated_json(value, rng, depth=0):
    """A copy of the value with a few changes of its structure."""
    if isinstance(value, dict):
        out = {}
        for key, inner in value.items():
            chance = rng.random()
            if chance < 0.01:
                continue
            if chance < 0.02:
                key = rng.choice(WORDS)
            out[key] = mutated_json(inner, rng, depth + 1)
        return out
    if isinstance(value, list):
        out = [mutated_json(v, rng, depth + 1) for v in value]
        if out and rng.random() < 0.03:
            out += [rng.choice(out)] * rng.choice([1, 10, 500])
        return out
    if rng.random() < 0.03:
        return rng.choice([json.loads("0"), -1, 1e308, 1e6, 64, True, None, [], {}, rng.choice(WORDS), [[0] * 50] * 50])
    return value


def mutated(data, rng):
    """The bytes of a file after random changes."""
    if rng.random() < 0.6:
        try:
            text = json.dumps(mutated_json(json.loads(data), rng), ensure_ascii=rng.random() < 0.5)
            return text.encode("utf-8", "surrogatepass")
        except (ValueError, RecursionError):
            pass
    data = bytearray(data)
    for _ in range(rng.randint(1, 8)):
        at = rng.randrange(len(data) + 1)
        what = rng.random()
        if what < 0.3 and data:
            data[min(at, len(data) - 1)] = rng.randrange(256)
        elif what < 0.5:
            data[at:at] = rng.choice(NUMBERS + WORDS).encode("utf-8", "surrogatepass")
        elif what < 0.7:
            del data[at:at + rng.choice([1, 4, 100])]
        elif what < 0.9:
            piece = data[at:at + rng.choice([10, 200])]
            data[at:at] = piece * rng.choice([1, 3, 200])
        else:
            del data[at:]
    return bytes(data)


def commands(kind, file, folder):
    """The commands that read a file of this kind."""
    wood = str(ROOT / "graphs/dry_wood.json")
    out = ["--out", str(folder / "out.csv"), "--duration", "0.02"]
    if kind == "graph":
        return [["validate", file], ["render", file] + out, ["check-preset", file]]
    if kind == "session":
        return [["session", wood, "--file", file]]
    if kind == "profile":
        return [["devices"]]
    if kind == "run_log":
        return [["render", "--replay", file] + out]
    return [["render", wood, "--device", "stylus=trace:" + file] + out, ["render", wood, "--feed", file] + out]


def limit():
    resource.setrlimit(resource.RLIMIT_CPU, (4 * LONGEST_CPU_S, 4 * LONGEST_CPU_S))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def complaint(program, arguments, environment):
    """What is wrong with how the program ends; empty if nothing is."""
    with tempfile.TemporaryFile() as shown:
        process = subprocess.Popen([program] + arguments, stdin=subprocess.DEVNULL, stdout=shown, stderr=shown, env=environment, preexec_fn=limit)
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        shown.seek(0)
        text = shown.read(1 << 20)
    if process.returncode < 0:
        return f"died from signal {-process.returncode}"
    if process.returncode not in (0, 1, 2):
        return f"ended with status {process.returncode}"
    cpu = used.ru_utime + used.ru_stime
    if cpu > LONGEST_CPU_S:
        return f"took {cpu:.1f} CPU s"
    if used.ru_maxrss * 1024 > MOST_BYTES:
        return f"took {used.ru_maxrss / 1024:.0f} MB"
    if any(c < 32 and c not in (9, 10) or c == 127 for c in text):
        return "printed a control character"
    if process.returncode != 0 and not text.strip():
        return "failed without a message"
    return ""


def attempt(program, kind, data, keep, name):
    """Runs all commands on the data. Returns a description of the first failure."""
    with tempfile.TemporaryDirectory(prefix="tactus-fuzz-") as folder:
        folder = Path(folder)
        profiles = folder / "profiles"
        profiles.mkdir()
        file = (profiles if kind == "profile" else folder) / ("input" + SUFFIX[kind])
        file.write_bytes(data)
        environment = {"PATH": os.environ.get("PATH", ""), "HOME": str(folder), "TACTUS_PROFILES": str(profiles), "LANG": "C.UTF-8"}
        for arguments in commands(kind, str(file), folder):
            why = complaint(program, arguments, environment)
            if why:
                keep.mkdir(parents=True, exist_ok=True)
                shutil.copy(file, keep / (name + SUFFIX[kind]))
                return f"{name}: {why}: tactus {' '.join(arguments)}"
    return ""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tactus")
    parser.add_argument("--kept", action="store_true", help="run the kept files only")
    parser.add_argument("--count", type=int, default=10000)
    parser.add_argument("--seed", type=int, default=random.randrange(1 << 30))
    parser.add_argument("--keep", type=Path, default=ROOT / "build/fuzz/programs")
    args = parser.parse_args()

    if args.kept:
        jobs = [(kind, path.read_bytes(), path.stem) for kind in KINDS for path in sorted((ROOT / "tests/fuzz/programs").glob(f"{kind}_*"))]
    else:
        found = seeds()

        def job(i):
            rng = random.Random(f"{args.seed}/{i}")
            kind = rng.choice(KINDS)
            return kind, mutated(rng.choice(found[kind]).read_bytes(), rng), f"{kind}_{args.seed}_{i}"

        jobs = (job(i) for i in range(args.count))
        print(f"{args.count} files, --seed {args.seed}")

    watch, failures, total = Stopwatch(), [], 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for failure in pool.map(lambda j: attempt(args.tactus, *j[:2], args.keep, j[2]), jobs):
            total += 1
            if failure:
                failures.append(failure)
                print(failure, flush=True)
            elif total % 1000 == 0:
                print(f"  {total} files, {watch}", flush=True)
    print(f"{total} files, {len(failures)} failures, {watch}")
    return 1 if failures or total == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
