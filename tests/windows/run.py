#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs what was built for Windows in wine: run.py TACTUS BUILD. TACTUS is the program for Linux, BUILD the folder build/windows."""

import os
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
from wine import end, restart   # noqa: E402

WINE = "/usr/lib/wine/wine64"


def csharp(tactus, build, environment):
    """True if Tactus.cs does in wine what it does on Linux, or if there is no Mono for Windows."""
    print("== csharp_test.py", flush=True)
    mono = build / "mono/bin/mono.exe"
    if not mono.exists():
        print("skipped: there is no Mono for Windows; tests/windows/mono/build.sh builds it from Debian's sources, in a quarter of an hour", flush=True)
        return True
    words = [tactus.parents[1] / "libtactus.so", tactus, HERE.parents[1], WINE, mono, build / "bin/libtactus.dll"]
    test = HERE.parents[1] / "tests/framework/capi/csharp/csharp_test.py"
    return subprocess.run([sys.executable, "-B", test, *words], env=environment, check=False).returncode in (0, 77)


def main():
    tactus, build = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    environment = {**os.environ, "WINEPREFIX": str(build / "prefix"), "WINEDEBUG": "-all", "LC_ALL": "C.UTF-8",
                   "WINEDLLOVERRIDES": "mscoree,mshtml,winealsa.drv,winepulse.drv="}
    restart(WINE, environment)
    graphs, work = HERE.parents[1] / "graphs", build / "tried"
    wrong = []
    for script, words in (("presets.py", [tactus, build / "bin", WINE, graphs, work]), ("libraries.py", [tactus, build, WINE, work]),
                          ("devices.py", [tactus, build / "bin", WINE, graphs, work]), ("tests.py", [tactus.parents[1], build, WINE]),
                          ("window.py", [tactus, build / "bin", WINE, graphs, work])):
        print(f"== {script}", flush=True)
        if subprocess.run([sys.executable, "-B", HERE / script, *words], env=environment, check=False).returncode != 0:
            wrong.append(script)
    if not csharp(tactus, build, environment):
        wrong.append("csharp_test.py")
    end(WINE, environment)
    print(f"In wine: {' and '.join(wrong) + ' failed' if wrong else 'all passed'}")
    return 1 if wrong else 0


sys.exit(main())
