// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/waiting.hpp"

#include <host/app/run/asset_load.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/kit/geometry/nearest_by_boxes.hpp>

#include <catch2/catch.hpp>

#include <filesystem>

using namespace tactus;
using namespace tactus::host;

TEST_CASE ("what was loaded on another thread serves the next compilation, and its memory is given back", "[app][files]")
{
    const auto* file = TACTUS_SOURCE_DIR "/graphs/assets/liver.obj";
    const auto graph = loadGraph (TACTUS_SOURCE_DIR "/graphs/liver.json").graph;
    CHECK (assetBytes (graph) >= static_cast<double> (std::filesystem::file_size (file)));
    AssetLoad load;
    load.start (graph, catalogue());
    std::shared_ptr<const AssetLoad::Loaded> loaded;
    REQUIRE (tactus::test::eventually ([&] { return (loaded = load.take()) != nullptr; }));
    CHECK_FALSE (load.isRunning());
    REQUIRE (loaded->compiled.plan);

    FileAssets assets;
    const auto mesh = [&] { return *assets.mesh (file); };
    assets.adopt (loaded->assets);
    const auto shared = mesh();
    CHECK (shared.use_count() > 1);   // the plan of the other thread uses the same one
    const auto compiled = compile (graph, catalogue(), { .assets = &assets, .services = { .nearest_triangle = nearestByBoxes } });
    REQUIRE (compiled.plan);
    CHECK (compiled.messages.size() == loaded->compiled.messages.size());
    load.start (graph, catalogue());
    load.cancel();
    CHECK (load.take() == nullptr);
}
