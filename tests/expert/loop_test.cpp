// SPDX-License-Identifier: MIT
// Tests of what an expert tries first: the path from the hand to the motor.

#include "hands.hpp"

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

using namespace tactus;
using tactus::test::Dice;
using tactus::test::felt;
using tactus::test::has;
using tactus::test::planOf;
using tactus::test::Sketch;

namespace
{
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// A floor with friction and ridges, all of which respond to the hand within the tick.
Sketch floorboard()
{
    Sketch s;
    s.node ("hand", "device.position").node ("motor", "device.force");
    s.node ("floor", "deform.plane", { { "stiffness", "1 N/mm" } }).wire ("hand.position -> floor.position").wire ("floor.force -> sum.in[0]");
    s.node ("drag", "friction.elasto_plastic", { { "d_max", "0.4 mm" } }).wire ("hand.position -> drag.position");
    s.wire ("floor.resistance -> drag.normal_force").wire ("drag.force -> sum.in[1]");
    s.node ("grain", "texture.grating").node ("window", "contact.window").node ("faded", "vector.scale");
    s.wire ("hand.position -> grain.position").wire ("floor.depth -> window.depth").wire ("grain.force -> faded.in");
    s.wire ("window.gain -> faded.gain").wire ("faded.out -> sum.in[2]");
    s.node ("sum", "vector.add", Json::object(), { { "inputs", 3 } }).node ("safe", "safety.passivity");
    s.wire ("hand.position -> safe.position").wire ("sum.out -> safe.force").wire ("floor.state -> safe.contact");
    s.wire ("safe.force -> motor.force");
    return s;
}

bool sameBits (const std::vector<Vec3>& a, const std::vector<Vec3>& b)
{
    return std::ranges::equal (a, b, [] (const Vec3& u, const Vec3& v) {
        return std::ranges::equal (
            u, v, {}, [] (double x) { return std::bit_cast<std::uint64_t> (x); },
            [] (double x) { return std::bit_cast<std::uint64_t> (x); });
    });
}

/// A hand that strokes, presses and lifts.
Vec3 stroke (int k) { return { 0.02 * std::sin (0.01 * k), 0.01 * std::cos (0.007 * k), 2e-3 * std::sin (0.023 * k) }; }
}   // namespace

TEST_CASE ("expert 15: a hard wall buzzes with an encoder, and the passivity observer detects it", "[expert][safety]")
{
    const auto buzz = [] (double stiffness, double quantum, std::string pairing) {
        Sketch graph;
        graph.node ("hand", "device.position");
        graph.node ("wall", "deform.plane", { { "normal", { -1, 0, 0 } }, { "stiffness", stiffness } });
        graph.node ("safe", "safety.passivity", { { "mass", 0.1 }, { "pairing", pairing } }).node ("motor", "device.force");
        graph.wire ("hand.position -> wall.position").wire ("hand.position -> safe.position").wire ("wall.force -> safe.force");
        graph.wire ("safe.force -> motor.force");
        test::Mass tool;
        tool.damping = 0.2;
        tool.quantum = quantum;
        tool.x = -1e-3;
        tool.v = 0.1;
        tool.hand = [] (double) { return 0.5; };
        Engine engine { planOf (graph, 1000.0) };
        engine.attach ("stylus", tool);
        double low = inf, high = -inf;
        for (int k = 0; k < 10'000; ++k)
        {
            engine.tick();
            if (k < 8000) continue;
            low = std::min (low, tool.x);
            high = std::max (high, tool.x);
        }
        return high - low;
    };

    for (const double stiffness : { 1000.0, 3000.0, 6000.0 })   // the limit is 2 B / T = 400 N/m
        for (const double quantum : { 1e-6, 1e-5, 3e-5 })
        {
            const double blind = buzz (stiffness, quantum, "backward"), braked = buzz (stiffness, quantum, "zoh");
            INFO (stiffness << " N/m, " << quantum << " m: " << blind << " and " << braked << " m");
            CHECK (blind > 1e-3);
            CHECK (braked < 0.2 * blind);
        }
}

TEST_CASE ("expert 16: millimetres are not mistaken for metres, nor radians for cycles", "[expert][units]")
{
    const auto graph = [] (const Json& d_max, const Json& stiffness, const Json& ridges) {
        auto s = floorboard();
        s.graph.root.nodes[2].params["stiffness"] = stiffness;
        s.graph.root.nodes[3].params["d_max"] = d_max;
        s.graph.root.nodes[4].params["spatial_frequency"] = ridges;
        return s;
    };
    const auto plain = felt (graph (0.4e-3, 1000.0, 250.0), stroke, 1000);
    CHECK (sameBits (plain, felt (graph ("0.4 mm", "1 N/mm", "0.25 1/mm"), stroke, 1000)));
    CHECK (sameBits (plain, felt (graph ("400 um", "1 kN/m", "2.5 1/cm"), stroke, 1000)));
    CHECK_FALSE (sameBits (plain, felt (graph (0.4e-3, 1000.0, 2.0 * M_PI * 250.0), stroke, 1000)));
    for (const auto& wrong : { "4 mm", "250 1/s", "250 N/m", "1571 rad/m", "90000 deg/m" })
        CHECK (has (graph (0.4e-3, 1000.0, wrong).compile().messages, "param/unit"));

    const auto rings = [] (const Json& frequency) {
        Sketch sketch;
        sketch.node ("ring", "vibration.modal", Json::object(), { { "modes", { { { "frequency", frequency } } } } });
        return sketch.compile().messages;
    };
    CHECK (rings ("0.1 kHz").empty());
    CHECK (rings ("100 1/s").empty());
    CHECK (has (rings ("628 rad/s"), "setting/value"));

    // With k cycles per metre, one ridge is 1 / k long, so the force repeats after 1 / k, not after 2 pi / k.
    test::property ("any pitch, any position", [] (unsigned seed) {
        Dice dice { seed };
        const double k = dice.size (20.0, 5000.0), x = dice.uniform (-0.1, 0.1);
        Sketch grain;
        grain.node ("hand", "device.position").node ("grain", "texture.grating", { { "spatial_frequency", k } });
        grain.node ("motor", "device.force");
        grain.wire ("hand.position -> grain.position").wire ("grain.force -> motor.force");
        const auto f = felt (
            grain, [=] (int tick) { return Vec3 { x + 0.5 * tick / k, 0, 0 }; },
            3);
        RC_ASSERT (std::abs (f[2].x() - f[0].x()) < 1e-9);
        RC_ASSERT (std::abs (f[1].x() + f[0].x()) < 1e-9);
    });
}

TEST_CASE ("expert 17: a motion of a tenth of a nanometre, ten centimetres from the origin, reaches the motor", "[expert]")
{
    // Ten centimetres from the origin, a float has steps of 7 nm.
    const double stiffness = 1e6, step = 1e-10;
    test::property ("along each axis, anywhere on a desk", [&] (unsigned seed) {
        Dice dice { seed };
        const Vec3 axis = Vec3::Unit (dice.below (3)), from { dice.uniform (-0.2, 0.2), dice.uniform (-0.2, 0.2), dice.uniform (-0.2, 0.2) };
        Sketch graph;
        graph.node ("hand", "device.position");
        graph.node ("wall", "deform.plane", { { "normal", { axis.x(), axis.y(), axis.z() } }, { "offset", 0.3 }, { "stiffness", stiffness } });
        graph.node ("motor", "device.force");
        graph.wire ("hand.position -> wall.position").wire ("wall.force -> motor.force");
        const auto f = felt (
            graph, [&] (int k) { return Vec3 { from + k * step * axis }; },
            100);
        for (std::size_t k = 1; k < f.size(); ++k)
            RC_ASSERT (std::abs (axis.dot (f[k - 1] - f[k]) - stiffness * step) < 1e-3 * stiffness * step);
    });
}

TEST_CASE ("expert 18: the force for a sample reaches the motor within the same tick, however long the chain is", "[expert]")
{
    const auto plan = planOf (floorboard(), 1000.0);
    REQUIRE (plan->delays().size() == 1);
    CHECK (plan->delays()[0].shortest == 0);
    CHECK (plan->delays()[0].longest == 0);

    test::property ("a hand that jumps in and out at any tick", [] (unsigned seed) {
        Dice dice { seed };
        std::vector<double> z (64);
        for (double& v : z)
            v = dice.below (2) == 0 ? dice.uniform (-2e-3, 0.0) : dice.uniform (0.0, 2e-3);

        Sketch chain;
        chain.node ("hand", "device.position").node ("floor", "deform.plane").node ("motor", "device.force").wire ("hand.position -> floor.position");
        std::string last = "floor.force";
        for (int i = 0; i < 30; ++i)
        {
            const std::string name = "x" + std::to_string (i);
            chain.node (name, "vector.scale").wire (last + " -> " + name + ".in");
            last = name + ".out";
        }
        const auto f = felt (
            chain.wire (last + " -> motor.force"), [&] (int k) { return Vec3 { 0, 0, z[static_cast<std::size_t> (k)] }; },
            64);
        for (std::size_t k = 0; k < z.size(); ++k)
            RC_ASSERT (f[k].z() == 1000.0 * std::max (0.0, -z[k]));
    });
}

TEST_CASE ("expert 19: at a different rate, everything is just as fast, as deep and as safe", "[expert]")
{
    Sketch graph;
    graph.node ("ring", "vibration.modal", Json::object(), { { "modes", { { { "frequency", 90.0 }, { "decay", 40.0 }, { "amplitude", 1.0 } } } } });
    graph.node ("low", "filter.one_pole", { { "cutoff", "20 Hz" } }).node ("butter", "filter.butterworth2", { { "cutoff", "50 Hz" } });
    graph.node ("speed", "motion.velocity").node ("wall", "deform.plane", { { "stiffness", 0.0 }, { "damping", 2.0 } });
    graph.node ("fade", "texture.antialias").node ("safe", "safety.passivity", { { "mass", 0.1 } });
    graph.node ("wave", "signal.lfo", { { "frequency", "7 Hz" } });
    graph.wire ("wave.out -> butter.in");

    for (const double rate : { 1000.0, 4000.0, 10'000.0, 48'000.0 })
    {
        INFO (rate << " Hz");
        auto options = CompileOptions {};
        options.feeds = { "ring.hit", "low.in", "speed.position.z", "wall.position.z", "fade.position.x", "safe.position.x", "safe.force.x" };
        options.records = { "ring.value", "low.out", "speed.velocity.z", "wall.resistance", "fade.speed", "safe.alpha", "butter.out" };
        const auto plan = planOf (graph, rate, options);
        const auto out = [&] (std::size_t i) { return *plan->taps()[i].value; };

        const double v = -0.05;
        double loudest = 0.0, alpha = 0.0;
        for (int k = 0; k <= int (0.4 * rate); ++k)
        {
            const double t = k / rate;
            plan->setFeeds (std::vector { k == 0 ? 1.0 : 0.0, 1.0, v * t, v * t, v * t, 1e-3 * t, 5.0 });
            plan->tick();
            if (k == 0) continue;
            REQUIRE (out (0) == Approx (std::exp (-40.0 * t) * std::sin (2.0 * M_PI * 90.0 * t)).margin (1e-9));
            REQUIRE (out (1) == Approx (1.0 - std::exp (-2.0 * M_PI * 20.0 * t)).margin (2.0 * M_PI * 20.0 / rate));
            REQUIRE (out (3) == Approx (-2.0 * v));
            REQUIRE (out (4) == Approx (v));
            if (k >= 2) REQUIRE (out (2) == Approx (v));
            alpha = std::max (alpha, out (5));
            if (t > 0.2) loudest = std::max (loudest, out (6));
        }
        CHECK (alpha == Approx (0.5 * 0.1 * rate));
        CHECK (loudest == Approx (1.0 / std::sqrt (1.0 + std::pow (7.0 / 50.0, 4.0))).epsilon (2e-3));
    }
}

TEST_CASE ("expert 20: a nan from the device is neither stored nor sent to the motor", "[expert]")
{
    // The object includes the origin: if a lost tool were assumed to be at the origin, it would hit the object from inside.
    auto graph = floorboard();
    const Vec3 away { 0.05, -0.03, 0.06 };
    graph.graph.root.nodes[2].params["offset"] = away.z();
    graph.node ("ring", "vibration.modal").node ("up", "vector.join").wire ("floor.hit -> ring.hit").wire ("ring.value -> up.z").wire ("up.out -> motor.force");
    const auto well = felt (
        graph, [&] (int k) { return Vec3 { away + stroke (k) }; },
        1000);
    const double most = std::ranges::max (well, {}, [] (const Vec3& f) { return f.norm(); })
                            .norm();

    test::property ("tracking is lost for some ticks, reported or not, in any component", [&] (unsigned seed) {
        Dice dice { seed };
        const int from = 1 + dice.below (400), to = from + 1 + dice.below (4), which = dice.below (3);
        const bool told = dice.below (2) == 0;
        const double bad = dice.below (2) == 0 ? not_a_number : inf;

        Engine engine { planOf (graph, 1000.0) };
        test::Led hand { std::function<Reading (int)> { [=] (int k) {
            Reading reading { .position = away + stroke (k) };
            if (k < from || k >= to) return reading;
            reading.position[which] = bad;
            reading.valid = ! told;
            return reading;
        } } };
        engine.attach ("stylus", hand);
        for (int k = 0; k < 1000; ++k)
            engine.tick();

        for (const Vec3& f : hand.forces)
        {
            RC_ASSERT (isFinite (f));
            RC_ASSERT (f.norm() <= 1.5 * most);
        }
        for (std::size_t k = 700; k < well.size(); ++k)   // after the contact has ended, no trace of the lost ticks is left
            RC_ASSERT ((hand.forces[k] - well[k]).norm() < 1e-6 * most);
    });
}
