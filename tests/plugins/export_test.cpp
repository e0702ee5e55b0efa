// SPDX-License-Identifier: MIT
// `tactus export` of a graph with a node from a plugin: its header is copied if it is at hand, and never anything else.
#include "load.hpp"

#include <catch2/catch.hpp>

#include <host/cli/program.hpp>

#include <cstdlib>
#include <fstream>

using namespace tactus;
namespace fs = std::filesystem;

namespace
{
const std::string header_name = "live_node.hpp", header_text = test::textOf (TACTUS_SOURCE_DIR "/tests/plugins/objects/live_node.hpp");

/// A folder with the plugin, as somebody else would install it, and a graph with its node.
class Installed
{
public:
    Installed()
    {
        fs::create_directories (path ("lib/tactus/plugins"));
        fs::create_directories (path ("include/tactus/plugins"));
        fs::copy_file (test::pluginFile ("live_node"), plugins / "live_node.tactus");
        graph = scratch.write ("growing.json", R"({ "format": "tactus-graph", "version": 2, "rate_hz": 1000, "devices": { "stylus": { "driver": "sim" } },
            "nodes": { "hand": { "type": "device.position", "role": "stylus" }, "grow": { "type": "live.growing", "params": { "slope": 2.0 } },
                       "motor": { "type": "device.force", "role": "stylus" } },
            "wires": ["hand.position -> grow.position", "grow.force -> motor.force"] })");
    }

    fs::path path (const std::string& name) const { return scratch.path (name); }
    void put (const fs::path& file, const std::string& text) const { std::ofstream (file) << text; }

    test::Ran exported (std::vector<std::string> more = {}) const
    {
        more.insert (more.begin(), { "export", graph, "--plugins", plugins.string(), "-o", out });
        return test::runTactus (more);
    }

    /// Checks that nothing is exported, and that the message has these words.
    void refused (const std::vector<std::string>& words) const
    {
        const auto ran = exported();
        INFO (ran.err);
        CHECK (ran.status == 1);
        CHECK (ran.err.find ("export/plugin") != std::string::npos);
        for (const auto& word : words)
            CHECK (ran.err.find (word) != std::string::npos);
        CHECK_FALSE (fs::exists (out));
    }

    /// Exports the graph, and runs its self-test, which compares it with the plugin.
    void passes (std::vector<std::string> more = {}) const
    {
        const auto ran = exported (std::move (more));
        INFO (ran.err);
        REQUIRE (ran.status == 0);
        CHECK (fs::exists (out + "/plugins/live_node/live_node.hpp"));
        const auto said = scratch.path ("said");
        const int status = std::system (("make -s -C '" + out + "' test CXXFLAGS='-O0 -Wall -Wextra -Werror' > '" + said + "' 2>&1").c_str());
        INFO (test::textOf (said));
        CHECK (status == 0);
        CHECK (test::textOf (said).find ("0 allocations from the heap") != std::string::npos);
        fs::remove_all (out);
    }

    const test::Scratch scratch;
    const fs::path plugins = path ("lib/tactus/plugins");
    const std::string out = scratch.path ("out");
    std::string graph;
};
}   // namespace

TEST_CASE ("a node from a plugin is exported with its header from next to the plugin, and computes the same bits", "[plugins][export]")
{
    const Installed at;
    at.refused ({ "'grow' (live.growing)", "no header with it was found in", at.plugins.string(), at.path ("include/tactus/plugins").string() });

    // What the node includes comes along, and what `prepare` takes from the heap lies in the object.
    auto text = header_text;
    const std::string include = "#include <tactus/node/node.hpp>\n", tick = "    Outputs tick (const Inputs&) noexcept";
    REQUIRE (text.find (tick) != text.npos);
    text.replace (text.find (include), include.size(), include + "#include \"parts/start.hpp\"\n");
    fs::create_directories (at.plugins / "parts");
    at.put (at.plugins / "parts/start.hpp", "#pragma once\n#include <tactus/kit/geometry/rotation.hpp>\nnamespace live { constexpr double start = 0.0; }\n");
    at.put (at.plugins / header_name, text);
    at.passes();
    at.passes ({ "--float" });
}

TEST_CASE ("a node from a plugin is exported with its header from where packages install headers", "[plugins][export]")
{
    const Installed at;
    at.put (at.path ("include/tactus/plugins") / header_name, header_text);
    at.put (at.plugins / "other.hpp", "// mentions \"live.growing\", but defines no node\n");
    at.passes();
}

TEST_CASE ("an export takes nothing but the header of the node and what lies next to it", "[plugins][export]")
{
    const Installed at;
    const auto header = at.plugins / header_name;
    const auto with = [&] (const std::string& line) { at.put (header, line + "\n" + header_text); };

    at.put (at.path ("lib/secret.hpp"), "a secret");
    with ("#include \"../../secret.hpp\"");
    at.refused ({ "../../secret.hpp", "outside of its folder" });
    with ("#include \"" + at.path ("lib/secret.hpp").string() + "\"");
    at.refused ({ "secret.hpp", "outside of its folder" });
    with ("#include \"gone.hpp\"");
    at.refused ({ "gone.hpp" });
    with ("#include <tactus/run/run.hpp>");
    at.refused ({ "<tactus/run/run.hpp>" });

    with (std::string (2 << 20, '/'));   // 2 MB
    at.refused ({ "no header with it was found", "larger than 1 MB" });
    with ("");
    fs::permissions (header, fs::perms::others_write, fs::perm_options::add);
    at.refused ({ "no header with it was found" });
    fs::remove (header);
    fs::create_directory (header);
    at.refused ({ "no header with it was found" });

    // A chain of headers that has no end.
    fs::remove (header);
    with ("#include \"h0.h\"");
    for (int i = 0; i < 300; ++i)
        at.put (at.plugins / ("h" + std::to_string (i) + ".h"), "#include \"h" + std::to_string (i + 1) + ".h\"\n");
    at.refused ({ "more than 256 headers" });
}
