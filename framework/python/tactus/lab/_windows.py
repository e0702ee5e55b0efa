# SPDX-License-Identifier: MIT
"""Simulated observers, and the windows through which they or a person answer: lines at a terminal, or pages in a browser of this computer."""

from __future__ import annotations

import contextlib
import http.server
import json
import math
import os
import queue
import secrets
import select
import sys
import threading
import time
from dataclasses import dataclass
from typing import Any, Callable, Dict, Optional, TextIO, Tuple

from ._analysis import Function, probability
from ._procedures import Draw
from ._protocol import ANSWERS, Answer, Trial
from ._stages import Marks, Moment, Silent

Hand = Callable[[], Answer]   # the answer of the hand or by OSC at this moment


class Aborted(Exception):
    """The end of a session before its last trial, by a person. It can be resumed."""


class Window:
    """The side of an experiment that participant and experimenter see; derived classes implement it. stop: takes all forces to zero [any thread]; set by the
    experiment."""

    stop: Callable[[], None] = staticmethod(lambda: None)
    now: Callable[[], Moment] = staticmethod(Silent().now)   # the clock of the experiment
    marks: Optional[Marks] = None                            # those that come through the window, if it takes any

    def show(self, text: str) -> None:
        """Shows a page, and returns when the participant has read it."""

    def say(self, text: str) -> None:
        """Shows a few words, such as the number of an interval, and goes on."""

    def ask(self, trial: Trial, level: float, keys: Dict[str, str], limit: float, hand: Hand) -> Answer:
        """Asks, and waits for the answer: one of `keys`, whose values are the keys of a keyboard, or a number for magnitude; None after `limit` (in s, 0
        without one). level: what is felt, in the unit of what varies. hand: the answer of the hand or by OSC, to be called regularly."""
        raise NotImplementedError

    def awaited(self, take: Callable[[], Answer], limit: float = 0.0, hand: Hand = lambda: None) -> Answer:
        """The first answer of the hand or from `take`, which gives None after a moment without any. None after the limit in s, 0 without one."""
        until = time.monotonic() + (limit or math.inf)
        while (answer := hand()) is None and (answer := take()) is None and time.monotonic() < until:
            pass
        return answer

    def report(self, state: Dict[str, Any]) -> None:
        """Shows the state of the experiment to the experimenter."""

    def close(self) -> None:
        """Shows that the experiment is over."""


@dataclass(frozen=True)
class Observer:
    """A simulated observer, whose answers depend only on its seed and the number of the trial. threshold, width, lapse: of its psychometric function, whose
    guess rate is that of the block; threshold and width are in the unit of what varies. For adjust and match, threshold is the level at which the observer is
    content, give or take `width` (standard deviation). For magnitude, the answer is gain * level^exponent, with a factor exp (noise * normal)."""

    threshold: float
    width: float
    lapse: float = 0.0
    function: Function = "logistic"
    gain: float = 10.0
    exponent: float = 1.0
    noise: float = 0.1
    seed: int = 1

    def answer(self, trial: Trial, level: float) -> Answer:
        """The answer to a trial; `level` is the one that is felt, which adjust and match change."""
        draw = Draw(self.seed, "observer", trial.number)
        task = trial.block.task
        if task == "magnitude":
            return float(self.gain * max(level, 0.0) ** self.exponent * math.exp(self.noise * draw.normal()))
        if task in ("adjust", "match"):
            off = level - (self.threshold + self.width * draw.normal())
            return "done" if abs(off) <= 0.5 * trial.block.step else "less" if off > 0.0 else "more"
        chance = float(probability(self.function, level, self.threshold, self.width, trial.block.guess_rate, self.lapse))
        return trial.expected if draw.uniform() < chance else next(answer for answer in ANSWERS[task] if answer != trial.expected)


class Simulated(Window):
    """An observer that needs no time."""

    def __init__(self, observer: Observer):
        self.observer = observer

    def ask(self, trial: Trial, level: float, keys: Dict[str, str], limit: float, hand: Hand) -> Answer:
        return self.observer.answer(trial, level)


class Terminal(Window):
    """Lines of text: an answer is its key or its name, then Enter; "stop" ends the session."""

    def __init__(self, source: TextIO = sys.stdin, out: TextIO = sys.stdout):
        self._source, self._out, self._held = source, out, b""

    def show(self, text: str) -> None:
        self.say(f"{text}\n(Enter goes on)")
        self.awaited(self._line)

    def say(self, text: str) -> None:
        print(text, file=self._out, flush=True)

    def ask(self, trial: Trial, level: float, keys: Dict[str, str], limit: float, hand: Hand) -> Answer:
        self.say(trial.question + (f" ({', '.join(f'{key}: {answer}' for answer, key in keys.items())})" if keys else ""))

        def take() -> Answer:
            line = self._line()
            answer = None if line is None else meant(line or "Enter", keys)
            if line is not None and answer is None:
                self.say("Give " + (f"one of {', '.join(keys.values())}" if keys else "a number"))
            return answer

        return self.awaited(take, limit, hand)

    def _line(self) -> Optional[str]:
        if b"\n" not in self._held:
            if select.select([self._source], [], [], 0.02)[0]:
                read = os.read(self._source.fileno(), 4096)
                if not read:
                    raise Aborted("the input has ended")
                self._held += read
            return None
        line, self._held = self._held.split(b"\n", 1)
        text = line.decode(errors="replace").strip()
        if text == "stop":
            raise Aborted("stopped at the terminal")
        return text


def meant(text: str, keys: Dict[str, str]) -> Answer:
    """The answer that a text gives: one of `keys` by its name, its key or its place (Pad0, Pad1, …); without any, a finite number, 0 or more. Else None."""
    if keys:
        return {**{f"Pad{i}": name for i, name in enumerate(keys)}, **{key: name for name, key in keys.items()}, **{name: name for name in keys}}.get(text)
    try:
        value = float(text.replace(",", "."))
    except ValueError:
        return None
    return value if math.isfinite(value) and value >= 0.0 else None


_HEAD = """<!DOCTYPE html><html lang="en"><meta charset="utf-8"><title>Experiment</title>
<style>body{background:#111;color:#eee;font:5vmin sans-serif;margin:0;text-align:center}button{font:inherit;margin:.3em;padding:.2em .8em}</style><script>
const $ = id => document.getElementById(id);
function post(place, data) { fetch(place, {method: "POST", body: JSON.stringify(data)}).catch(() => {}); }
async function poll(place, pause, draw) {
  try { draw(await (await fetch(place)).json()); } catch { $("text").textContent = "The connection is lost."; }
  setTimeout(poll, pause, place, pause, draw); }
</script>"""

_PARTICIPANT = _HEAD + """<style>#typed{min-height:1.5em;font-size:8vmin}
main{min-height:100vh;display:flex;flex-direction:column;justify-content:center;white-space:pre-line}</style>
<main><div id="text">…</div><div id="typed"></div><div id="keys"></div></main><script>
let now = {}, typed = "", held = {}, midi = false;
function send(key) { if (now.id !== undefined) post("answer", {id: now.id, key}); }
function press(key) {
  if (!now.number) return send(key);
  if (key === "Enter") { if (typed) send(typed); typed = ""; }
  else if (key === "Backspace") typed = typed.slice(0, -1); else if (/^[0-9.,]$/.test(key)) typed += key;
  $("typed").textContent = typed;
}
addEventListener("keydown", e => { if (e.repeat && !["+", "-"].includes(e.key) || e.key === "F11") return; e.preventDefault(); press(e.key); });
addEventListener("dblclick", () => document.documentElement.requestFullscreen().catch(() => {}));
function listen() { if (midi || !navigator.requestMIDIAccess) return; midi = true;   // the browser asks first, so only where MIDI keys are answers
  navigator.requestMIDIAccess().then(m => m.inputs.forEach(i => i.onmidimessage = e => {
    if ((e.data[0] & 0xf0) === 0x90 && e.data[2] > 0) press("Midi" + e.data[1]); })).catch(() => {}); }
function pads() { for (const pad of navigator.getGamepads ? navigator.getGamepads() : []) if (pad) pad.buttons.forEach((b, i) => {
  if (b.pressed && !held[pad.index + "/" + i]) press("Pad" + i); held[pad.index + "/" + i] = b.pressed; }); }
function draw(next) {
  if (next.id !== now.id) { typed = ""; $("typed").textContent = ""; }
  if (JSON.stringify(next) === JSON.stringify(now)) return;
  now = next; $("text").textContent = next.text; $("keys").replaceChildren();
  for (const [answer, key] of Object.entries(next.keys || {})) { if (key.startsWith("Midi")) listen();
    const b = document.createElement("button"); b.textContent = `${answer} (${key === " " ? "space" : key})`;
    b.onclick = () => send(key); $("keys").append(b); }
}
poll("state", 50, draw); setInterval(pads, 20);
</script></html>"""

_EXPERIMENTER = _HEAD + """<style>#stop{background:#c00;color:#fff;font-size:40px;width:100%;padding:.4em;margin:0 0 .5em}td{padding:.15em .8em .15em 0}
body{font-size:16px;text-align:left;padding:1em;box-sizing:border-box}progress{width:100%;height:1.5em}svg{background:#fff;width:100%;max-width:50em}</style>
<button id="stop">STOP</button><div id="text">waiting</div><progress id="bar" value="0" max="1"></progress><table id="facts"></table>
<svg id="plot" viewBox="0 0 600 200" preserveAspectRatio="none"></svg><table id="health"></table><script>
$("stop").onclick = () => post("stop");
addEventListener("keydown", e => { if (!e.repeat && e.key.length === 1 && e.key !== " ") post("mark", {name: "key", value: e.key}); });  // space presses STOP
function rows(table, facts) { table.replaceChildren(); for (const [k, v] of facts) {
  const r = table.insertRow(); r.insertCell().textContent = k; r.insertCell().textContent = typeof v === "number" ? +v.toFixed(3) : v; } }
function draw(s) {
  const r = s.report, h = r.health || {}, levels = r.history || []; $("text").textContent = s.stopped ? "STOPPED" : s.over ? "over" : s.text;
  if (!r.name) return;
  $("bar").max = r.done + r.left || 1; $("bar").value = r.done;
  rows($("facts"), [["experiment", `${r.name}, sub-${r.participant} ses-${r.session}`], ["block", `${r.block} (${r.kind})`],
    ["trial", `${r.trial}; ${r.left} left at most`], ["level", r.level], ["running fit", r.fit || "not yet"],
    ["last answer", r.last.number ? `${r.last.answer ?? "none"}, outcome ${r.last.outcome}, trial ${r.last.number}` : ""]]);
  rows($("health"), [...Object.entries(h).filter(([k]) => k !== "devices"), ...(h.devices || []).map(
    d => [d.role, `${d.profile}, ${d.is_connected ? "connected" : "NOT CONNECTED"}, age ${d.age} s, lost ${d.lost} ${d.trouble}`])]);
  const top = Math.max(...levels.map(x => x[0])), low = Math.min(...levels.map(x => x[0]));
  $("plot").innerHTML = levels.map(([level, outcome], i) => `<circle cx="${10 + 580 * i / Math.max(1, levels.length - 1)}" r="4"
    cy="${190 - 180 * (top > low ? (level - low) / (top - low) : 0.5)}" fill="${outcome ? "#06c" : "#fff"}" stroke="#06c"/>`).join("");
}
poll("report", 200, draw);
</script></html>"""


class Browser(Window):
    """Two pages on 127.0.0.1: a plain one for the participant, and one for the experimenter with progress, the running fit, the health of the devices,
    and STOP. Their addresses hold a secret, so that other users cannot guess them. Keys of pads are called Pad0, Pad1, …, those of MIDI keyboards
    Midi60, … Other pages on this computer may POST {"name": …, "value": …} to `participant` + "mark"."""

    def __init__(self, port: int = 0):
        """port: TCP port; 0: any free one."""
        self.marks: Marks = queue.Queue(10000)
        self._state: Dict[str, Any] = {"text": "Please wait."}
        self._report: Dict[str, Any] = {}
        self._given: "queue.Queue[Tuple[int, str]]" = queue.Queue(1000)
        self._id, self._stopped, self._over = 0, threading.Event(), False
        window, token = self, secrets.token_urlsafe(12)

        class Handler(http.server.BaseHTTPRequestHandler):
            protocol_version = "HTTP/1.1"

            def log_message(self, format: str, *args: Any) -> None:
                pass

            def do_GET(self) -> None:
                """The reply, without anything in it if the secret is wrong, or the host is not this computer."""
                host, length, parts = self.headers.get("Host", "").rsplit(":", 1)[0], self.headers.get("Content-Length", "0"), self.path.split("/")
                body = self.rfile.read(min(int(length), 4096)) if length.isdigit() else b""
                is_known = len(parts) == 3 and secrets.compare_digest(parts[1].encode(), token.encode()) and host in ("127.0.0.1", "localhost")
                status, text = window._reply(f"{self.command} {parts[2] or 'participant'}", body) if is_known else (404, "{}")
                self.send_response(status)
                self.send_header("Content-Type", "text/html; charset=utf-8" if text.startswith("<") else "application/json")
                self.send_header("Content-Length", str(len(text.encode())))
                self.send_header("Cache-Control", "no-store")
                self.end_headers()
                self.wfile.write(text.encode())

            do_POST = do_GET

        self._server = http.server.ThreadingHTTPServer(("127.0.0.1", port), Handler)
        self._server.daemon_threads = True
        self.participant = f"http://127.0.0.1:{self._server.server_address[1]}/{token}/"
        self.experimenter = self.participant + "experimenter"
        self._thread = threading.Thread(target=self._server.serve_forever, kwargs={"poll_interval": 0.05}, name="tactus.lab pages", daemon=True)
        self._thread.start()

    def _reply(self, request: str, body: bytes) -> Tuple[int, str]:
        """The status and the text that answer a request."""
        told = {**self._state, "report": self._report, "stopped": self._stopped.is_set(), "over": self._over}
        pages = {"GET participant": _PARTICIPANT, "GET experimenter": _EXPERIMENTER, "GET state": json.dumps(self._state), "GET report": json.dumps(told)}
        if request == "POST stop":
            self._stopped.set()
            self.stop()
        elif request in ("POST mark", "POST answer"):
            try:
                given = json.loads(body)
                if request == "POST mark":
                    self.marks.put_nowait((str(given["name"])[:1000], str(given.get("value", ""))[:1000], self.now()))
                else:
                    self._given.put_nowait((int(given["id"]), str(given["key"])[:100]))
            except (ValueError, TypeError, KeyError, AttributeError, OverflowError, RecursionError, queue.Full):
                return 400, "{}"
        elif request not in pages:
            return 404, "{}"
        return 200, pages.get(request, "{}")

    def show(self, text: str) -> None:
        self._asked(text, {"go on": " "}, more={"Enter": "go on"})

    def say(self, text: str) -> None:
        self._state = {"text": text}
        self._check()

    def ask(self, trial: Trial, level: float, keys: Dict[str, str], limit: float, hand: Hand) -> Answer:
        answer = self._asked(trial.question, keys, limit, hand)
        self._state = {"text": ""}
        return answer

    def _asked(self, text: str, keys: Dict[str, str], limit: float = 0.0, hand: Hand = lambda: None, more: Dict[str, str] = {}) -> Answer:
        self._id += 1
        self._state = {"text": text, "keys": keys, "id": self._id, "number": not keys}

        def take() -> Answer:
            self._check()
            with contextlib.suppress(queue.Empty):
                number, key = self._given.get(timeout=0.02)
                if number == self._id:
                    return more.get(key) or meant(key, keys)
            return None

        return self.awaited(take, limit, hand)

    def _check(self) -> None:
        if self._stopped.is_set():
            raise Aborted("STOP was pressed")

    def report(self, state: Dict[str, Any]) -> None:
        self._report = json.loads(json.dumps(state, default=str).replace("NaN", "null").replace("Infinity", "null"))

    def close(self) -> None:
        self._state, self._over = {"text": "The experiment is over. Thank you."}, True

    def end(self) -> None:
        """Closes the pages."""
        self._server.shutdown()
        self._server.server_close()
        self._thread.join()
