#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws docs/figures/*.png from build/figures/*.csv: all of them, or those named. Each figure is a module in this folder with a function draw()."""

import importlib
import pathlib
import sys

sys.dont_write_bytecode = True

import style  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
KNOWN = sorted(path.stem for path in HERE.glob("*.py") if path.stem not in ("draw", "style"))

for name in sys.argv[1:] or KNOWN:
    if name not in KNOWN:
        sys.exit(f"there is no figure {name}; the figures are {', '.join(KNOWN)}")
    try:
        style.save(importlib.import_module(name).draw(), name)
    except FileNotFoundError as missing:
        sys.exit(f"{name}: {missing.filename} does not exist; run build/release/bin/tactus_tests \"[figures]\" first")
    print(f"docs/figures/{name}.png")
