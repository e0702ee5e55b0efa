// SPDX-License-Identifier: MIT
#include <tactus/nodes/signal/crossfade.hpp>

#include <support/property.hpp>

#include <catch2/catch.hpp>

using tactus::nodes::SignalCrossfade;

TEST_CASE ("crossfade: is a at 0 and b at 1, bit for bit", "[nodes][signal]")
{
    tactus::test::property ("any two signals", [] {
        const auto [a, b] = *rc::gen::pair (rc::gen::arbitrary<int>(), rc::gen::arbitrary<int>());
        RC_ASSERT (SignalCrossfade { .params = { .amount = 0.0 } }.tick ({ .a = a / 7.0, .b = b / 7.0 }).out == a / 7.0);
        RC_ASSERT (SignalCrossfade { .params = { .amount = 1.0 } }.tick ({ .a = a / 7.0, .b = b / 7.0 }).out == b / 7.0);
    });
}

TEST_CASE ("crossfade: equal signals pass at any amount", "[nodes][signal]")
{
    const double amount = GENERATE (0.1, 0.25, 0.5, 0.9);
    CHECK (SignalCrossfade { .params = { .amount = amount } }.tick ({ .a = 3.0, .b = 3.0 }).out == Approx (3.0));
}

TEST_CASE ("crossfade: a nan signal is not hidden by amount 0", "[nodes][signal]")
{
    CHECK (SignalCrossfade {}.tick ({ .a = 3.0, .b = tactus::inf }).out == 0.0);
}
