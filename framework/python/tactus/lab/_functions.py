# SPDX-License-Identifier: MIT
"""Psychometric functions: the chance of a "yes" or a right answer over the level of a stimulus."""

from __future__ import annotations

import math
from typing import Any, Literal, get_args

import numpy as np

from .._checks import Array

Function = Literal["logistic", "normal", "weibull"]
FUNCTIONS = get_args(Function)


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
    """The distribution function of the standard normal distribution."""
    return np.asarray(0.5 * _erfc(np.asarray(z, dtype=float) * -math.sqrt(0.5)), dtype=float)


_erfc = np.frompyfunc(math.erfc, 1, 1)
