# SPDX-License-Identifier: MIT
"""What the command line finds out, as objects: check, limits, fit, devices, which libtactus_live computes with the code of the commands; and logs of runs."""

from __future__ import annotations

import ctypes
import json
import math
import os
from concurrent.futures import ThreadPoolExecutor, wait
from contextlib import ExitStack
from typing import Any, Dict, Iterable, List, Mapping, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np

from . import _checks, _tactus
from ._assets import Assets, reader
from ._checks import Array, Path
from ._graph import Graph, checked_graph
from ._library import Messages, Opened, live, texts
from ._messages import Message, fail
from ._plot import axes_of
from ._records import Layout, Records, table_of, to_json
from ._views import html_table, html_text, plain, with_unit


class Condition(NamedTuple):
    """A condition on a graph and a device (docs/check.md). verdict: "passive", "passive_here" (along this motion only), "stable", "unstable", "holds",
    "near", "broken", "unknown" or "not_reached". value, limit: in `unit`; None if not known. margin: how many times the value may grow."""

    id: str
    role: str
    node: str
    verdict: str
    value: Optional[float]
    limit: Optional[float]
    margin: Optional[float]
    unit: str
    law: str
    text: str
    remedy: str

    @property
    def is_broken(self) -> bool:
        """True for the verdicts "unstable" and "broken"."""
        return self.verdict in ("unstable", "broken")

    def __repr__(self) -> str:
        return f"<tactus.Condition {plain(self.id)} of {plain(self.role)}: {plain(self.verdict)}>"


class Check:
    """The conditions of a graph on its devices. json: all that `tactus check` prints as JSON. conditions: those that were judged. is_broken: one of them is
    broken; False is no promise, as not everything can be judged. not_judged: what has no verdict, each with `what` and `why`. scope: the motion and the
    places along which it was judged."""

    def __init__(self, report: Dict[str, Any]):
        self.json, self.scope = report, str(report["scope"])
        self.rate_hz, self.is_broken = float(report["rate_hz"]), bool(report["broken"])
        self.not_judged: List[Dict[str, str]] = report["not_judged"]
        self.conditions = [Condition(**{name: c.get(name, "") for name in Condition._fields}) for c in report["conditions"]]

    def __repr__(self) -> str:
        broken = [f"{c.id} of {plain(c.role)}" for c in self.conditions if c.is_broken]
        return f"<tactus.Check: {'broken: ' + ', '.join(broken) if self.is_broken else 'no judged condition is broken'}; {plain(self.scope, 80)}>"

    def _repr_html_(self) -> str:
        rows = [(c.role, c.node, c.id, c.verdict, with_unit(c.value, c.unit), with_unit(c.limit, c.unit), c.text) for c in self.conditions]
        return f"<p>{html_text(self.scope)}</p>" + _html_list(f"not judged: {n['what']}: {n['why']}" for n in self.not_judged) + html_table(
            ("role", "node", "condition", "verdict", "value", "limit", ""), rows)


class Interval(NamedTuple):
    """A range of values around the present one. high: infinite if there is no limit. is_low_known, is_high_known: False if the loop beyond is not known."""

    low: float
    high: float
    is_low_known: bool
    is_high_known: bool

    def __str__(self) -> str:
        return f"{self.low:.4g}{'' if self.is_low_known else ' (unknown below)'} to {self.high:.4g}{'' if self.is_high_known else ' (unknown above)'}"


class Limits:
    """How stiff, damped and slow the heaviest contact of a graph may be. json: all that `tactus limits` prints as JSON. stiffness (N/m), damping (N s/m),
    rate (Hz): of the contact as it is. passive, stable: the ranges of "stiffness", "damping" and "rate", each by itself; None if there is none. The rule of
    `passive` is sufficient, not necessary. points, columns: with steps, the points of the regions."""

    def __init__(self, report: Dict[str, Any]):
        self.json = report
        self.role, self.node = str(report["role"]), str(report["node"])
        self.stiffness, self.damping, self.rate = float(report["stiffness"]), float(report["damping"]), float(report["rate_hz"])
        self.passive, self.stable = _intervals(report["passive"]), _intervals(report["stable"])
        self.columns: List[str] = list(report.get("columns", []))
        self.points: Array = np.array(report.get("rows", []), dtype=np.float64).reshape(-1, max(len(self.columns), 1))

    def __repr__(self) -> str:
        return f"<tactus.Limits of {plain(self.role)}: {self.stiffness:.3g} N/m and {self.damping:.3g} N s/m at {self.rate:g} Hz>"

    def _repr_html_(self) -> str:
        rows = [(f"{name} ({unit})", f"{now:.4g}", self.passive[name] or "nowhere", self.stable[name] or "nowhere")
                for name, unit, now in (("stiffness", "N/m", self.stiffness), ("damping", "N s/m", self.damping), ("rate", "Hz", self.rate))]
        return html_table((f"{self.role}, {self.node}", "now", "passive (sufficient)", "stable"), rows)

    def plot(self, x: str = "stiffness (N/m)", y: str = "damping (N*s/m)", axes: Any = None) -> Any:
        """Draws the points that are stable, passive or neither over two of the columns, and returns the matplotlib figure. It needs `steps`."""
        if not len(self.points):
            fail("plot/nothing", "steps", "there are no points", "give tactus.limits a number of steps")
        for name in (x, y):
            if name not in self.columns:
                fail("plot/unknown", name, f"there is no column '{plain(name)}'", f"use one of {', '.join(self.columns)}")
        column = dict(zip(self.columns, self.points.T))
        passive, stable = column["passive"] == 1.0, column["stable"]
        kinds = {"passive": passive, "stable, not passive": ~passive & (stable == 1.0), "not stable": ~passive & (stable < 1.0),
                 "unknown": ~passive & np.isnan(stable)}
        return _drawn(axes, x, y, [(label, column[x][which], column[y][which], ".") for label, which in kinds.items()])


class FitValue(NamedTuple):
    """A fitted parameter with its 95 % interval, in `unit` (SI). A bound that the recording does not determine is infinite. is_main: the verdict depends on
    the interval."""

    name: str
    unit: str
    value: float
    low: float
    high: float
    is_main: bool


class Fit:
    """A fit of a recording. values: the parameters by name. verdict: "good" or "poor" (is_good); lacking: what makes it poor, and which data would help.
    residual, left_out_residual, size: root mean squares of what is left, of the same on a part that was left out, and of the recording, in residual_unit.
    graph: a preset in which it can be felt. json: all that `tactus fit` prints as JSON, and the picture."""

    def __init__(self, report: Dict[str, Any]):
        self.json = report
        self.kind, self.verdict, self.is_good = str(report["kind"]), str(report["verdict"]), report["verdict"] == "good"
        self.values = {str(v["name"]): FitValue(str(v["name"]), str(v["unit"]), _finite(v["value"], math.nan), _finite(v["low"], -math.inf),
                                                _finite(v["high"], math.inf), bool(v["main"])) for v in report["parameters"]}
        self.lacking, self.notes = [str(line) for line in report["lacking"]], [str(line) for line in report["notes"]]
        left, self.rows = report["residual"], int(report["rows"])
        self.residual, self.left_out_residual, self.size = (_finite(left[k], math.nan) for k in ("rms", "left_out_rms", "recording_rms"))
        self.residual_unit = str(left["unit"])

    @property
    def graph(self) -> Graph:
        """A new graph with the fitted node."""
        return Graph.parse(self.json["graph"])

    def __repr__(self) -> str:
        return f"<tactus.Fit of {self.kind}, {self.verdict}: " + ", ".join(f"{v.name} {v.value:.4g} {v.unit}".rstrip() for v in self.values.values()) + ">"

    def _repr_html_(self) -> str:
        rows = [(v.name, with_unit(v.value, v.unit), f"{v.low:.4g} to {v.high:.4g}") for v in self.values.values()]
        lines = [f"verdict: {self.verdict}; residual {with_unit(self.residual, self.residual_unit)} of {with_unit(self.size, self.residual_unit)}",
                 *self.lacking, *self.notes]
        return html_table((self.kind, "value", "95 % interval"), rows) + _html_list(lines)

    def plot(self, axes: Any = None) -> Any:
        """Draws the recording and the fit, and returns the matplotlib figure."""
        p = self.json["picture"]
        curves = [(c["label"], *(np.array(c[k], dtype=np.float64) for k in "xy"), "." if c["recorded"] else "-") for c in p["curves"]]
        return _drawn(axes, f"{p['x']} ({p['x_unit'] or '1'})", f"{p['y']} ({p['y_unit'] or 'as recorded'})", curves, markersize=2)


class Conversion:
    """A file in another format. json: what the library says. files: those that were written. losses: what the formats cannot hold, as messages.
    differences: how far the written clips are from the one that was read, as sentences. notes: what the reader left out or guessed."""

    def __init__(self, report: Dict[str, Any]):
        self.json = report
        self.files = [str(file["name"]) for file in report["files"]]
        self.losses, self.notes = ([Message(False, m["id"], m["where"], m["text"], m["remedy"]) for m in found]
                                   for found in ([loss for file in report["files"] for loss in file["losses"]], report["notes"]))
        self.differences = [str(sentence) for file in report["files"] for sentence in file["differences"]]

    def __repr__(self) -> str:
        return f"<tactus.Conversion to {', '.join(map(plain, self.files))}: {len(self.losses)} losses; {plain('; '.join(self.differences), 200)}>"

    def _repr_html_(self) -> str:
        return _html_list([*(f"wrote {name}" for name in self.files), *(f"lost: {loss.where}: {loss.text}" for loss in self.losses), *self.differences])


class Devices(List[Dict[str, Any]]):
    """Devices as `tactus devices` lists them in JSON: a dict for each."""

    def __repr__(self) -> str:
        return f"<tactus.Devices: {len(self)}>"

    def _repr_html_(self) -> str:
        return html_table(("device", "profiles", "may be opened"), [(d.get("product") or d.get("port") or d.get("name", ""),
                                                                 ", ".join(p["id"] for p in d.get("profiles", [])) or d.get("profile", ""),
                                                                 {True: "yes", False: "no"}.get(d.get("may_open", None), "only simulated")) for d in self])


@_checks.arguments
def check(graph: Union[Graph, Path], *, devices: Optional[Mapping[str, str]] = None, set: Optional[Mapping[str, Any]] = None, rate: Optional[float] = None,
          duration: Optional[float] = None, sweep: bool = False, speed: Optional[float] = None, alpha: Optional[float] = None, beta: Optional[float] = None,
          gamma: Optional[float] = None) -> Check:
    """Checks whether devices can render a graph, as `tactus check` does, with the same numbers.

    graph: a tactus.Graph, a file, or the name of a preset. devices: by role, the id of a profile, a file, "gesture:circle" or "trace:FILE.csv"; set: values
    of parameters; rate: in Hz; duration: of the motion in s; sweep: the devices sweep their workspaces; speed: of strokes, in m/s; alpha, beta, gamma:
    samples and quanta per period, as in docs/check.md. Takes seconds; other threads run meanwhile."""
    return Check(_examined("tactus_check", graph, devices, set, rate=rate, duration=duration, sweep=_checks.truth("sweep", sweep) or None, speed=speed,
                           alpha=alpha, beta=beta, gamma=gamma))


@_checks.arguments
def limits(graph: Union[Graph, Path], *, devices: Optional[Mapping[str, str]] = None, set: Optional[Mapping[str, Any]] = None, rate: Optional[float] = None,
           duration: Optional[float] = None, role: Optional[str] = None, x: Optional[str] = None, y: Optional[str] = None,
           steps: Optional[int] = None) -> Limits:
    """Finds how stiff, damped and slow the heaviest contact of a graph may be, as `tactus limits` does, with the same numbers.

    graph, devices, set, rate, duration: as for tactus.check. role: whose contact. x, y: what varies, "stiffness=0:5000" (N/m), "damping=0:20" (N s/m),
    "rate=500:8000" (Hz) or "wall.stiffness=100:5000". steps: along x and y; with it, Limits.points has the points, which takes longer."""
    return Limits(_examined("tactus_limits", graph, devices, set, rate=rate, duration=duration, role=role, x=x, y=y, steps=steps))


@_checks.arguments
def fit(kind: str, recording: Union[Path, Mapping[str, Any]], *, columns: Optional[Mapping[str, str]] = None, units: Optional[Mapping[str, str]] = None,
        signs: Optional[Mapping[str, str]] = None, options: Optional[Mapping[str, Union[float, str]]] = None) -> Fit:
    """Fits the model of a node to a recording, as `tactus fit` does, with the same numbers.

    kind: "friction", "modes", "texture", "grating", "blade", "curve", "switch" or "shock". recording: a CSV or WAV file, or arrays by the name of the column,
    each of shape (n,); names may have units, as in "force [mN]". columns: the name of the column of a role, "" if it was not recorded; units: what 1 in it
    means, "1 mN"; signs: "+" or "-". options: of the kind, as numbers in SI or texts with units: {"load": "2 N"}; docs/fit.md lists them."""
    name = _checks.text("kind", kind, "give a kind, such as 'friction'").encode()
    given = _options({"columns": columns, "units": units, "signs": signs, **_checks.mapping("options", options, "{'load': '2 N'}")})
    if not hasattr(recording, "items"):
        return Fit(_asked("tactus_fit", name, os.fsencode(_checks.path("recording", recording, "give a path, or {'position': x, 'force': f}")), None, given))
    names, values = table_of(dict(recording.items()))
    table = _ColumnsStruct(texts(names), len(names), values.ctypes.data_as(ctypes.POINTER(ctypes.c_double)), len(values))
    return Fit(_asked("tactus_fit", name, None, ctypes.byref(table), given))


@_checks.arguments
def convert(source: Path, target: Path, *, rate: Optional[float] = None, calibration: Optional[Path] = None, split: bool = False,
            options: Optional[Mapping[str, float]] = None) -> Conversion:
    """Converts a haptic clip (AHAP, .haptic, HJIF, CSV, clips of Tactus) into another format, or a pen recording into a trace, as `tactus convert` does, with
    the same bits.

    source, target: files, whose extensions choose the formats; a target that exists is replaced. rate: of samples or rows, in Hz. calibration: an actuator
    calibration file of Meta. split: an .ahap into two files. options: of a pen: "pitch", "depth", "lift" (m), "force" (N), "full-pressure"."""
    given = _options({"rate": rate, "calibration": None if calibration is None else _checks.path("calibration", calibration),
                      "split": _checks.truth("split", split) or None, **_checks.mapping("options", options, "{'force': 2.0}")})
    return Conversion(_asked("tactus_convert", os.fsencode(_checks.path("source", source)), os.fsencode(_checks.path("target", target)), given))


def devices() -> Devices:
    """Lists HID devices, serial ports, event devices, and profiles of devices that can only be simulated. `tactus devices` also lists sound cards, which
    tactus.play cannot open. Nothing is opened."""
    return Devices(_asked("tactus_devices"))


class _ColumnsStruct(ctypes.Structure):
    _fields_ = [("names", ctypes.POINTER(ctypes.c_char_p)), ("count", ctypes.c_size_t), ("values", ctypes.POINTER(ctypes.c_double)),
                ("rows", ctypes.c_size_t)]


def _examined(function: str, graph: Union[Graph, Path], devices: Optional[Mapping[str, str]], values: Optional[Mapping[str, Any]], **options: Any) -> Any:
    roles = _checks.mapping("devices", devices, "{'stylus': 'tactus_board'}")
    given = {"devices": [f"{role}={_checks.text(f'devices[{role!r}]', what, 'give the id of a profile')}" for role, what in roles.items()],
             "set": dict(_checks.mapping("set", values, "{'drag.mu': 0.3}")) or None, **options}
    return _asked(function, _options(given), graph=graph)


def _options(given: Mapping[str, Any]) -> bytes:
    return to_json({key: dict(value) if isinstance(value, Mapping) else value for key, value in given.items() if value is not None}, "options").encode()


def _asked(function: str, *arguments: Any, graph: Union[Graph, Path, None] = None) -> Any:
    """The answer of a function of the library, from JSON. Python handles Ctrl-C only between its own instructions, so another thread calls the function. After
    Ctrl-C, that call ends by itself within seconds, and frees what it uses; the end of the program waits for it."""
    with ExitStack() as used:
        if graph is not None:
            arguments = (used.enter_context(Opened(graph)), *arguments)
        messages = used.enter_context(Messages())
        thread = ThreadPoolExecutor(1)
        answer = thread.submit(getattr(live(), function), *arguments, messages.handle)
        thread.shutdown(wait=False)

        @used.callback
        def free() -> None:
            live().tactus_text_free(ctypes.c_void_p(answer.result()))

        try:
            while not wait([answer], 0.05).done:   # not every system wakes a thread that waits without an end
                pass
        except KeyboardInterrupt:
            live().tactus_limits_interrupt()
            rest = used.pop_all()
            answer.add_done_callback(lambda _: rest.close())
            raise
        text = answer.result()
        messages.check(bool(text))
        return json.loads(ctypes.string_at(text))


def _intervals(ranges: Mapping[str, Any]) -> Dict[str, Optional[Interval]]:
    return {name: None if (r := ranges[name]) is None else Interval(r["from"], _finite(r["to"], math.inf), "unknown_below" not in r, "unknown_above" not in r)
            for name in ("stiffness", "damping", "rate")}


def _drawn(axes: Any, x: str, y: str, curves: Iterable[Tuple[Any, ...]], **style: Any) -> Any:
    """The figure with curves: label, x, y, and format of matplotlib."""
    ax = axes_of(axes)
    for label, xs, ys, form in curves:
        ax.plot(xs, ys, form, label=label, **style)
    ax.set(xlabel=x, ylabel=y)
    ax.legend(frameon=False, fontsize="small")
    return ax.figure


def _html_list(lines: Iterable[str]) -> str:
    return f"<ul>{''.join(f'<li>{html_text(line)}</li>' for line in lines)}</ul>"


def _finite(value: Optional[float], otherwise: float) -> float:
    return otherwise if value is None else float(value)


class Event(NamedTuple):
    """Something in a log that is no reading. kind: "turn" (name: a parameter), "hit" (name: an input; value in m/s), "graph", "halt", "rearm",
    "emergency", "tightened" (name: a role), "late", "end" or "broken"."""

    tick: int
    kind: str
    name: str
    value: Any

    def __repr__(self) -> str:
        return f"<tactus.Event at tick {self.tick}: {plain(self.kind)} {plain(self.name)}>"


class Log(Records):
    """What a log says about each tick: arrays by role and field, "stylus.position" of shape (n, 3) in m. "passed" is the time since the previous tick in s
    by the wall clock.

    events: what was turned, hit and stopped. wall, monotonic: when tick 0 began, in s since 1970 (UTC) and by time.monotonic(); None if the run was not in
    real time. program: what wrote the log. is_cut_off: the program died."""

    def __init__(self, rows: Records, about: Dict[str, Any]):
        super().__init__(rows, units=rows.units, rate_hz=rows.rate_hz)
        head, clocks = about["head"], about["head"]["clocks"] or {}
        self.events = [Event(int(e["tick"]), str(e["kind"]), str(e["name"]), e["value"]) for e in about["events"]]
        self.wall: Optional[float] = clocks.get("wall")
        self.monotonic: Optional[float] = clocks.get("monotonic")
        self.program, self.is_cut_off = str(head["program"]), bool(about["is_cut_off"])

    def at(self, time: float) -> float:
        """The tick, with its fraction, at a monotonic time in s, such as that of a mark or of another recording on this computer. The ticks are those of this
        log; before and after them, it is not a number."""
        if self.monotonic is None:
            return math.nan
        begun = self.monotonic + np.concatenate(([0.0], np.cumsum(self["passed"][1:])))
        return float(np.interp(time, begun, np.arange(len(begun), dtype=np.float64), math.nan, math.nan))


@_checks.arguments
def read_log(log: Path, *, start: float = 0.0, until: Optional[float] = None) -> Log:
    """Reads a log of `tactus play`, of a session or of an engine, packed or not. Nothing is played.

    start, until: the part that is read, in s of ticks; without `until`, to the end. A long log needs tactus.set_limits("numbers=1G")."""
    return Log(*_read(_tactus.read_log(_checks.path("log", log), *_part(start, until))))


@_checks.arguments
def replay(log: Path, graph: Optional[Graph] = None, *, record: Optional[Sequence[str]] = None, set: Optional[Mapping[str, Any]] = None,
           start: float = 0.0, until: Optional[float] = None, assets: Optional[Assets] = None) -> Records:
    """Plays a logged run again, as `tactus render` does, with the same bits. No device moves.

    graph: played instead of that of the log. record: ports; without any, the inputs of all sinks. set: values of parameters. start, until: the ticks that
    are returned, in s; all before them are played, too. assets: as in Graph.render."""
    ports = [] if record is None else _checks.texts("record", record, "['drag.force']")
    values = {name: to_json(value, name) for name, value in _checks.mapping("set", set, "{'drag.mu': 0.3}").items()}
    played = None if graph is None else checked_graph(graph)._graph
    begin, end = _part(start, until)
    return _read(_tactus.replay(_checks.path("log", log), played, ports, values, reader(assets), begin, end), ports)[0]


def _part(start: Any, until: Any) -> Tuple[float, float]:
    begin = _checks.number("start", start, "give a time in s", low=0.0)
    return begin, math.inf if until is None else _checks.number("until", until, "give a time in s after the start", above=begin)


def _read(table: Tuple[int, List[str], List[str], Array, str], asked: Sequence[str] = ()) -> Tuple[Records, Dict[str, Any]]:
    first, names, units, values, text = table
    about: Dict[str, Any] = json.loads(text)
    rate = float(about["rate_hz"] if "rate_hz" in about else about["head"]["rate_hz"])
    return Layout(names, units, asked, rate).records(values, first), about
