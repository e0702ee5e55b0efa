#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Measures what the window costs: processor time of its process, user and system. Needs Xvfb and xdotool. The table is in docs/bench.md.

window.py HOST [SECONDS [ROW...]]   HOST is build/release/bin/tactus-host; each row at rest or in motion takes SECONDS, 10 if not given. ROW is start,
                                    rest, answers, run, drag, large, inputs or huge: all but the last, if none is given"""

import atexit
import json
import mmap
import os
import pathlib
import re
import shutil
import signal
import statistics
import socket
import struct
import subprocess
import sys
import tempfile
import time
import zlib

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


class Screen:
    """What the X server shows, read without asking it: it keeps the pixels in a file."""

    def __init__(self, folder):
        with open(pathlib.Path(folder) / "Xvfb_screen0", "rb") as file:
            self.bytes = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
        header = struct.unpack(">25I", self.bytes[:100])   # of an XWD file
        self.line, self.first, self.height = header[12], header[0] + 12 * header[19], header[5]

    def sum(self):
        return zlib.adler32(memoryview(self.bytes)[self.first:])

    def has_picture(self):
        """True if there is text in the middle of the screen and in the last line of the window: both have many colours."""
        def colours(top, height):
            at = self.first + top * self.line
            return len(set(memoryview(self.bytes)[at:at + height * self.line].cast("I")))
        return all(colours(top, 12) > 8 for top in (self.height // 2, self.height - 20))


class Window(Walk):
    def __init__(self, host, *arguments, settings=None, osc="off", waits=True):
        self.pixels = tempfile.mkdtemp(prefix="tactus-screen-")
        super().__init__(str(host), None, "1280x720", "dark", ("-fbdir", self.pixels))
        self.screen = Screen(self.pixels)
        atexit.register(self.kill_all)
        if settings:
            folder = self.home / "settings"
            folder.mkdir()
            (folder / "settings.json").write_text(json.dumps(settings))
        self.begun = time.monotonic()
        # Without --places, which costs more than the window at rest.
        self.program = subprocess.Popen([self.host, "--osc", osc, *map(str, arguments)], env=self.environment)
        if not waits:
            return
        self.wait(lambda: subprocess.run(["xdotool", "search", "--onlyvisible", "--class", "tactus"], env=self.environment, capture_output=True,
                                         check=False).stdout, "the window")
        time.sleep(3.0)

    def end(self):
        super().end()
        shutil.rmtree(self.pixels)

    def kill_all(self):
        """If a row fails, nothing of it goes on running."""
        for process in (self.program, self.server):
            if process and process.poll() is None:
                process.kill()

    def first_picture(self):
        """Processor time, and time by the clock, from the start of the program to the first picture in the window."""
        while not self.screen.has_picture():
            if time.monotonic() - self.begun > 60.0 or self.program.poll() is not None:
                raise SystemExit("the window shows nothing")
            time.sleep(0.002)
        return self.seconds(), time.monotonic() - self.begun

    def answers(self, actions):
        """For each action: processor time of the message thread until the window rests again, and the time by the clock until the picture differs."""
        idle, costs, clocks = self.share(2.0, self.message_seconds), [], []
        with subprocess.Popen(["xdotool", "-"], env=self.environment, stdin=subprocess.PIPE, text=True) as tool:
            for action in actions:
                begin, used, before = time.monotonic(), self.message_seconds(), self.screen.sum()
                tool.stdin.write(" ".join(map(str, action)) + "\n")
                tool.stdin.flush()
                while self.screen.sum() == before and time.monotonic() - begin < 2.0:
                    time.sleep(0.001)
                clocks.append(time.monotonic() - begin)
                time.sleep(0.3)
                costs.append(self.message_seconds() - used - idle * (time.monotonic() - begin))
        return costs, clocks

    def print_answers(self, what, actions):
        costs, clocks = self.answers(actions)
        row(f"{what}: message thread, median and largest", f"{1e3 * statistics.median(costs):.1f} and {1e3 * max(costs):.1f} ms")
        row(f"{what}: until the picture differs, by the clock, median", f"{1e3 * statistics.median(clocks):.0f} ms")

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


def start(host, _):
    """The start with files that the system has in memory, and with files that it reads from the disk."""
    w = Window(host, "--safe", WOOD)
    row("start with a preset, first three seconds", f"{w.seconds():.2f} s")
    used = {line.split(maxsplit=5)[5].rstrip() for line in open(f"/proc/{w.program.pid}/maps", encoding="utf-8") if "/" in line}
    w.end()
    for what, is_cold in (("start with a preset", False), ("the same, files from the disk", True)):
        os.sync()
        for file in [pathlib.Path(u) for u in used | {str(WOOD)}] if is_cold else []:
            if file.is_file():
                with file.open("rb") as f:
                    os.posix_fadvise(f.fileno(), 0, 0, os.POSIX_FADV_DONTNEED)
        w = Window(host, "--safe", WOOD, waits=False)
        seconds, clock = w.first_picture()
        read = int(re.search(r"^read_bytes: (\d+)", pathlib.Path(f"/proc/{w.program.pid}/io").read_text(), re.M)[1])
        row(f"{what}: until the first picture", f"{seconds:.2f} s, {clock:.2f} s by the clock, {read / 1e6:.0f} MB read")
        w.end()


def place_of(host, file, kind):
    """Where the first node of this name, or with a number after it, is on the screen. A window of this size always shows it there."""
    w = Walk(str(host), None, "1280x720", "dark")
    w.start("--safe", str(file))
    x, y = w.at("Canvas")
    near = [p for name, p in w.places().items() if re.fullmatch(rf"{kind}\d*", name) and abs(p[0] - x) < 300 and abs(p[1] - y) < 150]
    w.end()
    return near[0]


def dragged(w, what, place):
    """A node moves with the pointer."""
    w.press(place)
    w.print_answers(f"{what}: one step of a drag", [("mousemove", place[0] + 8 * (i % 2 + 1), place[1] + 8 * (i % 3)) for i in range(20)])
    w.release()


def wheel(w, what):
    w.to((640, 250))
    w.settle()
    w.print_answers(f"{what}: one step of the wheel", [("click", button) for button in (4, 5) * 10])


def answers(host, _):
    """How long the window takes to follow the wheel and a drag."""
    place = place_of(host, WOOD, "drag")
    w = Window(host, "--safe", WOOD)
    dragged(w, "Dry wood", place)
    wheel(w, "Dry wood")
    w.end()


def rest(host, lasts_s):
    w = Window(host, "--safe", WOOD)
    time.sleep(6.0)   # the window comes to rest, and the first check is over
    row("window at rest", f"{w.share(lasts_s):.1%} of a core")
    row("its threads wake", f"{w.wakes(lasts_s):.0f} times a second")
    begin, used = time.monotonic(), w.seconds()
    while time.monotonic() - begin < lasts_s:   # over the canvas
        w.glide((500, 200), (800, 400), 25)
        w.glide((800, 400), (500, 200), 25)
    row("only the pointer moves", f"{(w.seconds() - used) / (time.monotonic() - begin):.1%} of a core")
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


def drag(host, lasts_s):
    """A node of a graph whose wires are routed around nodes is dragged to and fro, 60 moves a second."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "medium.json"
        file.write_text(json.dumps(large(149)))
        place = place_of(host, file, "plane")
        for what, arguments in (("300 nodes: a node is dragged without a pause", ("--safe", file)), ("the same running", (file,))):
            w = Window(host, *arguments)
            w.settle()
            w.press(place)
            begin, used, message, moves = time.monotonic(), w.seconds(), w.message_seconds(), 0
            with subprocess.Popen(["xdotool", "-"], env=w.environment, stdin=subprocess.PIPE, text=True) as tool:
                while time.monotonic() - begin < lasts_s:
                    moves += 1
                    tool.stdin.write(f"mousemove {place[0] + 4 * abs(moves % 100 - 50)} {place[1] + 2 * abs(moves % 60 - 30)}\n")
                    tool.stdin.flush()
                    time.sleep(max(0.0, begin + moves / 60.0 - time.monotonic()))
            lasted = time.monotonic() - begin
            row(f"{what}, {moves / lasted:.0f} moves a second", f"{(w.seconds() - used) / lasted:.1%} of a core")
            row("of it, the message thread", f"{(w.message_seconds() - message) / lasted:.1%} of a core")
            w.release()
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
        row("one edit there: a node is bypassed, message thread", f"{1e3 * w.each(5, 'b', 'b', seconds=w.message_seconds):.0f} ms")
        w.end()
        place = place_of(host, file, "plane")
        w = Window(host, "--safe", file)
        w.settle()
        dragged(w, "there", place)
        wheel(w, "there")
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
    """Force in N, ticks, and late ticks, as the window says over OSC."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as s:
        s.bind(("127.0.0.1", 0))
        s.settimeout(300.0)   # the window answers after the inputs that it has got
        s.sendto(text("/tactus/status") + text(",i") + struct.pack(">i", s.getsockname()[1]), ("127.0.0.1", port))
        force, _, ticks, late = struct.unpack(">ffii", s.recv(4096)[-16:])
        return force, ticks, late


def inputs(host, pairs, more_wires, rounds):
    """What single inputs cost while a large graph runs: processor time of the message thread until it has handled them, with the frames that it paints
    meanwhile."""
    port = 7791
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "large.json"
        file.write_text(json.dumps(large(pairs, more_wires)))
        w = Window(host, file, osc=str(port))
        w.settle()
        _, begun, late_before = status(port)
        w.click((260, 380))          # on the canvas, which then has the keyboard
        w.xdo("key", "ctrl+Right")   # selects a node
        w.xdo("key", "Right")        # the first edit stores the places of all nodes
        w.settle()
        idle = w.share(5.0, w.message_seconds)
        actions = [("key", "Right"), ("key", "plus"), ("click", 4), ("key", "ctrl+z"), ("mousemove", 700, 300), ("key", "minus"), ("click", 5),
                   ("mousemove", 640, 250), ("key", "ctrl+Right"), ("key", "Left")]
        costs = []
        for _ in range(rounds):
            for action in actions:   # the window answers the question after it has handled the input
                used = w.message_seconds()
                w.xdo(*action)
                status(port)
                costs.append((w.message_seconds() - used, action))
                time.sleep(0.2)
        costs.sort(key=lambda c: c[0])
        what = f"{2 * pairs + 2} nodes, {4 * pairs + more_wires} wires, running"
        row(f"{what}: message thread without inputs", f"{idle:.1%} of a core")
        row(f"{what}: an input, median", f"{1e3 * costs[len(costs) // 2][0]:.0f} ms")
        row(f"{what}: 99 of 100 inputs take at most", f"{1e3 * costs[-max(1, len(costs) // 100) - 1][0]:.0f} ms")
        row(f"{what}: the slowest input", f"{1e3 * costs[-1][0]:.0f} ms: {' '.join(map(str, costs[-1][1]))}")
        before = w.megabytes()
        for _ in range(10):
            w.xdo("key", "--delay", "40", *["Right", "Left"] * 50)
        status(port)
        w.settle()
        row(f"{what}: memory that 1000 edits take", f"{w.megabytes() - before:.1f} MB")
        _, ticks, late = status(port)
        row(f"{what}: late ticks meanwhile", f"{late - late_before} of {ticks - begun}")
        stop_during_edits(w, what, port)
        w.end()


def stop_during_edits(w, what, port):
    """The answer of the window waits for the edits, the stop does not: so this is the most that it takes."""
    with subprocess.Popen(["xdotool", "key", "--delay", "20", *["Right", "Left"] * 100], env=w.environment):
        begin, pushed = time.monotonic(), 0.0
        while pushed == 0.0 and time.monotonic() - begin < 10.0:   # the hand of the preset touches from time to time
            pushed = status(port)[0]
        begin = time.monotonic()
        w.xdo("key", "shift+Escape")
        while status(port)[0] != 0.0 and time.monotonic() - begin < 10.0:
            pass
        row(f"{what}: Shift+Esc during edits, from {pushed:.2f} N until the window says 0", f"at most {1e3 * (time.monotonic() - begin):.0f} ms by the clock")


def main():
    host, lasts_s = pathlib.Path(sys.argv[1]).resolve(), float(sys.argv[2]) if len(sys.argv) > 2 else 10.0
    chosen = sys.argv[3:] or ["start", "rest", "answers", "run", "drag", "large", "inputs"]
    print("| what | processor time |\n|---|---:|")
    rows = {"start": start, "rest": rest, "answers": answers, "run": run, "drag": drag, "large": large_graph,
            "inputs": lambda *_: inputs(host, 1000, 1000, 20), "huge": lambda *_: inputs(host, 5000, 5000, 5)}
    for name in chosen:
        rows[name](host, lasts_s)


main()
