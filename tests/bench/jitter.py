#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Measures how late ticks begin with and without real-time priority, on a computer that is idle or busy. Needs root, and must not run beside
anything else. The table is in docs/realtime.md.

jitter.py TACTUS [SECONDS] [ROUNDS]   the four cases take turns"""

import os
import re
import shutil
import subprocess
import sys
import tempfile

GRAPH = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../graphs/dry_wood.json")
SUMMARY = re.compile(r"late p50 ([\d.]+) us, p99 ([\d.]+) us, max ([\d.]+) us, missed (\d+) of (\d+) ticks")
NOBODY = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups", "--no-new-privs", "--bounding-set=-all"]


def play(program, seconds, is_granted, home):
    command = ([] if is_granted else NOBODY) + [program, "play", GRAPH, "--duration", str(seconds), "--osc", "off"]
    ran = subprocess.run(command, capture_output=True, text=True, check=False, env={**os.environ, "HOME": home, "TACTUS_HOME": home})
    found = SUMMARY.search(ran.stdout + ran.stderr)
    if not found:
        raise SystemExit(f"{' '.join(command)}: {ran.stdout}{ran.stderr}")
    if is_granted == ("no real-time priority" in ran.stdout + ran.stderr):
        raise SystemExit("the real-time priority is not as this case needs it")
    return [float(x) for x in found.groups()]


def main():
    program, seconds, rounds = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 20, int(sys.argv[3]) if len(sys.argv) > 3 else 3
    with tempfile.TemporaryDirectory() as home:
        os.chmod(home, 0o777)
        copy = shutil.copy(program, home)   # the other user may not enter the folder of the build
        print("| computer | priority | median | 99 % | worst | missed ticks |\n|---|---|---:|---:|---:|---:|")
        worst = {}
        for _ in range(rounds):
            for is_busy in (False, True):
                for is_granted in (True, False):
                    load = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(2 * os.cpu_count() if is_busy else 0)]
                    try:
                        now = play(copy, seconds, is_granted, home)
                    finally:
                        for process in load:
                            process.kill()
                            process.wait()
                    worst.setdefault((is_busy, is_granted), []).append(now)
        for (is_busy, is_granted), all_rounds in worst.items():
            p50, p99, most, missed, ticks = (max(column) for column in zip(*all_rounds))
            print(f"| {'busy' if is_busy else 'idle'} | {'real-time' if is_granted else 'ordinary'} | {p50:g} us | {p99:g} us | {most:g} us | "
                  f"{missed:.0f} of {ticks:.0f} |")


main()
