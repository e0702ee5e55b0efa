#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Fails on dead links and dead paths in the pages: README.md, CONTRIBUTING.md, docs/*.md, docs/decisions/*.md,
docs/tutorials/*.md, graphs/README.md.

    links.py [ROOT]     ROOT is the repository, by default the one that contains this file

Checks relative links and their #anchors, pictures, and names in backticks or code blocks that look like files of the repository:
paths that begin with one of its folders (a * must match something), and bare names of tests, scripts and headers. Paths with the
placeholders NAME or <...> are skipped, and so is everything under build/ and out/. Also fails if no page shows a picture of docs/host/,
or if the site has no place for a page.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else __file__).resolve()
ROOT = ROOT if len(sys.argv) > 1 else ROOT.parents[2]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted(ROOT.glob("docs/*.md")), *sorted(ROOT.glob("docs/decisions/*.md")),
         *sorted(ROOT.glob("docs/tutorials/*.md")), ROOT / "graphs/README.md"]

LINK = re.compile(r"\]\(([^)\s]+)\)|<img [^>]*src=\"([^\"]+)\"")
CODE = re.compile(r"^```.*?^```|`[^`\n]+`", re.M | re.S)
TOP = r"(?:framework|nodes|graphs|host|tests|docs|LICENSES|\.ci)/[\w./*<>-]*|\./\w+\.sh|CMake\w+\.\w+"
PATH = re.compile(rf"(?<![\w/.~-])(?:{TOP})")
BARE = re.compile(r"`(\w+_test|\w+\.(?:hpp|cpp|py|sh|md))`")
# Bare names of files that belong to other projects.
FOREIGN = re.compile(r"juce_|(CWoodenDevice|DS5_Output)\.cpp|(SpaceMouseWireless|SpaceNavigator|bluetooth_hid_notes|rumble_data_table)\.md")


def anchors(page):
    """The #anchors of a page's headings, as GitHub makes them."""
    text = re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.M | re.S)
    headings = re.findall(r"^#+ +(.*)$", text, re.M)
    return {re.sub(r"[^\w\- ]", "", h.lower()).replace(" ", "-") for h in headings}


def dead(path):
    """True if a path in code does not exist."""
    if "NAME" in path or "<" in path:
        return False
    return not (any(ROOT.glob(path)) if "*" in path else (ROOT / path).exists())


def files():
    """The names of all files; tests are listed both with and without their suffix."""
    names = set()
    for top in ("framework", "nodes", "graphs", "host", "tests", "docs", "."):
        for file in (ROOT / top).glob("*" if top == "." else "**/*"):
            names |= {file.name, file.stem} if file.stem.endswith("_test") else {file.name}
    return names


FILES = files()


def problems(page):
    text = page.read_text(encoding="utf-8")
    code = "\n".join(CODE.findall(text))
    for link in (a or b for a, b in LINK.findall(CODE.sub("", text))):
        if "://" in link or link.startswith("mailto:"):
            continue
        file, _, anchor = link.partition("#")
        target = (page.parent / file).resolve() if file else page
        if not target.exists():
            yield f"dead link: {link}"
        elif anchor and target.suffix == ".md" and anchor not in anchors(target):
            yield f"dead anchor: {link}"
    for path in sorted({p.rstrip(".:" if "<" in p else ".:>") for p in PATH.findall(code)}):
        if dead(path.removeprefix("./")):
            yield f"dead path: {path}"
    for name in sorted(set(BARE.findall(text)) - FILES):
        if not FOREIGN.match(name):
            yield f"no such file: {name}"


def main():
    count = 0
    for page in PAGES:
        for problem in problems(page):
            print(f"{page.relative_to(ROOT)}: {problem}")
            count += 1
    shown = {(p.parent / (a or b)).resolve() for p in PAGES for a, b in LINK.findall(p.read_text(encoding="utf-8")) if "://" not in (a or b)}
    for picture in sorted(ROOT.glob("docs/host/*.png")):
        if picture not in shown:
            print(f"{picture.relative_to(ROOT)}: no page shows this picture")
            count += 1
    placed = set(re.findall(r'"([\w/]+)"', (ROOT / "docs/site/make_pages.py").read_text(encoding="utf-8")))
    for page in sorted(ROOT.glob("docs/*.md")):
        if page.stem not in placed:
            print(f"{page.relative_to(ROOT)}: it has no place in SECTIONS of docs/site/make_pages.py")
            count += 1
    print(f"{len(PAGES)} pages, {count} problems")
    return 1 if count else 0


if __name__ == "__main__":
    sys.exit(main())
