#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Reads the pages of the site in Chromium: pages_test.py SITE

No page loads anything in vain or writes an error, the switch between light and dark works, laws are set without an error, the search finds a page, and a page
fits on a phone. Exit status 77 if the packages chromium-driver and python3-selenium are missing."""

import functools
import http.server
import pathlib
import sys
import threading
import unittest

try:
    from selenium import webdriver
    from selenium.webdriver.common.by import By
    from selenium.webdriver.support.ui import WebDriverWait
except ImportError:
    sys.exit(77)

PATIENCE_S = 60
PAGES = ("index", "start", "concepts", "glossary", "tutorials/first_graph", "tutorials/notebook", "nodes/index", "nodes/friction.elasto_plastic",
         "gallery/index", "c_api", "decisions/index")
SET = "return document.querySelectorAll ('.MathJax_CHTML, .mjx-chtml').length"


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):   # pylint: disable=arguments-differ
        pass


class Pages(unittest.TestCase):
    site = None

    @classmethod
    def setUpClass(cls):
        cls.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=str(cls.site)))
        threading.Thread(target=cls.server.serve_forever, daemon=True).start()
        options = webdriver.ChromeOptions()
        for argument in ("--headless=new", "--no-sandbox", "--window-size=1200,900"):
            options.add_argument(argument)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        cls.browser = webdriver.Chrome(options=options)

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()
        cls.server.shutdown()

    def open(self, page):
        self.browser.get(f"http://127.0.0.1:{self.server.server_port}/{page}")

    def until(self, script):
        return WebDriverWait(self.browser, PATIENCE_S).until(lambda browser: browser.execute_script(script))

    def test_no_page_writes_an_error(self):
        for page in PAGES:
            with self.subTest(page):
                self.open(f"{page}.html")
                self.until("return document.readyState === 'complete'")
                self.assertEqual([entry["message"] for entry in self.browser.get_log("browser") if entry["level"] in ("SEVERE", "WARNING")], [])

    def test_light_and_dark(self):
        self.open("index.html")
        themes = set()
        for _ in range(3):
            themes.add(self.browser.execute_script("return document.body.dataset.theme"))
            self.browser.execute_script("document.querySelector ('.theme-toggle').click()")
        self.assertEqual(themes, {"auto", "light", "dark"})

    def test_laws_are_set_without_an_error(self):
        self.open("nodes/friction.elasto_plastic.html")
        self.assertGreater(self.until(SET), 3)
        self.assertEqual(self.browser.execute_script("return document.querySelectorAll ('.mjx-merror, .merror').length"), 0)
        loaded = self.browser.execute_script("return performance.getEntriesByType ('resource').map (r => r.name)")
        self.assertEqual([name for name in loaded if not name.startswith(f"http://127.0.0.1:{self.server.server_port}/")], [])

    def test_the_search_finds_a_tutorial(self):
        self.open("search.html?q=jelly")
        self.assertIn("first_node.html", self.until("return [...document.querySelectorAll ('#search-results a')].map (a => a.href).join (' ')"))

    def test_pages_fit_on_a_phone(self):
        self.browser.set_window_size(500, 900)   # Chromium has no narrower window
        try:
            for page in ("index", "tutorials/first_graph", "concepts"):
                with self.subTest(page):
                    self.open(f"{page}.html")
                    self.until("return document.readyState === 'complete'")
                    self.assertLessEqual(self.browser.execute_script("return document.documentElement.scrollWidth - innerWidth"), 0)
                    self.assertTrue(self.browser.find_element(By.CSS_SELECTOR, "article h1").is_displayed())
        finally:
            self.browser.set_window_size(1200, 900)


if __name__ == "__main__":
    Pages.site = pathlib.Path(sys.argv[1]).resolve()
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
