// SPDX-License-Identifier: MIT
#include "response.hpp"

#include <nodes/filter/one_pole.hpp>

#include <catch2/catch.hpp>
#include <rapidcheck/catch.h>

#include <limits>

using tactus::nodes::OnePole;

namespace
{
OnePole filterOf (double cutoff, double rate_hz = 1000.0)
{
    OnePole node;
    node.params.cutoff = cutoff;
    node.prepare ({ .rate_hz = rate_hz });
    node.update();
    return node;
}
}   // namespace

TEST_CASE ("one-pole: its response is that of the analogue filter, bilinear", "[nodes][filter]")
{
    rc::prop ("any cutoff and frequency", []
              {
        const double cutoff = *rc::gen::inRange (5, 495) / 1000.0, turns = *rc::gen::inRange (0, 500) / 1000.0;
        const auto s = bilinear (turns, cutoff);
        const auto wanted = 1.0 / (1.0 + s);
        RC_ASSERT (std::abs (Response { filterOf (1000.0 * cutoff) }(turns) - wanted) < 1e-9); });
}

TEST_CASE ("one-pole: is 3 dB down at the cutoff, passes rest whole and nothing at half the rate", "[nodes][filter]")
{
    const double cutoff = GENERATE (5.0, 100.0, 250.0, 480.0);
    const Response response { filterOf (cutoff) };
    CHECK (std::norm (response (cutoff / 1000.0)) == Approx (0.5));
    CHECK (std::abs (response (0.0)) == Approx (1.0));
    CHECK (std::abs (response (0.5)) < 1e-9);
}

TEST_CASE ("one-pole: is stable at any cutoff, also beyond half the rate", "[nodes][filter]")
{
    const double cutoff = GENERATE (0.0, 1e-9, 1.0, 499.9, 500.0, 501.0, 1e6, 1e300);
    auto node = filterOf (cutoff);
    double out = 0.0;
    for (int k = 0; k < 100'000; ++k)
    {
        out = node.tick ({ .in = k % 3 == 0 ? 1.0 : -0.5 }).out;
        REQUIRE (std::abs (out) <= 2.0);
    }
    if (cutoff >= 500.0)
        for (int k = 0; k < 30'000; ++k)
            out = node.tick ({ .in = 1.0 }).out;
    if (cutoff >= 500.0) CHECK (out == Approx (1.0));
}

TEST_CASE ("one-pole: starts from rest after a sample that is no number", "[nodes][filter]")
{
    auto used = filterOf (50.0), fresh = filterOf (50.0);
    for (int k = 0; k < 10; ++k)
        used.tick ({ .in = 1.0 });
    CHECK (used.tick ({ .in = std::numeric_limits<double>::quiet_NaN() }).out == 0.0);
    for (int k = 0; k < 10; ++k)
        CHECK (used.tick ({ .in = 2.0 }).out == fresh.tick ({ .in = 2.0 }).out);
}

TEST_CASE ("one-pole: a step is approached without overshoot", "[nodes][filter]")
{
    auto node = filterOf (20.0);
    double before = 0.0;
    for (int k = 0; k < 200; ++k)
    {
        const double out = node.tick ({ .in = 1.0 }).out;
        CHECK (out >= before);
        CHECK (out <= 1.0 + 1e-12);
        before = out;
    }
}
