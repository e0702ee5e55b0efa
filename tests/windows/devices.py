#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Plays on devices with tactus.exe in wine: devices.py TACTUS BIN WINE GRAPHS WORK [READINGS]. Arguments as for presets.py.

Arms are behind a fake drd64.dll, dhd64.dll and HD.dll; `tactus fake-device` moves the hand, and tells what the arm has heard. A board that
`tactus fake-device` plays on a pseudo-terminal is COM7, and then COM12, whose name needs a prefix. Without --untried, `tactus play` must refuse all of
them, and so must a program with tactus_live.dll; then they have heard no force. With it, what they play must be what `tactus render --replay` renders on
Linux from the log, to the bit, and the device must have heard forces, within the limit of its guard. On a busy computer, most reports are skipped for
newer ones, and the guard withholds forces, so the counts are only printed."""

import contextlib
import math
import os
import pathlib
import re
import signal
import struct
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from wine import add_port, restart   # noqa: E402

READINGS = 10000
MOST_N = 2.0001   # of the profile of the board, and a rounding
WATCHDOG_AT = 44   # bytes into FakeArms of host/drivers/forcedimension/fake_drd.hpp


@contextlib.contextmanager
def board(tactus, wine, work, port):
    """A board at this port of wine, and the file of what it hears."""
    link, heard = work / f"line_{port}", work / f"heard_{port}.txt"
    link.unlink(missing_ok=True)
    fake = subprocess.Popen([tactus, "fake-device", "tactus_board", "--wire", "serial", "--link", link, "--log", heard], stdout=subprocess.PIPE, text=True)
    try:
        fake.stdout.readline()   # it is there
        add_port(wine, port, link)
        restart(wine)   # it looks for ports when it starts
        yield heard
    finally:
        fake.terminate()
        fake.communicate()


@contextlib.contextmanager
def arm(tactus, driver, library, said):
    """The environment in which tactus.exe finds this fake library of a maker, whose arm `tactus fake-device` moves; `said` gets what that has heard."""
    fake = subprocess.Popen([tactus, "fake-device", driver], stdout=subprocess.PIPE, text=True)
    try:
        fake.stdout.readline()
        memory = pathlib.Path(re.search(r"TACTUS_FAKE_\w+='([^']*)'", fake.stdout.readline()).group(1))
        if driver == "forcedimension":
            with memory.open("r+b") as arms:   # a watchdog of minutes: the monotonic clock of wine is not that of Linux
                arms.seek(WATCHDOG_AT)
                arms.write(struct.pack("i", 0x3FFFFF))   # 255 in the eight bits that the driver gets
        yield {**os.environ, "FDSDK": f"Z:{library.parent}", "TACTUS_FAKE_DRD": f"Z:{memory}", "TACTUS_FAKE_HD": f"Z:{memory}", "WINEPATH": f"Z:{library}"}
    finally:
        fake.send_signal(signal.SIGINT)
        said.append(fake.communicate()[0].strip())


def forces_heard(log):
    """The forces that the board heard, in uN, without repetitions; a report without one is 0."""
    whole = log.read_text().rpartition("\n")[0].splitlines()
    reports = [bytes.fromhex(line.partition("<")[2]) for line in whole if "<" in line]
    forces = [tuple(int.from_bytes(r[at:at + 4], "little", signed=True) for at in (8, 12, 16)) if r[2] & 1 else (0, 0, 0) for r in reports]
    return [f for i, f in enumerate(forces) if i == 0 or f != forces[i - 1]]


def main():
    tactus, programs, wine, graphs, work = sys.argv[1:6]
    readings = int(sys.argv[6]) if len(sys.argv) > 6 else READINGS
    exe, work, graph = pathlib.Path(programs).resolve() / "tactus.exe", pathlib.Path(work).resolve(), pathlib.Path(graphs).resolve() / "dry_wood.json"
    work.mkdir(parents=True, exist_ok=True)
    wrong = []

    def expect(holds, what, ran):
        if not holds:
            wrong.append(what)
            print(f"{what}\n{ran.stdout[-800:]}{ran.stderr[-2000:]}", flush=True)

    def play(name, device, count, environment, *more, is_refused=False):
        """Plays; what was played must be what Linux renders. `is_refused`: nothing plays, because there is no guardian."""
        words = [wine, exe, "play", graph, "--device", f"stylus={device}", "--osc", "off", *more]
        how = {"capture_output": True, "text": True, "cwd": work, "check": False, "timeout": 600, "env": environment}
        if is_refused:
            for program in ([*words, "--duration", "1"], [wine, exe.with_name("live_c.exe"), f"Z:{graph}", f"stylus={device}", "1"]):
                ran = subprocess.run(program, **how)
                expect(ran.returncode != 0 and "[device/failsafe]" in ran.stderr, f"{name}: {program[1].name} does not refuse a device with forces", ran)
            return ran
        ran = subprocess.run([*words, "--untried", "--duration", str(1.1 * count / 1000), "--log", f"{name}.jsonl", "--out", f"{name}.csv"], **how)
        expect(ran.returncode == 0, f"{name}: the run fails", ran)
        here = subprocess.run([tactus, "render", graph, "--replay", f"{name}.jsonl", "--out", f"{name}_again.csv"], **how)
        expect(here.returncode == 0, f"{name}: the log cannot be replayed", here)
        table, again = work / f"{name}.csv", work / f"{name}_again.csv"
        same = table.exists() and again.exists() and table.read_bytes() == again.read_bytes()
        ticks = table.read_bytes().count(b"\n") - 1 if table.exists() else 0
        expect(same and ticks > 0, f"{name}: Linux renders something else from the log", ran)
        print(f"{name}: {ticks} ticks{', as Linux renders them' if same else ''}\n" + "\n".join(ran.stderr.splitlines()[-3:]), flush=True)
        return ran

    # A file COM7.csv would be the port itself.
    for port, count in (("COM7", readings), ("COM12", 1000)):
        with board(tactus, wine, work, port) as log:
            listed = subprocess.run([wine, exe, "devices"], capture_output=True, text=True, check=False, timeout=120)
            expect(f"serial port {port}\n" in listed.stdout, f"{port} is not listed", listed)
            ran = play(f"line_{port}", f"serial:tactus_board@{port}", count, os.environ, is_refused=True)
            expect(not any(map(any, forces_heard(log))), f"{port}: a board that was refused has heard a force", ran)
            ran = play(f"line_{port}", f"serial:tactus_board@{port}", count, os.environ)
            heard, taken = forces_heard(log), re.search(r"(\d+) taken", ran.stderr)
            expect(taken and int(taken.group(1)) >= count, f"{port}: fewer reports than {count}", ran)
            largest = max((math.hypot(*force) for force in heard), default=0.0)
            expect(largest < 1e6 * MOST_N, f"{port}: the board has heard {1e-6 * largest} N", ran)
            got = taken.group(0) if taken else "no reports"
            print(f"{port}: {got}; the board has heard {len(heard)} different forces of at most {1e-6 * largest} N", flush=True)
    for driver, library in (("forcedimension", "drd64"), ("forcedimension", "dhd64"), ("openhaptics", "HD")):
        said = []
        for is_refused in (True, False):
            with arm(tactus, driver, pathlib.Path(programs).resolve().parent / "fakes" / library / "bin", said) as environment:
                ran = play(library, driver, 1000, environment, "--rate", "1000", is_refused=is_refused)
        nothing = said.pop(0)
        expect(nothing.endswith(" of at most 0 N"), f"{library}.dll: an arm that was refused has felt a force: {nothing}", ran)
        found = re.search(r"(\d+) forces heard, of at most ([0-9.]+) N", said[0])
        expect(found and int(found.group(1)) > 0, f"{library}.dll is not driven: {said}", ran)
        print(f"{library}.dll: {found.group(0) if found else said}", flush=True)
    print(f"devices: {len(wrong)} problems")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
