# SPDX-License-Identifier: MIT
"""The commands that compile the repository, from compile_commands.json, with the sources that each of them reads: a batch includes several."""

import json
import os
import pathlib
import re
import shlex
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
INCLUDED = re.compile(r'^#include (?:"(/.*\.(?:c|cpp))"|<tactus/(nodes/.*\.hpp)>)$', re.MULTILINE)
HEADER = [("-Xclang", "-include-pch"), ("-Xclang", "-include")]   # each is followed by -Xclang FILE


class Command:
    def __init__(self, build, entry):
        self.directory = entry["directory"]
        self.file = pathlib.Path(self.directory, entry["file"])
        self.arguments = shlex.split(entry["command"])
        self.makes_header = self.file.name.startswith("cmake_pch")
        in_build = self.file.is_relative_to(build)
        text = self.file.read_text(encoding="utf-8") if in_build and self.file.exists() else ""
        included = [pathlib.Path(source or ROOT / node) for source, node in INCLUDED.findall(text)]
        self.sources = {f for f in (included if in_build else [self.file]) if f.is_relative_to(ROOT) and not f.is_relative_to(build)}

    def without_object(self):
        at = self.arguments.index("-o")
        return self.arguments[:at] + self.arguments[at + 2 :]

    def without_precompiled(self):
        """The arguments without precompiled headers, and without the object."""
        kept, rest = [], self.without_object()
        while rest:
            if tuple(rest[:2]) in HEADER:
                del rest[:4]
            else:
                kept.append(rest.pop(0))
        return kept


def read(build):
    """All commands, after the batches are written."""
    entries = json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))
    files = [pathlib.Path(e["directory"], e["file"]) for e in entries]
    written = [f for f in files if f.name.startswith("joined_")]
    for batch in (f for f in files if f.parent.name == "Unity"):
        made = [pathlib.Path(f) for f, _ in INCLUDED.findall(batch.read_text(encoding="utf-8")) if f.startswith(str(build))]
        written += [f for f in made if not f.exists() and "exported" not in f.parts]
    # Ninja itself would first build all libraries that the batch links.
    for file in sorted({f.relative_to(build) for f in written}):
        write = subprocess.run(["ninja", "-C", build, "-t", "commands", "-s", file], capture_output=True, text=True, check=True).stdout
        subprocess.run(write.splitlines()[-1], shell=True, check=True)
    commands = [Command(build, e) for e in entries]
    # What the bench exports exists only once the command line is built.
    return [c for c in commands if not any("exported" in f.parts for f in c.sources)]


def cover(commands):
    """Commands that read each source once, the largest first."""
    seen, chosen = set(), []
    for command in sorted(commands, key=lambda c: (-len(c.sources), str(c.file))):
        if command.sources - seen:
            chosen.append(command)
            seen |= command.sources
    return chosen


def cpus():
    return os.cpu_count() or 1
