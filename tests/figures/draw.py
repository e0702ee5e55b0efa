#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws docs/figures/*.png from build/figures/*.csv: all of them, or those named. Each figure is a module in plots/ with a function draw()."""

import importlib
import pathlib
import sys

sys.dont_write_bytecode = True

PLOTS = pathlib.Path(__file__).resolve().parent / "plots"
sys.path.insert(0, str(PLOTS))

import style  # noqa: E402

KNOWN = sorted(path.stem for path in PLOTS.glob("*.py") if path.stem != "style")

for name in sys.argv[1:] or KNOWN:
    if name not in KNOWN:
        sys.exit(f"there is no figure {name}; the figures are {', '.join(KNOWN)}")
    try:
        style.save(importlib.import_module(name).draw(), name)
    except FileNotFoundError as missing:
        sys.exit(f"{name}: {missing.filename} does not exist; run build/release/bin/tactus_tool_tests \"[figures]\" first")
    print(f"docs/figures/{name}.png")
