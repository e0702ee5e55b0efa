// SPDX-License-Identifier: GPL-3.0-or-later
#include "program.hpp"

#include <tactus/file/csv.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>

using namespace tactus;

TEST_CASE ("the liver drags with a tenth of the push, at its edges with a third more or less, with either tool and between them", "[graphs]")
{
    constexpr double rate = 4000.0, deepest = 0.0086;   // at 8.6 mm the fingertip feels 6 N, the largest force of the preset
    const test::Scratch scratch;
    const std::string names[] { "t", "liver.position.x", "liver.position.y", "liver.position.z", "liver.tool" };
    auto feed = TableWriter::create (scratch.path ("feed.csv"), names);
    REQUIRE (feed);
    int tick = 0;
    for (const double tool : { 0.0, 0.5, 1.0 })   // their radii: 8, 5 and 2 mm
        for (const double depth : { 0.0002, 0.001, 0.002, 0.004, 0.006, deepest })
            for (int k = -200; k < 1000; ++k)   // down, and then 2 cm to the side
            {
                const double down = std::min (1.0, (k + 200) / 200.0);
                REQUIRE (feed->row (std::vector { tick++ / rate, 2e-5 * std::max (0, k), 0.0, 0.002 - (depth + 0.002) * down + 0.008 - 0.006 * tool, tool }));
            }
    REQUIRE (feed->commit());

    const std::vector<std::string> outputs { "liver.force.x", "liver.force.y", "liver.force.z", "liver.resistance", "liver.state", "liver.depth" };
    const std::string liver = TACTUS_SOURCE_DIR "/graphs/liver.json";
    std::vector<std::string> arguments { "render", liver, "--out", scratch.path ("out.csv"), "--feed", scratch.path ("feed.csv") };
    for (const auto& output : outputs)
        arguments.insert (arguments.end(), { "--record", output });
    const auto ran = test::runTactus (arguments);
    INFO (ran.err);
    REQUIRE (ran.status == 0);

    const auto table = readTable (std::filesystem::path (scratch.path ("out.csv")));
    REQUIRE (table);
    std::vector<double> ratios;
    double hardest = 0.0;
    for (std::size_t r = 0; r < table->rows(); ++r)
    {
        const auto value = [&] (std::size_t i) { return table->at (r, *table->column (outputs[i])); };
        if (value (4) != 2.0 || value (5) < 1.5e-3) continue;   // not slipping, or shallow: there, the slope of the mesh also pushes sideways
        const double all2 = value (0) * value (0) + value (1) * value (1) + value (2) * value (2), push = value (3);
        ratios.push_back (std::sqrt (std::max (0.0, all2 - push * push)) / push);
        hardest = std::max (hardest, push);
    }
    REQUIRE (ratios.size() > 8000);
    CHECK (hardest > 4.0);
    std::ranges::sort (ratios);
    CHECK (ratios[ratios.size() / 2] == Approx (0.1).epsilon (0.1));
    CHECK (ratios.front() > 0.06);
    CHECK (ratios.back() < 0.14);
}
