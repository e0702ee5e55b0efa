#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tries node plugins and tactus_live.dll in wine: libraries.py TACTUS BUILD WINE WORK, where BUILD is build/windows.

A graph with a node of a plugin in C must render what TACTUS renders with the same plugin for Linux, from build/release; a plugin in C++ must be listed.
Then a C program plays a preset on a simulated hand by tactus_live.dll."""

import json
import os
import pathlib
import shutil
import subprocess
import sys

GRAPH = {"format": "tactus-graph", "version": 2, "rate_hz": 1000,
         "nodes": {"wave": {"type": "signal.lfo", "params": {"frequency": 3}}, "twice": {"type": "c.twice"}}, "wires": ["wave.out -> twice.in"]}


def main():
    tactus, build, wine, work = sys.argv[1], pathlib.Path(sys.argv[2]).resolve(), sys.argv[3], pathlib.Path(sys.argv[4]).resolve()
    work.mkdir(parents=True, exist_ok=True)
    (work / "plugin.json").write_text(json.dumps(GRAPH))
    wrong = []

    def expect(holds, what, ran):
        if not holds:
            wrong.append(what)
            print(f"{what}\n{ran.stdout[-800:]}{ran.stderr[-2000:]}", flush=True)

    def run(program, plugins, *words):
        return subprocess.run([*program, *words], capture_output=True, text=True, cwd=work, check=False, timeout=120,
                              env={**os.environ, "TACTUS_PLUGINS": str(plugins), "TACTUS_HOME": str(work / "no home")})

    exe = [wine, build / "bin/tactus.exe"]
    render = ("render", "plugin.json", "--ticks", "3000", "--record", "twice.out", "--out")
    there = run(exe, f"Z:{build / 'node_plugins'}", *render, "there.csv")
    expect(there.returncode == 0, "a graph with a node of a plugin does not render", there)
    (work / "plugins").mkdir(exist_ok=True)
    shutil.copy(build.parent / "release/tests/plugins/objects/in_c.tactus", work / "plugins")   # where there are bad ones, too
    here = run([tactus], work / "plugins", *render, "here.csv")
    expect(here.returncode == 0, "a graph with a node of a plugin does not render on Linux", here)
    same = not wrong and (work / "there.csv").read_bytes() == (work / "here.csv").read_bytes()
    expect(same and (work / "here.csv").stat().st_size > 30000, "the plugin computes something else", there)
    listed = run(exe, f"Z:{build / 'node_plugins'}", "nodes")
    expect("ice" in listed.stdout and "c.twice" in listed.stdout, "the plugins are not listed", listed)

    live = run([wine, build / "bin/live_c.exe"], "", f"Z:{pathlib.Path(__file__).resolve().parents[2] / 'graphs/dry_wood.json'}", "stylus=gesture:stroke", "2")
    ticks, _, force = live.stdout.partition(" ticks, peak force ")
    expect(live.returncode == 0 and force and int(ticks) > 500 and float(force.split()[0]) > 0.1, "tactus_live.dll does not play", live)
    print(f"tactus_live.dll: {live.stdout.strip()}")
    made = [name for name in ("libtactus.dll.a", "libtactus.def", "libtactus_live.dll.a", "tactus_live.def") if not (build / name).exists()]
    expect(not made, f"there is no {' and no '.join(made)}", live)
    # hidapi marks its functions, too.
    functions = [line.split()[0] for line in (build / "tactus_live.def").read_text().splitlines() if line.startswith("    ")]
    ours = all(name.startswith(("tactus_", "hid_")) for name in functions) and "tactus_session_open" in functions
    expect(ours, f"tactus_live.dll exports {functions[:9]}", live)
    print(f"libraries: {len(wrong)} problems, {sum(name.startswith('tactus_') for name in functions)} functions in tactus_live.dll")
    return 1 if wrong else 0


sys.exit(main())
