# SPDX-License-Identifier: MIT
"""Psychometric functions, fitted with intervals by profile likelihood or from a posterior; d' and criterion; the exponent of magnitude estimation; plots."""

from __future__ import annotations

import html
import importlib
import math
import os
import statistics
from dataclasses import dataclass
from typing import Any, Dict, List, Literal, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _checks
from .._messages import fail
from ._functions import FUNCTIONS, Function, core, probability

Array = NDArray[np.float64]
_CLIP = 1e-12   # chances of 0 and 1 have no likelihood
_MOST_LAPSE = 0.06


class Interval(NamedTuple):
    """An interval; infinite where the data do not bound it."""

    low: float
    high: float


@dataclass(frozen=True)
class Psychometric:
    """A fitted psychometric function. threshold, width and their intervals: in the unit of the levels (weibull: width is an exponent, without one).
    deviance: -2 log of the likelihood over that of the observed shares. levels, yes, trials: the data, one entry for each level."""

    function: Function
    threshold: float
    width: float
    guess: float
    lapse: float
    threshold_interval: Interval
    width_interval: Interval
    deviance: float
    confidence: float
    levels: Array
    yes: Array
    trials: Array
    unit: str = "1"

    def __call__(self, level: ArrayLike) -> Array:
        """The chance of a "yes" or a right answer."""
        return probability(self.function, level, self.threshold, self.width, self.guess, self.lapse)

    def level(self, chance: float = 0.75) -> float:
        """The level at which the function has this value, in the unit of the levels; NaN if it never has."""
        share = (chance - self.guess) / (1.0 - self.guess - self.lapse)
        if not 0.0 < share < 1.0:
            return math.nan
        if self.function == "weibull":
            return float(self.threshold * math.pow(-math.log1p(-share), 1.0 / self.width))
        z = math.log(share / (1.0 - share)) if self.function == "logistic" else statistics.NormalDist().inv_cdf(share)
        return self.threshold + self.width * z

    @property
    def slope(self) -> float:
        """The slope at the threshold, per unit of the levels."""
        at = {"logistic": 0.25, "normal": 1.0 / math.sqrt(2.0 * math.pi), "weibull": math.exp(-1.0)}[self.function]
        return (1.0 - self.guess - self.lapse) * at * (self.width / self.threshold if self.function == "weibull" else 1.0 / self.width)

    @property
    def jnd(self) -> float:
        """The just noticeable difference, in the unit of the levels: from a share of 0.5 to one of 0.75, without guesses and lapses."""
        if self.function == "weibull":
            return float(self.threshold * (math.log(4.0) ** (1.0 / self.width) - math.log(2.0) ** (1.0 / self.width)))
        return self.width * (math.log(3.0) if self.function == "logistic" else 0.6744897501960817)

    def plot(self, ax: Any = None) -> Any:
        """Draws the data and the function with matplotlib; returns the axes."""
        ax = _axes(ax)
        span = np.linspace(self.levels.min(), self.levels.max(), 200)
        ax.plot(span, self(span), color="black", lw=1.0)
        ax.scatter(self.levels, self.yes / self.trials, s=4.0 + 60.0 * self.trials / self.trials.max(), color="tab:blue", zorder=3)
        low, high = self.threshold_interval
        ax.axvline(self.threshold, color="gray", lw=0.6)
        if math.isfinite(high - low):
            ax.axvspan(low, high, color="gray", alpha=0.2, lw=0.0)
        ax.set_xlabel(f"level ({self.unit})")
        ax.set_ylabel("share of yes or right")
        ax.set_ylim(-0.03, 1.03)
        return ax

    def _repr_html_(self) -> str:
        rows = [("threshold", self.threshold, self.unit, self.threshold_interval),
                ("width", self.width, "1" if self.function == "weibull" else self.unit, self.width_interval),
                ("guess", self.guess, "1", None), ("lapse", self.lapse, "1", None), ("deviance", self.deviance, "1", None)]
        cells = "".join(f"<tr><td>{name}</td><td>{value:.4g}</td><td>{html.escape(unit)}</td><td>{f'{i.low:.4g} to {i.high:.4g}' if i else ''}</td></tr>"
                        for name, value, unit, i in rows)
        return f"<table><caption>{self.function}, {int(self.trials.sum())} trials, {self.confidence:.0%} intervals</caption>{cells}</table>"


class _Likelihood:
    """The likelihood of data over threshold, log width and lapse rate."""

    def __init__(self, function: Function, levels: Array, yes: Array, trials: Array, guess: float, lapse: Optional[float]):
        self.function, self.levels, self.yes, self.trials, self.guess = function, levels, yes, trials, guess
        span = float(levels.max() - levels.min()) or abs(float(levels[0])) or 1.0
        low, high = float(levels.min()), float(levels.max())
        widths = (0.05, 60.0) if function == "weibull" else (span / 300.0, 6.0 * span)
        thresholds = (low / 5.0 if low > 0.0 else span / 1e3, high * 5.0) if function == "weibull" else (low - 2.0 * span, high + 2.0 * span)
        free = 0.0 if lapse is None else lapse
        self.low = np.array([thresholds[0], math.log(widths[0]), free])
        self.high = np.array([thresholds[1], math.log(widths[1]), min(_MOST_LAPSE, 0.99 - guess) if lapse is None else lapse])
        self.middle = math.log(3.0 if function == "weibull" else span / 6.0)   # of the prior of the log width
        self.step = np.array([1e-5 * span, 1e-5, 1e-6])

    def chances(self, at: Array) -> Array:
        return np.clip(probability(self.function, self.levels, at[0], math.exp(at[1]), self.guess, at[2]), _CLIP, 1.0 - _CLIP)

    def log(self, at: Array) -> float:
        p = self.chances(at)
        return float(self.yes @ np.log(p) + (self.trials - self.yes) @ np.log1p(-p))

    def begin(self) -> Array:
        """The best point of a coarse grid."""
        if self.function == "weibull":
            t = np.exp(np.linspace(math.log(max(self.low[0], 1e-300)), math.log(self.high[0]), 25))
        else:
            t = np.linspace(self.levels.min(), self.levels.max(), 21)
        w = np.linspace(self.low[1], self.high[1], 13)
        lapses = np.linspace(self.low[2], self.high[2], 2 if self.high[2] > self.low[2] else 1)
        p = np.clip(self.guess + (1.0 - self.guess - lapses[None, None, :, None]) * core(self.function, self.levels, t[:, None, None, None],
                                                                                        np.exp(w)[None, :, None, None]), _CLIP, 1.0 - _CLIP)
        logs = np.log(p) @ self.yes + np.log1p(-p) @ (self.trials - self.yes)
        i, k, m = np.unravel_index(int(np.argmax(logs)), logs.shape)
        return np.array([t[i], w[k], lapses[m]])

    def climb(self, start: Array, held: Sequence[int] = ()) -> Tuple[Array, float]:
        """The most likely point from a start on, by Fisher scoring within the bounds; parameters in `held` stay."""
        at = np.clip(start, self.low, self.high)
        best, damping = self.log(at), 1e-3
        for _ in range(60):
            p = self.chances(at)
            free = [i for i in range(3) if i not in held and self.high[i] > self.low[i]]
            slopes = np.stack([(self.chances(at + d) - self.chances(at - d)) / (2.0 * self.step[i]) for i in free
                               for d in [np.eye(3)[i] * self.step[i]]]) if free else np.zeros((0, len(p)))
            score = slopes @ ((self.yes - self.trials * p) / (p * (1.0 - p)))
            moves = [k for k, i in enumerate(free) if not (at[i] <= self.low[i] and score[k] < 0.0 or at[i] >= self.high[i] and score[k] > 0.0)]
            if not moves:
                break
            information = (slopes[moves] * (self.trials / (p * (1.0 - p)))) @ slopes[moves].T
            scale = np.sqrt(np.maximum(np.diag(information), 1e-300))
            gained = 0.0
            for _ in range(25):
                step = np.linalg.solve(information / np.outer(scale, scale) + damping * np.eye(len(moves)), score[moves] / scale) / scale
                tried = at.copy()
                tried[[free[k] for k in moves]] += step
                tried = np.clip(tried, self.low, self.high)
                value = self.log(tried)
                if value > best:
                    gained, at, best, damping = value - best, tried, value, max(damping * 0.2, 1e-9)
                    break
                damping = min(damping * 5.0, 1e12)
            if gained < 1e-10:
                break
            damping = min(damping, 1e3)
        return at, best

    def profile(self, index: int, value: float, start: Array) -> Tuple[Array, float]:
        """The most likely point with one parameter held at a value; the start helps, and a coarse one guards against a local summit."""
        held = start.copy()
        held[index] = value
        return self.climb(held, [index])

    def posterior(self, confidence: float) -> List[Tuple[float, float, float]]:
        """Low end, median and high end of threshold and log width, with equal tails of the posterior, on a grid: first a coarse
        one, then finer ones over the part that holds its mass. The prior is flat in the threshold (weibull: its logarithm) and in the lapse rate; the log
        width is normal, around a sixth of the span of the levels (weibull: an exponent of 3), with a standard deviation of 1."""
        is_log = self.function == "weibull"
        middle = self.middle
        ends = [np.log(self.low[0]) if is_log else self.low[0], np.log(self.high[0]) if is_log else self.high[0], middle - 4.0, middle + 4.0]
        lapses = np.linspace(self.low[2], self.high[2], 5 if self.high[2] > self.low[2] else 1)
        for counts in ((101, 21), (61, 41), (81, 61)):
            t, w = np.linspace(ends[0], ends[1], counts[0]), np.linspace(ends[2], ends[3], counts[1])
            shares = core(self.function, self.levels, (np.exp(t) if is_log else t)[:, None, None], np.exp(w)[None, :, None])
            logs = np.stack([np.log(p) @ self.yes + np.log1p(-p) @ (self.trials - self.yes) for lapse in lapses
                             for p in [np.clip(self.guess + (1.0 - self.guess - lapse) * shares, _CLIP, 1.0 - _CLIP)]])
            mass = np.exp(logs - logs.max()).sum(axis=0) * np.exp(-0.5 * (w - middle) ** 2)
            tails = [mass.sum(axis=1) / mass.sum(), mass.sum(axis=0) / mass.sum()]
            if counts != (81, 61):
                for at, (grid, tail) in enumerate(zip((t, w), tails)):
                    inside = np.flatnonzero(tail > 1e-6)
                    ends[2 * at:2 * at + 2] = [grid[max(inside[0] - 1, 0)], grid[min(inside[-1] + 1, len(grid) - 1)]]
        found = []
        for grid, tail in zip((t, w), tails):
            below = np.concatenate([[0.0], np.cumsum(0.5 * (tail[1:] + tail[:-1]))])
            found.append([float(x) for x in np.interp([0.5 - 0.5 * confidence, 0.5, 0.5 + 0.5 * confidence], below / below[-1], grid)])
        (a, b, c), (d, e, f) = [math.exp(x) for x in found[0]] if is_log else found[0], found[1]
        return [(a, b, c), (d, e, f)]


def _interval(given: _Likelihood, best: Array, log: float, index: int, drop: float) -> Tuple[float, float]:
    """Where the profile of a parameter has fallen by `drop`; infinite if it does not within the bounds."""
    ends = []
    for sign, bound in ((-1.0, given.low[index]), (1.0, given.high[index])):
        at, step = best, 1e-3 * (given.high[index] - given.low[index])
        inside, outside = best[index], math.nan
        while math.isnan(outside):
            value = inside + sign * step
            if (bound - value) * sign <= 0.0:
                value = bound
            at, here = given.profile(index, value, at)
            if log - here > drop:
                outside = value
            elif value == bound:
                break
            else:
                inside, step = value, 2.0 * step
        if math.isnan(outside):
            ends.append(sign * math.inf)
            continue
        for _ in range(40):
            middle = 0.5 * (inside + outside)
            at, here = given.profile(index, middle, at)
            inside, outside = (inside, middle) if log - here > drop else (middle, outside)
            if abs(outside - inside) < 1e-4 * max(abs(inside - best[index]), 1e-12):
                break
        ends.append(0.5 * (inside + outside))
    return ends[0], ends[1]


def _gathered(levels: ArrayLike, yes: ArrayLike, trials: Optional[ArrayLike]) -> Tuple[Array, Array, Array]:
    """One entry for each level."""
    x, k = _checks.array("levels", levels).ravel(), _checks.array("yes", yes).ravel()
    n = np.ones(len(x)) if trials is None else _checks.array("trials", trials).ravel()
    if not len(x) == len(k) == len(n) or len(x) == 0:
        fail("lab/shape", "levels", f"there are {len(x)} levels, {len(k)} answers and {len(n)} numbers of trials", "give arrays of the same length")
    if not (np.isfinite(x).all() and np.isfinite(k).all() and np.isfinite(n).all()) or (k < 0.0).any() or (k > n).any():
        fail("lab/value", "yes", "a level is not finite, or there are more answers than trials", "give levels, and the yes or right answers out of trials")
    known, where = np.unique(x, return_inverse=True)
    total, right = np.zeros(len(known)), np.zeros(len(known))
    np.add.at(total, where, n)
    np.add.at(right, where, k)
    return known[total > 0], right[total > 0], total[total > 0]


def psychometric(levels: ArrayLike, yes: ArrayLike, trials: Optional[ArrayLike] = None, *, function: Function = "logistic", guess: float = 0.0,
                 lapse: Optional[float] = None, confidence: float = 0.95, unit: str = "1", method: Literal["profile", "posterior"] = "profile") -> Psychometric:
    """Fits a psychometric function. method: "profile": by maximum likelihood, with intervals by profile likelihood; "posterior": medians and intervals of
    the posterior, for levels that a staircase or the psi method has chosen, where intervals by profile likelihood are too short. Its prior is flat, but for
    the width, whose logarithm is normal, with a standard deviation of 1, around a sixth of the span of the levels (weibull: around an exponent of 3).

    levels: shape (n,), in `unit`. yes: shape (n,): 0 or 1 for each trial, or numbers of "yes" or right answers out of `trials`. guess: the rate without a
    stimulus: 0.5 for two intervals. lapse: the rate of mistakes at any level; without it, it is fitted, from 0 to 0.06 (Wichmann and Hill 2001).
    An interval that the data do not bound is infinite. docs/lab.md tells how often the intervals hold the truth."""
    if function not in FUNCTIONS:
        fail("lab/value", "function", f"there is no function {_checks.shown(function)}", f"the functions: {', '.join(FUNCTIONS)}")
    _checks.number("guess", guess, "give a rate from 0 to 0.99", low=0.0, high=0.99)
    _checks.number("confidence", confidence, "give a share such as 0.95", above=0.0, high=0.9999)
    if lapse is not None:
        _checks.number("lapse", lapse, "give a rate from 0, less than 1 together with guess", low=0.0, high=0.99 - guess)
    x, k, n = _gathered(levels, yes, trials)
    if len(x) < 2:
        fail("lab/data", "levels", "all trials have the same level", "give trials at two levels or more")
    if function == "weibull" and x.min() < 0.0:
        fail("lab/value", "levels", "a level is less than 0", "the function weibull needs levels from 0; use logistic or normal")
    given = _Likelihood(function, x, k, n, guess, lapse)
    best, log = given.climb(given.begin())
    share = np.clip(k / n, _CLIP, 1.0 - _CLIP)
    saturated = float(k @ np.log(share) + (n - k) @ np.log1p(-share))
    if method == "posterior":
        thresholds, logs = given.posterior(confidence)
        best[0], best[1], log = thresholds[1], logs[1], given.log(np.array([thresholds[1], logs[1], best[2]]))
        ends, widths = (thresholds[0], thresholds[2]), (logs[0], logs[2])
    else:
        drop = 0.5 * statistics.NormalDist().inv_cdf(0.5 + 0.5 * confidence) ** 2
        ends, widths = _interval(given, best, log, 0, drop), _interval(given, best, log, 1, drop)
    return Psychometric(function, float(best[0]), math.exp(best[1]), guess, float(best[2]), Interval(*ends),
                        Interval(math.exp(widths[0]), math.exp(widths[1]) if widths[1] < math.inf else math.inf),
                        2.0 * (saturated - log), confidence, x, k, n, unit)


# ------------------------------------------------------------------------ Signals and noise

class Detection(NamedTuple):
    """d_prime and criterion (both in standard deviations of the noise) with 95 % intervals (Gourevitch and Galanter 1967)."""

    d_prime: float
    criterion: float
    d_prime_interval: Interval
    criterion_interval: Interval


def detection(hits: int, signals: int, false_alarms: int, noises: int) -> Detection:
    """d' and criterion of "yes" answers: `hits` of `signals`, and `false_alarms` of `noises`. Half an answer is added to both kinds (Hautus 1995), so rates of
    0 and 1 are finite."""
    for name, count, most in (("hits", hits, signals), ("false_alarms", false_alarms, noises)):
        _checks.whole(name, count, "give a number of answers", high=_checks.whole(name, most, "give a number of trials", low=1))
    normal = statistics.NormalDist()
    rates = (hits + 0.5) / (signals + 1.0), (false_alarms + 0.5) / (noises + 1.0)
    z = [normal.inv_cdf(rate) for rate in rates]
    variance = sum(rate * (1.0 - rate) / (count * normal.pdf(at) ** 2) for rate, count, at in zip(rates, (signals, noises), z))
    d, c, sd = z[0] - z[1], -0.5 * (z[0] + z[1]), 1.959963984540054 * math.sqrt(variance)
    return Detection(d, c, Interval(d - sd, d + sd), Interval(c - 0.5 * sd, c + 0.5 * sd))


def d_prime_of_two_intervals(right: int, trials: int) -> float:
    """d' of two-interval forced choice without a bias: sqrt (2) z, with half an answer added to both kinds."""
    return math.sqrt(2.0) * statistics.NormalDist().inv_cdf((_checks.whole("right", right, "give a number of answers", high=trials) + 0.5) / (trials + 1.0))


class PowerLaw(NamedTuple):
    """answer = gain * level^exponent (Stevens 1957), with the 95 % interval of the exponent; the exponent has no unit."""

    gain: float
    exponent: float
    exponent_interval: Interval


def power_law(levels: ArrayLike, answers: ArrayLike) -> PowerLaw:
    """Fits magnitude estimates by least squares of logarithms; levels (in any unit) and answers, both of shape (n,), must be above 0."""
    x, y = _checks.array("levels", levels).ravel(), _checks.array("answers", answers).ravel()
    if len(x) != len(y) or len(x) < 3 or not ((x > 0.0).all() and (y > 0.0).all()) or np.ptp(x) == 0.0:
        fail("lab/data", "levels", "a power law needs three pairs of levels and answers or more, all above 0, at two levels or more", "leave out answers of 0")
    u, v = np.log(x), np.log(y)
    spread = float(((u - u.mean()) ** 2).sum())
    exponent = float(((u - u.mean()) * (v - v.mean())).sum() / spread)
    gain = float(v.mean() - exponent * u.mean())
    free = len(x) - 2
    error = math.sqrt(float(((v - gain - exponent * u) ** 2).sum()) / free / spread)
    half = t_quantile(free) * error
    return PowerLaw(math.exp(gain), exponent, Interval(exponent - half, exponent + half))


def t_quantile(free: int, share: float = 0.975) -> float:
    """The quantile of Student's distribution with `free` degrees of freedom, by bisection of its integral."""
    def below(t: float) -> float:
        x = np.linspace(0.0, math.atan(t / math.sqrt(free)), 2001)   # t = sqrt (free) tan (x)
        y = np.cos(x) ** (free - 1)
        scale = math.exp(math.lgamma(0.5 * (free + 1)) - math.lgamma(0.5 * free)) / math.sqrt(math.pi)
        return 0.5 + scale * float((y[0] + 4.0 * y[1:-1:2].sum() + 2.0 * y[2:-1:2].sum() + y[-1]) * (x[1] - x[0]) / 3.0)
    low, high = 0.0, 1e4
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if below(middle) < share else (low, middle)
    return low


# ------------------------------------------------------------------------ Plots

def _axes(ax: Any) -> Any:
    if ax is not None:
        return ax
    try:
        figure = importlib.import_module("matplotlib.figure")
    except ImportError as why:
        fail("lab/no_matplotlib", "plot", f"matplotlib cannot be imported: {why}", "install it: on Debian, python3-matplotlib")
    return figure.Figure(figsize=(4.0, 3.0), layout="constrained").add_subplot()


def save_plot(ax: Any, path: Union[str, "os.PathLike[str]"]) -> None:
    """Writes the figure of axes as .svg, .pdf or .png; the same figure gives the same bytes."""
    matplotlib = importlib.import_module("matplotlib")
    kind = os.path.splitext(os.fspath(path))[1].lower()
    dates: Dict[str, Dict[str, Optional[str]]] = {".svg": {"Date": None}, ".pdf": {"CreationDate": None}}
    with matplotlib.rc_context({"svg.hashsalt": "tactus", "pdf.fonttype": 42}):
        ax.figure.savefig(path, metadata=dates.get(kind))


def plot_staircase(levels: Sequence[float], outcomes: Sequence[float], unit: str = "1", ax: Any = None) -> Any:
    """Draws the levels of a staircase over its trials; right answers are filled. Returns the axes."""
    ax = _axes(ax)
    count, right = np.arange(1, len(levels) + 1), np.asarray(outcomes, dtype=float) > 0.0
    ax.plot(count, levels, color="gray", lw=0.8)
    for kind, face in ((right, "tab:blue"), (~right, "white")):
        ax.scatter(count[kind], np.asarray(levels, dtype=float)[kind], s=14, facecolor=face, edgecolor="tab:blue", zorder=3)
    ax.set_xlabel("trial")
    ax.set_ylabel(f"level ({unit})")
    return ax
