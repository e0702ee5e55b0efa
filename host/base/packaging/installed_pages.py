# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the pages as they are installed: a link to a file that is installed elsewhere leads there, and one to a file that only the sources have becomes its
text.

installed_pages.py SOURCE FOLDER DATA INCLUDE     DATA, INCLUDE: the installed folders of data and headers, seen from the folder of the pages
"""
import os
import pathlib
import re
import shutil
import sys

PAGES = ("docs/*.md", "docs/decisions/*.md", "docs/tutorials/*.md")
LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^)\s#]*)(#[^)\s]*)?\)|<img [^>]*?src=\"([^\"]+)\"[^>]*>")
FIXED = re.compile(r"^```.*?^```|`[^`\n]+`", re.M | re.S)
HEADERS = {"framework/capi/tactus.h", "framework/plugin/tactus_plugin.h", "host/devices/device_plugins/tactus_device.h", "host/devices/live/tactus_live.h"}
# As in framework/install.cmake.
NO_HEADERS = re.compile(r"framework/(capi|examine|python|kit/single|.*/examine|fit/(least_squares|ring_\w+|spectrum_model)|check/pair)\b")


def installed(path, data, include):
    """Where a file of the repository is installed, seen from the folder of the pages; None if it is not."""
    if path.startswith("docs/examples"):
        return f"{data}/doc/libtactus-dev/{path[len('docs/'):]}"
    if any(pathlib.PurePath(path).match(pattern) for pattern in PAGES):
        return path[len("docs/"):]
    if path.startswith("graphs/") and path.endswith(".json"):
        return f"{data}/tactus/{path}"
    if path.startswith("host/devices/profiles/") and path.endswith(".json"):
        return f"{data}/tactus/profiles/{os.path.basename(path)}"
    if path in HEADERS:
        return f"{include}/tactus/{os.path.basename(path)}"
    if path.endswith(".hpp") and path.startswith(("framework/", "nodes/")) and not NO_HEADERS.match(path):
        return f"{include}/tactus/{path[len('framework/'):] if path.startswith('framework/') else path}"
    return None


def rewritten(text, page, source, data, include):
    """The text of a page, whose path is that in the repository."""
    def of_link(link):
        picture, words, target, anchor, image = link.groups()
        target = target or image or ""
        if not target or "://" in target or target.startswith("mailto:"):
            return link.group()
        path = os.path.normpath(os.path.join(os.path.dirname(page), target))
        place = None if picture or image else installed(path, data, include)
        if place is None or not (source / path).exists():
            return words or ""
        place = os.path.relpath(place, os.path.dirname(page[len("docs/"):]) or ".")
        return f"[{words}]({place}{anchor or ''})"

    kept = []   # code inside of links stays, and code that looks like a link is none

    def keep(code):
        kept.append(code.group())
        return f"\0{len(kept) - 1}\0"

    text = LINK.sub(of_link, FIXED.sub(keep, text))
    return re.sub("\0(\\d+)\0", lambda at: kept[int(at[1])], text)


def main(source, folder, data, include):
    source, folder = pathlib.Path(source), pathlib.Path(folder)
    shutil.rmtree(folder, ignore_errors=True)
    for pattern in PAGES:
        for page in sorted(source.glob(pattern)):
            name = page.relative_to(source).as_posix()
            to = folder / page.relative_to(source / "docs")
            to.parent.mkdir(parents=True, exist_ok=True)
            to.write_text(rewritten(page.read_text(encoding="utf-8"), name, source, data, include), encoding="utf-8")


main(*sys.argv[1:])
