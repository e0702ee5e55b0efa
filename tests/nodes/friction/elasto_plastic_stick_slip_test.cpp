// SPDX-License-Identifier: MIT
#include <tactus/nodes/friction/elasto_plastic.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using tactus::nodes::ElastoPlastic;

namespace
{
constexpr double d_max = 1e-4, ratio = 2.5, gap = (ratio - 1.0) * d_max, mu = 0.4;
constexpr double collapse = 0.5 * (mu / d_max) * (ratio * ratio - 1.0) * d_max * d_max;   // J, lost in each slip at 1 N

/// A contact with stick-slip under 1 N, dragged along x.
struct Rub
{
    Rub()
    {
        node.params = { .mu = mu, .d_max = d_max, .static_ratio = ratio };
        to (0.0);
    }

    void to (double x)
    {
        out = node.tick ({ .position = { x, 0, 0 } });
        p = x;
        if (out.state == 2.0) ++seen;
        pull -= out.force.x();
        ++ticks;
    }

    double slips() const { return out.dissipated_energy / collapse; }   // computed from the dissipated energy

    ElastoPlastic node;
    ElastoPlastic::Outputs out;
    double p = 0.0, pull = 0.0;   // m; N, the drag summed over all ticks
    int seen = 0, ticks = 0;
};
}   // namespace

TEST_CASE ("friction: stick and slip alternate with the period d_stick - d_max", "[nodes][friction]")
{
    Rub rub;
    double first = 0.0, last = 0.0, highest = 0.0;
    for (int k = 0; k < 100'000; ++k)
    {
        const int before = rub.seen;
        rub.to (rub.p + 1e-3 * d_max);
        highest = std::max (highest, -rub.out.force.x());
        if (rub.seen == before) continue;
        CHECK (-rub.out.force.x() == Approx (mu).epsilon (1.1e-3));
        (before == 0 ? first : last) = rub.p;
    }

    CHECK ((last - first) / (rub.seen - 1) == Approx (gap).epsilon (1e-3));
    CHECK (highest == Approx (ratio * mu).epsilon (1e-3));
}

TEST_CASE ("friction: a step that passes several slips leaves the stretch and the heat of a slow hand", "[nodes][friction]")
{
    std::mt19937 random (1);
    std::uniform_real_distribution<double> any (0.0, 40.0 * d_max);
    for (int k = 0; k < 200; ++k)
    {
        const double x = any (random), beyond = x - ratio * d_max;
        const double slips = beyond > 0.0 ? std::floor (beyond / gap) + 1.0 : 0.0;
        Rub rub;
        rub.to (x);
        INFO (x);
        CHECK (rub.out.deflection.x() == Approx (beyond > 0.0 ? d_max + beyond - (slips - 1.0) * gap : x));
        CHECK (rub.slips() == Approx (slips).margin (1e-9));
        CHECK (rub.out.state == (slips > 0.0 ? 2.0 : 1.0));
    }
}

TEST_CASE ("friction: slips per millimetre, drag and heat of stick-slip do not depend on speed and rate", "[nodes][friction]")
{
    // The hand's speed varies by 20 % from sample to sample, so that the samples do not always meet the same part of a tooth.
    for (const double rate : { 1000.0, 4000.0, 20'000.0 })
        for (const double speed : { 2e-3, 5e-3, 20e-3, 50e-3, 100e-3, 200e-3, 500e-3 })
        {
            std::mt19937 random (1);
            std::uniform_real_distribution<double> varied (0.8, 1.2);
            const double step = speed / rate, length = std::max (40e-3, 20'000 * step);
            Rub rub;
            while (rub.p < length)
                rub.to (rub.p + step * varied (random));

            INFO (rate << " Hz, " << speed << " m/s");
            CHECK (rub.slips() / rub.p == Approx (1.0 / gap).epsilon (0.01));
            if (gap >= 4.0 * 1.2 * step) CHECK (rub.seen == Approx (rub.slips()));
            CHECK (rub.pull / rub.ticks == Approx (0.5 * (1.0 + ratio) * mu).epsilon (0.02));
            CHECK (rub.out.dissipated_energy / rub.p == Approx (collapse / gap).epsilon (0.02));
        }
}
