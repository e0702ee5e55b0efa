#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks the results of in_guest.sh in a folder: check.py FOLDER PROGRAM SOURCE

The program's counts must match the device's log. Each force that the device received is assigned to a tick by the sequence
number of the report that it answers. After encoding, it must match the force that `tactus render` computes for the recorded
positions, bit for bit."""
import csv
import json
import math
import os
import re
import subprocess
import sys
import tempfile

folder, program, source = sys.argv[1:4]
failures = []


def check(holds, what):
    print(("ok      " if holds else "FAILED  ") + what)
    if not holds:
        failures.append(what)


def text(name):
    with open(os.path.join(folder, name), encoding="utf-8") as f:
        return f.read()


def rows_of_fake(log):
    """The log of fake-device, as rows of the board's log."""
    number = lambda report, at: int.from_bytes(report[at:at + 4], "little", signed=True)
    for line in log.splitlines():
        step, what, report = line.split(" ", 2)
        if what == "!":
            continue
        report = bytes.fromhex(report)
        where = 12 if what == ">" else 8
        three = [str(number(report, where + 4 * i)) for i in range(3)]
        if what == ">":
            yield ["in", "good", str(number(report, 4)), *three]
        else:
            yield ["out", "driven" if report[2] & 1 else "other" if any(report[2:60]) else "neutral", str(number(report, 4)), *three, str(1e-3 * int(step))]


class Board:
    """The log of a board: what it sent and received, in order."""

    def __init__(self, name):
        if os.path.exists(os.path.join(folder, name + ".fake.log")):
            self.rows = list(rows_of_fake(text(name + ".fake.log")))
        else:
            self.rows = [line.split(",") for line in text(name + ".board.csv").splitlines()]
        self.sent = [(r[1], int(r[2])) for r in self.rows if r[0] == "in"]
        self.place = {tuple(int(v) for v in r[3:6]): int(r[2]) for r in self.rows if r[0] == "in"}
        self.heard = [(r[1], int(r[2]), tuple(int(v) for v in r[3:6]), float(r[6])) for r in self.rows if r[0] == "out" and len(r) == 7]
        self.broken = sum(1 for r in self.rows if r[0] == "out" and (len(r) != 7 or r[1] in ("sum", "other")))


def play_rows(name):
    with open(os.path.join(folder, name + ".play.csv"), newline="", encoding="utf-8") as f:
        return list(csv.DictReader(f))


def counted(name):
    """The program's own summary."""
    said = text(name + ".play.err")
    number = lambda pattern: int((re.search(pattern, said) or [0, 0])[1])
    return {"reports": number(r"tactus_board\): (\d+) reports"), "taken": number(r"reports, (\d+) taken"), "lost": number(r"taken, (\d+) lost"),
            "refused": number(r"lost, (\d+) refused"),
            "short": number(r"(\d+) too short"), "long": number(r"(\d+) too long"), "mark": number(r"(\d+) wrong mark"),
            "restarts": number(r"(\d+) out of order"), "dropped": number(r"(\d+) replaced by newer"),
            "departures": 1 if "unplugged once" in said else number(r"unplugged (\d+) times"),
            "no room": number(r"(\d+) dropped for lack of room")}


def expected(sent, reports, with_short):
    """The counts that the program must report after this many reports. Newer kernels do not pass on short reports."""
    out = {"lost": 0, "restarts": 0, "short": 0, "long": 0, "mark": 0}
    kinds = {"short": "short", "oversized": "long", "malformed": "mark"}
    last = None
    for how, n in [s for s in sent if s[0] != "dropped" and (with_short or s[0] != "short")][:reports]:
        if how in kinds:
            out[kinds[how]] += 1
            continue
        if last is not None and n > last:
            out["lost"] += n - last - 1
        elif last is not None and n < last:
            out["restarts"] += 1
        last = n
    return out


def micro(newton):
    """A force in N, encoded as in the profile: s32, in units of 1 uN."""
    return int(math.floor(newton / 1e-6 + 0.5))


def closed_loop(name):
    board, rows, said = Board(name), play_rows(name), counted(name)
    check(board.broken == 0, f"{name}: every report to the board had the right length and checksum")

    # The tick that answers a report used the position in that report.
    ticks = []
    for row in rows:
        place = tuple(round(float(row["hand.position." + c]) * 1e9) for c in "xyz")
        ticks.append(board.place.get(place, 0))

    applied = [tuple(micro(float(row["motor.applied." + c])) for c in "xyz") for row in rows]   # on the previous tick
    k, compared, wrong = 0, 0, 0
    for kind, echo, force, _ in board.heard:
        if kind != "driven" or echo == 0 or not any(force):
            continue   # while a reading is not valid, the graph keeps the previous position, which identifies no report; there is no force then
        found = next((i for i in range(k, len(rows) - 1) if ticks[i] == echo and applied[i + 1] == force), None)
        if found is None:
            wrong += ticks.count(echo) > 0 and echo not in ticks[-2:]   # answers at the end of the run are not recorded
            continue
        k, compared = found, compared + 1
    check(wrong == 0 and compared > 0, f"{name}: {compared} forces match the guard's output by sequence number, {wrong} do not")
    check(any(abs(f[2]) > 1e5 for f in applied), f"{name}: there was a force on the tool")

    same_offline(name, rows)
    full = sum(1 for i in range(len(rows) - 1) if all(rows[i]["motor.force." + c] == rows[i + 1]["motor.applied." + c] for c in "xyz"))
    print(f"        {said}; {full} ticks with the full force")
    return board, said, full


def same_offline(name, rows):
    """The same positions again, offline."""
    with tempfile.TemporaryDirectory() as scratch:
        trace, again = os.path.join(scratch, "trace.csv"), os.path.join(scratch, "again.csv")
        with open(trace, "w", encoding="utf-8") as f:
            f.write("t,x,y,z\n")
            for row in rows:
                f.write(",".join([row["t"]] + [row["hand.position." + c] for c in "xyz"]) + "\n")
        subprocess.run([program, "render", os.path.join(source, "graphs/dry_wood.json"), "--rate", "1000", "--device", "stylus=trace:" + trace,
                        "--record", "motor.force", "--out", again], check=True)
        with open(again, newline="", encoding="utf-8") as f:
            offline = list(csv.DictReader(f))
    same = sum(all(a["motor.force." + c] == b["motor.force." + c] for c in "xyz") for a, b in zip(rows, offline))
    check(same == len(rows) == len(offline) and same > 500, f"{name}: {same} of {len(rows)} ticks have the same force offline and live, bit for bit")


board, said, full = closed_loop("loop")
check(said["refused"] == 0 and said["taken"] > 300, f"loop: {said['taken']} reports decoded")
check(full > 0, "loop: after the ramp the device gets the graph's force unchanged")
check(said["lost"] == 0, "loop: no report is lost")
check("which tick the run directly" in text("loop.play.err"), "loop: the tick thread reads the board itself")

board, said, full = closed_loop("fake_loop")
check(said["refused"] == said["lost"] == 0 and said["taken"] > 300 and full > 0, f"fake_loop: {said['taken']} reports of fake-device decoded")
check(" 0 refused, 0 stray bytes" in text("fake_loop.fake.txt"), "fake_loop: fake-device refused no report")

heard = Board("fake_faults").heard
pushed = [h for h in heard if h[0] == "driven" and any(h[2])]
gap = max((b[3] - a[3] for a, b in zip(pushed, pushed[1:])), default=0.0)
check(len(pushed) > 1000 and gap > 0.5, f"fake_faults: fake-device is pushed {len(pushed)} times, and not for {gap:.2f} s, in which it is away")
check(heard[-1][0] == "neutral" and heard[-1][3] - pushed[-1][3] < 0.15, "fake_faults: once its player is killed, the last report is neutral")
check("fake/hidraw" in text("fake_dualsense.txt"), "a DualSense of fake-device is refused, as the kernel's driver refuses it")
check("play on it: --device ROLE=hid:woodenhaptics_usb" in text("fake_woodenhaptics.txt"), "fake-device is a WoodenHaptics arm")

if os.path.exists(os.path.join(folder, "usb.board.csv")):
    board, said, _ = closed_loop("usb")
    check(said["refused"] == 0 and said["taken"] > 300, f"usb: {said['taken']} reports decoded")
    taken = gaps = 0   # among the reports that the program took
    for kind, _ in board.sent:
        taken += kind == "good"
        gaps += kind == "dropped" and taken > 0
        if taken == said["taken"]:
            break
    check(said["lost"] == gaps, f"usb: {said['lost']} counted as lost, {gaps} dropped by the bus")
else:
    print("skipped: this kernel has no USB gadgets")

board, said, _ = closed_loop("faults")
should = expected(board.sent, said["taken"] + said["refused"], said["short"] > 0)
for what, number in should.items():
    check(said[what] == number and (number > 0 or what == "short"), f"faults: {what}: {said[what]} counted, {number} by the device")

board, said, _ = closed_loop("unplug")
check(said["departures"] == 1, "unplug: the board went away once")
came_back = next(i for i, r in enumerate(board.rows) if r[0] == "plugged")
after = [(r[1], tuple(int(v) for v in r[3:6])) for r in board.rows[came_back:] if r[0] == "out" and len(r) == 7]
driven = [f for kind, f in after if kind == "driven"]
check(len(driven) > 10, f"unplug: the board is driven again with {len(driven)} reports")
first, most = max(abs(v) for v in driven[0]), max(abs(v) for f in driven for v in f)
check(first < most / 4, f"unplug: force starts at {first} uN and rises to {most}")

for signal in ("INT", "TERM", "KILL", "SEGV"):
    heard = Board(signal).heard
    pushed = [h for h in heard if h[0] == "driven" and any(h[2])]
    check(len(pushed) > 10, f"{signal}: the board received forces")
    check(heard[-1][0] == "neutral", f"{signal}: the last report to the board is neutral")
    if signal in ("INT", "TERM"):
        last = [h for h in heard if h[0] == "driven"][-1]
        check(not any(last[2]), f"{signal}: the force had already fallen to zero")
    else:
        # The guardian notices at once that the program is gone; the fault handler writes itself.
        after = heard[-1][3] - pushed[-1][3]
        check(after < 0.15, f"{signal}: that is {1e3 * after:.1f} ms after the last push")

heard = Board("STOP").heard
gap = next((i for i in range(len(heard) - 1) if heard[i + 1][3] - heard[i][3] > 2.0), 0)   # frozen from here to the next report
check(gap > 10 and any(any(h[2]) for h in heard[:gap]) and heard[gap][0] == "neutral", "STOP: while the program is frozen, the board is at rest")
later = [i for i in range(gap + 1, len(heard)) if heard[i][0] == "driven" and any(heard[i][2])]
# A report that was on its way into the kernel when the program froze gets there when the program continues. The next one is neutral.
check(later in ([], [gap + 1]) and all(heard[i + 1][0] == "neutral" for i in later), "STOP: the program continues without a force")
check("run/frozen" in text("STOP.play.err"), "STOP: the program says that it was frozen")

heard = Board("guardian").heard
last = max((i for i, h in enumerate(heard) if h[0] == "driven" and any(h[2])), default=0)
check(last > 10 and heard[-1][3] - heard[last][3] > 0.5, "guardian: there is no force after the guardian has been killed")
check(not any([h for h in heard if h[0] == "driven"][-1][2]), "guardian: the force had gone to zero before the program was killed")
check(heard[-1][0] == "neutral", "guardian: the last report to the board is neutral, from the next guardian")
check("run/unguarded" in text("guardian.play.err"), "guardian: the program says that its guardian was killed")

for name in sorted(f.removesuffix(".board.csv") for f in os.listdir(folder) if f.startswith("own_") and f.endswith(".board.csv")):
    heard = Board(name).heard
    pushed = [i for i, h in enumerate(heard) if h[0] == "driven" and any(h[2])]
    check(len(pushed) > 10, f"{name}: the board received {len(pushed)} forces")
    rest = next((h for h in heard[pushed[-1] + 1:] if h[0] == "neutral" or not any(h[2])), None) if pushed else None
    check(rest is not None and rest[3] - heard[pushed[-1]][3] < 0.15 and heard[-1][0] == "neutral", f"{name}: then the board rests, at once and to the end")
    if name in ("own_close", "own_hang", "own_script_raise", "own_script_exit"):   # ramps, and is not cut off; the board may miss steps of the ramp
        sizes = [max(map(abs, heard[i][2])) for i in pushed[-6:]]
        check(min(b / a for a, b in zip(sizes, sizes[1:])) < 0.81, f"{name}: the force ends along a ramp of 5 ms: {sizes} uN")
check("the handler of the program ran" in text("own_fault.play.err"), "own_fault: the program's own handler of faults runs, too")
check("emergency stop: 0" in text("own_hang.play.err"), "own_hang: another thread stops a program that hangs")
if os.path.exists(os.path.join(folder, "own_script_raise.play.err")):
    check("RuntimeError: an exception of the script" in text("own_script_raise.play.err"), "own_script_raise: the exception is the script's")
    check("by ['tactus_board']" in text("own_script_raise.play.err"), "own_script_raise: Python sees the forces and the health of the board")
else:
    print("skipped: scripts, because the Python package is not built")

# A driver in a plugin writes from a thread of its own, so a force that it sends need not answer the latest report, and it may leave out some.
board, rows = Board("driver_loop"), play_rows("driver_loop")
applied = [tuple(micro(float(row["motor.applied." + c])) for c in "xyz") for row in rows]
pushed = [h[2] for h in board.heard if h[0] == "driven" and any(h[2])]
k, compared = 0, 0
for force in pushed:
    found = next((i for i in range(k, len(applied)) if all(abs(a - b) <= 1 for a, b in zip(applied[i], force))), None)
    if found is None:
        break
    k, compared = found, compared + 1
fade = [max(map(abs, f)) for f in pushed[compared:]]   # as with the joystick
check(board.broken == 0 and compared > 300 and len(fade) < 300 and fade == sorted(fade, reverse=True),
      f"driver_loop: {compared} of {len(pushed)} forces match the guard's output in order; the rest is the fade")
check(any(abs(f[2]) > 1e5 for f in applied), "driver_loop: there was a force on the tool")
for signal in ("INT", "KILL", "STOP", "hang"):
    heard = Board("driver_" + signal).heard
    last = max((i for i, h in enumerate(heard) if h[0] == "driven" and any(h[2])), default=0)
    rest = next((h for h in heard[last + 1:] if h[0] == "neutral" or not any(h[2])), None)
    check(last > 10 and rest is not None and rest[3] - heard[last][3] < 0.15 and heard[-1][0] == "neutral",
          f"driver_{signal}: after the last of {last} forces, the board rests at once and to the end")


class Joystick:
    """What a joystick received, according to OpenFFBoard's descriptor: 05 block magnitude, 0a block operation, 0b block, 0c control."""

    def __init__(self, name):
        rows = [line.split(",") for line in text(name + ".board.csv").splitlines()]
        self.rows = [(how, float(t), bytes.fromhex(report)) for how, t, report in rows]
        self.told = [report for how, _, report in self.rows if how == "out"]
        self.forces = [int.from_bytes(r[2:4], "little", signed=True) for r in self.told if r[0] == 5]
        self.blocks = {r[1] for r in self.told if r[0] in (1, 5, 0x0A, 0x0B)}

    def rests(self):
        """True if the last command was to stop. After a crash, commands may come twice."""
        return 0x0C in [r[0] for r in self.told[-4:]] and self.told[-1] in (b"\x0c\x04", b"\x0b" + self.told[-1][1:]) and self.forces[-1] == 0


if os.path.exists(os.path.join(folder, "joystick.board.csv")):
    stick, rows = Joystick("joystick"), play_rows("joystick")
    counts = [-int(math.copysign(math.floor(abs(float(r["motor.applied.x"])) / 4.0 * 32767 + 0.5), float(r["motor.applied.x"]))) for r in rows]
    pushed = [f for f in stick.forces if f != 0]
    k, compared = 0, 0
    for force in pushed:
        found = next((i for i in range(k, len(counts)) if abs(counts[i] - force) <= 1), None)
        if found is None:
            break
        k, compared = found, compared + 1
    # A row holds the force of the tick before it, so the force of the last tick is not recorded. The fade starts from that force.
    fade = [abs(f) for f in pushed[compared:]]
    check(compared > 50 and len(fade) < 20 and fade == sorted(fade, reverse=True),
          f"joystick: {compared} of {len(pushed)} forces match the guard's output in order; the rest is the fade: {fade}")
    check(max(abs(f) for f in stick.forces) > 500, f"joystick: the force on it reaches {max(abs(f) for f in stick.forces) / 32767 * 4:.2f} N")
    check(stick.told[0] == b"\x0c\x08" and stick.told[1][:2] == b"\x11\x01", "joystick: its effects are cleared and a constant force is created")
    check(stick.blocks == {3}, "joystick: all reports use the block that it assigned")
    starts = sum(1 for r in stick.told if r[:3] == b"\x0a\x03\x01")
    check(starts >= 4, f"joystick: the effect, which ends on its own, is started {starts} times")
    check(stick.rests(), "joystick: at the end all effects are stopped")

    weak = Joystick("uncalibrated")
    most = max(abs(f) for f in weak.forces)
    check(0 < most <= 3277, f"uncalibrated: at most {most / 327.67:.1f} % of the joystick's force is used")
    check("pid/uncalibrated" in text("uncalibrated.play.err"), "uncalibrated: there is a warning")

    back = Joystick("replugged")
    came = next(i for i, r in enumerate(back.rows) if r[0] == "plugged")
    after = [r for how, _, r in back.rows[came:] if how == "out"]
    again = [int.from_bytes(r[2:4], "little", signed=True) for r in after if r[0] == 5]
    check({r[1] for r in after if r[0] in (1, 5, 0x0A)} == {7} and any(again),
          f"replugged: the joystick is driven again with {sum(1 for f in again if f)} reports, in its new block")
    first = next((abs(f) for f in again if f), 0)
    check(first < max(abs(f) for f in again) / 4, f"replugged: force starts at {first} and rises to {max(abs(f) for f in again)}")

    check("pid/full" in text("no_room.play.err"), "no free effect block: there is an error")

    for answers, what in ((1, "keeps its force, because it says where it is"), (0, "loses its force, because it does not say where it is")):
        silent = Joystick(f"quiet_{answers}")
        since = next(t for how, t, _ in silent.rows if how == "quiet")
        later = [int.from_bytes(r[2:4], "little", signed=True) for how, t, r in silent.rows if how == "out" and r[0] == 5 and since + 0.3 < t < since + 1.0]
        check(len(later) > 50 and all((f != 0) == (answers == 1) for f in later), f"a silent joystick {what}: {later[:1]} to {later[-1:]}")
    check("asked for" in text("quiet_1.play.err") and "sends no report while nothing changes" in text("quiet_0.play.err"),
          "a silent joystick: the summary says so")

    killed = Joystick("joystick_killed")
    check(sum(1 for f in killed.forces if f) > 20 and killed.rests(), "joystick: when its program is killed, all effects are stopped")
else:
    print("skipped: the joystick, because its descriptor is missing")


class Wheel:
    """What an event device received: its levels, and when its effect was played, stopped and erased."""

    def __init__(self, name):
        self.rows = [(what, int(value), float(t)) for what, value, t in (line.split(",") for line in text(name + ".board.csv").splitlines())]

    def forces(self, since=0.0):
        return [(i, value, t) for i, (what, value, t) in enumerate(self.rows) if what == "level" and value != 0 and t >= since]

    def after(self, what):
        return next(t for w, _, t in self.rows if w == what)

    def rests(self):
        """After its last force, how long the effect went on; None if it is on for as long as it lasts."""
        last = self.forces()[-1]
        return next((t - last[2] for what, value, t in self.rows[last[0] + 1:] if what in ("stop", "erase") or (what == "level" and value == 0)), None)


if os.path.exists(os.path.join(folder, "wheel_loop.board.csv")):
    wheel, rows = Wheel("wheel_loop"), play_rows("wheel_loop")
    counts = []   # the levels of the ticks: a positive one pushes to the left
    for row in rows:
        force = float(row["motor.applied.x"])
        counts.append(-int(math.copysign(math.floor(abs(force) / 4.0 * 32767.0 + 0.5), force)))
    pushed = [level for _, level, _ in wheel.forces()]
    k, compared = 0, 0
    for level in pushed:
        found = next((i for i in range(k, len(counts)) if counts[i] == level), None)
        if found is None:
            break
        k, compared = found, compared + 1
    fade = [abs(level) for level in pushed[compared:]]
    check(compared > 2000 and len(fade) < 20 and fade == sorted(fade, reverse=True),
          f"wheel_loop: {compared} of {len(pushed)} levels are the guard's output after encoding, bit for bit and in order; the rest is the fade: {fade}")
    check(not any(what in ("other", "dropped") for what, _, _ in wheel.rows), "wheel_loop: every effect is a constant force of half a second to the left")
    check(sum(1 for what, _, _ in wheel.rows if what == "in") > 5000, "wheel_loop: thousands of events")
    same_offline("wheel_loop", rows)
    starts = [t for what, _, t in wheel.rows if what == "play"]
    check(len(starts) > 10 and max(b - a for a, b in zip(starts, starts[1:])) < 0.45,
          f"wheel_loop: the effect, which ends on its own, is started {len(starts)} times")
    check(("gain", 65535) in [r[:2] for r in wheel.rows] and ("autocenter", 0) in [r[:2] for r in wheel.rows], "wheel_loop: full gain, no spring of its own")
    check(wheel.rests() is not None, "wheel_loop: at the end it rests")
    reached = re.search(r"(\d+) new ones per second reached the device", text("wheel_loop.play.err"))
    by_log = (len(wheel.forces()) - 1) / (wheel.forces()[-1][2] - wheel.forces()[0][2])
    check(reached is not None and 0.5 * by_log < int(reached[1]) < 2.0 * by_log,
          f"wheel_loop: the program says that {reached and reached[1]} new forces per second reached it; by its log, {by_log:.0f} on average")

    listed = text("events.txt")
    check("Test wheel" in listed and "constant force" in listed and "axes: x y z; 2 buttons" in listed,
          "the list names an event device with its effects and axes")
    probed = next(d["probe"] for d in json.loads(text("events.json")) if d.get("name") == "Test wheel")
    check(probed["valid"] and probed["readings"] > 50 and 0.0 < abs(probed["axes"]["x"]) < 0.36, f"an event device is probed: {probed}")
    check("another role or another instance" in text("events_taken.txt"), "a second program cannot open an event device in use")
    check("may not be opened by this user" in text("events_denied.txt") and 'ATTRS{id/vendor}=="046d"' in text("events_denied.txt")
          and 'ATTRS{id/vendor}=="046d"' in text("events_denied_play.txt"), "a user without permission for an event device is shown the udev rule")

    away = Wheel("wheel_unplug")
    again = [abs(level) for _, level, _ in away.forces(away.after("plugged"))]
    check(len(again) > 200 and again[0] < max(again) / 4, f"wheel_unplug: it is driven again with {len(again)} forces, from {again[:1]} to {max(again, default=0)}")
    hung = Wheel("wheel_hang")
    late = [level for _, level, _ in hung.forces(hung.after("answers"))]
    check(len(hung.forces()) > 250 and len(late) <= 2 and hung.rests() is not None and hung.rests() < 0.15 and "run/frozen" in text("wheel_hang.play.err"),
          f"wheel_hang: after an update that did not return, {late} come late, it rests {hung.rests()} s after the last, and the run is stopped")
    for signal in ("INT", "KILL", "STOP"):
        ended = Wheel("wheel_" + signal)
        check(len(ended.forces()) > 150 and ended.rests() is not None and ended.rests() < 0.15,
              f"wheel_{signal}: after the last of {len(ended.forces())} forces, it rests {ended.rests()} s later")
    killed = [what for what, _, _ in Wheel("wheel_KILL").rows]
    check("erase" in killed, "wheel_KILL: the kernel has removed the effect")
    frozen = Wheel("wheel_STOP")
    check("stop" in [what for what, _, _ in frozen.rows[frozen.forces()[-1][0]:]], "wheel_STOP: the guardian has stopped the effect")
else:
    print("skipped: event devices, because the kernel or the driver is missing")


def outputs(name):
    return [bytes.fromhex(line.split(",")[2]) for line in text(name + ".board.csv").splitlines()]


if os.path.exists(os.path.join(folder, "dualsense.board.csv")):
    motors = [(r[4], r[3]) for r in outputs("dualsense") if r[0] == 0x02 and r[1] & 0x03]
    check(any(189 <= strong <= 191 and 62 <= weak <= 63 for strong, weak in motors) and motors[-1] == (0, 0) and max(motors)[0] <= 191,
          f"dualsense: hid-playstation rumbles it in {len(motors)} reports, up to {max(motors, default=None)}, and it rests at the end")
else:
    print("skipped: a DualSense, because the kernel has no driver for it")
if os.path.exists(os.path.join(folder, "switch_pro.board.csv")):
    neutral, unset = bytes([0, 1, 0x40, 0x40] * 2), bytes(8)
    sides = [r[2:10] for r in outputs("switch_pro") if r[0] in (0x01, 0x10) and len(r) >= 10]
    rumbled = [s for s in sides if s not in (neutral, unset)]
    # Bytes 1 and 5 begin with the amplitudes: that of the strong motor, on the left, is three times that of the weak one, on a scale of logarithms.
    amplitudes = [(s[1] >> 1, s[5] >> 1) for s in rumbled]
    check(len(rumbled) > 5 and all(strong >= weak for strong, weak in amplitudes) and max(amplitudes)[1] > 0 and sides[-1] == neutral,
          f"switch_pro: hid-nintendo rumbles it in {len(rumbled)} of {len(sides)} reports, such as {rumbled[:1] and rumbled[0].hex()}, and it rests "
          f"at the end: {sides[-1:] and sides[-1].hex()}; at most {max(amplitudes, default=None)}; the weak motor is the stronger one in "
          f"{sum(weak > strong for strong, weak in amplitudes)}")
else:
    print("skipped: a Switch controller, because the kernel has no driver for it")

check("No HID device is connected." in text("none.txt"), "without a device, the list says so")
check("tactus_board" in text("devices.txt") and "spacemouse" in text("devices.txt"), "the list names the profiles that fit")
# No serial ports, event devices and profiles.
devices = [d for d in json.loads(text("devices.json")) if "profiles" in d and "driver" not in d and not d.get("numbers_only")]
check({p["id"] for d in devices for p in d["profiles"][:1]} >= {"tactus_board", "spacemouse"} and all(d["may_open"] for d in devices),
      "the list as JSON names them too")
if any(d["product"] == "Test joystick" for d in devices):
    check(any(d["product"] == "Test joystick" and d["profiles"][0]["id"] == "pid" for d in devices), "a joystick with force feedback is listed as pid")
probes = {d["probe"].get("profile"): d["probe"] for d in json.loads(text("probe.json")) if "probe" in d}
mouse = probes.get("spacemouse", {})
check(mouse.get("reports", 0) > 3 and mouse["axes"]["x"] == 100 * 4e-6 and mouse["axes"]["rz"] == -0.05 and mouse["pressed"] == ["button1"],
      f"a SpaceMouse is probed: {mouse.get('reports')} reports")
check(probes.get("tactus_board", {}).get("taken", 0) > 10, "a board is probed along with it")
check("hid/not_opened" in text("taken.txt") and "is using it" in text("taken.txt"), "a second program cannot open a device in use")
rule = 'KERNEL=="hidraw*", ATTRS{idVendor}=="16c0", ATTRS{idProduct}=="0486", TAG+="uaccess"'
check(rule in text("denied.txt") and rule in text("denied_play.txt") and "hid/not_permitted" in text("denied_play.txt"),
      "a user without permission is shown the udev rule")

print("\n".join([f"{len(failures)} failures:", *failures]) if failures else "everything passed")
sys.exit(1 if failures else 0)
