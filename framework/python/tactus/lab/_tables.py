# SPDX-License-Identifier: MIT
"""Tables in files that other programs read: CSV, TSV, HDF5, MAT (version 5) and XDF; and the trials and marks of a session, made from its journal."""

from __future__ import annotations

import csv
import io
import itertools
import json
import math
import pathlib
import re
import struct
from typing import Any, Dict, Iterator, List, Mapping, Optional, Sequence, Tuple, Union
from xml.sax.saxutils import escape

import numpy as np

from .._checks import Path
from .._messages import fail
from .._records import Records, components, imported
from .._views import html_table
from . import _journal
from ._analysis import Detection, Function, PowerLaw, Psychometric, detection, power_law, psychometric
from ._procedures import Constant, Psi, Staircase, StaircaseTrack
from ._protocol import Block, Protocol
from ._results import replace
from ._schema import read

Column = Any   # an array of numbers, or a list of texts


class Table(Dict[str, Column]):
    """Columns of one length by name: arrays of shape (n,), or lists of texts. None among numbers is not a number. units: SI units of columns. about: what else
    is known, for the sidecar. rate_hz: of rows that are ticks, 0 otherwise."""

    def __init__(self, columns: Mapping[str, Column], units: Optional[Mapping[str, str]] = None, about: Optional[Mapping[str, Any]] = None,
                 rate_hz: float = 0.0):
        super().__init__({name: values if isinstance(values, list) and any(isinstance(v, str) for v in values) else
                          np.array(values, float) if isinstance(values, list) and None in values else np.asarray(values) for name, values in columns.items()})
        self.units, self.about, self.rate_hz = dict(units or {}), dict(about or {}), rate_hz
        if len(lengths := {len(values) for values in self.values()}) > 1:
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
            file.create_dataset(name, data=data, dtype=kind).attrs["units"] = table.units.get(name, "")
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
    return b"\x08" + struct.pack("<QH", len(content) + 2, tag) + content


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


_TRIAL_UNITS = {"onset": "s", "duration": "s", "response_time": "s", "begin_wall": "s", "begin_monotonic": "s"}
_EVENT_UNITS = {"onset": "s", "duration": "s", "wall": "s", "monotonic": "s"}


class SessionData:
    """The results of a session. trials, events: tables; `write` writes them beside the journal, with names after BIDS."""

    def __init__(self, folder: pathlib.Path, stem: str, events: List[_journal.Event], protocol: Protocol):
        self.folder, self.stem, self.protocol, self.header, self._events = folder, stem, protocol, events[0], events
        self.is_complete = any(event.get("event") == "end" for event in events)
        about = {{"protocol": "protocol_sha256"}.get(key, key): value for key, value in self.header.items() if key not in ("format", "version")}
        units = {block.varies.unit for block in protocol.blocks}
        of_levels = {"level": units.pop()} if len(units) == 1 else {}   # blocks may vary different things
        self.trials = _table([self._trial_row(event, onset) for event, onset in self._timed("trial")], {**_TRIAL_UNITS, **of_levels}, about)
        self.events = _table([{"onset": onset, "duration": 0.0, "trial_type": event["name"], "value": event["value"] or "n/a", "code": event.get("code"),
                               **{key: event[key] for key in ("tick", "wall", "monotonic")}} for event, onset in self._timed("mark")], _EVENT_UNITS, about)

    def _timed(self, kind: str) -> Iterator[Tuple[_journal.Event, float]]:
        """The events of a kind, with the time since the session began, in s. It is taken from the monotonic clock within a run, which may begin anew
        between runs."""
        begun = run = self.header["started"]
        for event in self._events:
            if event.get("event") == "mark" and event["name"] == "run":
                run = event
            if event.get("event") == kind:
                yield event, float(run["wall"] - begun["wall"] + event.get("begin", event)["monotonic"] - run["monotonic"])

    def _trial_row(self, event: _journal.Event, onset: float) -> Dict[str, Any]:
        begin = event["begin"]
        return {"onset": onset, "duration": event["end"]["monotonic"] - begin["monotonic"],
                **{key: event[key] for key in ("number", "block", "kind", "condition", "track", "level")},
                "intervals": " ".join(map(repr, event["intervals"])), "expected": event["expected"] or "n/a",
                "answer": "n/a" if event["answer"] is None else str(event["answer"]), "outcome": event["outcome"],
                "response_time": event["response_time"], "guard": " ".join(event["guard"]) or "n/a", "guard_count": len(event["guard"]),
                "tick": begin["tick"], "begin_wall": begin["wall"], "begin_monotonic": begin["monotonic"]}

    def write(self, *formats: str) -> List[pathlib.Path]:
        """Writes _beh.tsv (trials) and _events.tsv with sidecars, and the same in further formats: "csv", "h5", "mat", "xdf". They are made from the journal,
        so writing them again loses nothing. Returns the files."""
        written = []
        for name, table in (("beh", self.trials), ("events", self.events)):
            for extension in ("tsv", *formats):
                copy = "_copy" if extension == "csv" else ""   # with a sidecar of its own
                written.append(self.folder / f"{self.stem}_{name}{copy}.{extension}")
                table.write(written[-1])
        top = self.folder.parents[2] / "dataset_description.json"
        if not top.exists():
            top.write_text(json.dumps({"Name": self.protocol.name, "BIDSVersion": "1.8.0", "DatasetType": "raw", "GeneratedBy": [{"Name": "tactus.lab"}]},
                                      indent=2) + "\n", encoding="utf-8")
        return written

    def _block(self, name: Optional[str]) -> Block:
        for block in self.protocol.blocks:
            if name in (None, block.name):
                return block
        fail("lab/unknown", "block", f"there is no block '{name}'", f"the blocks: {', '.join(b.name for b in self.protocol.blocks)}")

    def chosen(self, block: Optional[str] = None, condition: Optional[str] = None, kind: str = "main") -> Dict[str, Any]:
        """Levels and outcomes (both of shape (n,)) of the answered trials of a block, by default the first; of one condition, by default all."""
        name = self._block(block).name
        rows = [(level, outcome) for b, k, c, level, outcome in zip(*(self.trials[key] for key in ("block", "kind", "condition", "level", "outcome")))
                if (b, k, c) == (name, kind, c if condition is None else condition) and not math.isnan(outcome)]
        levels, outcomes = np.array(rows, dtype=float).reshape(-1, 2).T
        return {"levels": levels, "outcomes": outcomes}

    def fit(self, block: Optional[str] = None, condition: Optional[str] = None, *, function: Optional[Function] = None,
            lapse: Optional[float] = None) -> Union[Psychometric, PowerLaw]:
        """The psychometric function of a block, with its guess rate, by the posterior after a staircase or psi; for magnitude estimation, the power law.
        Practice and catch trials do not count."""
        given, data = self._block(block), self.chosen(block, condition)
        if given.task == "magnitude":
            return power_law(data["levels"], data["outcomes"])
        if given.task in ("adjust", "match"):
            fail("lab/data", given.name, "a psychometric function cannot be fitted to adjusted levels", "take their mean: chosen(block)['outcomes']")
        used = function or (given.procedure.function if isinstance(given.procedure, Psi) else "logistic")
        return psychometric(data["levels"], data["outcomes"], function=used, guess=given.guess_rate, lapse=lapse, unit=given.varies.unit,
                            method="profile" if isinstance(given.procedure, Constant) else "posterior")

    def detection(self, block: Optional[str] = None, condition: Optional[str] = None) -> Detection:
        """d' and criterion of a block with the task yes_no: its trials are signals, its catch trials noise."""
        if self._block(block).task != "yes_no":
            fail("lab/data", self._block(block).name, "the task is not yes_no", "give a block with the task yes_no")
        signals, noises = self.chosen(block, condition)["outcomes"], self.chosen(block, condition, "catch")["outcomes"]
        return detection(int(signals.sum()), len(signals), int(noises.sum()), len(noises))

    def turns(self, block: Optional[str] = None) -> Dict[str, List[float]]:
        """The levels at the reversals of each staircase, by condition and track ("smooth/0"), in the unit of what varies."""
        given = self._block(block)
        if not isinstance(given.procedure, Staircase):
            fail("lab/data", given.name, "the procedure of this block is not a staircase", "give a block with a staircase")
        tracks: Dict[str, StaircaseTrack] = {}
        for b, kind, c, t, level, outcome in zip(*(self.trials[key] for key in ("block", "kind", "condition", "track", "level", "outcome"))):
            if b == given.name and kind == "main" and not math.isnan(outcome):
                tracks.setdefault(f"{c}/{int(t)}", StaircaseTrack(given.procedure)).answer(level, outcome)
        return {name: track.turns for name, track in tracks.items()}

    def _repr_html_(self) -> str:
        state = "complete" if self.is_complete else "not complete"
        return f"<p>{self.stem}: {self.trials.rows} trials, {state}</p>{self.trials._repr_html_()}"


def _table(rows: List[Dict[str, Any]], units: Dict[str, str], about: Dict[str, Any]) -> Table:
    return Table({name: [row[name] for row in rows] for name in (rows[0] if rows else units)}, units, about)


def load(folder: Path, name: str = "") -> SessionData:
    """The data of a session, complete or not, from its folder. name: of the experiment, if the folder has several."""
    place = pathlib.Path(folder)
    found = sorted(place.glob(f"*_task-{name or '*'}_journal.jsonl"))
    if len(found) != 1:
        fail("lab/journal", str(folder), f"there are {len(found)} journals here" + (f" of '{name}'" if name else ""),
             "give the folder of a session, such as data/sub-01/ses-01/beh, and the name of an experiment if there are several")
    stem = found[0].name[:-len("_journal.jsonl")]
    data = json.loads((place / f"{stem}_protocol.json").read_text(encoding="utf-8"))
    return SessionData(place, stem, _journal.read(found[0]), read(Protocol, data))
