// SPDX-License-Identifier: MIT
#include <tactus/nodes/signal/trigger.hpp>

#include <support/property.hpp>

#include <catch2/catch.hpp>

using tactus::nodes::SignalTrigger;

TEST_CASE ("trigger: hits once when the signal rises, and again after it has fallen", "[nodes][signal]")
{
    SignalTrigger node;
    node.params = { .threshold = 0.5, .speed = 2.0 };
    CHECK (node.tick ({ .in = 0.0 }).hit == 0.0);
    CHECK (node.tick ({ .in = 0.5 }).hit == 0.0);
    CHECK (node.tick ({ .in = 0.6 }).hit == 2.0);
    CHECK (node.tick ({ .in = 0.7 }).hit == 0.0);
    CHECK (node.tick ({ .in = 0.7 }).gate == 1.0);
    CHECK (node.tick ({ .in = 0.5 }).gate == 0.0);
    CHECK (node.tick ({ .in = 0.6 }).hit == 2.0);
}

TEST_CASE ("trigger: a gate of 0 and 1 works by default", "[nodes][signal]")
{
    SignalTrigger node;
    double hits = 0.0;
    for (const double in : { 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0 })
        hits += node.tick ({ .in = in }).hit;
    CHECK (hits == 2.0);
}

TEST_CASE ("trigger: noise narrower than the hysteresis makes no second hit", "[nodes][signal]")
{
    tactus::test::property ("any jitter", [] (const std::vector<signed char>& jitter) {
        SignalTrigger node;
        node.params = { .threshold = 1.0, .hysteresis = 0.3 };
        node.tick ({ .in = 0.0 });
        RC_ASSERT (node.tick ({ .in = 1.2 }).hit == 1.0);
        for (const auto j : jitter)
        {
            const auto out = node.tick ({ .in = 1.0 + j / 128.0 * 0.149 });
            RC_ASSERT (out.hit == 0.0);
            RC_ASSERT (out.gate == 1.0);
        }
    });
}

TEST_CASE ("trigger: a signal that is high from the start triggers no hit", "[nodes][signal]")
{
    SignalTrigger node;
    const auto first = node.tick ({ .in = 1.0 });
    CHECK (first.hit == 0.0);
    CHECK (first.gate == 1.0);

    CHECK (node.tick ({ .in = tactus::inf }).gate == 0.0);
    CHECK (node.tick ({ .in = 1.0 }).hit == 0.0);
    node.tick ({ .in = 0.0 });
    CHECK (node.tick ({ .in = 1.0 }).hit == 1.0);
}

TEST_CASE ("trigger: the gate stays open for the time of hold, at any rate", "[nodes][signal]")
{
    for (const double rate : { 1000.0, 4000.0, 20000.0 })
    {
        SignalTrigger node;
        node.params = { .threshold = 0.5, .hold = 0.02 };
        node.prepare ({ .rate_hz = rate });
        node.tick ({ .in = 0.0 });
        CHECK (node.tick ({ .in = 1.0 }).hit == 1.0);
        int ticks = 0;
        while (node.tick ({ .in = 0.0 }).gate == 1.0)
            ++ticks;
        CHECK (ticks / rate == Approx (0.02).margin (1e-9));
        CHECK (node.tick ({ .in = 1.0 }).hit == 1.0);
    }
}

TEST_CASE ("trigger: pulses closer than hold keep the gate open and make one hit", "[nodes][signal]")
{
    for (const double rate : { 1000.0, 4000.0, 20000.0 })
    {
        SignalTrigger node;
        node.params = { .threshold = 3.5, .hold = 0.02 };
        node.prepare ({ .rate_hz = rate });
        node.tick ({ .in = 3.0 });
        double hits = 0.0;
        for (int k = 0; k < static_cast<int> (0.5 * rate); ++k)   // a slow blade: its encoder steps every 15 ms
        {
            const auto out = node.tick ({ .in = k % static_cast<int> (0.015 * rate) == 0 ? 4.0 : 3.0 });
            REQUIRE (out.gate == 1.0);
            hits += out.hit;
        }
        CHECK (hits == 1.0);
    }
}
