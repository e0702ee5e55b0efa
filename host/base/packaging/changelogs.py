# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the two changelogs of a Debian package: CHANGELOG.md, and the list of the versions of the package.

changelogs.py CHANGELOG.md MAINTAINER FOLDER
"""
import datetime
import email.utils
import gzip
import pathlib
import re
import sys


def packages(text, maintainer):
    for version, date in re.findall(r"^## ([\d.]+) \(([\d-]+)\)$", text, re.MULTILINE):
        noon = datetime.datetime.fromisoformat(date + "T12:00:00+00:00")
        signature = f" -- {maintainer}  {email.utils.format_datetime(noon)}\n"
        yield f"tactus ({version}-1) unstable; urgency=medium\n\n  * Version {version}: see changelog.gz.\n\n{signature}"


def main(changelog, maintainer, folder):
    text = pathlib.Path(changelog).read_text(encoding="utf-8")
    for name, content in (("changelog.gz", text), ("changelog.Debian.gz", "\n".join(packages(text, maintainer)))):
        (pathlib.Path(folder) / name).write_bytes(gzip.compress(content.encode(), 9, mtime=0))


main(*sys.argv[1:])
