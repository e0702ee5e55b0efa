#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""`tactus render --stems`, read by Python's own reader of WAV files: stems_test.py TACTUS GRAPHS"""

import csv
import io
import json
import math
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest
import wave

TACTUS, GRAPHS = sys.argv[1], pathlib.Path(sys.argv[2])

# A layer that is turned down and ducked, one that is muted, and one that reaches the ceiling with the first; a force that is not mixed.
MIXED = {
    "format": "tactus-graph", "version": 2, "name": "Mixed", "rate_hz": 4000, "devices": {"tip": {"driver": "sim"}},
    "nodes": {
        "low": {"type": "signal.lfo", "params": {"frequency": "5 Hz", "amplitude": 2}},
        "high": {"type": "signal.lfo", "params": {"frequency": "100 Hz", "amplitude": 1}},
        "off": {"type": "signal.lfo", "params": {"frequency": "30 Hz", "amplitude": 3}},
        "side": {"type": "signal.lfo", "params": {"frequency": "20 Hz", "amplitude": 0.5}},
        "desk": {"type": "layer.mix", "settings": {"inputs": 3, "names": "Low tone, High tone, Off"},
                 "params": {"gain": [0.5, 1, 1], "mute": [0, 0, 1], "priority": [0, 1, 0], "ceiling": 0.9}},
        "motor": {"type": "device.force", "role": "tip"}},
    "wires": ["low.out -> desk.in[0]", "high.out -> desk.in[1]", "off.out -> desk.in[2]", "desk.out -> motor.force.z", "side.out -> motor.force.x"]}


def run(*arguments, status=0):
    done = subprocess.run([TACTUS, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == status, f"{arguments}: {done.returncode}\n{done.stdout}{done.stderr}"
    return done


def integers(path):
    """The samples of each channel, and the rate, as Python's wave module reads them."""
    with wave.open(str(path)) as file:
        width, channels, frames = file.getsampwidth(), file.getnchannels(), file.getnframes()
        data = file.readframes(frames)
    assert len(data) == width * channels * frames
    values = [int.from_bytes(data[i:i + width], "little", signed=True) for i in range(0, len(data), width)]
    return [values[c::channels] for c in range(channels)], file.getframerate(), width


def floats(path):
    """The same of a file with floats, which the module does not read."""
    data = path.read_bytes()
    assert data[:4] == b"RIFF" and struct.unpack("<I", data[4:8])[0] == len(data) - 8
    at, form = 12, None
    while at < len(data):
        name, size = data[at:at + 4], struct.unpack("<I", data[at + 4:at + 8])[0]
        if name == b"fmt ":
            form = struct.unpack("<HHIIHH", data[at + 8:at + 24])
        if name == b"data":
            values = struct.unpack(f"<{size // 4}f", data[at + 8:at + 8 + size])
        at += 8 + size + size % 2
    assert form[0] == 3 and form[5] == 32
    return [list(values[c::form[1]]) for c in range(form[1])], form[2]


def amplitude(samples, hertz, rate):
    """Of a tone, over the middle half of the samples."""
    part = samples[len(samples) // 4:len(samples) * 3 // 4]
    turn = [2 * math.pi * hertz * k / rate for k in range(len(part))]
    return 2 * math.hypot(sum(s * math.cos(t) for s, t in zip(part, turn)), sum(s * math.sin(t) for s, t in zip(part, turn))) / len(part)


def vibrating(samples, rate):
    """Through a second-order Butterworth high-pass at 8 Hz, from rest at the first sample."""
    w = 2 * math.pi * 8 / rate
    c, alpha = math.cos(w), math.sin(w) / (2 * 0.7071)
    before, made = [0.0, 0.0], [0.0, 0.0]
    for v in (s - samples[0] for s in samples):
        out = (0.5 * (1 + c) * (v - 2 * before[-1] + before[-2]) + 2 * c * made[-1] - (1 - alpha) * made[-2]) / (1 + alpha)
        before.append(v)
        made.append(out)
    return made[2:]


class Stems(unittest.TestCase):
    def setUp(self):
        self.home = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.home.name)
        self.graph = self.folder / "mixed.json"
        self.graph.write_text(json.dumps(MIXED))
        self.out = self.folder / "out"

    def tearDown(self):
        self.home.cleanup()

    def render(self, *options, graph=None, status=0):
        self.done = run("render", graph or self.graph, "--stems", self.out, "--duration", "1", *options, status=status)
        return json.loads((self.out / "stems.json").read_text()) if status == 0 else None

    def test_floats_are_the_values_of_the_run(self):
        said = self.render()
        self.assertEqual([f["file"] for f in said["files"]], ["mix.wav", "mix_x.wav", "mix_y.wav", "mix_z.wav", "layer_1_low_tone.wav",
                                                             "layer_2_high_tone.wav", "layer_3_off.wav", "not_mixed_side_out.wav"])
        rows = list(csv.DictReader(io.StringIO(run("render", self.graph, "--duration", "1", "--record", "motor.force,low.out,desk.out,side.out").stdout)))
        mix, rate = floats(self.out / "mix.wav")
        self.assertEqual((rate, len(mix), len(mix[0])), (4000, 3, 4000))
        one = lambda name: floats(self.out / name)[0][0]
        low, high, off, side = map(one, ["layer_1_low_tone.wav", "layer_2_high_tone.wav", "layer_3_off.wav", "not_mixed_side_out.wav"])
        self.assertEqual(one("mix_z.wav"), mix[2])
        for k, row in enumerate(rows):
            for c, axis in enumerate("xyz"):
                self.assertEqual(mix[c][k], struct.unpack("f", struct.pack("f", float(row["motor.force." + axis])))[0])
            self.assertAlmostEqual(low[k] + high[k] + off[k], float(row["desk.out"]), delta=1e-6)
            self.assertAlmostEqual(side[k], float(row["side.out"]), delta=1e-6)
        self.assertEqual(max(map(abs, off)), 0.0)
        self.assertGreater(max(map(abs, high)), 0.8)
        loud = max(abs(a / float(r["low.out"])) for a, r in zip(low[2000:], rows[2000:]) if abs(float(r["low.out"])) > 1)
        self.assertLess(loud, 0.5 * 10 ** (-11 / 20))   # turned down by half, and ducked by 12 dB
        for s in said["sums"]:
            self.assertLess(s["largest_difference"], 1e-12)
            self.assertAlmostEqual(s["peak"], 0.9)
        self.assertIn("the layers of desk add up to its mix within", self.done.stdout)

    def test_integers_at_any_rate_add_up_to_the_mix(self):
        for name, width in (("pcm16", 2), ("pcm24", 3)):
            said = self.render("--stem-format", name, "--stem-rate", "44100")
            parts = {}
            for f in said["files"]:
                channels, rate, bytes_each = integers(self.out / f["file"])
                self.assertEqual((rate, bytes_each, len(channels), len(channels[0])), (44100, width, len(f["channels"]), 44100))
                parts[f["file"]] = [[v * f["full_scale"] / (2 ** (8 * width - 1) - 1) for v in c] for c in channels]
            step = 2 * said["files"][0]["full_scale"] / 2 ** (8 * width)
            peak = max(abs(v) for p in parts.values() for c in p for v in c)
            self.assertAlmostEqual(peak / said["files"][0]["full_scale"], 10 ** (-1 / 20), delta=1e-3)
            mix, layers = parts["mix.wav"], [parts[f["file"]][0] for f in said["files"] if f["kind"] == "layer"]
            worst = max(abs(sum(values) - m) for m, *values in zip(mix[2], *layers))
            self.assertLess(worst, 8 * step + 1e-6)
            self.assertLess(max(abs(a - b) for a, b in zip(mix[0], parts["not_mixed_side_out.wav"][0])), 4 * step + 1e-6)
            self.assertAlmostEqual(amplitude(parts["not_mixed_side_out.wav"][0], 20, 44100), 0.5, delta=2e-3)

    def test_clips_have_the_envelopes_of_the_layers(self):
        formats = ("haptic", "ahap", "hjif")
        said = self.render("--stem-clips", ",".join(formats))
        clips = [f for f in said["files"] if f["kind"] == "clip"]
        parts = [f for f in said["files"] if f["kind"] in ("layer", "not_mixed")]
        self.assertEqual([f["file"] for f in clips], [p["file"][:-3] + name for p in parts for name in formats])
        heard = {p["file"]: vibrating(floats(self.out / p["file"])[0][0], 4000) for p in parts}
        scales = {f["full_scale"] for f in clips}
        loudest = scales.pop()
        self.assertFalse(scales)
        self.assertAlmostEqual(loudest, max(max(map(abs, h)) for h in heard.values()), delta=1e-6 * loudest)
        self.assertIn("the wave becomes its envelope, in steps of 10 ms", self.done.stdout)
        self.assertIn("a force that is held", self.done.stdout)   # of the tone of 5 Hz
        for part in parts:
            samples = heard[part["file"]]
            name = part["file"][:-4]
            said_points = json.loads((self.out / (name + ".haptic")).read_text())["signals"]["continuous"]["envelopes"]["amplitude"]
            for p in said_points[1:-1]:   # in the middle of each 10 ms
                first, end = round((p["time"] - 0.005) * 4000), round((p["time"] + 0.005) * 4000)   # a sample at an edge may be in either window
                least, most = (max(map(abs, samples[max(first + by, 0):end - by])) for by in (1, -1))
                self.assertGreaterEqual(p["amplitude"] * loudest, least - 1e-5 * loudest)
                self.assertLessEqual(p["amplitude"] * loudest, most + 1e-5 * loudest)
            self.assertGreater(len(said_points), 90 if part["peak"] > 0 else 0)
            curves = json.loads((self.out / (name + ".hjif")).read_text())["perceptions"][0]["channels"][0]["bands"][0]
            frames = curves["effects"][0]["keyframes"]
            self.assertLess(max(abs(k["amplitude_modulation"] * loudest - v) for k, v in zip(frames, samples)), 1e-6)
            events = [e["Event"] for e in json.loads((self.out / (name + ".ahap")).read_text())["Pattern"] if "Event" in e]
            self.assertTrue(all(e["EventType"] == "HapticContinuous" for e in events), events[:2])
        for f in clips:   # other commands read them
            run("convert", self.out / f["file"], self.folder / "back.json")

        vectors = self.render("--stem-clips", "haptic", "--stem-scale", "each", graph=GRAPHS / "bronze_bell.json")
        wall = next(f for f in vectors["files"] if f["file"] == "not_mixed_wall_force.haptic")
        self.assertEqual((wall["channels"], wall["full_scale"]), (["along 0 0 1"], wall["peak"]))
        self.assertIn("a force that is held is left out", self.done.stdout)
        self.assertEqual(sorted(f["file"] for f in vectors["files"] if f["kind"] == "clip"), sorted(p.name for p in self.out.glob("*.haptic")))
        self.assertIn("one of haptic, ahap, hjif", run("render", self.graph, "--stems", self.out, "--stem-clips", "wav", status=2).stderr)

    def test_a_force_that_is_held_is_no_vibration_of_a_clip(self):
        held = json.loads(json.dumps(MIXED))
        held["nodes"]["low"] = {"type": "signal.constant", "params": {"value": 3}}
        held["nodes"]["desk"]["params"] = {"mute": [0, 0, 1]}
        self.graph.write_text(json.dumps(held))
        said = self.render("--stem-clips", "hjif", "--stem-scale", "each")
        self.assertIn("a force that is held is left out", self.done.stdout)
        clips = {f["file"].split(".")[0]: f for f in said["files"] if f["kind"] == "clip"}
        self.assertLess(clips["layer_1_low_tone"]["peak"], 1e-6)
        for name, hertz, right in (("layer_2_high_tone", 100, 1.0), ("not_mixed_side_out", 20, 0.5)):
            frames = json.loads((self.out / clips[name]["file"]).read_text())["perceptions"][0]["channels"][0]["bands"][0]["effects"][0]["keyframes"]
            played = amplitude([k["amplitude_modulation"] * clips[name]["full_scale"] for k in frames], hertz, 4000)
            self.assertAlmostEqual(played, right, delta=0.02 * right)
        held["nodes"]["low"] = {"type": "signal.lfo", "params": {"frequency": "200 Hz"}}
        self.graph.write_text(json.dumps(held))
        self.render("--stem-clips", "hjif")
        self.assertNotIn("a force that is held", self.done.stdout)   # tones of 200, 100 and 20 Hz

    def test_a_clip_is_silent_before_the_first_touch(self):
        step = json.loads(json.dumps(MIXED))
        step["nodes"] = {"turn": {"type": "signal.lfo", "params": {"frequency": "1 Hz", "amplitude": 1, "shape": "square"}},
                         "desk": {"type": "layer.mix", "settings": {"inputs": 1}}, "motor": step["nodes"]["motor"]}
        step["wires"] = ["turn.out -> desk.in[0]", "desk.out -> motor.force.z"]
        self.graph.write_text(json.dumps(step))
        self.render("--stem-clips", "hjif")
        frames = json.loads(next(self.out.glob("layer_*.hjif")).read_text())["perceptions"][0]["channels"][0]["bands"][0]["effects"][0]["keyframes"]
        values = [k["amplitude_modulation"] for k in frames]
        first = next(k for k, v in enumerate(values) if v)
        self.assertGreater(first, 1000)   # half a second before the first edge, and nothing rises before it
        self.assertGreater(abs(values[first]), 0.9 * max(map(abs, values)))

    def test_nodes_between_what_is_not_mixed_and_the_motor_are_named(self):
        graph = json.loads(json.dumps(MIXED))
        graph["nodes"]["soft"] = {"type": "signal.gain", "params": {"gain": 0.5}}
        graph["wires"][3:] = ["desk.out -> soft.in", "side.out -> soft.in", "soft.out -> motor.force.z"]
        self.graph.write_text(json.dumps(graph))
        said = self.render()
        self.assertEqual([f.get("not_applied") for f in said["files"] if f["kind"] == "not_mixed"], [["soft"]])
        self.assertIn("not_mixed_side_out.wav is the signal of side.out, without soft, through which it reaches the motor", self.done.stdout)
        self.assertAlmostEqual(max(floats(self.out / "not_mixed_side_out.wav")[0][0]), 0.5, delta=1e-3)
        graph["wires"][-2:] = ["desk.out -> motor.force.z", "side.out -> motor.force.z"]
        self.graph.write_text(json.dumps(graph))
        self.assertNotIn("not_applied", json.dumps(self.render()))
        self.assertNotIn("through which", self.done.stdout)

    def test_dither_is_noise_of_one_step_and_spares_silence(self):
        said = self.render("--stem-format", "pcm16", "--stem-scale", "1000 N")
        quiet = integers(self.out / "not_mixed_side_out.wav")[0][0]
        self.assertEqual(set(integers(self.out / "layer_3_off.wav")[0][0]), {0})
        exact = [0.5 * math.sin(2 * math.pi * 20 * k / 4000) * 32767 / 1000 for k in range(4000)]
        errors = [q - e for q, e in zip(quiet, exact)]
        self.assertLess(max(map(abs, errors)), 1.6)
        self.assertAlmostEqual(sum(e * e for e in errors) / len(errors), 3 / 12, delta=0.05)   # a triangle of two steps, and the rounding
        first = (self.out / "mix.wav").read_bytes()
        self.render("--stem-format", "pcm16", "--stem-scale", "1000 N")
        self.assertEqual(first, (self.out / "mix.wav").read_bytes())
        self.render("--stem-format", "pcm16", "--stem-scale", "1000 N", "--no-dither")
        plain = integers(self.out / "not_mixed_side_out.wav")[0][0]
        self.assertLess(max(abs(p - e) for p, e in zip(plain, exact)), 0.6)
        self.assertEqual(said["files"][0]["full_scale"], 1000)

    def test_scales(self):
        said = self.render("--stem-format", "pcm24", "--stem-scale", "each")
        for f in said["files"]:
            if f["peak"] > 0:
                self.assertAlmostEqual(max(abs(v) for c in integers(self.out / f["file"])[0] for v in c) / 8388607, 10 ** (-1 / 20), delta=1e-5)
        said = self.render("--stem-format", "pcm16", "--stem-scale", "0.25 N")
        clipped = {f["file"]: f["clipped"] for f in said["files"]}
        self.assertGreater(clipped["mix.wav"], 100)
        self.assertIn("samples are beyond full scale", self.done.stderr)

    def test_a_loop_has_no_click(self):
        for rate in ("4000", "48000"):
            said = self.render("--stem-loop", "50 ms", "--stem-rate", rate)
            for f in said["files"]:
                for c in floats(self.out / f["file"])[0]:
                    self.assertEqual(len(c), said["frames"])
                    inside = max(abs(b - a) for a, b in zip(c, c[1:]))
                    self.assertLessEqual(abs(c[0] - c[-1]), 1.05 * inside + 1e-9, f["file"])
            self.assertEqual(said["frames"], int(rate) * 95 // 100)
        self.render("--stem-loop", "800 ms", status=1)
        self.assertIn("stems/loop", self.done.stderr)

    def test_mono(self):
        self.render("--stem-mono", graph=GRAPHS / "bronze_bell.json")
        for file in self.out.glob("*.wav"):
            self.assertEqual(len(floats(file)[0]), 1, file)

    def test_mono_files_of_vectors_add_up_unless_there_is_a_torque_too(self):
        def tone(frequency):
            return {"type": "signal.lfo", "params": {"frequency": f"{frequency} Hz"}}
        graph = {
            "format": "tactus-graph", "version": 2, "name": "Vectors", "rate_hz": 4000, "devices": {"tip": {"driver": "sim"}},
            "nodes": {"a": tone(5), "b": tone(30), "c": tone(80), "ab": {"type": "vector.join"}, "bc": {"type": "vector.join"},
                      "desk": {"type": "layer.mix_vectors", "settings": {"inputs": 2}}, "motor": {"type": "device.force", "role": "tip"}},
            "wires": ["a.out -> ab.x", "b.out -> ab.y", "b.out -> bc.y", "c.out -> bc.z", "ab.out -> desk.in[0]", "bc.out -> desk.in[1]",
                      "desk.out -> motor.force"]}
        file = self.folder / "vectors.json"
        file.write_text(json.dumps(graph))
        said = self.render("--stem-mono", graph=file)
        mix, *layers = [floats(self.out / f["file"])[0] for kind in ("mix", "layer") for f in said["files"] if f["kind"] == kind]
        self.assertEqual(([len(c) for c in (mix, *layers)], len(layers)), ([1, 1, 1], 2))
        self.assertLess(max(abs(m - sum(v)) for m, *v in zip(mix[0], *(c[0] for c in layers))), 1e-6)
        self.assertGreater(max(mix[0]), 0.5)

        graph["wires"].append({"wire": "bc.out -> motor.torque", "gain": "0.1 m"})
        file.write_text(json.dumps(graph))
        said = self.render("--stem-mono", graph=file)
        widths = {f["kind"]: len(f["channels"]) for f in said["files"]}
        self.assertEqual((widths["mix"], widths["layer"]), (6, 3))

    def test_the_presets_with_a_mixer(self):
        said = self.render("--stem-format", "pcm24", "--stem-rate", "48000", graph=GRAPHS / "bronze_bell.json")
        kinds = [f["kind"] for f in said["files"]]
        self.assertEqual((kinds.count("mix"), kinds.count("axis"), kinds.count("layer"), kinds.count("not_mixed")), (1, 3, 3, 1))
        scale = said["files"][0]["full_scale"] / 8388607
        z = [v * scale for v in integers(self.out / "mix_z.wav")[0][0]]
        parts = [integers(self.out / f["file"])[0][-1] for f in said["files"] if f["kind"] in ("layer", "not_mixed")]
        self.assertLess(max(abs(m - scale * sum(v)) for m, *v in zip(z, *parts)), 20 * scale + 1e-6)

    def test_a_folder_of_graphs(self):
        folder = self.folder / "graphs"
        folder.mkdir()
        for name in ("one", "two"):
            (folder / (name + ".json")).write_text(json.dumps(MIXED))
        (folder / "broken.json").write_text("{")
        done = run("render", folder, "--stems", self.out, "--duration", "0.1", status=1)
        self.assertIn("2 of 3 graphs were rendered", done.stdout)
        self.assertEqual(sorted(p.name for p in self.out.iterdir()), ["one", "two"])

    def test_what_is_in_a_folder_stays(self):
        self.out.mkdir()
        (self.out / "mine.txt").write_text("mine")
        self.render(status=1)
        self.assertEqual([p.name for p in self.out.iterdir()], ["mine.txt"])
        (self.out / "mine.txt").unlink()
        self.render()
        (self.out / "mine.txt").write_text("mine")
        self.render("--stem-format", "pcm16")
        self.assertEqual((self.out / "mine.txt").read_text(), "mine")
        self.render("--out", "a.csv", status=2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
