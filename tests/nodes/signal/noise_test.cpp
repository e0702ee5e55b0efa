// SPDX-License-Identifier: MIT
#include <tactus/nodes/signal/noise.hpp>

#include <catch2/catch.hpp>

#include <vector>

using tactus::nodes::SignalNoise;

namespace
{
std::vector<double> noiseOf (int seed, int n, double amplitude = 1.0)
{
    SignalNoise node;
    node.settings.seed = seed;
    node.params.amplitude = amplitude;
    node.prepare ({});
    std::vector<double> all;
    for (int k = 0; k < n; ++k)
        all.push_back (node.tick ({}).out);
    return all;
}
}   // namespace

TEST_CASE ("noise: is Gaussian with its amplitude as standard deviation", "[nodes][signal]")
{
    const int seed = GENERATE (0, 1, 2, 12345);
    constexpr int n = 1'000'000;
    const auto x = noiseOf (seed, n, 3.0);

    double sum = 0.0, squares = 0.0, fourths = 0.0, neighbours = 0.0;
    int beyond_two = 0;
    for (int k = 0; k < n; ++k)
    {
        const double v = x[static_cast<std::size_t> (k)] / 3.0;
        sum += v;
        squares += v * v;
        fourths += v * v * v * v;
        if (std::abs (v) > 2.0) ++beyond_two;
        if (k > 0) neighbours += v * x[static_cast<std::size_t> (k - 1)] / 3.0;
    }
    // five standard errors
    CHECK (std::abs (sum / n) < 5e-3);
    CHECK (std::abs (squares / n - 1.0) < 5e-3 * std::sqrt (2.0));
    CHECK (std::abs (fourths / n - 3.0) < 5e-3 * std::sqrt (96.0));
    CHECK (std::abs (neighbours / n) < 5e-3);
    CHECK (std::abs (beyond_two / double { n } - 0.0455) < 5e-3 * 0.21);
}

TEST_CASE ("noise: the same seed gives the same noise, a different seed gives different noise", "[nodes][signal]")
{
    CHECK (noiseOf (1, 1000) == noiseOf (1, 1000));
    CHECK (noiseOf (1, 1000) != noiseOf (2, 1000));
}
