# SPDX-License-Identifier: MIT
"""Tables in files that other programs read: CSV and TSV, HDF5, MAT (version 5) and XDF."""

from __future__ import annotations

import csv
import io
import itertools
import json
import pathlib
import re
import struct
from typing import Any, Dict, List, Mapping, Optional, Sequence
from xml.sax.saxutils import escape

import numpy as np

from .._checks import Path
from .._messages import fail
from .._records import Records, components, imported
from .._views import html_table
from ._results import replace

Column = Any   # an array of numbers, or a list of texts


class Table(Dict[str, Column]):
    """Columns of one length by name: arrays of shape (n,), or lists of texts. None among numbers is not a number. units: SI units of columns. about: what else
    is known, for the sidecar. rate_hz: of rows that are ticks, 0 otherwise."""

    def __init__(self, columns: Mapping[str, Column], units: Optional[Mapping[str, str]] = None, about: Optional[Mapping[str, Any]] = None,
                 rate_hz: float = 0.0):
        super().__init__({name: values if isinstance(values, list) and any(isinstance(v, str) for v in values) else
                          np.array(values, float) if isinstance(values, list) and None in values else np.asarray(values) for name, values in columns.items()})
        self.units, self.about, self.rate_hz = dict(units or {}), dict(about or {}), rate_hz
        lengths = {len(values) for values in self.values()}
        if len(lengths) > 1:
            fail("lab/shape", "columns", f"the columns have {sorted(lengths)} rows", "give columns of one length")

    @property
    def rows(self) -> int:
        """The number of rows."""
        return len(next(iter(self.values()), []))

    def _repr_html_(self) -> str:
        units = (f" ({unit})" if (unit := self.units.get(name, "1")) not in ("", "1") else "" for name in self)
        rows = zip(*(map(_shown, values[:20]) for values in self.values()))
        return html_table([name + unit for name, unit in zip(self, units)], rows) + f"<p>{self.rows} rows</p>"

    def write(self, path: Path) -> None:
        """Writes the table; the extension selects the format: .csv, .tsv, .h5, .mat or .xdf. Numbers keep all their bits. A .csv and a .tsv get a sidecar .json
        with units; the others hold it. After a crash, either the old file or the new one exists."""
        target = pathlib.Path(path)
        kind = target.suffix.lower()
        if kind not in _WRITERS:
            fail("lab/format", str(path), f"the extension '{target.suffix}' is not known", f"use one of {', '.join(_WRITERS)}")
        data = _WRITERS[kind](self)
        if kind in (".csv", ".tsv"):
            replace(target.with_suffix(".json"), lambda file: file.write((json.dumps(self.sidecar(), indent=2, ensure_ascii=False) + "\n").encode()))
        replace(target, lambda file: file.write(data))

    def sidecar(self) -> Dict[str, Any]:
        """Units, sampling rate and other facts about the table, as JSON."""
        return {**({"SamplingFrequency": self.rate_hz} if self.rate_hz else {}), **self.about,
                **{name: {"Units": self.units[name]} for name in self if self.units.get(name)}}


def table_of(records: Records, about: Optional[Mapping[str, Any]] = None) -> Table:
    """Records of a run as a table with one column for each component: "drag.force.x"."""
    return Table(*components(records.items(), records.units), about, records.rate_hz)


def _is_text(values: Column) -> bool:
    return isinstance(values, list) or np.asarray(values).dtype.kind in "OSU"


def _shown(value: Any) -> str:
    """A cell as BIDS has it: numbers as the shortest text that reads back as the same number."""
    plain = value.item() if isinstance(value, np.generic) else value
    return "n/a" if plain is None or plain != plain else repr(plain) if isinstance(plain, float) else str(plain)


def _text(table: Table, separator: str) -> bytes:
    rows, made = [list(table), *zip(*(map(_shown, values) for values in table.values()))], io.StringIO()
    if separator == ",":
        csv.writer(made, lineterminator="\n").writerows(rows)
    else:   # BIDS has no quotes
        made.writelines("\t".join(" ".join(re.split("[\t\r\n]+", cell)) for cell in row) + "\n" for row in rows)
    return made.getvalue().encode()


def _hdf5(table: Table) -> bytes:
    h5py, out = imported("h5py", ".h5"), io.BytesIO()
    with h5py.File(out, "w") as file:
        file.attrs["about"] = json.dumps(table.sidecar(), ensure_ascii=False)
        for name, values in table.items():
            data, kind = ([str(v) for v in values], h5py.string_dtype()) if _is_text(values) else (np.asarray(values), None)
            made = file.create_dataset(name, data=data, dtype=kind)
            made.attrs["units"] = table.units.get(name, "")
    return out.getvalue()


def _element(kind: int, data: bytes) -> bytes:
    """An element of MAT 5 (MathWorks, "MAT-File Format"). Octave 7 does not read the letters beyond ASCII that scipy.io.savemat writes."""
    return struct.pack("<II", kind, len(data)) + data + b"\0" * (-len(data) % 8)


def _matrix(name: str, mat_class: int, shape: Sequence[int], content: bytes) -> bytes:
    head = _element(6, struct.pack("<II", mat_class, 0)) + _element(5, struct.pack(f"<{len(shape)}i", *shape)) + _element(1, name.encode())
    return _element(14, head + content)


def _characters(name: str, text: str) -> bytes:
    data = text.encode("utf-16-le")
    return _matrix(name, 4, (1 if data else 0, len(data) // 2), _element(17, data))


def mat_name(name: str, taken: Sequence[str]) -> str:
    """A name of a variable that MATLAB and Octave take: letters, digits and _, at most 63."""
    plain = "".join(c if c.isascii() and (c.isalnum() or c == "_") else "_" for c in name)
    plain = (plain if plain[:1].isalpha() else "x" + plain)[:59]
    names = itertools.chain([plain], (f"{plain}_{count}" for count in itertools.count(2)))
    return next(name for name in names if name not in taken)


def _mat(table: Table) -> bytes:
    names: List[str] = []
    made = [b"MATLAB 5.0 MAT-file, written by tactus.lab".ljust(116) + b"\0" * 8 + struct.pack("<H", 0x0100) + b"IM"]
    for column, values in table.items():
        names.append(mat_name(column, [*names, "about"]))
        kind, content = (1, b"".join(_characters("", str(v)) for v in values)) if _is_text(values) else (6, _element(9, np.asarray(values, "<f8").tobytes()))
        made.append(_matrix(names[-1], kind, (table.rows, 1), content))
    return b"".join([*made, _characters("about", json.dumps({**table.sidecar(), "columns": dict(zip(names, table))}, ensure_ascii=False))])


def _chunk(tag: int, content: bytes) -> bytes:
    """A chunk of XDF (https://github.com/sccn/xdf, version 1.0)."""
    data = struct.pack("<H", tag) + content
    return b"\x08" + struct.pack("<Q", len(data)) + data


def _xdf(table: Table) -> bytes:
    """One stream of all numbers, and one for each column of texts (marks): libxdf reads only one text of a sample. The times are those of the column
    monotonic, t or onset, in s."""
    clock = next((name for name in ("monotonic", "t", "onset") if name in table), None)
    if clock is None:
        fail("lab/no_times", "columns", "the table has no times", "give it a column 't', 'onset' or 'monotonic', in s")
    times, about = np.asarray(table[clock], dtype=float), escape(json.dumps(table.sidecar(), ensure_ascii=False))
    numbers = [name for name in table if not _is_text(table[name])]
    rows = np.zeros(len(times), dtype=[("flag", "u1"), ("time", "<f8"), ("values", "<f8", (len(numbers),))])
    rows["flag"], rows["time"], rows["values"] = 8, times, np.stack([np.asarray(table[name], dtype=float) for name in numbers], axis=1)
    streams = [("tactus", "Haptics", numbers, table.rate_hz, "double64", rows.tobytes())]
    for name in table:
        if _is_text(table[name]):
            texts = b"".join(struct.pack("<BdBI", 8, time, 4, len(text)) + text for time, text in zip(times, (str(t).encode() for t in table[name])))
            streams.append((name, "Markers", [name], 0.0, "string", texts))
    first, last = (float(times[0]), float(times[-1])) if len(times) else (0.0, 0.0)
    foot = (f'<?xml version="1.0"?><info><first_timestamp>{first!r}</first_timestamp>'
            f'<last_timestamp>{last!r}</last_timestamp><sample_count>{len(times)}</sample_count></info>')
    made = [b"XDF:" + _chunk(1, b'<?xml version="1.0"?><info><version>1.0</version></info>')]
    for number, (name, kind, channels, rate, form, samples) in enumerate(streams, 1):
        units = ["" if kind == "Markers" else table.units.get(channel, "") for channel in channels]
        described = "".join(f"<channel><label>{escape(c)}</label><unit>{escape(u)}</unit></channel>" for c, u in zip(channels, units))
        head = (f'<?xml version="1.0"?><info><name>{escape(name)}</name><type>{kind}</type><channel_count>{len(channels)}</channel_count>'
                f"<nominal_srate>{rate!r}</nominal_srate><channel_format>{form}</channel_format><source_id>tactus</source_id><version>1.1</version>"
                f"<desc><channels>{described}</channels><about>{about}</about></desc></info>")
        id = struct.pack("<I", number)
        made += [_chunk(2, id + head.encode()), *([_chunk(3, id + b"\x08" + struct.pack("<Q", len(times)) + samples)] if len(times) else []),
                 _chunk(6, id + foot.encode())]
    return b"".join(made)


_WRITERS = {".csv": lambda table: _text(table, ","), ".tsv": lambda table: _text(table, "\t"), ".h5": _hdf5, ".mat": _mat, ".xdf": _xdf}
