# SPDX-License-Identifier: MIT
"""The analysis of tactus.lab, against closed forms, psyphy and brute force; and how often nominal 95 % intervals hold the truth:

    lab_fit_test.py coverage [--runs 2000] [--seed SEED] [METHOD...]

Without --seed, the seed is drawn. A method is PROCEDURE/FUNCTION: constant (7 levels of 40 trials), staircase or psi (both 80 trials in two intervals;
1 up, 2 down), logistic, normal or weibull; or detection (100 signals, 100 noises), or power (5 levels of 10 magnitudes). Each prints how many intervals
held the true threshold (or d', or exponent), and the true width (or criterion): by profile likelihood, and then of the posterior."""

import argparse
import importlib.util
import math
import secrets
import sys
import unittest

import numpy as np
from lab_protocol_test import block, protocol, walk
from support import TestCase
from tactus import lab
from tactus.lab import _analysis
from tactus.lab._procedures import Draw

THRESHOLD, WIDTH = 10.0, {"logistic": 1.0, "normal": 1.7, "weibull": 3.5}
LEVELS = np.array([6.0, 7.5, 9.0, 10.0, 11.0, 12.5, 14.0])
YES = np.array([1, 4, 11, 19, 30, 37, 39])


def likelihood(fit, threshold, width, lapse):
    """The logarithm of the likelihood of the data of a fit at other parameters, which may be arrays of one shape."""
    p = np.clip(lab.probability(fit.function, fit.levels, *(np.asarray(x)[..., None] for x in (threshold, width)), fit.guess, np.asarray(lapse)[..., None]),
                1e-12, 1 - 1e-12)
    return np.log(p) @ fit.yes + np.log1p(-p) @ (fit.trials - fit.yes)


def answered(procedure, function, seed):
    """The levels of an experiment, whether the answers of a simulated observer were right, and the guess rate."""
    task, given = {"constant": ("yes_no", lab.Constant(levels=tuple(LEVELS), repeats=40)),
                   "staircase": ("2ifc", lab.Staircase(start=16.0, steps=(2.0, 1.0, 0.5), low=0.5, high=40.0, trials=80)),
                   "psi": ("2ifc", lab.Psi(levels=tuple(range(2, 22)), widths=tuple(WIDTH[function] * 2.0 ** k for k in (-2, -1, 0, 1, 2)),
                                           lapses=(0.0, 0.03), function=function, trials=80))}[procedure]
    observer = lab.Observer(THRESHOLD, WIDTH[function], lapse=0.02, function=function, seed=seed)
    trials = walk(lab.Plan(protocol(block("main", task, given), seed=seed)), lambda trial: observer.answer(trial, trial.level))[1]
    return [t.level for t in trials], [t.outcome(observer.answer(t, t.level)) for t in trials], trials[0].block.guess_rate


def run(method, seed):
    """Whether the intervals of one experiment hold the truth."""
    draw = Draw(seed)
    if method == "detection":
        d, c = 1.5, 0.3
        hits, alarms = (sum(draw.uniform() < rate for _ in range(100)) for rate in lab.probability("normal", [0.5 * d - c, -0.5 * d - c], 0.0, 1.0))
        return [low <= truth <= high for (low, high), truth in zip(lab.detection(hits, 100, alarms, 100)[2:], (d, c))]
    if method == "power":
        levels = np.repeat([1.0, 2.0, 4.0, 8.0, 16.0], 10)
        answers = [5.0 * level ** 0.8 * math.exp(0.3 * draw.normal()) for level in levels]
        low, high = lab.power_law(levels, answers).exponent_interval
        return [low <= 0.8 <= high]
    procedure, function = method.split("/")
    levels, right, guess = answered(procedure, function, seed)
    fits = [lab.psychometric(levels, right, function=function, guess=guess, method=method) for method in ("profile", "posterior")]
    return [low <= truth <= high for fit in fits for (low, high), truth in ((fit.threshold_interval, THRESHOLD), (fit.width_interval, WIDTH[function]))]


class Analysis(TestCase):
    def test_values_at_the_threshold_and_far_away(self):
        for function, at in (("logistic", 0.5), ("normal", 0.5), ("weibull", 1.0 - math.exp(-1.0))):
            chances = lab.probability(function, [1e-9 if function == "weibull" else -1e9, 10.0, 1e9], 10.0, 2.0, 0.5, 0.02)
            self.assertTrue(np.allclose(chances, [0.5, 0.5 + 0.48 * at, 0.98], rtol=0.0, atol=1e-12), chances)

    def test_level_jnd_and_slope_follow_from_the_function(self):
        for function in ("logistic", "normal", "weibull"):
            fit = lab.psychometric(LEVELS, YES, np.full(7, 40), function=function, lapse=0.02)
            self.assertAlmostEqual(float(fit(fit.level(0.7))), 0.7, 9)
            self.assertTrue(math.isnan(fit.level(0.99)))
            shares = _analysis.core(function, [fit.level(0.98 * 0.5), fit.level(0.98 * 0.5) + fit.jnd], fit.threshold, fit.width)
            self.assertTrue(np.allclose(shares, [0.5, 0.75], atol=1e-9), shares)
            step = 1e-5
            self.assertAlmostEqual(fit.slope, float(fit(fit.threshold + step) - fit(fit.threshold - step)) / (2 * step), 6)

    def test_the_fit_is_the_most_likely_one(self):
        """Against 20000 points near and far."""
        draws = np.random.default_rng(3).normal(0, 1, (3, 20000)) * np.repeat([1e-3, 1.0], 10000)
        for function in ("logistic", "normal", "weibull"):
            for guess, lapse in ((0.0, 0.0), (0.0, None), (0.1, 0.03)):
                fit = lab.psychometric(LEVELS, np.maximum(YES, 5 * (guess > 0)), np.full(7, 40), function=function, guess=guess, lapse=lapse)
                best = likelihood(fit, fit.threshold, fit.width, fit.lapse)
                lapses = np.clip(fit.lapse + 0.01 * draws[2], 0.0, 0.06) if lapse is None else np.full(20000, lapse)
                self.assertLessEqual(likelihood(fit, fit.threshold + draws[0], fit.width * np.exp(draws[1]), lapses).max(), best + 1e-9)

    def test_the_logistic_without_guess_and_lapse_has_the_closed_form_of_its_scores(self):
        """At the maximum of a logistic regression, the sums of residuals, and of residuals times levels, are 0."""
        fit = lab.psychometric(LEVELS, YES, np.full(7, 40), lapse=0.0)
        residuals = YES - 40 * fit(LEVELS)
        self.assertLess(abs(residuals.sum()), 1e-4)
        self.assertLess(abs(residuals @ LEVELS), 1e-3)

    def test_threshold_width_and_deviance_are_those_of_psyphy(self):
        """psyphy 0.2-3 of R (Debian: r-cran-psyphy): glm (cbind (k, n - k) ~ x, binomial (mafc.logit (2))), and mafc.probit, mafc.weib over log (x)."""
        right = np.array([22, 24, 28, 30, 35, 38, 40])
        for function, guess, yes, told in (
                ("logistic", 0.0, YES, (9.9690506757, 1.0547274570, 0.4407702492)), ("logistic", 0.5, right, (9.664519443, 1.206292916, 1.697352519)),
                ("normal", 0.5, right, (9.642818136, 2.081579470, 1.313757795)), ("weibull", 0.5, right, (10.4292770337, 5.1303940738, 0.8716821986))):
            fit = lab.psychometric(LEVELS, yes, np.full(7, 40), function=function, guess=guess, lapse=0.0)
            self.assertTrue(np.allclose((fit.threshold, fit.width, fit.deviance), told, rtol=3e-6), (function, fit))

    def test_the_ends_of_an_interval_are_where_the_profile_has_fallen(self):
        """The profile is the largest value over many points. Constant stimuli, and a staircase, whose likelihood has several summits."""
        chosen, right, guess = answered("staircase", "logistic", 1)
        for fit in (*(lab.psychometric(LEVELS, YES, np.full(7, 40), function=function) for function in ("logistic", "normal", "weibull")),
                    lab.psychometric(chosen, right, guess=guess)):
            best = likelihood(fit, fit.threshold, fit.width, fit.lapse)
            intervals = fit.threshold_interval, fit.width_interval
            many = np.meshgrid(np.geomspace(0.2, 5.0, 801), np.linspace(0.0, 0.06, 61))
            for i, center in enumerate((fit.threshold, fit.width)):
                other = (fit.width if i == 0 else fit.threshold) * many[0]
                for end in intervals[i]:
                    at = (np.full_like(other, end), other) if i == 0 else (other, np.full_like(other, end))
                    self.assertAlmostEqual(best - likelihood(fit, *at, many[1]).max(), 0.5 * 1.959964 ** 2, delta=0.03)
                self.assertTrue(intervals[i][0] < center < intervals[i][1])

    def test_the_posterior_is_that_of_a_sum_over_many_points(self):
        levels = np.repeat(LEVELS, 6)
        yes = np.array([Draw(2, i).uniform() < p for i, p in enumerate(lab.probability("logistic", levels, 10.0, 1.0, 0.5, 0.02))], dtype=float)
        fit = lab.psychometric(levels, yes, guess=0.5, method="posterior")
        t, z, lapse = np.meshgrid(np.linspace(-10.0, 30.0, 801), np.linspace(-4.0, 4.0, 161), np.linspace(0.0, 0.06, 9), indexing="ij")
        middle = math.log((14.0 - 6.0) / 6.0)
        mass = np.exp(likelihood(fit, t, np.exp(middle + z), lapse) + 25.0 - 0.5 * z ** 2).sum(axis=(1, 2))
        below = (np.cumsum(mass) - 0.5 * mass) / mass.sum()
        for end, share in ((fit.threshold_interval.low, 0.025), (fit.threshold, 0.5), (fit.threshold_interval.high, 0.975)):
            self.assertLess(abs(np.interp(end, t[:, 0, 0], below) - share), 0.005, (end, share))

    def test_data_that_do_not_bound_it_give_infinite_intervals(self):
        flat = lab.psychometric([1, 2, 3, 4], [5, 5, 5, 5], [10] * 4)
        self.assertTrue(math.isinf(flat.threshold_interval.low) or math.isinf(flat.threshold_interval.high), flat)
        steep = lab.psychometric([1, 2, 3, 4], [0, 0, 10, 10], [10] * 4)
        self.assertEqual(steep.width_interval.low, 0.0)
        self.assertTrue(2.0 < steep.threshold < 3.0)

    def test_wrong_data_are_errors(self):
        for id, arguments, more in (("lab/shape", ([1, 2], [1]), {}), ("lab/data", ([1, 1], [0, 1]), {}), ("lab/value", ([1, 2], [0, 2]), {}),
                                    ("lab/value", ([1, math.nan], [0, 1]), {}), ("lab/value", ([-1, 2], [0, 1]), {"function": "weibull"}),
                                    ("lab/value", ([1, 2], [0, 1]), {"function": "cubic"}), ("argument/value", ([1, 2], [0, 1]), {"guess": 1.0})):
            self.fails(id, lambda: lab.psychometric(*arguments, **more))

    def test_intervals_hold_the_truth_about_as_often_as_they_say(self):
        """A few runs with fixed seeds; with the word coverage, this script makes the 2000 of docs/lab.md."""
        for method in ("constant/logistic", "constant/normal", "constant/weibull", "staircase/logistic", "detection", "power"):
            runs, least = (200, 0.8) if method.startswith("staircase") else (60, 0.88)   # docs/lab.md: staircases hold less than they say
            shares = np.mean([run(method, seed) for seed in range(runs)], axis=0)
            self.assertTrue((shares >= least).all(), (method, shares))

    def test_d_prime_criterion_and_quantiles_of_student_are_those_of_tables(self):
        found = lab.detection(69, 100, 31, 100)   # 2 z (0.6881)
        self.assertAlmostEqual(found.d_prime, 0.9811, 3)
        self.assertAlmostEqual(found.criterion, 0.0, 10)
        self.assertTrue(math.isfinite(lab.detection(100, 100, 0, 100).d_prime))
        self.assertAlmostEqual(lab.d_prime_of_two_intervals(76, 100), math.sqrt(2) * 0.6986, 2)
        self.fails("argument/value", lab.detection, 11, 10, 0, 10)
        for free, value in ((1, 12.7062), (2, 4.3027), (5, 2.5706), (30, 2.0423), (1000, 1.9623)):
            self.assertAlmostEqual(_analysis.t_quantile(free), value, 3)

    def test_a_power_law_without_noise_is_found(self):
        law = lab.power_law([1.0, 2.0, 4.0, 8.0], [3.0 * x ** 0.7 for x in (1.0, 2.0, 4.0, 8.0)])
        self.assertAlmostEqual(law.exponent, 0.7, 12)
        self.assertAlmostEqual(law.gain, 3.0, 12)
        self.fails("lab/data", lab.power_law, [1, 2, 3], [1, 0, 2])

    @unittest.skipUnless(importlib.util.find_spec("matplotlib"), "matplotlib is not installed")
    def test_plots_are_the_same_bytes_each_time(self):
        fit = lab.psychometric(LEVELS, YES, np.full(7, 40), unit="N/m")
        for name, head in (("a.svg", b"<?xml"), ("a.pdf", b"%PDF")):
            lab.save_plot(fit.plot(), self.folder / name)
            before = (self.folder / name).read_bytes()
            lab.save_plot(fit.plot(), self.folder / name)
            self.assertTrue(before.startswith(head) and before == (self.folder / name).read_bytes())
        ax = lab.plot_staircase([3.0, 2.0, 1.0, 2.0], [1, 1, 0, 1], unit="N")
        self.same_bits(ax.get_lines()[0].get_ydata(), [3.0, 2.0, 1.0, 2.0])
        self.assertIn("threshold", fit._repr_html_())


def coverage():
    """Prints how often the intervals hold the truth."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--runs", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=secrets.randbits(32))
    parser.add_argument("methods", nargs="*", default=[*(f"{p}/{f}" for p in ("constant", "staircase", "psi") for f in WIDTH), "detection", "power"])
    asked = parser.parse_args(sys.argv[2:])
    for method in asked.methods:
        shares = np.mean([run(method, asked.seed + i) for i in range(asked.runs)], axis=0)
        print(f"{method}: " + ", ".join(f"{share:.1%}" for share in shares) + f" of {asked.runs} runs, seed {asked.seed}", flush=True)


if __name__ == "__main__":
    coverage() if sys.argv[1:2] == ["coverage"] else unittest.main()
