# SPDX-License-Identifier: MIT
"""The wheel, from the objects of this build: installed into a virtual environment, it works without the source tree and the build folder."""

import base64
import csv
import hashlib
import io
import os
import pathlib
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import unittest
import zipfile

from support import ROOT

BUILD = os.environ.get("TACTUS_BUILD", "")
PROJECT = str(ROOT / "framework" / "python")
SUFFIX = sysconfig.get_config_var("EXT_SUFFIX")


def run(*command, **options):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False, **options)
    if done.returncode != 0:
        raise AssertionError(f"{command}: {done.stdout}\n{done.stderr}")
    return done.stdout


@unittest.skipUnless(BUILD, "there is no build folder")
class Wheel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.work = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.work.name)
        run(sys.executable, "-m", "build", "--no-isolation", "--wheel", f"-Cbuild-dir={BUILD}", "--outdir", cls.folder, PROJECT, cwd=cls.folder)
        cls.wheel = next(cls.folder.glob("*.whl"))
        cls.archive = zipfile.ZipFile(cls.wheel)
        cls.names = cls.archive.namelist()
        cls.info = next(name for name in cls.names if name.endswith(".dist-info/METADATA")).rsplit("/", 1)[0]
        cls.site = cls.install()

    @classmethod
    def tearDownClass(cls):
        cls.archive.close()
        cls.work.cleanup()

    @classmethod
    def install(cls):
        """A virtual environment with the wheel, and how to run its Python: away from the source tree, and without the variables that this test has."""
        run(sys.executable, "-m", "venv", "--system-site-packages", "--without-pip", cls.folder / "venv")
        cls.python = cls.folder / "venv" / "bin" / "python3"
        run(sys.executable, "-m", "pip", "--python", cls.python, "install", "--no-index", "--no-cache-dir", cls.wheel, env=cls.environment())
        return pathlib.Path(cls.inside("import tactus; print(tactus.__file__)").strip()).parent

    @classmethod
    def environment(cls):
        return {"PATH": "/usr/bin:/bin", "HOME": str(cls.folder), "PYTHONDONTWRITEBYTECODE": "1"}

    @classmethod
    def inside(cls, code):
        return run(cls.python, "-c", code, cwd=cls.folder, env=cls.environment())

    def test_it_is_for_this_interpreter_and_platform(self):
        python = f"cp{sys.version_info.major}{sys.version_info.minor}"
        platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
        self.assertRegex(self.wheel.name, f"^tactus-[0-9.]+-{python}-{python}-{platform}.whl$")
        self.assertIn(f"Tag: {python}-{python}-{platform}\n", self.archive.read(f"{self.info}/WHEEL").decode())

    def test_it_has_what_it_needs_and_names_no_folder_of_this_computer(self):
        for name in (f"tactus/_tactus{SUFFIX}", "tactus/_tactus.pyi", "tactus/py.typed", "tactus/libtactus_live.so.0", "tactus/force-guardian",
                     "tactus/graphs/dry_wood.json", "tactus/graphs/assets/leather.png", "tactus/profiles/tactus_board.json",
                     f"{self.info}/licenses/LICENSES/MIT.txt", f"{self.info}/licenses/framework/python/licences_of_others.txt"):
            self.assertIn(name, self.names)
        self.assertEqual({name.split("/")[0] for name in self.names}, {"tactus", self.info})
        self.assertTrue(self.archive.getinfo("tactus/force-guardian").external_attr >> 16 & 0o100, "the guardian cannot be started")
        for name in self.names:
            data = self.archive.read(name)
            for folder in (str(ROOT), str(pathlib.Path(BUILD).resolve()), str(pathlib.Path.home()) + "/"):
                self.assertNotIn(folder.encode(), data, name)

    def test_every_file_has_its_hash_in_the_record(self):
        rows = {row[0]: row[1:] for row in csv.reader(io.StringIO(self.archive.read(f"{self.info}/RECORD").decode()))}
        self.assertEqual(set(rows), set(self.names))
        for name in set(self.names) - {f"{self.info}/RECORD"}:
            data = self.archive.read(name)
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            self.assertEqual(rows[name], [f"sha256={digest}", str(len(data))], name)

    def test_pip_makes_the_same_bytes(self):
        run(sys.executable, "-m", "pip", "wheel", "--no-index", "--no-deps", "--no-build-isolation", "--no-cache-dir", "-w", self.folder / "pip", PROJECT,
            env={**os.environ, "TACTUS_BUILD": BUILD})
        self.assertEqual((self.folder / "pip" / self.wheel.name).read_bytes(), self.wheel.read_bytes())

    def test_an_installed_wheel_renders_and_plays_the_presets(self):
        self.assertTrue(str(self.site).startswith(str(self.folder / "venv")), self.site)
        out = self.inside("""
import tactus, numpy
by_name = tactus.Graph("dry_wood").render(duration=0.5)["motor.force"]
pictures = {"assets/leather.png": numpy.full((64, 64), 128, numpy.uint8)}
for name in tactus.presets():
    tactus.Graph(name).render(duration=0.01, assets=pictures)
with tactus.play("dry_wood", {"stylus": "gesture:circle"}, session="off", duration=1.0, record=["motor.force"]) as session:
    session.wait(60)
    played = session.collect()["motor.force"]
try:
    tactus.play("dry_wood", {"stylus": "hid:no_such_profile"}, session="off")
except tactus.Error as why:
    knows = "tactus_board" in why.text + why.remedy
print(len(tactus.presets()), numpy.abs(by_name).max() > 0, numpy.abs(played).max() > 0, knows)
""")
        self.assertEqual(out.split(), [str(len(list((ROOT / "graphs").glob("*.json")))), "True", "True", "True"])

    def test_types_are_found_by_type_checkers(self):
        self.assertTrue((self.site / "py.typed").exists())

    def test_numpy_is_required(self):
        self.assertIn("Requires-Dist: numpy", self.archive.read(f"{self.info}/METADATA").decode())
        run(sys.executable, "-m", "venv", "--without-pip", self.folder / "bare")
        done = subprocess.run([sys.executable, "-m", "pip", "--python", self.folder / "bare/bin/python3", "install", "--no-index", "--no-cache-dir", self.wheel],
                              capture_output=True, text=True, env={"PATH": "/usr/bin:/bin", "PIP_CONFIG_FILE": "/dev/null"}, check=False)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("numpy", done.stderr)

    def test_a_build_folder_that_is_none_is_refused(self):
        done = subprocess.run([sys.executable, "-m", "build", "--no-isolation", "--wheel", f"-Cbuild-dir={self.folder}", "--outdir", self.folder, PROJECT],
                              capture_output=True, text=True, cwd=self.folder, check=False)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("is no build folder of CMake", done.stdout + done.stderr)

    def test_the_sources_have_all_that_a_build_needs(self):
        run(sys.executable, "-m", "build", "--no-isolation", "--sdist", "--outdir", self.folder, PROJECT, cwd=self.folder)
        with tarfile.open(next(self.folder.glob("*.tar.gz"))) as archive:
            archive.extractall(self.folder / "sources")
        top = next((self.folder / "sources").iterdir())
        missing = [file for file in ("CMakeLists.txt", "framework/python/tactus_backend.py", "LICENSES/MIT.txt", "pyproject.toml", "PKG-INFO",
                                     "nodes/CMakeLists.txt", "host/devices/live/tactus_live.h") if not (top / file).is_file()]
        self.assertEqual(missing, [])
        run(sys.executable, "-m", "build", "--no-isolation", "--wheel", f"-Cbuild-dir={BUILD}", "--outdir", self.folder / "again", top, cwd=self.folder)
        self.assertEqual((self.folder / "again" / self.wheel.name).read_bytes(), self.wheel.read_bytes())


try:
    import build   # noqa: F401
    run(sys.executable, "-m", "pip", "--version")
    run(sys.executable, "-c", "import venv, ensurepip")
except (ImportError, AssertionError):
    print("skipped: python3-build, python3-pip or python3-venv is not installed")
    sys.exit(77)

if __name__ == "__main__":
    unittest.main()
