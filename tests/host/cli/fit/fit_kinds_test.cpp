// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/cli/program.hpp"
#include "table_text.hpp"

#include <host/tools/fitting/fitting.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/kit/random.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <thread>

using namespace tactus;
using test::checkRefused;
using test::runTactus;
using test::Scratch;
using test::table;

namespace
{
constexpr double full_circle = 2.0 * std::numbers::pi;

/// Strokes of 1 mm on a contact that stretches 0.1 mm and then slides at 0.8 N, at a load of 2 N.
std::string strokes (const std::string& header = "position,force,load")
{
    Random random { 3 };
    double d = 0.0, last = 0.0;
    return table (header, 1200, [&, random] (std::ostream& out, int i) mutable {
        const double phase = std::fmod (i / 400.0, 1.0), x = 1e-3 * (1.0 - std::abs (2.0 * phase - 1.0));
        d = std::clamp (d + x - last, -1e-4, 1e-4);
        last = x;
        out << x << "," << -0.8 * d / 1e-4 + 0.02 * random.normal() << ",2";
    });
}

std::string ring()
{
    Random random { 4 };
    return table ("t,acceleration", 1500, [random] (std::ostream& out, int i) mutable {
        const double t = i / 5000.0;
        out << t << "," << std::exp (-20.0 * t) * std::sin (full_circle * 220.0 * t + 1.5) + 0.01 * random.normal();
    });
}

std::string cloth()
{
    Random random { 5 };
    double before = 0.0, earlier = 0.0;
    return table ("t,speed,force,acceleration", 6000, [&, random] (std::ostream& out, int i) mutable {
        const double y = 1.5 * before - 0.8 * earlier + random.normal();
        earlier = before;
        before = y;
        out << i / 2000.0 << "," << (i < 3000 ? 0.05 : 0.2) << ",1.2," << y;
    });
}

std::string ridges()
{
    Random random { 6 };
    return table ("x_mm,height_um", 800, [random] (std::ostream& out, int i) mutable {
        const double x = 0.02 * i;
        out << x << "," << 30.0 * std::sin (full_circle * x / 2.5) + 0.5 * random.normal();
    });
}

/// A sample of 2 N/mm that bursts at 6 N, 3 mm deep, with a crack of 2 mm, and is cut at 4 N.
std::string cut()
{
    Random random { 7 };
    double crack = 0.0;
    return table ("depth,force", 600, [&, random] (std::ostream& out, int i) mutable {
        const double depth = 2e-5 * i;
        if (depth >= 3e-3 && crack == 0.0) crack = 2e-3;
        if (crack > 0.0) crack = std::max (crack, depth - 2e-3);
        out << depth << "," << 2000.0 * (depth - crack) + 0.05 * random.normal();
    });
}

/// A slow push of 4 mm, in and out.
std::string press()
{
    return table ("depth,force", 4000, [] (std::ostream& out, int i) {
        const double depth = 4e-3 * (1.0 - std::abs (i / 2000.0 - 1.0));
        out << depth << "," << (i < 2000 ? 1200.0 : 900.0) * depth;
    });
}

/// An impact of 5 ms, recorded with its times.
std::string blow()
{
    return table ("t,depth,force", 2000, [] (std::ostream& out, int i) {
        const double phase = std::numbers::pi * i / 1999.0, depth = 1e-3 * std::sin (phase);
        out << 5e-3 * i / 1999.0 << "," << depth << "," << 5e4 * depth * (1.0 + 0.2 * std::cos (phase));
    });
}

struct Case
{
    std::string kind, recording, node, parameter;
    double value, tolerance;
    std::vector<std::string> options {};
};

double valueIn (const Json& report, const std::string& name)
{
    for (const auto& v : report.at ("parameters"))
        if (v.at ("name").get<std::string>() == name) return v.at ("value").get<double>();
    FAIL ("there is no " << name);
    return 0.0;
}
}   // namespace

TEST_CASE ("fit: each kind finds its parameters, and its preset is valid and can be played", "[cli][fit]")
{
    const Case cases[] {
        { "friction", strokes(), "drag", "mu", 0.4, 0.01 },
        { "friction", strokes(), "drag", "d_max", 1e-4, 0.02 },
        { "modes", ring(), "ring", "mode 1 frequency", 220.0, 0.002 },
        { "modes", ring(), "ring", "mode 1 decay", 20.0, 0.02, { "--mass", "20 g", "--speed", "0.3 m/s" } },
        { "texture", cloth(), "grain", "model 2 a1", 1.5, 0.03, { "--mass", "5 g" } },
        { "grating", ridges(), "ridges1", "period", 2.5e-3, 0.002, { "--load", "0.5 N" } },
        { "grating", ridges(), "ridges1", "amplitude 1", 30e-6, 0.01 },
        { "blade", cut(), "blade", "toughness", 200.0, 0.01, { "--width", "20 mm" } },
        { "blade", cut(), "blade", "rupture_force", 6.0, 0.02, { "--width", "20 mm" } },
    };
    for (const auto& c : cases)
    {
        CAPTURE (c.kind, c.parameter);
        const Scratch scratch;
        const auto csv = scratch.write ("recording.csv", c.recording), preset = scratch.path ("preset.json"), picture = scratch.path ("fit.svg");
        std::vector<std::string> arguments { "fit", c.kind, csv, "-o", preset, "--plot", picture, "--json" };
        arguments.insert (arguments.end(), c.options.begin(), c.options.end());
        const auto ran = runTactus (arguments);
        INFO (ran.out << ran.err);
        REQUIRE (ran.status == 0);
        CHECK (ran.err == "");
        const auto json = Json::parse (ran.out);
        CHECK (valueIn (json, c.parameter) == Approx (c.value).epsilon (c.tolerance));
        CHECK (json.at ("verdict").get<std::string>() == "good");
        CHECK (json.at ("kind").get<std::string>() == c.kind);
        CHECK (json.at ("residual").at ("left_out_rms").get<double>() > 0.0);
        CHECK (test::textOf (picture).find ("<svg") != std::string::npos);

        const auto loaded = loadGraph (preset);
        CHECK (loaded.messages.empty());
        CHECK (loaded.graph.root.find (c.node));
        CHECK (writeGraph (loaded.graph) == test::textOf (preset));
        const auto valid = runTactus ({ "validate", preset });
        INFO (valid.out << valid.err);
        CHECK (valid.status == 0);
        CHECK (runTactus ({ "render", preset, "--out", scratch.path ("out.csv"), "--duration", "0.3" }).status == 0);
    }
}

TEST_CASE ("fit: the preset of friction gives the same forces as the recording", "[cli][fit]")
{
    const Scratch scratch;
    const auto csv = scratch.write ("strokes.csv", strokes()), preset = scratch.path ("wood.json");
    const auto ran = runTactus ({ "fit", "friction", csv, "-o", preset });
    INFO (ran.out << ran.err);
    REQUIRE (ran.status == 0);
    CHECK (ran.out.find ("verdict") != std::string::npos);
    CHECK (ran.out.find ("good") != std::string::npos);
    const auto loaded = loadGraph (preset);
    const auto& params = loaded.graph.root.find ("drag")->params;
    CHECK (params.at ("mu").get<double>() == Approx (0.4).epsilon (0.01));
    CHECK (params.at ("reference_load").get<double>() == Approx (2.0));
}

TEST_CASE ("fit: columns have units in their names, may be separated in other ways, and can be named", "[cli][fit]")
{
    const Scratch scratch;
    const auto fitted = [&] (const std::string& text, std::vector<std::string> options = {}) {
        const auto preset = scratch.path ("preset.json");
        options.insert (options.begin(), { "fit", "friction", scratch.write ("recording.txt", text), "-o", preset, "--json" });
        const auto ran = runTactus (options);
        INFO (ran.out << ran.err);
        REQUIRE (ran.status == 0);
        return valueIn (Json::parse (ran.out), "d_max");
    };
    const auto plain = fitted (strokes());
    auto tabs = strokes ("Position [m]\tFriction [N]\tNormal [N]");
    std::replace (tabs.begin(), tabs.end(), ',', '\t');
    CHECK (fitted (tabs) == plain);
    auto semicolons = strokes ("x;F;load");
    std::replace (semicolons.begin(), semicolons.end(), ',', ';');
    CHECK (fitted (semicolons, { "--column", "force=F" }) == plain);
    CHECK (fitted (strokes ("x_mm,force_mN,load_mN")) == Approx (1e-3 * plain).epsilon (1e-6));
    CHECK (fitted (strokes ("a,b,c"), { "--column", "position=a", "--unit", "position=1 mm", "--column", "force=b", "--column", "load=c" })
           == Approx (1e-3 * plain).epsilon (1e-6));
}

TEST_CASE ("fit: a recording with too little information gets a poor verdict that says what is missing", "[cli][fit]")
{
    const Scratch scratch;
    auto text = cut();
    text.resize (text.find ('\n', text.size() / 8) + 1);   // ends before the burst
    const auto preset = scratch.path ("short.json");
    const auto ran = runTactus ({ "fit", "blade", scratch.write ("cut.csv", text), "-o", preset });
    INFO (ran.out << ran.err);
    REQUIRE (ran.status == 0);
    CHECK (ran.out.find ("poor") != std::string::npos);
    CHECK (ran.out.find ("did not burst") != std::string::npos);
    CHECK (ran.out.find ("unknown") != std::string::npos);
    CHECK (runTactus ({ "validate", preset }).status == 0);
}

TEST_CASE ("fit: a recording without times has those of the rate that is given", "[cli][fit]")
{
    const Scratch scratch;
    Random random { 6 };
    const auto csv = scratch.write ("ring.csv", table ("value", 1500, [random] (std::ostream& out, int i) mutable {
                                        out << std::exp (-0.004 * i) * std::sin (full_circle * 0.08 * i) + 0.001 * random.normal();
                                    }));
    const auto preset = scratch.path ("ring.json");
    checkRefused ({ "fit", "modes", csv, "-o", preset }, 1, "give their rate: --rate HZ", preset);
    const auto ran = runTactus ({ "fit", "modes", csv, "-o", preset, "--rate", "1000" });
    INFO (ran.out);
    CHECK (ran.status == 0);
    CHECK ((ran.out.find ("mode 1 frequency  80.0") != std::string::npos || ran.out.find ("mode 1 frequency  79.9") != std::string::npos));
}

TEST_CASE ("fit: recordings and options that cannot be used are refused, and nothing is written", "[cli][fit]")
{
    const Scratch scratch;
    const auto preset = scratch.path ("out.json"), csv = scratch.write ("strokes.csv", strokes());
    const auto refused = [&] (const std::vector<std::string>& arguments, int status, const char* words) { checkRefused (arguments, status, words, preset); };
    refused ({ "fit", "modes", csv, "-o", preset }, 1, "[fit/column]");
    refused ({ "fit", "friction", scratch.write ("inch.csv", strokes ("x_kg,force,load")), "-o", preset }, 1, "[fit/unit]");
    refused ({ "fit", "curve", scratch.write ("huge.csv", table ("depth,force", 60, [] (std::ostream& out, int i) { out << i << ",1e300"; })), "-o", preset },
             1, "row 1 of the column 'force' is 1e+300");
    refused ({ "fit", "friction", scratch.write ("still.csv", table ("x,force", 100, [] (std::ostream& out, int i) { out << "1," << i; })), "-o", preset }, 1,
             "[fit/no_motion]");
    refused ({ "fit", "modes", scratch.write ("ring.csv", ring()), "-o", preset, "--rate", "5000" }, 1, "[fit/given_twice]");
    refused ({ "fit", "friction", csv, "-o", preset, "--load", "2 m" }, 2, "--load");
    refused ({ "fit", "friction", csv, "-o", preset, "--column", "depth=x" }, 2, "--column");
    refused ({ "fit", "friction", csv, "-o", preset, "--unit", "force=1 m" }, 2, "--unit");
    refused (
        { "fit", "modes", scratch.write ("uneven.csv", table ("t,value", 200, [] (std::ostream& out, int i) { out << i * i << "," << i % 3; })), "-o", preset },
        1, "[fit/uneven]");
    refused ({ "fit", "texture",
               scratch.write ("rest.csv", table ("t,acceleration,speed", 400, [] (std::ostream& out, int i) { out << i * 1e-3 << "," << i % 3 << ",0"; })),
               "-o", preset },
             1, "[fit/at_rest]");
}

TEST_CASE ("fit: every kind can be cancelled, before it begins and while it runs", "[cli][fit]")
{
    const std::map<std::string, std::string> recordings {
        { "friction", strokes() },
        { "modes", ring() },
        { "texture", cloth() },
        { "grating", ridges() },
        { "blade", cut() },
        { "curve", press() },
        { "switch", press() },
        { "shock", blow() },
    };
    for (const auto& info : host::fitKinds())
    {
        CAPTURE (info.id);
        const Scratch scratch;
        const auto rows = host::readRecording (scratch.write ("recording.csv", recordings.at (info.id)));
        REQUIRE (rows);
        const auto problemIf = [&] (FitCourse& course) {
            const auto made = host::fitRecording (info.kind, *rows, "recording.csv", {}, &course);
            return made ? std::string() : made.error().id;
        };
        FitCourse whole, refused;
        CHECK (problemIf (whole) == "");
        CHECK (whole.share > 0.0);
        refused.cancelled = true;
        CHECK (problemIf (refused) == "fit/cancelled");

        for (const double share : { 0.1, 0.5, 0.75 })
        {
            FitCourse course;
            std::jthread other ([&] (const std::stop_token& done) {
                while (course.share < share && ! done.stop_requested())
                    std::this_thread::yield();
                course.cancelled = true;
            });
            const auto problem = problemIf (course);
            CHECK ((problem == "" || problem == "fit/cancelled"));   // it may end before the other thread sees the share
        }
    }
}
