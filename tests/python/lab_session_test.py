# SPDX-License-Identifier: MIT
"""Sessions of tactus.lab: their journals, and how they go on after a crash; marks; windows; the commands; tables, which others read if they are there."""

import csv
import dataclasses
import io
import json
import math
import os
import pty
import signal
import socket
import struct
import subprocess
import sys
import threading
import tty
import unittest
import urllib.error
import urllib.request
from importlib.util import find_spec

import numpy as np
import tactus
from lab_protocol_test import block, protocol
from support import PROGRAM, ROOT, TestCase, drag, positions, why_not_live
from tactus import _messages, lab
from tactus.lab import _stages
from waiting import eventually

OBSERVER = lab.Observer(threshold=2.0, width=0.3)
NUMBERS = np.concatenate([np.random.default_rng(1).normal(0, 1e3, 40), [0.1, 1e-300, -0.0, 1e308, 5e-324, math.pi]])
TEXTS = ["", "wood", "ä µ", "a,b", 'say "hi"'] + [f"t{i}" for i in range(41)]


class Asked(lab.Simulated):
    """An observer, which may leave at a trial. A function of the trial, the keys and the hand may answer first."""

    def __init__(self, first=lambda *asked: None, observer=OBSERVER, leaves=0):
        super().__init__(observer)
        self.first, self.leaves = first, leaves

    def ask(self, trial, level, keys, limit, hand):
        if trial.number == self.leaves:
            raise lab.Aborted("enough")
        answer = self.first(trial, keys, hand)
        return super().ask(trial, level, keys, limit, hand) if answer is None else answer


def awaited(hand):
    """The answer of a hand, once it gives one."""
    found = []
    assert eventually(lambda: found or found.extend(filter(None, [hand()])) or found)
    return found[0]


class Case(TestCase):
    def session(self, made, window=None, **more):
        return lab.Experiment(made, more.pop("out", self.folder), window=window or Asked(), **more)

    def run_session(self, *given, **more):
        return self.session(*given, **more).run()

    def browser(self):
        made = lab.Browser()
        self.addCleanup(made.end)
        return made

    def receiver(self):
        made = lab.Receiver(0)
        self.addCleanup(made.close)
        return made

    def web(self, address, data=None, **headers):
        """The status and the text of a page, or of the reply to data that are sent there."""
        try:
            with urllib.request.urlopen(urllib.request.Request(address, data, headers), timeout=60) as reply:
                return reply.status, reply.read().decode()
        except urllib.error.HTTPError as why:
            return why.code, ""

    def rows(self, table, *names):
        return list(zip(*(table[name] for name in names)))

    def answers(self, data):
        return self.rows(data.trials, "number", "kind", "condition", "level", "intervals", "answer")


class Sessions(Case):
    made = protocol(block(procedure=lab.Staircase(start=4.0, steps=(1.0, 0.5), trials=30, tracks=2), practice=2, catch=0.1, break_every=10,
                          instructions="feel it"))

    def test_nothing_is_lost_and_the_order_stays_after_three_breaks_in_the_middle_of_a_line(self):
        before = b""
        for resume, number in ((False, 9), (True, 22), (True, 22)):
            data = self.run_session(self.made, Asked(leaves=number), resume=resume)
            self.assertEqual(data.trials.rows, number - 1)
            path = next(data.folder.glob("*journal.jsonl"))
            self.assertTrue(path.read_bytes().startswith(before))   # append-only
            with open(path, "ab") as file:   # as if the power had failed
                file.write(b'{"event": "trial", "numb')
            before = path.read_bytes()
        resumed, whole = self.run_session(self.made, resume=True), self.run_session(self.made, out=self.folder / "whole")
        self.assertEqual(self.answers(resumed), self.answers(whole))
        self.assertTrue(resumed.is_complete)
        self.assertEqual([resumed.turns(), list(resumed.events["trial_type"]).count("run")], [whole.turns(), 4])

    def test_a_session_never_replaces_another_and_goes_on_only_with_its_protocol_in_one_process(self):
        data = self.run_session(self.made, Asked(leaves=5))
        self.assertEqual((data.trials.rows, data.is_complete), (4, False))
        self.fails("lab/exists", self.run_session, self.made)
        self.fails("lab/protocol", self.run_session, protocol(block()), resume=True)
        own = next(self.folder.rglob("*_protocol.json"))
        own.unlink()   # as if the process had been killed before it wrote the file
        held = self.session(self.made, resume=True)
        self.fails("lab/busy", self.session, self.made, resume=True)
        self.assertTrue(held.run().is_complete)
        self.assertEqual(own.read_text(encoding="utf-8"), self.made.text())
        self.fails("lab/exists", self.run_session, self.made, resume=True)
        self.fails("lab/value", self.run_session, self.made, participant="../x")
        made = protocol(dataclasses.replace(block(), varies=lab.Varies(target="roughness")), graph="dry_wood")   # with levels above 1
        self.fails("lab/value", self.session, made, participant="03")
        self.fails("lab/journal", self.run_session, self.made, resume=True, participant="02")

    def test_a_session_goes_on_from_its_own_copy_of_a_protocol_with_relative_paths(self):
        study = self.folder / "study"
        study.mkdir()
        tactus.Graph("dry_wood").save(study / "own.json")
        made = protocol(lab.Block(name="a", task="2ifc", procedure=lab.Constant(levels=(0.2, 0.4), repeats=2), varies=lab.Varies(target="roughness")),
                        graph="own.json")
        made.save(study / "p.json")
        folder = self.run_session(lab.Protocol.load(study / "p.json"), Asked(leaves=2), stage=lab.Silent()).folder
        (study / "p.json").unlink()
        own = next(folder.glob("*_protocol.json"))
        again = lab.Protocol.load(own)
        self.assertIsNotNone(again.graph_of(again.all_conditions()[0]))
        self.run_session(again, stage=lab.Silent(), resume=True)
        self.assertTrue(lab.load(folder).is_complete)
        self.assertNotIn(str(self.folder), own.read_text(encoding="utf-8"))   # no path of this computer

    def test_answers_by_osc_that_are_none_or_come_early_do_not_count(self):
        answers, receiver = [], self.receiver()

        def first(trial, keys, hand):
            receiver.answers.put("xyz")
            receiver.answers.put(keys["yes"] if trial.number % 2 else "no")
            answers.append((hand(), hand()))
            receiver.answers.put("yes")   # for the next trial
            return answers[-1][1]
        receiver.answers.put("yes")
        data = self.run_session(protocol(block("see", "yes_no", lab.Constant(levels=(2.0,), repeats=4))), Asked(first), receiver=receiver)
        self.assertEqual(answers, [(None, "yes"), (None, "no")] * 2)
        self.assertTrue(data.is_complete)

    def test_a_level_that_the_graph_refuses_ends_a_simulated_adjustment(self):
        class Narrow(lab.Silent):
            def show(self, condition, target, level):
                if level > 2.5:
                    _messages.fail("param/range", "/", "too large", "give less")
        made = protocol(block("set", "adjust", lab.Constant(levels=(1.0,), repeats=1), step=0.25))
        data = self.run_session(made, Asked(observer=lab.Observer(threshold=9.0, width=0.0)), stage=Narrow())
        self.assertEqual(list(data.chosen("set")["outcomes"]), [2.5])

    def test_a_changed_line_is_an_error_not_a_loss(self):
        self.run_session(self.made)
        path = next(self.folder.rglob("*journal.jsonl"))
        lines = path.read_bytes().split(b"\n")
        for change in (lambda: lines[:9] + [lines[9][:20]] + lines[10:], lambda: [b"{}"] + lines[1:], lambda: [b"\xff"]):
            path.write_bytes(b"\n".join(change()))
            self.fails("lab/journal", lab.load, path.parent)

    def test_adjusting_matching_and_magnitudes(self):
        made = protocol(block("set", "adjust", lab.Constant(levels=(1.0, 3.0), repeats=2), step=0.25), block("like", "match", step=0.5),
                        block("how", "magnitude", lab.Constant(levels=(1.0, 4.0, 16.0), repeats=6)))
        data = self.run_session(made, lab.Simulated(lab.Observer(threshold=2.0, width=0.0, gain=3.0, exponent=0.5, noise=0.05)))
        for name, count in (("set", 4), ("like", 12)):
            self.assertEqual(list(data.chosen(name)["outcomes"]), [2.0] * count)
        law = data.fit("how")
        self.assertTrue(law.exponent_interval.low < 0.5 < law.exponent_interval.high and abs(law.gain - 3.0) < 0.3, law)
        self.fails("lab/data", data.fit, "set")
        self.fails("lab/unknown", data.fit, "none")

    def test_detection_uses_catch_trials_as_noise(self):
        found = self.run_session(protocol(block("see", "yes_no", lab.Constant(levels=(2.0,), repeats=200), catch=0.5)),
                                 lab.Simulated(lab.Observer(threshold=1.0, width=1.0, function="normal"))).detection()
        self.assertTrue(found.d_prime_interval.low < 2.0 < found.d_prime_interval.high, found)   # z (Phi (1)) - z (Phi (-1))
        self.assertTrue(found.criterion_interval.low < 0.0 < found.criterion_interval.high, found)

    def test_tables_have_times_and_what_others_must_know(self):
        data = self.run_session(self.made, device={"stylus": "hid:auto"})
        ends = "beh.json", "beh.tsv", "events.json", "events.tsv", "journal.jsonl", "protocol.json"
        self.assertEqual(sorted(p.name for p in data.folder.iterdir()), [f"sub-01_ses-01_task-tried_{end}" for end in ends])
        self.assertTrue((self.folder / "dataset_description.json").exists())
        levels, about = (json.loads((data.folder / f"{data.stem}_{name}.json").read_text()) for name in ("beh", "events"))
        self.assertEqual((levels["level"]["Units"], about["seed"], about["onset"]["Units"], about["protocol_sha256"]), ("N", 1, "s", self.made.hash()))
        self.assertEqual((set(about["versions"]), about["devices"]), ({"tactus", "python", "numpy"}, {"stylus": "hid:auto"}))
        onset = np.asarray(data.events["onset"])
        self.assertTrue((np.diff(onset) >= 0.0).all() and onset[0] >= 0.0)
        self.same_bits(np.asarray(data.events["wall"]) > 1.7e9, np.ones(data.events.rows))

    def test_marks_and_answers_come_by_osc_and_wrong_packets_do_nothing(self):
        receiver = self.receiver()

        def send(*packets):
            with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as own:
                for packet in packets:
                    own.sendto(packet, ("127.0.0.1", receiver.port))

        def first(trial, keys, hand):
            if trial.number == 2:
                send(*(_stages.osc("/tactus/answer", *words) for words in (("first", "wrong"), ("first",), ("second", receiver.token))))
                return awaited(hand)
        send(b"x", b"/tactus/mark\0\0\0\0,q\0\0", b"/tactus/mark\0\0\0\0,s\0\0", b"#bundle\0" + b"\0" * 12, b"\xff" * 64, _stages.osc("/tactus/other", "a"))
        self.assertTrue(lab.mark("blink", "left", receiver.port))
        data = self.run_session(protocol(), Asked(first), receiver=receiver)
        self.assertIn(("blink", "left"), self.rows(data.events, "trial_type", "value"))
        self.assertEqual(data.trials["answer"][1], "second")
        self.assertFalse(lab.mark("nobody", port=1, wait=0.05))
        self.assertEqual(_stages.read_osc(_stages.osc("/a", "text", 3, 0.5)), ("/a", ["text", 3, 0.5]))

    def test_marks_come_through_the_page_of_the_participant(self):
        """As docs/examples/lab/jspsych_marks.html sends them: text, from another origin."""
        page = (ROOT / "docs/examples/lab/jspsych_marks.html").read_text(encoding="utf-8")
        self.assertIn('fetch(participant + "mark", {method: "POST", mode: "no-cors", body: JSON.stringify({name, value', page)
        browser, window = self.browser(), Asked()
        window.marks = browser.marks
        for status, body in ((200, '{"name": "picture", "value": "hölzern"}'.encode()), *((400, wrong) for wrong in
                             (b"", b"[]", b"{}", b"\xff", b'{"value": "x"}', b"3"))):
            self.assertEqual(self.web(browser.participant + "mark", body, **{"Content-Type": "text/plain;charset=UTF-8", "Origin": "null"})[0], status, body)
        data = self.run_session(protocol(), window)
        self.assertEqual([row for row in self.rows(data.events, "trial_type", "value") if row[0] == "picture"], [("picture", "hölzern")])

    def test_triggers_are_bytes_on_a_serial_line(self):
        ours, theirs = pty.openpty()
        for end in (ours, theirs):
            self.addCleanup(os.close, end)
        tty.setraw(ours)
        made = protocol(block(procedure=lab.Constant(levels=(1.0,), repeats=3)),
                        triggers=lab.Triggers(port=os.ttyname(theirs), codes={"trial": 1, "stimulus": 2, "answer": 255}))
        data = self.run_session(made)
        self.assertEqual(os.read(ours, 100), b"\x01\x02\x02\xff" * 3)
        self.assertEqual([code for code in data.events["code"] if not math.isnan(code)], [1, 2, 2, 255] * 3)
        self.fails("lab/triggers", self.session, protocol(triggers=lab.Triggers(port="/dev/null")), participant="02")

    def test_lines_at_a_terminal_are_answers_and_a_time_limit_ends_a_question(self):
        (read, write), said = os.pipe(), io.StringIO()
        with os.fdopen(read) as source, os.fdopen(write, "wb", 0) as typed:
            terminal, asked = lab.Terminal(source, said), (lab.Plan(protocol()).step, 1.0, {"first": "1"})
            typed.write(b"\n5\n1\nsecond\nstop\n")
            data = self.run_session(protocol(instructions="welcome"), terminal)
            self.assertEqual((data.trials["answer"], data.is_complete), (["first", "second"], False))
            self.assertRegex(said.getvalue(), "(?s)welcome.*Give one of 1, 2")
            self.assertIsNone(terminal.ask(*asked, 0.001, lambda: None))
            self.assertEqual(terminal.ask(*asked, 0.0, lambda: "first"), "first")
            typed.close()
            self.assertRaises(lab.Aborted, terminal.ask, *asked, 0.0, lambda: None)

    def test_a_participant_answers_in_a_browser_and_the_experimenter_sees_it(self):
        browser, found, asked = self.browser(), [], []
        made = protocol(block("a", procedure=lab.Constant(levels=(1.0, 3.0), repeats=2), instructions="press a key"),
                        block("b", "magnitude", lab.Constant(levels=(2.0,), repeats=1)))
        thread = threading.Thread(target=lambda: found.append(self.run_session(made, browser)))
        thread.start()

        def answer():
            state = json.loads(self.web(browser.participant + "state")[1])
            if "id" in state and state["id"] not in asked:
                asked.append(state["id"])
                for key in ("q", "3.5" if state["number"] else " " if state["keys"] == {"go on": " "} else "Pad1" if len(asked) == 3 else "2"):
                    self.web(browser.participant + "answer", json.dumps({"id": state["id"], "key": key}).encode())
            return not thread.is_alive()
        self.assertTrue(eventually(answer))
        thread.join()
        self.assertEqual(found[0].trials["answer"], ["second"] * 4 + ["3.5"])
        report = json.loads(self.web(browser.participant + "report")[1])
        self.assertEqual((report["report"]["block"], report["report"]["done"], report["over"]), ("b", 4, True))
        for text, page in (("STOP", browser.experimenter), ('post("mark"', browser.experimenter), ('poll("state"', browser.participant)):
            self.assertIn(text, self.web(page)[1])

    def test_stop_aborts_and_strangers_see_nothing(self):
        browser, stopped = self.browser(), []
        experiment = self.session(protocol(), browser)
        browser.stop = lambda: stopped.append(1)
        top = browser.participant.rsplit("/", 2)[0]
        for address in (top + "/", top + "/wrong/", top + "/wrong/state", browser.participant + "x"):
            self.assertEqual(self.web(address)[0], 404, address)
        self.assertEqual(self.web(browser.participant, Host="evil.example")[0], 404)
        for body in (b"", b"[]", b'{"id": "x", "key": 1}', b"\xff"):
            self.assertEqual(self.web(browser.participant + "answer", body)[0], 400, body)
        self.web(browser.participant + "stop", b"")
        self.assertFalse(experiment.run().is_complete)
        self.assertEqual(stopped, [1])


@unittest.skipIf(why_not_live(), why_not_live())
class OnDevices(Case):
    """A simulated hand strokes a preset. The first two marks come before the graph plays."""

    made = lab.Protocol(name="wood", graph="dry_wood", devices={"stylus": "gesture:circle"}, conditions=[lab.Condition(name="dry")], blocks=[
            lab.Block(name="a", task="2ifc", procedure=lab.Staircase(start=0.9, steps=(0.2,), low=0.0, high=1.0, trials=3),
                      varies=lab.Varies(target="roughness", standard=0.1, rest=0.0), interval=0.02, gap=0.01)])

    def test_a_session_plays_marks_ticks_and_its_log_replays(self):
        data = self.run_session(self.made, stage=lab.Live(self.made, str(self.folder / "log.jsonl"), "off"))
        ticks = np.asarray(data.events["tick"], dtype=float)[2:]
        self.assertTrue((np.diff(ticks) >= 0.0).all() and ticks[-1] > ticks[0], ticks)
        self.assertEqual((set(data.header["graphs"]), data.header["rates_hz"]), ({"dry"}, {"dry": 4000.0}))
        log = tactus.read_log(self.folder / "log.jsonl")
        wall, monotonic = (np.asarray(data.events[key], dtype=float)[2:] for key in ("wall", "monotonic"))
        self.assertTrue((wall >= log.wall - 1.0).all() and (monotonic >= log.monotonic).all())
        self.assertGreaterEqual([event.kind for event in log.events].count("turn"), 6)   # each interval and each rest
        self.assertGreater(len(tactus.replay(self.folder / "log.jsonl")["t"]), ticks[0])   # reports_test.py compares it with `tactus render`

    def test_a_newcomers_experiment_is_killed_three_times_and_loses_nothing(self):
        """The example of the page: 2 down, 1 up, keyboard, simulated hand. Killed while it waits for an answer."""
        example = ROOT / "docs/examples/lab/keyboard.py"

        def run(out, first, end):
            """Gives the answers from trial `first` on, before `end`, and kills the program when it asks for that one, if it does."""
            with subprocess.Popen([sys.executable, "-B", "-u", str(example), str(out), *(["--resume"] if first > 1 else [])], stdin=subprocess.PIPE,
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE) as program:
                said = b""
                for line in ([b""] if first == 1 else []) + [b"1" if trial % 3 else b"2" for trial in range(first, end)]:   # the same ones in each run
                    program.stdin.write(line + b"\n")
                program.stdin.flush()
                while said.count(b"Which one was stronger?") <= end - first and (byte := program.stdout.read(1)):
                    said += byte
                if end <= 24:
                    program.kill()
                return program.wait(), (said + program.stdout.read()).decode(), program.stderr.read()

        out, whole = self.folder / "killed", self.folder / "whole"
        for first, end in ((1, 4), (4, 5), (5, 17)):
            self.assertEqual(run(out, first, end)[0], -signal.SIGKILL)
            self.assertEqual(lab.load(out / "sub-01/ses-01/beh").trials.rows, end - 1)
        for folder, first in ((out, 17), (whole, 1)):
            code, said, problem = run(folder, first, 25)
            self.assertEqual(code, 0, problem)
            self.assertRegex(said, r"24 trials, complete\nthreshold [0-9.]+ \(95 % ")
        self.assertEqual(*(self.answers(lab.load(folder / "sub-01/ses-01/beh")) for folder in (out, whole)))
        self.assertEqual(len(list(out.rglob("*_log.jsonl"))), 4)   # none replaces another

    def rests(self, levels, rest=100.0, **guard):
        """A protocol with two walls, in which a tool rests 2 mm deep."""
        (self.folder / "rests.csv").write_text("t,x,y,z\n0,0,0,-0.002\n600,0,0,-0.002\n", encoding="utf-8")
        for name, kind in (("plane", "deform.plane"), ("coupled", "coupling.virtual")):
            (self.folder / f"{name}.json").write_text(json.dumps({
                "format": "tactus-graph", "version": 2, "rate_hz": 1000, "devices": {"stylus": {"driver": "sim", "mass": 0.1, "damping": 3.0, "guard": guard}},
                "nodes": {"hand": {"type": "device.position", "role": "stylus"}, "wall": {"type": kind, "params": {"stiffness": 500.0}},
                          "motor": {"type": "device.force", "role": "stylus"}}, "wires": ["hand.position -> wall.position", "wall.force -> motor.force"]}))
        return lab.Protocol(name="wall", folder=str(self.folder), devices={"stylus": f"trace:{self.folder}/rests.csv"}, conditions=[
            lab.Condition(name="a", graph="plane.json"), lab.Condition(name="b", graph="coupled.json")], blocks=[
                lab.Block(name="w", task="2ifc", interval=0.1, gap=0.1, varies=lab.Varies(target="wall.stiffness", standard=500.0, rest=rest),
                          procedure=lab.Constant(levels=levels, repeats=2))])

    def test_what_a_guard_does_is_a_column_of_the_trial(self):
        made = self.rests((500.0,), 500.0, max_force=0.5)
        stage = lab.Live(made, None, "off")

        def first(trial, keys, hand):
            assert trial.number > 1 or eventually(lambda: stage.wait(0.0) or "run/clipped" in stage._seen)
        data = self.run_session(made, Asked(first), stage=stage)
        self.assertEqual((data.trials["guard"][0], data.trials["guard_count"][0]), ("run/clipped", 1))

    def test_switching_a_stimulus_never_steps_the_force(self):
        made = self.rests((1000.0, 2000.0))
        self.assertTrue(self.run_session(made, stage=lab.Live(made, str(self.folder / "log.jsonl"), "off")).is_complete)
        force = tactus.replay(self.folder / "log.jsonl", record=["motor.applied"])["motor.applied"][20:, 2]   # the tool begins in the wall
        self.assertGreater(np.ptp(force), 3.0)                      # from 0 to 4 N
        self.assertLess(np.abs(np.diff(force)).max(), 0.7, force)   # in a tick of 1 ms: 4 N take 10 ms, along a cosine

    def test_an_emergency_stop_ends_the_session_which_can_be_resumed(self):
        window = Asked(lambda trial, keys, hand: window.stop() if trial.number == 2 else None, lab.Observer(threshold=0.3, width=0.1))
        self.fails("lab/stopped", self.run_session, self.made, window, stage=lab.Live(self.made, None, "off"))
        data = self.run_session(self.made, stage=lab.Live(self.made, None, "off"), resume=True)
        self.assertEqual((data.is_complete, data.trials.rows), (True, 3))

    def test_the_hand_itself_answers(self):
        made = dataclasses.replace(self.made, hand={"first": lab.HandAnswer(port="motor.force.x", above=-1e9)})
        data = self.run_session(made, Asked(lambda trial, keys, hand: awaited(hand)), stage=lab.Live(made, None, "off"))
        self.assertEqual(set(data.trials["answer"]), {"first"})


@unittest.skipUnless(PROGRAM, "the program is not built")
class Commands(Case):
    def test_an_experiment_runs_and_tells_its_threshold(self):
        Sessions.made.save(self.folder / "p.json")
        given = "p.json", "--observer", "threshold=2,width=0.3"
        for status, said, words in ((0, r"complete\nmain, graph: threshold [0-9.]+ N \(95 % ", (*given, "--packed-log")), (1, "--resume", given),
                                    (2, "threshold=x", (*given[:2], "threshold=x")), (2, "file", ()), (0, "--resume", ("--help",))):
            self.assertRegex(self.ran("experiment", *words, "--osc", "off", status=status), said)

    def test_a_mark_without_an_experiment_is_an_error_and_without_the_package_one_sentence_names_it(self):
        self.ran("mark", "x", "--osc", "1", status=1)
        receiver = self.receiver()
        self.ran("mark", "--osc", receiver.port, "--", "blink", "-left")
        self.assertEqual(receiver.marks.get(timeout=60)[:2], ("blink", "-left"))
        self.assertEqual(self.ran("mark", "x", status=2, PYTHONPATH=str(self.folder)),
                         "error: the Python package tactus is not installed; install it, or set PYTHONPATH to the folder python of the build\n")

    def test_the_module_prints_its_schema_and_writes_tables_again(self):
        data = self.run_session(Sessions.made)
        events = data.folder / f"{data.stem}_events.tsv"
        before = events.read_bytes()
        events.unlink()
        shape, tables = (self.ran("-m", "tactus.lab", *words, program=sys.executable) for words in (["schema"], ["tables", data.folder, "--to", "mat"]))
        self.assertEqual(json.loads(shape), lab.schema())
        self.assertIn("_beh.mat", tables)
        self.assertEqual(events.read_bytes(), before)


class Writers(TestCase):
    def setUp(self):
        self.table = lab.Table({"t": np.arange(46) / 1000.0, "motor.force.x": NUMBERS, "name": TEXTS}, {"t": "s", "motor.force.x": "N"},
                               {"graph": "abc"}, 1000.0)

    def test_text_keeps_every_bit_and_has_a_sidecar(self):
        for end, separator in (("csv", ","), ("tsv", "\t")):
            self.table.write(self.folder / f"x.{end}")
            with open(self.folder / f"x.{end}", encoding="utf-8", newline="") as file:
                rows = list(csv.reader(file, delimiter=separator))
            self.assertEqual(rows[0], list(self.table))
            self.same_bits([float(row[1]) for row in rows[1:]], NUMBERS)
            self.assertEqual([row[2] for row in rows[1:]], TEXTS)
            self.assertEqual(json.loads((self.folder / "x.json").read_text()),
                             {"SamplingFrequency": 1000.0, "graph": "abc", "t": {"Units": "s"}, "motor.force.x": {"Units": "N"}})
        lab.Table({"a": [math.nan, None, 1.5]}).write(self.folder / "n.tsv")
        self.assertEqual((self.folder / "n.tsv").read_text(), "a\nn/a\nn/a\n1.5\n")

    @unittest.skipUnless(find_spec("h5py"), "h5py is not installed")
    def test_hdf5_is_read_by_h5py(self):
        import h5py
        self.table.write(self.folder / "x.h5")
        with h5py.File(self.folder / "x.h5") as file:
            self.same_bits(file["motor.force.x"][()], NUMBERS)
            self.assertEqual([v.decode() for v in file["name"][()]], TEXTS)
            self.assertEqual(file["t"].attrs["units"], "s")

    @unittest.skipUnless(find_spec("scipy"), "scipy is not installed")
    def test_mat_is_read_by_scipy(self):
        import scipy.io
        self.table.write(self.folder / "x.mat")
        read = scipy.io.loadmat(self.folder / "x.mat", chars_as_strings=True)
        self.same_bits(read["motor_force_x"][:, 0], NUMBERS)
        self.assertEqual([str(cell[0]) if cell.size else "" for cell in read["name"][:, 0]], TEXTS)
        self.assertEqual(json.loads(str(read["about"][0]))["columns"]["motor_force_x"], "motor.force.x")
        lab.Table({"a.b": [1.0], "a_b": [2.0], "3": [3.0], "x" * 80: [4.0]}).write(self.folder / "y.mat")
        self.assertEqual({k: float(v[0, 0]) for k, v in scipy.io.loadmat(self.folder / "y.mat").items() if not k.startswith("__") and k != "about"},
                         {"a_b": 1.0, "a_b_2": 2.0, "x3": 3.0, "x" * 59: 4.0})

    @unittest.skipUnless(find_spec("pyxdf"), "pyxdf is not installed")
    def test_xdf_is_read_by_pyxdf(self):
        import pyxdf
        self.table.write(self.folder / "x.xdf")
        streams, _ = pyxdf.load_xdf(str(self.folder / "x.xdf"), synchronize_clocks=False, dejitter_timestamps=False)
        by_type = {stream["info"]["type"][0]: stream for stream in streams}
        self.same_bits(by_type["Haptics"]["time_series"][:, 1], NUMBERS)
        self.same_bits(by_type["Haptics"]["time_stamps"], self.table["t"])
        self.assertEqual([row[0] for row in by_type["Markers"]["time_series"]], TEXTS)

    def test_xdf_has_the_chunks_of_its_specification(self):
        self.table.write(self.folder / "x.xdf")
        data = (self.folder / "x.xdf").read_bytes()
        self.assertEqual(data[:4], b"XDF:")
        at, tags = 4, []
        while at < len(data):
            self.assertEqual(data[at], 8)
            length, tag = struct.unpack_from("<QH", data, at + 1)
            tags.append((tag, struct.unpack_from("<I", data, at + 11)[0] if tag > 1 else 0))
            if tags[-1] == (3, 1):
                count = struct.unpack_from("<Q", data, at + 16)[0]
                rows = np.frombuffer(data, dtype=[("flag", "u1"), ("time", "<f8"), ("v", "<f8", 2)], count=count, offset=at + 24)
                self.same_bits(rows["v"][:, 1], NUMBERS)
            at += 9 + length
        self.assertEqual((at, tags), (len(data), [(1, 0), (2, 1), (3, 1), (6, 1), (2, 2), (3, 2), (6, 2)]))
        lab.Table({"t": [0.0, 1.0], "name": ["a", "b"], "value": ["c", "d"], "level": [1, 2]}).write(self.folder / "y.xdf")
        self.assertEqual((self.folder / "y.xdf").read_bytes().count(b"<channel_count>1<"), 2)   # libxdf reads one text of a sample

    def test_records_of_a_run_become_a_table(self):
        run = drag().render(feed={"drag.position": positions(50), "drag.normal_force": 1.0}, record=["drag.force", "drag.state"])
        table = lab.table_of(run, {"device": "none"})
        self.assertEqual(list(table), ["t", "drag.force.x", "drag.force.y", "drag.force.z", "drag.state"])
        self.same_bits(table["drag.force.y"], run["drag.force"][:, 1])
        self.assertEqual((table.units["drag.force.y"], table.rate_hz), ("N", 1000.0))
        self.assertIn("drag.state", table._repr_html_())

    def test_wrong_tables_are_errors_and_leave_the_old_file(self):
        self.table.write(self.folder / "x.csv")
        before = (self.folder / "x.csv").read_bytes()
        self.fails("lab/format", self.table.write, self.folder / "x.docx")
        self.fails("lab/shape", lab.Table, {"a": [1.0], "b": [1.0, 2.0]})
        self.fails("lab/no_times", lab.Table({"a": [1.0]}).write, self.folder / "x.xdf")
        self.assertEqual((self.folder / "x.csv").read_bytes(), before)
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["x.csv", "x.json"])


if __name__ == "__main__":
    unittest.main()
