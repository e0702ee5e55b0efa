#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks the C headers: c_headers.py [C_COMPILER_OR_C++_COMPILER...]. Prints FILE:LINE for each problem. Exit status 1 if there are any.

- The comment of each function, and of each function in a struct, says which thread may call it.
- Each tag is one that docs/threads.md explains.
- Each struct with a size has an initialiser, which sets the size and leaves nothing out.
- Each header compiles by itself and with the others, as C99 and as C++, without warnings, and so do all initialisers."""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
HEADERS = ("framework/capi/tactus.h", "host/devices/live/tactus_live.h", "framework/plugin/tactus_plugin.h", "host/devices/device_plugins/tactus_device.h")
FUNCTION = re.compile(r"^TACTUS_API [^;]*?\b(tactus_\w+) \([^;]*;", re.M)
HOOK = re.compile(r"^ +[\w* ]*\(\*\s*(\w+)\) \([^;]*;", re.M)
TYPE = re.compile(r"^typedef \w+ \(\*(tactus_\w+)\) \([^;]*;", re.M)
STRUCT = re.compile(r"^typedef struct (\w+)\n\{\n    uint32_t size;", re.M)
COMMENT = re.compile(r"/\*\*.*?\*/", re.S)
TAG = re.compile(r"\[([^\[\]]*?\bthreads?\b[^\[\]]*)\]")
WARNINGS = ("-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Werror")


def comment_of(text, declaration):
    """The comment behind a declaration, or else the one directly before it."""
    behind = COMMENT.match(text, declaration.end() + len(text[declaration.end():]) - len(text[declaration.end():].lstrip(" ")))
    if behind:
        return behind[0]
    before = text[:declaration.start()].rstrip()
    found = list(COMMENT.finditer(before))
    return found[-1][0] if found and found[-1].end() == len(before) else ""


def tags_of(comment):
    return [" ".join(tag.replace("*", " ").split()) for tag in TAG.findall(comment)]


def untagged(path, text, known):
    for pattern in (FUNCTION, HOOK, TYPE):
        for declaration in pattern.finditer(text):
            place = f"{path}:{text.count(chr(10), 0, declaration.start()) + 1}"
            tags = tags_of(comment_of(text, declaration))
            if not tags:
                yield f"{place}: the comment of {declaration[1]} does not say which thread may call it"
            for tag in tags:
                if not any(name in tag for name in known):
                    yield f"{place}: docs/threads.md does not explain [{tag}]"


def initialiser_of(struct, path):
    return struct.upper() + ("_INIT" if path.endswith(("plugin.h", "device.h")) else "")


def without_initialiser(path, text):
    for struct in STRUCT.finditer(text):
        macro = initialiser_of(struct[1], path)
        if not re.search(rf"^#define {macro} +\\\n +{{ +\\\n +sizeof \({struct[1]}\)", text, re.M):
            yield f"{path}:{text.count(chr(10), 0, struct.start()) + 1}: {struct[1]} has no initialiser {macro} that sets its size"


def uses(texts):
    """A function that begins each struct with its initialiser and checks the sizes."""
    lines = ["size_t everyStruct (void);", "size_t everyStruct (void)", "{", "    size_t wrong = 0;"]
    for path, text in texts.items():
        for struct in STRUCT.findall(text):
            lines.append(f"    {{ {struct} one = {initialiser_of(struct, path)}; wrong += one.size != sizeof one; }}")
    return "\n".join(lines + ["    return wrong;", "}", ""])


def compiled(compiler, texts, folder):
    is_cpp = "++" in pathlib.Path(compiler).name
    language = ["-x", "c++", "-std=c++17"] if is_cpp else ["-x", "c", "-std=c99"]
    names = [f"tactus/{pathlib.Path(path).name}" for path in texts]
    includes = {name: f"#include <{name}>\n" for name in names}
    units = {**includes, "all headers": "".join(includes.values()) + uses(texts), "all headers backwards": "".join(reversed(includes.values())) + uses(texts)}
    for name, unit in units.items():
        unit += "int unused;\n"
        result = subprocess.run([compiler, *language, *WARNINGS, "-fsyntax-only", f"-I{folder}", "-"], input=unit, capture_output=True, text=True)
        if result.returncode != 0:
            yield f"{compiler}: {name}:\n{result.stderr}"


def main():
    texts = {path: (ROOT / path).read_text(encoding="utf-8") for path in HEADERS}
    page = (ROOT / "docs/threads.md").read_text(encoding="utf-8")
    known = re.findall(r"^\| \*\*(.+?)\*\* \|", page, re.M)
    found = []
    for path, text in texts.items():
        found += untagged(path, text, known)
        found += without_initialiser(path, text)
    functions = sum(len(FUNCTION.findall(text)) for text in texts.values())
    if functions < 90 or len(known) < 5:
        found.append(f"only {functions} functions and {len(known)} threads were found, so this check does not know the headers")
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "tactus").mkdir()
        for path in HEADERS:
            shutil.copy(ROOT / path, pathlib.Path(folder) / "tactus")
        for compiler in sys.argv[1:] or [c for c in ("gcc", "g++", "clang", "clang++") if shutil.which(c)]:
            found += compiled(compiler, texts, folder)
    print("\n".join(found) if found else f"{functions} functions of the C API say which thread may call them, and every struct has an initialiser")
    return 1 if found else 0


sys.exit(main())
