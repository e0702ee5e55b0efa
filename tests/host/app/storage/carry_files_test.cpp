// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/storage/carry_files.hpp>

#include "support/temporary_folder.hpp"

#include <tactus/file/graph_file.hpp>

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

constexpr auto pen_graph = R"({"format": "tactus-graph", "version": 1, "nodes": {}, "wires": [], "devices": {"pen": {"driver": "trace", "path": ")";
}   // namespace

TEST_CASE ("saving a graph in another folder copies the files it names")
{
    TemporaryFolder to;
    const auto graph = loadGraph (liver).graph;
    CHECK (writeGraph (carriedTo (to.path(), graph)) == writeGraph (graph));
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
        CHECK (meshOf (carriedTo (to.path(), graph)) == "assets/liver_2.obj");
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
    CHECK (writeGraph (carriedTo (to.path(), outer)) == writeGraph (outer));
    CHECK (to.textOf ("parts/inner.json") == inner);
    CHECK (to.textOf ("parts/tap.wav") == "sound");

    to.write ("parts/tap.wav", "another sound");
    fs::remove (to / "parts/inner.json");
    CHECK (writeGraph (carriedTo (to.path(), outer)) == writeGraph (outer));
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
        const auto path = penOf (carriedTo (to / folder, graph));
        INFO (path);
        CHECK (fs::path (path).is_relative());
        CHECK (fs::equivalent (to / folder / path, from / "pen.csv"));
    }
    CHECK (penOf (carriedTo (from.path(), graph)) == "pen.csv");   // beside it
    CHECK_FALSE (fs::exists (to / "pen.csv"));
}

TEST_CASE ("a link that leads to nothing is replaced by the copy, not followed")
{
    TemporaryFolder from, to, outside;
    from.write ("pen.csv", "t,x\n");
    from.write ("g.json", pen_graph + std::string (R"(pen.csv"}}})"));
    fs::create_symlink (outside / "not_yet", to / "pen.csv");
    CHECK (penOf (carriedTo (to.path(), loadGraph (from / "g.json").graph)) == "pen.csv");
    CHECK (outside.isEmpty());
    CHECK (to.textOf ("pen.csv") == "t,x\n");
}

TEST_CASE ("texts that name no file, and files that are named by their whole path, are left alone")
{
    TemporaryFolder from, to;
    from.write ("pen.csv", "t,x\n");
    for (const auto& path : { std::string ("stroke"), std::string ("none.csv"), (from / "pen.csv").string(), std::string (2000, 'x') })
    {
        from.write ("g.json", pen_graph + path + R"("}}})");
        CHECK (penOf (carriedTo (to.path(), loadGraph (from / "g.json").graph)) == path);
    }
    CHECK (to.isEmpty());
}
