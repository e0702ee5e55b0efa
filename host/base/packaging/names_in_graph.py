# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints the names that can complete one argument of a command line. The completions of the shells call this.

names_in_graph.py TACTUS KIND [WORD…]

KIND is nodes, presets, or one of these kinds of names in a graph: ports, sets (parameters and controls), hits, roles. The graph is
the first of the words that names a graph file or a preset, otherwise the one that `tactus play` is running.
"""
import json
import os
import pathlib
import re
import subprocess
import sys


class Names:
    def __init__(self, tactus):
        self.tactus = tactus
        program = pathlib.Path(tactus).resolve().parent
        self.share = program.parent / "share/tactus"
        self.graphs = pathlib.Path(os.environ.get("TACTUS_PRESETS") or self.share / "graphs")
        self.sheets = None

    def sheet(self, node_type):
        if self.sheets is None:
            text = subprocess.run([self.tactus, "nodes", "--json"], capture_output=True, text=True, check=True).stdout
            self.sheets = {sheet["id"]: sheet for sheet in json.loads(text)}
        return self.sheets.get(node_type, {})

    def nodes(self):
        self.sheet("")
        return list(self.sheets)

    def presets(self):
        return [file.stem for file in self.graphs.glob("*.json")]

    def file(self, word):
        """The graph file that an argument names; None if it names none."""
        given, preset = pathlib.Path(word).expanduser(), self.graphs / f"{word}.json"
        if given.suffix == ".json" and given.is_file():
            return given
        return preset if re.fullmatch(r"[\w-]+", word) and preset.is_file() else None

    def playing(self):
        """The graph that `tactus play` is running for this user."""
        for process in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                words = (process / "cmdline").read_text().split("\0")
                if pathlib.Path(words[0]).name != "tactus" or "play" not in words[1:2]:
                    continue
                folder = (process / "cwd").resolve()
            except OSError:
                continue
            for word in words[2:]:
                found = self.file(str(folder / word)) or self.file(word)
                if found:
                    return found
        return None

    def inside(self, patch, graphs, kind, path=""):
        """The names of a patch and of the subgraphs in it."""
        for node, content in patch.get("nodes", {}).items():
            node_type = content.get("type", "")
            name = f"{path}{node}"
            if node_type.startswith("graph:"):
                inner = graphs.get(node_type.removeprefix("graph:"), {})
                exposed = inner.get("expose", {})
                groups = {"ports": ("inputs", "outputs"), "sets": ("params",)}.get(kind, ())
                yield from (f"{name}.{port}" for group in groups for port in exposed.get(group, {}))
                if path.count("/") < 8:   # in a faulty file, a subgraph may contain itself
                    yield from self.inside(inner, graphs, kind, f"{name}[0]/" if "count" in content else f"{name}/")
                continue
            sheet = self.sheet(node_type)
            if kind == "ports":
                yield from (f"{name}.{port['id']}" for port in sheet.get("inputs", []) + sheet.get("outputs", []))
            elif kind == "hits":
                yield from (f"{name}.{port['id']}" for port in sheet.get("inputs", []) if port.get("quantity") == "hit")
            elif kind == "sets":
                for param in sheet.get("params", []):
                    yield from (f"{name}.{param['id']}={choice}" for choice in param.get("choices", [""]))

    def in_graph(self, kind, words):
        file = next(filter(None, map(self.file, words)), None) or self.playing()
        if file is None:
            return []
        graph = json.loads(file.read_text(encoding="utf-8"))
        if kind == "roles":
            profiles = [f"hid:{profile.stem}" for profile in (self.share / "profiles").glob("*.json") if not profile.stem.endswith(".schema")]
            return [f"{role}={device}" for role in graph.get("devices", {}) for device in ["sim", "hid:auto", *profiles]]
        controls = [f"{control}=" for control in graph.get("controls", {})] if kind == "sets" else []
        return controls + list(self.inside(graph, graph.get("graphs", {}), kind))


def main(tactus, kind, *words):
    names = Names(tactus)
    simple = {"nodes": names.nodes, "presets": names.presets}
    print("\n".join(sorted(simple[kind]() if kind in simple else names.in_graph(kind, words))))


try:
    main(*sys.argv[1:])
except (OSError, ValueError, AttributeError, TypeError, subprocess.CalledProcessError):
    sys.exit(1)   # for example, the file is not a graph; a completion must not print errors
