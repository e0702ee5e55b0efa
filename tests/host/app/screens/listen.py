#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Strokes a board in the host with the mouse, slowly and fast, and records the sound: ./test.sh --sound

listen.py HOST OUT   writes slow.wav and fast.wav, as a sound card would have played them

The host runs on its own display, and plays through a JACK server without hardware. A texture is a pattern in space, so the
pitch must rise in proportion to the speed of the stroke.
"""
import pathlib
import sys
import time
import wave

import numpy

from walk import Walk

sys.path.append(str(pathlib.Path(__file__).resolve().parents[3] / "audio"))
from sound_server import Server  # noqa: E402

RATE = 48000
SLOW, FAST = 100.0, 300.0  # pixels per second
STROKES, REACH = 4, 150.0  # strokes back and forth, and their length in pixels
LOWEST, HIGHEST = 20.0, 1000.0  # Hz
TOLERANCE = 0.2  # allowed relative error of the ratio of the pitches, which should equal the ratio of the speeds


def stroke(walk, speed):
    """Strokes back and forth at a constant speed with the button down, as one command so that nothing interrupts it."""
    x, y = walk.at("Surface")
    step = 0.008  # s
    steps = round(REACH / speed / step)
    words = ["mousemove", round(x - REACH / 2), y, "mousedown", 1]
    for k in range(STROKES):
        for i in range(1, steps + 1):
            part = i / steps if k % 2 == 0 else 1 - i / steps
            words += ["mousemove", round(x + (part - 0.5) * REACH), y, "sleep", step]
    started = time.monotonic()
    walk.xdo(*words, "mouseup", 1)
    return STROKES * REACH / (time.monotonic() - started)


def heard(file):
    """The frequency in Hz below which half of the sound's power lies, and the RMS level (full scale 1)."""
    with wave.open(str(file)) as w:
        samples = numpy.frombuffer(w.readframes(w.getnframes()), dtype=numpy.int16)[:: w.getnchannels()] / 32768.0
    spectrum = numpy.abs(numpy.fft.rfft(samples * numpy.hanning(len(samples)))) ** 2
    hz = numpy.fft.rfftfreq(len(samples), 1 / RATE)
    inside = (hz >= LOWEST) & (hz <= HIGHEST)
    so_far = numpy.cumsum(spectrum[inside])
    return float(hz[inside][numpy.searchsorted(so_far, so_far[-1] / 2)]), float(numpy.sqrt((samples**2).mean()))


def main():
    host, out = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    out.mkdir(parents=True, exist_ok=True)
    server = Server(RATE, 256, 2)
    walk = Walk(str(host), out, "1280x720", "dark")
    walk.environment.update(server.environment | {"DISPLAY": walk.display, "HOME": walk.environment["HOME"]})
    try:
        walk.start("--osc", "off", "graphs/canvas_weave.json")
        walk.wait(lambda: walk.has("Sound"), "the sound button")
        walk.click("Sound")
        found = {}
        for name, speed in (("slow", SLOW), ("fast", FAST)):
            file = out / f"{name}.wav"
            file.unlink(missing_ok=True)
            capture = server.capture(file, STROKES * REACH / speed, [1], bits=16)
            time.sleep(0.3)
            real_speed = stroke(walk, speed)
            capture.wait()
            found[name] = (real_speed, *heard(file))
            print(f"  {name}: at {real_speed:.0f} pixels per second: {found[name][1]:.1f} Hz, loudness {found[name][2]:.4f}", flush=True)
        walk.shot("sound")
    finally:
        walk.end()
        server.end()
    ratio = (found["fast"][1] / found["slow"][1]) / (found["fast"][0] / found["slow"][0])
    print(f"  ratio of the pitch change to the speed change: {ratio:.2f}")
    if min(loud for _, _, loud in found.values()) < 1e-3:
        raise SystemExit("the recording is silent")
    if abs(ratio - 1.0) > TOLERANCE:
        raise SystemExit("the pitch does not follow the speed")


if __name__ == "__main__":
    main()
