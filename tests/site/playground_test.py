#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Uses the playground in Chromium as a person does: strokes, turns knobs, stops, records, and plugs in a gamepad and a board, which are simulated.

Usage: playground_test.py TACTUS SITE. Exit status 77 if the packages chromium-driver and python3-selenium are missing. What is recorded in the page must
be what `tactus render` computes, bit for bit."""

import csv
import functools
import http.server
import io
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import threading
import unittest

try:
    from selenium import webdriver
    from selenium.common.exceptions import WebDriverException
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
    from selenium.webdriver.support.ui import WebDriverWait
except ImportError:
    webdriver = None

HERE = pathlib.Path(__file__).resolve().parent
PATIENCE_S = 60

# A gamepad that rumbles, and a board at the other end of WebHID: it reports its position each 4 ms.
MOCKS = """
window.effects = [];
window.pad = { id: 'Mock pad (Vendor: 1)', axes: [0, 0, 0, 0], buttons: Array.from ({ length: 16 }, () => ({ pressed: false })),
               vibrationActuator: { playEffect: (kind, effect) => { window.effects.push (effect); }, reset: () => { window.was_reset = true; } } };
window.has_pad = false;
navigator.getGamepads = () => window.has_pad ? [window.pad] : [];
class Board extends EventTarget
{
    vendorId = 0x16c0; productId = 0x0486; productName = 'Mock board'; collections = [{ usagePage: 0xffab, usage: 0x0200 }];
    sent = []; z = 0.003; number = 0; flags = 0b11;   // homed, driven
    async open()
    {
        this.timer = setInterval (() => {
            const data = new DataView (new ArrayBuffer (64));
            data.setUint8 (0, 0x54); data.setUint8 (1, 1); data.setUint16 (2, this.flags, true); data.setUint32 (4, this.is_repeating ? this.number : ++this.number, true);
            data.setUint32 (8, 1000 * performance.now(), true);
            data.setInt32 (20, Math.round (this.z * 1e9), true);
            if (! this.is_silent) this.dispatchEvent (Object.assign (new Event ('inputreport'), { reportId: 0, data, device: this }));
        }, 4);
    }
    async close() { clearInterval (this.timer); this.is_closed = true; }
    async sendReport (id, bytes) { this.sent.push ([...bytes]); localStorage.setItem ('last', JSON.stringify (this.last())); }
    last()
    {
        const data = new DataView (Uint8Array.from (this.sent.at (-1)).buffer);
        return { drives: data.getUint16 (2, true) & 1, answers: data.getUint32 (4, true), force: data.getInt32 (16, true) * 1e-6, count: this.sent.length };
    }
}
window.board = new Board();
Object.defineProperty (navigator, 'hid', { value: Object.assign (new EventTarget(), {
    requestDevice: async options => { window.filters = options.filters; return [window.board]; } }) });
window.AudioWorkletNode = class extends AudioWorkletNode { constructor (...all) { super (...all); window.engine = this; } };
window.AudioContext = class extends AudioContext { constructor (options) { super (options); window.sound = this; } };
"""

UNNAMED = """
return [...document.querySelectorAll ('input, select, button, canvas, a[href]')].filter (one => ! one.closest ('[hidden]')
    && ! one.labels?.length && ! one.getAttribute ('aria-label') && ! one.textContent.trim()).map (one => one.outerHTML);
"""

# The contrast of each text with what is behind it, by WCAG 2.1.
FAINT = """
const parts = text => text.match (/[\\d.]+/g).map (Number);
const light = ([r, g, b]) => [r, g, b].map (c => c / 255).map (c => c <= 0.03928 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4)
                                     .reduce ((sum, c, i) => sum + c * [0.2126, 0.7152, 0.0722][i], 0);
const behind = one => {
    const c = parts (getComputedStyle (one).backgroundColor);
    return c.length === 3 || c[3] === 1 || ! one.parentElement ? c : behind (one.parentElement);
};
const hasText = one => ! one.closest ('[hidden], noscript') && [...one.childNodes].some (node => node.nodeType === 3 && node.data.trim());
return [...document.querySelectorAll ('body *')].filter (hasText)
    .map (one => [one.outerHTML, ...[light (parts (getComputedStyle (one).color)), light (behind (one))].sort ((a, b) => a - b)])
    .map (([text, dark, bright]) => [text, (bright + 0.05) / (dark + 0.05)])
    .filter (([, contrast]) => contrast < 4.5);
"""


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


class Playground(unittest.TestCase):
    tactus = site = None

    @classmethod
    def setUpClass(cls):
        cls.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=str(cls.site)))
        threading.Thread(target=cls.server.serve_forever, daemon=True).start()
        cls.start()

    @classmethod
    def start(cls):
        options = webdriver.ChromeOptions()
        for flag in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--window-size=1200,1100"):
            options.add_argument(flag)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        options.binary_location = shutil.which("chromium")
        cls.page = webdriver.Chrome(options=options)
        cls.mock()

    @classmethod
    def mock(cls):
        cls.page.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": MOCKS})

    @classmethod
    def tearDownClass(cls):
        cls.page.quit()
        cls.server.shutdown()

    def setUp(self):
        self.open("preset=dry_wood")

    def tearDown(self):
        errors = [entry for entry in self.page.get_log("browser") if entry["level"] in ("SEVERE", "WARNING")]
        self.assertEqual(errors, [])

    def open(self, address):
        self.page.get("about:blank")
        self.page.get(f"http://127.0.0.1:{self.server.server_port}/#{address}")
        self.until("return document.getElementById ('about').textContent !== ''")

    def run_script(self, script, *arguments):
        return self.page.execute_script(script, *arguments)

    def until(self, script, *arguments):
        WebDriverWait(self.page, PATIENCE_S, poll_frequency=0.02).until(lambda page: page.execute_script(script, *arguments), f"never true: {script}")

    def id(self, name):
        return self.page.find_element(By.ID, name)

    def force(self):
        return float(self.id("force").text.split()[0])

    def until_force(self, condition):
        self.until(f"const force = Number.parseFloat (document.getElementById ('force').textContent); return {condition}")

    def press(self):
        """Presses into the board, below the middle of the picture, and waits for the force."""
        pad = self.id("pad")
        ActionChains(self.page).move_to_element(pad).click_and_hold().move_by_offset(10, int(0.49 * pad.size["height"])).perform()
        self.until_force("force > 0.2")

    def release(self):
        ActionChains(self.page).release().perform()

    def turn(self, knob, value):
        self.run_script("const knob = document.getElementById (arguments[0]); knob.value = arguments[1]; knob.dispatchEvent (new Event ('input'));"
                        "knob.dispatchEvent (new Event ('change'));", "knob-" + knob, value)

    def text_of(self, link):
        return self.page.execute_async_script("const [link, done] = arguments; fetch (document.getElementById ('of-' + link).href).then (a => a.text()).then (done)",
                                              link)

    def record(self, act, role="stylus"):
        self.id("record").click()
        self.until("return document.getElementById ('record').getAttribute ('aria-pressed') === 'true'")
        act()
        self.id("record").click()
        self.until("return document.getElementById ('of-forces') !== null")
        return self.text_of(role), self.text_of("forces")

    def rendered(self, preset, traces, *sets):
        with tempfile.TemporaryDirectory() as folder:
            made, devices = pathlib.Path(folder) / "out.csv", []
            for role, trace in traces.items():
                moved = pathlib.Path(folder) / f"{role}.csv"
                moved.write_text(trace)
                devices.append(f"--device={role}=trace:{moved}")
            subprocess.run([self.tactus, "render", preset, *devices, *[f"--set={one}" for one in sets], "--out", made], check=True, capture_output=True)
            return made.read_text()

    def same(self, recorded, rendered, smallest=0.2):
        ours, theirs = (list(csv.reader(io.StringIO(text))) for text in (recorded, rendered))
        self.assertEqual(ours[0], theirs[0])
        self.assertEqual(len(ours), len(theirs))
        numbers = [[[float(cell) for cell in row[1:]] for row in rows[1:]] for rows in (ours, theirs)]
        self.assertEqual(sum(a != b for a, b in zip(*numbers)), 0)
        self.assertGreater(max(abs(cell) for row in numbers[0] for cell in row), smallest)
        return len(numbers[0])

    def test_a_first_feel_takes_less_than_a_megabyte(self):
        self.press()
        felt_ms = self.run_script("return performance.now()")
        self.release()
        loaded = self.run_script("return performance.getEntriesByType ('resource').map (one => [one.name, one.encodedBodySize])")
        self.assertIn(True, [name.endswith("dry_wood.wasm") for name, _ in loaded])
        engine = sum((self.site / name).stat().st_size for name in ("engine.js", "graphs/tactus_graph.js", "index.html"))   # a worklet is not listed
        total = sum(size for _, size in loaded) + engine
        print(f"first feel after {total} bytes; {felt_ms:.0f} ms after the page was opened, with a hand of selenium")
        self.assertLess(total, 1_000_000)
        origin = f"http://127.0.0.1:{self.server.server_port}/"
        self.assertEqual([name for name, _ in loaded if not name.startswith(origin)], [])

    def test_what_is_recorded_is_what_render_computes(self):
        def stroke():
            self.press()
            if "TACTUS_SCREENS" in os.environ:
                self.page.save_screenshot(os.environ["TACTUS_SCREENS"] + "/playground.png")
            chain = ActionChains(self.page)
            for step in (-80, 60, -30, 90):
                chain.move_by_offset(step, 0)
            chain.perform()
            self.release()

        trace, forces = self.record(stroke)
        ticks = self.same(forces, self.rendered("dry_wood", {"stylus": trace}))
        self.assertGreater(ticks, 1000)
        self.open("preset=dry_wood&roughness=0.9")
        self.assertEqual(self.id("knob-roughness").get_attribute("value"), "0.9")
        trace, forces = self.record(stroke)
        rough = self.rendered("dry_wood", {"stylus": trace}, "roughness=0.9")
        self.same(forces, rough)
        self.assertNotEqual(rough, self.rendered("dry_wood", {"stylus": trace}))

    def test_a_link_holds_preset_and_knobs(self):
        self.turn("roughness", 0.25)
        self.assertIn("#preset=dry_wood&roughness=0.25", self.page.current_url)
        self.open("preset=dry_wood&roughness=nonsense")
        self.assertEqual(self.id("knob-roughness").get_attribute("value"), "0.5")
        self.open("preset=nothing_like_this")
        self.assertEqual(self.id("preset").get_attribute("value"), "dry_wood")

    def test_stop_takes_the_force_away_until_the_person_starts_again(self):
        self.press()
        self.page.find_element(By.TAG_NAME, "body").send_keys(Keys.ESCAPE)
        self.until_force("force === 0")
        self.assertIn("you stopped it", self.id("status").text)
        ActionChains(self.page).move_by_offset(5, 0).move_by_offset(-5, 0).perform()
        self.assertEqual(self.force(), 0.0)
        self.release()
        self.id("record").click()   # a new start is no way around a stop
        self.press_only()
        self.id_click("record")
        self.until("return document.getElementById ('of-forces') !== null")
        self.assertEqual(self.force(), 0.0)
        self.id_click("rearm")
        self.press()
        self.id_click("stop")
        self.until_force("force === 0")
        self.release()
        self.open("preset=dry_wood")
        self.id("stop").click()   # before there is an engine
        self.record(self.press_only)
        self.release()
        self.assertEqual(self.force(), 0.0)
        self.assertIn("you stopped it", self.id("status").text)
        self.id("rearm").click()
        self.press()
        self.release()

    def press_only(self, depth=0.49):
        pad = self.id("pad")
        ActionChains(self.page).move_to_element(pad).click_and_hold().move_by_offset(10, int(depth * pad.size["height"])).perform()

    def touch(self, kind, *points):
        self.page.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": list(points)})

    def id_click(self, name):
        """Clicks while the mouse may be down elsewhere, as a second hand would."""
        self.run_script("document.getElementById (arguments[0]).click()", name)

    def test_arrow_keys_move_the_hand(self):
        self.id("pad").send_keys(Keys.ARROW_DOWN * 50)
        self.until_force("force > 0.2")
        self.id("pad").send_keys(Keys.ARROW_UP * 50)
        self.until_force("force < 0.01")

    def test_a_gamepad_moves_the_hand_and_rumbles_until_stop(self):
        self.run_script("window.has_pad = true; window.pad.axes = [0, 1, 0, 0]")
        self.id("pad").click()
        self.until("window.pad.axes[0] = Math.sin (performance.now() / 50); return window.effects.some (one => one.strongMagnitude > 0.02)")
        self.assertTrue(all(0 <= one["strongMagnitude"] <= 1 for one in self.run_script("return window.effects")))
        self.run_script("window.pad.buttons[1].pressed = true")
        self.until("return window.was_reset === true")
        self.until_force("force === 0")
        self.run_script("window.effects.length = 0")
        self.until("window.ticks = (window.ticks ?? 0) + 1; return window.ticks > 20")
        self.assertEqual(self.run_script("return window.effects.length"), 0)

    def test_a_board_gets_guarded_forces_and_stop_lets_its_motors_go(self):
        self.id("connect").click()
        self.until("return ! document.getElementById ('disconnect').hidden")
        self.assertTrue(any(one.get("usagePage") == 0xFFAB for one in self.run_script("return window.filters")))
        self.run_script("window.board.z = -0.0005")
        self.until("return window.board.sent.length > 0 && window.board.last().drives === 1 && window.board.last().force > 0.5")
        self.until("return window.board.last().answers > 0")   # a report that no reading has asked for answers none
        self.run_script("window.board.z = -0.005")   # 10 N, if nothing limited it: the profile of the board allows 2 N
        self.until("return window.board.last().force > 1.5")
        forces = self.run_script("return window.board.sent.map (bytes => new DataView (Uint8Array.from (bytes).buffer).getInt32 (16, true) * 1e-6)")
        self.assertLessEqual(max(map(abs, forces)), 2.0)
        self.id("stop").click()
        self.until("return window.board.last().drives === 0 && window.board.last().force === 0")
        count = self.run_script("return window.board.last().count")
        self.until("window.waits = (window.waits ?? 0) + 1; return window.waits > 20")
        self.assertEqual(self.run_script("return window.board.last().count"), count)
        self.id("rearm").click()
        self.run_script("window.board.z = -0.0005")
        self.until("return window.board.last().drives === 1 && window.board.last().force > 0.3")
        self.run_script("window.board.is_silent = true")   # the watchdog of the guard
        self.until("return window.board.last().force === 0")
        self.id("disconnect").click()
        self.until("return window.board.is_closed === true")
        self.assertEqual(self.run_script("return window.board.last().drives"), 0)

    def connect(self, preset, z):
        """Connects the board with the first role of a preset, and waits for its force."""
        self.open(f"preset={preset}")
        self.id("connect").click()
        self.until("return ! document.getElementById ('disconnect').hidden")
        self.run_script("window.board.z = arguments[0]", z)
        self.until("return window.board.sent.length > 0 && window.board.last().force > 0.3")

    def let_pass(self, count):
        """Waits for this many more reports to the board, and returns their forces."""
        before = self.run_script("return window.board.sent.length")
        self.until("return window.board.sent.length >= arguments[0]", before + count)
        return self.run_script("return window.board.sent.slice (arguments[0]).map (bytes => { const data = new DataView (Uint8Array.from (bytes).buffer);"
                               "return Math.hypot (...[8, 12, 16].map (at => data.getInt32 (at, true) * 1e-6)); })", before)

    def test_a_board_keeps_its_role_when_another_hand_is_chosen(self):
        self.connect("two_fingers", -0.003)
        self.assertIn("as index", self.id("device").text)
        self.run_script("window.board.z = 0.003")
        self.until("return window.board.last().force === 0")
        self.run_script("const hand = document.getElementById ('hand'); hand.value = 1; hand.dispatchEvent (new Event ('change'))")
        self.press_only(0.2)
        self.until_force("force > 0.5")
        self.assertLess(max(self.let_pass(50)), 0.5)   # the cork creaks, which both fingers feel
        self.run_script("window.board.z = -0.003")
        self.until("return window.board.last().force > 0.3")
        self.assertLessEqual(max(self.let_pass(50)), 2.00001)
        self.run_script("window.board.is_silent = true")   # the watchdog of its own role
        self.until("return window.board.last().force === 0")
        self.assertEqual(max(self.let_pass(50)), 0.0)
        self.until_force("force > 0.5")
        self.release()

    def test_a_latched_stop_lasts_until_start(self):
        self.connect("dry_wood", -0.0005)
        self.until("window.board.z = window.board.z > 0 ? -0.0005 : 0.1;"   # faster than the profile of the board allows
                   "return document.getElementById ('status').textContent.includes ('too fast')")
        self.run_script("window.board.z = -0.0005")
        self.until("return window.board.last().force === 0")
        self.record(lambda: self.assertEqual(max(self.let_pass(50)), 0.0))
        self.assertTrue(self.id("rearm").is_displayed())
        for preset in ("two_fingers", "dry_wood"):
            self.run_script("const list = document.getElementById ('preset'); list.value = arguments[0]; list.dispatchEvent (new Event ('change'))", preset)
            self.until("return location.hash.includes (arguments[0]) && document.getElementById ('status').textContent.includes ('too fast')", preset)
            self.assertEqual(max(self.let_pass(50)), 0.0)
        self.id("disconnect").click()
        self.until("return window.board.is_closed === true")
        self.id("connect").click()
        self.until("return ! document.getElementById ('disconnect').hidden")
        self.assertEqual(max(self.let_pass(50)), 0.0)
        self.id("rearm").click()
        self.until("return window.board.last().force > 0.3")

    def test_a_silence_brings_the_board_to_rest(self):
        self.connect("dry_wood", -0.0005)
        before = self.run_script("for (const end = performance.now() + 150; performance.now() < end;); return window.board.sent.length")   # the page stalls
        self.until("return window.board.sent.length > arguments[0]", before)
        self.assertIn(0, self.run_script("return [-1, 0].map (i => window.board.sent[arguments[0] + i][2] & 1)", before))   # -1: it rested already
        self.until("return window.board.last().force > 0.3")
        self.run_script("window.sound.suspend()")
        self.until("return window.board.last().drives === 0")
        self.run_script("window.sound.resume()")
        self.until("return window.board.last().force > 0.3")

    def test_what_a_board_says_of_itself_is_heard(self):
        self.connect("dry_wood", -0.0005)
        for told, why in (("window.board.flags = 0b1011", "too hot"), ("window.board.flags = 0b01", "not driven"), ("window.board.is_repeating = true", "same report")):
            self.run_script(told)
            self.until("return document.getElementById ('status').textContent.includes (arguments[0])", why)
            self.until("return window.board.last().force === 0")
            self.run_script("window.board.flags = 0b11; window.board.is_repeating = false")
            self.until("return window.board.last().force > 0.3")

    def second_window(self):
        """Opens the playground in another window. The caller is there afterwards. The next test begins with a browser of its own."""
        self.addCleanup(self.restart)
        first = self.page.current_window_handle
        self.page.switch_to.new_window("window")
        self.page.set_window_size(1200, 1100)
        self.mock()
        self.open("preset=dry_wood")
        return first, self.page.current_window_handle

    def restart(self):
        self.page.quit()
        self.start()

    def close_window(self, back_to):
        self.page.close()
        self.page.switch_to.window(back_to)

    def device_text(self, part):
        self.until("return document.getElementById ('device').textContent.includes (arguments[0])", part)

    def test_two_windows_do_not_drive_one_board(self):
        self.connect("dry_wood", -0.0005)
        first, second = self.second_window()
        self.id("connect").click()
        self.device_text("another tab drives a Tactus board")
        self.assertEqual(self.run_script("return window.board.sent.length"), 0)
        self.page.switch_to.window(first)
        self.until("return window.board.last().force > 0.3")   # the first one goes on
        self.id("disconnect").click()
        self.until("return window.board.is_closed === true")
        self.page.switch_to.window(second)
        self.id("connect").click()
        self.device_text("is connected")
        self.close_window(first)   # and a closed window has no lock any more
        self.id("connect").click()
        self.device_text("is connected")

    def test_stop_in_one_window_stops_all_and_each_is_started_by_itself(self):
        self.connect("dry_wood", -0.0005)
        first, second = self.second_window()
        self.press()
        self.id_click("stop")
        self.until_force("force === 0")
        self.page.switch_to.window(first)
        self.until("return window.board.last().drives === 0 && document.getElementById ('status').textContent.includes ('you stopped it in another tab')")
        for act in ("record", "record"):
            self.id_click(act)
        self.page.switch_to.window(second)
        self.release()
        self.id_click("rearm")
        self.press()   # this window was started
        self.release()
        self.page.switch_to.window(first)
        self.until("window.waits = (window.waits ?? 0) + 1; return window.waits > 20")
        self.assertEqual(self.run_script("return window.board.last().drives"), 0)   # this one was not
        self.id("rearm").click()
        self.until("return window.board.last().force > 0.3")
        self.id("pad").send_keys(Keys.ESCAPE)   # the other way round, by a key
        self.until("return window.board.last().drives === 0")
        self.page.switch_to.window(second)
        self.until("return document.getElementById ('status').textContent.includes ('you stopped it in another tab')")
        self.close_window(first)

    def test_a_hidden_tab_stops_its_board_alone(self):
        self.connect("dry_wood", -0.0005)
        first, second = self.second_window()
        self.page.switch_to.window(first)
        self.run_script("Object.defineProperty (document, 'hidden', { value: true, configurable: true }); document.dispatchEvent (new Event ('visibilitychange'))")
        self.until("return window.board.last().drives === 0 && document.getElementById ('status').textContent.includes ('this tab was hidden')")
        self.page.switch_to.window(second)
        self.press()   # the other one goes on
        self.release()
        self.close_window(first)

    def last_report(self):
        return json.loads(self.run_script("return localStorage.getItem ('last')"))

    def test_a_page_that_ends_lets_its_board_go(self):
        first, second = self.second_window()   # looks at what the board got last
        ends = {"reload": self.page.refresh, "another page": lambda: self.page.get("about:blank"), "close": self.page.close}
        for name, end in ends.items():
            with self.subTest(name):
                self.page.switch_to.window(first)
                self.connect("dry_wood", -0.0005)
                end()
                self.page.switch_to.window(second)
                self.until("return JSON.parse (localStorage.getItem ('last')).drives === 0")
                self.until("return navigator.locks.query().then (all => all.held.length === 0)")
        self.assertEqual(self.page.window_handles, [second])

    def test_a_page_that_crashes_leaves_the_board_to_the_next_one(self):
        first, second = self.second_window()
        self.connect("dry_wood", -0.0005)   # in the second one
        try:
            self.page.set_page_load_timeout(2)
            self.page.get("chrome://crash")
        except WebDriverException:
            pass
        finally:
            self.page.set_page_load_timeout(PATIENCE_S)
        self.page.switch_to.window(first)
        self.until("return navigator.locks.query().then (all => all.held.length === 0)")
        self.id("connect").click()
        self.device_text("is connected")
        self.page.switch_to.window(second)
        self.close_window(first)

    def test_a_page_that_is_frozen_or_kept_for_the_way_back_gives_its_board_up(self):
        self.addCleanup(self.restart)   # a browser that was frozen takes no touch any more
        self.connect("dry_wood", -0.0005)
        self.page.execute_cdp_cmd("Page.setWebLifecycleState", {"state": "frozen"})
        self.page.execute_cdp_cmd("Page.setWebLifecycleState", {"state": "active"})
        self.until("return window.board.is_closed === true && document.getElementById ('status').textContent.includes ('this page was left')")
        self.assertEqual(self.run_script("return window.board.last().drives"), 0)
        self.connect("dry_wood", -0.0005)
        self.page.get("about:blank")
        self.page.back()
        self.until("return document.getElementById ('about').textContent !== ''")
        self.until("return document.getElementById ('disconnect').hidden")
        self.assertEqual(self.last_report()["drives"], 0)
        self.until("return navigator.locks.query().then (all => all.held.length === 0)")

    def test_an_error_in_the_engine_or_the_page(self):
        self.connect("dry_wood", -0.0005)
        self.run_script("setTimeout (() => { throw new Error ('on purpose'); }, 0); Promise.reject (new Error ('on purpose'))")
        self.let_pass(20)
        self.until("return window.board.last().force > 0.3")   # the page goes on, with all its limits
        self.run_script("window.engine.port.postMessage ({ turn: { name: 'no such knob', position: 1 } })")
        self.let_pass(20)
        self.until("return window.board.last().force > 0.3")
        self.run_script("window.engine.port.postMessage ({ load: { bytes: null } })")   # the engine restarts, and fails
        self.until("return window.board.last().force === 0")
        self.page.get_log("browser")   # the errors were on purpose

    def test_every_preset_is_what_render_computes(self):
        for preset in json.loads((self.site / "presets.json").read_text())["presets"]:
            with self.subTest(preset["id"]):
                self.open(f"preset={preset['id']}")
                self.assertEqual(self.id("hand").is_displayed(), len(preset["boxes"]) > 1)
                role = next(iter(preset["boxes"]))
                self.run_script("document.getElementById ('press').value = 0.9")

                def touch():
                    self.press_only()
                    chain = ActionChains(self.page, duration=60)
                    for across, up in ((-200, 0), (100, -150), (80, 150), (-150, -60), (60, 60)):
                        chain.move_by_offset(across, up)
                    chain.perform()
                    self.release()

                _, forces = self.record(touch, role)
                traces = {one: self.text_of(one) for one in preset["boxes"]}
                self.same(forces, self.rendered(preset["id"], traces), 0.0)

    def test_the_page_opens_again_without_its_server(self):
        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=str(self.site)))
        threading.Thread(target=server.serve_forever, daemon=True).start()
        try:
            self.page.get(f"http://127.0.0.1:{server.server_port}/#preset=dry_wood")
            self.until("return document.getElementById ('about').textContent !== ''")
            self.press()
            self.release()
            self.until("return navigator.serviceWorker.controller !== null")
            self.page.set_script_timeout(PATIENCE_S)
            self.page.execute_async_script("const done = arguments[0], wait = () => caches.match ('graphs/dry_wood.wasm')"
                                           ".then (kept => kept ? done() : setTimeout (wait, 50)); wait();")
        finally:
            server.shutdown()
            server.server_close()
        self.page.refresh()
        self.until("return document.getElementById ('about').textContent !== ''")
        self.press()
        self.release()

    def test_everything_has_a_name_and_can_be_read(self):
        self.assertEqual(self.run_script(UNNAMED), [])
        for scheme in ("light", "dark"):
            self.page.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": scheme}]})
            self.assertEqual(self.run_script(FAINT), [], scheme)
        self.page.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})

    def test_a_phone_shows_all_of_it(self):
        self.page.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": 360, "height": 740, "deviceScaleFactor": 2, "mobile": True})
        try:
            self.open("preset=dry_wood")
            self.assertLessEqual(self.run_script("return document.documentElement.scrollWidth"), 360)
            pad = self.id("pad")
            self.assertGreater(pad.size["width"], 300)
            stop = self.id("stop")
            self.assertGreaterEqual(min(stop.size["width"], stop.size["height"]), 44)
            edges = self.run_script("return document.getElementById ('pad').getBoundingClientRect().toJSON()")
            point = {"x": edges["left"] + edges["width"] / 2, "y": edges["top"] + 0.99 * edges["height"], "force": 0.8}
            self.touch("touchStart", point)   # a tap starts the engine
            self.touch("touchEnd")
            self.until("return document.getElementById ('status').textContent.includes ('is running')")
            self.touch("touchStart", point)
            self.until_force("force > 0.2")
            self.touch("touchEnd")
            self.until_force("force < 0.01")
            if "TACTUS_SCREENS" in os.environ:
                self.page.save_screenshot(os.environ["TACTUS_SCREENS"] + "/playground_phone.png")
        finally:
            self.page.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})


if __name__ == "__main__":
    if webdriver is None or shutil.which("chromedriver") is None or shutil.which("chromium") is None:
        print("skipped: needs chromium, chromium-driver and python3-selenium")
        sys.exit(77)
    Playground.tactus, Playground.site = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
    for test in ("reports_test.mjs", "offline_test.mjs", "playground_device_test.mjs"):
        subprocess.run(["node", HERE / test, Playground.site], check=True)
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
