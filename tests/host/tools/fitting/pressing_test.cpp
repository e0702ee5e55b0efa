// SPDX-License-Identifier: MIT
// The recordings of presses that laboratories have: heights, places on the scale of a machine, the force on the sensor, in any order of the columns.
#include "host/cli/fit/table_text.hpp"
#include "support/property.hpp"
#include "support/temporary_folder.hpp"

#include <host/tools/fitting/fitting.hpp>
#include <host/tools/fitting/pressing.hpp>
#include <tactus/kit/random.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <fstream>
#include <set>
#include <string>
#include <tuple>
#include <vector>

using namespace tactus;
using Values = std::vector<double>;

namespace
{
/// A tool that comes through the air, touches, presses by 8 mm and, if it is let go, comes back. The force is 1.5 N at 8 mm.
struct Press
{
    std::string header = "z_mm,force_N";
    double from = 30.0, way = -1.0;   // the recorded place at the touch, in mm, and how it changes as the tool goes in
    double force_sign = 1.0;
    double air = 0.0;   // mm before the touch
    bool comes_back = false, has_force_first = false;
    double noise = 0.0;   // N

    std::string text() const
    {
        Random random { 11 };
        constexpr int rows = 400;
        return test::table (header, comes_back ? 2 * rows : rows, [this, random] (std::ostream& out, int i) mutable {
            const double share = double (i < rows ? i : 2 * rows - i) / rows, depth = (8.0 + air) * share - air;
            const double in = std::max (0.0, depth), force = force_sign * (0.1 * in + 0.0109375 * in * in) + noise * random.normal();
            const double place = from + way * depth;
            if (has_force_first)
                out << force << ',' << place;
            else
                out << place << ',' << force;
        });
    }

    Table table() const
    {
        const TemporaryFolder folder;
        const auto file = folder / "press.csv";
        std::ofstream (file) << text();
        auto read = host::readRecording (file);
        REQUIRE (read);
        return *read;
    }

    host::FittedGraph fitted (const host::FitSettings& settings = {}) const
    {
        auto made = host::fitRecording (host::FitKind::curve, table(), "press.csv", settings);
        INFO ((made ? "" : describe (made.error())));
        REQUIRE (made);
        return *made;
    }
};

double deepestOf (const host::FittedGraph& made) { return made.report.picture.curves.front().x.back(); }
}   // namespace

TEST_CASE ("a sign is turned where a whole column has the other one, and that of a depth where it falls while the force grows", "[fit]")
{
    using Values = std::vector<double>;
    const auto& columns = host::infoOf (host::FitKind::curve).columns;
    const auto turned = [&] (Values depth, Values force) {
        host::RecordedColumns recorded { { "depth", std::move (depth) }, { "force", std::move (force) } };
        const auto notes = host::orient (columns, recorded).notes;
        return std::tuple (notes.size(), recorded["depth"], recorded["force"]);
    };
    const Values in { 0.0, 1.0, 2.0 }, out { 0.0, -1.0, -2.0 };
    CHECK (turned (in, in) == std::tuple (0u, in, in));
    CHECK (turned (out, in) == std::tuple (1u, in, in));
    CHECK (turned (in, out) == std::tuple (1u, in, in));
    CHECK (turned (out, out) == std::tuple (2u, in, in));
    const Values noisy { 0.01, -1.0, -2.0 }, approach { -5.0, -2.0, 0.1 }, both { -1.0, 0.5, 2.0 };
    CHECK (std::get<0> (turned (noisy, in)) == 1);
    CHECK (turned (approach, in) == std::tuple (0u, approach, in));   // in the air first, as deform.plane has it
    CHECK (turned (approach, out) == std::tuple (1u, approach, in));
    CHECK (turned (both, both) == std::tuple (0u, both, both));
    CHECK (turned ({}, out) == std::tuple (1u, Values {}, in));
    CHECK (std::get<0> (turned ({ 0.0, 0.0 }, { 0.0, 0.0 })) == 0);
    const auto& strokes = host::infoOf (host::FitKind::friction).columns;   // there, the force has both signs, or that of the only stroke
    host::RecordedColumns stroke { { "position", out }, { "force", out }, { "load", { -3.0, -3.0, -3.0 } } };
    CHECK (host::orient (strokes, stroke).turned == std::set<std::string> { "load" });
    CHECK (stroke["force"] == out);
    CHECK (stroke["position"] == out);
    CHECK (stroke["load"] == Values { 3.0, 3.0, 3.0 });
}

TEST_CASE ("a press is recognised and fitted on whatever scale its place and its force were recorded", "[fit]")
{
    const std::vector<Press> presses {
        { .from = 0.0, .way = 1.0 },
        { .from = 30.0 },                              // a height, 30 to 22 mm
        { .from = 0.0, .air = 1.0 },                   // a height, 1 mm to -8 mm
        { .from = 1.0 },                               // touches at 1 mm, goes on to -7 mm
        { .from = -30.0, .way = 1.0 },                 // from below
        { .from = 120.0, .way = 1.0 },                 // the travel of a machine
        { .from = 30.0, .force_sign = -1.0 },          // the force on the sensor
        { .from = 22.0, .air = 5.0, .noise = 5e-3 },   // comes through the air
        { .from = 9.0, .way = 1.0, .air = 9.0 },       // a travel that begins in the air
        { .header = "force_N,height_mm", .from = 30.0, .has_force_first = true },
        { .header = "Load (N),Extension (mm)", .from = 12.0, .way = 1.0, .has_force_first = true },
    };
    for (auto press : presses)
        for (const bool back : { false, true })
        {
            press.comes_back = back;
            INFO (press.header << " from " << press.from << ", way " << press.way << ", force " << press.force_sign);
            INFO ("air " << press.air << ", back " << back);
            CHECK (host::guessKind (press.table()) == host::FitKind::curve);
            const auto made = press.fitted();
            CHECK (made.report.is_good);
            CHECK (deepestOf (made) == Approx (8e-3).margin (4e-4));   // within half the distance of two points of the curve
            CHECK (made.report.picture.curves.front().y.back() == Approx (1.5).epsilon (0.02));
            const auto seen = host::pictureOf (host::FitKind::curve, press.table(), {});
            CHECK (seen.turned.contains ("depth") == (press.way < 0.0));
            CHECK (seen.turned.contains ("force") == (press.force_sign < 0.0));
            const auto isSaid = [] (const std::string& note) { return note.find ("sign was turned") != note.npos; };
            CHECK ((press.way > 0.0 || std::ranges::any_of (made.report.notes, isSaid)));
        }
}

TEST_CASE ("what was done to the zero of a depth is said in the scale of the recording, and a given touch counts", "[fit]")
{
    const auto notes = Press { .from = 30.0 }.fitted().report.notes;
    CHECK (std::ranges::count (notes, "the depth falls while the force grows; its sign was turned") == 1);
    CHECK (std::ranges::count (notes, "the depth is counted from 30 mm of the recording, where the force begins") == 1);
    host::FitSettings settings;
    settings.touch = 29e-3;
    CHECK (deepestOf (Press { .from = 30.0 }.fitted (settings)) == Approx (7e-3).margin (1e-4));
    // A zero that can be the touch stays, also if the force begins softly or a little later.
    for (const double place : { 0.0, -0.5, 0.3 })
        for (const auto& note : Press { .from = place, .way = 1.0, .air = 2.0 }.fitted().report.notes)
            CHECK (note.find ("counted from") == note.npos);
}

TEST_CASE ("the user turns a sign, or keeps it, against the recording", "[fit]")
{
    const Press press { .from = 30.0, .comes_back = true };
    for (const bool turned : { false, true })
    {
        host::FitSettings settings;
        settings.columns.turned["depth"] = turned;
        const auto seen = host::pictureOf (host::FitKind::curve, press.table(), settings);
        CHECK (seen.turned.contains ("depth") == turned);
        CHECK (bool (host::fitRecording (host::FitKind::curve, press.table(), "press.csv", settings)) == turned);
    }
    host::FitSettings pulled;
    pulled.columns.turned["force"] = true;
    const auto refused = host::fitRecording (host::FitKind::curve, press.table(), "press.csv", pulled);
    REQUIRE_FALSE (refused);
    CHECK (refused.error().id.starts_with ("fit/"));
}

TEST_CASE ("a sample that bursts is a cut, a soft body on which the tool rests is none", "[fit]")
{
    const auto kindOf = [] (bool bursts) {
        const TemporaryFolder folder;
        const auto file = folder / "recording.csv";
        std::ofstream (file) << test::table ("height_mm,force_N", 400, [bursts] (std::ostream& out, int i) {
            const double depth = bursts || i < 200 ? 0.02 * i : 4.0, rests = bursts || i < 200 ? 0.0 : 0.3 * (1.0 - std::exp (-0.03 * (i - 200)));
            out << 30.0 - depth << ',' << (bursts && i > 200 ? 2.0 : 2.0 * depth) * (1.0 - rests);
        });
        auto read = host::readRecording (file);
        REQUIRE (read);
        return host::guessKind (*read);
    };
    CHECK (kindOf (true) == host::FitKind::blade);
    CHECK (kindOf (false) == host::FitKind::curve);
}

TEST_CASE ("any columns can be oriented, and their numbers only change sign and zero", "[fit][property]")
{
    const auto& columns = host::infoOf (host::FitKind::curve).columns;
    test::property ("any columns", [&] (const Values& depth, const Values& force) {
        host::RecordedColumns recorded { { "depth", depth }, { "force", force } };
        const auto did = host::orient (columns, recorded, {}, { .is_looked_for = true });
        RC_ASSERT (recorded["depth"].size() == depth.size());
        for (std::size_t i = 0; i < force.size(); ++i)
            RC_ASSERT (std::isnan (force[i]) || recorded["force"][i] == (did.turned.contains ("force") ? -force[i] : force[i]));
    });
}
