#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the playground: a folder that any file server can serve.

Usage: build_playground.py TACTUS OUT [--modules FOLDER] [PRESET...]

Exports each preset (default: all in graphs/) to WebAssembly, and copies the page. FOLDER (default: build/site/modules) keeps what was compiled: a preset
whose exported code is the same is not compiled again. presets.json has what the page needs of each preset: its texts, and for each role the box in which its own
gesture moves. reports.wasm is the program's own reader of profiles and reports. Needs clang-22, lld-22, libc++-22-dev-wasm32, libclang-rt-22-dev-wasm32 and wasi-libc."""

import argparse
import concurrent.futures
import csv
import hashlib
import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROFILES = ["tactus_board", "dualsense_usb"]


def run(*command):
    made = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False)
    if made.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{made.stdout}{made.stderr}")
    return made.stdout


def hash_of(folder):
    all_bytes = hashlib.sha256()
    for path in sorted(folder.rglob("*")):
        if path.is_file():
            all_bytes.update(f"{path.relative_to(folder)}\0".encode() + path.read_bytes())
    return all_bytes.hexdigest()


def make_module(tactus, preset, modules):
    """Exports and compiles a preset. Returns the folder of the module."""
    kept = modules / preset
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch) / preset
        run(tactus, "export", ROOT / "graphs" / f"{preset}.json", "-o", folder, "--to", "wasm")
        digest = hash_of(folder)
        if (kept / "hash").is_file() and (kept / "hash").read_text() == digest:
            return kept
        run("make", "-s", "-C", folder, "wasm")
        shutil.rmtree(kept, ignore_errors=True)
        kept.mkdir(parents=True)
        for name in (f"{preset}.wasm", f"{preset}.js", "tactus_graph.js", "tactus_page.js"):
            shutil.copy(folder / name, kept)
        (kept / "hash").write_text(digest)
    return kept


def make_reports(tactus, modules):
    """Compiles what reads and writes the reports of devices, from the sources of the program. Returns the module."""
    folder = modules.resolve() / "reports"
    run("make", "-s", "-C", ROOT, "-f", "docs/site/reports/Makefile", f"-j{os.cpu_count()}", f"OUT={folder}", f"INCLUDE={tactus.parent.parent / 'include'}")
    return folder / "reports.wasm"


def position_nodes(graph):
    """The path of a node that reads the position of each role."""
    found = {}

    def search(nodes, prefix, roles):
        for name, node in nodes.items():
            kind = node["type"]
            if kind == "device.position":
                found.setdefault(roles.get(node["role"], node["role"]), prefix + name)
            if not kind.startswith("graph:"):
                continue
            inner = graph["graphs"][kind[len("graph:"):]]["nodes"]
            given = node.get("roles", {})
            for i in range(node.get("count", 1)):
                one = {key: value[i] if isinstance(value, list) else value for key, value in given.items()}
                search(inner, f"{prefix}{name}[{i}]/" if "count" in node else f"{prefix}{name}/", one)

    search(graph["nodes"], "", {})
    return found


def rendered(tactus, preset, ports):
    with tempfile.TemporaryDirectory() as scratch:
        path = pathlib.Path(scratch) / "out.csv"
        run(tactus, "render", ROOT / "graphs" / f"{preset}.json", "--record", ",".join(ports), "--out", path)
        with path.open(newline="") as file:
            rows = list(csv.reader(file))
    columns = {name: [float(row[i]) for row in rows[1:]] for i, name in enumerate(rows[0])}
    return columns


def view_of(tactus, preset, graph, about):
    """For each role: the box in which its own gesture moves, wider by a fifth, and deep enough to press."""
    nodes = position_nodes(graph)
    motors = {record["name"].rsplit(".", 1)[0] for record in about["records"] if ".force." in record["name"]}
    columns = rendered(tactus, preset, [f"{node}.position" for node in nodes.values()] + sorted(motors))
    boxes, sizes = {}, {}
    for role, node in nodes.items():
        place = [columns[f"{node}.position.{axis}"] for axis in "xyz"]
        near = [m for m in motors if m.rsplit("/", 1)[0] == node.rsplit("/", 1)[0]] if "/" in node else motors
        force = [max((abs(columns[f"{m}.{axis}"][k]) for m in near for axis in "xyz"), default=0.0) for k in range(len(place[0]))]
        boxes[role] = []
        for axis, values in enumerate(place):
            low, high = min(values), max(values)
            middle, half = (low + high) / 2, max((high - low) / 2 * 1.2, 0.004 if axis < 2 else 0.002)
            boxes[role].append([middle - half, middle + half])
        sizes[role] = [max(values) - min(values) for values in place]
        contact = next((place[2][k] for k, size in enumerate(force) if size > 0.01), None)
        if contact is not None:
            low, high = boxes[role][2]
            boxes[role][2][0] = min(low, contact - 0.6 * (high - contact), contact - 0.003)
    first = sizes[next(iter(nodes))]
    return {"boxes": boxes, "view": "above" if first[1] > 0.5 * first[0] else "side"}


def about_of(module, preset):
    """The description in the script of a module: an object of JSON between two known lines."""
    text = (module / f"{preset}.js").read_text()
    return json.loads(text.split("export const about = ", 1)[1].split("\n};\n", 1)[0] + "\n}")


def entry_of(tactus, preset, modules):
    graph = json.loads((ROOT / "graphs" / f"{preset}.json").read_text())
    module = make_module(tactus, preset, modules)
    about = about_of(module, preset)
    entry = {"id": preset, "title": about["title"], "about": about["about"], "tags": graph.get("tags", []),
             "size": (module / f"{preset}.wasm").stat().st_size, **view_of(tactus, preset, graph, about)}
    assert set(entry["boxes"]) == {role["name"] for role in about["roles"]}, preset
    assert all(math.isfinite(value) for box in entry["boxes"].values() for pair in box for value in pair), preset
    return entry


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tactus", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--modules", type=pathlib.Path, default=ROOT / "build/site/modules")
    parser.add_argument("presets", nargs="*")
    given = parser.parse_args()
    tactus = given.tactus.resolve()
    presets = given.presets or sorted(path.stem for path in (ROOT / "graphs").glob("*.json"))
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        entries = list(pool.map(lambda preset: entry_of(tactus, preset, given.modules), presets))
    graphs = given.out / "graphs"
    graphs.mkdir(parents=True, exist_ok=True)
    for path in (ROOT / "docs/site/playground").iterdir():
        shutil.copy(path, given.out)
    for preset in presets:
        for path in (given.modules / preset).iterdir():
            if path.suffix in (".wasm", ".js"):
                shutil.copy(path, graphs)
    shutil.copy(make_reports(tactus, given.modules), given.out)
    profiles = [json.loads((ROOT / "host/devices/profiles" / f"{name}.json").read_text()) for name in PROFILES]
    (given.out / "profiles.json").write_text(json.dumps({"profiles": profiles}))
    (given.out / "presets.json").write_text(json.dumps({"presets": sorted(entries, key=lambda one: one["title"])}, indent=1) + "\n")
    worker = given.out / "offline.js"
    worker.write_text(worker.read_text().replace("BUILD", hash_of(given.out)[:16]))
    print(f"{given.out}: {len(presets)} presets")


if __name__ == "__main__":
    main()
