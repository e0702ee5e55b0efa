// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/sketch.hpp"

#include <host/app/model/fragment.hpp>
#include <tactus/graph/edit.hpp>

#include <catch2/catch.hpp>

using namespace tactus;
using namespace tactus::host;
using tactus::test::Sketch;

TEST_CASE ("the corner of copied text is the minimum of its node positions", "[fragment]")
{
    auto sketch = Sketch {}.node ("a", "signal.constant").node ("b", "signal.gain").node ("c", "signal.abs");
    auto& g = sketch.graph;
    std::set<graph::Id> all;
    for (auto& n : g.root.nodes)
        all.insert (n.id = static_cast<graph::Id> (all.size() + 1));
    CHECK_FALSE (cornerOf (fragmentOf (g, "", all).root));
    CHECK_FALSE (readCopied ("no graph at all"));

    g.root.nodes[0].extra["ui"]["at"] = Json::array ({ 40.0, 300.0 });
    g.root.nodes[1].extra["ui"]["at"] = Json::array ({ 200.0, -16.0 });
    CHECK (cornerOf (fragmentOf (g, "", all).root) == juce::Point<double> (40.0, -16.0));

    std::set<graph::Id> made;
    const auto pasted = paste (g, "", fragmentOf (g, "", all), { 60.0, 116.0 }, made);
    REQUIRE (pasted);
    const auto& batch = std::get<graph::Batch> (pasted->edit);
    CHECK (std::get<graph::AddNode> (batch.commands[0].edit).node.extra.at ("ui").at ("at") == Json::array ({ 100.0, 416.0 }));
}

TEST_CASE ("a paste ends, however large the positions are", "[fragment]")
{
    auto g = Sketch {}.node ("a", "signal.constant").graph;
    g.root.nodes[0].id = 1;
    g.root.nodes[0].extra["ui"]["at"] = Json::array ({ 1e300, -1e300 });
    std::set<graph::Id> made;
    CHECK (paste (g, "", fragmentOf (g, "", { 1 }), {}, made));
    CHECK (made.size() == 1);
}
