# SPDX-License-Identifier: MIT
"""Psychometric functions: the chance of a "yes" or a right answer over the level of a stimulus."""

from __future__ import annotations

import math
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Function = Literal["logistic", "normal", "weibull"]
FUNCTIONS = ("logistic", "normal", "weibull")


def core(function: Function, level: Any, threshold: Any, width: Any) -> Array:
    """F, from 0 to 1, without guesses and lapses.

    logistic: 1 / (1 + exp (-(x - threshold) / width)), 0.5 at the threshold. normal: Phi ((x - threshold) / width), 0.5 at the threshold.
    weibull: 1 - exp (-(x / threshold)^width), 1 - 1/e at the threshold; x >= 0, and width is an exponent without a unit."""
    x = np.asarray(level, dtype=float)
    if function == "weibull":
        with np.errstate(over="ignore", divide="ignore"):
            return np.asarray(-np.expm1(-np.power(np.maximum(x, 0.0) / threshold, width)))
    z = (x - threshold) / width
    return np.asarray(0.5 * (1.0 + np.tanh(0.5 * z))) if function == "logistic" else phi(z)


def probability(function: Function, level: Any, threshold: Any, width: Any, guess: Any = 0.0, lapse: Any = 0.0) -> Array:
    """guess + (1 - guess - lapse) F: the chance of a "yes" or a right answer."""
    return np.asarray(guess + (1.0 - guess - lapse) * core(function, level, threshold, width))


def phi(z: Any) -> Array:
    """The distribution function of the standard normal distribution: a table of math.erfc with steps of 1/512, and cubics between; off by
    less than 1e-13 where a test compares it."""
    at = np.clip(np.asarray(z, dtype=float), -_ENDS, _ENDS) + _ENDS
    i = np.minimum((at * _PER_UNIT).astype(int), len(_VALUES) - 2)
    u = at * _PER_UNIT - i
    rise = _VALUES[i + 1] - _VALUES[i]
    slope, next_slope = _SLOPES[i] / _PER_UNIT, _SLOPES[i + 1] / _PER_UNIT
    return np.asarray(_VALUES[i] + u * (slope + u * (3.0 * rise - 2.0 * slope - next_slope + u * (slope + next_slope - 2.0 * rise))))


_ENDS, _PER_UNIT = 9, 512
_POINTS = [i / _PER_UNIT - _ENDS for i in range(2 * _ENDS * _PER_UNIT + 1)]
_VALUES = np.array([0.5 * math.erfc(-z / math.sqrt(2.0)) for z in _POINTS])
_SLOPES = np.array([math.exp(-0.5 * z * z) / math.sqrt(2.0 * math.pi) for z in _POINTS])
