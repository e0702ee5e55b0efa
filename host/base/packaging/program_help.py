# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads what `--help` prints, for the man pages and the completions, so that they cannot differ from the program."""
import re
import subprocess
from dataclasses import dataclass, field


@dataclass
class Item:
    """An option, a positional argument or a command."""

    term: str   # as printed, such as "--rate FLOAT:from 1 to 1e+06 Excludes: --replay"
    about: str

    @property
    def names(self):
        return [name for name in self.term.split()[0].split(",") if name]

    @property
    def takes_value(self):
        words = self.term.split()[1:]
        return bool(words) and words[0] not in ("Needs:", "Excludes:", "REQUIRED")

    @property
    def alternatives(self):
        """The values of an option that takes one of a few words."""
        found = re.search(r"\{([^}]*)\}", self.term)
        return found[1].split(",") if found else []


@dataclass
class Help:
    name: str    # "tactus render"
    about: str
    usage: str
    positionals: list = field(default_factory=list)
    options: list = field(default_factory=list)
    commands: list = field(default_factory=list)
    footer: list = field(default_factory=list)   # lines


def run(program, arguments):
    return subprocess.run([program, *arguments], capture_output=True, text=True, encoding="utf-8", check=True).stdout


def read(program, name, command=None):
    """The help of a program, or of one of its commands."""
    lines = run(program, ([command] if command else []) + ["--help"]).rstrip("\n").split("\n")
    page = Help(f"{name} {command}" if command else name, lines[0], "")
    lists = {"Positionals:": page.positionals, "Options:": page.options, "Subcommands:": page.commands}
    current = None
    for i, line in enumerate(lines[1:], 1):
        if line.startswith("Usage: "):
            page.usage = line.removeprefix("Usage: ")
        elif line in lists:
            current = lists[line]
        elif current is not None and line.startswith("  "):
            take(current, line)
        elif line:
            page.footer = lines[i:]
            break
    return page


def take(items, line):
    """Adds a line of a list: a new item, or, if it is indented by 12 spaces, more text about the previous item."""
    if line.startswith(" " * 12):
        items[-1].about = f"{items[-1].about} {line.strip()}".strip()
        return
    term, _, about = line.strip().partition("  ")
    items.append(Item(term.strip(), about.strip()))


def read_all(program, name):
    """The help of a program and of each of its commands, except those whose own program is not built (TACTUS_BENCH)."""
    whole = read(program, name)
    return [whole] + [read(program, name, command.term) for command in whole.commands if is_built(program, command.term)]


def is_built(program, command):
    said = subprocess.run([program, command, "--help"], capture_output=True, text=True, encoding="utf-8", check=False)
    return said.returncode == 0 or "bench/not_built" not in said.stderr
