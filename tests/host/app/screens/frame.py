#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The first window of the host is on the screen as a whole, with the title bar that a window manager gives it.

frame.py HOST   skipped without Xvfb, openbox, xdotool, xwininfo and xprop
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time

SIZES = ("1024x700", "1280x720", "1600x1000")
PATIENCE = 60.0  # s
NEEDED = ("Xvfb", "openbox", "xdotool", "xwininfo", "xprop")


def output(environment, *words):
    return subprocess.run(words, env=environment, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout


def outer(environment, window):
    """The window with its frame: left, top, right, bottom. None as long as it has no frame."""
    extents = re.search(r"= (\d+), (\d+), (\d+), (\d+)", output(environment, "xprop", "-id", window, "_NET_FRAME_EXTENTS"))
    info = output(environment, "xwininfo", "-id", window)
    numbers = [re.search(f"{name}: +(-?\\d+)", info) for name in ("Absolute upper-left X", "Absolute upper-left Y", "Width", "Height")]
    if not extents or not all(numbers):
        return None
    left, right, top, bottom = map(int, extents.groups())
    x, y, width, height = (int(n.group(1)) for n in numbers)
    return (x - left, y - top, x + width + right, y + height + bottom) if top > 0 else None


def until(so, patience=PATIENCE):
    """Waits for a value that is not None."""
    end = time.monotonic() + patience
    while time.monotonic() < end:
        value = so()
        if value is not None:
            return value
        time.sleep(0.05)
    return None


def with_window_manager(size, home, log, programs):
    """The environment of a new screen on which openbox runs. Starts Xvfb and openbox again if either ends or does not answer."""
    for attempt in range(3):
        read, write = os.pipe()
        name = f":{1000 + (os.getpid() + attempt * 101) % 50000}"  # never :0, which other tests would open
        # -noreset: otherwise the server would start again, without openbox, whenever it has no client.
        words = ["Xvfb", name, "-displayfd", str(write), "-screen", "0", f"{size}x24", "-nolisten", "tcp", "-noreset"]
        server = subprocess.Popen(words, pass_fds=[write], stderr=log)
        programs.append(server)
        os.close(write)
        with os.fdopen(read) as told:
            display = told.readline().strip()
        if not display:
            continue
        environment = dict(os.environ, DISPLAY=f":{display}", HOME=home, TACTUS_HOME=home)
        manager = subprocess.Popen(["openbox", "--sm-disable"], env=environment, stdout=log, stderr=log)
        programs.append(manager)

        def state():
            if manager.poll() is not None or server.poll() is not None:
                return False
            return "window id" in output(environment, "xprop", "-root", "_NET_SUPPORTING_WM_CHECK") or None

        if until(state, PATIENCE / 3):
            return environment
        print(f"attempt {attempt + 1}: openbox has exit code {manager.poll()}, Xvfb {server.poll()}")
    return None


def check(host, size):
    with tempfile.TemporaryDirectory(prefix="tactus-frame-") as home, tempfile.TemporaryFile("w+") as log:
        programs = []
        try:
            environment = with_window_manager(size, home, log, programs)
            if environment is None:
                log.seek(0)
                return f"the window manager does not start. Xvfb and openbox print: {log.read().strip() or 'nothing'}"
            programs.append(subprocess.Popen([host, "--safe", "--osc", "off"], env=environment))
            width, height = map(int, size.split("x"))
            seen = []

            def place():
                for window in output(environment, "xdotool", "search", "--onlyvisible", "--name", "Tactus").split():
                    if found := outer(environment, window):
                        seen[:] = [found]
                        return found
                return None

            whole = (0, 0, width, height)
            if until(lambda: place() == whole or None) is None:
                return f"on a screen of {size}, the window with its frame is at {seen}"
            time.sleep(1.0)  # it stays there
            return None if until(place) == whole else f"on a screen of {size}, the window moves to {seen}"
        finally:
            for program in reversed(programs):
                program.terminate()
                program.wait()


def main():
    missing = [program for program in NEEDED if not shutil.which(program)]
    if missing:
        print("skipped: not installed:", ", ".join(missing))
        return 77
    wrong = [what for what in (check(sys.argv[1], size) for size in SIZES) if what]
    for what in wrong:
        print(what)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
