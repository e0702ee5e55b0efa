#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Looks at a site that docs/build.sh has built: site_test.py TACTUS SITE

Every link leads to a file and a place in it; nothing is loaded from elsewhere; every node has its page with law, ports and source; every preset has its card, its
page with plot, sound and file, and a link to the playground; long pages have a table of contents; laws are typeset; the notebook has run; pages link
the words of the glossary; and the search knows all pages."""

import html.parser
import json
import pathlib
import re
import subprocess
import sys
import unittest
from urllib.parse import unquote, urlsplit

LOADS = {"script": "src", "img": "src", "audio": "src", "video": "src", "source": "src", "iframe": "src"}


class Page(html.parser.HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.path, self.links, self.loaded, self.ids, self.words, self.quiet, self.has_toc, self.formulas = path, [], [], set(), 0, 0, False, 0
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        given = dict(attrs)
        if "id" in given:
            self.ids.add(given["id"])
        if tag == "a" and given.get("name"):
            self.ids.add(given["name"])
        if tag == "a" and given.get("href"):
            self.links.append(given["href"])
        if tag in LOADS and given.get(LOADS[tag]):
            self.loaded.append(given[LOADS[tag]])
        if tag == "link" and given.get("rel") not in ("search", "index", "next", "prev", "canonical"):
            self.loaded.append(given["href"])
        self.formulas += "math notranslate" in (given.get("class") or "")
        if tag == "video":
            self.loaded.append(given["poster"])
        if "toc-tree" in (given.get("class") or ""):
            self.has_toc = True
        if tag in ("script", "style", "pre", "table"):
            self.quiet += 1

    def handle_endtag(self, tag):
        if tag in ("script", "style", "pre", "table"):
            self.quiet -= 1

    def handle_data(self, data):
        if not self.quiet:
            self.words += len(data.split())


class Site(unittest.TestCase):
    tactus = site = None

    @classmethod
    def setUpClass(cls):
        cls.pages = {path: Page(path) for path in sorted(cls.site.rglob("*.html")) if "_downloads" not in path.parts}

    def target(self, page, link):
        """The file that a link of a page leads to, and the place in it."""
        parts = urlsplit(link)
        path = (page.path.parent / unquote(parts.path)).resolve() if parts.path else page.path
        return path / "index.html" if path.is_dir() else path, unquote(parts.fragment)

    def test_every_link_leads_somewhere(self):
        checked = 0
        for page in self.pages.values():
            for link in page.links + page.loaded:
                if urlsplit(link).scheme:
                    continue
                path, place = self.target(page, link)
                self.assertTrue(path.is_file(), f"{page.path}: {link}")
                checked += 1
                if place and path in self.pages and "playground" not in path.parts:
                    self.assertIn(place, self.pages[path].ids | {"", "top"}, f"{page.path}: {link}")
        self.assertGreater(checked, 5000)

    def test_nothing_is_loaded_from_elsewhere(self):
        for page in self.pages.values():
            self.assertEqual([link for link in page.loaded if urlsplit(link).netloc], [], page.path)
        for style in self.site.rglob("*.css"):
            self.assertIsNone(re.search(r"(@import|url\()\s*[\"']?(https?:)?//", style.read_text(encoding="utf-8")), style)

    def test_every_node_has_a_page(self):
        for node in json.loads(subprocess.run([self.tactus, "nodes", "--json"], check=True, capture_output=True, text=True).stdout):
            with self.subTest(node["id"]):
                text = (self.site / "nodes" / f"{node['id']}.html").read_text(encoding="utf-8")
                kinds = [kind for kind in ("inputs", "params", "settings", "outputs") if node[kind]]
                ports = [f"<span class=\"pre\">{port['id']}</span>" for kind in kinds for port in node[kind]]
                for part in ('id="law"', "Source: ", *[f'id="{kind}"' for kind in kinds], *ports):
                    self.assertIn(part, text)

    def test_laws_are_typeset_and_the_notebook_has_run(self):
        self.assertEqual(self.pages[self.site / "nodes/friction.elasto_plastic.html"].formulas, 7)
        self.assertTrue((self.site / "_static/mathjax/MathJax.js").is_file())
        notebook = (self.site / "tutorials/notebook.html").read_text(encoding="utf-8")
        self.assertIn("tool.out", notebook)
        self.assertTrue(re.search(r'<img alt="[^"]*" src="[^"]*\.png"', notebook), "the notebook shows no figure")

    def test_the_index_has_six_sections(self):
        index = (self.site / "index.html").read_text(encoding="utf-8")
        for section in ("start", "tutorials", "how-to", "concepts", "reference", "decisions"):
            self.assertIn(f'<section id="{section}">', index)
        for page in ("index", "start"):
            self.assertTrue(any(link.endswith("first_minute.webm") for link in self.pages[self.site / f"{page}.html"].loaded), page)

    def test_the_reference_has_the_interfaces(self):
        for page, words in {"cpp_api": "tactus/run/run.hpp GuardLimits", "c_api": "tactus_plugin.h tactus_graph_load", "python_api": "Graph.render sweep",
                            "commands": "check-preset", "profiles": "kinematics", "wires": "cobs", "osc": "/tactus"}.items():
            text = (self.site / f"{page}.html").read_text(encoding="utf-8")
            for word in words.split():
                self.assertIn(word, text, page)

    def test_every_preset_has_a_card_and_a_page(self):
        index = (self.site / "gallery/index.html").read_text(encoding="utf-8")
        presets = json.loads((self.site / "playground/presets.json").read_text())["presets"]
        self.assertGreater(len(presets), 0)
        for preset in presets:
            with self.subTest(preset["id"]):
                play = f"../playground/index.html#preset={preset['id']}"
                self.assertIn(play, index)
                page = self.pages[self.site / "gallery" / f"{preset['id']}.html"]
                self.assertIn(play, page.links)
                for picture in (f"{preset['id']}.png", f"{preset['id']}_patch.svg"):
                    self.assertIn(picture, index)
                    self.assertTrue(any(link.endswith(picture) for link in page.loaded))
                self.assertTrue(any(link.endswith(f"{preset['id']}.wav") for link in page.loaded))
                self.assertTrue(any(link.endswith(f"{preset['id']}.json") for link in page.links))
                self.assertTrue(any("../nodes/" in link for link in page.links))

    def test_a_long_page_has_a_table_of_contents(self):
        long_pages = [page for page in self.pages.values() if page.words > 1500 and page.path.stem not in ("genindex", "glossary", "search")]
        self.assertGreater(len(long_pages), 5)
        self.assertEqual([page.path.name for page in long_pages if not page.has_toc], [])

    def test_the_glossary_defines_its_words_and_the_search_knows_all_pages(self):
        words = self.pages[self.site / "glossary.html"].ids
        for word in ("role", "record", "section", "guard", "tick"):
            self.assertIn(f"term-{word}", words)
        index = (self.site / "searchindex.js").read_text(encoding="utf-8")
        for name in ("devices", "tutorials/first_graph", "tutorials/notebook", "concepts", "nodes/friction.elasto_plastic", "gallery/dry_wood",
                     "decisions/one_walk"):
            self.assertIn(f'"{name}"', index)

    def test_a_page_links_the_first_use_of_a_word_of_the_glossary(self):
        for page, word in (("devices", "profile"), ("devices", "guard"), ("tutorials/first_node", "plugin"), ("tutorials/first_graph", "role"),
                           ("graph_file", "section"), ("decisions/flat_plan", "record"), ("live", "live-session")):
            with self.subTest(page=page, word=word):
                here = self.pages[self.site / f"{page}.html"]
                links = [link for link in here.links if link.endswith(f"#term-{word}")]
                self.assertEqual([self.target(here, link)[0].name for link in links], ["glossary.html"])


if __name__ == "__main__":
    Site.tactus, Site.site = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
