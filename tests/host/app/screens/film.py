#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Films the first minute with the host, on a virtual display: ./test.sh --screens

film.py HOST OUT     writes OUT/first_minute.webm, .mp4 and .png, the poster

A mouse chooses a preset, strokes it, turns a knob while the tool presses, adds a node, and tries another preset. Needs Xvfb, xdotool and ffmpeg. It fails if a
step does not have the expected effect. A person must judge from the film whether it looks good, on a computer that does nothing else meanwhile.
"""
import pathlib
import signal
import subprocess
import sys
import time

from walk import Walk

FFMPEG = ["ffmpeg", "-loglevel", "error", "-y"]
SIZE, RATE_HZ = "1280x720", 20
MOST_BYTES = 1_500_000   # of the .webm, which the pages show
POSTER = "Stroke it with the mouse"   # the caption under which the poster is taken


class Filmed(Walk):
    """A walk that is filmed, with a caption for each part."""

    def __init__(self, host, out):
        super().__init__(host, out, SIZE, "dark")
        self.raw = self.home / "raw.mkv"
        self.captions = []
        self.camera = None

    def film(self):
        command = [*FFMPEG, "-f", "x11grab", "-draw_mouse", "1", "-framerate", str(RATE_HZ), "-video_size", SIZE, "-i", self.display,
                   "-c:v", "libx264", "-preset", "ultrafast", "-qp", "12", str(self.raw)]
        self.camera = subprocess.Popen(command, env=self.environment, stdin=subprocess.DEVNULL)
        self.wait(lambda: self.raw.exists() and self.raw.stat().st_size > 0, "the first picture of the film")
        self.begun = time.monotonic()

    def say(self, text):
        self.captions.append((time.monotonic() - self.begun, text))

    def cut(self):
        self.captions.append((time.monotonic() - self.begun, ""))
        self.camera.send_signal(signal.SIGINT)
        if self.camera.wait(timeout=60) not in (0, 255):
            raise SystemExit(f"ffmpeg ended with {self.camera.returncode}")

    def filters(self):
        parts = []
        for number, ((start, text), (end, _)) in enumerate(zip(self.captions, self.captions[1:])):
            file = self.home / f"caption{number}.txt"
            file.write_text(text, encoding="utf-8")
            parts.append(f"drawtext=textfile={file}:font=DejaVu Sans:fontsize=22:fontcolor=white:box=1:boxcolor=0x1f4e79@0.85:boxborderw=8"
                         f":x=(w-text_w)/2:y=h-56:enable='between(t,{start:.2f},{end:.2f})'")
        return ",".join(parts)

    def early(self):
        """How long the camera ran before the first caption, in s. Its last picture is that of the cut."""
        ask = ["ffprobe", "-v", "error", "-show_entries", "format=duration", "-of", "csv=p=0", str(self.raw)]
        told = subprocess.run(ask, check=True, capture_output=True, text=True)
        return max(0.0, float(told.stdout) - self.captions[-1][0])

    def develop(self):
        early = self.early()
        for name, options in (("webm", ["-c:v", "libvpx-vp9", "-crf", "44", "-b:v", "0", "-cpu-used", "4", "-row-mt", "1", "-g", "200"]),
                              ("mp4", ["-c:v", "libx264", "-crf", "30", "-preset", "slow", "-pix_fmt", "yuv420p", "-movflags", "+faststart"])):
            film = str(self.out / f"first_minute.{name}")
            subprocess.run([*FFMPEG, "-ss", f"{early:.2f}", "-i", str(self.raw), "-vf", self.filters(), "-an", *options, film], check=True)
        at = next(start for start, text in self.captions if text == POSTER) + 3.0
        subprocess.run([*FFMPEG, "-ss", f"{early + at:.2f}", "-i", str(self.raw), "-frames:v", "1", "-filter_complex",
                        "split[a][b];[a]palettegen=max_colors=128[p];[b][p]paletteuse=dither=none", str(self.out / "first_minute.png")], check=True)

    def stroke(self, times, reach=90):
        x, y = self.at("Surface")
        for _ in range(times):
            self.glide([x - reach, y], [x + reach, y], 24)
            self.glide([x + reach, y], [x - reach, y], 24)


def act(w):
    w.start()
    w.wait(lambda: w.has("Dry wood"), "the welcome page with presets")
    time.sleep(3.0)   # while the plots of the forces are drawn
    w.film()
    w.say("Choose a preset")
    time.sleep(2.0)
    w.click("Dry wood")
    w.wait(lambda: w.has("drag"), "the graph of Dry wood")
    time.sleep(1.0)

    w.say(POSTER)
    x, y = w.at("Surface")
    w.press([x - 90, y])
    w.stroke(3)
    w.glide([x - 90, y], [x + 20, y])

    w.say("Turn a knob while the tool presses")
    w.key("h")   # keeps it pressed
    w.release()
    knob = w.at("drag.d_max value")
    w.press(knob)
    w.glide(knob, [knob[0], knob[1] - 30], 30)
    w.glide([knob[0], knob[1] - 30], [knob[0], knob[1] + 10], 30)
    w.release()
    w.key("h")

    w.say("Pull a wire, and add what it should lead to")
    start = w.at("hand.position")
    w.press(start)
    w.glide(start, w.empty_place(), 24)
    w.release()
    w.wait(lambda: w.has("Palette"), "the palette")
    w.type("grating")
    time.sleep(1.0)
    w.key("Return")
    w.wait(lambda: "grating" in w.places(), "the node grating")
    time.sleep(1.5)
    w.key("ctrl+z", "Home")

    w.say("A loop without a delay is refused, and mended by a click")
    w.drag("drag.deflection", "board.position")
    w.wait(lambda: w.problems(), "a problem")
    w.click(w.problems())
    time.sleep(1.5)
    w.click("Delay wire by a tick")
    w.wait(lambda: not w.problems(), "no problems left")
    w.key("ctrl+z", "ctrl+z")

    w.say("Feel how it changed")
    w.click("Scopes")
    w.press([x - 90, y])
    w.stroke(2)
    w.release()
    time.sleep(0.5)
    w.cut()


def main():
    host, out = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    out.mkdir(parents=True, exist_ok=True)
    w = Filmed(str(host), out)
    try:
        act(w)
        w.develop()
    finally:
        if w.camera and w.camera.poll() is None:
            w.camera.kill()
        w.end()
    size = (out / "first_minute.webm").stat().st_size
    print(f"{out}/first_minute.webm: {w.captions[-1][0]:.0f} s, {size} bytes")
    if size > MOST_BYTES:
        raise SystemExit(f"more than {MOST_BYTES} bytes: the pages cannot show it")


if __name__ == "__main__":
    main()
