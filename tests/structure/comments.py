#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that the comment on a type begins with a noun: "The reading of a device at a tick.", not "What a device reports at a tick."

Usage: comments.py [SOURCE_FOLDER]. Prints FILE:LINE for each problem. Exit status 1 if there are any.

It looks at the first word of each comment of // or /// directly above a type, a template or an alias. It refuses the words that begin a clause
without a noun. Whether another word is a noun is left to the reader. The check first tries itself on REFUSED and FINE."""

import pathlib
import re
import sys

PARTS = ["framework", "nodes", "host"]
SUFFIXES = (".hpp", ".cpp", ".h")
TYPE = re.compile(r"\s*(template|class|struct|enum|union|using|concept|typedef)\b")
COMMENT = re.compile(r"\s*//+!?<?\s*")
CLAUSE = re.compile(r"(What|Whatever|That|Those|All that|Which|Whichever|Where|Wherever|How|Who|Whose|When|Whenever|While|Whether|Why)\b")

REFUSED = ["/// What it shows.\nstruct A", "    // Where it goes.\n    enum class A", "/// Whether it is\n/// open.\ntemplate <typename T>\nstruct A",
           "/// All that it needs.\nusing A = int;", "int a;\n\n/// How far it is.\n///\n/// A note.\nclass A"]
FINE = ["/// The part that it shows.\nstruct A", "/// What it shows.\nint a;", "int a;   ///< what it shows\nstruct A", "/// The one\n/// that is open.\nstruct A",
        "/// What it shows.\n\nstruct A", "/// Whatsoever.\nstruct A", "// What a file is for.\n\n/// A type.\nstruct A"]


def refused(text):
    """The number and the first word of each comment that is refused."""
    begin = None
    for number, line in enumerate(text.splitlines(), 1):
        if line.lstrip().startswith("//"):
            begin = begin or (number, CLAUSE.match(COMMENT.sub("", line, count=1)))
            continue
        if begin and begin[1] and TYPE.match(line):
            yield begin[0], begin[1].group()
        begin = None


def problems(root):
    for text in REFUSED:
        if not list(refused(text)):
            yield f"tests/structure/comments.py: this is not refused: {text!r}"
    for text in FINE:
        if list(refused(text)):
            yield f"tests/structure/comments.py: this is fine, and refused: {text!r}"
    for part in PARTS:
        for path in sorted((root / part).rglob("*")):
            if path.suffix in SUFFIXES:
                for number, word in refused(path.read_text(encoding="utf-8")):
                    yield f"{path.relative_to(root).as_posix()}:{number}: the comment on a type begins with \"{word}\"; begin it with a noun"


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parents[2]).resolve()
    found = list(problems(root))
    print("\n".join(found) or "no comment on a type begins with a clause")
    return 1 if found else 0


sys.exit(main())
