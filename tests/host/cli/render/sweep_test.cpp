// SPDX-License-Identifier: GPL-3.0-or-later
// `tactus spectrogram` and `tactus sweep`.
#include "host/cli/program.hpp"

#include <support/rounds.hpp>
#include <tactus/file/csv.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>

using namespace tactus;
using namespace tactus::test;

namespace
{
std::string gratingGraph (double per_metre)
{
    return R"({ "format": "tactus-graph", "version": 2, "name": "Ridges", "rate_hz": 4000,
      "nodes": { "hand": { "type": "device.position", "role": "tip" },
                 "ridges": { "type": "texture.grating", "params": { "amplitude": 0.2, "spatial_frequency": )"
           + std::to_string (per_metre) + R"( } },
                 "motor": { "type": "device.force", "role": "tip" } },
      "wires": [ "hand.position -> ridges.position", "ridges.force -> motor.force" ] })";
}

Table tableFrom (const std::vector<std::string>& arguments, const std::string& file)
{
    const auto ran = runTactus (arguments);
    INFO (ran.err);
    REQUIRE (ran.status == 0);
    auto table = readTable (std::filesystem::path (file));
    REQUIRE (table);
    return *table;
}

/// The number of the column with the largest value of a row, without the first column and those below a number.
std::size_t highestIn (const Table& table, std::size_t row, std::size_t from)
{
    std::size_t highest = from;
    for (auto c = from; c < table.columns.size(); ++c)
        if (table.at (row, c) > table.at (row, highest)) highest = c;
    return highest;
}

/// The frequency of a column, from its name: "12.5 Hz (N)".
double hzOf (const std::string& column) { return std::stod (column); }
}   // namespace

TEST_CASE ("in a sweep over a grating, the strongest frequency is the speed divided by the period", "[cli][sweep]")
{
    const Scratch scratch;
    std::mt19937 random (7);
    for (int round = 0; round < rounds (12); ++round)
    {
        const auto draw = [&] (double low, double high) { return std::uniform_real_distribution<double> (low, high) (random); };
        const double per_metre = draw (200.0, 2000.0), slowest = draw (0.02, 0.1), fastest = slowest + draw (0.05, 0.3);
        constexpr double length = 0.06;
        const auto graph = scratch.write ("g.json", gratingGraph (per_metre)), out = scratch.path ("s.csv");
        const auto table = tableFrom ({ "sweep", graph, "--speed", std::to_string (slowest) + ".." + std::to_string (fastest), "--steps", "6", "--up-to",
                                        "2000", "-o", out },
                                      out);
        REQUIRE (table.rows() == 6);
        CHECK (table.columns[0] == "speed (m/s)");
        CHECK (table.columns[1] == "0 Hz (N)");
        for (std::size_t row = 0; row < table.rows(); ++row)
        {
            const double speed = table.at (row, 0), bin = speed / length;   // the stroke lasts length / speed
            INFO (per_metre << " 1/m at " << speed << " m/s");
            const auto ridge = highestIn (table, row, 1);
            CHECK (hzOf (table.columns[ridge]) == Approx (speed * per_metre).margin (bin));
            CHECK (table.at (row, ridge) == Approx (0.2).epsilon (0.06));
        }
        CHECK (table.at (0, 0) == Approx (slowest).margin (1e-6));
        CHECK (table.at (5, 0) == Approx (fastest).margin (1e-6));
    }
}

TEST_CASE ("a sweep prints the period of the pattern that it finds, and nothing if there is no pattern", "[cli][sweep]")
{
    const Scratch scratch;
    const auto graph = scratch.write ("g.json", gratingGraph (500.0));
    const auto found = runTactus ({ "sweep", graph, "--speed", "0.05..0.2", "--steps", "8", "-o", scratch.path ("s.svg") });
    INFO (found.err);
    REQUIRE (found.status == 0);
    CHECK (found.out.find ("divided by 2 mm") != std::string::npos);
    auto text = gratingGraph (500.0);
    text.replace (text.find ("\"amplitude\": 0.2"), 16, "\"amplitude\": 0.0");
    const auto silent = runTactus ({ "sweep", scratch.write ("silent.json", text), "--speed", "0.05..0.2", "--steps", "8", "-o", scratch.path ("s.svg") });
    CHECK (silent.status == 0);
    CHECK (silent.out.empty());
}

TEST_CASE ("a sweep shows the force against position and speed", "[cli][sweep]")
{
    const Scratch scratch;
    const auto graph = scratch.write ("g.json", gratingGraph (100.0)), out = scratch.path ("m.csv");
    const auto table = tableFrom ({ "sweep", graph, "--speed", "0.02..0.1", "--steps", "3", "--map", "--length", "20 mm", "-o", out }, out);
    CHECK (table.columns[0] == "speed (m/s)");
    REQUIRE (table.columns[1].starts_with ("x = -0.00"));
    CHECK (table.columns[1].ends_with (" m (N)"));
    REQUIRE (table.rows() == 3);
    for (std::size_t row = 0; row < 3; ++row)   // a grating is a force that depends only on the place
        for (std::size_t c = 1; c < table.columns.size(); ++c)
        {
            const double x = std::stod (table.columns[c].substr (4));
            CHECK (table.at (row, c) == Approx (0.2 * std::sin (2.0 * std::numbers::pi * 100.0 * x)).margin (0.01));
        }
}

TEST_CASE ("a spectrogram has a row for each time and a column for each frequency, with units", "[cli][sweep]")
{
    const Scratch scratch;
    const auto graph = scratch.write ("g.json", R"({ "format": "tactus-graph", "version": 2, "rate_hz": 4000,
      "nodes": { "tone": { "type": "signal.gain" } } })");
    std::string feed = "t,tone.in\n";
    for (int k = 0; k < 4000; ++k)
        feed += std::to_string (k / 4000.0) + "," + std::to_string (0.5 * std::sin (2.0 * std::numbers::pi * (k < 2000 ? 125.0 : 500.0) * k / 4000.0)) + "\n";
    const auto file = scratch.write ("f.csv", feed), out = scratch.path ("s.csv");
    const auto table = tableFrom ({ "spectrogram", graph, "--feed", file, "--port", "tone.out", "--window", "0.128", "-o", out }, out);
    CHECK (table.columns[0] == "time (s)");
    CHECK (hzOf (table.columns.back()) <= 1000.0);
    for (std::size_t row = 0; row < table.rows(); ++row)
    {
        if (std::abs (table.at (row, 0) - 0.5) < 0.07) continue;
        const auto ridge = highestIn (table, row, 1);
        CHECK (hzOf (table.columns[ridge]) == Approx (table.at (row, 0) < 0.5 ? 125.0 : 500.0).margin (1.0 / 0.128));
        CHECK (table.at (row, ridge) == Approx (0.5).epsilon (0.05));
    }
}

TEST_CASE ("spectrograms and sweeps are written as PNG, SVG and PDF", "[cli][sweep]")
{
    const Scratch scratch;
    const auto graph = scratch.write ("g.json", gratingGraph (500.0));
    for (const auto* kind : { ".png", ".svg", ".pdf" })
    {
        const auto out = scratch.path (std::string ("s") + kind);
        const auto ran = runTactus ({ "sweep", graph, "--speed", "0.05..0.2", "--steps", "4", "-o", out, "--size", "120x80" });
        INFO (ran.err);
        REQUIRE (ran.status == 0);
        const auto text = textOf (out);
        CHECK (text.size() > 1000);
        if (std::string (kind) == ".svg") CHECK (text.find ("data:image/png;base64,") != std::string::npos);
        if (std::string (kind) == ".pdf") CHECK (text.find ("/Subtype /Image") != std::string::npos);
        const auto over_time = runTactus ({ "spectrogram", "dry_wood", "-o", out });
        INFO (over_time.err);
        CHECK (over_time.status == 0);
        CHECK (textOf (out) != text);
    }
}

TEST_CASE ("what cannot be analysed is refused before anything is written", "[cli][sweep]")
{
    const Scratch scratch;
    const auto graph = scratch.write ("g.json", gratingGraph (500.0)), out = scratch.path ("s.png");
    checkRefused ({ "sweep", graph, "--speed", "0.2", "-o", out }, 2, "0.02..0.3", out);
    checkRefused ({ "sweep", graph, "--speed", "0.3..0.2", "-o", out }, 2, "0.02..0.3", out);
    checkRefused ({ "sweep", graph, "--speed", "0.0001..0.2", "-o", out }, 2, "2400000 ticks", out);   // 600 s
    checkRefused ({ "sweep", graph, "--speed", "1..2x", "-o", out }, 2, "0.02..0.3", out);
    checkRefused ({ "sweep", graph, "--speed", "0.1..0.2", "--role", "thumb", "-o", out }, 1, "device/unknown_role", out);
    checkRefused ({ "sweep", graph, "--speed", "0.1..0.2", "--port", "ridges.nothing", "-o", out }, 1, "ridges.nothing", out);
    checkRefused ({ "sweep", graph, "--speed", "0.1..0.2", "-o", scratch.path ("s.gif") }, 2, ".png", scratch.path ("s.gif"));
    checkRefused ({ "spectrogram", graph, "-o", out }, 1, "run/no_length", out);
    checkRefused ({ "spectrogram", graph, "--duration", "0.05", "-o", out }, 1, "spectrum/too_short", out);
    const auto silent = scratch.write ("n.json", R"({ "format": "tactus-graph", "version": 2, "nodes": { "tone": { "type": "signal.gain" } } })");
    checkRefused ({ "sweep", silent, "--speed", "0.1..0.2", "-o", out }, 1, "sweep/no_hand", out);
    checkRefused ({ "spectrogram", silent, "--duration", "1", "-o", out }, 1, "record/nothing", out);
}
