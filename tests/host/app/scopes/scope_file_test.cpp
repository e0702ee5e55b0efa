// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/desk_rig.hpp"
#include "scope_bench.hpp"

#include <host/app/scopes/scope_file.hpp>
#include <support/property.hpp>
#include <tactus/file/graph_file.hpp>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::Bench;
using tactus::host::test::DeskRig;

namespace
{
Json withScopes (Json scopes)
{
    Json ui;
    ui["scopes"] = std::move (scopes);
    return ui;
}
}   // namespace

TEST_CASE ("scopes: what a file keeps of them is read as it was written", "[app][scopes]")
{
    ScopeSpec over;
    over.kind = ScopeKind::over;
    over.x = "hand.position";
    over.y = "drag.force";
    over.state = "drag.state";
    over.component = 1;
    over.seconds = 2.5;
    over.share = 0.5;
    ScopeSpec time;
    time.ports = { "motor.force", "fingers[2]/drag.force" };
    time.trigger = { ScopeTrigger::Edge::falling, -0.25 };
    ScopeSpec spectrum;
    spectrum.kind = ScopeKind::spectrum;
    spectrum.in_decibels = false;
    ScopeSpec tool;
    tool.kind = ScopeKind::tool;
    tool.node = "drag";
    tool.has_normal = true;
    const std::vector<ScopeSpec> all { over, time, spectrum, tool };
    CHECK (readScopes (withScopes (writeScopes (all))) == all);
    CHECK (readScopes (withScopes (Json::array())) == std::vector<ScopeSpec> {});
    CHECK_FALSE (readScopes (Json()));
}

TEST_CASE ("scopes: whatever a file says about them, what is read can be shown", "[app][scopes]")
{
    const auto ui = withScopes (*Json::tryParse (R"([ 3, {}, { "kind": "radar" },
        { "kind": "time", "seconds": -1e300, "share": 1e300, "component": 77, "ports": [ 1, "", "no.port" ], "edge": "sideways", "level": "high" },
        { "kind": "spectrogram", "up_to_hz": -5, "ports": "motor.force", "decibels": 3 }, { "kind": "tool", "node": [] } ])"));
    const auto scopes = readScopes (ui);
    REQUIRE (scopes);
    REQUIRE (scopes->size() == 3);
    CHECK (scopes->front().seconds == ScopeSpec::least_s);
    CHECK (scopes->front().component == 2);
    CHECK (scopes->front().ports == std::vector<std::string> { "", "no.port" });

    Bench b;
    auto graph = b.document.graph();
    graph.extra["ui"]["scopes"] = ui.at ("scopes");
    b.document.open (graph, {}, "open");
    b.panel->showOwn();
    CHECK (b.panel->shown().size() == 3);
    b.panel->refresh();
    CHECK (b.panel->createComponentSnapshot (b.panel->getLocalBounds()).isValid());
}

TEST_CASE ("the scopes that the user adds, closes or sets are saved with the graph, and others are not", "[app][scopes][files]")
{
    TemporaryFolder folder;
    const auto file = folder / "mine.json";
    std::filesystem::copy_file (TACTUS_SOURCE_DIR "/graphs/dry_wood.json", file);
    const auto kinds = [] (const graph::Graph& g) {
        std::vector<ScopeKind> all;
        for (const auto& s : readScopes (g.extra.value ("ui", Json())).value_or (std::vector<ScopeSpec> {}))
            all.push_back (s.kind);
        return all;
    };
    {
        DeskRig r (file.string());
        auto& scopes = r.make<ScopePanel> (scopesPanel);
        r.panel->restore();
        const auto save = [&] {
            auto written = r.document.graph();
            r.panel->keep (written);
            REQUIRE (r.document.save (file, written).empty());
        };
        save();
        CHECK_FALSE (readScopes (loadGraph (file).graph.extra.value ("ui", Json())));
        scopes.add (ScopeKind::spectrum);
        save();
        CHECK (kinds (loadGraph (file).graph) == std::vector { ScopeKind::time, ScopeKind::over, ScopeKind::energy, ScopeKind::spectrum });
    }
    {
        DeskRig r (file.string());
        auto& scopes = r.make<ScopePanel> (scopesPanel);
        r.panel->restore();
        CHECK (scopes.shown().size() == 4);
        CHECK (scopes.shown().back()->shown().kind == ScopeKind::spectrum);
    }
}
