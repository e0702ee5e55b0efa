// SPDX-License-Identifier: MIT
#include <tactus/nodes/contact/impact.hpp>

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <random>
#include <vector>

using tactus::nodes::Impact;

namespace
{
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

Impact impact (const Impact::Params& params = {}, double rate_hz = 1000.0)
{
    Impact node;
    node.params = params;
    node.prepare ({ .rate_hz = rate_hz });
    return node;
}

double quantised (double x, double quantum) { return quantum > 0.0 ? quantum * std::floor (x / quantum + 0.5) : x; }

struct Strike
{
    int hits = 0;
    double speed = 0.0;
};

/// The number of hits for depths depth (0), depth (1), …, and the speed of the last hit.
template <typename Depth>
Strike strike (Impact node, int ticks, Depth depth)
{
    Strike s;
    for (int k = 0; k < ticks; ++k)
        if (const auto out = node.tick ({ .depth = depth (k) }); out.hit != 0.0)
        {
            CHECK (out.contact == 1.0);
            ++s.hits;
            s.speed = out.hit;
        }
    return s;
}
}   // namespace

TEST_CASE ("impact: a steady approach gives one hit with exactly its speed, at any rate", "[nodes][contact]")
{
    for (const double rate : { 500.0, 1000.0, 4000.0, 10'000.0 })
        for (const double v : { 1e-3, 0.05, 2.0 })
        {
            const auto [hits, speed] = strike (impact ({}, rate), 3000, [&] (int k) { return v * (k - 1000.3) / rate; });
            CHECK (hits == 1);
            CHECK (speed == Approx (v).epsilon (1e-9));
        }
}

TEST_CASE ("impact: a quantised ramp gives one hit, with the speed within the bound of the quantum", "[nodes][contact]")
{
    const double q = 1e-5, T = 1e-3;
    std::mt19937 random (3);
    std::uniform_real_distribution<double> uniform;
    double worst_fast = 0.0, worst_slow = 0.0;
    for (int trial = 0; trial < 2000; ++trial)
    {
        const double v = 0.005 * std::pow (200.0, uniform (random)), start = -0.05 - q * uniform (random);
        const auto [hits, speed] = strike (impact(), int (0.06 / (v * T)), [&] (int k) { return quantised (start + v * T * k, q); });
        REQUIRE (hits == 1);
        (v > 0.03 ? worst_fast : worst_slow) = std::max (v > 0.03 ? worst_fast : worst_slow, std::abs (speed / v - 1.0));
        REQUIRE (std::abs (speed - v) <= 2.0 * q / (16.0 * T) + 1e-12);
    }
    CHECK (worst_fast < 0.03);
    CHECK (worst_slow < 0.15);
}

TEST_CASE ("impact: a slow approach seen by a coarse encoder has its speed within 5 % at every rate, and one hit", "[nodes][contact]")
{
    std::mt19937 random (5);
    std::uniform_real_distribution<double> uniform;
    for (const double rate : { 1000.0, 2500.0, 4000.0, 10'000.0, 20'000.0 })
        for (const double quantum : { 0.0, 1e-6, 7e-6, 2e-5, 5e-5 })
            for (const double v : { 0.005, 0.02, 0.1, 0.5 })
                for (int trial = 0; trial < 20; ++trial)
                {
                    // The surface lies anywhere between two steps of the encoder.
                    const double surface = 5e-5 * uniform (random), start = -0.1 * v * (2.0 + uniform (random));
                    const auto depth = [&] (int k) { return quantised (start + v * k / rate + surface, quantum) - surface; };
                    const auto [hits, speed] = strike (impact ({}, rate), static_cast<int> (0.4 * rate), depth);
                    INFO (rate << " Hz, quantum " << quantum << ", " << v << " m/s");
                    REQUIRE (hits == 1);
                    REQUIRE (speed == Approx (v).epsilon (0.05));
                }
}

TEST_CASE ("impact: an encoder that flickers by one quantum at each step changes the speed by no more than the header says", "[nodes][contact]")
{
    std::mt19937 random (9);
    std::uniform_real_distribution<double> uniform;
    std::normal_distribution<double> gauss;
    for (const double rate : { 1000.0, 4000.0, 20'000.0 })
        for (const double quantum : { 5e-6, 2e-5, 5e-5 })
            for (const double v : { 0.005, 0.02, 0.1 })
                for (const double width : { 0.02, 0.04, 0.1 })   // rms of the jitter before rounding, in quanta
                    for (int trial = 0; trial < 30; ++trial)
                    {
                        const double surface = quantum * uniform (random), start = -0.1 * v * (2.0 + uniform (random));
                        const auto depth = [&] (int k) {
                            const double jitter = width * quantum * gauss (random);
                            return quantised (start + v * k / rate + surface + jitter, quantum) - surface;
                        };
                        const auto [hits, speed] = strike (impact ({}, rate), static_cast<int> (0.4 * rate), depth);
                        const double error = width < 0.03 ? 0.05 : width < 0.05 ? 0.07
                                                                                : 0.12;
                        INFO (rate << " Hz, quantum " << quantum << ", " << v << " m/s, jitter " << width);
                        REQUIRE (hits == 1);
                        REQUIRE (speed == Approx (v).epsilon (error));
                    }
}

TEST_CASE ("impact: if a tool waits and waggles before the touch, the hit has the speed of its last stroke", "[nodes][contact]")
{
    const double quantum = 5e-6;
    for (const double rate : { 1000.0, 20'000.0 })
        for (const double nearest : { -2e-3, -5e-4, -1e-4 })
        {
            const auto depth = [&] (int k) {
                const double t = k / rate, out = 0.1, in = 0.12;   // comes near, goes back by 2 mm at 0.1 m/s, and strikes at 0.2 m/s
                const double x = t < out ? nearest - 0.1 * (out - t) : t < in ? nearest - 0.1 * (t - out)
                                                                              : nearest - 0.1 * (in - out) + 0.2 * (t - in);
                return quantised (x, quantum);
            };
            const auto [hits, speed] = strike (impact ({}, rate), static_cast<int> (0.2 * rate), depth);
            CHECK (hits == 1);
            CHECK (speed == Approx (0.2).epsilon (0.05));
        }
}

TEST_CASE ("impact: a braking approach has the same speed at every rate", "[nodes][contact]")
{
    for (const double release : { 1e-6, 1e-5, 5e-5 })
    {
        const auto speed = [&] (double rate) {
            const auto depth = [&] (int k) {
                const double t = k / rate - 0.1003;   // arrives at 0.3 m/s, and brakes at 5 m/s2
                return 0.3 * t - 2.5 * t * t;
            };
            return strike (impact ({ .release = release }, rate), static_cast<int> (0.11 * rate), depth).speed;
        };
        const double expected = speed (20'000.0);
        CHECK (expected == Approx (0.3).epsilon (0.08));
        for (const double rate : { 1000.0, 4000.0 })
            CHECK (speed (rate) == Approx (expected).epsilon (0.02));
    }
}

TEST_CASE ("impact: the speed is not taken over more than the window", "[nodes][contact]")
{
    // The tool speeds up 18 ms before the contact. So large a `release` hides the change, so only `window` keeps it out of the speed.
    const auto depth = [] (int k) { return k < 180 ? -1e-3 * (220 - k) / 10.0 : -3.5e-3 + 2e-4 * (k - 180); };
    for (const double window : { 0.005, 0.015 })
        CHECK (strike (impact ({ .release = 1e-2, .window = window }), 300, depth).speed == Approx (0.2).epsilon (1e-6));
    CHECK (strike (impact ({ .release = 1e-2, .window = 0.1 }), 300, depth).speed < 0.18);
}

TEST_CASE ("impact: a tremor of one quantum at the surface counts as one contact, wherever the surface lies", "[nodes][contact]")
{
    const double q = 5e-5;
    for (const double rate : { 1000.0, 20'000.0 })
        for (double surface = q / 16.0; surface < q; surface += q / 16.0)
        {
            const auto depth = [&] (int k) {
                const double t = k / rate, tremor = 0.45 * q * std::sin (2.0 * M_PI * 9.0 * t);
                return quantised (std::min (-0.01 + 0.05 * t, surface) + tremor, q) - surface;
            };
            CHECK (strike (impact ({}, rate), static_cast<int> (2.0 * rate), depth).hits == 1);
        }
}

TEST_CASE ("impact: quantised positions that flicker at the surface count as one contact", "[nodes][contact]")
{
    // A hand hovers at half a quantum, with a tremor of 0.4 quanta on either side, so the rounded depth flickers.
    const double q = 1e-5;
    const auto [hits, speed] = strike (impact ({ .release = 2e-5 }), 5000,
                                       [&] (int k) { return quantised (k < 100 ? 1e-5 * (k - 100) : 0.5 * q + 0.4 * q * std::sin (0.7 * k), q); });
    CHECK (hits == 1);
    CHECK (speed > 0.0);
}

TEST_CASE ("impact: the speed is taken at the end of the approach, not over all of it", "[nodes][contact]")
{
    const double T = 1e-3;
    SECTION ("a falling tool")
    {
        const double drop = 0.05, v = std::sqrt (2.0 * 9.81 * drop);
        const auto [hits, speed] = strike (impact(), 200, [&] (int k) { return 0.5 * 9.81 * T * T * k * k - drop; });
        CHECK (hits == 1);
        CHECK (speed == Approx (v).epsilon (0.03));
    }
    SECTION ("a tool that was at rest until the last tick")
    {
        const auto [hits, speed] = strike (impact(), 400, [&] (int k) { return k < 300 ? -1e-3 : -1e-3 + 0.4 * T * (k - 300); });
        CHECK (hits == 1);
        CHECK (speed == Approx (0.4).epsilon (0.05));
    }
    SECTION ("a tool that moved away and turned back")
    {
        const std::vector<double> depths { -1e-5, -4e-4, 1e-4 };
        const auto [hits, speed] = strike (impact(), 3, [&] (int k) { return depths[std::size_t (k)]; });
        CHECK (hits == 1);
        CHECK (speed > 0.0);
    }
}

TEST_CASE ("impact: a contact ends only `release` below the surface", "[nodes][contact]")
{
    auto node = impact ({ .release = 1e-3 });
    node.tick ({ .depth = -2e-3 });
    CHECK (node.tick ({ .depth = 1e-3 }).hit > 0.0);
    CHECK (node.tick ({ .depth = -0.9e-3 }).contact == 1.0);
    CHECK (node.tick ({ .depth = 1e-3 }).hit == 0.0);
    CHECK (node.tick ({ .depth = -1.1e-3 }).contact == 0.0);
    CHECK (node.tick ({ .depth = 1e-3 }).hit == Approx (2.1));
}

TEST_CASE ("impact: within the refractory time there is no second hit, and it is not triggered later either", "[nodes][contact]")
{
    const auto hits = [] (double refractory) {
        // Taps every 20 ms.
        return strike (impact ({ .refractory = refractory }), 1000, [] (int k) { return 1e-3 * std::sin (2.0 * M_PI * k / 20.0 - 1.0); })
            .hits;
    };
    CHECK (hits (0.0) == 50);
    CHECK (hits (0.020) == 50);
    CHECK (hits (0.021) == 25);
    CHECK (hits (0.2) == 5);

    auto node = impact ({ .refractory = 0.01 });
    node.tick ({ .depth = -1e-3 });
    CHECK (node.tick ({ .depth = 1e-3 }).hit > 0.0);
    node.tick ({ .depth = -1e-3 });
    for (int k = 0; k < 100; ++k)
        CHECK (node.tick ({ .depth = 1e-3 }).hit == 0.0);
}

TEST_CASE ("impact: a touch slower than min_speed is a contact without a hit", "[nodes][contact]")
{
    const auto hits = [] (double v) { return strike (impact ({ .min_speed = 0.1 }), 1000, [&] (int k) { return v * 1e-3 * (k - 500.5); })
                                          .hits; };
    CHECK (hits (0.0999) == 0);
    CHECK (hits (0.1001) == 1);
}

TEST_CASE ("impact: a tool that is inside from the start, or after a fault, triggers no hit", "[nodes][contact]")
{
    auto node = impact();
    CHECK (node.tick ({ .depth = 1e-3 }).hit == 0.0);
    CHECK (node.tick ({ .depth = 1e-3 }).contact == 1.0);
    node.tick ({ .depth = -1e-3 });

    const auto fault = node.tick ({ .depth = not_a_number });
    CHECK (fault.hit == 0.0);
    CHECK (fault.contact == 0.0);
    CHECK (node.tick ({ .depth = 1e-3 }).hit == 0.0);
    CHECK (node.tick ({ .depth = 1e-3 }).contact == 1.0);
}

TEST_CASE ("impact: no input breaks it", "[nodes][contact]")
{
    tactus::test::property ("hits are finite and not negative", [] {
        auto node = impact ({ .release = *rc::gen::element (0.0, 1e-5, 1e300), .refractory = *rc::gen::element (0.0, 0.01, 1e300) });
        for (int k = 0; k < 60; ++k)
        {
            const double depth = *rc::gen::element (0.0, 1e-3, -1e-3, 1e-320, -1e300, 1e300, 1.7e308, -1.7e308, not_a_number, tactus::inf);
            const auto out = node.tick ({ .depth = depth });
            RC_ASSERT (tactus::isFinite (out.hit) && out.hit >= 0.0);
            RC_ASSERT (out.contact == 0.0 || out.contact == 1.0);
        }
    });
}
