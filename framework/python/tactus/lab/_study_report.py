# SPDX-License-Identifier: MIT
"""The report of a study: one page that works without a network. Texts of the study never become markup."""

from __future__ import annotations

import base64
import csv
import os
import pathlib
import shlex
import shutil
import struct
import subprocess
import tempfile
import zlib
from html import escape
from typing import Any, Dict, List, NamedTuple, Sequence, Tuple

import numpy as np

from .._checks import Array
from . import _columns
from ._parts import Results
from ._study import Map, Prepared

MOST_CELLS, BINS, LINES, WORST, PROBLEMS = 400, 24, 300, 10, 20
# Seven colours of the map viridis of matplotlib, which stays readable in grey and for the colour-blind.
COLOURS = np.array([(68, 1, 84), (68, 57, 131), (49, 104, 142), (33, 145, 140), (53, 183, 121), (144, 215, 67), (253, 231, 37)], float)
GREY = (225, 225, 225)


def _colour(part: Array) -> Array:
    """Colours, shape (…, 3), of parts from 0 to 1; grey for what is not a number."""
    at = np.clip(np.nan_to_num(part), 0.0, 1.0) * (len(COLOURS) - 1)
    low = np.minimum(at.astype(int), len(COLOURS) - 2)
    mixed = COLOURS[low] + (COLOURS[low + 1] - COLOURS[low]) * (at - low)[..., None]
    return np.where(np.isnan(part)[..., None], np.array(GREY, float), mixed).round().astype(np.uint8)


def _png(pixels: Array) -> str:
    """Pixels, shape (rows, columns, 3), as the address of a picture."""
    rows, columns, _ = pixels.shape
    raw = b"".join(b"\0" + row.tobytes() for row in pixels)

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    made = (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", columns, rows, 8, 2, 0, 0, 0)) + chunk(b"IDAT", zlib.compress(raw, 9))
            + chunk(b"IEND", b""))
    return "data:image/png;base64," + base64.b64encode(made).decode()


def _short(value: Any) -> str:
    return f"{value:.4g}" if isinstance(value, (float, np.floating, int)) else str(value)[:40]


class _Axis(NamedTuple):
    """The cells along one axis: their middles, their texts, the cell of each point, and the unit."""

    middles: Array
    texts: List[str]
    cells: Array
    title: str

    def at(self, values: Array) -> Array:
        """The places of values, in cells from the low end."""
        return np.interp(values, self.middles, np.arange(len(self.middles)) + 0.5, left=np.nan, right=np.nan)


def _axis(name: str, values: Any, unit: str) -> _Axis:
    title = f"{name} ({unit})" if unit else name
    if isinstance(values, list):
        known = sorted(set(values))
        return _Axis(np.arange(len(known), dtype=float), known, np.array([known.index(v) for v in values]), title)
    different = np.unique(values)
    if len(different) <= MOST_CELLS and len(different) ** 1.5 <= len(values) + 8 or len(different) <= BINS:
        return _Axis(different, [_short(float(v)) for v in different], np.searchsorted(different, values), title)
    edges = np.linspace(different[0], different[-1], BINS + 1)
    middles = (edges[1:] + edges[:-1]) / 2
    return _Axis(middles, [_short(float(v)) for v in middles], np.clip(np.searchsorted(edges, values, "right") - 1, 0, BINS - 1), title)


def _heat_map(each: Map, results: Results, units: Dict[str, str], limits: Sequence[Tuple[str, Array, Array]], note: str) -> str:
    x, y = (_axis(name, results[name], units.get(name, "")) for name in (each.x, each.y))
    values = np.asarray(results[each.of], float)
    shape = (len(y.middles), len(x.middles))
    cell = y.cells * shape[1] + x.cells
    good = np.isfinite(values)
    count = np.bincount(cell[good], minlength=shape[0] * shape[1])
    with np.errstate(invalid="ignore", divide="ignore"):
        means = (np.bincount(cell[good], values[good], minlength=shape[0] * shape[1]) / count).reshape(shape)
    shown = means[np.isfinite(means)]
    low, high = (float(shown.min()), float(shown.max())) if shown.size else (0.0, 0.0)
    pixels = _colour((means - low) / (high - low) if high > low else np.where(np.isnan(means), np.nan, 0.5))
    w, h, left, top = 460.0, 340.0, 80.0, 10.0
    parts = [f'<image x="{left}" y="{top}" width="{w}" height="{h}" preserveAspectRatio="none" style="image-rendering:pixelated" href="{_png(pixels[::-1])}"/>']
    for k, (name, at_x, at_y) in enumerate(limits):
        px, py = left + x.at(at_x) / shape[1] * w, top + h - y.at(at_y) / shape[0] * h
        points = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(px, py) if np.isfinite(a) and np.isfinite(b))
        dash = ("", ' stroke-dasharray="6 4"')[k % 2]
        parts.append(f'<polyline points="{points}" fill="none" stroke="white" stroke-width="4"/><polyline points="{points}" fill="none" stroke="#c00" '
                     f'stroke-width="2"{dash}/><text x="{left + w + 90}" y="{top + 40 + 18 * k}" fill="#c00">'
                     f'{"- - " if k % 2 else "—— "}{escape(name)}</text>')
    for axis, is_x in ((x, True), (y, False)):
        n = len(axis.texts)
        for k in sorted({round(i * (n - 1) / 5) for i in range(6)}):
            place = (k + 0.5) / n
            parts.append(f'<text x="{left + place * w:.1f}" y="{top + h + 16}" text-anchor="middle">{escape(axis.texts[k])}</text>' if is_x else
                         f'<text x="{left - 6}" y="{top + h - place * h + 4:.1f}" text-anchor="end">{escape(axis.texts[k])}</text>')
    parts.append(f'<text x="{left + w / 2}" y="{top + h + 36}" text-anchor="middle">{escape(x.title)}</text>'
                 f'<text transform="translate(14 {top + h / 2}) rotate(-90)" text-anchor="middle">{escape(y.title)}</text>')
    bar = _png(_colour(np.linspace(1.0, 0.0, 64)[:, None]))
    parts.append(f'<image x="{left + w + 16}" y="{top}" width="14" height="{h}" preserveAspectRatio="none" href="{bar}"/>'
                 f'<text x="{left + w + 34}" y="{top + 12}">{_short(high)}</text><text x="{left + w + 34}" y="{top + h}">{_short(low)}</text>')
    most = int(count.max()) if count.size else 0
    said = f"The mean of up to {most} points in a cell. " if most > 1 else ""
    unit = f" ({escape(units[each.of])})" if units.get(each.of) else ""
    return (f'<h2>{escape(each.of)}{unit}</h2><svg viewBox="0 0 740 {top + h + 44}" width="740" role="img" aria-label="{escape(each.of)} over '
            f'{escape(each.x)} and {escape(each.y)}, from {_short(low)} to {_short(high)}">{"".join(parts)}</svg><p>{said}Grey: no number. {escape(note)}</p>')


def limits_of(prepared: Prepared, results: Results, each: Map) -> Tuple[List[Tuple[str, Array, Array]], str]:
    """The limits that `tactus limits` computes over two parameters: name, x, y; and a sentence about them."""
    program = os.environ.get("TACTUS_PROGRAM") or shutil.which("tactus")
    if not program or not prepared.file:
        return [], "The limits are not drawn: the program tactus was not found."
    if any(":" in name or "." not in name and name != "rate" for name in (each.x, each.y)):
        return [], "The limits are not drawn: they are known over parameters and the rate only."
    good = [i for i, error in enumerate(results["error"]) if not error]
    if any(isinstance(results[name], list) or len(set(results[name][good])) < 2 for name in (each.x, each.y)):
        return [], "The limits are not drawn: they need two different numbers along each axis."
    ends = [f"{name}={results[name][good].min():.12g}:{results[name][good].max():.12g}" for name in (each.x, each.y)]
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "limits.csv")
        sets = [word for name, value in prepared.study.set.items() for word in ("--set", f"{name}={value}")]
        rate = ["--rate", f"{prepared.study.rate:.12g}"] if prepared.study.rate and "rate" not in (each.x, each.y) else []
        words = [program, "limits", prepared.file, "--x", ends[0], "--y", ends[1], "--steps", "20", "-o", file, *sets, *rate]
        done = subprocess.run(words, capture_output=True, text=True, check=False)
        try:
            with open(file, encoding="utf-8", newline="") as table:
                rows = list(csv.DictReader(table))
        except OSError:
            return [], f"The limits are not drawn: tactus limits says: {done.stderr.strip() or done.stdout.strip()}"
    keys = [next(k for k in rows[0] if k == name or k == f"{name} (Hz)") for name in (each.x, each.y)]
    found = []
    for verdict in ("passive", "stable"):
        xs: List[float] = []
        ys: List[float] = []
        for x in sorted({float(row[keys[0]]) for row in rows}):
            column = sorted((float(row[keys[1]]), float(row[verdict]) if row[verdict] else 0.0) for row in rows if float(row[keys[0]]) == x)
            for (y, holds), (after, next_holds) in zip(column, column[1:]):
                if holds and not next_holds:
                    xs.append(x)
                    ys.append((y + after) / 2)
                    break
        if xs:
            found.append((verdict, np.array(xs), np.array(ys)))
    other = " They are those of the graph's own devices." if prepared.devices else ""
    return found, f"Limits: `tactus limits`, to half a step of 20; passive is sufficient, and stable is the linear loop.{other}"


def _parallel(results: Results, column: str, axes: List[str], units: Dict[str, str]) -> str:
    """Parallel coordinates of some points, coloured by a column."""
    values = np.asarray(results[column], float)
    rows = np.unique(np.linspace(0, len(values) - 1, min(LINES, len(values))).astype(int)) if len(values) else np.zeros(0, int)
    rows = rows[np.isfinite(values[rows])]
    if len(rows) < 2 or len(axes) < 2:
        return ""
    w, h, left, top = 900.0, 260.0, 60.0, 24.0
    places, parts = [], []
    for k, name in enumerate(axes):
        axis = _axis(name, results[name], units.get(name, ""))
        numbers = axis.cells.astype(float) if isinstance(results[name], list) else np.asarray(results[name], float)
        finite = numbers[np.isfinite(numbers)]
        low, high = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 0.0)
        x = left + k * w / (len(axes) - 1)
        places.append((x, np.where(np.isfinite(numbers), top + h - (numbers - low) / (high - low or 1.0) * h, top + h + 14)))
        ends = (axis.texts[0], axis.texts[-1]) if isinstance(results[name], list) else (_short(low), _short(high))
        parts.append(f'<line x1="{x:.1f}" x2="{x:.1f}" y1="{top}" y2="{top + h}" stroke="#888"/><text x="{x:.1f}" y="{top - 8}" text-anchor="middle">'
                     f'{escape(axis.title)}</text><text x="{x + 4:.1f}" y="{top + 10}">{escape(ends[1])}</text>'
                     f'<text x="{x + 4:.1f}" y="{top + h}">{escape(ends[0])}</text>')
    span = float(np.ptp(values[rows])) or 1.0
    colours = _colour((values[rows] - values[rows].min()) / span)
    lines = []
    for row, c in zip(rows, colours):
        path = " ".join(f"{x:.1f},{y[row]:.1f}" for x, y in places)
        lines.append(f'<polyline fill="none" stroke="rgb({c[0]},{c[1]},{c[2]})" stroke-opacity="0.6" points="{path}"/>')
    return (f'<h2>All factors</h2><svg viewBox="0 0 1020 {top + h + 24}" width="1020" role="img" aria-label="Parallel coordinates">'
            f'{"".join(lines)}{"".join(parts)}</svg><p>'
            f"{len(rows)} of {results.rows} points, coloured by {escape(column)}. A line that leaves an axis below it has no number there.</p>")


def page(prepared: Prepared, results: Results, words: Sequence[str]) -> str:
    """The page. words: the command that renders the study."""
    study, names = prepared.study, prepared.names
    units = study.units
    bad = [i for i, error in enumerate(results["error"]) if error]
    maps = study.maps or ([Map(column, names[0], names[1]) for column in study.columns if not column.endswith("_margin")] if len(names) > 1 else [])
    body = []
    for each in maps:
        limits, note = limits_of(prepared, results, each) if each.limits else ([], "")
        body.append(_heat_map(each, results, units, limits, note))
    if study.columns:
        column = study.worst or study.columns[-1]
        least, column = column.startswith("-"), column.lstrip("-")
        body.append(_parallel(results, column, [*names, *study.columns][:10], units))
        values = np.asarray(results[column], float)
        order = [int(i) for i in np.argsort(values if least else -values, kind="stable") if np.isfinite(values[i])][:WORST]
        body.append(f"<h2>The points with the {'smallest' if least else 'largest'} {escape(column)}</h2>" + _table(prepared, results, order, words)
                    + "<p>The command writes the records of the point and its graph, and prints how to open that in the window.</p>")
    if bad:
        body.append(f"<h2>{len(bad)} points with errors</h2>" + _table(prepared, results, bad[:PROBLEMS], words))
    marks = ", ".join(f"Tactus {o['tactus']} on {o['computer']}" for o in results.about["origins"])
    many = len(results.about["origins"])
    mixed = f"<p><strong>The results come from {many} kinds of computers or versions</strong>; the column origin tells them apart.</p>" if many > 1 else ""
    return (f'<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><meta http-equiv="Content-Security-Policy" '
            f'content="default-src \'none\'; img-src data:; style-src \'unsafe-inline\'"><title>{escape(study.name)}</title><style>'
            f'body{{font:15px sans-serif;margin:2em auto;max-width:1060px;color:#222}}'
            f'svg text{{font:12px sans-serif}}table{{border-collapse:collapse}}td,th{{padding:2px 8px;border-bottom:1px solid #ddd;text-align:left}}'
            f'code{{font-size:12px}}</style></head><body><h1>{escape(study.name)}</h1><p>{escape(study.about)}</p>'
            f'<p>{results.rows} points, {len(bad)} with errors. {escape(marks)}. Study {escape(results.about["study"])}.</p>{mixed}{"".join(body)}</body></html>\n')


def _table(prepared: Prepared, results: Results, rows: List[int], words: Sequence[str]) -> str:
    columns = [*prepared.names, *prepared.study.columns, *(["error", "error_place"] if any(results["error"][i] for i in rows) else [])]
    head = "".join(f"<th>{escape(name)}</th>" for name in ["point", *columns, "render it"])
    lines = []
    for i in rows:
        command = shlex.join([*words, "--point", str(i)])
        cells = "".join(f"<td>{escape(results[name][i] if isinstance(results[name], list) else _short(float(results[name][i])))}</td>" for name in columns)
        lines.append(f"<tr><td>{i}</td>{cells}<td><code>{escape(command)}</code></td></tr>")
    return f"<table><tr>{head}</tr>{''.join(lines)}</table>"


def write(prepared: Prepared, results: Results, path: pathlib.Path, words: Sequence[str]) -> None:
    """Writes the page."""
    text = page(prepared, results, words).encode()
    _columns.replace(path, lambda out: out.write(text))
