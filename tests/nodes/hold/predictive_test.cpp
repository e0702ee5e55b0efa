// SPDX-License-Identifier: MIT
#include <tactus/nodes/hold/predictive.hpp>

#include <golden/golden.hpp>

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using tactus::Vec3;
using tactus::nodes::PredictiveHold;
using tactus::test::Golden;

namespace
{
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

PredictiveHold hold (double limit = 100.0)
{
    PredictiveHold node;
    node.params.limit = limit;
    node.prepare ({ .rate_hz = 1000.0 });
    return node;
}

double push (PredictiveHold& node, double f) { return node.tick ({ .in = { f, 0, 0 } }).out.x(); }
double push (PredictiveHold& node, double f, double contact) { return node.tick ({ .in = { f, 0, 0 }, .contact = contact }).out.x(); }
}   // namespace

TEST_CASE ("hold: it matches the golden column", "[nodes][hold][golden]")
{
    const Golden golden ("passivity");
    auto node = hold();
    CHECK (golden.worst ("f_predictive", [&] (std::size_t i) { return push (node, golden (i, "f_env")); })
           <= 1.0);
}

TEST_CASE ("hold: on a steady slope it gives the force in the middle of the sample", "[nodes][hold]")
{
    auto node = hold();
    CHECK (push (node, 1.0) == 1.0);   // there is no previous force to predict from
    for (int k = 1; k < 10; ++k)
        CHECK (push (node, 1.0 + 0.2 * k) == Approx (1.0 + 0.2 * (k + 0.5)));
}

TEST_CASE ("hold: a steady force passes bit for bit", "[nodes][hold]")
{
    tactus::test::property ("any force", [] {
        const double f = 1e-3 * *rc::gen::inRange (-50'000, 50'000);
        auto node = hold();
        for (int k = 0; k < 5; ++k)
            RC_ASSERT (push (node, f) == f);
    });
}

TEST_CASE ("hold: it stops the leak of a sampled spring", "[nodes][hold][energy]")
{
    // The hand pushes in and out along a path, whatever the force. The force is held over each sample.
    const auto absorbed = [] (bool predicts) {
        auto node = hold();
        const double sigma = 1000.0, T = 1e-3;
        double energy = 0.0, p = 0.0, held = 0.0;
        for (int k = 0; k <= 200; ++k)
        {
            const double next = 5e-3 * (1.0 - std::cos (2.0 * M_PI * 5.0 * k * T));
            energy -= held * (next - p);
            p = next;
            held = predicts ? push (node, -sigma * p) : -sigma * p;
        }
        return energy;
    };
    CHECK (absorbed (false) < -1e-3);
    CHECK (std::abs (absorbed (true)) < 1e-2 * std::abs (absorbed (false)));
}

TEST_CASE ("hold: it does not predict across a touch", "[nodes][hold]")
{
    auto node = hold();
    CHECK (push (node, 0.0, 0.0) == 0.0);
    CHECK (push (node, 1.0, 1.0) == 1.0);
    CHECK (push (node, 1.2, 1.0) == Approx (1.3));
    CHECK (push (node, 0.4, 0.0) == 0.4);   // nor across a release
    CHECK (push (node, 0.0, 0.0) == Approx (-0.2));
}

TEST_CASE ("hold: a contact that is unwired or nan changes nothing", "[nodes][hold]")
{
    auto plain = hold(), wired = hold();
    for (const double f : { 0.0, 1.0, 1.5, 0.0, 0.0, -2.0 })
        CHECK (push (plain, f) == push (wired, f, f == 1.5 ? not_a_number : 1.0));

    CHECK (push (wired, 3.0, 0.0) == 3.0);   // after the nan, a release still counts as a change
}

TEST_CASE ("hold: a force of 0 is not a change of contact", "[nodes][hold]")
{
    auto node = hold();
    push (node, 2.0, 1.0);
    CHECK (push (node, 0.0, 1.0) == Approx (-1.0));
    CHECK (push (node, 2.0, 1.0) == Approx (3.0));
}

TEST_CASE ("hold: a force beyond the limit keeps its direction", "[nodes][hold]")
{
    tactus::test::property ("any two forces", [] {
        const auto force = [] {
            const auto number = rc::gen::element (0.0, 1.0, -3.0, 40.0, -1e-9, 1e200, -1.7e308);
            const double x = *number, y = *number, z = *number;
            return Vec3 { x, y, z };
        };
        const double limit = *rc::gen::element (0.0, 0.5, 5.0, 1e10, 1e300);
        auto node = hold (limit);
        const Vec3 before = force(), now = force();
        node.tick ({ .in = before });
        const Vec3 out = node.tick ({ .in = now }).out;
        RC_ASSERT (tactus::isFinite (out));
        RC_ASSERT (out.stableNorm() <= limit * (1.0 + 1e-12));
        if (limit > 0.0) RC_ASSERT ((tactus::direction (out) - tactus::direction (0.375 * now - 0.125 * before)).norm() < 1e-9);
    });
}

TEST_CASE ("hold: after a fault there is nothing to predict from", "[nodes][hold]")
{
    for (const double bad : { not_a_number, tactus::inf, -tactus::inf })
    {
        auto node = hold();
        push (node, 1.0, 1.0);
        push (node, 2.0, 1.0);
        CHECK (push (node, bad, 1.0) == 0.0);
        CHECK (push (node, 3.0, 1.0) == 3.0);
        CHECK (push (node, 3.2, 1.0) == Approx (3.3));
    }
    auto node = hold();
    push (node, 1.0, 1.0);
    CHECK (push (node, 1.0, tactus::inf) == 0.0);
    CHECK (push (node, 2.0, 0.0) == 2.0);
}

TEST_CASE ("hold: a new instance adopts the previous force", "[nodes][hold]")
{
    auto old = hold(), next = hold();
    push (old, 1.0);
    next.adopt (old);
    CHECK (push (next, 2.0) == Approx (2.5));
}
