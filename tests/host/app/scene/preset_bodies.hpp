// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/scene/bodies.hpp>
#include <host/base/assets/file_assets.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/plan/compile.hpp>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace tactus::host::test
{

inline graph::Graph presetGraph (const std::string& name)
{
    auto loaded = loadGraph (std::filesystem::path (TACTUS_SOURCE_DIR) / "graphs" / (name + ".json"));
    if (hasErrors (loaded.messages)) throw std::runtime_error (loaded.messages.front().text);
    return std::move (loaded.graph);
}

inline std::vector<scene::Body> bodiesOf (const graph::Graph& graph)
{
    FileAssets assets;
    const auto compiled = compile (graph, catalogue(), { .assets = &assets });
    if (! compiled.plan) throw std::runtime_error ("the graph does not compile");
    return scene::bodiesOf (*compiled.plan);
}

inline std::vector<scene::Body> bodiesIn (const std::string& preset) { return bodiesOf (presetGraph (preset)); }

}   // namespace tactus::host::test
