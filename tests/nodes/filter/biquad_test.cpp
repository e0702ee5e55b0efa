// SPDX-License-Identifier: MIT
#include "response.hpp"

#include <tactus/nodes/filter/biquad.hpp>

#include <support/property.hpp>
#include <support/ready.hpp>

#include <catch2/catch.hpp>

#include <numbers>
#include <random>

using tactus::nodes::BiquadFilter;
using tactus::test::ready;
using Kind = BiquadFilter::Kind;

namespace
{
constexpr Kind kinds[] { Kind::low, Kind::high, Kind::band, Kind::notch, Kind::peak, Kind::low_shelf, Kind::high_shelf };

/// The analogue prototypes of the cookbook.
std::complex<double> prototype (const BiquadFilter::Params& p, std::complex<double> s)
{
    const double q = p.q, a = std::pow (10.0, p.gain_db / 40.0), r = std::sqrt (a) / q;
    switch (p.kind)
    {
    case Kind::low:
        return 1.0 / (s * s + s / q + 1.0);
    case Kind::high:
        return s * s / (s * s + s / q + 1.0);
    case Kind::band:
        return s / q / (s * s + s / q + 1.0);
    case Kind::notch:
        return (s * s + 1.0) / (s * s + s / q + 1.0);
    case Kind::peak:
        return (s * s + s * a / q + 1.0) / (s * s + s / (a * q) + 1.0);
    case Kind::low_shelf:
        return a * (s * s + r * s + a) / (a * s * s + r * s + 1.0);
    case Kind::high_shelf:
        return a * (a * s * s + r * s + 1.0) / (s * s + r * s + a);
    }
    return 0.0;
}
}   // namespace

TEST_CASE ("biquad: every kind has the response of its prototype in the cookbook", "[nodes][filter]")
{
    tactus::test::property ("any kind, cutoff, q, gain and frequency", [] {
        const BiquadFilter::Params params {
            .cutoff = static_cast<double> (*rc::gen::inRange (10, 490)),
            .q = *rc::gen::inRange (30, 500) / 100.0,
            .gain_db = static_cast<double> (*rc::gen::inRange (-24, 25)),
            .kind = *rc::gen::elementOf (std::vector<Kind> (std::begin (kinds), std::end (kinds))),
        };
        const double turns = *rc::gen::inRange (0, 500) / 1000.0;
        const auto wanted = prototype (params, bilinear (turns, params.cutoff / 1000.0));
        RC_ASSERT (std::abs (Response { ready<BiquadFilter> (params) }(turns)-wanted) < 1e-8 * (1.0 + std::abs (wanted)));
    });
}

TEST_CASE ("biquad: peak and shelves do nothing at 0 dB", "[nodes][filter]")
{
    const auto kind = GENERATE (Kind::peak, Kind::low_shelf, Kind::high_shelf);
    auto node = ready<BiquadFilter> ({ .kind = kind });
    for (int k = 0; k < 100; ++k)
        CHECK (node.tick ({ .in = std::sin (0.7 * k) }).out == Approx (std::sin (0.7 * k)).margin (1e-12));
}

TEST_CASE ("biquad: the notch removes its centre, and the band passes it unchanged", "[nodes][filter]")
{
    const double cutoff = GENERATE (20.0, 100.0, 400.0);
    CHECK (std::abs (Response { ready<BiquadFilter> ({ .cutoff = cutoff, .kind = Kind::notch }) }(cutoff / 1000.0)) < 1e-9);
    CHECK (std::abs (Response { ready<BiquadFilter> ({ .cutoff = cutoff, .kind = Kind::band }) }(cutoff / 1000.0)) == Approx (1.0));
}

TEST_CASE ("biquad: is stable at any cutoff and q", "[nodes][filter]")
{
    const auto kind = GENERATE (from_range (std::begin (kinds), std::end (kinds)));
    const double cutoff = GENERATE (0.0, 0.001, 100.0, 499.0, 500.0, 1e9);
    const double q = GENERATE (1e-3, 0.7071, 1e3);
    const double gain_db = GENERATE (-24.0, 0.0, 24.0);
    auto node = ready<BiquadFilter> ({ .cutoff = cutoff, .q = q, .gain_db = gain_db, .kind = kind });

    // an impulse may ring for long, but the output of a stable filter never grows beyond its first moments
    double early = 1.0, late = 0.0;
    for (int k = 0; k < 20'000; ++k)
    {
        const double out = std::abs (node.tick ({ .in = k == 0 ? 1.0 : 0.0 }).out);
        REQUIRE (std::isfinite (out));
        (k < 10'000 ? early : late) = std::max (k < 10'000 ? early : late, out);
    }
    INFO (static_cast<int> (kind) << ' ' << cutoff << ' ' << q << ' ' << gain_db);
    CHECK (late <= early);
}

namespace
{
/// The recursion of the cookbook, which the node had before, in transposed direct form II.
class CookbookLow
{
public:
    CookbookLow (double cutoff, double rate, double q)
    {
        const double w = 2.0 * std::numbers::pi * cutoff / rate, alpha = std::sin (w) / (2.0 * q), a0 = 1.0 + alpha;
        b0 = 0.5 * (1.0 - std::cos (w)) / a0;
        a1 = -2.0 * std::cos (w) / a0;
        a2 = (1.0 - alpha) / a0;
    }

    double operator() (double x)
    {
        const double y = b0 * x + s1;
        s1 = 2.0 * b0 * x - a1 * y + s2;
        s2 = b0 * x - a2 * y;
        return y;
    }

private:
    double b0, a1, a2, s1 = 0.0, s2 = 0.0;
};
}   // namespace

TEST_CASE ("biquad: while its params stand still, it gives what the cookbook's recursion gives", "[nodes][filter]")
{
    const double cutoff = GENERATE (1.0, 20.0, 100.0, 450.0);
    const double q = GENERATE (0.3, 0.7071, 5.0);
    auto node = ready<BiquadFilter> ({ .cutoff = cutoff, .q = q });
    CookbookLow cookbook (cutoff, 1000.0, q);
    std::mt19937 random (1);
    for (int k = 0; k < 5000; ++k)
    {
        const double x = std::uniform_real_distribution { -1.0, 1.0 }(random);
        REQUIRE (node.tick ({ .in = x }).out == Approx (cookbook (x)).margin (1e-11));
    }
}

TEST_CASE ("biquad: a cutoff on a square wave does not make it grow", "[nodes][filter]")
{
    // Noise of rms 1 through filters without a source of energy. In direct form, they reached 1e308 and 1e96.
    struct Case
    {
        Kind kind;
        double q, low, high;
        int half_period;
    };
    const auto c = GENERATE (Case { Kind::low, 0.7071, 20.0, 450.0, 5 }, Case { Kind::high, 0.7071, 20.0, 450.0, 5 }, Case { Kind::band, 5.0, 1.0, 450.0, 50 });
    auto node = ready<BiquadFilter> ({ .q = c.q, .kind = c.kind });
    std::mt19937 random (1);
    std::normal_distribution noise { 0.0, 1.0 };
    double most = 0.0;
    for (int k = 0; k < 10'000; ++k)
    {
        node.params.cutoff = (k / c.half_period) % 2 == 0 ? c.low : c.high;
        node.update();
        most = std::max (most, std::abs (node.tick ({ .in = noise (random) }).out));
    }
    CHECK (most > 0.5);   // the band at 450 Hz lets little noise through
    CHECK (most < 8.0);
}
