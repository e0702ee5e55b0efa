// SPDX-License-Identifier: MIT
#include "load.hpp"
#include "support/sketch.hpp"
#include "support/tested_types.hpp"

#include <catch2/catch.hpp>

#include <host/base/assets/file_assets.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/kit/geometry/nearest_by_boxes.hpp>
#include <tactus/run/device/make_device.hpp>

#include <algorithm>
#include <filesystem>

using namespace tactus;
namespace fs = std::filesystem;

namespace
{
const fs::path folder = fs::path (TACTUS_SOURCE_DIR) / "graphs";

/// The forces and torques that the guards let through in the first 2 s, with the devices that the graph describes.
std::vector<double> forcesOf (const graph::Graph& g, const Catalogue& types)
{
    host::FileAssets assets;
    auto [plan, messages] = compile (g, types, { .assets = &assets, .services = { .nearest_triangle = nearestByBoxes } });
    INFO (test::text (messages));
    REQUIRE (plan);
    std::vector<MadeDevice> devices;   // outlives the engine
    Engine engine { std::move (plan) };
    for (const auto& role : engine.plan().roles())
        devices.push_back (makeDevice (*g.device (role.name), folder));
    for (std::size_t i = 0; i < devices.size(); ++i)
        engine.attach (engine.plan().roles()[i].name, *devices[i].device, devices[i].limits);

    std::vector<double> all;
    for (int k = 0; k < static_cast<int> (2.0 * g.rate_hz); ++k)
    {
        engine.tick();
        for (const auto& role : engine.plan().roles())
            for (const auto* part : { &role.state->applied.force, &role.state->applied.torque })
                all.insert (all.end(), part->data(), part->data() + 3);
    }
    return all;
}
}   // namespace

TEST_CASE ("a preset gives the same bits with nodes from a plugin", "[plugins][graphs]")
{
    std::vector<NodeType> guests (test::testedTypes().begin(), test::testedTypes().end());
    const auto types = catalogue().with (std::move (guests));
    int presets = 0;
    for (const auto& entry : fs::directory_iterator (folder))
    {
        if (entry.path().extension() != ".json") continue;
        const auto loaded = loadGraph (entry.path());
        INFO (entry.path().stem().string());
        ++presets;
        const auto forces = forcesOf (loaded.graph, catalogue());
        CHECK (forcesOf (loaded.graph, types) == forces);
        CHECK (std::ranges::any_of (forces, [] (double f) { return f != 0.0; }));   // the tool touches something by then
    }
    CHECK (presets > 10);
}
