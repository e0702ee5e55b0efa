// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/storage/carry_files.hpp>

#include "support/temporary_folder.hpp"

#include <tactus/file/graph_file.hpp>

using namespace tactus;
using namespace tactus::host;
namespace fs = std::filesystem;

TEST_CASE ("saving a graph in another folder copies the files it names")
{
    TemporaryFolder to;
    const auto graph = loadGraph (std::string (TACTUS_SOURCE_DIR) + "/graphs/liver.json").graph;
    CHECK (carryFiles (graph, to.path()).empty());
    CHECK (fs::file_size (to / "assets/liver.obj") == fs::file_size (std::string (TACTUS_SOURCE_DIR) + "/graphs/assets/liver.obj"));
}

TEST_CASE ("a file that already exists is not overwritten")
{
    TemporaryFolder to;
    fs::create_directories (to / "assets");
    to.write ("assets/liver.obj", "mine");
    carryFiles (loadGraph (std::string (TACTUS_SOURCE_DIR) + "/graphs/liver.json").graph, to.path());
    CHECK (to.textOf ("assets/liver.obj") == "mine");
}

TEST_CASE ("the files named by an included graph are copied too")
{
    TemporaryFolder from, to;
    fs::create_directories (from / "parts");
    from.write ("parts/tap.wav", "sound");
    from.write ("parts/inner.json", R"({"format": "tactus-graph", "version": 1, "wires": [],
        "nodes": {"w": {"type": "vibration.wavetable", "settings": {"table": {"wav": "tap.wav"}}}}})");
    from.write ("outer.json", R"({"format": "tactus-graph", "version": 1, "nodes": {"in": {"type": "file:parts/inner.json"}}, "wires": []})");
    CHECK (carryFiles (loadGraph (from / "outer.json").graph, to.path()).empty());
    CHECK (fs::exists (to / "parts/inner.json"));
    CHECK (to.textOf ("parts/tap.wav") == "sound");
}

TEST_CASE ("a file outside the graph's folder is not copied, and is reported")
{
    TemporaryFolder from, to;
    fs::create_directories (from / "sub");
    fs::create_directories (to / "sub");
    from.write ("pen.csv", "t,x\n");
    from.write ("sub/g.json", R"({"format": "tactus-graph", "version": 1, "nodes": {}, "wires": [],
        "devices": {"pen": {"driver": "trace", "path": "../pen.csv"}}})");
    CHECK (carryFiles (loadGraph (from / "sub/g.json").graph, to / "sub") == std::vector<std::string> { "../pen.csv" });
    CHECK_FALSE (fs::exists (to / "pen.csv"));
}

TEST_CASE ("a link that leads to nothing is replaced by the copy, not followed")
{
    TemporaryFolder from, to, outside;
    from.write ("pen.csv", "t,x\n");
    from.write ("g.json", R"({"format": "tactus-graph", "version": 1, "nodes": {}, "wires": [],
        "devices": {"pen": {"driver": "trace", "path": "pen.csv"}}})");
    fs::create_symlink (outside / "not_yet", to / "pen.csv");
    CHECK (carryFiles (loadGraph (from / "g.json").graph, to.path()).empty());
    CHECK (outside.isEmpty());
    CHECK (to.textOf ("pen.csv") == "t,x\n");
}
