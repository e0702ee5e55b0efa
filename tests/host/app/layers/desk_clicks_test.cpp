// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/window_rig.hpp"

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::WindowRig;

TEST_CASE ("three textures and a vibration are composed with a few clicks", "[layers]")
{
    const auto* preset = GENERATE ("dry_wood.json", "granite_wall.json", "scissors_cloth.json");
    WindowRig w (preset);
    w.click ("Layers");
    const auto mixers = mixersOf (w.graph());
    REQUIRE (mixers.empty());
    const auto steps = w.view->document().history().names().size();
    w.click ("+ Texture");
    const auto mixer = mixersOf (w.graph()).front();
    w.click ("+ Texture");
    w.click ("+ Recorded");
    w.click ("+ Vibration");
    CHECK (w.clicks <= 8);

    const auto& graph = w.graph();
    const auto compiled = compile (graph, catalogue());
    CHECK (compiled.plan != nullptr);
    std::vector<std::string> added;
    for (const auto& n : graph.root.nodes)
        if (n.type.starts_with ("texture.") || n.type.starts_with ("vibration.")) added.push_back (n.type);
    const int layers = layersOf (*findMixer (graph, mixer), catalogue());
    for (int i = layers - 4; i < layers; ++i)
        CHECK (wireInto (graph, mixer, i) != nullptr);
    CHECK (added.size() >= 4);
    CHECK (w.view->document().history().names().size() == steps + 4);   // one undo step for each
}
