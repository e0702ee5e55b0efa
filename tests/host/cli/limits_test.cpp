// SPDX-License-Identifier: GPL-3.0-or-later
// `tactus limits`.
#include "framework/check/own_loop.hpp"
#include "program.hpp"
#include "support/rounds.hpp"

#include <tactus/check/sampled_loop.hpp>
#include <tactus/file/csv.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/run/device/sim.hpp>
#include <tactus/text/json.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <filesystem>
#include <numbers>
#include <random>
#include <utility>

using namespace tactus;
using namespace tactus::test;

namespace
{
/// A wall on a device of 0.1 kg and 2 N s/m, at 1 kHz.
std::string wallOn (const std::string& device = R"({ "driver": "sim", "mass": 0.1, "damping": 2, "position": [0, 0, "-1 mm"], "hand_force": [0, 0, "-2 N"] })")
{
    return R"({ "format": "tactus-graph", "version": 2, "name": "Wall", "rate_hz": 1000, "devices": { "tip": )" + device + R"( }, "nodes": {
        "hand": { "type": "device.position", "role": "tip" }, "motor": { "type": "device.force", "role": "tip" },
        "wall": { "type": "deform.plane", "params": { "stiffness": 2000, "damping": 1 } } },
        "wires": ["hand.position -> wall.position", "wall.force -> motor.force"] })";
}

const DeviceNumbers arm = numbersOf (Simulation { .mass = 0.1, .damping = 2.0 });

Table tableOf (std::vector<std::string> arguments, const std::string& file)
{
    arguments.insert (arguments.end(), { "-o", file });
    const auto ran = runTactus (arguments);
    INFO (ran.out << ran.err);
    REQUIRE (ran.status == 0);
    auto table = readTable (std::filesystem::path (file));
    REQUIRE (table);
    return *table;
}

/// Compares each row of a table with the exact loop of a wall.
void compareWithLoop (const Table& table)
{
    const auto column = [&] (std::string_view name) { return table.column (name).value(); };
    const auto rate = column ("rate (Hz)"), stiffness = column ("stiffness (N/m)"), damping = column ("damping (N*s/m)"), radius = column ("radius"),
               load = column ("load (N*s/m)"), passive = column ("passive"), stable = column ("stable"), damper = column ("b < 2M/T + 4B/3"),
               footnote = column ("sigma T < b + B");
    for (std::size_t i = 0; i < table.rows(); ++i)
    {
        const double f = table.at (i, rate), k = table.at (i, stiffness), b = table.at (i, damping);
        INFO (f << " Hz, " << k << " N/m, " << b << " N s/m");
        const std::array response { k + b * f, k };
        const double exact = check::largestRadius (response, arm, 1.0 / f).value();
        CHECK (table.at (i, radius) == Approx (exact).epsilon (1e-5));
        CHECK (table.at (i, load) == Approx (0.5 * k / f + b).epsilon (1e-4).margin (1e-9));
        if (std::abs (exact - check::at_rest) > 1e-4) CHECK ((table.at (i, stable) == 1.0) == (exact <= check::at_rest));
        CHECK ((table.at (i, passive) == 1.0) == (table.at (i, load) <= 2.0));
        CHECK ((table.at (i, damper) == 1.0) == (b < 0.2 * f + 8.0 / 3.0));
        CHECK ((table.at (i, footnote) == 1.0) == (k / f < b + 2.0));
    }
}
}   // namespace

TEST_CASE ("`tactus limits` finds the stiffness at which walls begin to swing, with and without virtual damping", "[check][cli]")
{
    const Scratch scratch;
    const auto file = scratch.write ("wall.json", wallOn());
    for (const auto& [b, stiffest] : { std::pair { 0.0, 4.0e3 }, { 1.0, 6.0e3 }, { 5.0, 13.5e3 }, { 20.0, 36e3 } })
    {
        const auto out = scratch.path ("limits" + std::to_string (static_cast<int> (b)) + ".json");
        const auto ran = runTactus ({ "limits", file, "--set", "wall.damping=" + std::to_string (b), "--steps", "2", "-o", out });
        INFO (ran.out << ran.err);
        REQUIRE (ran.status == 0);
        const auto limits = Json::parse (textOf (out));
        CHECK (limits.at ("stable").at ("stiffness").at ("to").get<double>() == Approx (stiffest).epsilon (0.02));
        CHECK (limits.at ("damping").get<double>() == Approx (b).margin (1e-6));
        if (b <= 1.0)
            CHECK (limits.at ("passive").at ("stiffness").at ("to").get<double>() == Approx (2e3 * (2.0 - b)).epsilon (0.001));
        else
            CHECK (limits.at ("passive").at ("stiffness").is_null());
        CHECK (limits.at ("largest_damper").get<double>() == Approx (202.68).epsilon (1e-4));
    }
}

TEST_CASE ("`tactus limits` says at which stiffness, damping and rate a contact is passive, and where it rests", "[check][cli]")
{
    const Scratch scratch;
    const auto file = scratch.write ("wall.json", wallOn());
    const auto ran = runTactus ({ "limits", file, "--set", "wall.damping=0" });
    INFO (ran.out << ran.err);
    CHECK (ran.status == 0);
    CHECK (ran.out.find (", steepest along the force of 'wall': ") != std::string::npos);
    CHECK (ran.out.find ("stiffness 2000 N/m, virtual damping 0 N*s/m; passive\n") != std::string::npos);
    CHECK (ran.out.find ("2000        at most 4000 ") != std::string::npos);
    CHECK (ran.out.find ("0           at most 1 ") != std::string::npos);
    CHECK (ran.out.find ("1000        at least 500 ") != std::string::npos);   // sigma/(2B)
    // A little damping makes a wall rest that swings without any, so the range of the damping does not begin at 0.
    const auto stiff = runTactus ({ "limits", file, "--set", "wall.damping=0", "--set", "wall.stiffness=4600" });
    INFO (stiff.out << stiff.err);
    CHECK (stiff.out.find ("0           nowhere                           at most 198, at least 0.3\n") != std::string::npos);
    CHECK (runTactus ({ "limits", file, "--set", "wall.stiffness=50000" }).out.find ("N*s/m; it swings\n") != std::string::npos);
    CHECK (runTactus ({ "limits", file, "--set", "wall.stiffness=5000" }).out.find ("stable, but not passive") != std::string::npos);
}

namespace
{
/// A graph whose tool strokes a wall, with a friction that has its load from the wall.
std::string strokedWall (int rate_hz, const std::string& tool, const std::string& wall)
{
    return R"({ "format": "tactus-graph", "version": 2, "rate_hz": )" + std::to_string (rate_hz) + R"(, "devices": { "tip": { "driver": "sim", "mass": 0.1,
        "hand": { "stiffness": 100, "damping": 2, "path": "stroke" }, )"
           + tool + R"( } },
        "nodes": { "hand": { "type": "device.position", "role": "tip" }, "motor": { "type": "device.force", "role": "tip" },
            "wall": { "type": "deform.plane", "params": { )"
           + wall + R"( } }, "drag": { "type": "friction.elasto_plastic" } },
        "wires": ["hand.position -> wall.position", "hand.position -> drag.position", "wall.resistance -> drag.normal_force",
            "wall.force -> motor.force", "drag.force -> motor.force"] })";
}
}   // namespace

TEST_CASE ("`tactus limits` names a weaker loop beside the contact that it varies, and varies no param that acts across this", "[check][cli]")
{
    const Scratch scratch;
    const auto limits = [&] (const char* wall) {
        const auto file = scratch.write ("rubbed.json", strokedWall (1000, R"("damping": 2, "delay": 1)", wall));
        const auto ran = runTactus ({ "limits", file, "--json" });
        INFO (ran.out << ran.err);
        REQUIRE (ran.status == 0);
        return std::pair (Json::parse (ran.out), runTactus ({ "limits", file }).out);
    };
    const auto [stiff, text] = limits (R"("stiffness": 5000, "damping": 5)");
    CHECK (stiff.at ("node") == Json ("wall"));
    CHECK (stiff.at ("weakest").at ("node") == Json ("drag"));
    const double room = stiff.at ("weakest").at ("may_grow").get<double>(), steepest = 0.4 / 1e-4;   // mu over d_max, of 1 N
    const std::array<double, 1> response { room * steepest };
    DeviceNumbers late = arm;
    late.delay = DeviceNumber { .value = 1.0, .source = "made up" };
    CHECK (check::comesToRest (response, late, 1e-3));
    CHECK_FALSE (check::comesToRest (std::array { 1.01 * response[0] }, late, 1e-3));
    // A stiffer wall is the weakest itself; nothing that is varied lets the friction rest.
    const auto stiffer = limits (R"("stiffness": 20000, "damping": 5)").first;
    CHECK (stiffer.at ("stable").at ("stiffness").is_null());
    CHECK (stiffer.at ("weakest").at ("node") == Json ("drag"));
    CHECK (stiffer.at ("weakest").at ("may_grow").get<double>() < 1.0);
    CHECK (text.find ("the weakest other loop there is that of 'drag': it swings, and would rest with 0.33") != std::string::npos);

    const auto soft = limits (R"("stiffness": 1000, "damping": 1)").first;
    CHECK (soft.at ("node") == Json ("drag"));
    CHECK (soft.at ("stiffness_param") == Json (""));   // not the wall's
    CHECK_FALSE (soft.contains ("weakest"));
}

TEST_CASE ("the limits of a wall behind a predictor are where a tool begins to swing, within 5 %", "[check][cli]")
{
    const Scratch scratch;
    const auto wall = [&] (double stiffness, double rate_hz) {
        return R"({ "format": "tactus-graph", "version": 2, "name": "Wall", "rate_hz": )" + std::to_string (rate_hz) + R"(, "devices": { "h":
            { "driver": "sim", "mass": 0.1, "damping": 3, "position": [0, 0, "-0.2 mm"], "hand_force": [0, 0, "-0.6 N"] } }, "nodes": {
            "hand": { "type": "device.position", "role": "h" }, "motor": { "type": "device.force", "role": "h" },
            "wall": { "type": "deform.plane", "params": { "stiffness": )"
               + std::to_string (stiffness) + R"(, "damping": 0.3 } }, "ahead": { "type": "hold.predictive", "params": { "limit": 1e6 } } },
            "wires": ["hand.position -> wall.position", "wall.force -> ahead.in", "ahead.out -> motor.force"] })";
    };
    const auto ran = runTactus ({ "limits", scratch.write ("wall.json", wall (3000.0, 2000.0)), "--json" });
    INFO (ran.out << ran.err);
    REQUIRE (ran.status == 0);
    const auto limits = Json::parse (ran.out);
    CHECK (limits.at ("stiffness_param") == Json ("wall.stiffness"));
    CHECK (limits.at ("damping").get<double>() == Approx (0.3).epsilon (1e-3));   // the half tick of the predictor is no damper

    const auto swings = [&] (double stiffness, double rate_hz) {
        const auto loaded = readGraph (wall (stiffness, rate_hz));
        own::Loop loop { loaded.graph, catalogue(), {}, { .mass = 0.1, .damping = 3.0 } };
        const Vec3 rest { 0.0, 0.0, -0.6 / stiffness };
        bool any = false;
        for (const auto& grip :
             { own::Grip {}, { 6e-3, 2.0, 200.0 }, { 6e-3, 4.0, 200.0 }, { 6e-3, 2.0, 800.0 }, { 6e-3, 4.0, 800.0 }, { 0.554, 6.45, 135.0 } })
        {
            loop.follow ({ rest });
            const auto third = loop.letGo ({ 0.0, 0.0, 1e-7 }, grip, { 0.0, 0.0, -0.6 });
            any = any || third.is_far || third.swing > 1e-8;
        }
        return any;
    };
    const double stiffest = limits.at ("stable").at ("stiffness").at ("to").get<double>(), slowest = limits.at ("stable").at ("rate").at ("from").get<double>();
    INFO (stiffest << " N/m, " << slowest << " Hz");
    CHECK_FALSE (swings (0.95 * stiffest, 2000.0));
    CHECK (swings (1.05 * stiffest, 2000.0));
    CHECK (swings (3000.0, 0.95 * slowest));
    CHECK_FALSE (swings (3000.0, 1.05 * slowest));
}

namespace
{
/// The damping that a device needs, by the supremum on a fine grid of frequencies. `force`: after a step of 1 m into the contact, tick by tick.
double neededFor (const std::vector<double>& force, double period)
{
    double most = 0.0;
    constexpr int points = 4000;
    for (int i = 1; i <= points; ++i)
    {
        const double w = std::numbers::pi * i / points;   // in radians per tick
        std::complex<double> h = 0.0;
        for (std::size_t k = 0; k < force.size(); ++k)
            h += (force[k] - (k > 0 ? force[k - 1] : 0.0)) * std::polar (1.0, -w * static_cast<double> (k));
        most = std::max (most, 0.5 * period * ((1.0 - std::polar (1.0, -w)) * h).real() / (1.0 - std::cos (w)));
    }
    return most;
}
}   // namespace

TEST_CASE ("the limit of passive stiffness is within 1 % of the supremum over the frequency, with damping, filters and delays", "[check][cli]")
{
    const Scratch scratch;
    std::mt19937_64 random { 11 };
    const auto between = [&] (double low, double high) { return low + (high - low) * std::uniform_real_distribution<double> { 0.0, 1.0 }(random); };
    for (int i = 0; i < tactus::test::rounds (12); ++i)
    {
        const double rate_hz = std::round (between (1000.0, 5000.0)), B = between (0.5, 4.0), b = i % 3 == 0 ? 0.0 : between (0.0, 0.3) * B;
        const int delay = static_cast<int> (between (0.0, 3.99));
        const bool is_filtered = i % 2 == 0;
        const double cutoff = rate_hz * between (0.15, 0.35);
        const auto wall = [&] (double stiffness) {
            const auto text = [] (auto v) { return std::to_string (v); };
            const auto smooth = R"(, "smooth": { "type": "filter.reconstruction", "params": { "cutoff": )" + text (cutoff) + " } }";
            const std::string through = R"("wall.force -> smooth.in", "smooth.out -> motor.force")";
            return R"({ "format": "tactus-graph", "version": 2, "name": "Wall", "rate_hz": )" + text (rate_hz)
                   + R"(, "devices": { "h": { "driver": "sim", "mass": 0.1, "damping": )" + text (B) + R"(, "delay": )" + text (delay)
                   + R"(, "position": [0, 0, "-0.2 mm"], "hand_force": [0, 0, "-0.3 N"] } }, "nodes": {
                     "hand": { "type": "device.position", "role": "h" }, "motor": { "type": "device.force", "role": "h" },
                     "wall": { "type": "deform.plane", "params": { "stiffness": )"
                   + text (stiffness) + R"(, "damping": )" + text (b) + " } }" + (is_filtered ? smooth : "")
                   + R"( }, "wires": [ "hand.position -> wall.position", )" + (is_filtered ? through : R"("wall.force -> motor.force")") + " ] }";
        };
        const auto response = [&] (double stiffness) {
            constexpr double step = 1e-6;
            own::Loop loop { readGraph (wall (stiffness)).graph, catalogue(), {}, { .mass = 0.1, .damping = B } };
            const Vec3 place { 0.0, 0.0, -1e-3 };
            loop.follow ({ place });
            const double before = loop.force().z();
            std::vector<double> all (static_cast<std::size_t> (delay), 0.0);
            for (const auto& f : loop.stepTo (place - Vec3 (0.0, 0.0, step), 200))
                all.push_back ((f.z() - before) / step);
            return all;
        };
        const double some = B * rate_hz / (2.0 * delay + 1.0);
        const auto at_one = response (some), at_two = response (2.0 * some);
        double low = 0.0, high = 4.0 * some;
        for (int k = 0; k < 40; ++k)
        {
            const double middle = 0.5 * (low + high);
            auto mixed = at_one;
            for (std::size_t n = 0; n < mixed.size(); ++n)
                mixed[n] += (middle / some - 1.0) * (at_two[n] - at_one[n]);
            (neededFor (mixed, 1.0 / rate_hz) <= B ? low : high) = middle;
        }
        const auto ran = runTactus ({ "limits", scratch.write ("wall.json", wall (0.5 * low)), "--json" });
        INFO (i << ": " << rate_hz << " Hz, B " << B << ", b " << b << ", delay " << delay << ", cutoff " << (is_filtered ? cutoff : 0.0) << '\n'
                << ran.out << ran.err);
        REQUIRE (ran.status == 0);
        const auto passive = Json::parse (ran.out).at ("passive");
        CHECK (passive.at ("rule") == Json ("sufficient"));
        CHECK (passive.at ("stiffness").at ("to").get<double>() == Approx (low).epsilon (0.01));
    }
}

TEST_CASE ("`tactus limits` finds those of an axis, as it finds them for a tool that moves along one line", "[check][cli]")
{
    const Scratch scratch;
    const auto knob = scratch.write ("knob.json", R"json({ "format": "tactus-graph", "version": 2, "name": "detents", "rate_hz": 1000,
        "devices": { "knob": { "driver": "sim", "mass": "50 g", "axes": { "slide": { "mass": "50 g", "damping": "1 N*s/m", "position": "0.2 mm" } } } },
        "nodes": { "p": { "type": "device.axis", "role": "knob", "settings": { "axis": "slide" } },
                   "law": { "type": "signal.expression", "settings": { "inputs": 1, "text": "-2*sin(2000*in0)" } },
                   "m": { "type": "device.effort", "role": "knob", "settings": { "axis": "slide" } } },
        "wires": ["p.axis -> law.in[0]", "law.out -> m.effort"] })json");
    const auto ran = runTactus ({ "limits", knob, "--json" });
    INFO (ran.out << ran.err);
    REQUIRE (ran.status == 0);
    const auto limits = Json::parse (ran.out);
    CHECK (limits.at ("axis") == Json ("slide"));
    CHECK (limits.at ("stiffness").get<double>() == Approx (4000.0).epsilon (0.01));
    CHECK (limits.at ("passive").at ("rule") == Json ("sufficient"));
    CHECK (limits.at ("passive").at ("stiffness").at ("to").get<double>() == Approx (2000.0).epsilon (0.001));   // 2B/T
    CHECK (limits.at ("stable").at ("stiffness").at ("to").get<double>() == Approx (2005.0).epsilon (0.01));
}

TEST_CASE ("the limits of the rate hold for the place of the motion, whatever the rate, and a damper above that of the device is passive at none",
           "[check][cli]")
{
    const Scratch scratch;
    const auto wall = scratch.write ("wall.json", R"({ "format": "tactus-graph", "version": 2, "name": "wall", "rate_hz": 1000,
        "devices": { "h": { "driver": "sim", "mass": "100 g", "damping": "1 N*s/m", "quantum": "50 um", "coulomb": "0.03 N",
            "position": ["0 mm", "0 mm", "3 mm"],
            "hand": { "stiffness": "300 N/m", "damping": "3 N*s/m", "path": "press", "scale": 0.2, "offset": ["0 mm", "0 mm", "-4 mm"] } } },
        "nodes": { "p": { "type": "device.position", "role": "h" }, "m": { "type": "device.force", "role": "h" },
            "w": { "type": "deform.plane", "params": { "stiffness": "1 N/mm", "damping": "10 N*s/m" } } },
        "wires": ["p.position -> w.position", "w.force -> m.force"] })");
    const auto ran = runTactus ({ "limits", wall, "--json" });
    INFO (ran.out << ran.err);
    REQUIRE (ran.status == 0);
    const auto limits = Json::parse (ran.out);
    CHECK (limits.at ("passive").at ("rate").is_null());
    CHECK (limits.at ("quanta").at ("stiffness").get<double>() == Approx (1200.0));   // 2 f_f/delta
    CHECK (limits.at ("quanta").at ("damping").get<double>() == Approx (0.6));        // f_f T/delta
}

TEST_CASE ("each point of a table of `tactus limits` is the exact loop of a wall", "[check][cli]")
{
    const Scratch scratch;
    const auto file = scratch.write ("wall.json", wallOn());
    const auto drawn = tableOf ({ "limits", file, "--x", "stiffness=0:60000", "--y", "damping=0:250", "--steps", "6" }, scratch.path ("a.csv"));
    CHECK (drawn.rows() == 49);
    compareWithLoop (drawn);
    const auto measured = tableOf ({ "limits", file, "--x", "wall.stiffness=100:40000", "--y", "wall.damping=0:100", "--steps", "4" }, scratch.path ("b.csv"));
    CHECK (measured.rows() == 25);
    CHECK (measured.at (24, measured.column ("wall.stiffness").value()) == 40000.0);
    CHECK (measured.at (24, measured.column ("stiffness (N/m)").value()) == Approx (40000.0));
    compareWithLoop (measured);
    compareWithLoop (tableOf ({ "limits", file, "--x", "rate=300:4000", "--y", "stiffness=100:20000", "--steps", "4" }, scratch.path ("c.csv")));
    compareWithLoop (tableOf ({ "limits", file, "--steps", "3" }, scratch.path ("d.csv")));
}

TEST_CASE ("a wall has its limits, whatever friction slides on it under its load", "[check][cli]")
{
    // The tool of 0.1 kg and 1 N s/m strokes a wall with b = 0.3 N s/m. The wall is passive up to k = 2 (B - b)/T = 5600 N/m, and swings from 10.4 kN/m on,
    // by an exact simulation of mass, damping and hands. The friction has 4000 N/m, whatever its load, and is passive up to 2 B/T = 8000 N/m.
    const Scratch scratch;
    const auto file = scratch.write ("stroked.json", strokedWall (4000, R"("damping": 1)", R"("damping": 0.3)"));
    for (const double k : { 6000.0, 10'500.0, 11'000.0, 12'000.0, 15'000.0, 20'000.0 })
    {
        const auto limits = Json::parse (runTactus ({ "limits", file, "--json", "--set", "wall.stiffness=" + std::to_string (k) }).out);
        INFO (k << ": " << limits.dump());
        CHECK (limits.at ("stiffness_param") == Json ("wall.stiffness"));
        CHECK (limits.at ("stiffness").get<double>() == Approx (k).epsilon (1e-3));
        CHECK (limits.at ("stable").at ("stiffness").at ("to").get<double>() == Approx (10'400).epsilon (0.01));
        CHECK (limits.at ("passive").at ("stiffness").at ("to").get<double>() == Approx (5600).epsilon (0.01));
    }
    const auto stiffnessOf = [&] (double stiffness, const std::string& mu) {
        const auto ran = runTactus ({ "check", file, "--json", "--set", "wall.stiffness=" + std::to_string (stiffness), "--set", "drag.mu=" + mu });
        INFO (ran.err);
        const auto all = Json::parse (ran.out).at ("conditions").asArray();
        return *std::ranges::find (all, "stiffness", [] (const Json& one) { return one.at ("id").asString(); });
    };
    for (const double k : { 5000.0, 5700.0, 9000.0, 20'000.0 })
    {
        const auto c = stiffnessOf (k, "0.4"), without = stiffnessOf (k, "0");
        INFO (k << ": " << c.dump());
        const bool is_passive = k < 5600.0;
        REQUIRE (c.at ("loops").size() == 2);
        CHECK (c.at ("loops")[0].at ("node") == Json ("wall"));
        for (const auto& loop : c.at ("loops").asArray())
        {
            const bool is_wall = loop.at ("node") == Json ("wall");
            CHECK (loop.at ("passive_up_to").get<double>() == Approx (is_wall ? 1.0 / (k / 8000.0 + 0.3) : 2.0).epsilon (0.01));
            if (is_passive)
                CHECK (loop.at ("may_grow").is_null());
            else
                CHECK (loop.at ("may_grow").get<double>() == Approx (is_wall ? without.at ("margin").get<double>() : 2.0).epsilon (0.01));
        }
    }
}

TEST_CASE ("limits and check agree on walls that are turned, on an axis, in a corner and beside a curl", "[check][cli]")
{
    const Scratch scratch;
    const auto graph = [&] (const char* name, int rate_hz, const std::string& tool, const std::string& nodes, const std::string& wires) {
        return scratch.write (name, R"({ "format": "tactus-graph", "version": 2, "rate_hz": )" + std::to_string (rate_hz) + R"(, "devices": { "tip": { "driver":
            "sim", "mass": 0.1, )" + tool
                                        + R"(, "hand": { "stiffness": 100, "damping": 2, "path": "press" } } }, "nodes": { )" + nodes + R"( }, "wires": [ )"
                                        + wires + " ] }");
    };
    const std::string hand = R"("hand": { "type": "device.position", "role": "tip" }, "motor": { "type": "device.force", "role": "tip" }, )";
    const auto limitOf = [] (const std::string& file) {
        const auto limits = Json::parse (runTactus ({ "limits", file, "--json" }).out);
        return limits.at ("passive").at ("stiffness").at ("to").get<double>() / limits.at ("stiffness").get<double>();
    };
    const auto stiffnessOf = [] (const std::string& file) {
        const auto all = Json::parse (runTactus ({ "check", file, "--json" }).out).at ("conditions").asArray();
        return *std::ranges::find (all, "stiffness", [] (const Json& one) { return one.at ("id").asString(); });
    };

    // B 2 and a delay of 1: passive up to 2B/(3T) = 1333 N/m, however the wall is turned.
    const auto turned = graph ("turned.json", 1000, R"("damping": 2, "delay": 1)",
                               hand + R"("to": { "type": "vector.to_frame", "params": { "rotation": [0, -0.6, 0] } },
            "from": { "type": "vector.from_frame", "params": { "rotation": [0, -0.6, 0] } }, "a": { "type": "deform.plane", "params": { "stiffness": 1000 } })",
                               R"("hand.position -> to.in", "to.out -> a.position", "a.force -> from.in", "from.out -> motor.force")");
    CHECK (limitOf (turned) == Approx (1.333).epsilon (0.01));
    CHECK (stiffnessOf (turned).at ("loops")[0].at ("passive_up_to").get<double>() == Approx (1.333).epsilon (0.01));

    // The same on an axis, without a delay: 4 times.
    const auto axis = graph ("axis.json", 1000, R"("damping": 2, "axes": { "knob": { "mass": 0.1, "damping": 2 } })",
                             R"("ax": { "type": "device.axis", "role": "tip", "settings": { "axis": "knob" } }, "j": { "type": "vector.join" },
            "ef": { "type": "device.effort", "role": "tip", "settings": { "axis": "knob" } }, "s": { "type": "vector.split" },
            "a": { "type": "deform.plane", "params": { "stiffness": 1000 } })",
                             R"("ax.axis -> j.z", "j.out -> a.position", "a.force -> s.in", "s.z -> ef.effort")");
    CHECK (limitOf (axis) == Approx (4.0).epsilon (0.01));

    // The steepest direction of a corner of two walls is no wall's own: no node has a factor.
    const auto corner = graph ("corner.json", 1000, R"("damping": 2.5, "delay": 1)",
                               hand + R"("a": { "type": "deform.plane", "params": { "stiffness": 1000, "normal": [0.91, 0, 0.4146] } },
            "b": { "type": "deform.plane", "params": { "stiffness": 1000 } })",
                               R"("hand.position -> a.position", "hand.position -> b.position", "a.force -> motor.force", "b.force -> motor.force")");
    const auto both = stiffnessOf (corner);
    INFO (both.dump());
    CHECK (both.at ("margin").get<double>() == Approx (1.178).epsilon (0.01));
    CHECK_FALSE (both.contains ("loops"));

    // K = 1000 I with a curl of 300 N/m: the eigenvalues of M p^2 + B p + 1100 +- 283i, for a wall of 1200 N/m, have a positive real part.
    const auto swirl = graph ("swirl.json", 4000, R"("damping": 1)",
                              hand + R"("s": { "type": "vector.split" }, "j": { "type": "vector.join" }, "ex": { "type": "signal.expression",
            "settings": { "inputs": 2, "text": "-1000*in0-300*in1" } }, "ez": { "type": "signal.expression", "settings": { "inputs": 1, "text": "300*in0" } },
            "a": { "type": "deform.plane", "params": { "stiffness": 1200 } })",
                              R"("hand.position -> s.in", "hand.position -> a.position", "a.force -> motor.force", "s.x -> ex.in[0]", "s.z -> ex.in[1]",
            "s.x -> ez.in[0]", "ex.out -> j.x", "ez.out -> j.z", "j.out -> motor.force")");
    CHECK (Json::parse (runTactus ({ "limits", swirl, "--json" }).out).at ("radius").get<double>() > 1.001);
}

TEST_CASE ("a wall behind a passivity controller is judged by its trials, and its limits are said to be of one state", "[check][cli]")
{
    const Scratch scratch;
    const auto file = scratch.write ("controlled.json", R"({ "format": "tactus-graph", "version": 2, "rate_hz": 600, "devices": { "tip": { "driver": "sim",
        "mass": 0.1, "damping": 1, "hand": { "stiffness": 100, "damping": 2, "path": "press" } } }, "nodes": {
        "hand": { "type": "device.position", "role": "tip" }, "motor": { "type": "device.force", "role": "tip" },
        "wall": { "type": "deform.plane", "params": { "stiffness": 20000, "damping": 0 } }, "control": { "type": "safety.passivity" } },
        "wires": ["hand.position -> wall.position", "hand.position -> control.position", "wall.force -> control.force", "control.force -> motor.force"] })");
    const auto checked = runTactus ({ "check", file }).out;
    INFO (checked);
    CHECK (checked.find ("  stable      stiffness") != std::string::npos);
    CHECK (checked.find ("such as dry friction, a brake or a safety.passivity") != std::string::npos);
    const auto told = runTactus ({ "limits", file }).out;
    CHECK (told.find ("'control' (safety.passivity) brakes by what was before, so the contact's limits are not known") != std::string::npos);
    CHECK (Json::parse (runTactus ({ "limits", file, "--json" }).out).at ("controller") == Json ("control"));
}

TEST_CASE ("a param is varied at the same force, so the place follows it", "[check][cli]")
{
    // A Hertz contact behind a gain g: f = g K w^1.5. At the same force, w^1.5 is f/(g K), and the slope 1.5 g K w^0.5 grows with g^(2/3).
    const Scratch scratch;
    const auto file = scratch.write ("hertz.json", R"({ "format": "tactus-graph", "version": 2, "name": "Hertz", "rate_hz": 1000, "devices": { "tip":
        { "driver": "sim", "mass": 0.1, "damping": 2, "position": [0, 0, "-1 mm"], "hand_force": [0, 0, "-2 N"] } }, "nodes": {
        "hand": { "type": "device.position", "role": "tip" }, "motor": { "type": "device.force", "role": "tip" },
        "wall": { "type": "deform.plane", "settings": { "law": { "power": [40000, 1.5] } } }, "amp": { "type": "signal.gain", "params": { "gain": 1 } } },
        "wires": ["hand.position -> wall.position", "wall.force.z -> amp.in", "amp.out -> motor.force.z"] })");
    const auto table = tableOf ({ "limits", file, "--x", "amp.gain=0.5:8", "--y", "rate=1000:2000", "--steps", "4" }, scratch.path ("gain.csv"));
    const auto gain = table.column ("amp.gain").value(), stiffness = table.column ("stiffness (N/m)").value();
    const double each = table.at (0, stiffness) / std::pow (table.at (0, gain), 2.0 / 3.0);
    for (std::size_t i = 0; i < table.rows(); ++i)
    {
        INFO ("gain " << table.at (i, gain));
        CHECK (table.at (i, stiffness) == Approx (each * std::pow (table.at (i, gain), 2.0 / 3.0)).epsilon (0.01));
    }
}

TEST_CASE ("`tactus limits` draws a picture of each kind", "[check][cli]")
{
    const Scratch scratch;
    const auto file = scratch.write ("wall.json", wallOn());
    for (const auto& [name, start] : { std::pair { "a.png", "\x89PNG" }, { "a.svg", "<svg" }, { "a.pdf", "%PDF" } })
    {
        const auto ran = runTactus ({ "limits", file, "--steps", "8", "-o", scratch.path (name) });
        INFO (name << ran.out << ran.err);
        CHECK (ran.status == 0);
        CHECK (textOf (scratch.path (name)).substr (0, 200).find (start) != std::string::npos);
    }
}

TEST_CASE ("`tactus limits` refuses bad input, and says where it is and what would help", "[check][cli]")
{
    const Scratch scratch;
    const auto file = scratch.write ("wall.json", wallOn()), out = scratch.path ("out.png");
    const auto refused = [&] (std::vector<std::string> more, int status, const std::string& words) {
        more.insert (more.begin(), { "limits", file, "-o", out });
        checkRefused (more, status, words, out);
    };
    const auto axis = [&] (const std::string& x, int status, const std::string& words) { refused ({ "--x", x, "--y", "damping=0:5" }, status, words); };
    axis ("stiffness", 2, "is not a range in SI units, such as stiffness=0:5000");
    axis ("stiffness=5:1", 2, "is not a range");
    axis ("stiffness=nan:1", 2, "is not a range");
    axis ("stiffness=-1:1", 2, "must be between 0 and 1e");
    axis ("rate=100:1e6", 2, "at most 1e5 Hz");
    axis ("damping=0:9", 2, "is already along --x");
    axis ("wal.stiffness=0:1", 1, "did you mean 'wall'");
    axis ("wall.stifness=0:1", 1, "did you mean 'stiffness'");
    axis ("wall.normal=0:1", 1, "has no param 'normal' that is a number");
    axis ("wall.stiffness=-5:100", 1, "wall.stiffness=-5");
    refused ({ "--x", "stiffness=0:1" }, 2, "give both, or none");
    checkRefused ({ "limits", file, "--x", "stiffness=0:1", "--y", "damping=0:5" }, 2, "name one with -o", out);
    refused ({ "--role", "tap" }, 1, "did you mean 'tip'");
    checkRefused ({ "limits", file, "-o", scratch.path ("out.txt") }, 2, "should end in", scratch.path ("out.txt"));
    checkRefused ({ "limits", scratch.write ("g.json", wallOn (R"({ "driver": "gesture", "path": "press" })")), "-o", out }, 1,
                  "the mass of the device is not known", out);
    checkRefused (
        { "limits", scratch.write ("h.json", wallOn (R"({ "driver": "sim", "mass": 0.1, "damping": 2, "position": [0, 0, "50 mm"] })")), "-o", out }, 1,
        "limits/no_contact", out);
}
