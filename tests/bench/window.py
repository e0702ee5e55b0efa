#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Measures what the window costs: processor time of its process, user and system. Needs Xvfb and xdotool. The table is in docs/bench.md.

window.py HOST [SECONDS [ROW...]]   HOST is build/release/bin/tactus-host; each row at rest or in motion takes SECONDS, 10 if not given. ROW is rest,
                                    run, large, inputs or huge: all but the last, if none is given"""

import json
import os
import pathlib
import re
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/host/app/screens"))
from walk import Walk  # noqa: E402

TICKS = os.sysconf("SC_CLK_TCK")
WOOD = ROOT / "graphs/dry_wood.json"


def large(pairs, more_wires=0):
    """A graph of so many planes and gratings on one hand and one motor."""
    nodes = {"hand": {"type": "device.position", "role": "stylus"}, "motor": {"type": "device.force", "role": "stylus"}}
    wires = []
    for i in range(pairs):
        nodes[f"plane{i}"] = {"type": "deform.plane", "params": {"stiffness": 2, "offset": -1e-5 * i}}
        nodes[f"grating{i}"] = {"type": "texture.grating", "params": {"amplitude": 0.001, "spatial_frequency": 100 + i}}
        for node in (f"plane{i}", f"grating{i}"):
            wires += [f"hand.position -> {node}.position", f"{node}.force -> motor.force"]
    wires += [f"plane{i}.resistance -> grating{i}.amplitude" for i in range(more_wires)]
    wood = json.loads(WOOD.read_text())
    return {"format": "tactus-graph", "version": 2, "name": "Large", "rate_hz": 1000, "devices": wood["devices"], "nodes": nodes, "wires": wires}


class Window(Walk):
    def __init__(self, host, *arguments, settings=None, osc="off"):
        super().__init__(str(host), None, "1280x720", "dark")
        if settings:
            folder = self.home / "settings"
            folder.mkdir()
            (folder / "settings.json").write_text(json.dumps(settings))
        # Without --places, which costs more than the window at rest.
        self.program = subprocess.Popen([self.host, "--osc", osc, *map(str, arguments)], env=self.environment)
        self.wait(lambda: subprocess.run(["xdotool", "search", "--onlyvisible", "--class", "tactus"], env=self.environment, capture_output=True,
                                         check=False).stdout, "the window")
        time.sleep(3.0)

    def seconds(self):
        fields = pathlib.Path(f"/proc/{self.program.pid}/stat").read_text().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / TICKS

    def message_seconds(self):
        """Processor time of the message thread alone, which answers the user: that of the work in the background does not count."""
        return int(pathlib.Path(f"/proc/{self.program.pid}/task/{self.program.pid}/schedstat").read_text().split()[0]) / 1e9

    def wakes(self, lasts_s):
        """How often a second the threads of the process wait for something and get it: counted, so it is the same on a busy machine."""
        def count():
            return sum(int(re.search(r"^voluntary_ctxt_switches:\s*(\d+)", s.read_text(), re.M)[1])
                       for s in pathlib.Path(f"/proc/{self.program.pid}/task").glob("*/status"))
        begin, before = time.monotonic(), count()
        time.sleep(lasts_s)
        return (count() - before) / (time.monotonic() - begin)

    def share(self, lasts_s, seconds=None):
        """The fraction of a core that the process takes."""
        seconds = seconds or self.seconds
        begin, used = time.monotonic(), seconds()
        time.sleep(lasts_s)
        return (seconds() - used) / (time.monotonic() - begin)

    def megabytes(self):
        """Resident memory."""
        return int(pathlib.Path(f"/proc/{self.program.pid}/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6

    def settle(self):
        """Waits until the process rests, or repeats itself for longer than a check of a large graph takes."""
        before, same_for = 1.0, 0
        for _ in range(60):
            now = self.share(1.0)
            same_for = same_for + 1 if abs(now - before) < 0.05 else 0
            if now < 0.1 or same_for > 8:
                return
            before = now

    def each(self, times, *keys, seconds=None):
        """Processor time of each of several actions, beyond that of doing nothing."""
        seconds = seconds or self.seconds
        self.settle()
        idle = self.share(2.0, seconds)
        begin, used = time.monotonic(), seconds()
        for _ in range(times):
            for k in keys:
                self.xdo("key", k)
                time.sleep(0.3)
        time.sleep(0.5)
        self.settle()
        lasted = time.monotonic() - begin
        return (seconds() - used - idle * lasted) / (times * len(keys))


def row(what, value):
    print(f"| {what} | {value} |", flush=True)


def rest(host, lasts_s):
    w = Window(host, "--safe", WOOD)
    row("start with a preset, first three seconds", f"{w.seconds():.2f} s")
    time.sleep(3.0)   # the window comes to rest, and the first check is over
    row("window at rest", f"{w.share(lasts_s):.1%} of a core")
    row("its threads wake", f"{w.wakes(lasts_s):.0f} times a second")
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


def run(host, lasts_s):
    w = Window(host, WOOD)
    w.settle()
    before = w.megabytes()
    row("running Dry wood, scopes on", f"{w.share(lasts_s):.1%} of a core")
    row("memory that a second of it takes", f"{(w.megabytes() - before) / lasts_s:.2f} MB")
    w.end()
    w = Window(host, WOOD, settings={"scene": True})
    w.settle()
    row("the same with the scene in space", f"{w.share(lasts_s):.1%} of a core")
    w.end()


def large_graph(host, lasts_s):
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "large.json"
        file.write_text(json.dumps(large(500)))
        w = Window(host, "--safe", file)
        w.settle()
        row("start with a graph of 1002 nodes", f"{w.seconds():.2f} s")
        row("the same at rest", f"{w.share(lasts_s):.1%} of a core")
        row("one zoom step there", f"{1e3 * w.each(10, 'plus', 'minus'):.0f} ms")
        w.xdo("key", "ctrl+Right")   # selects a node
        w.xdo("key", "Right")        # the first edit stores the places of all nodes
        row("one edit there: a node moves, message thread", f"{1e3 * w.each(5, 'Right', 'Left', seconds=w.message_seconds):.0f} ms")
        row("the same with the check and the autosave after it", f"{1e3 * w.each(5, 'Right', 'Left'):.0f} ms")
        w.end()
        w = Window(host, file)
        w.settle()
        row("the same running", f"{w.share(lasts_s):.1%} of a core")
        row("of it, the message thread", f"{w.share(lasts_s, w.message_seconds):.1%} of a core")
        w.program.send_signal(signal.SIGTERM)
        begin = time.monotonic()
        w.program.wait()
        row("closing it", f"{time.monotonic() - begin:.2f} s by the clock")
        w.end()


def text(s):
    data = s.encode() + b"\0"
    return data + b"\0" * (-len(data) % 4)


def status(port):
    """Ticks, and late ticks, as the window says over OSC."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as s:
        s.bind(("127.0.0.1", 0))
        s.settimeout(10.0)
        s.sendto(text("/tactus/status") + text(",i") + struct.pack(">i", s.getsockname()[1]), ("127.0.0.1", port))
        return struct.unpack(">ii", s.recv(4096)[-8:])


def inputs(host, pairs, more_wires, rounds):
    """What single inputs cost while a large graph runs."""
    port = 7791
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "large.json"
        file.write_text(json.dumps(large(pairs, more_wires)))
        w = Window(host, file, osc=str(port))
        w.settle()
        begun, late_before = status(port)
        w.click((260, 380))          # on the canvas, which then has the keyboard
        w.xdo("key", "ctrl+Right")   # selects a node
        w.xdo("key", "Right")        # the first edit stores the places of all nodes
        w.settle()
        idle = w.share(5.0, w.message_seconds)
        actions = [("key", "Right"), ("key", "plus"), ("click", 4), ("key", "ctrl+z"), ("mousemove", 700, 300), ("key", "minus"), ("click", 5),
                   ("mousemove", 640, 250), ("key", "ctrl+Right"), ("key", "Left")]
        costs = []
        for _ in range(rounds):
            for action in actions:
                begin, used = time.monotonic(), w.message_seconds()
                w.xdo(*action)
                time.sleep(0.5)
                costs.append((w.message_seconds() - used - idle * (time.monotonic() - begin), action))
        costs.sort(key=lambda c: c[0])
        what = f"{2 * pairs + 2} nodes, {4 * pairs + more_wires} wires, running"
        row(f"{what}: message thread without inputs", f"{idle:.1%} of a core")
        row(f"{what}: an input, median", f"{1e3 * costs[len(costs) // 2][0]:.0f} ms")
        row(f"{what}: 99 of 100 inputs take at most", f"{1e3 * costs[-max(1, len(costs) // 100) - 1][0]:.0f} ms")
        row(f"{what}: the slowest input", f"{1e3 * costs[-1][0]:.0f} ms: {' '.join(map(str, costs[-1][1]))}")
        before = w.megabytes()
        for _ in range(10):
            w.xdo("key", "--delay", "40", *["Right", "Left"] * 50)
        w.settle()
        row(f"{what}: memory that 1000 edits take", f"{w.megabytes() - before:.1f} MB")
        ticks, late = status(port)
        row(f"{what}: late ticks meanwhile", f"{late - late_before} of {ticks - begun}")
        w.end()


def main():
    host, lasts_s = pathlib.Path(sys.argv[1]).resolve(), float(sys.argv[2]) if len(sys.argv) > 2 else 10.0
    chosen = sys.argv[3:] or ["rest", "run", "large", "inputs"]
    print("| what | processor time |\n|---|---:|")
    rows = {"rest": lambda: rest(host, lasts_s), "run": lambda: run(host, lasts_s), "large": lambda: large_graph(host, lasts_s),
            "inputs": lambda: inputs(host, 1000, 1000, 20), "huge": lambda: inputs(host, 5000, 5000, 5)}
    for name in chosen:
        rows[name]()


main()
