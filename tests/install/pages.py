#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Fails if a page that is installed links to what is not: pages.py PREFIX SOURCE. Each page of the sources must be there, with its links to other pages."""
import pathlib
import re
import sys

LINK = re.compile(r"\]\(([^)\s]+)\)|<img [^>]*src=\"([^\"]+)\"")
CODE = re.compile(r"^```.*?^```|`[^`\n]+`", re.M | re.S)


def links(page):
    text = CODE.sub("", page.read_text(encoding="utf-8"))
    return [link for link in (a or b for a, b in LINK.findall(text)) if "://" not in link and not link.startswith(("mailto:", "#"))]


def main():
    folder, docs = pathlib.Path(sys.argv[1]).resolve() / "share/doc/tactus", pathlib.Path(sys.argv[2]).resolve() / "docs"
    found, count, elsewhere = [], 0, 0
    for source in [*docs.glob("*.md"), *docs.glob("decisions/*.md"), *docs.glob("tutorials/*.md")]:
        page = folder / source.relative_to(docs)
        if not page.exists():
            found.append(f"{page} is not installed")
            continue
        for link in links(page):
            count += 1
            to = page.parent / link.split("#")[0]
            elsewhere += folder not in to.resolve().parents
            if not to.exists():
                found.append(f"{page}: {link}")
        to_pages = [link for link in links(source) if link.split("#")[0].endswith(".md") and docs in (source.parent / link.split("#")[0]).resolve().parents]
        lost = set(to_pages) - set(links(page))
        found += [f"{page}: the link to {link} is lost" for link in sorted(lost)]
    if elsewhere < 20:
        found.append(f"only {elsewhere} links lead to examples, graphs and headers")
    print("\n".join(found) if found else f"{count} links of the installed pages lead to what is installed, {elsewhere} of them to examples, graphs and headers")
    return 1 if found else 0


sys.exit(main())
