// SPDX-License-Identifier: GPL-3.0-or-later
// The self-test of an exported graph compares every output with that of the engine, bit for bit, while parameters and controls move and
// inputs are hit. Here, the self-tests of several graphs run in one program.

#include "exported_code.hpp"

#include <host/generate/code.hpp>
#include <host/generate/sources.hpp>
#include <support/sketch.hpp>
#include <tactus/file/graph_file.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

using namespace tactus;
using test::ExportedProgram;

namespace
{
bool passes (const std::string& said) { return said.starts_with ("passed"); }

/// The largest difference that self-tests print, as a part of the value expected.
double largestDifference (const std::string& said)
{
    std::istringstream lines (said);
    double largest = 0.0;
    for (std::string line; std::getline (lines, line);)
    {
        const auto is = line.find (" is "), expected = line.find (", expected ");
        if (is == line.npos || expected == line.npos) continue;
        const double value = std::strtod (line.c_str() + is + 4, nullptr), wanted = std::strtod (line.c_str() + expected + 11, nullptr);
        largest = std::max (largest, std::abs (value - wanted) / std::max (std::abs (wanted), 1e-9));
    }
    return largest;
}

/// The C++ code of a graph that has to be exportable.
void require (ExportedProgram& program, const host::ExportedFolder& exported, const std::string& name)
{
    INFO (name << ": " << test::text (exported.messages));
    REQUIRE_FALSE (exported.files.empty());
    for (const auto& [path, text] : exported.files)   // a static within a function would lie in the memory of the graph that calls it first
        CHECK (text.find ("static const auto ") == std::string::npos);
    program.add (exported);
}
}   // namespace

TEST_CASE ("exported graphs give the bits of the engine while parameters move", "[export]")
{
    // Sections with other rates, a mesh, a height map, a recording, a subgraph in several instances, a formula, shocks, noise.
    ExportedProgram program;
    for (const auto* name : { "dry_wood", "vibraphone_bar", "two_fingers", "liver", "pebbled_leather", "bronze_bell", "machined_steel", "padded_bench" })
        require (program, test::exportedPreset (name), name);
    for (unsigned seed = 1; seed <= 12; ++seed)
        require (program, test::exportedRandomGraph (seed, 12), "random graph " + std::to_string (seed));

    // A graph with a fault in its code: its self-test has to notice.
    auto broken = test::exportedPreset ("soft_pad");
    auto& source = test::textOf (broken, "soft_pad.cpp");
    const std::string call = "motor.effort()";
    REQUIRE (source.find (call) != std::string::npos);
    source.replace (source.find (call), call.size(), "tactus::Effort { .force = 1.0000000000000002 * motor.effort().force }");
    program.add (broken);

    const auto said = program.run ("c++", "-O0");
    INFO (said);
    std::istringstream lines (said);
    int right = 0, wrong = 0;
    for (std::string line; std::getline (lines, line);)
    {
        if (line.find ("values compared") == std::string::npos) continue;
        const bool is_right = line.ends_with (", 0 differ");
        is_right ? ++right : ++wrong;
        CHECK (is_right != line.starts_with ("soft_pad:"));
    }
    CHECK (right == 20);
    CHECK (wrong == 1);
}

TEST_CASE ("all presets and many random graphs give the bits of the engine with each compiler", "[.export_all]")
{
    const auto* given = std::getenv ("TACTUS_EXPORT_COMPILERS");
    const auto* count = std::getenv ("TACTUS_EXPORT_GRAPHS");
    std::istringstream compilers (given != nullptr ? given : "g++");
    const unsigned graphs = count != nullptr ? static_cast<unsigned> (std::atoi (count)) : 100, graphs_per_program = 20;
    for (std::string compiler; compilers >> compiler;)
    {
        ExportedProgram presets;
        for (const auto& name : test::presetNames())
            require (presets, test::exportedPreset (name), name);
        const auto said = presets.run (compiler, "-O2");
        INFO (compiler << ", " << presets.graphCount() << " presets: " << said);
        CHECK (passes (said));
        for (unsigned first = 1; first <= graphs; first += graphs_per_program)
        {
            ExportedProgram random;
            for (unsigned seed = first; seed < std::min (first + graphs_per_program, graphs + 1); ++seed)
                require (random, test::exportedRandomGraph (seed, 4 + static_cast<int> (seed % 25)), "random graph " + std::to_string (seed));
            const auto answer = random.run (compiler, "-O1");
            INFO (compiler << ", random graphs from " << first << ": " << answer);
            CHECK (passes (answer));
        }
    }
}

TEST_CASE ("presets give the bits of the engine on a Cortex-M7", "[.export_m7]")
{
    // What a small board has, less some for the stack and for everything else. A graph that does not fit is left out, and printed.
    constexpr std::size_t memory = 512 * 1024 - 32 * 1024;
    ExportedProgram program;
    std::string left_out;
    for (const auto& name : test::presetNames())
    {
        auto exported = test::exportedPreset (name);
        const auto& header = test::textOf (exported, exported.stem + ".hpp");
        const std::string block = "tactus::exported::Memory<";
        if (std::stoul (header.substr (header.find (block) + block.size())) > memory)
            left_out += name + " does not fit\n";
        else
            require (program, exported, name);
    }
    const auto said = program.runOnM7 ("-O2");
    WARN (left_out << said);
    CHECK (program.graphCount() >= 30);
    CHECK (said.find ("fault") == said.npos);

    // In the others, some values differ in their last bits (docs/export.md).
    for (const auto* name : { "bronze_bell", "canvas_weave", "celery_stalk", "layered_cloth", "liver_cut", "machined_steel",
                              "notched_rail", "oak_board", "padded_bench", "potato_cut", "potato_edge", "scissors_cloth",
                              "scissors_skin", "singing_glass", "tactile_key", "two_fingers", "vibraphone_bar" })
    {
        const auto line = said.substr (said.find (std::string ("\n") + name + ": ") + 1);
        const auto compared = line.find (" values compared, ");
        INFO (name);
        REQUIRE (compared != line.npos);
        CHECK (line.substr (compared, line.find ('\n', compared) - compared) == " values compared, 0 differ");
    }

    std::istringstream lines (said);
    int compared = 0;
    for (std::string line; std::getline (lines, line);)
        compared += line.find ("values compared") != line.npos ? 1 : 0;
    CHECK (compared == program.graphCount());
    CHECK (largestDifference (said) < 1e-9);
}

TEST_CASE ("an exported graph calls its nodes and values what the patch calls them", "[export]")
{
    const auto read = readGraph (R"({ "format": "tactus-graph", "version": 2, "name": "Names", "devices": {},
        "nodes": { "left": { "type": "signal.constant", "params": { "value": 2 } }, "left_out": { "type": "signal.gain" },
                   "double": { "type": "signal.gain", "params": { "gain": 0.1 } }, "tick": { "type": "signal.add" } },
        "wires": ["left.out -> left_out.in", "left_out.out -> double.in", { "wire": "double.out -> tick.in[0]", "gain": 0.3 }] })");
    auto exported = host::exportGraph (read.graph, { .file = "my names.json", .program = "tactus", .compile = { .records = { "tick.out" } }, .open = {} });
    INFO (test::text (exported.messages));
    REQUIRE_FALSE (exported.files.empty());
    CHECK (exported.class_name == "MyNames");
    CHECK (exported.stem == "my_names");
    const auto& source = test::textOf (exported, "my_names.cpp");
    CHECK (source.find ("// left_out: signal.gain") != std::string::npos);
    CHECK (source.find ("0.3 * double__out.out") != std::string::npos);
    CHECK (source.find ("left_out_2.tick") != std::string::npos);   // `left_out` holds the outputs of `left`
}

TEST_CASE ("names and numbers of exported code", "[export]")
{
    using namespace host;
    CHECK (literal (0.4) == "0.4");
    CHECK (literal (2.0) == "2.0");
    CHECK (literal (1e300) == "1e+300");
    CHECK (literal (-0.0) == "-0.0");
    CHECK (literal (inf) == "tactus::inf");
    CHECK (textLiteral ("a \"b\"\n\\?") == "\"a \\\"b\\\"\\012\\\\\\?\"");
    CHECK (comment ("a\nb\\") == "a b");
    CHECK (identifier ("finger[3]/drag.mu") == "finger_3_drag_mu");
    CHECK (identifier ("3d") == "g3d");
    CHECK (className ("dry_wood") == "DryWood");
    Names names { { "tick" } };
    CHECK (names.make ("tick") == "tick_2");
    CHECK (names.make ("new") == "new_");
    CHECK (names.make ("a", { "_out" }) == "a");
    CHECK (names.make ("a_out") == "a_out_2");
}

TEST_CASE ("every node type of the catalogue has a class and a header that can be exported", "[export]")
{
    for (const auto& type : catalogue())
    {
        if (! type.origin.empty() || ! type.info.id.starts_with ("signal.")) continue;
        INFO (type.info.id);
        const auto found = host::classOf (type.info.id);
        CHECK (found.name.starts_with ("tactus::nodes::"));
        CHECK (host::findSource (found.header) != nullptr);
    }
    CHECK (host::classOf ("signal.nothing").name.empty());
    const auto files = host::withIncludes ({ "tactus/nodes/signal/expression.hpp" });
    CHECK (files.contains ("tactus/kit/expression.cpp"));
    CHECK (files.contains ("tactus/kit/vec3.hpp"));
    CHECK_FALSE (files.contains ("tactus/node/catalogue.hpp"));
}
