// SPDX-License-Identifier: MIT
// The state of a run with nodes from plugins. every_node_test.cpp examines each of their nodes alone.
#include "load.hpp"
#include "support/sketch.hpp"
#include "support/temporary_folder.hpp"

#include <catch2/catch.hpp>

#include <tactus/kit/state_archive.hpp>
#include <tactus/run/run.hpp>

#include <algorithm>
#include <fstream>

using namespace tactus;
namespace fs = std::filesystem;

namespace
{
/// A run with a node in C++ and one in C, from plugins, and with one that is compiled in.
class CountingRun
{
public:
    explicit CountingRun (const fs::path& in_c) : types (catalogue().with (typesOf ({ test::pluginFile ("live_node"), in_c })))
    {
        test::Sketch s;
        s.node ("hand", "device.position").node ("grow", "live.growing", { { "slope", "1 N" } }).node ("swing", "signal.lfo").node ("count", "c.twice");
        graph = s.wire ("hand.position -> grow.position").wire ("swing.out -> count.in").graph;
        run.emplace (types, CompileOptions { .rate_hz = 1000.0 });
        INFO (test::text (run->load (graph)));
        REQUIRE (run->hasEngine());
    }

    std::vector<std::byte> save()
    {
        auto state = run->save (graph);
        if (state) return *state;
        FAIL (state.error().text);
        return {};
    }

    Result<> restore (std::span<const std::byte> state) { return run->restore (state, graph); }

    void tick (int n)
    {
        for (int i = 0; i < n; ++i)
            run->tick();
    }

    graph::Graph graph;
    Catalogue types;
    std::optional<Run> run;

private:
    static std::vector<NodeType> typesOf (const std::vector<fs::path>& plugins)
    {
        auto loaded = loadPlugins (plugins, catalogue());
        INFO (test::text (loaded.messages));
        REQUIRE (loaded.types.size() == plugins.size());
        return std::move (loaded.types);
    }
};
}   // namespace

TEST_CASE ("a run with nodes from plugins goes on from a saved state with the same bits, also in another run", "[plugins][state]")
{
    CountingRun run { test::pluginFile ("saves") }, other { test::pluginFile ("saves") };
    run.tick (100);
    other.tick (33);
    const auto state = run.save();
    CHECK (run.save() == state);   // saving changes nothing
    run.tick (50);
    const auto after = run.save();
    CHECK (after != state);
    for (auto* again : { &other, &run })
    {
        REQUIRE (again->restore (state));
        CHECK (again->save() == state);
        again->tick (50);
        CHECK (again->save() == after);
    }
}

TEST_CASE ("a node of a plugin that has no functions for its state is named, and nothing is saved", "[plugins][state]")
{
    CountingRun run { test::pluginFile ("in_c") };
    run.tick (10);
    const auto state = run.run->save (run.graph);
    REQUIRE_FALSE (state);
    CHECK (state.error().id == "state/refused");
    CHECK (state.error().text.find ("'count'") != std::string::npos);
    CHECK (state.error().remedy.find ("list its state") != std::string::npos);
}

TEST_CASE ("a state of another build of a plugin is refused, and changes nothing", "[plugins][state]")
{
    const TemporaryFolder folder;
    const auto copy = folder / "saves.tactus";
    fs::copy_file (test::pluginFile ("saves"), copy);
    CountingRun same { copy };
    const auto later = folder / "later.tactus";
    fs::copy_file (copy, later);
    std::ofstream (later, std::ios::binary | std::ios::app) << "more";
    CountingRun run { test::pluginFile ("saves") }, newer { later };
    run.tick (20);
    CHECK (same.restore (run.save()));
    const auto before = newer.save();
    const auto refused = newer.restore (run.save());
    REQUIRE_FALSE (refused);
    CHECK (refused.error().id == "state/graph");
    CHECK (refused.error().text.find ("another build") != std::string::npos);
    CHECK (newer.save() == before);
}

TEST_CASE ("a plugin can refuse the bytes of a state, and its reason is told", "[plugins][state]")
{
    const auto loaded = test::load ("saves");
    REQUIRE (loaded.types.size() == 1);
    const auto& type = loaded.types.front();
    const auto node = type.make();
    std::vector<std::byte> bytes;
    StateArchive archive { bytes };
    type.serialize (node.get(), archive);
    REQUIRE (bytes.size() == 4 + 8 + 8);   // the build, the length, a double
    bytes[4] = std::byte { 7 };
    StateArchive shorter { std::span<const std::byte> (bytes) };
    type.serialize (node.get(), shorter);
    CHECK (shorter.refusal().find ("another size") != std::string::npos);
    bytes[4] = std::byte { 9 };
    StateArchive longer { std::span<const std::byte> (bytes) };
    type.serialize (node.get(), longer);
    CHECK (longer.refusal().find ("more bytes") != std::string::npos);
}
