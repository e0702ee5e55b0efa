# SPDX-License-Identifier: MIT
"""The report of a study: one page that works without a network. Texts of the study never become markup."""

from __future__ import annotations

import pathlib
import shlex
import string
from html import escape
from typing import Any, Dict, Iterable, List, NamedTuple, Sequence, Tuple

import numpy as np

from .._checks import Array
from .._messages import Error
from .._reports import limits
from ._results import Results, replace
from ._study import Map, Prepared

MOST_CELLS, BINS, LINES, WORST, PROBLEMS = 100, 24, 300, 10, 20
# Seven colours of the map viridis of matplotlib, which stays readable in grey and for the colour-blind.
COLOURS = np.array([(68, 1, 84), (68, 57, 131), (49, 104, 142), (33, 145, 140), (53, 183, 121), (144, 215, 67), (253, 231, 37)], float)
GREY = (225, 225, 225)
PAGE = string.Template("""<!DOCTYPE html><html lang="en"><head><meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'"><title>$name</title><style>
body {font: 15px sans-serif; margin: 2em auto; max-width: 1060px; color: #222} svg text, code {font-size: 12px}
table {border-collapse: collapse} td, th {padding: 2px 8px; border-bottom: 1px solid #ddd; text-align: left}
</style></head><body><h1>$name</h1><p>$about</p><p>$said</p>$body</body></html>
""")


def _colour(part: Array) -> Array:
    """Colours, shape (…, 3), of parts from 0 to 1; grey for what is not a number."""
    at = np.clip(np.nan_to_num(part), 0.0, 1.0) * (len(COLOURS) - 1)
    mixed = np.stack([np.interp(at, np.arange(len(COLOURS)), column) for column in COLOURS.T], axis=-1)
    return np.where(np.isnan(part)[..., None], np.array(GREY, float), mixed).round().astype(np.uint8)


def _image(x: float, y: float, w: float, h: float, colours: Array) -> str:
    """Rectangles of colours, shape (rows, columns, 3)."""
    rows, columns, _ = colours.shape
    return (f'<g transform="translate({x} {y}) scale({w / columns:.6g} {h / rows:.6g})" shape-rendering="crispEdges">'
            + "".join(f'<rect x="{k % columns}" y="{k // columns}" width="1" height="1" fill="#{bytes(colour).hex()}"/>'
                      for k, colour in enumerate(colours.reshape(-1, 3))) + "</g>")


def _short(value: Any) -> str:
    return f"{value:.4g}" if isinstance(value, (float, np.floating, int)) else str(value)


def _text(x: float, y: float, text: str, anchor: str = "start", more: str = "") -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}"{more}>{escape(text)}</text>'


def _some(count: int, most: int) -> Any:
    """Numbers below `count`, evenly, the first and the last among them."""
    return np.unique(np.linspace(0, count - 1, min(most, count)).astype(int))


class _Axis(NamedTuple):
    """The cells along one axis: one for each text or number; or, of many numbers, parts of the range."""

    title: str
    middles: Array   # of texts, their numbers
    texts: List[str]
    edges: Array   # where each cell begins
    ends: Array   # the lowest and the highest value

    @staticmethod
    def of(results: Results, name: str, values: Iterable[Array]) -> "_Axis":
        """values: of the column, some rows at a time."""
        edges: Any = np.zeros(0)
        count, many, unit = 0, False, results.about["units"].get(name)
        for some in values:
            edges, count = np.unique(np.concatenate([edges.astype(some.dtype), some])), count + len(some)
            if edges.dtype != object and len(edges) > MOST_CELLS:
                edges, many = edges[[0, -1]], True
        middles, ends = edges, edges[[0, -1]] if len(edges) else edges
        if edges.dtype != object and (many or len(edges) > BINS and len(edges)**1.5 > count + 8):
            edges = np.linspace(ends[0], ends[1], BINS + 1)[:-1]
            middles = edges + (edges[1] - edges[0]) / 2
        return _Axis(f"{name} ({unit})" if unit else name, np.arange(len(edges)) if edges.dtype == object else middles, list(map(_short, middles)), edges, ends)

    def cells(self, values: Array) -> Any:
        """The cells of values."""
        return np.searchsorted(self.edges, values, "right") - 1

    def at(self, values: Array) -> Array:
        """The places of values, in cells from the low end."""
        return np.interp(values, self.middles, np.arange(len(self.texts)) + 0.5, left=np.nan, right=np.nan)


def _picked(results: Results, rows: Any, names: Sequence[str]) -> Dict[str, Array]:
    """Some columns of some points."""
    order = np.argsort(rows)
    parts = [[values[rows[order][(rows[order] >= first) & (rows[order] < first + len(values))] - first] for values in block]
             for first, block in results.blocks(*names)]
    return {name: np.concatenate(values)[np.argsort(order)] for name, values in zip(names, zip(*parts))}


def _heat_map(each: Map, results: Results, limits: Sequence[Tuple[str, Array, Array]], note: str) -> str:
    x, y = (_Axis.of(results, name, (values for _, (values,) in results.blocks(name))) for name in (each.x, each.y))
    shape = len(y.texts), len(x.texts)
    count, total = np.zeros(shape), np.zeros(shape)
    for _, (at_x, at_y, values) in results.blocks(each.x, each.y, each.of):
        cells, good = y.cells(at_y) * shape[1] + x.cells(at_x), np.isfinite(values)
        for sums, weights in ((count, good), (total, np.where(good, values, 0.0))):
            sums += np.bincount(cells, weights, sums.size).reshape(shape)
    means = total / np.where(count > 0, count, np.nan)
    low, high = (float(np.nanmin(means)), float(np.nanmax(means))) if count.any() else (0.0, 0.0)
    w, h, left, top = 460.0, 340.0, 80.0, 10.0
    parts = [_image(left, top, w, h, _colour((means - low) / (high - low) if high > low else means * 0.0 + 0.5)[::-1]),
             _image(left + w + 16, top, 14, h, _colour(np.linspace(1.0, 0.0, 64)[:, None])),
             _text(left + w + 34, top + 12, _short(high)), _text(left + w + 34, top + h, _short(low)), _text(left + w / 2, top + h + 36, x.title, "middle"),
             _text(0, 0, y.title, "middle", f' transform="translate(14 {top + h / 2}) rotate(-90)"')]
    for k, (name, at_x, at_y) in enumerate(limits):
        px, py = left + x.at(at_x) / shape[1] * w, top + h - y.at(at_y) / shape[0] * h
        points = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(px, py) if np.isfinite(a + b))
        line, dash = f'<polyline points="{points}" fill="none"', ("", ' stroke-dasharray="6 4"')[k % 2]
        parts.append(f'{line} stroke="white" stroke-width="4"/>{line} stroke="#c00" stroke-width="2"{dash}/>'
                     + _text(left + w + 90, top + 40 + 18 * k, f'{"- - " if k % 2 else "—— "}{name}', more=' fill="#c00"'))
    parts += [_text(left + (k + 0.5) / shape[1] * w, top + h + 16, x.texts[k], "middle") for k in _some(shape[1], 6)]
    parts += [_text(left - 6, top + h - (k + 0.5) / shape[0] * h + 4, y.texts[k], "end") for k in _some(shape[0], 6)]
    said = f"The mean of up to {count.max():.0f} points in a cell. " if count.max() > 1 else ""
    unit = results.about["units"].get(each.of)
    return (f'<h2>{escape(each.of)}{f" ({escape(unit)})" if unit else ""}</h2><svg viewBox="0 0 740 {top + h + 44}" width="740" role="img" aria-label="'
            f'{escape(each.of)} over {escape(each.x)} and {escape(each.y)}, from {_short(low)} to {_short(high)}">{"".join(parts)}</svg>'
            f"<p>{said}Grey: no number. {escape(note)}</p>")


def limits_of(prepared: Prepared, results: Results, each: Map) -> Tuple[List[Tuple[str, Array, Array]], str]:
    """The limits that `tactus limits` computes over two parameters: name, x, y; and a sentence about them."""
    if any(":" in name or "." not in name and name != "rate" for name in (each.x, each.y)):
        return [], "The limits are not drawn: they are known over parameters and the rate only."
    axes = {name: _Axis.of(results, name, (values[errors == ""] for _, (values, errors) in results.blocks(name, "error"))) for name in (each.x, each.y)}
    if any(axis.edges.dtype == object or len(axis.texts) < 2 for axis in axes.values()):
        return [], "The limits are not drawn: they need two different numbers along each axis."
    x, y = (f"{name}={axis.ends[0]:.12g}:{axis.ends[1]:.12g}" for name, axis in axes.items())
    try:
        rate = prepared.study.rate if prepared.study.rate and "rate" not in (each.x, each.y) else None
        known = limits(prepared.graph, set=prepared.study.set, rate=rate, x=x, y=y, steps=20)
    except Error as why:
        return [], f"The limits are not drawn: tactus limits says: {why.text}"
    columns = dict(zip(known.columns, np.nan_to_num(known.points).T))
    at_x, at_y = (next(columns[k] for k in columns if k in (name, f"{name} (Hz)")) for name in (each.x, each.y))
    found: List[Tuple[str, Array, Array]] = []
    for verdict in ("passive", "stable"):
        ends = []
        for value in np.unique(at_x):   # for each x, the first that holds before one that does not
            across = sorted(zip(at_y[at_x == value], columns[verdict][at_x == value] > 0.0))
            ends += [(value, (a + b) / 2) for (a, holds), (b, still) in zip(across, across[1:]) if holds and not still][:1]
        if ends:
            found.append((verdict, np.array(ends)[:, 0], np.array(ends)[:, 1]))
    other = " They are those of the graph's own devices." if prepared.devices else ""
    return found, f"Limits: `tactus limits`, to half a step of 20; passive is sufficient, and stable is the linear loop.{other}"


def _parallel(results: Results, column: str, names: List[str]) -> str:
    """Parallel coordinates of some points, coloured by a column."""
    picked = _picked(results, _some(results.rows, LINES), list(dict.fromkeys([*names, column])))
    good = np.isfinite(picked[column])
    if good.sum() < 2 or len(names) < 2:
        return ""
    w, h, left, top = 900.0, 260.0, 60.0, 24.0
    places, parts = [], []
    for k, name in enumerate(names):
        values = picked[name][good]
        axis, x = _Axis.of(results, name, [values]), left + k * w / (len(names) - 1)
        numbers = axis.cells(values).astype(float) if values.dtype == object else values
        low, high = np.nanmin(numbers, initial=np.inf), np.nanmax(numbers, initial=-np.inf)
        places.append([f"{x:.1f},{y:.1f}" for y in np.where(np.isfinite(numbers), top + h - (numbers - low) / (high - low or 1.0) * h, top + h + 14)])
        ends = (axis.texts[0], axis.texts[-1]) if values.dtype == object else (_short(low), _short(high))
        parts.append(f'<line x1="{x:.1f}" x2="{x:.1f}" y1="{top}" y2="{top + h}" stroke="#888"/>{_text(x, top - 8, axis.title, "middle")}'
                     f'{_text(x + 4, top + 10, ends[1])}{_text(x + 4, top + h, ends[0])}')
    values = picked[column][good]
    lines = [f'<polyline fill="none" stroke="rgb({r},{g},{b})" stroke-opacity="0.6" points="{" ".join(line)}"/>'
             for (r, g, b), line in zip(_colour((values - values.min()) / (np.ptp(values) or 1.0)), zip(*places))]
    said = f"{len(values)} of {results.rows} points, coloured by {column}. A line that leaves an axis below it has no number there."
    return (f'<h2>All factors</h2><svg viewBox="0 0 1020 {top + h + 24}" width="1020" role="img" aria-label="Parallel coordinates">'
            f"{''.join(lines + parts)}</svg><p>{escape(said)}</p>")


def _table(title: str, prepared: Prepared, results: Results, rows: List[int], words: Sequence[str]) -> str:
    """Some points, with the command that renders each of them."""
    picked = _picked(results, np.array(rows, int), [*prepared.names, *prepared.study.columns, "error", "error_place"])
    names = [name for name in picked if not name.startswith("error") or (picked["error"] != "").any()]
    lines = [[str(i), *(_short(picked[name][k]) for name in names), shlex.join([*words, "--point", str(i)])] for k, i in enumerate(rows)]
    body = "".join("<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in line[:-1]) + f"<td><code>{escape(line[-1])}</code></td></tr>" for line in lines)
    return f'<h2>{escape(title)}</h2><table><tr>{"".join(f"<th>{escape(name)}</th>" for name in ["point", *names, "render it"])}</tr>{body}</table>'


def page(prepared: Prepared, results: Results, words: Sequence[str]) -> str:
    """The page. words: the command that renders the study."""
    study, names = prepared.study, prepared.names
    maps = study.maps or [Map(column, names[0], names[1]) for column in study.columns if len(names) > 1 and not column.endswith("_margin")]
    body = [_heat_map(each, results, *(limits_of(prepared, results, each) if each.limits else ((), ""))) for each in maps]
    if study.columns:
        sign, column, worst = 1.0 if study.worst.startswith("-") else -1.0, study.worst.lstrip("-") or study.columns[-1], list[Tuple[float, int]]()
        body.append(_parallel(results, column, [*names, *study.columns][:10]))
        for first, (values,) in results.blocks(column):
            some = [(sign * values[k], first + k) for k in np.argsort(sign * values, kind="stable")[:WORST].tolist() if np.isfinite(values[k])]
            worst = sorted([*worst, *some])[:WORST]
        body += [_table(f"The points with the {'smallest' if sign > 0 else 'largest'} {column}", prepared, results, [row for _, row in worst], words),
                 "<p>The command writes the records of the point and its graph, and prints how to open that in the window.</p>"]
    bad = [first + k for first, (errors,) in results.blocks("error") for k in np.flatnonzero(errors != "").tolist()]
    if bad:
        body.append(_table(f"{len(bad)} points with errors", prepared, results, bad[:PROBLEMS], words))
    origins: List[str] = sorted(filter(None, results.about["texts"]["origin"]))
    mixed = f" The results come from {len(origins)} kinds of computers or versions; the column origin tells them apart." if len(origins) > 1 else ""
    said = f"{results.rows} points, {len(bad)} with errors. Tactus {', '.join(origins)}. Study {results.about['study']}.{mixed}"
    return PAGE.substitute(name=escape(study.name), about=escape(study.about), said=escape(said), body="".join(body))


def write(prepared: Prepared, results: Results, path: pathlib.Path, words: Sequence[str]) -> None:
    """Writes the page."""
    text = page(prepared, results, words).encode()
    replace(path, lambda out: out.write(text))
