// SPDX-License-Identifier: MIT
#include <tactus/nodes/signal/envelope.hpp>

#include <support/property.hpp>
#include <support/ready.hpp>

#include <catch2/catch.hpp>

using tactus::nodes::SignalEnvelope;
using tactus::test::ready;

namespace
{
double after (SignalEnvelope& node, int ticks, double gate)
{
    double out = 0.0;
    for (int k = 0; k < ticks; ++k)
        out = node.tick ({ .gate = gate }).out;
    return out;
}
}   // namespace

TEST_CASE ("envelope: each segment takes its set time", "[nodes][signal]")
{
    auto node = ready<SignalEnvelope> ({ .attack = 0.01, .decay = 0.02, .sustain = 0.5, .release = 0.04 });

    CHECK (after (node, 100, 0.0) == 0.0);
    CHECK (after (node, 1, 1.0) == Approx (0.1));
    CHECK (after (node, 4, 1.0) == Approx (0.5));
    CHECK (after (node, 5, 1.0) == 1.0);
    CHECK (after (node, 10, 1.0) == Approx (0.75));
    CHECK (after (node, 10, 1.0) == 0.5);
    CHECK (after (node, 1000, 1.0) == 0.5);
    CHECK (after (node, 20, 0.0) == Approx (0.25));
    CHECK (after (node, 20, 0.0) == 0.0);
}

TEST_CASE ("envelope: a gate that reopens continues from the current level", "[nodes][signal]")
{
    auto node = ready<SignalEnvelope> ({ .attack = 0.01, .release = 0.1 });
    after (node, 20, 1.0);
    CHECK (after (node, 50, 0.0) == Approx (0.5));
    CHECK (after (node, 1, 1.0) == Approx (0.6));
}

TEST_CASE ("envelope: released during the attack, it falls from its level in the same time", "[nodes][signal]")
{
    auto node = ready<SignalEnvelope> ({ .attack = 0.1, .release = 0.1 });
    CHECK (after (node, 50, 1.0) == Approx (0.5));
    CHECK (after (node, 50, 0.0) == Approx (0.25));
    CHECK (after (node, 50, 0.0) == 0.0);
}

TEST_CASE ("envelope: times of 0 make it the gate itself", "[nodes][signal]")
{
    auto node = ready<SignalEnvelope> ({ .attack = 0.0, .decay = 0.0, .sustain = 1.0, .release = 0.0 });
    for (const double gate : { 0.0, 1.0, 1.0, 0.0, 1.0, 0.0, 0.0 })
        CHECK (node.tick ({ .gate = gate }).out == gate);
}

TEST_CASE ("envelope: stays within 0 to 1 and never steps further than its fastest segment", "[nodes][signal]")
{
    tactus::test::property ("random gates", [] (const std::vector<bool>& gates) {
        auto node = ready<SignalEnvelope> ({ .attack = 0.004, .decay = 0.003, .sustain = 0.3, .release = 0.005 });
        double before = 0.0;
        for (const bool gate : gates)
            for (int k = 0; k < 2; ++k)
            {
                const double out = node.tick ({ .gate = gate ? 1.0 : 0.0 }).out;
                RC_ASSERT (out >= 0.0 && out <= 1.0);
                RC_ASSERT (std::abs (out - before) <= 0.25 + 1e-9);
                before = out;
            }
    });
}
