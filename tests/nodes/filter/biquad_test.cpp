// SPDX-License-Identifier: MIT
#include "response.hpp"

#include <tactus/nodes/filter/biquad.hpp>

#include <support/property.hpp>
#include <support/ready.hpp>

#include <catch2/catch.hpp>

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
