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
# Text that is fainter than WCAG 2.1 asks for (AA, whose threshold for large text is lower), and elements without a name.
FAINT = """
const parts = text => text.match (/[\\d.]+/g).map (Number);
const light = ([r, g, b]) => [r, g, b].map (c => c / 255).map (c => c <= 0.03928 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4)
                                     .reduce ((sum, c, i) => sum + c * [0.2126, 0.7152, 0.0722][i], 0);
const over = (top, bottom) => top.slice (0, 3).map ((c, i) => (top[3] ?? 1) * c + (1 - (top[3] ?? 1)) * bottom[i]);
const behind = one => {
    const c = parts (getComputedStyle (one).backgroundColor);
    return c.length === 3 || c[3] === 1 ? c : over (c, one.parentElement ? behind (one.parentElement) : [255, 255, 255]);
};
const isShown = one => one.getClientRects().length > 0 && ! one.closest ('noscript, .MathJax_CHTML, .mjx-chtml, .MJX_Assistive_MathML');
const hasText = one => [...one.childNodes].some (node => node.nodeType === 3 && node.data.trim());
return [...document.querySelectorAll ('article *, .sidebar-drawer *')].filter (one => hasText (one) && isShown (one))
    .map (one => {
        const ground = behind (one), style = getComputedStyle (one), size = Number.parseFloat (style.fontSize);
        const [dark, bright] = [light (over (parts (style.color), ground)), light (ground)].sort ((a, b) => a - b);
        return [one.outerHTML.slice (0, 200), (bright + 0.05) / (dark + 0.05), size >= 24 || (size >= 18.6 && style.fontWeight >= 700) ? 3 : 4.5];
    })
    .filter (([, contrast, least]) => contrast < least);
"""
UNNAMED = """
return [...document.querySelectorAll ('input:not([type=checkbox]), select, button, a[href], audio, video, img')].filter (one => one.getClientRects().length > 0
    && ! one.labels?.length && ! one.getAttribute ('aria-label') && ! one.title && ! one.alt && ! one.placeholder && ! one.textContent.trim()
    && ! one.querySelector ('img[alt], title')).map (one => one.outerHTML.slice (0, 200));
"""
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

    def test_everything_has_a_name_and_can_be_read(self):
        try:
            for scheme, is_dark in (("light", False), ("dark", True)):
                self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": scheme}]})
                for page in PAGES:
                    with self.subTest(page, scheme=scheme):
                        self.open(f"{page}.html")
                        self.browser.execute_script("localStorage.clear(); document.body.dataset.theme = 'auto'")
                        self.until("return document.readyState === 'complete'")
                        ground = self.browser.execute_script("return getComputedStyle (document.body).backgroundColor.match (/\\d+/g).map (Number)")
                        self.assertEqual(max(ground[:3]) < 128, is_dark)
                        self.assertEqual(self.browser.execute_script(FAINT)[:5], [])
                        self.assertEqual(self.browser.execute_script(UNNAMED), [])
        finally:
            self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})

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
