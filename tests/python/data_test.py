# SPDX-License-Identifier: MIT
"""Importers of recordings and models of others, with files of the same layout: those of the toolkits may not be passed on."""

import cmath
import contextlib
import io
import json
import math
import pathlib
import random
import tempfile
import unittest
import warnings

from support import PROGRAM, TestCase
from tactus import Graph, data


def stable(order, rng):
    """A random polynomial whose zeros are within the unit circle."""
    polynomial = [1.0]
    for _ in range(order):
        reflection, extended = rng.uniform(-0.7, 0.7), polynomial + [0.0]
        polynomial = [extended[k] + reflection * extended[len(polynomial) - k] for k in range(len(extended))]
    return polynomial


def frequencies_of(polynomial):
    """The line spectral frequencies, where the symmetric and the antisymmetric polynomial change their signs on the unit circle."""
    order, found = len(polynomial) - 1, []

    def value(angle, sign):
        at = sum(c * cmath.exp(-1j * angle * k) for k, c in enumerate(polynomial))
        whole = cmath.exp(0.5j * angle * (order + 1)) * (at + sign * cmath.exp(-1j * angle * (order + 1)) * at.conjugate())
        return whole.real if sign > 0 else whole.imag

    for sign in (1, -1):
        steps = 20000
        for i in range(1, steps - 1):
            low, high = math.pi * i / steps, math.pi * (i + 1) / steps
            if value(low, sign) * value(high, sign) >= 0.0:
                continue
            for _ in range(60):
                middle = 0.5 * (low + high)
                low, high = (low, middle) if value(low, sign) * value(middle, sign) <= 0.0 else (middle, high)
            found.append(low)
    return sorted(found)


def noise(polynomial, count, rng):
    """White noise of variance 1 through 1 / polynomial, from where it has settled."""
    out = []
    for _ in range(count + 200):
        out.append(rng.gauss(0.0, 1.0) - sum(c * out[-k] for k, c in enumerate(polynomial[1:], 1) if k <= len(out)))
    return out[200:]


def listed(tag, values):
    return f"<{tag}>" + "".join(f"<value>{v!r}</value>" for v in values) + f"</{tag}>"


def texture(models, friction=0.4, count=None):
    """A file of the layout of the toolkit: (speed in mm/s, force in N, variance, AR frequencies, MA frequencies, gain)."""
    text = f"<?xml version='1.0'?><modelSet><mu>{friction}</mu><numMod>{count or len(models)}</numMod><numTri>0</numTri>"
    text += "<maxSpeed>200</maxSpeed><maxForce>3</maxForce>" + listed("speedList", [m[0] for m in models]) + listed("forceList", [m[1] for m in models])
    for speed, force, variance, ar, ma, gain in models:
        text += "<model>" + listed("ARlsf", ar) + (listed("MAlsf", ma) + f"<gain>{gain}</gain>" if ma else "")
        text += f"<var>{variance}</var><speedMod>{speed}</speedMod><forceMod>{force}</forceMod></model>"
    return text + "</modelSet>"


class Data(TestCase):
    def imported(self, files, *options, kind="hatt"):
        """The presets by name, what was printed, and the status."""
        with tempfile.TemporaryDirectory() as folder:
            source, out = pathlib.Path(folder) / "in", pathlib.Path(folder) / "out"
            source.mkdir()
            for name, text in files.items():
                (source / name).parent.mkdir(parents=True, exist_ok=True)
                (source / name).write_bytes(text if isinstance(text, bytes) else text.encode())
            said = io.StringIO()
            with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
                status = data.main([kind, str(source), "-o", str(out), *options])
            presets = {p.name: p.read_text(encoding="utf-8") for p in out.glob("*.json")}
            return presets, said.getvalue(), status

    def test_frequencies_give_the_polynomial_they_came_from(self):
        for seed in range(12):
            rng = random.Random(seed)
            polynomial = stable(2 + seed, rng)
            made = data.polynomial_of(frequencies_of(polynomial))
            self.assertEqual(len(made), len(polynomial))
            for a, b in zip(made, polynomial):
                self.assertAlmostEqual(a, b, places=6)

    def test_a_texture_becomes_a_preset_that_compiles(self):
        rng = random.Random(1)
        ar = [stable(4, rng) for _ in range(3)]
        models = [(50.0 + 40 * i, 0.5 + i, 0.2, frequencies_of(a), [], 1.0) for i, a in enumerate(ar)]
        presets, said, status = self.imported({"Models_Wood 1.xml": texture(models)}, "--mass", "0.1")
        self.assertEqual(status, 0, said)
        self.assertIn("AR, as in the file", said)
        self.assertIn("does not allow passing on the toolkit", said)
        preset = json.loads(presets["wood_1.json"])
        models = preset["nodes"]["texture"]["settings"]["models"]
        self.assertEqual([m["speed"] for m in models], [0.05, 0.09, 0.13])
        self.assertAlmostEqual(models[0]["variance"], 0.2 * 0.01)
        for m, a in zip(models, ar):
            for got, wanted in zip(m["coefficients"], a[1:]):
                self.assertAlmostEqual(got, -wanted, places=6)
        self.assertIn("licence", preset["about"])
        force = Graph.parse(presets["wood_1.json"]).render(record=["texture.value"], duration=0.5)["texture.value"]
        self.assertTrue(any(v != 0.0 for v in force) and all(math.isfinite(v) for v in force))

    def test_an_arma_model_becomes_an_ar_model_with_its_error(self):
        rng = random.Random(2)
        ar, ma = stable(4, rng), stable(2, rng)
        presets, said, status = self.imported({"Models_Cork.xml": texture([(50.0, 1.0, 0.3, frequencies_of(ar), frequencies_of(ma), 2.0)])})
        self.assertEqual(status, 0, said)
        self.assertRegex(said, r"ARMA as AR of order 40, off by at most \S+ dB rms")
        model = json.loads(presets["cork.json"])["nodes"]["texture"]["settings"]["models"][0]
        for angle in (0.1, 0.7, 1.5, 2.5):   # the spectra are the same
            wanted = 0.3 * 4.0 * (data.magnitude(ma, angle) / data.magnitude(ar, angle))**2 * 0.05**2
            got = model["variance"] / data.magnitude([1.0] + [-c for c in model["coefficients"]], angle)**2
            self.assertAlmostEqual(got / wanted, 1.0, delta=0.02)

    def test_what_is_wrong_is_refused_with_its_place(self):
        good = [(50.0, 1.0, 0.3, [0.5, 1.5], [], 1.0)]
        for text, why in (("<modelSet", "it is not XML"), ("<a/>", "its root is <a>"), (texture([]), "it has no <model>"),
                          (texture(good, count=3), "<numMod> says 3"),
                          (texture([(50.0, 1.0, 0.3, [1.5, 0.5], [], 1.0)]), "model 1: line spectral frequencies must increase"),
                          (texture([(50.0, 1.0, -1.0, [0.5, 1.5], [], 1.0)]), "model 1: <var> must be above 0"),
                          (texture([(50.0, "x", 0.3, [0.5, 1.5], [], 1.0)]), "model 1: could not convert"),
                          (texture([(math.nan, 1.0, 0.3, [0.5, 1.5], [], 1.0)]), "<speedMod> is not finite")):
            presets, said, status = self.imported({"Models_Bad.xml": text, "Models_Good.xml": texture(good)})
            self.assertEqual(status, 1)
            self.assertIn(why, said)
            self.assertEqual(list(presets), ["good.json"])
        self.assertEqual(self.imported({})[2], 1)

    def models_in(self, preset):
        return json.loads(preset)["nodes"]["texture"]["settings"]["models"]

    def assert_spectrum(self, model, polynomial, variance, most_db):
        """The spectrum of a model is that of the process which made its recordings."""
        for angle in (0.3, 0.8, 1.4, 2.1, 2.8):
            wanted = variance / data.magnitude(polynomial, angle)**2
            got = model["variance"] / data.magnitude([1.0] + [-c for c in model["coefficients"]], angle)**2
            self.assertLess(abs(10.0 * math.log10(got / wanted)), most_db)

    def test_recordings_of_cluster_become_models_of_their_spectra(self):
        rng = random.Random(4)
        files, made = {}, {}
        for speed in (20, 60):
            for force in (500, 1000):
                polynomial = made[speed, force] = stable(3, rng)
                for direction in (0, 90):
                    axes = [noise(polynomial, 6000, rng) for _ in range(3)]
                    rows = [f"{(i + 0.2 * rng.uniform(-1, 1)) / 6000:.12f},{axes[0][i]:.6f},{axes[1][i]:.6f},{axes[2][i] - 0.98:.6f}" for i in range(6000)]
                    files[f"sensor_data/accel/7_{direction}_{speed}_{force}_0.csv"] = "time,X,Y,Z\n" + "\n".join(rows) + "\n"
        files["sensor_data/force/7_0_20_500_0.csv"] = "time,force\n0,1\n"   # not an acceleration
        presets, said, status = self.imported(files, "--mass", "0.1", kind="cluster")
        self.assertEqual(status, 0, said)
        self.assertEqual(list(presets), ["texture_7.json"])
        self.assertRegex(said, r"4 models of 8 recordings; the AR models of order 20 miss their autocorrelations by at most \S+ % of the variance")
        self.assertRegex(said, r"their rows were interpolated: read back, they differ by at most \S+ % \(rms\)")
        self.assertIn("read the licence", said)
        models = self.models_in(presets["texture_7.json"])
        self.assertEqual([(m["speed"], m["force"]) for m in models], [(0.02, 0.5), (0.02, 1.0), (0.06, 0.5), (0.06, 1.0)])
        for m in models:
            self.assertAlmostEqual(m["rate"], 6000.0, delta=1.0)
        Graph.parse(presets["texture_7.json"]).render(record=["texture.value"], duration=0.1)

    def test_even_recordings_of_cluster_keep_their_spectrum(self):
        rng = random.Random(5)
        polynomial = stable(3, rng)
        axes = [noise(polynomial, 20000, rng) for _ in range(3)]
        text = "time,X,Y,Z\n" + "\n".join(f"{i / 6000!r},{axes[0][i]!r},{axes[1][i]!r},{axes[2][i]!r}" for i in range(20000))
        presets, said, status = self.imported({"accel/1_0_20_500_0.csv": text}, "--mass", "0.1", kind="cluster")
        self.assertEqual(status, 0, said)
        self.assert_spectrum(self.models_in(presets["texture_1.json"])[0], polynomial, 3.0 * (0.1 * data.GRAVITY)**2, 2.0)

    def test_recordings_of_lmt_become_models_with_guesses_that_are_named(self):
        rng = random.Random(6)
        polynomial = stable(4, rng)
        files = {f"Testing/AccelScansDFT321/G6Carpet_{person}.txt": "\n".join(map(repr, noise(polynomial, 20000, rng))) for person in ("Andrea", "Matti")}
        files["Testing/FricScans/G6Carpet_Friction_Andrea.txt"] = "1\n2\n"
        files["Testing/AccelTappings/G6Carpet_Tapping1.txt"] = "1\n2\n"
        presets, said, status = self.imported(files, "--unit", "g", kind="lmt")
        self.assertEqual(status, 0, said)
        self.assertEqual(list(presets), ["g6carpet.json"])
        self.assertIn("1 models of 2 recordings", said)
        self.assertIn("are guesses, and the numbers are taken as g", said)
        model, = self.models_in(presets["g6carpet.json"])
        self.assertEqual(model["rate"], 1e4)
        self.assert_spectrum(model, polynomial, (0.05 * data.GRAVITY)**2, 2.0)

    def test_recordings_that_are_wrong_are_refused_with_their_place(self):
        rng = random.Random(7)
        good = "time,X,Y,Z\n" + "\n".join(f"{i / 6000},{rng.gauss(0, 1)},0.1,1" for i in range(1200))
        lines = good.split("\n")
        for text, why in ((good.replace("time,X", "t,X", 1), "its first row is not time,X,Y,Z"), ("\n".join(lines[:500]), "it has 499 samples"),
                          ("\n".join(lines[:700] + ["1,2"] + lines[700:]), "line 701 has 2 fields instead of 4"),
                          ("\n".join(lines[:700] + ["nan,1,1,1"] + lines[700:]), "a number is not finite"),
                          ("\n".join(lines[:700] + [lines[600]] + lines[700:]), "its times do not increase"),
                          ("\n".join(lines[:700] + ["x,1,1,1"] + lines[700:]), "could not convert")):
            presets, said, status = self.imported({"accel/1_0_20_500_0.csv": text, "accel/2_0_20_500_0.csv": good}, kind="cluster")
            self.assertEqual(status, 1)
            self.assertIn(why, said)
            self.assertIn("1_0_20_500_0.csv", said)
            self.assertEqual(list(presets), ["texture_2.json"])
        slow = "time,X,Y,Z\n" + "\n".join(f"{i / 5000},{rng.gauss(0, 1)},0.1,1" for i in range(1200))
        said = self.imported({"accel/1_0_20_500_0.csv": slow, "accel/1_45_20_500_0.csv": good}, kind="cluster")[1]
        self.assertIn("rates from 5000 to 6000 Hz", said)
        self.assertIn("there is no .txt in a folder Accel", self.imported({"a.txt": "1"}, kind="lmt")[1])
        self.assertIn("do not vary", self.imported({"Accel/A_query1.txt": "0\n" * 2000}, kind="lmt")[1])

    def test_no_link_in_the_folder_is_followed_and_no_name_reaches_the_terminal_as_a_command(self):
        with tempfile.TemporaryDirectory() as folder:
            inside, outside = pathlib.Path(folder) / "recordings", pathlib.Path(folder) / "planted"
            inside.mkdir()
            (inside / "Models_Wood.xml").write_text(texture([(50.0, 0.5, 0.2, [0.5, 1.0, 1.5, 2.0], [], 1.0)]), encoding="utf-8")
            (inside / "Models_\x1b]0;a\x07.xml").write_text("nothing", encoding="utf-8")
            (inside / "wood.json").symlink_to(outside)   # it leads nowhere yet
            said = io.StringIO()
            with contextlib.redirect_stdout(said):
                status = data.main(["hatt", str(inside), "-o", str(inside)])   # the presets next to the recordings
            self.assertEqual(status, 1)
            self.assertIn("wood.json exists", said.getvalue())
            self.assertFalse(outside.exists())
            self.assertIn(r"Models_\x1b]0;a\x07.xml: refused", said.getvalue())
            self.assertTrue(all(c.isprintable() or c == "\n" for c in said.getvalue()))

    def damaged(self, content, rng):
        """Bytes with a few mistakes: changed, cut off, left out, repeated, and numbers that no recording has."""
        for _ in range(rng.choice((1, 1, 2, 4))):
            at, kind = rng.randrange(len(content) + 1), rng.randrange(6)
            end = min(len(content), at + rng.randrange(80))
            if kind == 0:
                content = content[:at] + bytes([rng.randrange(256)]) + content[at + 1:]
            elif kind == 1:
                content = content[:at] if rng.randrange(4) == 0 else content[:at] + content[end:]
            elif kind == 2:
                content = content[:end] + content[at:]
            elif kind == 3:
                odd = (b"nan", b"1e308", b"-1e200", b"1e-320", b"inf", b"0", b"1e400", b"\0", b"\xff\xfe", b"<model>", b"</value>", b"&a;", b"\n\n", b",,")
                content = content[:at] + rng.choice(odd) + content[at:]
            elif digits := [n for n, c in enumerate(content) if 48 <= c < 58]:
                place = rng.choice(digits)
                content = content[:place] + rng.choice((b"-", b".", b"e", b"9", b"e150", b"99999", b"")) + content[place + 1:]
        return content

    def test_damaged_files_are_refused_with_a_sentence_or_become_presets_that_compile(self):
        rng = random.Random(63)
        axes = [[rng.gauss(0.0, 1.0) for _ in range(1100)] for _ in range(2)]
        moving = [(50.0, 1.0, 0.3, [0.5, 1.0, 1.5], [0.7, 1.4], 2.0)]
        plain = [(50.0 + 30.0 * i, 1.0 + i, 0.3, frequencies_of(stable(4, rng)), [], 1.0) for i in range(2)]
        for kind, name, content, count in (
                ("hatt", "Models_A.xml", texture(plain), 300), ("hatt", "Models_A.xml", texture(moving), 20),
                ("cluster", "accel/1_0_20_500_0.csv", "time,X,Y,Z\n" + "\n".join(f"{i / 6000:.9f},{axes[0][i]:.4f},{axes[1][i]:.3f},1" for i in range(1100)), 300),
                ("lmt", "Accel/A_query1.txt", "\n".join(f"{v:.4f}" for v in axes[0]), 300)):
            made = 0
            for _ in range(count):
                damaged = self.damaged(content.encode(), rng)
                presets, said, status = self.imported({name: damaged}, kind=kind)
                with self.subTest(kind=kind, said=said, content=damaged[:2000]):
                    self.assertEqual(status, 0 if presets else 1)
                    self.assertNotIn("Traceback", said)
                    for preset in presets.values():
                        made += 1
                        self.assertEqual(json.loads(preset, parse_constant=self.fail)["format"], "tactus-graph")
                        with warnings.catch_warnings():
                            warnings.simplefilter("ignore")   # the model may be loud
                            Graph.parse(preset).render(record=["texture.value"], duration=0.01)
            self.assertLess(made, count)


@unittest.skipUnless(PROGRAM, "the program is not built")
class Command(TestCase):
    """`tactus import-data`, which starts the package."""

    def setUp(self):
        super().setUp()
        made = tempfile.TemporaryDirectory()
        self.addCleanup(made.cleanup)
        self.folder = pathlib.Path(made.name)
        (self.folder / "Models_Wood.xml").write_text(texture([(50.0, 0.5, 0.2, [0.5, 1.0, 1.5, 2.0], [], 1.0)]), encoding="utf-8")

    def test_it_writes_presets_and_loads_no_module_from_the_folder_of_recordings(self):
        for name in ("tactus.py", "argparse.py", "json.py"):
            (self.folder / name).write_text("open('planted', 'w')\n", encoding="utf-8")
        self.assertIn("wood.json: 1 models", self.ran("import-data", "hatt", ".", "-o", "out"))
        self.assertTrue((self.folder / "out/wood.json").exists())
        self.assertFalse((self.folder / "planted").exists())

    def test_without_the_package_a_sentence_names_it(self):
        packages = self.folder / "packages"
        packages.mkdir()
        (packages / "tactus.py").write_text("raise ImportError\n", encoding="utf-8")
        said = self.ran("import-data", "hatt", ".", "-o", "out", status=2, PYTHONPATH=str(packages))
        self.assertTrue(said.startswith("error: the Python package tactus is not installed"), said)
        self.assertFalse((self.folder / "out").exists())


if __name__ == "__main__":
    unittest.main()
