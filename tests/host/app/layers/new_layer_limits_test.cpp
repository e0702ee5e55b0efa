// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/layers/mixer.hpp>
#include <host/app/limits/limit_list.hpp>

#include <tactus/file/graph_file.hpp>
#include <tactus/graph/edit.hpp>

#include <catch2/catch.hpp>

using namespace tactus;
using namespace tactus::host;

namespace
{
LimitList limitsNow (const graph::Graph& g)
{
    FileAssets assets;
    return limitsOf ({ g, 0.0, limitRolesOf (g, {}, {}) }, catalogue(), assets);
}
}   // namespace

TEST_CASE ("a new layer breaks no limit at its initial level", "[layers][limits]")
{
    for (const char* preset : { "dry_wood.json", "soft_pad.json", "aluminium_bar.json" })
    {
        const auto loaded = loadGraph (std::string (TACTUS_SOURCE_DIR "/graphs/") + preset).graph;
        const auto before = limitsNow (loaded).broken();
        for (const auto& kind : layerKinds())
        {
            INFO (preset << ' ' << kind.type);
            auto graph = loaded;
            auto mixer = addMixer (graph, catalogue());
            REQUIRE (mixer);
            REQUIRE (graph::apply (graph, mixer->command));
            auto layer = addLayer (graph, mixer->place, catalogue(), kind.type);
            REQUIRE (layer);
            REQUIRE (graph::apply (graph, layer->command));
            const auto after = limitsNow (graph);
            REQUIRE (after.is_checked);
            for (const auto& l : after.limits)
                UNSCOPED_INFO (l.text);
            CHECK (after.broken() <= before);
        }
    }
}
