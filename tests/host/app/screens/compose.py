#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Composes with the keyboard alone on a virtual display, and copies between two windows: ./test.sh --screens

compose.py HOST OUT

A person with a keyboard makes one effect of three presets, with a modulator and a mix, and exports its stems. Each key and each typed word is an
action, and there may be MOST of them. sox and ffprobe must open the stems, and the layers must add up to the mix. Then a graph goes from one window
to another one through the clipboard of the display, as nodes and as a layer. A person must judge from the pictures in OUT whether this looks good.
"""
import json
import pathlib
import subprocess
import sys
import wave

import numpy

import walk
from walk import Walk

walk.PATIENCE = 180.0  # s: the files of many layers take a while to write
MOST = 25  # actions
PRESETS = pathlib.Path(__file__).resolve().parents[4] / "graphs"


class Keyboard:
    """A person without a mouse."""

    def __init__(self, w):
        self.walk, self.actions = w, 0

    def key(self, key):
        self.walk.key(key)
        self.actions += 1

    def word(self, text):
        self.walk.type(text)
        self.actions += 1

    def choose(self, opens, text):
        self.key(opens)
        self.wait("Palette")
        self.word(text)
        self.key("Return")
        self.walk.wait(lambda: not self.walk.has("Palette"), "an answer to " + text)

    def wait(self, name):
        self.walk.wait(lambda: self.walk.has(name), name)


def compose(w):
    w.start()
    w.wait(lambda: w.has("Dry wood"), "the welcome page with presets")
    w.to([w.at("Inspector")[0], w.at("Layers")[1]])  # the pointer lies somewhere else
    person = Keyboard(w)
    person.actions += 1

    def opened():   # a window that has just started may lose a key
        w.key("Return")
        return w.has("drag")

    w.wait(opened, "the graph of Dry wood")
    person.choose("space", "zip")
    person.wait("zip_fastener")
    person.choose("space", "squealing")
    person.wait("squealing_rubber")
    person.choose("space", "lfo")
    person.wait("lfo")
    person.choose("w", "roughness")
    w.shot("modulated")
    if not w.at("lfo")[0] < w.at("drag")[0]:
        raise SystemExit("the oscillator is at the right of what it feeds")
    person.choose("ctrl+k", "gain of zip")
    person.wait("Gain of Zip fastener in dB")
    person.word("x0.5")
    person.key("Return")
    w.shot("mixed")
    person.choose("ctrl+k", "export stems")
    w.wait(lambda: w.has("24 bit"), "the question about the stems")
    w.shot("stems")
    person.key("Return")
    person.wait("New Folder")  # of the dialog for the folder
    person.key("Return")
    folder = w.home / "Documents" / "Tactus" / "Dry wood stems"
    w.wait(lambda: (folder / "stems.json").exists(), "the stems")
    w.shot("exported")
    if person.actions > MOST:
        raise SystemExit(f"{person.actions} actions")
    print(f"  {person.actions} actions with the keyboard", flush=True)
    examine(folder)
    return w.kill()


def read(file):
    with wave.open(str(file)) as f:
        data = numpy.frombuffer(f.readframes(f.getnframes()), dtype=numpy.uint8).reshape(-1, f.getnchannels(), 3).astype(numpy.int32)
    return (data[..., 0] | data[..., 1] << 8 | data[..., 2] << 16) << 8 >> 8


def examine(folder):
    """Other programs open each file, and the layers add up to the mix, but for the noise of each file's dither."""
    said = json.loads((folder / "stems.json").read_text())
    for stem in said["files"]:
        file = str(folder / stem["file"])
        rate = subprocess.run(["soxi", "-r", file], check=True, capture_output=True, text=True).stdout.strip()
        probe = ["ffprobe", "-v", "error", "-show_entries", "stream=codec_name,sample_rate,channels", "-of", "csv=p=0", file]
        seen = subprocess.run(probe, check=True, capture_output=True, text=True).stdout.strip()
        if rate != "48000" or seen != f"pcm_s24le,48000,{len(stem['channels'])}":
            raise SystemExit(f"{file}: sox says {rate} Hz, ffprobe says {seen}")
    layers = [read(folder / s["file"]) for s in said["files"] if s["kind"] == "layer"]
    mix = read(folder / "mix.wav")
    apart = abs(sum(layers) - mix).max()
    if len(layers) != 5 or apart > 2 * (len(layers) + 1) or abs(mix).max() < 1000000:
        raise SystemExit(f"{len(layers)} layers add up to {apart} steps from the mix")
    print(f"  sox and ffprobe open {len(said['files'])} files; {len(layers)} layers add up to the mix within {apart} of 2^23 steps", flush=True)


class Window:
    """One of two windows on the display of a walk."""

    def __init__(self, w, preset):
        self.walk, self.file = w, w.home / f"{preset}.places.json"
        arguments = [w.host, "--places", str(self.file), str(PRESETS / f"{preset}.json")]
        self.program = subprocess.Popen(arguments, env=w.environment | {"TACTUS_HOME": str(w.home / f"{preset}.settings")})
        w.wait(lambda: self.file.exists() and self.has("motor"), preset)
        search = ["xdotool", "search", "--onlyvisible", "--pid", str(self.program.pid)]
        self.id = subprocess.run(search, env=w.environment, check=True, capture_output=True, text=True).stdout.split()[0]

    def places(self):
        try:
            return json.loads(self.file.read_text())
        except (OSError, ValueError):
            return {"window": {}}

    def has(self, name):
        return self.place(name) != [0, 0]

    def place(self, name):
        places = self.places()
        return places.get(name) or places["window"].get(name, [0, 0])

    def front(self):
        """Brings the window to the front, and clicks on a free place of its canvas."""
        self.walk.xdo("windowactivate", "--sync", self.id)
        nodes = [p for p in self.places().values() if isinstance(p, list)]
        self.walk.click([self.place("Canvas")[0], min(y for _, y in nodes) - 40])


def exchange(w):
    manager = subprocess.Popen(["openbox", "--sm-disable"], env=w.environment, stderr=subprocess.DEVNULL)
    root = ["xprop", "-root", "_NET_SUPPORTING_WM_CHECK"]
    w.wait(lambda: b"window id" in subprocess.run(root, env=w.environment, capture_output=True, check=False).stdout, "the window manager")
    one, other = Window(w, "velvet"), Window(w, "dry_wood")
    one.front()
    w.key("ctrl+a", "ctrl+c")
    w.shot("copied")
    other.front()
    w.key("ctrl+v")
    w.wait(lambda: other.has("hand_2"), "the pasted nodes")
    w.shot("pasted")
    w.key("ctrl+z")
    w.wait(lambda: not other.has("hand_2"), "what was there before")
    w.key("ctrl+shift+v")
    w.wait(lambda: other.has("velvet") and other.has("desk"), "the pasted layer")
    w.click(other.place("Layers"))
    w.wait(lambda: other.has("Gain of Velvet"), "its strip")
    w.shot("pasted-as-a-layer")
    for program in (one.program, other.program, manager):
        program.kill()
        program.wait()
    print("  a graph went from one window to the other one", flush=True)


def main():
    host, out = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    out.mkdir(parents=True, exist_ok=True)
    for name, act in (("composing", compose), ("exchanging", exchange)):
        print(name, flush=True)
        w = Walk(str(host), out, "1600x1000", "dark")
        try:
            act(w)
        except SystemExit:
            w.shot("failed")
            raise
        finally:
            w.end()


if __name__ == "__main__":
    main()
