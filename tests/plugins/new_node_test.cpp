// SPDX-License-Identifier: MIT
// `tactus new-node` as a newcomer uses it, from the folder in which Tactus was built.
#include "load.hpp"

#include <catch2/catch.hpp>

#include <host/cli/program.hpp>

#include <cstdlib>
#include <fstream>
#include <utility>

using namespace tactus;

namespace
{
/// What a command prints, and whether it succeeds.
std::pair<bool, std::string> run (const test::Scratch& scratch, const std::string& command)
{
    const auto said = scratch.path ("said");
    const bool is_right = std::system (("(" + command + ") > '" + said + "' 2>&1").c_str()) == 0;
    return { is_right, test::textOf (said) };
}
}   // namespace

TEST_CASE ("a node that new-node writes builds from the build tree, is exported, and says what is wrong with it after a mistake", "[plugins]")
{
    const test::Scratch scratch;
    const auto folder = scratch.path ("rough_wood"), header = folder + "/rough_wood.hpp";
    const auto made = test::runTactus ({ "new-node", "mylab", "rough_wood", folder });
    INFO (made.out << made.err);
    REQUIRE (made.status == 0);
    CHECK (made.out.find ("100% tests passed") != std::string::npos);
    const auto listed = test::runTactus ({ "nodes", "mylab.rough_wood", "--plugins", folder + "/build" });
    CHECK (listed.status == 0);
    CHECK (listed.out.find ("Pushes the tool out") != std::string::npos);

    const auto graph = scratch.write ("g.json", R"({ "format": "tactus-graph", "version": 2, "rate_hz": 1000, "devices": { "stylus": { "driver": "sim" } },
        "nodes": { "hand": { "type": "device.position", "role": "stylus" }, "wood": { "type": "mylab.rough_wood" },
                   "motor": { "type": "device.force", "role": "stylus" } },
        "wires": ["hand.position -> wood.position", "wood.force -> motor.force"] })");
    const auto exported = test::runTactus ({ "export", graph, "--plugins", folder + "/build", "-o", scratch.path ("out") });
    INFO (exported.err);
    REQUIRE (exported.status == 0);
    const auto tested = run (scratch, "make -s -C '" + scratch.path ("out") + "' test CXXFLAGS=-O0");
    INFO (tested.second);
    CHECK (tested.first);

    const auto text = test::textOf (header);
    const std::pair<std::string, std::string> mistakes[] { { "const noexcept", "const" }, { "Params params;", "Params params;\n    void update() {}" } };
    const std::string reasons[] { "mylab::RoughWood is not a node: `tick` is not noexcept", "mylab::RoughWood: `update` would never be called" };
    for (std::size_t i = 0; i < std::size (mistakes); ++i)
    {
        auto wrong = text;
        wrong.replace (wrong.find (mistakes[i].first), mistakes[i].first.size(), mistakes[i].second);
        std::ofstream (header) << wrong;
        const auto built = run (scratch, "cmake --build '" + folder + "/build' --target rough_wood");
        INFO (built.second);
        CHECK_FALSE (built.first);
        CHECK (built.second.find (reasons[i]) != std::string::npos);
    }
}
