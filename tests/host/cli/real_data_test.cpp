// SPDX-License-Identifier: GPL-3.0-or-later
// Published recordings, if they are present. Plots go to build/figures/.

#include "program.hpp"

#include <host/tools/figures/plot.hpp>
#include <tactus/file/assets/table.hpp>
#include <tactus/file/csv.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

using namespace tactus;

namespace
{
std::string figure (const std::string& name)
{
    const auto folder = std::filesystem::path (TACTUS_SOURCE_DIR) / "build" / "figures";
    std::filesystem::create_directories (folder);
    return (folder / name).string();
}

struct Presliding
{
    std::vector<double> t, load, position, friction;   // s, N, m, N on the tool
};

Presliding readPresliding (const std::string& path)
{
    Presliding p;
    std::ifstream in (path);
    std::string line;
    std::getline (in, line);
    while (std::getline (in, line))
    {
        std::istringstream cells (line);
        double t = 0.0, micronewton_load = 0.0, millimetre = 0.0, micronewton = 0.0;
        cells >> t >> micronewton_load >> millimetre >> micronewton;
        p.t.push_back (t);
        p.load.push_back (1e-6 * micronewton_load);
        p.position.push_back (1e-3 * millimetre);
        p.friction.push_back (1e-6 * micronewton);
    }
    return p;
}

/// The energy that a force on the tool takes from the hand.
double work (const std::vector<double>& force, const std::vector<double>& position, std::size_t from)
{
    double w = 0.0;
    for (std::size_t i = from + 1; i < force.size(); ++i)
        w -= 0.5 * (force[i] + force[i - 1]) * (position[i] - position[i - 1]);
    return w;
}
}   // namespace

TEST_CASE ("presliding friction measured under 5 N is reproduced: loop energy within 3 %, force within 0.2 N", "[data]")
{
    const auto folder = test::sharedData ("friction_jchristopherson");
    if (folder.empty()) return;
    const auto measured = readPresliding (folder + "/split/presliding_dev_0_100s.txt");
    REQUIRE (measured.t.size() > 10000);

    const test::Scratch scratch;
    const std::vector<std::string> columns { "t", "drag.position.x", "drag.normal_force" };
    auto feed = TableWriter::create (scratch.path ("feed.csv"), columns);
    REQUIRE (feed);
    for (std::size_t i = 0; i < measured.t.size(); ++i)
        REQUIRE (feed->row (std::vector { measured.t[i], measured.position[i], measured.load[i] }));
    REQUIRE (feed->commit());

    // Fitted manually in mu, d_max and break_away: mu is the measured plateau, and d_max is the width of the loop's
    // shoulders.
    const auto graph = scratch.write ("graph.json", R"({ "format": "tactus-graph", "version": 1, "name": "Presliding", "nodes": {
        "drag": { "type": "friction.elasto_plastic", "params": { "mu": 0.472, "d_max": "60 um", "adhesion": "dupont", "break_away": 0.9 } } }, "wires": [] })");
    const auto ran = test::runTactus ({ "render", graph, "--feed", scratch.path ("feed.csv"), "--record", "drag.force.x", "--out", scratch.path ("out.csv") });
    INFO (ran.err);
    REQUIRE (ran.status == 0);

    const auto table = readTable (std::filesystem::path (scratch.path ("out.csv")));
    REQUIRE (table);
    REQUIRE (table->rows() == measured.t.size());
    std::vector<double> made;
    for (std::size_t i = 0; i < table->rows(); ++i)
        made.push_back (table->at (i, 1));

    std::size_t settled = 0;
    while (measured.t[settled] - measured.t[0] < 20.0)
        ++settled;
    double squares = 0.0;
    for (std::size_t i = settled; i < made.size(); ++i)
        squares += std::pow (made[i] - measured.friction[i], 2);
    const double rms = std::sqrt (squares / static_cast<double> (made.size() - settled));
    const double energy = work (made, measured.position, settled) / work (measured.friction, measured.position, settled);
    WARN ("presliding: force within " << rms << " N rms, loop energy " << 100.0 * (energy - 1.0) << " % off");
    CHECK (rms < 0.20);
    CHECK (energy == Approx (1.0).margin (0.03));

    const double middle = 0.5 * (*std::ranges::min_element (measured.position) + *std::ranges::max_element (measured.position));
    const auto after = [&] (const std::vector<double>& v, double origin) {
        std::vector<double> cut;
        for (std::size_t i = settled; i < v.size(); ++i)
            cut.push_back (v[i] - origin);
        return cut;
    };
    host::Figure picture { .title = "Presliding friction, measured and synthesised" };
    picture.panels.push_back ({ .title = {}, .x = { "displacement", "m" }, .y = { "friction force", "N" }, .series = {} });
    picture.panels[0].series.push_back ({ .label = "measured", .x = after (measured.position, middle), .y = after (measured.friction, 0.0) });
    picture.panels[0].series.push_back ({ .label = "friction.elasto_plastic", .x = after (measured.position, middle), .y = after (made, 0.0) });
    REQUIRE (host::writeFigure (picture, figure ("presliding.png")));
}

TEST_CASE ("strokes drawn on a tablet drive the wood preset with position and pressure", "[data]")
{
    const auto folder = test::sharedData ("strokes_evemu");
    if (folder.empty()) return;
    const test::Scratch scratch;
    int strokes = 0;
    for (const auto& entry : std::filesystem::directory_iterator (folder))
    {
        if (entry.path().extension() != ".events") continue;
        ++strokes;
        INFO (entry.path());
        const auto converted = test::runTactus ({ "convert", entry.path().string(), scratch.path ("trace.csv") });
        INFO (converted.err);
        REQUIRE (converted.status == 0);

        const auto ran = test::runTactus ({ "render", TACTUS_SOURCE_DIR "/graphs/dry_wood.json",
                                            "--device", "stylus=trace:" + scratch.path ("trace.csv"),
                                            "--record", "hand.position,board.resistance,drag.force",
                                            "--out", scratch.path ("out.csv"), "--plot", figure ("wood_" + entry.path().stem().string() + ".png") });
        INFO (ran.err);
        REQUIRE (ran.status == 0);

        const auto table = readTable (std::filesystem::path (scratch.path ("out.csv")));
        REQUIRE (table);
        double resistance = 0.0, drag = 0.0, step = 0.0;
        for (std::size_t r = 0; r < table->rows(); ++r)
        {
            resistance = std::max (resistance, table->at (r, *table->column ("board.resistance")));
            drag = std::max (drag, std::abs (table->at (r, *table->column ("drag.force.x"))) + std::abs (table->at (r, *table->column ("drag.force.y"))));
            if (const auto x = *table->column ("hand.position.x"); r > 0) step = std::max (step, std::abs (table->at (r, x) - table->at (r - 1, x)));
        }
        CHECK (resistance > 0.1);
        CHECK (resistance < 20.0);
        CHECK (step < 0.02);   // a hand moves by less per row; the tablet's jump to 0, 0 is larger
        if (entry.path().string().find ("drag") != std::string::npos) CHECK (drag > 0.05);
    }
    CHECK (strokes >= 2);
}

TEST_CASE ("profilometer files are read unchanged", "[host][assets][table][data]")
{
    const auto folder = test::sharedData ("topography_contactengineering");
    if (folder.empty()) return;

    const auto read = [&] (const std::string& name) { return readers::readGrid (test::textOf (folder + "/" + name), name); };
    const auto dektak = read ("dektak-1.csv"), xy = read ("xy-4.txt");
    INFO ((dektak ? "" : describe (dektak.error())));
    INFO ((xy ? "" : describe (xy.error())));
    REQUIRE (dektak);
    CHECK (dektak->rows == 1);
    CHECK (dektak->columns > 9000);
    CHECK (dektak->values.front() == -0.00933);
    REQUIRE (xy);
    CHECK (xy->rows == 1);
    CHECK (xy->columns > 9000);
    CHECK (xy->values.front() == 0.003581);
}
