#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs what the pages show: the blocks of code in README.md, CONTRIBUTING.md, docs/*.md and docs/tutorials/*.md.

    blocks.py BUILD [PAGE...]     BUILD is a finished build, such as build/release; without PAGE, all pages

Each page gets a folder of its own, with the folders of the repository in it, a home of its own, and `tactus` on the PATH. Its blocks run there from the
first to the last:

    ```sh        runs in bash, and fails if one of its commands fails. `play`, `probe` and `fake-device` without --duration end after a second
    ```python    runs in one Python, with the package of the build
    ```json      can be read; a graph is valid
    others       stand in a file that is compiled or run elsewhere (from:), or are compiled here (compiles)
    ```          shows what a program prints, or how a line looks, and is left alone

A comment on the line above a block changes this:

    <!-- not run: REASON -->         the block is left alone, and the reason says why, or what else runs it
    <!-- file: NAME -->              the block is written to this file first, also if it is not run
    <!-- first: COMMANDS -->         runs before the block, in the same bash, Python or header. With BACKGROUND=1 before it, `tactus play` runs until the block
                                     ends, and is the one that `set`, `hit` and `probe` talk to
    <!-- in the background -->       the block runs until the page ends
    <!-- fails -->                   the last command of the block fails
    <!-- compiles -->                a header in C++ that the compiler of the build takes
    <!-- from: PATH -->              the lines of the block stand in this file of the repository, in this order

A command in the text, such as `tactus render GRAPH --plot FILE`, is not run, but its options must exist. Exit status 77 if the Python package is not built, and
all else is fine.
"""
import json
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
COPIED = ("graphs", "docs")   # a command may write there
FENCE = re.compile(r"^( *)```([\w{}+-]*)\s*$")
DIRECTIVE = re.compile(r"^ *<!-- (not run: |file: |first: |from: |in the background|compiles|fails)(.*?) ?-->\s*$")
INLINE = re.compile(r"`tactus ([a-z][a-z-]+)((?: [^`]*)?)`")
LONGEST_S = 600   # what takes longer hangs


class Failed(Exception):
    pass


class Block:
    def __init__(self, page, line, language, directives):
        self.page, self.line, self.language, self.directives, self.lines = page, line, language, directives, []

    @property
    def text(self):
        return "".join(line + "\n" for line in self.lines)

    def where(self):
        return f"{self.page}:{self.line}"


def blocks_of(page, text):
    """The blocks of a page, in order. A directive that stands above no block is an error."""
    found, open_block, indent, directives = [], None, "", {}
    for number, line in enumerate(text.splitlines(), 1):
        fence, directive = FENCE.match(line), DIRECTIVE.match(line)
        if open_block is not None:
            if fence and not fence[2]:
                found.append(open_block)
                open_block = None
            else:
                open_block.lines.append(line.removeprefix(indent))
        elif fence:
            open_block, indent, directives = Block(page, number + 1, fence[2], directives), fence[1], {}
        elif directive:
            directives[directive[1].strip(" :")] = directive[2].strip()
        elif directives and line.strip():
            raise Failed(f"{page}:{number}: {', '.join(directives)}: there is no block below")
    if open_block is not None:
        raise Failed(f"{open_block.where()}: the block has no end")
    return found


def shim(program, osc):
    """A `tactus` that runs the real one, but ends by itself, and does not meet other programs at the usual port."""
    return f"""#!/bin/bash
command=${{1-}}
case $command in play|probe|fake-device)
    case "$BACKGROUND $* " in 1*|*" --duration "*|*" --trigger "*|*" --help "*) ;; *) set -- "$@" --duration 1 ;; esac ;;
esac
case $command in
    play) case " $* " in *" --osc "*) ;; *) [ -n "$BACKGROUND" ] && port={osc}; set -- "$@" --osc "${{port-off}}" ;; esac ;;
    set|probe|hit) set -- "$@" --osc {osc} ;;
esac
exec {program} "$@"
"""


class Page:
    def __init__(self, name, text, build, folder):
        self.name, self.text, self.build, self.folder = name, text, build, folder
        self.background, self.python = [], []
        for part in ROOT.iterdir():
            if part.name in COPIED:
                shutil.copytree(part, folder / part.name)
            elif part.name not in (".git", "build", "out"):
                (folder / part.name).symlink_to(part)
        programs = folder / "build/release/bin"
        programs.mkdir(parents=True)
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as free:
            free.bind(("127.0.0.1", 0))
            osc = free.getsockname()[1]
        for program in (build / "bin").iterdir():
            (programs / program.name).symlink_to(program)
        (programs / "tactus").unlink()
        (programs / "tactus").write_text(shim(build / "bin/tactus", osc), encoding="utf-8")
        (programs / "tactus").chmod(0o755)
        (folder / "home").mkdir()
        self.environment = {**os.environ, "PATH": f"{programs}:{os.environ['PATH']}", "HOME": str(folder / "home"),
                            "XDG_CONFIG_HOME": str(folder / "home/.config"), "BACKGROUND": "", "PYTHONPATH": str(build / "python"), "MPLBACKEND": "Agg",
                            "CMAKE_PREFIX_PATH": str(build / "plugin_kit")}
        for name in ("TACTUS_HOME", "TACTUS_PLUGINS", "TACTUS_PROFILES"):
            self.environment.pop(name, None)

    def run(self):
        """Runs all blocks. Returns how many ran, by kind, and why others did not."""
        counts, left = {}, []
        try:
            for block in blocks_of(self.name, self.text):
                if "not run" in block.directives:
                    if len(block.directives["not run"].split()) < 2:
                        raise Failed(f"{block.where()}: say why it is not run")
                    left.append((block, block.directives["not run"]))
                    self.write(block)
                    continue
                counts[block.language or "text"] = counts.get(block.language or "text", 0) + 1
                self.take(block)
            if self.python:
                program = "".join(block.directives.get("first", "") + "\n" + block.text for block in self.python)
                self.execute([sys.executable, "-B", "-"], self.python[0], program)
        finally:
            for process in self.background:
                os.killpg(process.pid, signal.SIGINT)
                process.wait(timeout=120)
        return counts, left

    def write(self, block):
        if "file" in block.directives:
            path = self.folder / block.directives["file"]
            path.parent.mkdir(parents=True, exist_ok=True)
            path.unlink(missing_ok=True)
            path.write_text(block.text, encoding="utf-8")

    def take(self, block):
        self.write(block)
        if "from" in block.directives:
            self.compare(block)
        elif "compiles" in block.directives:
            header = self.folder / "shown.hpp"
            header.write_text(block.directives.get("first", "") + "\n" + block.text, encoding="utf-8")
            self.execute(["c++", "-std=c++20", "-fsyntax-only", "-I", str(self.build / "include"), "-I", str(ROOT), "-isystem", "/usr/include/eigen3",
                          "-include", str(header), "-x", "c++", "/dev/null"], block, "")
        elif block.language == "sh":
            self.shell(block)
        elif block.language == "python":
            self.python.append(block)
        elif block.language == "json":
            self.read(block)
        elif block.language and "file" not in block.directives:
            raise Failed(f"{block.where()}: nothing runs this block; write <!-- from: PATH --> or <!-- not run: REASON --> above it")

    def compare(self, block):
        path = ROOT / block.directives["from"]
        if not path.is_file():
            raise Failed(f"{block.where()}: there is no file {block.directives['from']}")
        rest = iter(" ".join(line.split()) for line in path.read_text(encoding="utf-8").splitlines())
        for line in filter(None, (" ".join(line.split()) for line in block.lines)):
            if line not in rest:   # consumes what comes before it
                raise Failed(f"{block.where()}: {block.directives['from']} does not have, in this order: {line}")

    def read(self, block):
        text = block.text.strip()
        try:
            value = json.loads(text if text.startswith(("{", "[")) else "{" + text.rstrip(",") + "}")
        except ValueError as error:
            raise Failed(f"{block.where()}: this is no JSON: {error}") from error
        if isinstance(value, dict) and value.get("format") == "tactus-graph":
            graph = self.folder / block.directives.get("file", "shown.json")
            graph.write_text(block.text, encoding="utf-8")
            self.execute([str(self.build / "bin/tactus"), "validate", str(graph)], block, "")

    def shell(self, block):
        script = "set -eo pipefail\n" + (block.directives.get("first", "") + "\n") + block.text
        if "in the background" in block.directives:
            environment = {**self.environment, "BACKGROUND": "1"}
            self.background.append(subprocess.Popen(["bash", "-c", script], cwd=self.folder, env=environment, stdin=subprocess.DEVNULL,
                                                    stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True))
            return
        self.execute(["bash", "-c", script + "\nkill $(jobs -p) 2>/dev/null || true; wait" if "first" in block.directives else script], block, "")

    def execute(self, command, block, given):
        with subprocess.Popen(command, cwd=self.folder, env=self.environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                              start_new_session=True) as ran:
            try:
                out, err = ran.communicate(given, LONGEST_S)
            except subprocess.TimeoutExpired as error:
                os.killpg(ran.pid, signal.SIGKILL)
                raise Failed(f"{block.where()}: it does not end within {LONGEST_S} s") from error
        if (ran.returncode == 0) == ("fails" in block.directives):
            told = "it does not fail" if ran.returncode == 0 else f"exit status {ran.returncode}"
            raise Failed(f"{block.where()}: {told}\n{block.text}{out[-2000:]}{err[-4000:]}")


def wrong_options(name, text, program, helps):
    """Commands in the text that do not exist, and options that they do not have."""
    bare = re.sub(r"^ *```.*?^ *```", "", text, flags=re.M | re.S)
    for command, rest in INLINE.findall(bare):
        if command not in helps:
            ran = subprocess.run([program, command, "--help"], capture_output=True, text=True, check=False)
            helps[command] = None if "bench/not_built" in ran.stderr else ran.stdout if ran.returncode == 0 else ""
        if helps[command] is None:
            print(f"not checked: {name}: tactus {command}, whose program is not built (TACTUS_BENCH)")
            continue
        if not helps[command]:
            yield f"{name}: there is no command: tactus {command}"
        for option in re.findall(r"(?<![\w-])--[a-z][a-z-]+", rest):
            of_kind = re.match(r" ([a-z]+)\b", rest)   # `fit friction`, `curve hertz`
            known = helps[command]
            if of_kind and option not in known:
                asked = [program, command, of_kind[1], "--help"]
                known = helps.setdefault(command + of_kind[0], subprocess.run(asked, capture_output=True, text=True, check=False).stdout)
            if helps[command] and option not in known:
                yield f"{name}: tactus {command} has no option {option}"


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    pages = [pathlib.Path(page).resolve() for page in sys.argv[2:]] or [
        ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").glob("*.md")), *sorted((ROOT / "docs/tutorials").glob("*.md"))]
    has_python = (build / "python/tactus").is_dir()
    problems, total, left_alone, helps = [], {}, [], {}
    for path in pages:
        name, text = path.relative_to(ROOT), path.read_text(encoding="utf-8")
        problems += wrong_options(name, text, build / "bin/tactus", helps)
        with tempfile.TemporaryDirectory() as folder:
            try:
                found = blocks_of(name, text)
                if not found or (not has_python and any(block.language == "python" and "not run" not in block.directives for block in found)):
                    continue
                counts, left = Page(name, text, build, pathlib.Path(folder)).run()
            except Failed as problem:
                problems.append(str(problem))
                continue
        left_alone += left
        for language, count in counts.items():
            total[language] = total.get(language, 0) + count
    for block, reason in left_alone:
        print(f"not run: {block.where()}: {reason}")
    print("\n".join(problems))
    counts = ", ".join(f"{count} {language}" for language, count in sorted(total.items()))
    print(f"{len(pages)} pages; {counts}; {len(left_alone)} left alone; {len(problems)} problems")
    if problems:
        return 1
    return 0 if has_python else 77


if __name__ == "__main__":
    sys.exit(main())
