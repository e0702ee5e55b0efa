#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the source of the site, which Sphinx reads: make_pages.py TACTUS SOURCE [PRESET...]

The pages of the repository come as they are, in sections. Links that lead out of the pages become copies of the files. A page is made for each node, from its
datasheet and the comment of its header; for each preset, from its file and a run of it; for the commands, from their --help; and for the interfaces in C++
and Python, from the comments of the headers and of the package tactus, which must be on PYTHONPATH."""

import importlib
import inspect
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import laws

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Code, in which links are none, or a link, whose text may have code.
PART = re.compile(r"^```.*?^```|(?P<picture>!?)\[(?P<text>(?:[^\[\]]|\[[^\]]*\])*)\]\((?P<target>[^)\s]+)\)|`[^`\n]+`", re.M | re.S)

# Pages of the repository, and what they are called on the site.
PAGES = {"README.md": "start", "CONTRIBUTING.md": "contributing", "SECURITY.md": "security", "CHANGELOG.md": "changelog", "graphs/README.md": "preset_table",
         **{f"docs/{path.name}": path.stem for path in sorted((ROOT / "docs").glob("*.md"))},
         **{f"docs/tutorials/{path.name}": f"tutorials/{path.stem}" for path in sorted((ROOT / "docs/tutorials").glob("*.md"))},
         **{f"docs/decisions/{path.name}": "decisions/" + ("index" if path.stem == "README" else path.stem)
            for path in sorted((ROOT / "docs/decisions").glob("*.md"))}}

NOTEBOOKS = {"docs/examples/python/fig4.ipynb": "tutorials/notebook", "docs/tutorials/lab.ipynb": "tutorials/lab"}

# The index: each section with a sentence, and its pages in the order of reading.
SECTIONS = {
    "Start": ("What Tactus is, and a first feel: in the browser, or on your computer.", ["start", "playground", "gallery/index"]),
    "Tutorials": ("A quarter of an hour each, from nothing to something that you feel.",
                  [*(f"tutorials/{name}" for name in ("first_graph", "first_node", "first_device", "recording_to_preset", "embed")), "tutorials/notebook", "tutorials/lab"]),
    "How to": ("One page per task: first patching and playing, then devices, then programs of your own.",
               ["host", "replay", "fit", "import", "clips", "spectra", "devices", "known_devices", "sessions", "audio", "check", "realtime",
                "library", "steps", "states", "live", "export", "python", "csharp", "lab", "studies", "plugins", "windows"]),
    "Concepts": ("What the words mean, and how the parts work together.",
                 ["concepts", "glossary", "chapter", "safety", "hazards", "architecture", "panels", "threads", "fusion"]),
    "Reference": ("Nodes, files, commands, interfaces, costs.",
                  ["nodes/index", "graph_file", "commands", "osc", "profiles", "wires", "cpp_api", "c_api", "python_api",
                   "preset_table", "bench", "instructions", "promises", "changelog", "contributing", "security"]),
    "Decisions": ("The reasons for the design, and what was measured.", ["decisions/index"]),
}

TITLES = {"start": "Install, and a first feel <start>", "tutorials/notebook": "A Python notebook <tutorials/notebook>",
          "tutorials/lab": "An experiment in a notebook <tutorials/lab>"}

# Words of the glossary that have other meanings, too. They become links only where a page links them to the glossary, or has them in bold.
EVERYDAY = set("binding bypass check claim clock control engine feed fused hit instance limit passive port probe rate reading record run section session setting stable "
               "stop tap trace wire".split())
PLURALS = {"quantum": "quanta"}
# What stays as it is when words become links: code, headings, links, markup, and names of buttons.
FIXED = re.compile(r"^ *```.*?^ *```|^#.*?$|^ {4,}.*?$|(?<!\*)\*(?!\*)[^*\n]+\*(?!\*)|"
                   r"!?\[(?:[^\[\]]|\[[^\]]*\])*\]\([^)\s]+\)|\{term\}`[^`]+`|`[^`\n]+`|<[^>\n]+>", re.M | re.S)

# The headers of the C++ interface: where a program that uses Tactus begins, and what these need.
HEADERS = ("framework/node", "framework/graph", "framework/file", "framework/plan", "framework/run", "framework/run/clock", "framework/run/device")
DECLARED = re.compile(r"^((?:///(?! *@)[^\n]*\n)+)(?:template <[^\n]*>\n)?(?:\[\[\w+\]\] )?(?:(?:class|struct|enum class) (?P<type>\w+)(?: final)?[^;\n]*$|"
                      r"[^\n(=]*?\b(?P<call>\w+) \()", re.M)

GESTURES = ("stroke", "circle", "press", "tap", "cut")   # tags of presets, and the parts of the gallery


def run(*command):
    return subprocess.run([str(part) for part in command], check=True, capture_output=True, text=True).stdout


def escaped(text):
    """A text in a cell of a table."""
    return re.sub(r"([|<*_\[\]])", r"\\\1", text)


def graph_of(path):
    return json.loads(path.read_text(encoding="utf-8"))


def types_in(graph):
    """The types of all nodes of a graph, in its subgraphs too."""
    parts = [graph, *graph.get("graphs", {}).values()]
    return {node["type"] for part in parts for node in part.get("nodes", {}).values()}


class Site:
    def __init__(self, tactus, source, presets):
        self.tactus, self.source = tactus, source
        self.presets = {name: graph_of(ROOT / "graphs" / f"{name}.json") for name in presets}
        self.nodes = json.loads(run(tactus, "nodes", "--json"))
        self.figures = {path.stem: types_in(graph_of(path)) for path in sorted((ROOT / "docs/figures").glob("*.json")) if path.with_suffix(".png").is_file()}

    def write(self, name, text):
        path = self.source / f"{name}.md"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def copied(self, path):
        """A copy of a file of the repository, which a page can link to."""
        kept = self.source / "files" / path
        if kept.suffix == ".md":
            kept = kept.with_suffix(".md.txt")   # not a page
        kept.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / path, kept)
        return kept.relative_to(self.source)

    def moved(self, link, of, name):
        """The part of a page that stands for a link: `of` is the path of the page in the repository, `name` its name on the site."""
        picture, text, target = link["picture"], link["text"], link["target"]
        if target is None or "://" in target or target.startswith(("mailto:", "#")):
            return link.group()
        if "](" in text:   # a picture in a link
            text = PART.sub(lambda inner: self.moved(inner, of, name), text)
        file, _, anchor = target.partition("#")
        path = pathlib.PurePosixPath(os.path.normpath(pathlib.PurePosixPath(of).parent / file))
        here = pathlib.PurePosixPath(name).parent
        if str(path) in NOTEBOOKS:
            return f"{picture}[{text}]({os.path.relpath(NOTEBOOKS[str(path)] + '.ipynb', here)})"
        if str(path) == "docs/glossary.md" and not anchor and (term := self.term(text)):
            return term
        if str(path) in PAGES:
            return f"{picture}[{text}]({os.path.relpath(PAGES[str(path)] + '.md', here)}{'#' + anchor if anchor else ''})"
        if path.suffix == ".webm":
            return self.video(path, text, here)
        if (ROOT / path).is_file():
            return f"{picture}[{text}]({os.path.relpath(self.copied(path), here)})"
        return f"{text} (`{path}/`)"

    def video(self, path, picture, here):
        """A film, with the picture that stands for it as its poster. Sphinx copies what is in _static, but not what only HTML names."""
        told, poster = re.fullmatch(r"!\[(.*)\]\((.*)\)", picture, re.S).groups()
        for file in (path, path.with_name(pathlib.PurePosixPath(poster).name)):
            shutil.copy(ROOT / file, self.source / "_static")
        up = os.path.relpath("_static", here)
        return (f'<video controls preload="none" muted width="1280" height="720" aria-label="{told}" '
                f'poster="{up}/{pathlib.PurePosixPath(poster).name}" src="{up}/{path.name}"></video>')

    def page(self, of, name):
        text = re.sub(r'<img src="([^"]+)"(?: width="\d+")? alt="([^"]*)">', r"![\2](\1)", (ROOT / of).read_text(encoding="utf-8"))
        if not re.search("^##", text, re.M):   # a page in paragraphs with names
            text = re.sub(r"^\*\*([^*]+)\*\*", r"## \1\n\n**\1**", text, flags=re.M)
        return PART.sub(lambda link: self.moved(link, of, name), text)

    def words(self):
        """The words of the glossary, each with its spellings."""
        words = re.findall(r"^- \*\*(.*?)\*\*: ", (ROOT / "docs/glossary.md").read_text(encoding="utf-8"), re.M)
        return {spelling: word for word in words for spelling in (word, PLURALS.get(word, word + "s"))}

    def term(self, text):
        """A link to a word of the glossary, or None if the text is none."""
        word = self.words().get(text.lower())
        return word and (f"{{term}}`{text}`" if text == word else f"{{term}}`{text} <{word}>`")

    def linked(self, text, done=()):
        """The first use of each word of the glossary in a text becomes a link to it, except for the words in `done`."""
        spellings, done = self.words(), set(done)
        either = "|".join(sorted(map(re.escape, spellings), key=len, reverse=True))
        use = re.compile(rf"\*\*({either})\*\*|(?<![\w/.-])({either})(?![\w/-]|\.\w)", re.I)

        def link(match):
            found = match[1] or match[2]
            word = spellings[found.lower()]
            if word in done or (match[2] and word in EVERYDAY):
                return match.group()
            done.update(word.split() + [word])
            return self.term(found)

        parts, end = [], 0
        for fixed in FIXED.finditer(text):
            parts.append(use.sub(link, text[end:fixed.start()]))
            end = fixed.end()
            if named := re.match(r"\{term\}`(?:[^`]*<)?([^`>]+)>?`", fixed.group()):
                done.add(named[1])
            parts.append(fixed.group())
        return "".join(parts) + use.sub(link, text[end:])

    def pages(self):
        for of, name in PAGES.items():
            text = self.page(of, name)
            if name == "glossary":
                text = self.glossary(text)
            elif name not in ("changelog", "preset_table", "instructions"):   # lists; and presets have everyday words
                text = self.linked(text)
            if name == "playground":
                text = text.replace("\n\n", "\n\n<a href=\"playground/index.html\">Open the playground</a>\n\n", 1)
            self.write(name, text)

    def glossary(self, text):
        """The glossary, in which each entry links the words that it uses."""
        head, *entries = text.rstrip().split("\n- ")
        terms = (re.fullmatch(r"\*\*(.*?)\*\*: (.*)", entry.rstrip(), re.S).groups() for entry in entries)
        return f"{head}\n\n:::{{glossary}}\n" + "\n\n".join(f"{word}\n  {self.linked(meaning, [word])}" for word, meaning in terms) + "\n:::\n"

    def page_film(self):
        """The film at the top of the README."""
        lines = (ROOT / "README.md").read_text(encoding="utf-8").splitlines()
        return PART.sub(lambda link: self.moved(link, "README.md", "index"), next(line for line in lines if line.startswith("[![") and ".webm" in line))

    def index(self):
        text = "# Tactus\n\nHaptic effects, patched like a modular synthesiser. [Feel a few in the browser](playground.md), or [build it](start.md).\n"
        text += "\n" + self.page_film() + "\n"
        for title, (about, pages) in SECTIONS.items():
            named = [TITLES.get(page, page) for page in pages]
            text += f"\n## {title}\n\n{about}\n\n```{{toctree}}\n:caption: {title}\n:maxdepth: 1\n\n" + "\n".join(named) + "\n```\n"
        self.write("index", text)
        (self.source / "tutorials").mkdir(parents=True, exist_ok=True)
        for notebook, page in NOTEBOOKS.items():
            shutil.copy(ROOT / notebook, self.source / f"{page}.ipynb")
        decisions = [name for name in PAGES.values() if name.startswith("decisions/") and name != "decisions/index"]
        path = self.source / "decisions/index.md"
        path.write_text(path.read_text() + "\n```{toctree}\n:hidden:\n\n" + "\n".join(name.split("/")[1] for name in decisions) + "\n```\n")

    # ------------------------------------------------------------------ nodes

    def law_of(self, node):
        """The comment of the header of a node, as Markdown."""
        family, _ = node["id"].split(".")
        for header in sorted((ROOT / "nodes" / family).glob("**/*.hpp")):
            text = header.read_text(encoding="utf-8")
            if f'.id = "{node["id"]}"' not in text:
                continue
            comment = re.search(r"((?:^///[^\n]*\n)+)(?:template <[^\n]*>\n)?struct", text, re.M)
            lines = [re.sub("^/// ?", "", line) for line in comment.group(1).splitlines()]
            ports = {port["id"] for kind in ("inputs", "params", "settings", "outputs") for port in node[kind]}
            return header, self.with_laws("\n".join(self.prose(lines)), ports)
        return None, ""

    @staticmethod
    def with_laws(text, ports):
        """Blocks of code that are laws are typeset."""
        return re.sub(r"^```\n(.*?)^```$", lambda block: laws.law(block[1].splitlines(), ports) or block[0], text, flags=re.M | re.S)

    @staticmethod
    def prose(lines):
        """Blocks that are indented become code, and a line above a list becomes a heading."""
        made, in_code = [], False
        for line, after in zip(lines, [*lines[1:], ""]):
            is_code = line.startswith("    ") and (in_code or not made or made[-1] == "")
            if in_code and line == "" and after.startswith("    "):
                is_code = True
            if is_code != in_code:
                if in_code and made[-1] == "":
                    made.pop()
                made += ["```", ""] if in_code else ["```"]
            in_code = is_code
            if is_code:
                made.append(line[4:])
            elif re.match(r" ?- ", after) and line and not line.startswith((" ", "-")):
                made += ["", f"### {line.rstrip(':')}", ""]
            else:
                made.append(re.sub(r"([<*\\])", r"\\\1", line))
        return made + (["```"] if in_code else [])

    @staticmethod
    def number(value):
        return ", ".join(f"{part:g}" for part in value) if isinstance(value, list) else f"{value:g}" if isinstance(value, float) else str(value)

    def range_of(self, port):
        low, high = (port.get("usual_range") or port.get("hard_range") or [None, None])
        if port.get("choices"):
            return ", ".join(map(str, port["choices"]))
        return "" if low is None and high is None else f"{'' if low is None else self.number(low)}…{'' if high is None else self.number(high)}"

    def table(self, title, ports):
        if not ports:
            return ""
        rows = [f"\n## {title}\n\n| name | unit | default | range | meaning |\n|---|---|---|---|---|\n"]
        for port in ports:
            default = port.get("default", "")
            default = json.dumps(default) if isinstance(default, (dict, str)) and default != "" else self.number(default)
            cells = [f"`{port['id']}`", port.get("unit", port.get("kind", "")), default if len(default) < 60 else "a table", self.range_of(port), port["about"]]
            rows.append("| " + " | ".join(escaped(str(cell)) if i else cell for i, cell in enumerate(cells)) + " |\n")
        return "".join(rows)

    def node_page(self, node):
        users = [name for name, graph in self.presets.items() if node["id"] in types_in(graph)]
        header, law = self.law_of(node)
        text = f"# {node['name']}\n\n`{node['id']}`. {node['summary']}\n\nSource: {node['source']}.\n"
        if users:
            text += f"\n<a href=\"../playground/index.html#preset={users[0]}\">Open in the playground</a>, in the preset {self.presets[users[0]]['name']}.\n"
        if law:
            text += f"\n## Law\n\n{law}\n"
        is_model = not node["id"].startswith(("signal.", "device.", "vector."))
        figure = next((name for name, types in self.figures.items() if is_model and node["id"] in types), None)
        if figure:
            picture = self.copied(f"docs/figures/{figure}.png")
            graph = self.copied(f"docs/figures/{figure}.json")
            text += f"\n## Figure\n\n![{node['name']}, in the figure {figure}](../{picture})\n\n[The graph of the figure](../{graph}).\n"
        for title in ("inputs", "params", "settings", "outputs"):
            text += self.table(title.capitalize(), node[title])
        if users:
            text += "\n## Presets that use it\n\n" + "".join(f"- [{self.presets[name]['name']}](../gallery/{name}.md)\n" for name in users)
        if header:
            text += f"\n[The header](../{self.copied(header.relative_to(ROOT))}).\n"
        self.write("nodes/" + node["id"], text)

    def node_pages(self):
        families = {}
        for node in self.nodes:
            self.node_page(node)
            families.setdefault(node["id"].split(".")[0], []).append(node)
        text = f"# Nodes\n\nAll {len(self.nodes)} node types, by family. `tactus nodes` prints the same.\n"
        for family, nodes in families.items():
            text += f"\n## {family}\n\n" + "".join(f"- [`{node['id']}`]({node['id']}.md): {node['summary']}\n" for node in nodes)
        text += "\n```{toctree}\n:hidden:\n\n" + "\n".join(node["id"] for node in self.nodes) + "\n```\n"
        self.write("nodes/index", text)

    # ------------------------------------------------------------------ gallery

    def preset_page(self, name):
        graph, media = self.presets[name], self.source / "_static/gallery"
        media.mkdir(parents=True, exist_ok=True)
        file = ROOT / "graphs" / f"{name}.json"
        run(self.tactus, "render", file, "--plot", media / f"{name}.png", "--size", "150x90", "--dpi", "110", "--listen", media / f"{name}.wav")
        (media / f"{name}_patch.svg").write_text(importlib.import_module("tactus").Graph(file)._repr_svg_(), encoding="utf-8")
        title, known = graph["name"], {node["id"] for node in self.nodes}
        links = (f"<a href=\"../playground/index.html#preset={name}\">Play</a> · [Download](../{self.copied(f'graphs/{name}.json')}) · "
                 f"edit with `tactus-host graphs/{name}.json`")
        text = f"# {title}\n\n{graph['about']}\n\n{links}\n\n![The forces of {title} in its own gesture](../_static/gallery/{name}.png)\n\n"
        text += f"![The patch of {title}: its nodes and wires](../_static/gallery/{name}_patch.svg)\n\n"
        text += f"<audio controls preload=\"none\" aria-label=\"The sound of {title}\" src=\"../_static/gallery/{name}.wav\"></audio>\n"
        if graph.get("controls"):
            text += "\n## Knobs\n\n| knob | moves |\n|---|---|\n"
            text += "".join(f"| {control.get('name', key)} | {', '.join(f'`{to}`' for to in control['to'])} |\n" for key, control in graph["controls"].items())
        used = sorted(types_in(graph) & known)
        text += "\n## Nodes\n\n" + "".join(f"- [`{kind}`](../nodes/{kind}.md)\n" for kind in used)
        sources = graph.get("ui", {}).get("sources", {})
        if sources:
            text += "\n## Where the numbers come from\n\n| number | source |\n|---|---|\n"
            text += "".join(f"| `{key}` | {escaped(value)} |\n" for key, value in sources.items())
        self.write(f"gallery/{name}", text)
        card = f"\n:::{{container}} card\n[![The forces of {title}](../_static/gallery/{name}.png)]({name}.md)\n\n"
        card += f"**[{title}]({name}.md)**\n\n{graph['about']}\n\n"
        heard = f"<audio controls preload=\"none\" aria-label=\"The sound of {title}\" src=\"../_static/gallery/{name}.wav\"></audio>\n\n"
        patch = f"![The patch of {title}](../_static/gallery/{name}_patch.svg)\n\n"
        return card + patch + heard + f"{links} · [sources]({name}.md)\n\n{', '.join(graph.get('tags', []))}\n:::\n"

    def gallery(self):
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            cards = dict(zip(self.presets, pool.map(self.preset_page, self.presets)))
        gestures = {}
        for name, graph in self.presets.items():
            gestures.setdefault(next((tag for tag in graph.get("tags", []) if tag in GESTURES), "more"), []).append(cards[name])
        text = "# Gallery\n\nEach preset: what it feels like, its forces in its own gesture, its sound, and where its numbers come from.\n\n"
        for gesture in (*GESTURES, "more"):
            if gesture in gestures:
                text += f"\n## {gesture.capitalize()}\n\n::::{{container}} gallery\n" + "".join(gestures[gesture]) + "::::\n"
        self.write("gallery/index", text + "\n```{toctree}\n:hidden:\n\n" + "\n".join(self.presets) + "\n```\n")

    # ------------------------------------------------------------------ reference

    def commands(self):
        head = run(self.tactus, "--help")
        names = re.findall(r"^  ([a-z-]+) {2,}", head.split("Subcommands:")[1].split("Examples:")[0], re.M)
        text = f"# Commands\n\n```\n{head.strip()}\n```\n"
        for name in names:
            text += f"\n## tactus {name}\n\n```\n{run(self.tactus, name, '--help').strip()}\n```\n"
        self.write("commands", text)

    def cpp_api(self):
        text = "# C++ headers\n\n[Tactus in your own program](library.md) shows how to use them. All names are in the namespace `tactus`.\n"
        for folder in HEADERS:
            for header in sorted((ROOT / folder).glob("*.hpp")):
                declared = {}
                for found in DECLARED.finditer(header.read_text(encoding="utf-8")):
                    comment = " ".join(line.removeprefix("///").strip() for line in found[1].split("///\n")[0].splitlines())
                    comment = re.sub(r"(?<=\. )[^.]*:$", "", comment)   # what leads to an example
                    declared.setdefault(f"`{found['type']}`" if found["type"] else f"`{found['call']}()`", comment)
                if not declared:
                    continue
                included = f"tactus/{header.relative_to(ROOT / 'framework')}"
                text += f"\n## {included}\n\n[The header]({self.copied(header.relative_to(ROOT))}).\n\n| name | meaning |\n|---|---|\n"
                text += "".join(f"| {name} | {escaped(comment)} |\n" for name, comment in declared.items())
        self.write("cpp_api", text)

    @staticmethod
    def docstring(item):
        """The description of something in Python, as Markdown: its arguments become a list."""
        lines, in_code = [], False
        for line in (inspect.getdoc(item) or "").splitlines():
            argument = re.match(r"(\w+): (?=\S)", line)
            in_code = line.startswith("    ") and (in_code or not lines or lines[-1] == "")
            told = line if in_code else re.sub(r"`[^`]+`|[<*_\[\]{}]", lambda part: part[0] if part[0][0] == "`" else "\\" + part[0], line)
            lines.append(f"- `{argument[1]}`{told[len(argument[1]):]}" if argument else told)
        return "\n".join(lines)

    def python_item(self, name, item, level):
        """A class with its methods, a function or a property."""
        head, described = "#" * level, inspect.unwrap(item) if callable(item) else item
        text = f"\n{head} {name}\n\n"
        if inspect.isfunction(described):
            signature = str(inspect.signature(described)).replace("'", "").replace("(self, ", "(").replace("(self)", "()")
            text += f"```\n{name}{signature}\n```\n\n"
        text += self.docstring(item) + "\n"
        if inspect.isclass(item):
            for member, value in vars(item).items():
                value = getattr(value, "__func__", value)
                if not member.startswith("_") and (inspect.isfunction(value) or isinstance(value, property)) and inspect.getdoc(value):
                    text += self.python_item(f"{name}.{member}", value, level + 1)
        return text

    def python_api(self):
        package = importlib.import_module("tactus")
        text = "# Python\n\nThe package `tactus`, as its comments describe it. [From Python](python.md) shows how to use it.\n"
        text += "".join(self.python_item(name, getattr(package, name), 2) for name in package.__all__)
        self.write("python_api", text)

    def c_api(self):
        text = "# C interfaces\n\nThe headers, as their comments describe them. [Tactus in your own program](library.md) shows how to use them.\n"
        for header, about in (("tactus.h", "Graphs and runs"), ("tactus_live.h", "Sessions on real devices"), ("tactus_plugin.h", "Nodes in plugins"),
                              ("tactus_device.h", "Device drivers in plugins")):
            label = header.replace("_", "__").replace(".h", "_8h")   # as doxygen calls it
            text += f"\n({label})=\n## {about}: {header}\n\n```{{eval-rst}}\n.. doxygenfile:: {header}\n```\n"
        self.write("c_api", text)


def main():
    tactus, source = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    presets = sys.argv[3:] or sorted(path.stem for path in (ROOT / "graphs").glob("*.json"))
    shutil.rmtree(source, ignore_errors=True)
    (source / "_static").mkdir(parents=True)
    shutil.copy(ROOT / "docs/site/conf.py", source)
    for file in ("site.css", "icon.svg"):
        shutil.copy(ROOT / "docs/site" / file, source / "_static")
    site = Site(tactus, source, presets)
    site.pages()
    site.index()
    site.node_pages()
    site.gallery()
    site.commands()
    site.cpp_api()
    site.c_api()
    site.python_api()
    print(f"{source}: {len(PAGES)} pages, {len(site.nodes)} nodes, {len(presets)} presets")


if __name__ == "__main__":
    main()
