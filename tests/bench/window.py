#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Measures what the window costs: processor time of its process, user and system. Needs Xvfb and xdotool. The table is in docs/bench.md.

window.py HOST [SECONDS]   HOST is build/release/bin/tactus-host; each row at rest or in motion takes SECONDS, 10 if not given"""

import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/host/app/screens"))
from walk import Walk  # noqa: E402

TICKS = os.sysconf("SC_CLK_TCK")


def large(pairs):
    """A graph of so many planes and gratings on one hand and one motor."""
    nodes = {"hand": {"type": "device.position", "role": "stylus"}, "motor": {"type": "device.force", "role": "stylus"}}
    wires = []
    for i in range(pairs):
        nodes[f"plane{i}"] = {"type": "deform.plane", "params": {"stiffness": 2, "offset": -1e-5 * i}}
        nodes[f"grating{i}"] = {"type": "texture.grating", "params": {"amplitude": 0.001, "spatial_frequency": 100 + i}}
        for node in (f"plane{i}", f"grating{i}"):
            wires += [f"hand.position -> {node}.position", f"{node}.force -> motor.force"]
    wood = json.loads((ROOT / "graphs/dry_wood.json").read_text())
    return {"format": "tactus-graph", "version": 2, "name": "Large", "rate_hz": 1000, "devices": wood["devices"], "nodes": nodes, "wires": wires}


class Window(Walk):
    def __init__(self, host, *arguments):
        super().__init__(str(host), None, "1280x720", "dark")
        # Without --places, which costs more than the window at rest.
        self.program = subprocess.Popen([self.host, "--osc", "off", *map(str, arguments)], env=self.environment)
        self.wait(lambda: subprocess.run(["xdotool", "search", "--onlyvisible", "--class", "tactus"], env=self.environment, capture_output=True,
                                         check=False).stdout, "the window")
        time.sleep(3.0)

    def seconds(self):
        fields = pathlib.Path(f"/proc/{self.program.pid}/stat").read_text().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / TICKS

    def share(self, lasts_s):
        """The fraction of a core that the process takes."""
        begin, used = time.monotonic(), self.seconds()
        time.sleep(lasts_s)
        return (self.seconds() - used) / (time.monotonic() - begin)

    def megabytes(self):
        """Resident memory."""
        return int(pathlib.Path(f"/proc/{self.program.pid}/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6

    def settle(self):
        """Waits until the process does nothing but repeat itself."""
        before = 1.0
        for _ in range(60):
            now = self.share(1.0)
            if now < 0.1 or abs(now - before) < 0.02:
                return
            before = now

    def each(self, times, *keys):
        """Processor time of each of several actions, beyond that of doing nothing."""
        self.settle()
        idle = self.share(2.0)
        begin, used = time.monotonic(), self.seconds()
        for _ in range(times):
            for k in keys:
                self.xdo("key", k)
                time.sleep(0.3)
        time.sleep(0.5)
        self.settle()
        lasted = time.monotonic() - begin
        return (self.seconds() - used - idle * lasted) / (times * len(keys))


def row(what, value):
    print(f"| {what} | {value} |", flush=True)


def main():
    host, lasts_s = pathlib.Path(sys.argv[1]).resolve(), float(sys.argv[2]) if len(sys.argv) > 2 else 10.0
    wood = ROOT / "graphs/dry_wood.json"
    print("| what | processor time |\n|---|---:|")
    w = Window(host, "--safe", wood)
    row("start with a preset, first three seconds", f"{w.seconds():.2f} s")
    time.sleep(3.0)   # the window comes to rest, and the first check is over
    row("window at rest", f"{w.share(lasts_s):.1%} of a core")
    begin, used = time.monotonic(), w.seconds()
    while time.monotonic() - begin < lasts_s:   # over the canvas
        w.glide((500, 200), (800, 400), 25)
        w.glide((800, 400), (500, 200), 25)
    row("only the pointer moves", f"{(w.seconds() - used) / (time.monotonic() - begin):.1%} of a core")
    w.to((640, 250))
    used = w.seconds()
    for button in (4, 5) * 10:
        w.xdo("click", button)
        time.sleep(0.1)
    time.sleep(0.5)
    row("one step of the wheel", f"{1e3 * (w.seconds() - used) / 20:.0f} ms")
    w.end()

    w = Window(host, wood)
    w.settle()
    before = w.megabytes()
    row("running Dry wood, scopes on", f"{w.share(lasts_s):.1%} of a core")
    row("memory that a second of it takes", f"{(w.megabytes() - before) / lasts_s:.2f} MB")
    w.end()

    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "large.json"
        file.write_text(json.dumps(large(500)))
        begin = time.monotonic()
        w = Window(host, "--safe", file)
        w.settle()
        row("start with a graph of 1002 nodes", f"{w.seconds():.2f} s")
        row("the same at rest", f"{w.share(lasts_s):.1%} of a core")
        row("one zoom step there", f"{1e3 * w.each(10, 'plus', 'minus'):.0f} ms")
        w.xdo("key", "ctrl+Right")   # selects a node
        row("one edit there: a node moves", f"{1e3 * w.each(5, 'Right', 'Left'):.0f} ms")
        w.end()
        w = Window(host, file)
        w.settle()
        row("the same running", f"{w.share(lasts_s):.1%} of a core")
        w.program.send_signal(signal.SIGTERM)
        begin = time.monotonic()
        w.program.wait()
        row("closing it", f"{time.monotonic() - begin:.2f} s by the clock")
        w.end()


main()
