#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks Tactus.cs: csharp_test.py LIBRARY TACTUS SOURCES [WINE MONO DLL]. LIBRARY is libtactus.so, TACTUS the program, SOURCES the repository. With WINE,
C# runs there, in mono.exe MONO with libtactus.dll DLL, and is compared with the same things of Linux.

Compiles the file, a test and the example for Unity with mcs, and runs them with mono: rendered presets have the bits of `tactus render`; pushed readings the
efforts that the same library gives to Python's ctypes, also by steps longer than a tick; a saved half of a run has the same bits again; the guard says why it
stops; errors become exceptions, a loop allocates nothing, and a run that is not stopped ends with its object. Exit status 77 without mono."""

import csv
import ctypes
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile

CHANNELS = 32
PRESETS = ["dry_wood", "liver", "granite_wall", "potato_cut"]
RENDERED, TICKS, SILENT = 4000, 700, 500   # ticks: of a preset, with a pushed tool, and of these with readings
STEPS = 60


class Reading(ctypes.Structure):
    _fields_ = [("size", ctypes.c_uint32), ("valid", ctypes.c_int32), ("position", ctypes.c_double * 3), ("rotation", ctypes.c_double * 3),
                ("pressure", ctypes.c_double), ("age", ctypes.c_double), ("buttons", ctypes.c_uint32), ("axis_count", ctypes.c_uint32),
                ("signal_count", ctypes.c_uint32), ("axes", ctypes.c_double * CHANNELS), ("signals", ctypes.c_double * CHANNELS)]


class Effort(ctypes.Structure):
    _fields_ = [("size", ctypes.c_uint32), ("force", ctypes.c_double * 3), ("torque", ctypes.c_double * 3), ("axis_count", ctypes.c_uint32),
                ("signal_count", ctypes.c_uint32), ("axes", ctypes.c_double * CHANNELS), ("signals", ctypes.c_double * CHANNELS),
                ("brake", ctypes.c_double), ("max_signal", ctypes.c_double), ("withheld", ctypes.c_uint32)]


class DeviceOptions(ctypes.Structure):
    _fields_ = [("size", ctypes.c_uint32)] + [(n, ctypes.c_size_t) for n in ("axes", "na", "efforts", "ne", "buttons", "nb")] + [
        ("signal_inputs", ctypes.c_int32), ("signal_outputs", ctypes.c_int32), ("guard", ctypes.c_char_p), ("brake", ctypes.c_double),
        ("between", ctypes.c_int), ("step_effort", ctypes.c_int), ("simulated", ctypes.c_int)]


class RunOptions(ctypes.Structure):
    _fields_ = [("size", ctypes.c_uint32), ("rate", ctypes.c_double)] + [(n, ctypes.c_size_t) for n in ("f", "nf", "r", "nr", "s", "ns", "a", "ac", "log")]


def bits(value):
    return struct.pack(">d", value).hex()


def rendered(tactus, graph, folder):
    """The bits of the rows that the command line renders, without the time."""
    table = folder / "table.csv"
    subprocess.run([tactus, "render", graph, "--ticks", str(RENDERED), "--out", table], check=True, capture_output=True)
    rows = list(csv.reader(table.read_text().splitlines()))
    return [rows[0][1:]] + [[bits(float(v)) for v in row[1:]] for row in rows[1:]]


def pushed(library, graph, options, ticks, tick_once):
    """The efforts that ctypes gets. `tick_once` pushes and ticks."""
    lib = ctypes.CDLL(library)
    for name in ("tactus_graph_load", "tactus_run_create"):
        getattr(lib, name).restype = ctypes.c_void_p
    lib.tactus_run_role.restype = ctypes.c_char_p
    loaded = ctypes.c_void_p(lib.tactus_graph_load(str(graph).encode(), None))
    run = ctypes.c_void_p(lib.tactus_run_create(loaded, ctypes.byref(RunOptions(ctypes.sizeof(RunOptions))), None))
    role = lib.tactus_run_role(run, ctypes.c_size_t(0))
    device = DeviceOptions(ctypes.sizeof(DeviceOptions), **options)
    assert lib.tactus_run_pushed_device(run, role, ctypes.byref(device), None) == 0
    assert lib.tactus_run_open(run, None) == 0
    effort = Effort(ctypes.sizeof(Effort))
    lines = []
    for k in range(ticks):
        tick_once(lib, run, role, k)
        assert lib.tactus_run_take(run, role, ctypes.byref(effort)) == 0
        lines.append([bits(f) for f in effort.force])
    lib.tactus_run_free(run)
    lib.tactus_graph_free(loaded)
    return lines


def push(lib, run, role, tick):
    """As Test.Push."""
    reading = Reading(ctypes.sizeof(Reading), 1, (ctypes.c_double * 3)(0.0, 0.0, 0.03 - 0.0001 * tick))
    if tick < SILENT:
        assert lib.tactus_run_push(run, role, ctypes.byref(reading)) == 0
    assert lib.tactus_run_tick(run) == 0


def step(lib, run, role, k):
    """As Test.Step."""
    three = ctypes.c_double * 3
    reading = Reading(ctypes.sizeof(Reading), 1, three(0.00003 * k, 0.0, 0.002 - 0.0001 * k))
    assert lib.tactus_run_push_moving(run, role, ctypes.byref(reading), three(0.01, 0.0, -0.05), None) == 0
    assert lib.tactus_run_step_for(run, ctypes.c_double(0.0017)) == 0


def main():
    library, tactus, sources = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), pathlib.Path(sys.argv[3]).resolve()
    in_wine = sys.argv[4:]
    mono = in_wine[:2] or ["mono"]
    if not shutil.which("mcs") or not shutil.which("mono"):
        print("skipped: there is no mono (Debian: apt install mono-mcs mono-runtime)")
        return 77
    here = sources / "tests/framework/capi/csharp"
    graphs = sources / "graphs"
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)

        def build(program, *files):
            subprocess.run(["mcs", "-unsafe", "-warnaserror+", "-d:UNITY_EDITOR", f"-out:{folder / program}", sources / "framework/capi/Tactus.cs", *files],
                           check=True)

        if in_wine:
            shutil.copy(in_wine[2], folder)

        def lines(*words):
            words = [f"Z:{word}" if in_wine and word.startswith("/") else word for word in words]
            ran = subprocess.run([*mono, *words], cwd=folder, capture_output=True, text=True, timeout=300, check=False,
                                 env={**os.environ, "LD_LIBRARY_PATH": str(pathlib.Path(library).parent), "LC_ALL": "C.UTF-8"})
            assert ran.returncode == 0, (words, ran.stdout, ran.stderr)
            return ran.stdout.splitlines()

        build("test.exe", here / "Test.cs")
        build("unity.exe", here / "UnityNames.cs", sources / "docs/examples/unity/HapticTool.cs")

        version = subprocess.run([tactus, "--version"], capture_output=True, text=True, check=True).stdout.split()[1]
        assert lines("test.exe", "version") == [f"{version} True"]
        for preset in PRESETS:
            found = [line.split(" ") for line in lines("test.exe", "render", str(graphs / f"{preset}.json"), str(RENDERED))]
            expected = rendered(tactus, graphs / f"{preset}.json", folder)
            assert found == expected, preset
            assert len({tuple(row) for row in found}) > 100, f"{preset} renders the same on all ticks"

        found = [line.split(" ") for line in lines("test.exe", "push", str(graphs / "granite_wall.json"), str(TICKS), str(SILENT))]
        assert found == pushed(library, graphs / "granite_wall.json", {"guard": b'{"max_force": "2 N"}'}, TICKS, push)
        none = [bits(0.0)] * 3
        assert found[SILENT - 1] != none and found[-1] == none, "the tool is pushed, and no longer when its readings have stopped"

        found = lines("test.exe", "step", str(graphs / "dry_wood.json"), str(STEPS))
        rules = {"guard": b'{"max_impulse": "1 N*s", "impulse_window": "10 s"}', "between": 2, "step_effort": 1, "simulated": 1}
        assert [line.split(" ") for line in found[:STEPS]] == pushed(library, graphs / "dry_wood.json", rules, STEPS, step)
        assert len(set(found[:STEPS])) > STEPS // 2
        assert found[STEPS:] == ["True", "state/damaged", "None 0 False", "Impulse 1 True"], found[STEPS:]

        assert lines("test.exe", "errors", str(folder)) == [
            "file/unreadable True", "file/syntax 1", "1000", "True True True False", "node/unknown_type", "True", "True", "disposed"]
        assert lines("test.exe", "collections", str(graphs / "granite_wall.json")) == ["0"]
        assert lines("test.exe", "play", str(graphs / "dry_wood.json")) == ["Running 1", "True", "Over", "Running 1", "True"]
        unity = lines("unity.exe", str(graphs), "granite_wall.json")
        assert unity[:3] == ["pushes up True", "after a reload 0", "after the second play 0"], unity
        assert "[file/unreadable]" in unity[3] and unity[4:] == ["without a graph 0"], unity
    print(f"{len(PRESETS)} presets have the bits of the command line in C#, and so have the efforts of {TICKS} pushed ticks in Python; errors, stops and the "
          "example for Unity do what they should")
    return 0


sys.exit(main())
