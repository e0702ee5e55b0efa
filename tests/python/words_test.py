# SPDX-License-Identifier: MIT
"""The messages of the C++ side are written for the command line and the C API. In Python they name arguments of Python."""

import re
import unittest

import tactus
from support import ROOT, TestCase
from tactus._words import in_python

# What the two libraries of the package are made of.
FOLDERS = ("framework", "nodes", *("host/base/" + name for name in ("assets", "files", "platform")), "host/code/plugins",
           *("host/devices/" + name for name in ("device_plugins", "failsafe", "hid", "hid_link", "live", "sessions")))
LITERAL = re.compile(r'R"\((.*?)\)"|"((?:[^"\\\n]|\\.)*)"')
OPTION = re.compile(r"(?<![\w-])--[a-z]")
C_NAME = re.compile(r"\btactus_(run|graph|session|messages|text|set|nodes)_?\w*")
# Options of other programs: of the compiler, and of udevadm.
FOREIGN = re.compile(r"--param=|--version-script|udevadm")


def literals():
    """The texts in the sources, with the place."""
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).rglob("*.[ch]pp")):
            if (ROOT / "framework/python") in path.parents:
                continue
            for i, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
                if line.strip().startswith(("//", "#include", "*")):
                    continue
                for raw, plain in LITERAL.findall(line):
                    yield f"{path.relative_to(ROOT)}:{i}", raw or plain.replace('\\"', '"')


class Words(TestCase):
    def test_no_text_of_the_libraries_names_options_or_the_c_api_in_python(self):
        translated = 0
        for place, text in literals():
            if FOREIGN.search(text) or not (OPTION.search(text) or C_NAME.search(text)):
                continue
            for devices in ("devices", "device"):
                words = in_python(text, devices)
                self.assertIsNone(OPTION.search(words), f"{place}: {words}")
                self.assertIsNone(C_NAME.search(words), f"{place}: {words}")
            translated += 1
        self.assertGreater(translated, 30, "the sources have such texts, and this test does not find them")

    def test_the_words_are_those_of_python(self):
        for text, words in (
                ("--set drag.mu", "set drag.mu"),
                ("--device stylus=gestur:circle", "devices={'stylus': 'gestur:circle'}"),
                ("write ROLE=sim or ROLE=gesture:NAME", "write {'ROLE': 'sim'} or {'ROLE': 'gesture:NAME'}"),
                ("give a --duration in s", "give a duration in s"),
                ("or raise the budget: --limits points=1M", 'or raise the budget: tactus.set_limits("points=1M")'),
                ("give it one with tactus_run_device or tactus_run_pushed_device", "give it one with devices={'ROLE': …}"),
                ("use a name that tactus_run_role returns", "use one of Engine.roles"),
                ("choose with --clock ROLE, or in the session: tactus session --clock ROLE", "choose with clock='ROLE'"),
                ("name a role with a HID device, or write --clock timer or --clock audio",
                 "name a role with a HID device, or write clock='timer' or clock='audio'"),
                ("`tactus nodes friction.elasto_plastic` lists them", "tactus.nodes()['friction.elasto_plastic'] lists them")):
            self.assertEqual(in_python(text), words)
        self.assertEqual(in_python("--device stylus=sim", "device"), "device={'stylus': 'sim'}")

    def test_other_texts_stay_as_they_are(self):
        for text in ("", "drag.mu", "/wires/3", "a -> b", "a - b", "well-known", "x--", "/home/me/my--file.json", "tactus_board", "the file ends -- too early"):
            self.assertEqual(in_python(text), text)

    def test_the_documentation_of_the_package_names_no_options(self):
        for name in tactus.__all__:
            thing = getattr(tactus, name)
            for part in [thing, *(vars(thing).values() if isinstance(thing, type) else ())]:
                text = getattr(part, "__doc__", None) or ""
                self.assertIsNone(OPTION.search(text), f"{name}: {text}")
                self.assertIsNone(C_NAME.search(text), f"{name}: {text}")


if __name__ == "__main__":
    unittest.main()
