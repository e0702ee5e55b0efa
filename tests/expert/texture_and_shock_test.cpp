// SPDX-License-Identifier: MIT
// Tests of what an expert tries first: textures, shocks and rings.

#include "hands.hpp"
#include <support/property.hpp>
#include <support/rig.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace tactus;
using tactus::test::Dice;
using tactus::test::Sketch;

namespace
{
/// A floor at z = 0 with ridges along x, faded by a gain.
Sketch ridges (double spatial_frequency, const std::string& fader, const Json& fader_params, const std::string& fader_in)
{
    Sketch s;
    s.node ("hand", "device.position").node ("floor", "deform.plane");
    s.node ("grain", "texture.grating", { { "amplitude", 0.2 }, { "spatial_frequency", spatial_frequency }, { "phase", 1.0 } });
    s.node ("fade", fader, fader_params).node ("faded", "vector.scale").node ("motor", "device.force");
    s.wire (fader_in).wire ("hand.position -> floor.position").wire ("hand.position -> grain.position");
    return s.wire ("grain.force -> faded.in").wire ("fade.gain -> faded.gain").wire ("faded.out -> motor.force");
}

double along (const Vec3& force) { return force.x(); }

/// The largest change from tick to tick.
double steepest (const std::vector<double>& signal)
{
    double most = 0.0;
    for (std::size_t k = 1; k < signal.size(); ++k)
        most = std::max (most, std::abs (signal[k] - signal[k - 1]));
    return most;
}

struct Mode
{
    double frequency, decay, amplitude;
};

double ring (const std::vector<Mode>& modes, double v, double t)
{
    double sum = 0.0;
    for (const auto& [f, decay, a] : modes)
        if (t >= 0.0) sum += a * v * std::exp (-decay * t) * std::sin (2.0 * M_PI * f * t);
    return sum;
}
}   // namespace

TEST_CASE ("expert 10: a scan too fast for the tick rate does not alias into a slow buzz", "[expert][texture]")
{
    const double rate = 1000.0, k = 1000.0, f_max = 300.0;
    auto graph = ridges (k, "texture.antialias", { { "spatial_frequency", k }, { "f_max", f_max } }, "hand.position -> fade.position");
    const auto scan = [&] (double speed) {
        auto forces = test::felt (
            graph, [=] (int tick) { return Vec3 { 0.01 + speed * tick / rate, 0, 0 }; },
            200, rate);
        forces.erase (forces.begin());   // the first sample has no speed yet
        return forces;
    };
    const auto loudest = [] (const std::vector<Vec3>& forces) { return std::ranges::max (forces, {}, along).x(); };

    test::property ("any speed", [&] (unsigned seed) {
        const double speed = Dice { seed }.uniform (-1.0, 1.0), pitch = k * std::abs (speed);
        const auto forces = scan (speed);
        if (pitch >= f_max) RC_ASSERT (std::ranges::all_of (forces, [] (const Vec3& f) { return f.isZero (0.0); }));
        if (pitch > 20.0 && pitch < 0.45 * f_max) RC_ASSERT (loudest (forces) > 0.15);
    });

    // Without the guard, 1.5 m/s over ridges 1 mm apart (1500 Hz) would be felt as 500 Hz.
    REQUIRE (scan (1.5).back().isZero (0.0));
    graph.graph.root.nodes[3].bypass = true;
    const auto forces = scan (1.5);
    CHECK (loudest (forces) > 0.1);
    for (std::size_t i = 2; i < forces.size(); ++i)
        REQUIRE (forces[i].x() == Approx (forces[i - 2].x()).margin (1e-9));
}

TEST_CASE ("expert 11: a texture fades in at the touch and does not start with a step", "[expert][texture]")
{
    const double rate = 4000.0, k = 500.0, window = 1e-3, amplitude = 0.2;
    auto graph = ridges (k, "contact.window", { { "window", window } }, "floor.depth -> fade.depth");

    test::property ("any path in and out", [&] (unsigned seed) {
        Dice dice { seed };
        const double down = dice.size (1e-3, 0.2), across = dice.uniform (-0.2, 0.2), from = dice.uniform (-0.1, 0.1);
        const auto path = [=] (int tick) { return Vec3 { from + across * tick / rate, 0, down * (std::abs (tick - 1000) - 700) / rate }; };
        const auto forces = test::felt (graph, path, 2000, rate);
        const double step = amplitude * (down / window + 2.0 * M_PI * k * std::abs (across)) / rate;
        for (std::size_t i = 1; i < forces.size(); ++i)
        {
            RC_ASSERT (std::abs (forces[i].x() - forces[i - 1].x()) <= step * (1.0 + 1e-9));
            if (path (static_cast<int> (i)).z() >= 0.0) RC_ASSERT (forces[i].isZero (0.0));
        }
    });

    // Without the window, the hand feels the texture from the first tick on, even away from the surface.
    graph.graph.root.nodes[3].bypass = true;
    CHECK_FALSE (test::felt (
                     graph, [] (int) { return Vec3 { 0, 0, 1e-3 }; },
                     1)
                     .back()
                     .isZero (1e-3));
}

TEST_CASE ("expert 12: nothing is louder on the rebound than on the way in", "[expert][shock][deform]")
{
    test::property ("a wall, pushed in and released at any speed", [] (unsigned seed) {
        Dice dice { seed };
        Rig rig { "deform.plane", 4000.0 };
        rig.param ("stiffness", dice.size (100.0, 1e4)).param ("dissipation", dice.size (0.01, 5.0)).param ("damping", dice.uniform (0.0, 3.0));
        rig.prepare();
        const double step = dice.size (1e-6, 1e-3);
        std::vector<double> in, out;
        for (int k = -100; k <= 100; ++k)
        {
            rig.input ("position", Vec3 { 0, 0, -step * (100 - std::abs (k)) });
            rig.tick();
            (k < 0 ? in : out).push_back (rig.out ("resistance"));
        }
        for (std::size_t k = 1; k < 99; ++k)
            RC_ASSERT (out[100 - k] < in[k]);
    });

    test::property ("a mass leaves a shock with less energy than it arrived with", [] (unsigned seed) {
        Dice dice { seed };
        const double m = dice.size (0.005, 0.5), v = dice.size (0.05, 2.0), d_max = dice.size (1e-4, 5e-3);
        const double n = dice.uniform (1.0, 2.5), x = dice.size (0.05, 3.0);
        const double rate = 1000.0 * v / d_max;
        Rig rig { "shock.hunt_crossley", rate };
        rig.set ("stiffness", Law { .kind = Law::Kind::power, .a = 0.5 * (n + 1.0) * m * v * v / std::pow (d_max, n + 1.0), .b = n });
        rig.set ("damping", Law { .kind = Law::Kind::dissipation, .a = x / v }).param ("mass", m);
        rig.prepare();

        double impulse = 0.0;
        rig.input ("hit", v).tick();
        rig.input ("hit", 0.0).tick();
        for (; rig.out ("resistance") > 0.0; rig.tick())
            impulse += rig.out ("resistance") / rate;
        // In theory, the restitution e is the root of x - ln (1 + x) = -x e - ln (1 - x e).
        const double e = impulse / (m * v) - 1.0;
        RC_ASSERT (e > 0.0);
        RC_ASSERT (e < 1.0);
        RC_ASSERT (std::abs (x - std::log1p (x) + x * e + std::log1p (-x * e)) < 2e-3 * (x + 1.0));
    });
}

TEST_CASE ("expert 13: a double tap is two complete shocks without a click", "[expert][shock]")
{
    test::property ("any speeds, any time between them", [] (unsigned seed) {
        Dice dice { seed };
        const double first = dice.size (0.01, 2.0), second = dice.size (0.01, 2.0);
        const std::size_t later = static_cast<std::size_t> (1 + dice.below (100));
        const auto play = [&] (double a, double b) {
            Rig rig { "shock.hunt_crossley" };
            rig.prepare();
            std::vector<double> out;
            for (std::size_t k = 0; k < 300; ++k)
            {
                rig.input ("hit", k == 0 ? a : (k == later ? b : 0.0));
                rig.tick();
                out.push_back (rig.out ("resistance"));
            }
            return out;
        };
        const auto one = play (first, 0.0), other = play (0.0, second), both = play (first, second);
        for (std::size_t k = 0; k < both.size(); ++k)
            RC_ASSERT (std::abs (both[k] - one[k] - other[k]) <= 1e-12 * (1.0 + both[k]));
        RC_ASSERT (both.front() == 0.0);
        RC_ASSERT (both.back() == 0.0);
        RC_ASSERT (both[later] == one[later]);
        RC_ASSERT (steepest (both) <= (steepest (one) + steepest (other)) * (1.0 + 1e-12));
    });
}

TEST_CASE ("expert 14: an object hit again while it rings does not click, and ends in silence without denormal numbers", "[expert][vibration]")
{
    test::property ("any modes, any hits", [] (unsigned seed) {
        Dice dice { seed };
        const double rate = 4000.0;
        std::vector<Mode> modes (static_cast<std::size_t> (1 + dice.below (5)));
        Records records;
        double loudest = 0.0;
        for (auto& mode : modes)
        {
            mode = { dice.size (20.0, 1900.0), dice.size (20.0, 500.0), dice.size (0.01, 3.0) };
            records.push_back ({ mode.frequency, mode.decay, mode.amplitude });
            loudest += mode.amplitude;
        }
        Rig rig { "vibration.modal", rate }, left { "vibration.modal", rate };
        rig.set ("modes", records).prepare();
        left.set ("modes", records).prepare();

        const int again = 1 + dice.below (400);
        const double v = dice.size (0.01, 2.0), w = dice.size (0.01, 2.0);
        for (int k = 0; k < 10'000; ++k)
        {
            rig.input ("hit", k == 0 ? v : k == again ? w
                                                      : 0.0);
            left.input ("hit", k == 0 ? v : 0.0);
            rig.tick();
            if (k <= again) left.tick();
            const double now = rig.out ("value");
            if (k <= again) RC_ASSERT (now == left.out ("value"));   // bit for bit, including the tick of the hit
            if (k < 1000) RC_ASSERT (std::abs (now - ring (modes, v, k / rate) - ring (modes, w, (k - again) / rate)) < 1e-12 * loudest);
            RC_ASSERT (std::fpclassify (now) != FP_SUBNORMAL);
        }
        RC_ASSERT (rig.out ("value") == 0.0);
    });
}
