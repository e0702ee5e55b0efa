// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/storage/carry_files.hpp>

#include "support/temporary_folder.hpp"

#include <host/base/assets/file_assets.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/plan/compile.hpp>
#include <tactus/run/device/make_device.hpp>

#include <catch2/catch.hpp>

using namespace tactus;
using namespace tactus::host;
namespace fs = std::filesystem;

namespace
{
const std::string liver = TACTUS_SOURCE_DIR "/graphs/liver.json";

std::string meshOf (const graph::Graph& g)
{
    for (const auto& n : g.root.nodes)
        if (n.settings.contains ("surface")) return n.settings["surface"]["mesh"].get<std::string>();
    return {};
}

std::string penOf (const graph::Graph& g) { return (*g.device ("pen"))["path"].get<std::string>(); }

/// Saves the graph elsewhere, and returns what its file there says.
graph::Graph savedIn (const fs::path& folder, const graph::Graph& g)
{
    auto carried = carriedTo (folder, g);
    REQUIRE (copyInto (folder, carried.files));
    return std::move (carried.graph);
}

constexpr auto pen_graph = R"({"format": "tactus-graph", "version": 1, "nodes": {}, "wires": [], "devices": {"pen": {"driver": "trace", "path": ")";
}   // namespace

TEST_CASE ("saving a graph in another folder copies the files it names")
{
    TemporaryFolder to;
    const auto graph = loadGraph (liver).graph;
    CHECK (writeGraph (savedIn (to.path(), graph)) == writeGraph (graph));
    CHECK (fs::file_size (to / "assets/liver.obj") == fs::file_size (std::string (TACTUS_SOURCE_DIR) + "/graphs/assets/liver.obj"));
}

TEST_CASE ("a file that already exists is not overwritten: the copy gets another name, once")
{
    TemporaryFolder to;
    fs::create_directories (to / "assets");
    to.write ("assets/liver.obj", "mine");
    const auto graph = loadGraph (liver).graph;
    for (int i = 0; i < 2; ++i)
    {
        CHECK (meshOf (savedIn (to.path(), graph)) == "assets/liver_2.obj");
        CHECK (to.textOf ("assets/liver.obj") == "mine");
        CHECK (fs::file_size (to / "assets/liver_2.obj") == fs::file_size (std::string (TACTUS_SOURCE_DIR) + "/graphs/assets/liver.obj"));
        CHECK_FALSE (fs::exists (to / "assets/liver_3.obj"));
    }
}

TEST_CASE ("the files named by an included graph are copied too")
{
    TemporaryFolder from, to;
    fs::create_directories (from / "parts");
    from.write ("parts/tap.wav", "sound");
    const std::string inner = R"({"format": "tactus-graph", "version": 1, "wires": [],
        "nodes": {"w": {"type": "vibration.wavetable", "settings": {"table": {"wav": "tap.wav"}}}}})";
    from.write ("parts/inner.json", inner);
    from.write ("outer.json", R"({"format": "tactus-graph", "version": 1, "nodes": {"in": {"type": "file:parts/inner.json"}}, "wires": []})");
    const auto outer = loadGraph (from / "outer.json").graph;
    CHECK (writeGraph (savedIn (to.path(), outer)) == writeGraph (outer));
    CHECK (to.textOf ("parts/inner.json") == inner);
    CHECK (to.textOf ("parts/tap.wav") == "sound");

    to.write ("parts/tap.wav", "another sound");
    fs::remove (to / "parts/inner.json");
    CHECK (writeGraph (savedIn (to.path(), outer)) == writeGraph (outer));
    CHECK (to.textOf ("parts/tap_2.wav") == "sound");
    CHECK (loadGraph (to / "parts/inner.json").graph.root.find ("w")->settings["table"]["wav"] == "tap_2.wav");
}

TEST_CASE ("a file outside the graph's folder stays where it is, and the path leads there, also through a link")
{
    TemporaryFolder from, to;
    for (const auto* folder : { &from, &to })
        fs::create_directories (*folder / "sub");
    from.write ("pen.csv", "t,x\n");
    from.write ("sub/g.json", pen_graph + std::string (R"(../pen.csv"}}})"));
    fs::create_directory_symlink (to / "sub", to / "link");
    const auto graph = loadGraph (from / "sub/g.json").graph;
    for (const auto* folder : { "sub", "link", "not_yet" })
    {
        fs::create_directories (to / folder);
        const auto path = penOf (savedIn (to / folder, graph));
        INFO (path);
        CHECK (fs::path (path).is_relative());
        CHECK (fs::equivalent (to / folder / path, from / "pen.csv"));
    }
    CHECK (penOf (savedIn (from.path(), graph)) == "pen.csv");   // beside it
    CHECK_FALSE (fs::exists (to / "pen.csv"));
}

TEST_CASE ("a link in the way of a copy is neither followed nor replaced")
{
    TemporaryFolder from, to, outside;
    fs::create_directories (from / "assets");
    from.write ("pen.csv", "t,x\n");
    from.write ("assets/pen.csv", "t,x\n");
    fs::create_symlink (outside / "not_yet", to / "pen.csv");
    fs::create_directory_symlink (outside.path(), to / "assets");
    from.write ("g.json", pen_graph + std::string (R"(pen.csv"}}})"));
    CHECK (penOf (savedIn (to.path(), loadGraph (from / "g.json").graph)) == "pen_2.csv");
    from.write ("g.json", pen_graph + std::string (R"(assets/pen.csv"}}})"));
    const auto path = penOf (savedIn (to.path(), loadGraph (from / "g.json").graph));
    CHECK (fs::equivalent (to / path, from / "assets/pen.csv"));
    CHECK (outside.isEmpty());
    CHECK (fs::is_symlink (to / "pen.csv"));
    CHECK (to.textOf ("pen_2.csv") == "t,x\n");
}

TEST_CASE ("names of gestures, and files that are named by their whole path, are left alone")
{
    TemporaryFolder from, to;
    from.write ("pen.csv", "t,x\n");
    for (const auto& path : { std::string ("stroke"), (from / "pen.csv").string(), std::string (2000, 'x') })
    {
        from.write ("g.json", pen_graph + path + R"("}}})");
        CHECK (penOf (savedIn (to.path(), loadGraph (from / "g.json").graph)) == path);
    }
    CHECK (to.isEmpty());
}

TEST_CASE ("a graph that is saved elsewhere reads what it read before, or nothing as before")
{
    TemporaryFolder place;
    for (const auto* folder : { "from/sub", "far/away", "to/deeper" })
        fs::create_directories (place / folder);
    const std::string stroke = "t,x,y,z\n0,0,0,0\n1,0,0,0.01\n";
    place.write ("from/pen.csv", stroke);
    place.write ("from/sub/pen.csv", stroke);
    place.write ("pen.csv", stroke);
    place.write ("far/away/real.csv", stroke);
    place.write ("far/pen.csv", stroke);
    place.write ("to/deeper/none.csv", stroke);   // of another graph: nothing must be read that was missing before
    fs::create_symlink (place / "far/away/real.csv", place / "from/linked.csv");
    fs::create_directory_symlink (place / "far/away", place / "from/link");

    for (const auto& path : { std::string ("pen.csv"), std::string ("./pen.csv"), std::string ("sub/../pen.csv"), std::string ("sub/pen.csv"), std::string ("../pen.csv"),
                              std::string ("linked.csv"), std::string ("link/real.csv"), std::string ("link/../pen.csv"), std::string ("none.csv"),
                              (place / "pen.csv").string(), std::string ("nowhere/none.csv") })
    {
        INFO (path);
        place.write ("from/g.json", pen_graph + path + R"("}}})");
        const auto saved = penOf (savedIn (place / "to/deeper", loadGraph (place / "from/g.json").graph));
        INFO (saved);
        CHECK (fs::exists (place / "from" / path) == fs::exists (place / "to/deeper" / saved));
        const auto before = makeDevice ({ { "driver", "trace" }, { "path", path } }, place / "from");
        const auto after = makeDevice ({ { "driver", "trace" }, { "path", saved } }, place / "to/deeper");
        CHECK ((before.device != nullptr) == (after.device != nullptr));
    }
    CHECK_FALSE (fs::exists (place / "to/deeper/linked.csv"));   // it stays where it is, as what it leads to does
    CHECK_FALSE (fs::exists (place / "to/deeper/link"));
}

TEST_CASE ("each preset and template that is saved elsewhere compiles there as it does here, even if its own folder is gone")
{
    int with_files = 0;
    for (const auto* folder : { "/graphs", "/graphs/templates" })
        for (const auto& entry : fs::directory_iterator (TACTUS_SOURCE_DIR + std::string (folder)))
        {
            if (entry.path().extension() != ".json") continue;
            INFO (entry.path());
            TemporaryFolder to;
            const auto graph = loadGraph (entry.path()).graph;
            auto carried = carriedTo (to.path(), graph);
            REQUIRE (copyInto (to.path(), carried.files));
            with_files += ! carried.files.empty();
            CHECK (writeGraph (carried.graph) == writeGraph (graph));
            REQUIRE (saveGraph (carried.graph, to / "g.json"));
            FileAssets assets;
            CHECK_FALSE (hasErrors (compile (loadGraph (to / "g.json").graph, catalogue(), { .assets = &assets }).messages));
        }
    CHECK (with_files > 5);
}
