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
    end(WINE, environment)
    print(f"In wine: {' and '.join(wrong) + ' failed' if wrong else 'all passed'}")
    return 1 if wrong else 0


sys.exit(main())
