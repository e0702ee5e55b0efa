#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Drives the host with mouse and keyboard on a virtual display, and takes a picture after each step: ./test.sh --screens

walk.py HOST OUT [WIDTHxHEIGHT dark|light]   default: all sizes and themes

`tactus-host --places` writes a file that says where things are on the screen. The walk fails if a step does not have the
expected effect. A person must judge from the pictures in OUT whether the result looks good.
"""
import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

PATIENCE = 30.0  # s to wait for something to appear
SIZES, THEMES = ("1024x700", "1280x720", "1920x1080", "2560x1440", "3840x2160"), ("dark", "light")


class Walk:
    def __init__(self, host, out, size, theme, server_options=()):
        self.host, self.out, self.size, self.theme = host, out, size, theme
        self.home = pathlib.Path(tempfile.mkdtemp(prefix="tactus-walk-"))
        self.places_file = self.home / "places.json"
        self.shots = 0
        self.program = None
        for display in range(90, 200):
            if pathlib.Path(f"/tmp/.X{display}-lock").exists():
                continue
            server = ["Xvfb", f":{display}", "-screen", "0", f"{size}x24", "-nolisten", "tcp", *server_options]
            self.server = subprocess.Popen(server, stderr=subprocess.DEVNULL)
            time.sleep(1.0)
            if self.server.poll() is None:
                self.display = f":{display}"
                break
        self.environment = dict(os.environ, DISPLAY=self.display, TACTUS_HOME=str(self.home / "settings"), HOME=str(self.home))

    def start(self, *arguments):
        self.places_file.unlink(missing_ok=True)
        theme = ["--light"] if self.theme == "light" else []
        self.program = subprocess.Popen([self.host, "--places", str(self.places_file), *theme, *arguments], env=self.environment)
        self.wait(lambda: self.places_file.exists(), "the window")
        time.sleep(1.0)

    def kill(self):
        self.program.send_signal(signal.SIGKILL)
        self.program.wait()

    def end(self):
        if self.program and self.program.poll() is None:
            self.kill()
        self.server.terminate()
        self.server.wait()
        shutil.rmtree(self.home)

    def places(self):
        for _ in range(20):
            try:
                return json.loads(self.places_file.read_text())
            except (OSError, ValueError):
                time.sleep(0.05)
        raise SystemExit(f"{self.places_file} cannot be read")

    def has(self, name):
        places = self.places()
        return name in places or name in places["window"]

    def wait(self, so, what):
        end = time.monotonic() + PATIENCE
        while not so():
            if self.program and self.program.poll() is not None:
                raise SystemExit(f"the host exited with {self.program.returncode} while the walk waited for: {what}")
            if time.monotonic() > end:
                raise SystemExit(f"{self.size} {self.theme}: did not appear within {PATIENCE:.0f} s: {what}")
            time.sleep(0.05)

    def at(self, name):
        self.wait(lambda: self.has(name), name)
        places = self.places()
        return places.get(name) or places["window"][name]

    def xdo(self, *words):
        subprocess.run(["xdotool", *map(str, words)], env=self.environment, check=True)

    def to(self, place):
        x, y = self.at(place) if isinstance(place, str) else place
        self.xdo("mousemove", x, y)
        time.sleep(0.08)

    def click(self, place, times=1):
        self.to(place)
        for _ in range(times):
            self.xdo("click", 1)
            time.sleep(0.06)
        time.sleep(0.25)

    def press(self, place):
        self.to(place)
        self.xdo("mousedown", 1)
        time.sleep(0.08)

    def release(self):
        self.xdo("mouseup", 1)
        time.sleep(0.3)

    def glide(self, start, end, steps=12):
        for i in range(1, steps + 1):
            self.xdo("mousemove", round(start[0] + (end[0] - start[0]) * i / steps), round(start[1] + (end[1] - start[1]) * i / steps))
            time.sleep(0.02)
        time.sleep(0.2)

    def drag(self, start, end):
        a, b = (self.at(p) if isinstance(p, str) else p for p in (start, end))
        self.press(a)
        self.glide(a, b)
        self.release()

    def key(self, *keys):
        for k in keys:
            self.xdo("key", k)
            time.sleep(0.12)
        time.sleep(0.2)

    def type(self, text):
        self.xdo("type", "--delay", 25, text)
        time.sleep(0.4)

    def shot(self, name):
        self.shots += 1
        time.sleep(0.5)
        file = self.out / f"{self.size}-{self.theme}-{self.shots:02}-{name}.png"
        picture = self.home / "shot.png"
        subprocess.run(["/usr/bin/import", "-window", "root", str(picture)], env=self.environment, check=True)
        subprocess.run(["/usr/bin/convert", str(picture), "+dither", "-colors", "128", "-define", "png:compression-level=9", str(file)], check=True)
        print(f"  {file.name}", flush=True)

    def problems(self):
        """The name of the Problems tab if there are any problems, else None."""
        return next((name for name in self.places()["window"] if name.startswith("Problems ")), None)

    def empty_place(self):
        """A point on the canvas with no node near it."""
        nodes = [p for name, p in self.places().items() if isinstance(p, list)]
        canvas = self.at("Canvas")
        return [canvas[0], max(y for _, y in nodes) + 60]


def walk(w):
    w.start()
    w.wait(lambda: w.has("Dry wood"), "the welcome page with presets")
    time.sleep(3.0)  # while the plots of the forces are drawn
    w.shot("welcome")

    w.click("Dry wood")
    w.wait(lambda: w.has("drag"), "the graph of Dry wood")
    time.sleep(1.0)
    w.shot("dry-wood")

    # Stroke with the mouse.
    surface = w.at("Surface")
    reach = 90
    w.press([surface[0] - reach, surface[1]])
    for _ in range(3):
        w.glide([surface[0] - reach, surface[1]], [surface[0] + reach, surface[1]])
        w.glide([surface[0] + reach, surface[1]], [surface[0] - reach, surface[1]])
    w.glide([surface[0] - reach, surface[1]], [surface[0] + 20, surface[1]])
    w.shot("stroked")

    # Turn a knob while the tool presses: H keeps it pressed.
    w.key("h")
    w.release()
    mu = w.at("drag.d_max value")
    w.press(mu)
    w.glide(mu, [mu[0], mu[1] - 20])
    w.shot("knob-turned-while-pressing")
    w.release()
    w.key("h")

    # Draw a wire: ports that fit light up. Dropped on empty canvas, it opens the palette.
    start = w.at("hand.position")
    w.press(start)
    w.glide(start, w.at("drag.normal_force"))
    w.shot("wire-does-not-fit")
    w.glide(w.at("drag.normal_force"), w.empty_place())
    w.release()
    w.wait(lambda: w.has("Palette"), "the palette")
    w.type("grating")
    w.shot("palette")
    w.key("Return")
    w.wait(lambda: "grating" in w.places(), "the node grating")
    w.shot("node-added")
    w.key("ctrl+z", "Home")   # in a small window, the view follows a new node

    # Make a loop, read the problem, fix it.
    w.drag("drag.deflection", "board.position")
    w.wait(lambda: w.problems(), "a problem")
    w.click(w.problems())
    w.shot("loop")
    w.click("Delay wire by a tick")
    w.wait(lambda: not w.problems(), "no problems left")
    w.shot("loop-fixed")
    w.key("ctrl+z", "ctrl+z")

    # Add a layer.
    w.click("Layers")
    w.shot("no-layers")
    w.click("Add a mixer before the motor")
    w.wait(lambda: w.has("desk"), "a mixer")
    w.click("Other layer...")
    w.shot("layer-menu")
    w.key("Down", "Down", "Return")
    w.wait(lambda: w.has("desk.in[3]"), "another layer")
    w.shot("layers")
    w.key("Home")

    # Group two nodes into a subgraph, and enter it.
    w.click("grain")
    w.xdo("keydown", "shift")
    w.click("grain_felt")
    w.xdo("keyup", "shift")
    w.key("g")
    w.wait(lambda: w.has("group"), "the subgraph")
    w.click("group", times=2)
    w.wait(lambda: w.has("grain") and not w.has("drag"), "the inside of the subgraph")
    w.shot("subgraph")
    w.key("u")
    w.wait(lambda: w.has("drag"), "the outer graph")

    w.click("History")
    w.shot("history")
    w.click("drag")
    w.key("F1")
    w.shot("help")
    w.click("Close")

    # Save, edit, kill, recover.
    w.key("ctrl+s")
    w.shot("save-as")
    w.key("Return")   # accept the proposed folder and name
    saved = w.home / "Documents" / "Tactus" / "dry_wood.json"
    w.wait(saved.exists, "the saved file")
    w.shot("saved")
    damping = w.at("board.damping value")
    w.drag(damping, [damping[0], damping[1] - 30])
    time.sleep(4.0)  # the recovery file is written soon after the edit
    w.kill()
    w.start()
    w.wait(lambda: w.has("Recover") or w.has("Recover without running"), "the offer to recover")
    w.shot("recovery")

    def recovered():   # a window that has just started may lose a click
        for answer in ("Recover", "Recover without running"):
            if w.has(answer):
                w.click(answer)
                break
        return w.has("drag")

    w.wait(recovered, "the recovered graph")
    w.shot("recovered")

    w.click("Devices")
    time.sleep(1.0)  # while the host looks for devices
    w.shot("devices")

    # Fit a recording.
    w.kill()
    recording = w.home / "strokes.csv"
    recording.write_text(strokes())
    w.start(str(recording))
    w.click("Discard")   # the graph that was open
    w.wait(lambda: w.has("Recording and fit") and w.has("Fitted parameters"), "the fit")
    w.shot("fit")
    w.click("Open as new graph")
    w.wait(lambda: w.has("drag"), "the fitted graph")


def strokes():
    """Strokes of 1 mm on a contact that sticks, gives 0.15 mm and slides at 0.8 N under 2 N, with noise."""
    rng, rows, stretch, before = random.Random(3), ["position_mm,force,load"], 0.0, 0.0
    for i in range(1600):
        phase = i / 400.0 % 1.0
        position = 1.0 - abs(2.0 * phase - 1.0)
        stretch = min(0.15, max(-0.15, stretch + position - before))
        before = position
        rows.append(f"{position:.4f},{-0.8 * stretch / 0.15 + rng.gauss(0.0, 0.03):.4f},2")
    return "\n".join(rows) + "\n"


def main():
    host, out = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    out.mkdir(parents=True, exist_ok=True)
    one = tuple(sys.argv[3:5])
    for size, theme in [one] if one else [(s, t) for s in SIZES for t in THEMES]:
        print(f"{size} {theme}", flush=True)
        w = Walk(str(host), out, size, theme)
        try:
            walk(w)
        except SystemExit:
            w.shot("failed")
            raise
        finally:
            w.end()


if __name__ == "__main__":
    main()
