// SPDX-License-Identifier: MIT

#include "support/chance_hand.hpp"
#include "support/sketch.hpp"

#include "support/live.hpp"
#include <host/base/assets/file_assets.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/kit/geometry/nearest_by_boxes.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <thread>

using namespace tactus;

namespace
{
std::vector<std::shared_ptr<const graph::Graph>> presets()
{
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator (std::filesystem::path (TACTUS_SOURCE_DIR) / "graphs"))
        if (entry.path().extension() == ".json") files.push_back (entry.path());
    std::ranges::sort (files);
    std::vector<std::shared_ptr<const graph::Graph>> all;
    for (const auto& file : files)
        all.push_back (std::make_shared<const graph::Graph> (loadGraph (file).graph));
    return all;
}
}   // namespace

TEST_CASE ("switching presets as fast as possible under a trembling hand never causes a step in the force", "[graphs][live]")
{
    const auto graphs = presets();
    host::FileAssets assets;
    CompileOptions options { .rate_hz = 4000.0, .assets = &assets, .services = { .nearest_triangle = nearestByBoxes } };
    const auto first = std::ranges::find (graphs, std::string ("Dry wood"), [] (const auto& g) { return g->name; });
    REQUIRE (first != graphs.end());
    test::Live live { **first, catalogue(), options, compile (**first, catalogue(), options).plan };
    test::ChanceHand hand (5);
    live.engine().attach ("stylus", hand);

    std::atomic<bool> over = false;
    std::atomic<int> switched = 0;
    int steps = 0, moved = 0;   // written by the tick thread; read after it is joined
    {
        std::jthread ticking ([&, plan = static_cast<const Plan*> (&live.engine().plan())]() mutable {
            while (! over)
            {
                const auto before = hand.last;
                live.engine().tick();
                moved += before.force != hand.last.force;
                if (plan != &live.engine().plan())
                {
                    ++switched;
                    // The force may change on a role that the switch does not touch: an earlier fade may still be running.
                    const auto& roles = live.engine().plan().roles();
                    const auto role = std::ranges::find (roles, "stylus", &Plan::RoleUse::name);
                    steps += role != roles.end() && ! role->untouched && hand.last.force != before.force;
                }
                plan = &live.engine().plan();
            }
        });
        for (int round = 0; round < 4; ++round)
            for (const auto& graph : graphs)
            {
                const int seen = switched;
                const auto messages = live.perform (graph::ReplaceGraph { graph });
                INFO (graph->name << ": " << test::text (messages));
                CHECK_FALSE (hasErrors (messages));
                if (hasErrors (messages)) continue;
                while (switched == seen)
                    std::this_thread::yield();
            }
        over = true;
    }
    CHECK (switched == 4 * static_cast<int> (graphs.size()));
    CHECK (steps == 0);
    CHECK (moved > switched);
}
