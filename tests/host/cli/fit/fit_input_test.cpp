// SPDX-License-Identifier: GPL-3.0-or-later
// What `tactus fit` reads from files and options, and what it writes for recordings at the limits.

#include "host/cli/program.hpp"
#include "table_text.hpp"

#include <host/base/files/wav.hpp>
#include <host/tools/fitting/fitting.hpp>
#include <host/tools/fitting/surface_preset.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/kit/random.hpp>
#include <tactus/text/json.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace tactus;
using test::runTactus;
using test::Scratch;
using test::table;

namespace
{
constexpr double full_circle = 2.0 * std::numbers::pi;

/// A ring of 100 m/s2 at 300 Hz that decays with 200 1/s, struck 10 ms after the start.
std::string tap()
{
    Random random { 3 };
    return table ("t,acceleration", 1000, [random] (std::ostream& out, int i) mutable {
        const double t = i * 1e-4, since = t - 0.01;
        out << t << "," << (since < 0.0 ? 0.0 : 100.0 * std::exp (-200.0 * since) * std::sin (full_circle * 300.0 * since)) + 0.02 * random.normal();
    });
}

/// Strokes on a contact that stretches 0.1 mm. The separator also follows an index in front.
std::string strokes (const std::string& header, char separator, bool has_index)
{
    double d = 0.0, last = 0.0;
    return table (header, 600, [=] (std::ostream& out, int i) mutable {
        const double phase = std::fmod (i / 200.0, 1.0), x = 1e-3 * (1.0 - std::abs (2.0 * phase - 1.0));
        d = std::clamp (d + x - last, -1e-4, 1e-4);
        last = x;
        if (has_index) out << i << separator;
        out << x << separator << -0.8 * d / 1e-4;
    });
}

std::string hiss (double rate)
{
    Random random { 6 };
    double before = 0.0;
    return table ("t,acceleration", 3000, [=] (std::ostream& out, int i) mutable {
        before = 0.7 * before + random.normal();
        out << i / rate << "," << before;
    });
}

/// The fitted graph; `arguments` follow the names of the recording and the preset.
graph::Graph fitted (const Scratch& scratch, const std::string& kind, const std::string& csv, std::vector<std::string> arguments,
                     std::string* printed = nullptr)
{
    const auto preset = scratch.path ("preset.json");
    arguments.insert (arguments.begin(), { "fit", kind, scratch.write ("recording.csv", csv), "-o", preset });
    const auto ran = runTactus (arguments);
    INFO (ran.out << ran.err);
    REQUIRE (ran.status == 0);
    if (printed) *printed = ran.out + ran.err;
    return loadGraph (preset).graph;
}
}   // namespace

TEST_CASE ("fit modes: the preset rings as loud as the recorded blow, wherever the fitted part begins", "[cli][fit]")
{
    const Scratch scratch;
    using Options = std::vector<std::string>;
    for (const Options& part : { Options {}, Options { "--from", "30 ms", "--to", "50 ms" }, Options { "--from", "30 ms", "--blow", "10 ms" } })
    {
        auto arguments = part;
        arguments.insert (arguments.end(), { "--mass", "20 g", "--speed", "0.3 m/s" });
        const auto graph = fitted (scratch, "modes", tap(), arguments);
        CHECK (graph.root.find ("ring")->settings.at ("modes")[0].at ("amplitude").get<double>() == Approx (100.0 * 0.02 / 0.3).epsilon (0.04));
    }
}

TEST_CASE ("fit modes: a WAV is a recording, at its rate, with its channels", "[cli][fit]")
{
    const Scratch scratch;
    for (const double rate : { 8000.0, 44100.0 })
    {
        auto wav = host::WavWriter::create (scratch.path ("bell.WAV"), rate, 2);
        REQUIRE (wav);
        for (int i = 0; i < rate; ++i)
        {
            const double t = i / rate;
            const double samples[] { std::exp (-4.0 * t) * std::sin (full_circle * 440.0 * t),
                                     0.5 * std::exp (-9.0 * t) * std::sin (full_circle * 1234.0 * t) };
            REQUIRE (wav->frame (samples));
        }
        REQUIRE (wav->commit());
        for (const bool second : { false, true })
        {
            std::vector<std::string> arguments { "fit", "modes", scratch.path ("bell.WAV"), "-o", scratch.path ("bell.json"), "--json" };
            if (second) arguments.insert (arguments.end(), { "--column", "value=channel 2" });
            const auto ran = runTactus (arguments);
            INFO (ran.out << ran.err);
            REQUIRE (ran.status == 0);
            const auto report = Json::parse (ran.out);
            CHECK (report["verdict"] == "good");
            REQUIRE (report["parameters"].size() == 3);
            CHECK (report["parameters"][0]["value"].get<double>() == Approx (second ? 1234.0 : 440.0).epsilon (1e-5));
            CHECK (report["parameters"][1]["value"].get<double>() == Approx (second ? 9.0 : 4.0).epsilon (1e-3));
        }
    }
    const auto refused = runTactus ({ "fit", "friction", scratch.path ("bell.WAV"), "-o", scratch.path ("p.json") });
    CHECK (refused.status == 1);
    CHECK (refused.err.find ("channel 1, channel 2") != std::string::npos);
}

TEST_CASE ("fit: places and times may be 0 or negative", "[cli][fit]")
{
    const Scratch scratch;
    const auto press = table ("depth,force", 400, [] (std::ostream& out, int i) {
        const double depth = -2e-3 + 1e-5 * i;
        out << depth << "," << std::max (0.0, 2000.0 * (depth + 1e-3));
    });
    std::string printed;
    fitted (scratch, "curve", press, { "--touch", "-1 mm" }, &printed);
    CHECK (printed.find ("good") != std::string::npos);
    fitted (scratch, "modes", tap(), { "--from", "10 ms", "--blow", "0 s" });
    const auto refused = runTactus ({ "fit", "modes", scratch.write ("tap.csv", tap()), "-o", scratch.path ("p.json"), "--from", "1 m" });
    CHECK (refused.status == 2);
    CHECK (refused.err.find ("--from") != std::string::npos);
}

TEST_CASE ("fit: a depth or a force of the other sign gives the same fit, which says so", "[cli][fit]")
{
    const Scratch scratch;
    const auto press = [] (const std::string& header, double depth_factor, double force_factor, double zero) {
        return table (header, 400, [=] (std::ostream& out, int i) {
            const double depth = 1e-5 * std::min (i, 400 - i);
            out << depth_factor * depth + zero << "," << force_factor * (800.0 * depth + 2e5 * depth * depth);
        });
    };
    const auto parameters = [&] (const std::string& csv, const std::vector<std::string>& options, std::size_t notes) {
        std::string printed;
        auto with_json = options;
        with_json.emplace_back ("--json");
        fitted (scratch, "curve", csv, with_json, &printed);
        const auto report = Json::parse (printed);
        std::size_t turned = 0;
        for (std::size_t i = 0; i < report["notes"].size(); ++i)
            turned += static_cast<std::size_t> (report["notes"][i].asString().find ("sign was turned") != std::string::npos);
        CHECK (turned == notes);
        CHECK (report["verdict"] == "good");
        return report["parameters"].dump();
    };
    const auto plain = parameters (press ("depth,force", 1.0, 1.0, 0.0), {}, 0);
    CHECK (parameters (press ("depth,force", -1.0, 1.0, 0.0), {}, 1) == plain);
    CHECK (parameters (press ("depth,force", 1.0, -1.0, 0.0), {}, 1) == plain);
    CHECK (parameters (press ("z,fz", -1.0, -1.0, 0.0), {}, 2) == plain);
    CHECK (parameters (press ("z_m,Fz_N", -1.0, -1.0, 0.5), { "--touch", "500 mm" }, 2).size() > 10);   // a height, and where it touches
    CHECK (parameters (press ("height,force", -1.0, 1.0, 0.0), { "--sign", "depth=-" }, 0) == plain);   // the user has said it
    const auto file = scratch.write ("kept.csv", press ("height_m,force_N", -1.0, 1.0, 0.5));
    CHECK (runTactus ({ "fit", "curve", file, "-o", scratch.path ("p.json") }).out.find ("counted from 500 mm of the recording") != std::string::npos);
    CHECK (runTactus ({ "fit", "curve", file, "-o", scratch.path ("p.json"), "--sign", "depth=+" }).status == 1);
    CHECK (runTactus ({ "fit", "curve", file, "-o", scratch.path ("p.json"), "--sign", "depth=down" }).err.find ("depth=+ or depth=-") != std::string::npos);
    const auto loaded = [] (double load) {
        double d = 0.0, last = 0.0;
        return table ("x_mm,fx_N,fz_N", 600, [=] (std::ostream& out, int i) mutable {
            const double phase = std::fmod (i / 200.0, 1.0), x = 1.0 - std::abs (2.0 * phase - 1.0);
            d = std::clamp (d + x - last, -0.1, 0.1);
            last = x;
            out << x << "," << -8.0 * d << "," << load;
        });
    };
    const auto muOf = [&] (double load) {
        std::string text;
        fitted (scratch, "friction", loaded (load), { "--json" }, &text);
        return Json::parse (text)["parameters"][0]["value"].get<double>();
    };
    CHECK (muOf (2.0) == Approx (0.4).epsilon (0.01));
    CHECK (muOf (-2.0) == muOf (2.0));
}

TEST_CASE ("fit: an energy is said with the prefix of its size, and one of rounding errors is 0", "[fit]")
{
    CHECK (host::energyText (6.46e-11) == "0.0646 nJ");
    CHECK (host::energyText (6.465e-15) == "0 J");
    CHECK (host::energyText (-2.5e-5) == "-25 uJ");
    CHECK (host::energyText (2.4813e-3, 5) == "2.4813 mJ");
    CHECK (host::energyText (0.0) == "0 J");
}

TEST_CASE ("fit: a column without a name, such as the index that pandas writes, is no obstacle", "[cli][fit]")
{
    const Scratch scratch;
    const auto presetOf = [&] (const std::string& csv) { return writeGraph (fitted (scratch, "friction", csv, {})); };
    const auto plain = presetOf (strokes ("position,force", ',', false));
    CHECK (presetOf (strokes (",position,force", ',', true)) == plain);
    CHECK (presetOf (strokes (";position;force", ';', true)) == plain);
    CHECK (presetOf (strokes ("# position  force", ' ', false)) == plain);
}

TEST_CASE ("fit: messages about numbers name the line in the file", "[cli][fit]")
{
    const Scratch scratch;
    const auto read = host::readRecording (scratch.write ("blank.csv", "\n\nx;f\n1;2\n\n\n1;two\n"));
    REQUIRE_FALSE (read);
    CHECK (read.error().where.ends_with ("blank.csv:7"));
    const auto headless = host::readRecording (scratch.write ("headless.csv", "1;2\n3;four\n"));
    REQUIRE_FALSE (headless);
    CHECK (headless.error().where.ends_with ("headless.csv:2"));
}

TEST_CASE ("fit shock: an elastic impact is a free impact", "[cli][fit]")
{
    const Scratch scratch;
    const auto csv = table ("depth,force,t", 61, [] (std::ostream& out, int i) {
        const double phase = std::numbers::pi * i / 60.0, depth = 1e-3 * std::max (0.0, std::sin (phase));
        out << depth << "," << 5000.0 * depth * (1.0 + 1e-9 * std::cos (phase)) << "," << i * 1e-4;   // a loss above the rounding of the numbers
    });
    std::string printed;
    fitted (scratch, "shock", csv, {}, &printed);
    CHECK (printed.find ("fit/not_free") == std::string::npos);
}

TEST_CASE ("fit shock: if noise of the depth hides the speed at the touch, a free impact is neither confirmed nor denied", "[cli][fit]")
{
    const Scratch scratch;
    for (const double noise : { 0.0, 2e-5 })
    {
        const auto csv = table ("depth,force,t", 61, [&] (std::ostream& out, int i) {
            const double phase = std::numbers::pi * i / 60.0, depth = 1e-3 * std::sin (phase);
            out << std::max (0.0, depth + (i % 2 == 0 ? noise : -noise)) << "," << 5000.0 * depth * (1.0 + 0.1 * std::cos (phase)) << "," << i * 1e-4;
        });
        std::string printed;
        fitted (scratch, "shock", csv, { "--mass", "18.2 g" }, &printed);
        INFO (printed);
        CHECK ((printed.find ("so it is not known whether the tool moved freely") != std::string::npos) == (noise > 0.0));
        CHECK (printed.find ("fit/not_free") == std::string::npos);
    }
}

TEST_CASE ("fit texture: the preset runs at least as fast as the recording, or a note says what it lacks", "[cli][fit]")
{
    const Scratch scratch;
    std::string printed;
    CHECK (fitted (scratch, "texture", hiss (2000), {}).rate_hz == 4000);
    CHECK (fitted (scratch, "texture", hiss (10000), {}, &printed).rate_hz == 10000);
    CHECK (printed.find ("lacks frequencies") == std::string::npos);
    CHECK (fitted (scratch, "texture", hiss (40000), {}, &printed).rate_hz == 20000);
    CHECK (printed.find ("lacks frequencies above 10 kHz") != std::string::npos);
}

TEST_CASE ("a recording of numbers near the smallest is fitted or refused with a reason, like any other", "[cli][fit]")
{
    const Scratch scratch;
    const auto recording = scratch.write ("tiny.csv", table ("t,x,force", 4000, [] (std::ostream& out, int i) {
                                              const double t = i * 1e-3, x = 5e-3 * std::sin (0.5 * full_circle * t);
                                              out << t << "," << x << "," << 1e-310 * std::tanh (1e4 * x);
                                          }));
    const auto ran = runTactus ({ "fit", "friction", recording, "-o", scratch.path ("tiny.json") });
    INFO (ran.err);
    CHECK ((ran.status == 0 || ran.err.find ("tiny.csv") != std::string::npos));
    CHECK (ran.err.find ("should not happen") == std::string::npos);
}

TEST_CASE ("fit: an option for what the recording contains is refused, and no option is ignored", "[cli][fit]")
{
    const Scratch scratch;
    const auto preset = scratch.path ("out.json");
    const auto drag = scratch.write ("drag.csv", table ("x,force,load", 400, [] (std::ostream& out, int i) {
                                         const double phase = 0.05 * i;
                                         out << 1e-3 * std::sin (phase) << "," << (std::cos (phase) > 0.0 ? -0.8 : 0.8) << ",2";
                                     }));
    const auto refused = runTactus ({ "fit", "friction", drag, "-o", preset, "--load", "7 N" });
    CHECK (refused.status == 1);
    CHECK (refused.err.find ("--load gives the load, but the recording has a column for it") != std::string::npos);
    CHECK (refused.err.find ("[fit/given_twice]") != std::string::npos);
    CHECK (runTactus ({ "fit", "friction", drag, "-o", preset, "--load", "7 N", "--column", "load=" }).status == 0);
    CHECK (loadGraph (preset).graph.root.find ("drag")->params.at ("reference_load").get<double>() == 7.0);

    Random random { 6 };
    const auto hiss = [&] (std::ostream& out, int i) { out << i * 1e-3 << ",0.1," << random.normal(); };
    const auto cloth = scratch.write ("cloth.csv", table ("t,speed,acceleration", 2000, hiss));
    CHECK (runTactus ({ "fit", "texture", cloth, "-o", preset, "--speed", "0.2 m/s" }).err.find ("[fit/given_twice]") != std::string::npos);
    CHECK (runTactus ({ "fit", "texture", cloth, "-o", preset, "--force", "2 N" }).status == 0);
}

TEST_CASE ("fit: printed and saved tables have six digits, and a click is a reason for a poor verdict", "[cli][fit]")
{
    const Scratch scratch;
    const auto key = table ("x_mm,force_N", 1600, [] (std::ostream& out, int i) {
        const double depth = 4e-3 * std::min (i, 1600 - i) / 800.0 * 1e3, fall = std::clamp ((depth - 1.5) / 0.4, 0.0, 1.0) * 0.19;
        out << depth << "," << (0.6 * std::min (1.0, depth) - fall + 0.6 * std::max (0.0, depth - 3.0)) * (i < 800 ? 1.0 : 0.93);
    });
    std::string printed;
    const auto graph = fitted (scratch, "curve", key, {}, &printed);
    INFO (printed);
    CHECK (printed.find ("poor") != std::string::npos);
    CHECK (printed.find ("tactus fit switch") != std::string::npos);
    CHECK (printed.find ("[fit/falls]") != std::string::npos);
    int longest = 0, digits = 0;
    for (const char c : printed + test::textOf (scratch.path ("preset.json")))
    {
        digits = c >= '0' && c <= '9' ? digits + 1 : c == '.' ? digits
                                                              : 0;
        longest = std::max (longest, digits);
    }
    CHECK (longest <= 11);   // 0.0000123456
}
