#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compiles the sources that differ on Windows, without linking them, with mingw-w64: ./test.sh --windows --sources

Usage: sources.py [FILE...]. Without files: all that ask for _WIN32, or are in a folder `windows`. They need nothing but Eigen. Exit status 1 if the compiler
says anything."""

import concurrent.futures
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PARTS = ("framework", "nodes", "host")
COMPILER = ("x86_64-w64-mingw32-g++-posix -std=c++20 -fsyntax-only -Wall -Wextra -Wpedantic -Wconversion -Werror -isystem /usr/include/eigen3 "
            '-D TACTUS_LIBRARY_VERSION="0"').split()


def differs(source):
    return source.parent.name == "windows" or "_WIN32" in source.read_text(encoding="utf-8")


def compiled(source, include):
    ran = subprocess.run([*COMPILER, "-I", include, "-I", ROOT, source], stderr=subprocess.PIPE, text=True, check=False)
    return source, ran.returncode, ran.stderr


def main(names):
    sources = [pathlib.Path(n).resolve() for n in names] or sorted(s for part in PARTS for s in (ROOT / part).rglob("*.cpp") if differs(s))
    bad = 0
    with tempfile.TemporaryDirectory() as include:
        public = pathlib.Path(include) / "tactus"   # as CMakeLists.txt makes it
        public.mkdir()
        headers = [h for part in PARTS for h in (ROOT / part).rglob("tactus*.h")]
        for part in [*(d for d in (ROOT / "framework").iterdir() if d.is_dir()), ROOT / "nodes", *headers]:
            (public / part.name).symlink_to(part)
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            for source, status, text in pool.map(lambda s: compiled(s, include), sources):
                print(f"{'ok ' if status == 0 else 'BAD'} {source.relative_to(ROOT)}\n{text}", end="", flush=True)
                bad += status != 0
    print(f"{len(sources)} sources for Windows, {bad} problems")
    return bad > 0 or not sources


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
