#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Drives tactus-host.exe in wine with mouse and keyboard: window.py TACTUS BIN WINE GRAPHS WORK. Arguments as for presets.py.

It plays Dry wood with the mouse, and `tactus probe` on Linux reads the force over OSC; it stops, also while the thread of the window hangs, changes a
parameter, saves, opens a preset and a file with another name, is killed with an edit that is not saved, and gets it back. It takes a file that another
program of Windows drops on it, and saves and opens by its dialogs. All this on a screen with the usual resolution, and on one with twice as many pixels
for each length. Pictures are in WORK/window."""

import json
import os
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests/host/app/screens"), str(ROOT / "tests/windows")]
from walk import Walk   # noqa: E402
from wine import restart   # noqa: E402

OSC = "7791"


def there(path):
    """A path of Linux, as wine names it."""
    return "Z:" + str(path).replace("/", "\\")


class InWine(Walk):
    """The window on a screen with `scale` times 96 dots per inch."""

    def __init__(self, tactus, wine, exe, out, scale):
        out.mkdir(parents=True, exist_ok=True)
        super().__init__(str(exe), out, f"{1600 * scale}x{1000 * scale}", "dark")
        self.tactus, self.wine, self.folder, self.scale = tactus, wine, exe.parent, scale
        self.environment.update(TACTUS_HOME=there(self.home / "settings"), HOME=os.environ["HOME"])
        subprocess.run([wine, "reg", "add", "HKCU\\Control Panel\\Desktop", "/v", "LogPixels", "/t", "REG_DWORD", "/d", str(96 * scale), "/f"], check=True,
                       capture_output=True)
        restart(wine, self.environment)   # on this screen

    def start(self, *arguments):
        self.places_file.unlink(missing_ok=True)
        self.program = subprocess.Popen([self.wine, self.host, "--places", there(self.places_file), "--osc", OSC, *arguments], env=self.environment)
        self.wait(self.places_file.exists, "the window")

    def end(self):
        if self.program:
            self.kill()
        restart(self.wine)   # lets the screen go
        super().end()

    def save(self, is_saved):
        """Ctrl+S, and again if the window, which may have just started, has lost it."""
        self.wait(lambda: is_saved() or self.key("ctrl+s") or is_saved(), "the file with the change")

    def places(self):
        """In pixels; the program does not know of them."""
        def scaled(at):
            if isinstance(at, dict):
                return {name: scaled(place) for name, place in at.items()}
            return [self.scale * pixel for pixel in at]
        return scaled(super().places())

    def stroke(self):
        """Presses on the surface, and moves there."""
        x, y = self.at("Surface")
        self.press([x - 60 * self.scale, y])
        self.glide([x - 60 * self.scale, y], [x + 20 * self.scale, y])

    def drop(self, file, place):
        """Drags this file here from a window of another program."""
        source = subprocess.Popen([self.wine, self.folder / "drop.exe", there(file), "5", "5"], env=self.environment, text=True, stdout=subprocess.PIPE)
        said = source.stdout.readline()
        assert said == "ready\n", said
        self.drag([25, 25], place)
        said = source.stdout.readline()
        assert said == "dropped\n", said
        source.wait()

    def dialog(self, keys, title, name):
        """Types a name into the dialog that these keys open. A window that works on something else may lose the keys."""
        self.wait(lambda: self.has(title) or self.key(keys) or self.has(title), title)
        self.shot("dialog")
        self.type(name)
        self.key("Return")

    def title(self):
        found = subprocess.run(["xdotool", "search", "--name", "Tactus$", "getwindowname"], env=self.environment, capture_output=True, text=True, check=False)
        return found.stdout.strip()


def force(tactus):
    """The largest force in N within a third of a second, by `tactus probe` on Linux."""
    rows = subprocess.run([tactus, "probe", "motor.force", "--osc", OSC, "--rate", "100", "--duration", "0.3"], capture_output=True, text=True, check=False)
    lines = [line.split(",") for line in rows.stdout.splitlines()]
    return max((sum(float(v)**2 for v in row[1:])**0.5 for row in lines[1:]), default=None)


def value(file, node, param):
    return json.loads(file.read_text())["nodes"][node]["params"][param]


def stop_while_it_hangs(w):
    """Stops by Esc and by STOP, while the thread of the window hangs: the thread of the ticks, which has waited most often, ends."""
    tasks = pathlib.Path(f"/proc/{w.program.pid}/task")

    def waits():
        return {task.name: int((task / "status").read_text().split("\nvoluntary_ctxt_switches:")[1].split()[0]) for task in tasks.iterdir()}

    for stop in ("escape", "click"):
        w.key("F5")   # START takes no click within a second after a stop
        w.wait(lambda: w.has("STOP"), "the start")
        if stop == "click":
            stop = "click {} {}".format(*w.at("STOP"))
        hung = subprocess.Popen([w.wine, w.folder / "hung.exe"], env=w.environment, text=True, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        said = hung.stdout.readline()
        assert said == "hung\n", said
        before = waits()
        assert force(w.tactus) is None, "the window that hangs answers"   # also, some time passes
        after = waits()
        ticks = max(after, key=lambda task: after[task] - before.get(task, 0))
        assert after[ticks] - before.get(ticks, 0) > 50, "while the window hangs, nothing ticks"
        hung.stdin.write(stop + "\n")
        hung.stdin.flush()
        w.wait(lambda: not (tasks / ticks).exists(), f"{stop}: a stop while the window hangs")
        hung.communicate()
        w.wait(lambda: w.has("START"), "a window that goes on")


def walk(w, tactus, graphs):
    mine = w.home / "Brettchen ж 😀.json"
    shutil.copy(graphs / "dry_wood.json", mine)
    w.start(there(mine))
    w.wait(lambda: w.has("drag.mu value") and w.has("STOP"), "a graph that runs")
    assert "Dry wood" in w.title(), w.title()

    w.stroke()
    w.shot("stroke")
    felt = force(tactus)
    assert felt is not None and felt > 0.1, f"the tool presses on the wood, and the force is {felt} N"
    w.key("Escape")
    w.wait(lambda: w.has("START"), "a stop by Esc")
    w.release()
    assert force(tactus) in (None, 0.0), "after the stop, there is a force"
    w.shot("stopped")
    w.click("START")
    w.wait(lambda: w.has("STOP"), "the start")
    w.click("STOP")
    w.wait(lambda: w.has("START"), "a stop by the mouse")
    stop_while_it_hangs(w)

    before = value(mine, "board", "damping")
    damping = w.at("board.damping value")
    w.drag(damping, [damping[0], damping[1] - 30 * w.scale])
    w.save(lambda: value(mine, "board", "damping") != before)
    assert b"\r" not in mine.read_bytes()
    subprocess.run([tactus, "validate", mine], check=True, stdout=subprocess.DEVNULL)
    w.shot("saved")

    saved = mine.read_bytes()
    damping = w.at("board.damping value")
    w.drag(damping, [damping[0], damping[1] + 20 * w.scale])
    recovery = w.home / "settings"
    w.wait(lambda: any("damping" in f.read_text(errors="replace") for f in recovery.rglob("*.json") if "session" in str(f)), "the recovery file")
    w.kill()
    assert mine.read_bytes() == saved
    w.start()

    def recovered():   # a window that has just started may lose a click
        for answer in ("Recover", "Recover without running"):
            if w.has(answer):
                w.click(answer)
                break
        return w.has("drag")

    w.wait(recovered, "the recovered graph")
    w.shot("recovered")
    w.save(lambda: mine.read_bytes() != saved)

    w.click("Search presets")
    w.type("bronze bell")
    w.key("Return")
    w.wait(lambda: "Bronze bell" in w.title(), "the preset")
    w.shot("preset")

    wall = w.home / "Wand ж 😀.json"
    shutil.copy(graphs / "granite_wall.json", wall)
    w.drop(wall, w.empty_place())
    w.wait(lambda: w.has("granite_wall"), "the graph that was dropped")
    w.shot("dropped")
    kept = w.home / "noch eins.json"
    w.dialog("ctrl+shift+s", "Save graph", there(kept))
    w.wait(kept.exists, "the file that was saved by a dialog")
    subprocess.run([tactus, "validate", kept], check=True, stdout=subprocess.DEVNULL)
    w.wait(lambda: kept.name in w.title(), "its name")
    w.dialog("ctrl+o", "Open graph or clip", there(mine.rename(w.home / "brett.json")))
    w.wait(lambda: "brett.json" in w.title(), "the file that was opened by a dialog")


def main():
    tactus, folder, wine, graphs, work = sys.argv[1], *map(pathlib.Path, sys.argv[2:6])
    for scale in (2, 1):   # wine keeps the last one
        w = InWine(tactus, str(wine), folder / "tactus-host.exe", work / "window", scale)
        try:
            walk(w, tactus, graphs)
        except (SystemExit, AssertionError):
            w.shot("failed")
            raise
        finally:
            w.end()
        print(f"at {96 * scale} dpi, the window plays Dry wood by the mouse, stops, also while it hangs, saves and opens, also by dialogs, recovers after "
              "kill -9, and takes a file that another program drops", flush=True)


if __name__ == "__main__":
    main()
