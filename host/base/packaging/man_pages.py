# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes man pages from `--help`: one for the program, and one for each of its commands, as git does (tactus-render.1).

man_pages.py PROGRAM NAME VERSION DATE FOLDER
"""
import gzip
import pathlib
import re
import sys

import program_help

FILES = [("/usr/share/tactus/graphs", "the presets; TACTUS_PRESETS names another folder"),
         ("/usr/share/tactus/profiles", "the profiles of devices that come with Tactus"),
         ("~/.config/tactus/profiles", "your own profiles; TACTUS_PROFILES names another folder"),
         ("~/.config/Tactus", "settings and the session; TACTUS_HOME names another folder")]
STATUS = [("0", "all went well"), ("1", "a file or another input is at fault; the standard error says where and why"), ("2", "wrong usage")]


def escaped(text):
    text = text.replace("\\", "\\e").replace("-", "\\-").replace("'", "\\(aq").replace("`", "\\(ga").replace("^", "\\(ha").replace("~", "\\(ti")
    return re.sub(r"^\.", r"\\&.", text)


def definitions(items):
    for term, about in items:
        yield ".TP"
        yield f".B {escaped(term)}"
        yield escaped(about)


def section(title, items):
    return [f".SH {title}", *definitions(items)] if items else []


def footer(lines):
    """The prose and the examples below the options."""
    end = lines.index("Examples:") if "Examples:" in lines else len(lines)
    prose, examples = lines[:end], lines[end + 1:]
    if prose and any(prose):
        yield ".SH NOTES"
        for line in prose:
            yield escaped(line) if line else ".PP"
    while examples and not examples[-1]:
        examples.pop()
    if examples:
        yield ".SH EXAMPLES"
        shown = [line for line in examples if line.startswith("  ") or not line]
        yield ".nf"
        for line in shown:
            yield escaped(line.strip()) if line else ".sp"
        yield ".fi"
        for line in examples[len(shown):]:
            yield ".PP"
            yield escaped(line)


def page(found, title, version, date, others):
    about = found.about.removeprefix("Tactus: ").rstrip(".")
    lines = [".\\\" -*- coding: UTF-8 -*-", f'.TH {title.upper()} 1 {date} "Tactus {version}" "Tactus"',
             ".SH NAME", f"{title} \\- {escaped(about[0].lower() + about[1:])}",
             ".SH SYNOPSIS", f".B {escaped(found.usage)}"]
    lines += section("COMMANDS", [(item.term, item.about) for item in found.commands])
    lines += section("ARGUMENTS", [(item.term, item.about) for item in found.positionals])
    lines += section("OPTIONS", [(", ".join(item.names) + item.term[len(item.term.split()[0]):], item.about) for item in found.options])
    lines += footer(found.footer)
    lines += section("EXIT STATUS", STATUS) + section("FILES", FILES)
    lines += [".SH SEE ALSO", "\n".join(f".BR {escaped(name)} (1)" for name in others if name != title)]
    return "\n".join(lines) + "\n"


def main(program, name, version, date, folder):
    pages = {found.name.replace(" ", "-"): found for found in program_help.read_all(program, name)}
    titles = sorted({*pages, "tactus", "tactus-host"})
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    for title, found in pages.items():
        others = titles if title in ("tactus", "tactus-host") else ["tactus"]
        text = page(found, title, version, date, others)
        (folder / f"{title}.1.gz").write_bytes(gzip.compress(text.encode(), 9, mtime=0))


main(*sys.argv[1:])
