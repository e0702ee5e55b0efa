// SPDX-License-Identifier: MIT
#include <tactus/nodes/texture/antialias.hpp>
#include <tactus/nodes/texture/grating.hpp>

#include <golden/golden.hpp>
#include <support/property.hpp>
#include <support/ready.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

using tactus::Vec3;
using tactus::nodes::AntiAlias;
using tactus::nodes::Grating;
using tactus::test::Golden;
using tactus::test::ready;

namespace
{
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// The node's output on the second of two samples that move at v m/s along x.
AntiAlias::Outputs at (AntiAlias node, double v)
{
    node.tick ({});
    return node.tick ({ .position = { v * 1e-3, 0, 0 } });
}
}   // namespace

TEST_CASE ("antialias: it matches the golden columns", "[nodes][texture][golden]")
{
    const Golden golden ("texture");
    auto node = ready<AntiAlias> ({ .spatial_frequency = golden.param ("k"), .f_max = 100.0 }, 1.0 / golden.dt_s());
    std::vector<AntiAlias::Outputs> outs;
    for (std::size_t i = 0; i < golden.rows(); ++i)
        outs.push_back (node.tick ({ .position = { golden (i, "x"), golden (i, "y"), golden (i, "dz") } }));
    CHECK (golden.worst ("v_diff", [&] (std::size_t i) { return outs[i].speed; })
           <= 1.0);
    CHECK (golden.worst ("guard", [&] (std::size_t i) { return outs[i].gain; })
           <= 1.0);
}

TEST_CASE ("antialias: a slow hand feels the whole texture, a fast one feels nothing", "[nodes][texture]")
{
    const auto node = ready<AntiAlias> ({ .spatial_frequency = 200.0, .f_max = 100.0 });
    CHECK (at (node, 0.0).gain == 1.0);
    CHECK (at (node, 0.249).gain == 1.0);
    CHECK (at (node, 0.375).gain == Approx (0.5));
    CHECK (at (node, -0.375).gain == Approx (0.5));
    CHECK (at (node, 0.501).gain == 0.0);
    CHECK (at (node, 1e6).gain == 0.0);
    CHECK (at (node, -0.375).speed == Approx (-0.375));
}

TEST_CASE ("antialias: the faster, the softer, without a step", "[nodes][texture]")
{
    tactus::test::property ("two speeds", [] {
        const auto node = ready<AntiAlias> ({ .spatial_frequency = *rc::gen::element (0.0, 10.0, 200.0, 3000.0),
                                              .f_max = *rc::gen::element (1.0, 100.0, 400.0) });
        const double slow = 1e-4 * *rc::gen::inRange (0, 10'000), more = 1e-6 * *rc::gen::inRange (0, 100);
        const double a = at (node, slow).gain, b = at (node, slow + more).gain;
        RC_ASSERT (a >= b);
        RC_ASSERT (b >= 0.0);
        RC_ASSERT (a <= 1.0);
        RC_ASSERT (a - b <= M_PI * node.params.spatial_frequency / node.params.f_max * more + 1e-9);
    });
}

TEST_CASE ("antialias: only speed along the grating counts", "[nodes][texture]")
{
    auto node = ready<AntiAlias> ({ .angle = M_PI / 2 });
    node.tick ({});
    const auto out = node.tick ({ .position = { 0.1, 2e-4, 0.1 } });
    CHECK (out.speed == Approx (0.2));
    CHECK (out.gain == 1.0);
}

TEST_CASE ("antialias: turning the grating does not count as motion", "[nodes][texture]")
{
    auto node = ready<AntiAlias> ({});
    node.tick ({ .position = { 0.1, 0.2, 0 } });
    node.params.angle = 1.0;
    node.update();
    CHECK (node.tick ({ .position = { 0.1, 0.2, 0 } }).speed == 0.0);
}

TEST_CASE ("antialias: a scan too fast for the sampling rate does not alias to slow ridges", "[nodes][texture]")
{
    // 1 mm ridges at 1.01 m/s and 1 kHz: 1010 Hz, seen as 10 Hz.
    Grating grating;
    grating.params = { .amplitude = 0.3, .spatial_frequency = 1000.0 };
    grating.update();
    auto node = ready<AntiAlias> ({ .spatial_frequency = 1000.0, .f_max = 100.0 });
    double alias = 0.0, guarded = 0.0;
    for (int k = 0; k < 200; ++k)
    {
        const Vec3 p { 1.01e-3 * k, 0, 0 };
        const double value = grating.tick ({ .position = p }).value, gain = node.tick ({ .position = p }).gain;
        alias = std::max (alias, std::abs (value));
        if (k > 0) guarded = std::max (guarded, std::abs (gain * value));
    }
    CHECK (alias > 0.29);
    CHECK (guarded == 0.0);
}

TEST_CASE ("antialias: a fault gives 0, and the next sample has no speed", "[nodes][texture]")
{
    for (const Vec3& bad : { Vec3 { not_a_number, 0, 0 }, Vec3 { 0, tactus::inf, 0 }, Vec3 { 0, 0, not_a_number } })
    {
        auto node = ready<AntiAlias> ({});
        node.tick ({});
        const auto out = node.tick ({ .position = bad });
        CHECK (out.gain == 0.0);
        CHECK (out.speed == 0.0);
        const auto next = node.tick ({ .position = { 9, 9, 9 } });
        CHECK (next.gain == 1.0);
        CHECK (next.speed == 0.0);
    }
}

TEST_CASE ("antialias: no input breaks it", "[nodes][texture]")
{
    tactus::test::property ("outputs are finite", [] {
        const auto number = rc::gen::element (0.0, 1.0, -0.02, 1e-320, -1e160, 1e300, -1.7e308, not_a_number, tactus::inf);
        const double k = *rc::gen::element (0.0, 200.0, 1e300), angle = *rc::gen::element (0.0, 3.0, 1e300),
                     f_max = *rc::gen::element (0.0, 1e-320, 100.0, 1e300);
        auto node = ready<AntiAlias> ({ .spatial_frequency = k, .angle = angle, .f_max = f_max });
        for (int i = 0; i < 20; ++i)
        {
            const double x = *number, y = *number, z = *number;
            const auto out = node.tick ({ .position = { x, y, z } });
            RC_ASSERT (tactus::isFinite (out.gain, out.speed));
            RC_ASSERT (out.gain >= 0.0);
            RC_ASSERT (out.gain <= 1.0);
        }
    });
}

TEST_CASE ("antialias: a new instance adopts the previous position", "[nodes][texture]")
{
    auto old = ready<AntiAlias> ({}), next = ready<AntiAlias> ({});
    old.tick ({ .position = { 0.1, 0, 0 } });
    next.adopt (old);
    CHECK (next.tick ({ .position = { 0.1001, 0, 0 } }).speed == Approx (0.1));
}

TEST_CASE ("antialias: with a window, the gain of a coarse encoder is the same at every rate", "[nodes][texture]")
{
    const double quantum = 2e-5, speed = 0.18, k = 1600.0, f_max = 400.0;
    const auto range = [&] (double rate, double window) {
        AntiAlias node;
        node.params = { .spatial_frequency = k, .f_max = f_max };
        node.settings.window = window;
        node.prepare ({ .rate_hz = rate });
        node.update();
        double least = 1.0, most = 0.0;
        for (int i = 0; i < static_cast<int> (rate); ++i)
        {
            const double x = quantum * std::floor (speed * i / rate / quantum + 0.5);
            const auto out = node.tick ({ .position = { x, 0, 0 } });
            if (i < rate / 10.0) continue;
            least = std::min (least, out.gain);
            most = std::max (most, out.gain);
        }
        return std::pair { least, most };
    };
    const double right = 0.5 * (1.0 + std::cos (M_PI * (k * speed / (0.5 * f_max) - 1.0)));
    for (const double rate : { 1000.0, 4000.0, 20'000.0 })
    {
        const auto [least, most] = range (rate, 5e-3);
        INFO (rate << " Hz: " << least << " to " << most << ", should be " << right);
        CHECK (least > right - 0.06);
        CHECK (most < right + 0.06);
    }
    CHECK (range (20'000.0, 0.0) == std::pair { 0.0, 1.0 });
}

TEST_CASE ("antialias: a new instance adopts the window", "[nodes][texture]")
{
    AntiAlias old, next;
    for (auto* node : { &old, &next })
    {
        node->settings.window = 5e-3;
        node->prepare ({ .rate_hz = 1000.0 });
        node->update();
    }
    for (int i = 0; i < 20; ++i)
        old.tick ({ .position = { 1e-6 * i * i, 0, 0 } });
    next.adopt (old);
    CHECK (next.tick ({ .position = { 4e-4, 0, 0 } }).speed == old.tick ({ .position = { 4e-4, 0, 0 } }).speed);
}
