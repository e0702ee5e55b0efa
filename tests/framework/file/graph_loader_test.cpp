// SPDX-License-Identifier: MIT
#include <tactus/file/graph_file.hpp>

#include <support/temporary_folder.hpp>

#include <catch2/catch.hpp>

#include <fstream>
#include <sstream>

using namespace tactus;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace
{
/// A temporary folder of graphs.
class Folder : public TemporaryFolder
{
public:
    fs::path put (const std::string& name, const std::string& text) const
    {
        fs::create_directories ((*this / name).parent_path());
        write (name, text);
        return *this / name;
    }

    /// Writes a graph that includes other graphs.
    fs::path putIncluding (const std::string& name, std::initializer_list<const char*> others) const
    {
        std::string nodes;
        for (const auto* other : others)
            nodes += std::string (nodes.empty() ? "" : ", ") + "\n\"n" + std::to_string (nodes.size()) + R"(": { "type": "file:)" + other + "\" }";
        return put (name, R"({ "format": "tactus-graph", "version": 1, "nodes": {)" + nodes + " } }");
    }

    std::size_t files() const { return static_cast<std::size_t> (std::distance (fs::directory_iterator (path()), {})); }
};

std::string contents (const fs::path& path)
{
    std::ostringstream text;
    text << std::ifstream (path, std::ios::binary).rdbuf();
    return text.str();
}
}   // namespace

TEST_CASE ("included files are found relative to the file that includes them")
{
    const Folder folder;
    folder.put ("parts/wave.json", R"({ "format": "tactus-graph", "version": 1, "name": "wave" })");
    folder.putIncluding ("parts/grain.json", { "wave.json" });
    const auto loaded = loadGraph (folder.putIncluding ("main.json", { "parts/grain.json", "parts/wave.json" }));
    REQUIRE (loaded.messages.empty());
    const auto& files = loaded.graph.files;
    REQUIRE (files.size() == 2);
    CHECK (files.at ("parts/wave.json")->name == "wave");
    CHECK (files.at ("parts/grain.json")->files.at ("wave.json") == files.at ("parts/wave.json"));
    CHECK (fs::path (loaded.graph.folder) == folder.path());
}

TEST_CASE ("a graph file that cannot be read is reported with the reason")
{
    const Folder folder;
    auto loaded = loadGraph (folder / "missing.json");
    REQUIRE (loaded.messages.size() == 1);
    CHECK (loaded.messages[0].id == "file/unreadable");
    CHECK_THAT (loaded.messages[0].text, Contains ("missing.json") && Contains ("No such file"));
    CHECK_THAT (loaded.messages[0].file, Contains ("missing.json"));

    loaded = loadGraph (folder.path());
    REQUIRE (loaded.messages.size() == 1);
    CHECK_THAT (loaded.messages[0].text, Contains ("folder"));

    loaded = loadGraph (folder.putIncluding ("main.json", { "missing.json" }));
    REQUIRE (loaded.messages.size() == 1);
    CHECK (loaded.messages[0].id == "file/unreadable");
    CHECK (loaded.messages[0].where == "/nodes/n0/type");
    CHECK (loaded.messages[0].line == 2);
    CHECK_THAT (loaded.messages[0].file, Contains ("main.json"));
}

TEST_CASE ("problems in an included file are reported with its name and the place in it")
{
    const Folder folder;
    folder.put ("part.json", "{ \"format\": \"tactus-graph\", \"version\": 1,\n \"rate_hz\": 0 }");
    folder.put ("broken.json", "{ \"format\": ");
    const auto loaded = loadGraph (folder.putIncluding ("main.json", { "part.json", "broken.json" }));
    REQUIRE (loaded.messages.size() == 2);
    CHECK (loaded.messages[0].id == "file/bad_value");
    CHECK_THAT (loaded.messages[0].file, Contains ("part.json"));
    CHECK (loaded.messages[0].line == 2);
    CHECK (loaded.messages[1].id == "file/syntax");
    CHECK_THAT (loaded.messages[1].file, Contains ("broken.json"));
}

TEST_CASE ("files that include each other are refused, and the chain is shown")
{
    const Folder folder;
    folder.putIncluding ("b.json", { "sub/../c.json" });
    folder.putIncluding ("c.json", { "b.json" });
    fs::create_directory (folder / "sub");
    const auto loaded = loadGraph (folder.putIncluding ("a.json", { "b.json" }));
    REQUIRE (loaded.messages.size() == 1);
    CHECK (loaded.messages[0].id == "file/cycle");
    CHECK_THAT (loaded.messages[0].text, Contains ("b.json -> c.json -> b.json"));
    CHECK_THAT (loaded.messages[0].file, Contains ("c.json"));

    const auto itself = loadGraph (folder.putIncluding ("self.json", { "self.json" }));
    REQUIRE (itself.messages.size() == 1);
    CHECK_THAT (itself.messages[0].text, Contains ("self.json -> self.json"));
}

TEST_CASE ("the length of a chain of included files is limited")
{
    const Folder folder;
    for (int i = 0; i < 50; ++i)
        folder.putIncluding (std::to_string (i) + ".json", { (std::to_string (i + 1) + ".json").c_str() });
    const auto loaded = loadGraph (folder / "0.json");
    REQUIRE (loaded.messages.size() == 1);
    CHECK (loaded.messages[0].id == "file/too_deep");
}

TEST_CASE ("a graph is saved completely or not at all")
{
    const Folder folder;
    graph::Graph g;
    g.name = "Saved";
    const auto path = folder / "graph.json";
    CHECK (saveGraph (g, path));
    CHECK (contents (path) == writeGraph (g));
    CHECK (folder.files() == 1);

    SECTION ("replaces an older file, keeping its permissions and links")
    {
        fs::permissions (path, fs::perms::owner_read | fs::perms::owner_write);
        fs::create_symlink (path, folder / "link.json");
        g.name = "Again";
        CHECK (saveGraph (g, folder / "link.json"));
        CHECK (contents (path) == writeGraph (g));
        CHECK (fs::is_symlink (folder / "link.json"));
        CHECK (fs::status (path).permissions() == (fs::perms::owner_read | fs::perms::owner_write));
        CHECK (folder.files() == 2);
    }
    SECTION ("fails if the folder does not exist")
    {
        const auto done = saveGraph (g, folder / "nowhere/graph.json");
        REQUIRE_FALSE (done);
        CHECK (done.error().id == "output/unwritable");
        CHECK_THAT (done.error().text, Contains ("nowhere") && Contains ("there is no folder"));
    }
    SECTION ("fails if the target is a folder, and nothing is left behind")
    {
        fs::create_directory (folder / "folder");
        const auto done = saveGraph (g, folder / "folder");
        REQUIRE_FALSE (done);
        CHECK_THAT (done.error().text, Contains ("it is a folder"));
        CHECK (folder.files() == 2);
    }
}
