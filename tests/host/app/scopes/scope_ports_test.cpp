// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/scopes/scope_ports.hpp>

#include <host/app/run/traces.hpp>
#include <host/base/assets/file_assets.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/graph/edit.hpp>
#include <tactus/graph/history.hpp>
#include <tactus/plan/compile.hpp>

#include <filesystem>

using namespace tactus;
using namespace tactus::host;

namespace
{
const std::filesystem::path folder = std::filesystem::path (TACTUS_SOURCE_DIR) / "graphs";

graph::Graph load (const std::string& name) { return std::move (loadGraph (folder / (name + ".json")).graph); }

const ScopeSpec& of (const std::vector<ScopeSpec>& all, ScopeKind kind)
{
    const auto at = std::ranges::find (all, kind, &ScopeSpec::kind);
    REQUIRE (at != all.end());
    return *at;
}
}   // namespace

TEST_CASE ("scopes: every listed port can be recorded under its name, in every preset", "[app][scopes]")
{
    for (const auto& entry : std::filesystem::directory_iterator (folder))
    {
        if (entry.path().extension() != ".json") continue;
        INFO (entry.path().filename().string());
        const auto loaded = loadGraph (entry.path());
        FileAssets assets;
        CompileOptions options { .assets = &assets };
        for (const auto& p : scopePorts (loaded.graph, catalogue()))
            options.records.push_back (p.name);
        REQUIRE_FALSE (options.records.empty());
        const auto compiled = compile (loaded.graph, catalogue(), options);
        REQUIRE (compiled.plan);
        for (const auto& m : compiled.messages)
            CHECK_FALSE (m.where.starts_with ("record "));
        for (const auto& port : options.records)
        {
            INFO (port);
            CHECK (std::ranges::any_of (compiled.plan->taps(), [&] (const Tap& t) { return isPartOf (t.name, port); }));
        }
    }
}

TEST_CASE ("scopes: every preset has suggested scopes, with ports that exist", "[app][scopes]")
{
    for (const auto& entry : std::filesystem::directory_iterator (folder))
    {
        if (entry.path().extension() != ".json") continue;
        INFO (entry.path().filename().string());
        const auto loaded = loadGraph (entry.path());
        const auto ports = scopePorts (loaded.graph, catalogue());
        const auto all = suggestedScopes (loaded.graph, catalogue());
        CHECK (all.size() >= 2);
        for (const auto& s : all)
            for (const auto& p : portsOf (s, energyPorts (ports)))
            {
                INFO (p);
                CHECK (PortNames (ports).has (p));
            }
    }
}

TEST_CASE ("scopes: those that are suggested for a preset can all be recorded at once", "[app][scopes]")
{
    for (const auto& entry : std::filesystem::directory_iterator (folder))
    {
        if (entry.path().extension() != ".json") continue;
        INFO (entry.path().filename().string());
        const auto loaded = loadGraph (entry.path());
        FileAssets assets;
        CompileOptions options { .assets = &assets };
        const auto energies = energyPorts (scopePorts (loaded.graph, catalogue()));
        for (const auto& s : suggestedScopes (loaded.graph, catalogue()))
            for (const auto& p : portsOf (s, energies))
                if (std::ranges::count (options.records, p) == 0) options.records.push_back (p);
        const auto compiled = compile (loaded.graph, catalogue(), options);
        REQUIRE (compiled.plan);
        CHECK (compiled.plan->taps().size() <= ProbeRing::most);
    }
}

TEST_CASE ("scopes: of several instances, a scope that can show only one shows the first", "[app][scopes]")
{
    const auto all = suggestedScopes (load ("two_fingers"), catalogue());
    CHECK (of (all, ScopeKind::time).ports == std::vector<std::string> { "finger/motor.applied" });
    const auto& over = of (all, ScopeKind::over);
    CHECK (over.x == "finger[0]/hand.position");
    CHECK (over.y == "finger[0]/skin.force");
    CHECK (over.state == "finger[0]/skin.state");
    CHECK (stateFor ("finger[1]/skin.force", scopePorts (load ("two_fingers"), catalogue())) == "finger[1]/skin.state");
    CHECK (suggestedScope (ScopeKind::tool, load ("two_fingers"), catalogue()).node == "finger[0]/skin");
    CHECK (std::ranges::count (all, ScopeKind::energy, &ScopeSpec::kind) == 0);
}

TEST_CASE ("scopes: for Dry wood, the force on the hand, friction against displacement, and energy are suggested", "[app][scopes]")
{
    const auto all = suggestedScopes (load ("dry_wood"), catalogue());
    CHECK (of (all, ScopeKind::time).ports == std::vector<std::string> { "motor.applied" });
    const auto& over = of (all, ScopeKind::over);
    CHECK (over.x == "hand.position");
    CHECK (over.y == "drag.force");
    CHECK (over.state == "drag.state");
    const auto& energy = of (all, ScopeKind::energy);
    const auto energies = energyPorts (scopePorts (load ("dry_wood"), catalogue()));
    CHECK (energies == std::vector<std::string> { "board.stored_energy", "board.dissipated_energy", "drag.stored_energy", "drag.dissipated_energy" });
    CHECK (portsOf (energy, energies).size() == energies.size() + 2);
    CHECK (energy.x == "hand.position");
    CHECK (energy.y == "motor.applied");
    CHECK (suggestedScope (ScopeKind::tool, load ("dry_wood"), catalogue()).node == "drag");
}

TEST_CASE ("scopes: nothing is suggested for an empty graph", "[app][scopes]")
{
    CHECK (suggestedScopes ({}, catalogue()).empty());
    CHECK (portsOf (suggestedScope (ScopeKind::tool, {}, catalogue()), {}).empty());
}

TEST_CASE ("scopes: a scope follows a renamed node, and keeps the name of a removed one", "[app][scopes]")
{
    graph::History edits (load ("dry_wood"));
    ScopeModel model;
    for (auto& s : suggestedScopes (edits.graph(), catalogue()))
        model.scopes.push_back (std::make_unique<ScopeSpec> (std::move (s)));
    model.scopes.push_back (std::make_unique<ScopeSpec> (suggestedScope (ScopeKind::tool, edits.graph(), catalogue())));
    const auto& over = *model.scopes[1];
    const auto edit = [&] (graph::Command command) {
        const auto before = scopePorts (edits.graph(), catalogue());
        REQUIRE (edits.perform (std::move (command), graph::Step::own));
        follow (model, before, scopePorts (edits.graph(), catalogue()));
    };
    edit (graph::RenameNode { "", "drag", "rub" });
    CHECK (over.y == "rub.force");
    CHECK (over.state == "rub.state");
    CHECK (model.scopes.back()->node == "rub");
    edit (graph::RemoveNode { "", "rub" });
    CHECK (over.y == "rub.force");
    CHECK_FALSE (PortNames (scopePorts (edits.graph(), catalogue())).has (over.y));
    CHECK (PortNames (scopePorts (edits.graph(), catalogue())).has (over.x));
}
