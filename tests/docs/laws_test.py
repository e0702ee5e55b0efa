#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How docs/site/laws.py typesets the laws of headers: laws_test.py TACTUS"""

import json
import pathlib
import re
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "docs/site"))

import laws  # noqa: E402  pylint: disable=wrong-import-position

# Laws of nodes, and how they are set.
KNOWN = {
    "f = -sigma d": r"f =-\sigma \,d",
    "c <- c + |dp| zeta d~": r"c \leftarrow c +\lvert \mathrm{d}p \rvert \,\zeta \,\tilde{d }",
    "sigma = mu f_n / d_max": r"\sigma =\mu \,f_{n} /d_{\mathrm{max}}",
    "depth = offset - n . p": r"\mathrm{depth} =\mathrm{offset} -n \cdot p",
    "p = (p_k - p_(k-n)) / (n T)": r"p =(p_{k} -p _{k -n})/(n \,T )",
    "H (s) = 1 / (s^2 + sqrt (2) s + 1)": r"H (s )=1/(s ^{2}+\sqrt{2}\,s +1)",
    "w_i = (1 / q_i) / sum_j (1 / q_j)": r"w_{i} =(1/q_{i} )/\sum_{j} (1/q_{j} )",
    "D = linear |w| + quadratic |w|^2": r"D =\mathrm{linear} \,\lvert w \rvert +\mathrm{quadratic} \,\lvert w \rvert ^{2}",
    "m d'' = -N": "m \\,d'' =-N",
}
PORTS = {"depth", "offset", "linear", "quadratic", "break_away"}
PROSE = ("sigma is constant while the tool touches", "gain = 1 up to f_max / 2, then half a cosine", "x = (1", "x = |1", "x = 1)", "x = 2 ^", "x = #")


class Laws(unittest.TestCase):
    tactus = None

    def test_known_laws(self):
        for text, made in KNOWN.items():
            self.assertEqual(laws.formula(text, PORTS), made)

    def test_words_and_broken_formulas_stay_text(self):
        for text in PROSE:
            with self.assertRaises(laws.NoFormula, msg=text):
                laws.formula(text, PORTS)
            self.assertIsNone(laws.law([text], PORTS))

    def test_a_law_becomes_a_table_that_keeps_all_words(self):
        made = laws.law(["a      b = break_away c      what it is   (1)", "else   nothing | at all"], PORTS)
        self.assertEqual(made, "|  |  |  |\n|---|---|---|\n| a | $b =\\mathrm{break\\_away} \\,c$ | what it is (1) |\n| else |  | nothing \\| at all |\n")

    def test_most_formulas_of_the_nodes_are_typeset_and_have_whole_brackets(self):
        nodes = json.loads(subprocess.run([self.tactus, "nodes", "--json"], check=True, capture_output=True, text=True).stdout)
        ports = {node["id"]: {port["id"] for kind in ("inputs", "params", "settings", "outputs") for port in node[kind]} for node in nodes}
        formulas, nodes_with_law = 0, 0
        for header in sorted((ROOT / "nodes").rglob("*.hpp")):
            text = header.read_text(encoding="utf-8")
            found = re.search(r'\.id = "([a-z]+\.[a-z0-9_]+)"', text)
            if not found or found[1] not in ports:
                continue
            lines = [line[8:] for line in text.splitlines() if line.startswith("///     ")]
            made = "".join(laws.law([line], ports[found[1]]) or "" for line in lines)
            nodes_with_law += bool(made)
            for formula in re.findall(r"\$(.*?)\$", made):
                formulas += 1
                self.assertEqual(formula.count("{"), formula.count("}"), header)
                self.assertEqual(formula.count("\\lvert"), formula.count("\\rvert"), header)
        self.assertGreater(formulas, 70)
        self.assertGreater(nodes_with_law, 25)


if __name__ == "__main__":
    Laws.tactus = sys.argv[1]
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
