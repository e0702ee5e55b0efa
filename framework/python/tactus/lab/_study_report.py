# SPDX-License-Identifier: MIT
"""The report of a study: one page that works without a network. Texts of the study never become markup."""

from __future__ import annotations

import base64
import pathlib
import shlex
import struct
import zlib
from html import escape
from typing import Any, Dict, List, Sequence, Tuple

import numpy as np

from .._checks import Array
from .._messages import Error
from .._reports import limits
from . import _columns
from ._columns import BLOCK, Results
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


def _image(x: float, y: float, w: float, h: float, pixels: Array) -> str:
    """Pixels, shape (rows, columns, 3), as a picture in the page."""
    rows, columns, _ = pixels.shape

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    png = (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", columns, rows, 8, 2, 0, 0, 0))
           + chunk(b"IDAT", zlib.compress(b"".join(b"\0" + row.tobytes() for row in pixels), 9)) + chunk(b"IEND", b""))
    return (f'<image x="{x}" y="{y}" width="{w}" height="{h}" preserveAspectRatio="none" style="image-rendering:pixelated" '
            f'href="data:image/png;base64,{base64.b64encode(png).decode()}"/>')


def _short(value: Any) -> str:
    return f"{value:.4g}" if isinstance(value, (float, np.floating, int)) else str(value)


class _Axis:
    """The cells along one axis: one for each text or number; or, of many numbers, parts of the range."""

    def __init__(self, name: str, values: Any, unit: str):
        self.values, self.title = values, f"{name} ({unit})" if unit else name
        different: Any = sorted(set(values)) if isinstance(values, list) else np.unique(values)
        self._edges = np.arange(len(different)) - 0.5 if isinstance(values, list) else different
        self._known = {text: k for k, text in enumerate(different)} if isinstance(values, list) else {}
        if not self._known and len(different) > BINS and (len(different) > MOST_CELLS or len(different) ** 1.5 > len(values) + 8):
            self._edges = np.linspace(different[0], different[-1], BINS + 1)[:-1]
            different = self._edges + (self._edges[1] - self._edges[0]) / 2
        self.texts = [_short(each) for each in different]
        self._middles = np.arange(len(different)) if self._known else different

    def cells(self, some: slice) -> Array:
        """The cells of some points."""
        numbers = [self._known[text] for text in self.values[some]] if self._known else self.values[some]
        return np.asarray(np.searchsorted(self._edges, numbers, "right") - 1)

    def at(self, values: Array) -> Array:
        """The places of values, in cells from the low end."""
        return np.interp(values, self._middles, np.arange(len(self.texts)) + 0.5, left=np.nan, right=np.nan)


def _text(x: float, y: float, text: str, anchor: str = "start", more: str = "") -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}"{more}>{escape(text)}</text>'


def _heat_map(each: Map, results: Results, units: Dict[str, str], limits: Sequence[Tuple[str, Array, Array]], note: str) -> str:
    x, y = (_Axis(name, results[name], units.get(name, "")) for name in (each.x, each.y))
    values, shape = results[each.of], (len(y.texts), len(x.texts))
    count, total = np.zeros(shape[0] * shape[1]), np.zeros(shape[0] * shape[1])
    for some in (slice(first, first + BLOCK) for first in range(0, results.rows, BLOCK)):
        good = np.isfinite(values[some])
        cell = (y.cells(some) * shape[1] + x.cells(some))[good]
        count += np.bincount(cell, minlength=len(count))
        total += np.bincount(cell, values[some][good], minlength=len(count))
    means = (total / np.where(count > 0, count, np.nan)).reshape(shape)
    low, high = (float(np.nanmin(means)), float(np.nanmax(means))) if count.any() else (0.0, 0.0)
    pixels = _colour((means - low) / (high - low) if high > low else means * 0.0 + 0.5)
    w, h, left, top = 460.0, 340.0, 80.0, 10.0
    parts = [_image(left, top, w, h, pixels[::-1]), _image(left + w + 16, top, 14, h, _colour(np.linspace(1.0, 0.0, 64)[:, None])),
             _text(left + w + 34, top + 12, _short(high)), _text(left + w + 34, top + h, _short(low)), _text(left + w / 2, top + h + 36, x.title, "middle"),
             _text(0, 0, y.title, "middle", f' transform="translate(14 {top + h / 2}) rotate(-90)"')]
    for k, (name, at_x, at_y) in enumerate(limits):
        px, py = left + x.at(at_x) / shape[1] * w, top + h - y.at(at_y) / shape[0] * h
        points = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(px, py) if np.isfinite(a) and np.isfinite(b))
        line, dash = f'<polyline points="{points}" fill="none"', ("", ' stroke-dasharray="6 4"')[k % 2]
        parts.append(f'{line} stroke="white" stroke-width="4"/>{line} stroke="#c00" stroke-width="2"{dash}/>'
                     + _text(left + w + 90, top + 40 + 18 * k, f'{"- - " if k % 2 else "—— "}{name}', more=' fill="#c00"'))
    for i in range(6):
        for axis, is_x in ((x, True), (y, False)):
            k = round(i * (len(axis.texts) - 1) / 5)
            place = (k + 0.5) / len(axis.texts)
            parts.append(_text(left + place * w, top + h + 16, axis.texts[k], "middle") if is_x else
                         _text(left - 6, top + h - place * h + 4, axis.texts[k], "end"))
    most = int(count.max())
    said = f"The mean of up to {most} points in a cell. " if most > 1 else ""
    unit = f" ({escape(units[each.of])})" if units.get(each.of) else ""
    return (f'<h2>{escape(each.of)}{unit}</h2><svg viewBox="0 0 740 {top + h + 44}" width="740" role="img" aria-label="{escape(each.of)} over '
            f'{escape(each.x)} and {escape(each.y)}, from {_short(low)} to {_short(high)}">{"".join(parts)}</svg><p>{said}Grey: no number. {escape(note)}</p>')


def limits_of(prepared: Prepared, results: Results, each: Map) -> Tuple[List[Tuple[str, Array, Array]], str]:
    """The limits that `tactus limits` computes over two parameters: name, x, y; and a sentence about them."""
    if any(":" in name or "." not in name and name != "rate" for name in (each.x, each.y)):
        return [], "The limits are not drawn: they are known over parameters and the rate only."
    good = np.array([not error for error in results["error"]])
    if any(isinstance(results[name], list) or np.ptp(results[name][good]) == 0.0 for name in (each.x, each.y)):
        return [], "The limits are not drawn: they need two different numbers along each axis."
    x, y = (f"{name}={values.min():.12g}:{values.max():.12g}" for name in (each.x, each.y) for values in [results[name][good]])
    try:
        rate = prepared.study.rate if prepared.study.rate and "rate" not in (each.x, each.y) else None
        known = limits(prepared.graph, set=prepared.study.set, rate=rate, x=x, y=y, steps=20)
    except Error as why:
        return [], f"The limits are not drawn: tactus limits says: {why.text}"
    columns = dict(zip(known.columns, np.nan_to_num(known.points).T))
    at_x, at_y = (next(columns[k] for k in columns if k in (name, f"{name} (Hz)")) for name in (each.x, each.y))
    order = np.lexsort((at_y, at_x))
    at_x, at_y = at_x[order], at_y[order]
    found = []
    for verdict in ("passive", "stable"):
        holds = columns[verdict][order] > 0.0
        ends = np.flatnonzero(holds[:-1] & ~holds[1:] & (at_x[:-1] == at_x[1:]))   # for each x, the first that holds before one that does not
        ends = ends[np.unique(at_x[ends], return_index=True)[1]]
        if len(ends):
            found.append((verdict, at_x[ends], (at_y[ends] + at_y[ends + 1]) / 2))
    other = " They are those of the graph's own devices." if prepared.devices else ""
    return found, f"Limits: `tactus limits`, to half a step of 20; passive is sufficient, and stable is the linear loop.{other}"


def _parallel(results: Results, column: str, names: List[str], units: Dict[str, str]) -> str:
    """Parallel coordinates of some points, coloured by a column."""
    count = results.rows
    rows = np.unique(np.linspace(0, count - 1, min(LINES, count)).astype(int))
    values = results[column][rows]
    rows, values = rows[np.isfinite(values)], values[np.isfinite(values)]
    if len(rows) < 2 or len(names) < 2:
        return ""
    w, h, left, top = 900.0, 260.0, 60.0, 24.0
    places, parts = [], []
    for k, name in enumerate(names):
        whole = results[name]
        axis = _Axis(name, [whole[i] for i in rows] if isinstance(whole, list) else np.zeros(1), units.get(name, ""))
        numbers = axis.cells(slice(None)).astype(float) if isinstance(whole, list) else whole[rows]
        finite = numbers[np.isfinite(numbers)]
        low, high = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 0.0)
        x = left + k * w / (len(names) - 1)
        places.append((x, np.where(np.isfinite(numbers), top + h - (numbers - low) / (high - low or 1.0) * h, top + h + 14)))
        ends = (axis.texts[0], axis.texts[-1]) if isinstance(whole, list) else (_short(low), _short(high))
        parts.append(f'<line x1="{x:.1f}" x2="{x:.1f}" y1="{top}" y2="{top + h}" stroke="#888"/>{_text(x, top - 8, axis.title, "middle")}'
                     f'{_text(x + 4, top + 10, ends[1])}{_text(x + 4, top + h, ends[0])}')
    colours = _colour((values - values.min()) / (float(np.ptp(values)) or 1.0))
    lines = []
    for i, (r, g, b) in enumerate(colours):
        path = " ".join(f"{x:.1f},{y[i]:.1f}" for x, y in places)
        lines.append(f'<polyline fill="none" stroke="rgb({r},{g},{b})" stroke-opacity="0.6" points="{path}"/>')
    return (f'<h2>All factors</h2><svg viewBox="0 0 1020 {top + h + 24}" width="1020" role="img" aria-label="Parallel coordinates">'
            f'{"".join(lines)}{"".join(parts)}</svg><p>'
            f"{len(rows)} of {count} points, coloured by {escape(column)}. A line that leaves an axis below it has no number there.</p>")


def page(prepared: Prepared, results: Results, words: Sequence[str]) -> str:
    """The page. words: the command that renders the study."""
    study, names = prepared.study, prepared.names
    units = study.units
    bad = [i for i, error in enumerate(results["error"]) if error]
    maps = study.maps or ([Map(column, names[0], names[1]) for column in study.columns if not column.endswith("_margin")] if len(names) > 1 else [])
    body = [_heat_map(each, results, units, *(limits_of(prepared, results, each) if each.limits else ((), ""))) for each in maps]
    if study.columns:
        column = study.worst or study.columns[-1]
        least, column = column.startswith("-"), column.lstrip("-")
        body.append(_parallel(results, column, [*names, *study.columns][:10], units))
        values = np.where(np.isfinite(results[column]), results[column] if least else -results[column], np.inf)
        order = np.argsort(values, kind="stable")[:min(WORST, np.isfinite(values).sum())].tolist()
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
            f'<p>{results.rows} points, {len(bad)} with errors. {escape(marks)}. Study {escape(results.about["study"])}.</p>{mixed}{"".join(body)}'
            '</body></html>\n')


def _table(prepared: Prepared, results: Results, rows: List[int], words: Sequence[str]) -> str:
    errors = results["error"]
    names = [*prepared.names, *prepared.study.columns, *(["error", "error_place"] if any(errors[i] for i in rows) else [])]
    columns = [[str(i) for i in rows], *([_short(values[i]) for i in rows] for values in map(results.__getitem__, names))]
    head = "".join(f"<th>{escape(name)}</th>" for name in ["point", *names, "render it"])
    lines = ["".join(f"<td>{escape(cell)}</td>" for cell in cells) + f"<td><code>{escape(shlex.join([*words, '--point', cells[0]]))}</code></td>"
             for cells in zip(*columns)]
    return f"<table><tr>{head}</tr>{''.join(f'<tr>{line}</tr>' for line in lines)}</table>"


def write(prepared: Prepared, results: Results, path: pathlib.Path, words: Sequence[str]) -> None:
    """Writes the page."""
    text = page(prepared, results, words).encode()
    _columns.replace(path, lambda out: out.write(text))
