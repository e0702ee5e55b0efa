#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares what was built for Windows, in wine, with tactus: presets.py TACTUS BIN WINE GRAPHS WORK.

Each preset is rendered by render_dll.exe, a C program with libtactus.dll, and by tactus.exe, and must have the bits that tactus gives. Then files with
spaces and letters that are not ASCII, carriage returns, a file that is replaced, the folder of the settings and refusals are tried. BIN is the folder of
the programs; one that is not there is left out, with a message. WORK is a folder for the results."""

import csv
import json
import os
import pathlib
import struct
import subprocess
import sys

TICKS = 4000


def bits(table):
    """The text that render_dll.exe prints for the rows of this CSV file, without the time."""
    rows = list(csv.reader(table.read_text().splitlines()))
    return [" ".join(rows[0][1:])] + [" ".join(struct.pack(">d", float(v)).hex() for v in row[1:]) for row in rows[1:]]


def compare_dll(tactus, dll, wine, presets, work):
    """True if the DLL renders all presets with the right bits, but for those with pictures, for which the library has no decoder on any system."""
    same = pictures = 0
    for preset in presets:
        table = work / "table.csv"
        subprocess.run([tactus, "render", preset, "--ticks", str(TICKS), "--out", table], check=True, capture_output=True)
        there = subprocess.run([wine, dll, preset, str(TICKS)], capture_output=True, check=False, timeout=600)
        found = there.stdout.decode().replace("\r\n", "\n").splitlines()
        if there.returncode == 0 and found == bits(table) and len(found) == TICKS + 1:
            same += 1
        elif there.returncode == 1 and b"no decoder for pictures" in there.stderr and '.png"' in preset.read_text():
            pictures += 1
        else:
            print(f"{preset.name} has other bits in libtactus.dll\n{there.stderr.decode(errors='replace')[-1000:]}", flush=True)
    print(f"{same} of {len(presets)} presets have the same bits from libtactus.dll, and {pictures} need pictures, which a program must supply", flush=True)
    return same > 0 and same + pictures == len(presets)


def main():
    tactus, programs, wine, graphs, work = sys.argv[1:]
    exe, dll = pathlib.Path(programs) / "tactus.exe", pathlib.Path(programs) / "render_dll.exe"
    graphs = pathlib.Path(graphs).resolve()
    work = pathlib.Path(work).resolve()
    work.mkdir(parents=True, exist_ok=True)
    wrong = []

    def on_windows(*words, **more):
        return subprocess.run([wine, exe, *map(str, words)], capture_output=True, cwd=work, check=False, timeout=600, **more)

    def on_linux(*words):
        return subprocess.run([tactus, *map(str, words)], capture_output=True, cwd=work, check=False, timeout=600)

    def expect(holds, what, ran=None):
        if not holds:
            wrong.append(what)
            print(f"{what}\n{ran.stdout.decode(errors='replace')[-600:]}{ran.stderr.decode(errors='replace')[-1500:]}" if ran else what, flush=True)

    presets = sorted(graphs.glob("*.json"))
    if not presets:
        wrong.append("there are no presets")
    if not dll.exists():
        print("libtactus.dll is not built, so it is not compared")
    elif not compare_dll(tactus, dll, wine, presets, work):
        wrong.append("libtactus.dll has other bits")
    if not exe.exists():
        print("tactus.exe is not built, so it is not compared")
        return 1 if wrong else 0
    same = 0
    for preset in presets:
        table = work / f"{preset.stem}.csv"
        other = work / f"{preset.stem}_windows.csv"
        here = on_linux("render", preset, "--ticks", TICKS, "--out", table)
        there = on_windows("render", preset, "--ticks", TICKS, "--out", other.name)
        is_same = here.returncode == 0 and there.returncode == 0 and other.exists() and table.read_bytes() == other.read_bytes()
        same += is_same
        expect(is_same and table.stat().st_size > 10000, f"{preset.name} renders other bits on Windows", there)
        table.unlink(missing_ok=True)
        other.unlink(missing_ok=True)

    # The same words in the same bytes
    for words in (("nodes",), ("nodes", "--json"), ("nodes", "friction.elasto_plastic"), ("validate", "wrong.json"), ("schema",)):
        (work / "wrong.json").write_text('{ "format": "tactus-graph", "version": 2, "nodes": { "a": { "type": "no.such" } } }')
        here, there = on_linux(*words), on_windows(*words)
        expect((here.returncode, here.stdout, here.stderr) == (there.returncode, there.stdout, there.stderr),
               f"tactus {' '.join(words)} says something else on Windows", there)

    # Names
    folder = work / "Ordner mit Größe ж 😀"
    folder.mkdir(exist_ok=True)
    graph = folder / "mein Graph ß.json"
    text = (graphs / "dry_wood.json").read_text()
    graph.write_bytes(text.replace("\n", "\r\n").encode())
    table = folder / "Tabelle ü.csv"
    table.write_text("old")
    ran = on_windows("render", f"{folder.name}\\{graph.name}", "--duration", 1, "--out", f"{folder.name}\\{table.name}")
    here = on_linux("render", graphs / "dry_wood.json", "--duration", 1, "--out", work / "plain.csv")
    expect(ran.returncode == 0 and here.returncode == 0 and table.read_bytes() == (work / "plain.csv").read_bytes(),
           "a file with spaces and Unicode in its name, CRLF and an earlier result is not rendered alike", ran)
    expect(sorted(p.name for p in folder.iterdir()) == sorted([graph.name, table.name]), f"temporary files are left: {[p.name for p in folder.iterdir()]}")
    ran = on_windows("render", "dry_wood", "--duration", 1, "--out", "by_name.csv", env={**os.environ, "TACTUS_PRESETS": "Z:" + str(graphs)})
    expect(ran.returncode == 0 and (work / "by_name.csv").read_bytes() == (work / "plain.csv").read_bytes(), "a preset is not found by its name", ran)
    ran = on_windows("render", f"{folder.name}\\nicht da ж.json", "--out", "none.csv")
    expect(ran.returncode != 0 and "nicht da ж.json" in ran.stderr.decode() and not (work / "none.csv").exists(),
           "the error for a missing file does not name it", ran)

    # Tables with carriage returns
    feed = work / "feed.csv"
    rows = ["t,push.position.x"] + [f"{i / 1000},{0.0001 * i}" for i in range(500)]
    gain = {"g": {"type": "signal.gain", "params": {"gain": 2}}}
    (work / "graph.json").write_text(json.dumps({"format": "tactus-graph", "version": 2, "rate_hz": 1000, "nodes": gain}))
    outputs = []
    for end in ("\n", "\r\n"):
        feed.write_bytes(end.join([r.replace("push.position.x", "g.in") for r in rows]).encode())
        for run in (on_linux, on_windows):
            ran = run("render", "graph.json", "--feed", "feed.csv", "--record", "g.out", "--out", "fed.csv")
            expect(ran.returncode == 0, "a feed is not read", ran)
            outputs.append((work / "fed.csv").read_bytes() if ran.returncode == 0 else b"")
            (work / "fed.csv").unlink(missing_ok=True)
    expect(len(set(outputs)) == 1 and outputs[0].count(b"\n") > 400, "feeds with and without carriage returns give other results")

    # Locks and settings
    appdata = work / "App Data ö"
    appdata.mkdir(exist_ok=True)
    ran = on_windows("report", env={**os.environ, "APPDATA": "Z:" + str(appdata)})
    expect(ran.returncode == 0, "tactus report fails", ran)

    # What needs Linux says so.
    ran = on_windows("experiment", "x.json")
    expect(ran.returncode == 2 and "no Python package of Tactus for Windows" in ran.stderr.decode(), "tactus experiment does not say that it needs Linux", ran)
    print(f"{same} of {len(presets)} presets have the same bits; {len(wrong)} problems")
    return 1 if wrong or not presets else 0


sys.exit(main())
