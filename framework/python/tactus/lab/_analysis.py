# SPDX-License-Identifier: MIT
"""Psychometric functions, and fits of them with intervals by profile likelihood or from a posterior; d' and criterion; the exponent of magnitude estimation;
plots."""

from __future__ import annotations

import importlib
import math
import os
import statistics
from dataclasses import dataclass, field
from typing import Any, Dict, List, Literal, NamedTuple, Optional, Sequence, Tuple, get_args

import numpy as np
from numpy.typing import ArrayLike

from .. import _checks
from .._checks import Array, Path
from .._messages import fail
from .._plot import axes_of
from .._views import html_table

Function = Literal["logistic", "normal", "weibull"]
_CLIP = 1e-12   # chances of 0 and 1 have no likelihood
_erfc = np.vectorize(math.erfc, otypes=[float])


def core(function: Function, level: Any, threshold: Any, width: Any) -> Array:
    """F, from 0 to 1, without guesses and lapses.

    logistic: 1 / (1 + exp (-(x - threshold) / width)), 0.5 at the threshold. normal: Phi ((x - threshold) / width), 0.5 at the threshold.
    weibull: 1 - exp (-(x / threshold)^width), 1 - 1/e at the threshold; x >= 0, and width is an exponent without a unit."""
    x = np.asarray(level, dtype=float)
    if function == "weibull":
        with np.errstate(over="ignore", divide="ignore"):
            return np.asarray(-np.expm1(-np.power(np.maximum(x, 0.0) / threshold, width)))
    z = (x - threshold) / width
    return np.asarray(0.5 * (1.0 + np.tanh(0.5 * z)) if function == "logistic" else 0.5 * _erfc(z * -math.sqrt(0.5)))


def probability(function: Function, level: Any, threshold: Any, width: Any, guess: Any = 0.0, lapse: Any = 0.0) -> Array:
    """guess + (1 - guess - lapse) F: the chance of a "yes" or a right answer."""
    return np.asarray(guess + (1.0 - guess - lapse) * core(function, level, threshold, width))


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
    levels: Array = field(repr=False)
    yes: Array = field(repr=False)
    trials: Array = field(repr=False)
    unit: str = "1"

    def __call__(self, level: ArrayLike) -> Array:
        """The chance of a "yes" or a right answer."""
        return probability(self.function, level, self.threshold, self.width, self.guess, self.lapse)

    def level(self, chance: float = 0.75) -> float:
        """The level at which the function has this value, in the unit of the levels; NaN if it never has."""
        share = (chance - self.guess) / (1.0 - self.guess - self.lapse)
        return self._level(share) if 0.0 < share < 1.0 else math.nan

    def _level(self, share: float) -> float:
        if self.function == "weibull":
            return float(self.threshold * (-math.log1p(-share)) ** (1.0 / self.width))
        return self.threshold + self.width * (math.log(share / (1.0 - share)) if self.function == "logistic" else statistics.NormalDist().inv_cdf(share))

    @property
    def slope(self) -> float:
        """The slope at the threshold, per unit of the levels."""
        at = {"logistic": 0.25, "normal": 1.0 / math.sqrt(2.0 * math.pi), "weibull": math.exp(-1.0)}[self.function]
        return (1.0 - self.guess - self.lapse) * at * (self.width / self.threshold if self.function == "weibull" else 1.0 / self.width)

    @property
    def jnd(self) -> float:
        """The just noticeable difference, in the unit of the levels: from a share of 0.5 to one of 0.75, without guesses and lapses."""
        return self._level(0.75) - self._level(0.5)

    def plot(self, ax: Any = None) -> Any:
        """Draws the data and the function with matplotlib; returns the axes."""
        ax = axes_of(ax)
        span = np.linspace(self.levels.min(), self.levels.max(), 200)
        ax.plot(span, self(span), color="black", lw=1.0)
        ax.scatter(self.levels, self.yes / self.trials, s=4.0 + 60.0 * self.trials / self.trials.max(), color="tab:blue", zorder=3)
        low, high = self.threshold_interval
        ax.axvline(self.threshold, color="gray", lw=0.6)
        if math.isfinite(high - low):
            ax.axvspan(low, high, color="gray", alpha=0.2, lw=0.0)
        ax.set(xlabel=f"level ({self.unit})", ylabel="share of yes or right", ylim=(-0.03, 1.03))
        return ax

    def _repr_html_(self) -> str:
        rows = [("threshold", self.threshold, self.unit, self.threshold_interval),
                ("width", self.width, "1" if self.function == "weibull" else self.unit, self.width_interval),
                ("guess", self.guess, "1", None), ("lapse", self.lapse, "1", None), ("deviance", self.deviance, "1", None)]
        head = f"{self.function}, {int(self.trials.sum())} trials", "value", "unit", f"{self.confidence:.0%} interval"
        return html_table(head, [(name, f"{value:.4g}", unit, f"{i.low:.4g} to {i.high:.4g}" if i else "") for name, value, unit, i in rows])


class _Likelihood:
    """The likelihood of data over threshold (weibull: its logarithm), log width and lapse rate, searched on grids: no start is needed, and a second summit
    is not missed."""

    def __init__(self, function: Function, levels: Array, yes: Array, trials: Array, guess: float, lapse: Optional[float]):
        self.function, self.levels, self.yes, self.no, self.guess = function, levels, yes, trials - yes, guess
        low, high = float(levels.min()), float(levels.max())
        span = high - low or abs(low) or 1.0
        if function == "weibull":
            self.low, self.high = np.log([low / 5.0 if low > 0.0 else span / 1e3, 0.05]), np.log([high * 5.0, 60.0])
        else:
            self.low, self.high = np.array([low - 2.0 * span, math.log(span / 300.0)]), np.array([high + 2.0 * span, math.log(6.0 * span)])
        self.lapses = np.array([lapse]) if lapse is not None else np.linspace(0.0, min(0.06, 0.99 - guess), 9)
        self.middle = math.log(3.0 if function == "weibull" else span / 6.0)   # of the prior of the log width

    def logs(self, thresholds: Array, widths: Array, lapses: Array) -> Array:
        """Its logarithm on a grid, shape (thresholds, widths, lapses)."""
        at = np.exp(thresholds) if self.function == "weibull" else thresholds
        found = np.zeros((len(thresholds), len(widths), len(lapses)))
        for first in range(0, len(self.levels), 200):   # so that many levels take no more memory
            some = slice(first, first + 200)
            shares = core(self.function, self.levels[some], at[:, None, None], np.exp(widths)[None, :, None])
            for i, lapse in enumerate(lapses):
                p = np.clip(self.guess + (1.0 - self.guess - lapse) * shares, _CLIP, 1.0 - _CLIP)
                found[:, :, i] += np.log(p) @ self.yes[some] + np.log1p(-p) @ self.no[some]
        return found

    def best(self) -> Tuple[float, float, float]:
        """The most likely threshold, log width and lapse rate. A grid around the best point so far moves until that is inside, and then shrinks."""
        low, high = np.append(self.low, self.lapses[0]), np.append(self.high, self.lapses[-1])
        at, half, counts = 0.5 * (low + high), 0.5 * (high - low), np.array([101, 31, 9])
        for _ in range(200):
            axes = [np.unique(np.clip(np.linspace(a - h, a + h, n), b, c)) for a, h, n, b, c in zip(at, half, counts, low, high)]
            logs = self.logs(axes[0], axes[1], axes[2])
            where = np.unravel_index(int(np.argmax(logs)), logs.shape)
            at = np.array([axis[i] for axis, i in zip(axes, where)])
            if all(0 < i < len(axis) - 1 or axis[i] in (b, c) for axis, i, b, c in zip(axes, where, low, high)):
                half, counts = 4.0 * half / (counts - 1), np.array([9, 9, 9])
            if (half < 1e-9 * (high - low + 1e-300)).all():
                break
        return float(at[0]), float(at[1]), float(at[2])

    def ends(self, confidence: float, best: Optional[Tuple[float, float, float]]) -> Tuple[List[Tuple[float, float, float]], float]:
        """Low end, middle and high end of threshold and log width, and the lapse rate, from a coarse grid and then finer ones over the part that matters.
        With the best point: where the profile, the largest value over all others, has fallen from it. Without: medians and equal tails of the posterior,
        whose prior is that of `psychometric`, and the mean of the lapse rate."""
        ends = np.array([self.low, self.high]).T
        if best is None:
            ends[1] = self.middle - 4.0, self.middle + 4.0
        else:
            fallen = self.logs(*(np.array([x]) for x in best)).item() - 0.5 * statistics.NormalDist().inv_cdf(0.5 + 0.5 * confidence) ** 2
        for counts in ((101, 21), (61, 41), (81 if best is None else 161, 61)):
            grids = [np.linspace(low, high, count) for (low, high), count in zip(ends, counts)]
            logs = self.logs(grids[0], grids[1], self.lapses)
            if best is None:
                mass = np.exp(logs - logs.max() - 0.5 * (grids[1][:, None] - self.middle) ** 2)
                kept = [mass.sum(axis=(1, 2)), mass.sum(axis=(0, 2))]
            else:
                kept = [logs.max(axis=(1, 2)), logs.max(axis=(0, 2))]
            insides = [np.flatnonzero(one > (1e-6 * one.sum() if best is None else min(fallen, one.max()) - 4.0)) for one in kept]
            ends = np.array([[grid[max(i[0] - 1, 0)], grid[min(i[-1] + 1, len(grid) - 1)]] for grid, i in zip(grids, insides)])
        if best is None:
            return [_tails(grid, one, confidence) for grid, one in zip(grids, kept)], float(mass.sum(axis=(0, 1)) @ self.lapses / mass.sum())
        return [_crossings(grid, one, at, fallen) for grid, one, at in zip(grids, kept, best)], best[2]


def _tails(grid: Array, mass: Array, confidence: float) -> Tuple[float, float, float]:
    below = np.concatenate([[0.0], np.cumsum(0.5 * (mass[1:] + mass[:-1]))])
    low, middle, high = np.interp([0.5 - 0.5 * confidence, 0.5, 0.5 + 0.5 * confidence], below / below[-1], grid)
    return float(low), float(middle), float(high)


def _crossings(grid: Array, profile: Array, at: float, fallen: float) -> Tuple[float, float, float]:
    """Where a profile has fallen, on both sides of a point; infinite if it does not on the grid."""
    low, high = np.flatnonzero((profile < fallen) & (grid < at))[-1:], np.flatnonzero((profile < fallen) & (grid > at))[:1]
    ends = [float(np.interp(fallen, [profile[i[0]], max(profile[i[0] + step], fallen)], [grid[i[0]], grid[i[0] + step]])) if len(i) else -step * math.inf
            for i, step in ((low, 1), (high, -1))]
    return ends[0], at, ends[1]


def _gathered(levels: ArrayLike, yes: ArrayLike, trials: Optional[ArrayLike]) -> Tuple[Array, Array, Array]:
    """One entry for each level."""
    x, k = _checks.array("levels", levels).ravel(), _checks.array("yes", yes).ravel()
    n = np.ones(len(x)) if trials is None else _checks.array("trials", trials).ravel()
    if not len(x) == len(k) == len(n) or len(x) == 0:
        fail("lab/shape", "levels", f"there are {len(x)} levels, {len(k)} answers and {len(n)} numbers of trials", "give arrays of the same length")
    if not (np.isfinite(x).all() and np.isfinite(k).all() and np.isfinite(n).all()) or (k < 0.0).any() or (k > n).any():
        fail("lab/value", "yes", "a level is not finite, or there are more answers than trials", "give levels, and the yes or right answers out of trials")
    known, where = np.unique(x, return_inverse=True)
    total, right = np.bincount(where, n).astype(float), np.bincount(where, k).astype(float)
    return known[total > 0], right[total > 0], total[total > 0]


def psychometric(levels: ArrayLike, yes: ArrayLike, trials: Optional[ArrayLike] = None, *, function: Function = "logistic", guess: float = 0.0,
                 lapse: Optional[float] = None, confidence: float = 0.95, unit: str = "1", method: Literal["profile", "posterior"] = "profile") -> Psychometric:
    """Fits a psychometric function. method: "profile": by maximum likelihood, with intervals by profile likelihood; "posterior": medians and intervals of
    the posterior, for levels that a staircase or the psi method has chosen, where intervals by profile likelihood are too short. Its prior is flat, but for
    the width, whose logarithm is normal, with a standard deviation of 1, around a sixth of the span of the levels (weibull: around an exponent of 3).

    levels: shape (n,), in `unit`. yes: shape (n,): 0 or 1 for each trial, or numbers of "yes" or right answers out of `trials`. guess: the rate without a
    stimulus: 0.5 for two intervals. lapse: the rate of mistakes at any level; without it, it is fitted, from 0 to 0.06 (Wichmann and Hill 2001).
    An interval that the data do not bound is infinite. docs/lab.md tells how often the intervals hold the truth."""
    if function not in get_args(Function):
        fail("lab/value", "function", f"there is no function {_checks.shown(function)}", f"the functions: {', '.join(get_args(Function))}")
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
    (ends, widths), missed = given.ends(confidence, given.best() if method == "profile" else None)
    low, threshold, high = map(math.exp, ends) if function == "weibull" else ends
    narrow, width, wide = map(math.exp, widths)
    share, p = (np.clip(chances, _CLIP, 1.0 - _CLIP) for chances in (k / n, probability(function, x, threshold, width, guess, missed)))
    deviance = 2.0 * float(k @ np.log(share / p) + (n - k) @ np.log((1.0 - share) / (1.0 - p)))
    return Psychometric(function, threshold, width, guess, missed, Interval(low, high), Interval(narrow, wide), deviance, confidence, x, k, n, unit)


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
    (exponent, gain), covariance = np.polyfit(np.log(x), np.log(y), 1, cov=True)
    half = t_quantile(len(x) - 2) * math.sqrt(covariance[0, 0])
    return PowerLaw(math.exp(gain), float(exponent), Interval(float(exponent) - half, float(exponent) + half))


def t_quantile(free: int, share: float = 0.975) -> float:
    """The quantile of Student's distribution with `free` degrees of freedom, from a sum over x, where t = sqrt (free) tan (x)."""
    x = np.linspace(0.0, 0.5 * math.pi, 100001)
    below = np.cumsum(np.cos(0.5 * (x[1:] + x[:-1])) ** (free - 1))
    return math.sqrt(free) * math.tan(float(np.interp(2.0 * share - 1.0, np.append(0.0, below / below[-1]), x)))


def save_plot(ax: Any, path: Path) -> None:
    """Writes the figure of axes as .svg, .pdf or .png; the same figure gives the same bytes."""
    matplotlib = importlib.import_module("matplotlib")
    kind = os.path.splitext(os.fspath(path))[1].lower()
    dates: Dict[str, Dict[str, Optional[str]]] = {".svg": {"Date": None}, ".pdf": {"CreationDate": None}}
    with matplotlib.rc_context({"svg.hashsalt": "tactus", "pdf.fonttype": 42}):
        ax.figure.savefig(path, metadata=dates.get(kind))


def plot_staircase(levels: Sequence[float], outcomes: Sequence[float], unit: str = "1", ax: Any = None) -> Any:
    """Draws the levels of a staircase over its trials; right answers are filled. Returns the axes."""
    ax = axes_of(ax)
    count, right = np.arange(1, len(levels) + 1), np.asarray(outcomes, dtype=float) > 0.0
    ax.plot(count, levels, color="gray", lw=0.8)
    for kind, face in ((right, "tab:blue"), (~right, "white")):
        ax.scatter(count[kind], np.asarray(levels, dtype=float)[kind], s=14, facecolor=face, edgecolor="tab:blue", zorder=3)
    ax.set(xlabel="trial", ylabel=f"level ({unit})")
    return ax
