// SPDX-License-Identifier: MIT
#include <tactus/nodes/filter/butterworth2.hpp>
#include <tactus/nodes/filter/reconstruction.hpp>
#include <tactus/nodes/texture/grating.hpp>

#include <support/ready.hpp>
#include <tactus/kit/geometry/rotation.hpp>
#include <tactus/run/device/sim.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

using tactus::Vec3;
using tactus::nodes::Butterworth2;
using tactus::nodes::Reconstruction;
using tactus::test::ready;

namespace
{
Vec3 forceAt (int k) { return { std::sin (0.3 * k), k % 50 < 25 ? 1.0 : -0.5, 0.01 * k }; }
}   // namespace

TEST_CASE ("reconstruction: each component passes the Butterworth low-pass, bit for bit", "[nodes][filter]")
{
    auto node = ready<Reconstruction> ({ .cutoff = 30.0 });
    auto x = ready<Butterworth2> ({ .cutoff = 30.0 }), y = x, z = x;
    for (int k = 0; k < 1000; ++k)
    {
        const Vec3 f = forceAt (k);
        const Vec3 expected { x.tick ({ .in = f.x() }).out, y.tick ({ .in = f.y() }).out, z.tick ({ .in = f.z() }).out };
        REQUIRE (node.tick ({ .in = f }).out == expected);
    }
}

TEST_CASE ("reconstruction: it does not matter how the axes are turned", "[nodes][filter]")
{
    const auto turn = tactus::rotationMatrix (Vec3 (0.3, -1.1, 0.7));
    auto straight = ready<Reconstruction> ({ .cutoff = 30.0 }), turned = straight;
    for (int k = 0; k < 500; ++k)
        REQUIRE ((turn * straight.tick ({ .in = forceAt (k) }).out - turned.tick ({ .in = turn * forceAt (k) }).out).norm() < 1e-12);
}

TEST_CASE ("reconstruction: a slow force comes 1/(pi sqrt 2 cutoff) later", "[nodes][filter]")
{
    for (const double cutoff : { 30.0, 400.0 })
    {
        constexpr double rate = 20'000.0;
        auto node = ready<Reconstruction> ({ .cutoff = cutoff }, rate);
        double lag = 0.0;
        for (int k = 0; k < 4000; ++k)   // a ramp of 1 N/s
            lag = k / rate - node.tick ({ .in = { 0.0, k / rate, 0.0 } }).out.y();
        CHECK (lag == Approx (1.0 / (std::numbers::pi * std::numbers::sqrt2 * cutoff)).epsilon (2e-3));
    }
}

TEST_CASE ("reconstruction: one component that is not finite gives 0 on all, and has no effect afterwards", "[nodes][filter]")
{
    auto node = ready<Reconstruction> ({ .cutoff = 30.0 }), fresh = node;
    for (int k = 0; k < 20; ++k)
        node.tick ({ .in = forceAt (k) });
    CHECK (node.tick ({ .in = { 1.0, std::numeric_limits<double>::quiet_NaN(), 2.0 } }).out == Vec3 (0, 0, 0));
    for (int k = 0; k < 20; ++k)
        CHECK (node.tick ({ .in = forceAt (k) }).out == fresh.tick ({ .in = forceAt (k) }).out);
}

namespace
{
constexpr double loop_rate = 10'000.0;

/// The Pantograph with the numbers of its profile. The sensor is at the motor, and half of the mass behind a mode of 400 Hz.
tactus::Simulation pantograph()
{
    return { .mass = 0.05,
             .damping = 0.1,
             .quantum = 1e-5,
             .force_quantum = 2.5e-3,
             .coulomb = 0.02,
             .first_mode = 400.0,
             .first_mode_damping = 0.05,
             .end_mass = 0.025 };
}

/// The velocities of the tip, tick by tick, while the tool is on ridges of 2 mm, whose force is filtered or not.
std::vector<double> onRidges (const tactus::Simulation& sim, double amplitude, std::optional<double> cutoff, double duration_s)
{
    tactus::SimulatedDevice device { sim };
    device.prepare (1.0 / loop_rate);
    auto ridges = ready<tactus::nodes::Grating> ({ .amplitude = amplitude, .spatial_frequency = 500.0 }, loop_rate);
    auto filter = ready<Reconstruction> ({ .cutoff = cutoff.value_or (400.0) }, loop_rate);
    std::vector<double> velocities;
    for (int k = 0; k < static_cast<int> (duration_s * loop_rate); ++k)
    {
        const auto reading = device.read();
        velocities.push_back (reading.true_velocity.x());
        const Vec3 f = ridges.tick ({ .position = reading.position }).force;
        device.write ({ .force = cutoff ? filter.tick ({ .in = f }).out : f });
    }
    return velocities;
}

/// True if a tool that is let go 0.2 mm beside a valley still moves after 3 s.
bool swings (double amplitude, std::optional<double> cutoff)
{
    auto sim = pantograph();
    sim.position = { 1.2e-3, 0.0, 0.0 };
    const auto all = onRidges (sim, amplitude, cutoff, 3.0);
    return std::any_of (all.end() - 5000, all.end(), [] (double v) { return std::abs (v) > 1e-3; });
}

/// A hand that strokes to and fro by 60 mm, twice in 2 s.
struct Stroke final : tactus::Path
{
    static constexpr double w = 2.0 * std::numbers::pi;
    Point at (double t) const noexcept override { return { { 0.03 * std::sin (w * t), 0.0, 0.0 }, { 0.03 * w * std::cos (w * t), 0.0, 0.0 } }; }
    double duration() const noexcept override { return 1.0; }
};

/// The vibration of the tip from 300 to 1000 Hz in a stroke, in m/s rms.
double shaking (double amplitude, std::optional<double> cutoff)
{
    auto sim = pantograph();
    sim.hand = { 1000.0, 3.0, std::make_shared<Stroke>() };
    const auto all = onRidges (sim, amplitude, cutoff, 2.0);
    const std::vector<double> second (all.begin() + 10'000, all.end());   // 1 s, so the lines are 1 Hz apart
    double sum = 0.0;
    for (int hz = 300; hz < 1000; ++hz)
    {
        std::complex<double> line = 0.0;
        for (std::size_t k = 0; k < second.size(); ++k)
        {
            const double part = static_cast<double> (k) / loop_rate, window = 0.5 - 0.5 * std::cos (2.0 * std::numbers::pi * part);
            line += window * second[k] * std::polar (1.0, -2.0 * std::numbers::pi * hz * part);
        }
        sum += std::norm (line);
    }
    return std::sqrt (2.0 * sum * 8.0 / 3.0) / loop_rate;
}
}   // namespace

TEST_CASE ("reconstruction: on the Pantograph, ridges swing earlier with it, and a stroke shakes the tip as much as without", "[nodes][filter]")
{
    CHECK_FALSE (swings (2.5, {}));
    CHECK (swings (3.2, {}));
    CHECK_FALSE (swings (0.42, 400.0));
    CHECK (swings (0.55, 400.0));
    CHECK_FALSE (swings (0.27, 200.0));
    CHECK (swings (0.4, 200.0));

    for (const double amplitude : { 0.1, 0.3 })
    {
        const double plain = shaking (amplitude, {}), filtered = shaking (amplitude, 400.0);
        INFO (amplitude << " N: " << plain << " m/s, filtered " << filtered);
        CHECK (filtered > 0.7 * plain);
        CHECK (filtered < 1.3 * plain);
    }
}
