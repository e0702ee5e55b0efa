#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks what libtactus_live is made of: library.py LIBTACTUS_LIVE LIBTACTUS

- It needs only the libraries of devices and pictures, and those of the system; libtactus needs only the latter.
- It exports each function of tactus.h and tactus_live.h, and besides only what fused code calls.
- It contains no LLVM bitcode (docs/decisions/mit_below_gpl.md)."""

import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[4]
SYSTEM = {"libstdc++.so.6", "libm.so.6", "libgcc_s.so.1", "libc.so.6", "ld-linux-x86-64.so.2", "ld-linux-aarch64.so.1"}
failures = []


def check(holds, what):
    print(("ok      " if holds else "FAILED  ") + what)
    if not holds:
        failures.append(what)


def output(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def needed(library):
    return set(re.findall(r"NEEDED.*\[(.*)\]", output("readelf", "--wide", "--dynamic", library)))


def declared(header):
    return set(re.findall(r"^TACTUS_API [^;]*?\b(tactus_\w+) \(", (ROOT / header).read_text(encoding="utf-8"), re.MULTILINE))


live, plain = sys.argv[1:3]
check(needed(live) <= SYSTEM | {"libhidapi-hidraw.so.0", "libevdev.so.2", "libspng.so.0", "libturbojpeg.so.0"}, f"libtactus_live needs {sorted(needed(live))}")
check(needed(plain) <= SYSTEM, f"libtactus needs {sorted(needed(plain))}")

exported = {line.split()[-1].split("@")[0] for line in output("nm", "-D", "--defined-only", live).splitlines()}
api = declared("framework/capi/tactus.h") | declared("host/devices/live/tactus_live.h")
check(api <= exported, f"{len(api)} functions are exported; missing: {sorted(api - exported)}")
others = {name for name in exported if not name.startswith("tactus_") and not name.startswith("_ZN") and name != "TACTUS_LIVE_0"}
check(not others, f"nothing else is exported: {sorted(others)[:5]}")
check(b"BC\xc0\xde" not in pathlib.Path(live).read_bytes(), "it contains no bitcode")
sys.exit(1 if failures else 0)
