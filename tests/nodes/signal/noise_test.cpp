// SPDX-License-Identifier: MIT
#include <tactus/nodes/signal/noise.hpp>

#include <catch2/catch.hpp>
#include <unsupported/Eigen/FFT>

#include <cmath>
#include <complex>
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

/// Noise with a bandwidth of 250 Hz.
SignalNoise inBand (double rate_hz, double amplitude = 2.0)
{
    SignalNoise node;
    node.settings.seed = 7;
    node.params = { .amplitude = amplitude, .bandwidth = 250.0 };
    node.prepare ({ .rate_hz = rate_hz });
    node.update();
    return node;
}

std::vector<double> lasting (double seconds, double rate_hz)
{
    auto node = inBand (rate_hz);
    std::vector<double> all;
    for (int k = 0; k < static_cast<int> (seconds * rate_hz); ++k)
        all.push_back (node.tick ({}).out);
    return all;
}

/// RMS between two frequencies.
double rms (const std::vector<double>& values, double rate_hz, double from_hz, double to_hz)
{
    std::vector<std::complex<double>> bins;
    Eigen::FFT<double> {}.fwd (bins, values);
    const auto n = static_cast<double> (values.size());
    double power = 0.0;
    for (std::size_t i = 1; 2 * i < values.size(); ++i)
        if (const double f = static_cast<double> (i) * rate_hz / n; f >= from_hz && f < to_hz) power += 2.0 * std::norm (bins[i]) / (n * n);
    return std::sqrt (power);
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

TEST_CASE ("noise: without a band it is the white noise of files of version 1, number by number", "[nodes][signal]")
{
    tactus::Random random { 3 };
    for (const double v : noiseOf (3, 1000, 2.0))
        REQUIRE (v == 2.0 * random.normal());
}

TEST_CASE ("noise: in a band it is the same function of time at every rate of at least twice the band", "[nodes][signal]")
{
    const auto fast = lasting (20.0, 20000.0);
    for (const std::size_t every : { 5U, 20U, 40U })
    {
        const auto slow = lasting (20.0, 20000.0 / static_cast<double> (every));
        for (std::size_t k = 0; k < slow.size(); ++k)
            REQUIRE (slow[k] == Approx (fast[every * k]).margin (1e-8));
    }
}

TEST_CASE ("noise: its RMS lies within the band and is the amplitude, at 1, 4 and 20 kHz", "[nodes][signal]")
{
    // The spectrum is 225 Hz wide, so 100 s contain 45000 independent numbers: the standard error of the RMS is 0.33 %.
    constexpr double five_errors = 0.017;
    for (const double rate : { 1000.0, 4000.0, 20000.0 })
    {
        const auto x = lasting (100.0, rate);
        CHECK (rms (x, rate, 0.0, 250.0) == Approx (2.0).epsilon (five_errors));
        CHECK (rms (x, rate, 250.0, 0.5 * rate) < 5e-3 * 2.0);
        CHECK (rms (x, rate, 0.0, 100.0) == Approx (rms (x, rate, 100.0, 200.0)).epsilon (0.04));   // flat; 20000 independent numbers in each half
        CHECK (rms (x, rate, 0.0, 200.0) == Approx (2.0 * std::sqrt (200.0 / 225.0)).epsilon (0.02));
    }
}

TEST_CASE ("noise: its first second is as loud as any other", "[nodes][signal]")
{
    double squares = 0.0;
    for (int seed = 0; seed < 4000; ++seed)
    {
        auto node = inBand (1000.0);
        node.settings.seed = seed;
        node.prepare ({ .rate_hz = 1000.0 });
        squares += std::pow (node.tick ({}).out / 2.0, 2);
    }
    CHECK (squares / 4000.0 == Approx (1.0).epsilon (5.0 * std::sqrt (2.0 / 4000.0)));
}

TEST_CASE ("noise: if the rate is too low for the band, the part below half the rate is left, and a warning says so", "[nodes][signal]")
{
    const auto x = lasting (100.0, 300.0);
    double squares = 0.0;
    for (const double v : x)
        squares += v * v;
    CHECK (std::sqrt (squares / static_cast<double> (x.size())) == Approx (2.0 * std::sqrt (150.0 / 250.0)).epsilon (0.03));
    CHECK (inBand (500.0).warning ({ .rate_hz = 500.0 }).empty());
    CHECK (inBand (300.0).warning ({ .rate_hz = 300.0 }).find ("500 Hz") != std::string::npos);
}

TEST_CASE ("noise: its claimed amplitude holds while the bandwidth changes", "[nodes][signal]")
{
    auto node = inBand (1000.0);
    for (int k = 0; k < 20000; ++k)
    {
        node.params.bandwidth = k % 500 == 0 ? 0.0 : 1.0 + 0.1 * k;
        node.update();
        REQUIRE (std::abs (node.tick ({}).out) <= inBand (1000.0).claims().amplitude);
    }
}
