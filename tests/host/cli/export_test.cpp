// SPDX-License-Identifier: GPL-3.0-or-later

#include "program.hpp"

#include <catch2/catch.hpp>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

using namespace tactus::test;

namespace
{
/// A graph file with one node of this type.
std::string graphOf (const std::string& type)
{
    return R"({ "format": "tactus-graph", "version": 2, "devices": {}, "nodes": { "a": { "type": ")" + type + R"(" } }, "wires": [] })";
}
}   // namespace

TEST_CASE ("an exported folder builds and passes its self-test alone", "[cli][export]")
{
    const Scratch scratch;
    const auto folder = scratch.path ("dry_wood");
    const auto ran = runTactus ({ "export", TACTUS_SOURCE_DIR "/graphs/dry_wood.json", "-o", folder });
    INFO (ran.err);
    REQUIRE (ran.status == 0);
    CHECK (ran.err.empty());
    CHECK (ran.out.find ("DryWood") != std::string::npos);
    for (const auto* file : { "dry_wood.hpp", "dry_wood.cpp", "CMakeLists.txt",
                              "Makefile", "README.md", "LICENSE", "tactus/nodes/friction/elasto_plastic.hpp" })
        CHECK (std::filesystem::exists (folder + "/" + file));

    const auto said = scratch.path ("said");
    const auto make = "make -s -C '" + folder + "' test CXXFLAGS='-O0 -Wall -Wextra -Werror' > '" + said + "' 2>&1";
    const int status = std::system (make.c_str());
    INFO (textOf (said));
    CHECK (status == 0);
    CHECK (textOf (said).find ("0 allocations from the heap") != std::string::npos);

    // README.md says what the compiler says.
    const auto measured = std::system (("make -s -C '" + folder + "' memory CXXFLAGS=-O0 > '" + said + "' 2>&1").c_str());
    const auto memory = textOf (said), readme = textOf (folder + "/README.md");
    INFO (memory);
    CHECK (measured == 0);
    const auto after = [] (const std::string& text, const std::string& key) {
        const auto at = text.find (key);
        return at == text.npos ? 0ul : std::strtoul (text.c_str() + text.find_first_of ("0123456789", at + key.size()), nullptr, 10);
    };
    CHECK (after (readme, "the object, `static DryWood graph` |") == after (memory, "graph: "));
    CHECK (after (readme, "`DryWood::Inputs`, which you keep |") == after (memory, "in: "));
    CHECK (after (readme, "`DryWood::Outputs`, which you keep |") == after (memory, "out: "));
    CHECK (memory.find ("DryWood::tick") != memory.npos);
    unsigned long code = 0, data = 0, zeros = 0;
    const auto sizes = memory.find ('\n', memory.find ("code and tables"));
    REQUIRE (std::sscanf (memory.c_str() + sizes, "%lu %lu %lu", &code, &data, &zeros) == 3);
    CHECK (code > 10000);
    CHECK (data + zeros < 128);   // the object is the only variable
}

TEST_CASE ("export replaces only its own folders, and writes nothing if something is wrong", "[cli][export]")
{
    const Scratch scratch;
    const auto folder = scratch.path ("out");
    const auto graph = scratch.write ("g.json", graphOf ("signal.constant"));
    checkRefused ({ "export", graph, "-o", folder, "--to", "arduino" }, 1, "export/role", folder);
    checkRefused ({ "export", graph, "-o", folder, "--to", "cpq" }, 2, "cpp", folder);
    checkRefused ({ "export", graph }, 2, "--out", folder);
    checkRefused ({ "export", scratch.path ("none.json"), "-o", folder }, 1, "none.json", folder);
    const auto unknown = scratch.write ("u.json", graphOf ("my.node"));
    checkRefused ({ "export", unknown, "-o", folder }, 1, "my.node", folder);

    REQUIRE (runTactus ({ "export", graph, "-o", folder, "--record", "a.out" }).status == 0);
    CHECK (textOf (folder + "/g.hpp").find ("a_out") != std::string::npos);
    std::filesystem::copy_file (graph, folder + "/mine.json");
    REQUIRE (runTactus ({ "export", graph, "-o", folder, "--set", "a.value=3", "--record", "a.out" }).status == 0);
    CHECK (textOf (folder + "/g.cpp").find ("a.params.value, 3.0") != std::string::npos);
    CHECK (std::filesystem::exists (folder + "/mine.json"));

    const auto other = scratch.path ("other");
    std::filesystem::create_directories (other);
    std::filesystem::copy_file (graph, other + "/mine.json");
    checkRefused ({ "export", graph, "-o", other }, 1, "is not empty", other + "/g.hpp");
    CHECK (std::filesystem::exists (other + "/mine.json"));
}

TEST_CASE ("export says that the configuration of a SmartKnob is gone", "[cli][export]")
{
    const Scratch scratch;
    const auto none = scratch.path ("none");
    checkRefused ({ "export", TACTUS_SOURCE_DIR "/graphs/dry_wood.json", "-o", none, "--to", "smartknob" }, 2, "no longer exported", none);
}

TEST_CASE ("export writes and deletes nothing outside of its folder", "[cli][export]")
{
    namespace fs = std::filesystem;
    const Scratch scratch;
    const auto folder = scratch.path ("proj"), graph = scratch.write ("g.json", graphOf ("signal.constant"));
    fs::create_directories (folder + ".new");
    std::ofstream (folder + ".new/mine") << "precious";
    REQUIRE (runTactus ({ "export", graph, "-o", folder, "--record", "a.out" }).status == 0);
    CHECK (textOf (folder + ".new/mine") == "precious");

    const auto outside = scratch.write ("outside", "precious"), listed = scratch.write ("listed", "precious");
    fs::remove (folder + "/g.hpp");
    fs::create_symlink (outside, folder + "/g.hpp");
    fs::create_directory_symlink ("..", folder + "/up");
    std::ofstream (folder + "/tactus_export.txt", std::ios::app) << "up/listed\n";
    const auto ran = runTactus ({ "export", graph, "-o", folder, "--record", "a.out" });
    INFO (ran.err);
    CHECK (ran.status == 0);
    CHECK (textOf (outside) == "precious");
    CHECK (textOf (listed) == "precious");
    CHECK_FALSE (fs::is_symlink (folder + "/g.hpp"));

    fs::create_directory_symlink (folder, scratch.path ("link"));
    checkRefused ({ "export", graph, "-o", scratch.path ("link") }, 1, "symbolic link", scratch.path ("none"));
    checkRefused ({ "new-node", "mylab", "wood", folder, "--only-write" }, 1, "is not empty", folder + "/wood.hpp");
}

TEST_CASE ("export --float writes a class without doubles, and no C or FMU interface", "[cli][export]")
{
    const Scratch scratch;
    const auto folder = scratch.path ("small");
    checkRefused ({ "export", TACTUS_SOURCE_DIR "/graphs/soft_pad.json", "-o", folder, "--float", "--to", "fmu" }, 1, "export/float", folder);
    const auto large = scratch.write ("large.json", R"({ "format": "tactus-graph", "version": 2, "devices": {},
        "nodes": { "a": { "type": "signal.constant", "params": { "value": 1e100 } } }, "wires": [] })");
    checkRefused ({ "export", large, "-o", folder, "--float" }, 1, "1e+100", folder);

    REQUIRE (runTactus ({ "export", TACTUS_SOURCE_DIR "/graphs/soft_pad.json", "-o", folder, "--float" }).status == 0);
    const auto header = textOf (folder + "/soft_pad.hpp"), source = textOf (folder + "/soft_pad.cpp");
    CHECK (header.find ("static constexpr float rate_hz = ") != std::string::npos);
    for (const auto& text : { header, source })
        CHECK (text.find ("double") == std::string::npos);
    CHECK (textOf (folder + "/tactus/kit/fine.hpp").find ("using Fine = Extended;") != std::string::npos);
    CHECK (textOf (folder + "/README.md").find ("tactus::Extended::steps") != std::string::npos);
    CHECK_FALSE (std::filesystem::exists (folder + "/tactus/kit/math/exp.hpp"));
}
