// SPDX-License-Identifier: MIT
#include <tactus/nodes/motion/velocity.hpp>

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <random>
#include <vector>

using tactus::Vec3;
using tactus::nodes::Velocity;

namespace
{
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double T = 1e-3, q = 1e-5;

Velocity velocity (double noise = 0.0, int max_window = 16)
{
    Velocity node;
    node.params.noise = noise;
    node.settings.max_window = max_window;
    node.prepare ({ .rate_hz = 1.0 / T });
    return node;
}

double along (Velocity& node, double x) { return node.tick ({ .position = { x, 0, 0 } }).velocity.x(); }

double quantised (double x) { return q * std::floor (x / q + 0.5); }
}   // namespace

TEST_CASE ("velocity: exact on ramps, whatever the noise setting", "[nodes][motion]")
{
    tactus::test::property ("any speed, position, noise and window", [] {
        const double v = 1e-4 * *rc::gen::inRange (-10'000, 10'000), from = 1e-3 * *rc::gen::inRange (-200, 200);
        auto node = velocity (*rc::gen::element (0.0, 1e-6, 1e-5, 1e-3), *rc::gen::inRange (2, 64));
        for (int k = 0; k < 100; ++k)
        {
            const double measured = along (node, from + v * T * k);
            if (k >= 2) RC_ASSERT (std::abs (measured - v) <= 1e-6 * std::abs (v) + 1e-12);
        }
    });
}

TEST_CASE ("velocity: a ramp is exact on the second sample if it exceeds the noise", "[nodes][motion]")
{
    for (const double noise : { 0.0, 1e-5, 1e-4 })
    {
        auto node = velocity (noise);
        CHECK (along (node, 0.1) == 0.0);
        CHECK (along (node, 0.1 + 0.2 * T) == Approx (0.2));
    }
}

TEST_CASE ("velocity: half a quantum of noise never becomes speed", "[nodes][motion]")
{
    tactus::test::property ("a tool at rest, with noise", [] (unsigned seed) {
        std::mt19937 random { seed };
        std::uniform_real_distribution noise { -0.5 * q, 0.5 * q };
        auto node = velocity (q);
        for (int k = 0; k < 500; ++k)
            RC_ASSERT (along (node, 0.03 + noise (random)) == 0.0);
    });
}

TEST_CASE ("velocity: a position between two quanta never becomes speed either, without knowing the quantum", "[nodes][motion]")
{
    tactus::test::property ("a tool at rest between two quanta, with noise", [] (unsigned seed) {
        std::mt19937 random { seed };
        std::uniform_real_distribution noise { -0.5 * q, 0.5 * q };
        auto node = velocity();
        for (int k = 0; k < 500; ++k)
        {
            const double v = along (node, quantised (3000.5 * q + noise (random)));
            if (k >= 2) RC_ASSERT (v == 0.0);
        }
    });
}

TEST_CASE ("velocity: a steady quantised motion is exact to one quantum per window", "[nodes][motion]")
{
    tactus::test::property ("any speed", [] {
        const double v = 1e-5 * *rc::gen::inRange (-20'000, 20'000);
        const int window = *rc::gen::inRange (4, 33);
        auto known = velocity (q, window);
        for (int k = 0; k < 300; ++k)
        {
            const double measured = along (known, quantised (v * T * k));
            const int n = std::min (k, window);
            if (k >= 1) RC_ASSERT (std::abs (measured - v) <= 2.0 * q / (n * T) * (1.0 + 1e-6));
        }
    });
}

TEST_CASE ("velocity: it learns the quantum from a hand that starts slowly", "[nodes][motion]")
{
    auto known = velocity (q), learning = velocity();
    double x = 0.0;
    for (int k = 0; k < 3000; ++k)
    {
        x += 0.15 * std::sin (2.0 * M_PI * 1.0 * k * T) * T;
        const double a = along (known, quantised (x)), b = along (learning, quantised (x));
        if (k > 100) CHECK (a == Approx (b).margin (1e-9));
    }
}

TEST_CASE ("velocity: for a hand that moves slowly back and forth it is far quieter than the plain difference", "[nodes][motion]")
{
    auto node = velocity();
    double error = 0.0, plain = 0.0, before = 0.0;
    for (int k = 0; k < 4000; ++k)
    {
        const double w = 2.0 * M_PI * 0.3, x = 0.02 * std::sin (w * k * T), v = 0.02 * w * std::cos (w * k * T), p = quantised (x);
        const double measured = along (node, p);
        if (k > 1000)
        {
            error += std::pow (measured - v, 2.0);
            plain += std::pow ((p - before) / T - v, 2.0);
        }
        before = p;
    }
    CHECK (std::sqrt (error) < 0.25 * std::sqrt (plain));
}

TEST_CASE ("velocity: a hand that stops is at rest on the next sample", "[nodes][motion]")
{
    auto node = velocity (q);
    for (int k = 0; k < 50; ++k)
        along (node, quantised (0.2 * T * k));
    CHECK (along (node, quantised (0.2 * T * 49)) == 0.0);
    CHECK (along (node, quantised (0.2 * T * 48)) < -0.1);   // and here it turns back
}

TEST_CASE ("velocity: exact positions lag by no more than a tick", "[nodes][motion]")
{
    auto node = velocity();
    double worst = 0.0;
    for (int k = 0; k < 3000; ++k)
    {
        const double w = 2.0 * M_PI * 3.0;
        const double v = along (node, 0.02 * (1.0 - std::cos (w * k * T)));
        if (k > 10) worst = std::max (worst, std::abs (v - 0.02 * w * std::sin (w * (k - 0.5) * T)));
    }
    CHECK (worst < 0.02 * std::pow (2.0 * M_PI * 3.0, 2.0) * T);
}

TEST_CASE ("velocity: each axis has its own window and quantum", "[nodes][motion]")
{
    auto node = velocity();
    Velocity::Outputs out;
    for (int k = 0; k < 100; ++k)
        out = node.tick ({ .position = { 0.3 * T * k, k % 2 == 0 ? 0.0 : q, -0.4 * T * k } });
    CHECK (out.velocity.x() == Approx (0.3));
    CHECK (out.velocity.y() == 0.0);
    CHECK (out.velocity.z() == Approx (-0.4));
    CHECK (out.speed == Approx (0.5));
}

TEST_CASE ("velocity: a window of one tick is the plain difference", "[nodes][motion]")
{
    auto node = velocity (0.0, 1);
    along (node, 0.0);
    CHECK (along (node, q) == Approx (q / T));
    CHECK (along (node, q) == 0.0);
    CHECK (along (node, 5 * q) == Approx (4 * q / T));
}

TEST_CASE ("velocity: a fault gives 0, and the motion across it does not count", "[nodes][motion]")
{
    for (const Vec3& bad : { Vec3 { not_a_number, 0, 0 }, Vec3 { 0, tactus::inf, 0 } })
    {
        auto node = velocity();
        along (node, 0.0);
        along (node, 0.001);
        CHECK (node.tick ({ .position = bad }).velocity.isZero (0.0));
        CHECK (along (node, 0.5) == 0.0);
        CHECK (along (node, 0.502) == Approx (2.0));
    }
}

TEST_CASE ("velocity: no input breaks it", "[nodes][motion]")
{
    tactus::test::property ("outputs are finite", [] {
        const auto number = rc::gen::element (0.0, 1.0, -1.0, 1e-3, 1e-320, -1e160, 1e300, -1.7e308, not_a_number, tactus::inf);
        auto node = velocity (*rc::gen::element (0.0, 1e-320, 1e-5, 1e300), *rc::gen::element (1, 2, 16, Velocity::longest_window));
        for (int k = 0; k < 20; ++k)
        {
            const double x = *number, y = *number, z = *number;
            const auto out = node.tick ({ .position = { x, y, z } });
            RC_ASSERT (tactus::isFinite (out.velocity, out.speed));
            RC_ASSERT (out.speed >= 0.0);
        }
    });
}

TEST_CASE ("velocity: a new instance adopts the past samples", "[nodes][motion]")
{
    auto old = velocity(), next = velocity();
    for (int k = 0; k < 30; ++k)
        along (old, quantised (0.013 * T * k));
    next.adopt (old);
    const double x = quantised (0.013 * T * 30);
    CHECK (along (next, x) == along (old, x));
}

TEST_CASE ("velocity: with a window in seconds, a quantised ramp has the same noise at 1, 4 and 20 kHz", "[nodes][motion]")
{
    const auto worst = [] (double rate_hz, double window) {
        double error = 0.0;
        for (const double v : { 0.011, 0.023, 0.047 })
        {
            Velocity node;
            node.settings.window = window;
            node.prepare ({ .rate_hz = rate_hz });
            for (int k = 0; k < static_cast<int> (0.2 * rate_hz); ++k)
            {
                const double measured = along (node, quantised (0.37 * q + v * k / rate_hz));
                if (k > 0.05 * rate_hz) error = std::max (error, std::abs (measured - v));
            }
        }
        return error;
    };
    const double bound = 2.0 * q / 0.01;
    for (const double rate : { 1000.0, 4000.0, 20000.0 })
        CHECK (worst (rate, 0.01) <= bound);
    CHECK (worst (20000.0, 0.0) > 3.0 * bound);   // window 0: max_window, 16 ticks
}

namespace
{
/// The end-fit window of one axis, by its definition, in m per tick. `past`: the newest sample last.
double endFit (const std::vector<double>& past, std::size_t longest, double noise)
{
    const auto ago = [&past] (std::size_t n) { return past[past.size() - 1 - n]; };
    const auto reach = std::min (longest, past.size() - 1);
    const double now = ago (0), play = noise * (1.0 + 1e-6);
    double least = -tactus::inf, most = tactus::inf;
    std::size_t fitting = 0;
    bool is_rest = reach > 0;
    for (std::size_t n = 1; n <= reach && least <= most; ++n)
    {
        const double inverse = 1.0 / static_cast<double> (n), step = (now - ago (n)) * inverse;
        if (step >= least && step <= most) fitting = n;
        least = std::max (least, step - play * inverse);
        most = std::min (most, step + play * inverse);
    }
    for (std::size_t a = 0; a <= reach; ++a)
        for (std::size_t b = 0; b <= reach; ++b)
            is_rest = is_rest && ago (a) - ago (b) <= play;
    bool is_ramp = reach >= 2;
    for (std::size_t n = 1; n < reach; ++n)
    {
        const double rise = now - ago (reach), line = now - rise * static_cast<double> (n) / static_cast<double> (reach);
        is_ramp = is_ramp && std::abs (line - ago (n)) <= 1e-6 * std::abs (rise);
    }
    if (fitting == 0 || (least <= most && is_rest && ! is_ramp)) return 0.0;
    return (now - ago (fitting)) / static_cast<double> (fitting);
}
}   // namespace

TEST_CASE ("velocity: the bits of the definition, also where positions repeat", "[nodes][motion]")
{
    tactus::test::property ("any positions of a few quanta", [] (unsigned seed) {
        const double noise = *rc::gen::element (q, 3.0 * q);
        const int window = *rc::gen::inRange (1, 12);
        auto node = velocity (noise, window);
        std::mt19937 random { seed };
        std::vector<double> past;
        const double some[] { 0.0, -0.0, q, -q, 2.0 * q, 5.0 * q, 0.1, 0.1 + q };
        for (int k = 0; k < 200; ++k)
        {
            past.push_back (past.empty() || random() % 3 == 0 ? some[random() % std::size (some)] : past.back());
            const double expected = endFit (past, static_cast<std::size_t> (window), noise) / T;
            RC_ASSERT (std::bit_cast<std::uint64_t> (along (node, past.back())) == std::bit_cast<std::uint64_t> (expected));
        }
    });
}
