// SPDX-License-Identifier: MIT
#include <tactus/nodes/signal/slew.hpp>

#include <support/property.hpp>

#include <catch2/catch.hpp>

using tactus::nodes::SignalSlew;

namespace
{
SignalSlew slewOf (double rate)
{
    SignalSlew node;
    node.params.rate = rate;
    node.prepare ({ .rate_hz = 1000.0 });
    return node;
}
}   // namespace

TEST_CASE ("slew: a step becomes a ramp of the given rate, up and down", "[nodes][signal]")
{
    auto node = slewOf (100.0);   // 0.1 per tick
    node.tick ({ .in = 0.0 });
    for (int k = 1; k <= 9; ++k)
        CHECK (node.tick ({ .in = 1.0 }).out == Approx (0.1 * k));
    node.tick ({ .in = 1.0 });
    CHECK (node.tick ({ .in = 1.0 }).out == 1.0);
    CHECK (node.tick ({ .in = -5.0 }).out == Approx (0.9));
}

TEST_CASE ("slew: starts at the first sample, and again after a nan", "[nodes][signal]")
{
    auto node = slewOf (1.0);
    CHECK (node.tick ({ .in = 7.0 }).out == 7.0);
    CHECK (node.tick ({ .in = tactus::inf }).out == 0.0);
    CHECK (node.tick ({ .in = -3.0 }).out == -3.0);
}

TEST_CASE ("slew: never changes faster than its rate", "[nodes][signal]")
{
    tactus::test::property ("any signal", [] (const std::vector<short>& signal, unsigned short rate) {
        auto node = slewOf (rate);
        double before = node.tick ({ .in = 0.0 }).out;
        for (const short s : signal)
        {
            const double out = node.tick ({ .in = s / 1000.0 }).out;
            RC_ASSERT (std::abs (out - before) <= rate / 1000.0 * (1.0 + 1e-12));
            before = out;
        }
    });
}

TEST_CASE ("slew: a slower signal passes bit for bit", "[nodes][signal]")
{
    auto node = slewOf (100.0);
    for (int k = 0; k < 1000; ++k)
    {
        const double in = std::sin (0.09 * k);
        REQUIRE (node.tick ({ .in = in }).out == in);
    }
}
