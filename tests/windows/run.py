#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs what was built for Windows in wine: run.py TACTUS BUILD. TACTUS is the program for Linux, BUILD the folder build/windows."""

import os
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
WINE = "/usr/lib/wine/wine64"


def main():
    tactus, build = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    environment = {**os.environ, "WINEPREFIX": str(build / "prefix"), "WINEDEBUG": "-all", "LC_ALL": "C.UTF-8", "WINEDLLOVERRIDES": "mscoree,mshtml="}
    status = subprocess.run([sys.executable, "-B", HERE / "presets.py", tactus, build / "bin", WINE, HERE.parents[1] / "graphs", build / "tried"],
                            env=environment, check=False).returncode
    return 1 if status else 0


sys.exit(main())
