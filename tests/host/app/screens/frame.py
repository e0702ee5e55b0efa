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


def until(so):
    """Waits for a value that is not None."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        value = so()
        if value is not None:
            return value
        time.sleep(0.05)
    return None


def check(host, size):
    read, write = os.pipe()
    name = f":{1000 + os.getpid() % 50000}"  # never :0, which other tests would open
    server = subprocess.Popen(["Xvfb", name, "-displayfd", str(write), "-screen", "0", f"{size}x24", "-nolisten", "tcp"], pass_fds=[write], stderr=subprocess.DEVNULL)
    os.close(write)
    with os.fdopen(read) as told, tempfile.TemporaryDirectory(prefix="tactus-frame-") as home:
        programs = [server]
        try:
            environment = dict(os.environ, DISPLAY=f":{told.readline().strip()}", HOME=home, TACTUS_HOME=home)
            programs.append(subprocess.Popen(["openbox", "--sm-disable"], env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL))
            if until(lambda: "window id" in output(environment, "xprop", "-root", "_NET_SUPPORTING_WM_CHECK") or None) is None:
                return "the window manager does not start"
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
