#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Fails on paragraphs that are too long to hold in the head, and on long pages without a table of contents.

    lengths.py [ROOT]     ROOT is the repository, by default the one that contains this file

A paragraph, or a paragraph of an item of a list, has at most 120 words. A page of more than 1500 words, without its tables and code, links to each of its
sections before the first one.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[2]
MOST_IN_PARAGRAPH, MOST_WITHOUT_CONTENTS = 120, 1500

PAGES = [*sorted(ROOT.glob("*.md")), ROOT / "graphs/README.md", *sorted(ROOT.glob("docs/*.md")), *sorted(ROOT.glob("docs/decisions/*.md")),
         *sorted(ROOT.glob("docs/tutorials/*.md"))]
CODE = re.compile(r"^ *```.*?^ *```", re.M | re.S)
ITEM = re.compile(r"\n(?= *(?:[-*]|\d+\.) )")


def anchor(heading):
    """The anchor of a heading, as GitHub makes it."""
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def paragraphs(text):
    for block in re.split(r"\n\s*\n", text):
        for part in ITEM.split(block):
            if not part.lstrip().startswith(("|", "#")):
                yield re.sub(r"\]\([^)]*\)", "]", part).split()


def problems(page):
    text = CODE.sub("\n\n", page.read_text(encoding="utf-8"))
    if page.name == "CHANGELOG.md":   # a list of what is new
        return
    words = 0
    for paragraph in paragraphs(text):
        words += len(paragraph)
        if len(paragraph) > MOST_IN_PARAGRAPH:
            yield f"a paragraph of {len(paragraph)} words, more than {MOST_IN_PARAGRAPH}: {' '.join(paragraph[:12])} …"
    if words <= MOST_WITHOUT_CONTENTS:
        return
    headings = re.findall(r"^## +(.*)$", text, re.M)
    linked = re.findall(r"\]\(#([^)]+)\)", re.split(r"^## ", text, 1, re.M)[0])
    missing = [heading for heading in headings if anchor(heading) not in linked]
    if missing or not headings:
        yield f"{words} words, and no link from above the first section to: {', '.join(missing) or 'sections, of which there are none'}"


def main():
    count = 0
    for page in PAGES:
        for problem in problems(page):
            print(f"{page.relative_to(ROOT)}: {problem}")
            count += 1
    print(f"{len(PAGES)} pages, {count} problems")
    return 1 if count else 0


if __name__ == "__main__":
    sys.exit(main())
