// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/fit/fit_report.hpp>
#include <tactus/kit/random.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace tactus::test
{

/// Adds white noise that is 20 dB below the signal.
inline void addNoise (std::vector<double>& signal, Random& random)
{
    double squares = 0.0;
    for (const double v : signal)
        squares += v * v;
    const double deviation = 0.1 * std::sqrt (squares / static_cast<double> (signal.size()));
    for (double& v : signal)
        v += deviation * random.normal();
}

inline double between (Random& random, double low, double high) { return low + (high - low) * random.uniform(); }

/// Counts how often the intervals of parameters contain the truth, and how far the values are off.
class Draws
{
public:
    void add (const std::string& name, const FitValue& v, double truth)
    {
        auto& t = tallies[name];
        ++t.draws;
        if (v.low <= truth && truth <= v.high) ++t.covered;
        const double off = v.value / truth - 1.0;
        t.squares += off * off;
    }

    /// Of 300 draws, 95 +- 4 % of the intervals must contain the truth. The root mean square error of the values must be at most `error`. With
    /// fewer draws, chance has a larger effect: the first limit is wider, and the second one is higher by three standard deviations.
    void check (const std::string& name, double error, int draws)
    {
        const auto& t = tallies[name];
        const double margin = 4.0 * std::sqrt (300.0 / draws), covered = 100.0 * t.covered / t.draws, off = std::sqrt (t.squares / t.draws);
        const double chance = draws < 300 ? 3.0 / std::sqrt (2.0 * draws) : 0.0;
        CAPTURE (name, t.draws, covered, off);
        CHECK (t.draws >= 0.97 * draws);
        CHECK (covered >= 95.0 - margin);
        CHECK (covered <= 95.0 + margin);
        CHECK (off <= (1.0 + chance) * error);
    }

private:
    struct Tally
    {
        int draws = 0, covered = 0;
        double squares = 0.0;
    };
    std::map<std::string, Tally> tallies;
};

}   // namespace tactus::test
