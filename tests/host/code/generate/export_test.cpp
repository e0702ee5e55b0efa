// SPDX-License-Identifier: MIT
// The self-test of an exported graph compares every output with that of the engine, bit for bit, while parameters and controls move and
// inputs are hit. Here, the self-tests of several graphs run in one program.

#include "exported_code.hpp"

#include <host/code/generate/sources/code.hpp>
#include <host/code/generate/sources/single_precision.hpp>
#include <host/code/generate/sources/sources.hpp>
#include <support/sketch.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/run/log/run_head.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <regex>
#include <sstream>
#include <vector>

using namespace tactus;
using test::ExportedProgram;

namespace
{
bool passes (const std::string& said) { return said.starts_with ("passed"); }

/// The lines with this text.
std::vector<std::string> linesWith (const std::string& said, const std::string& text)
{
    std::istringstream lines (said);
    std::vector<std::string> all;
    for (std::string line; std::getline (lines, line);)
        if (line.find (text) != line.npos) all.push_back (line);
    return all;
}

/// The C++ code of a graph that has to be exportable.
void require (ExportedProgram& program, const host::ExportedFolder& exported, const std::string& name)
{
    INFO (name << ": " << test::text (exported.messages));
    REQUIRE_FALSE (exported.files.empty());
    for (const auto& [path, text] : exported.files)
    {
        CHECK (text.find ("static const auto ") == std::string::npos);   // would lie in the memory of the graph that calls it first
        CHECK (text.find ("no_device") == std::string::npos);            // a reading of nothing, which takes memory
    }
    program.add (exported);
}

/// The number of bytes in the row of the table of README.md that begins like this.
std::size_t bytesIn (const std::string& readme, const std::string& row)
{
    const auto at = readme.find ("| " + row);
    if (at == readme.npos) return 0;
    return std::strtoul (readme.c_str() + readme.find_first_of ("0123456789", readme.find (" | ", at)), nullptr, 10);
}

/// Compares what a README says about memory with what the program has printed.
void checkMemory (const std::string& said, const std::string& stem, const std::string& class_name, const std::string& readme)
{
    const auto printed = linesWith (said, stem + " takes ");
    INFO (stem << ":\n"
               << readme.substr (readme.find ("## Memory")));
    REQUIRE_FALSE (printed.empty());
    std::size_t object = 0, inputs = 0, outputs = 0;
    REQUIRE (std::sscanf (printed[0].c_str() + stem.size(), " takes %zu, %zu and %zu bytes", &object, &inputs, &outputs) == 3);
    INFO (object << " " << inputs << " " << outputs);
    constexpr std::size_t rounding = 64;   // of small nodes to words
    CHECK (bytesIn (readme, "the object") >= object);
    CHECK (bytesIn (readme, "the object") <= object + rounding);
    // A struct without members takes a byte.
    CHECK (std::max<std::size_t> (bytesIn (readme, "`" + class_name + "::Inputs`"), 1) == inputs);
    CHECK (std::max<std::size_t> (bytesIn (readme, "`" + class_name + "::Outputs`"), 1) == outputs);
}

/// Two contacts, as instances of a subgraph.
host::ExportedFolder exportedContacts()
{
    test::Sketch s;
    auto& part = s.subgraph ("contact");
    s.add (part, "board", "deform.plane", { { "damping", 1.0 } }).add (part, "drag", "friction.elasto_plastic");
    s.add (part, "board.resistance -> drag.normal_force");
    s.node ("c", "graph:contact");
    s.graph.root.nodes.front().extra["count"] = 2;
    s.node ("z", "signal.lfo", { { "frequency", 30.0 }, { "amplitude", 2e-3 } }).node ("hand", "vector.join").wire ("z.out -> hand.z").wire ("z.out -> hand.x");
    host::ExportOptions options { .file = "contacts.json", .program = "tactus", .compile = {}, .open = {} };
    for (const std::string contact : { "c[0]/", "c[1]/" })
    {
        s.wire ("hand.out -> " + contact + "board.position").wire ("hand.out -> " + contact + "drag.position");
        options.compile.records.push_back (contact + "drag.force");
    }
    return host::exportGraph (s.graph, options);
}

/// The smallest graph with a surface.
host::ExportedFolder exportedPad()
{
    test::Sketch s;
    s.node ("z", "signal.lfo", { { "frequency", 30.0 }, { "amplitude", 2e-3 } }).node ("hand", "vector.join").wire ("z.out -> hand.z");
    s.node ("pad", "deform.surface").wire ("hand.out -> pad.position");
    host::ExportOptions options { .file = "pad.json", .program = "tactus", .compile = {}, .open = {} };
    options.compile.records.push_back ("pad.force");
    return host::exportGraph (s.graph, options);
}
/// A mixer whose ceiling is set and taken away.
host::ExportedFolder exportedMixer()
{
    test::Sketch s;
    s.node ("wave", "signal.lfo", { { "frequency", 30.0 }, { "amplitude", 50.0 } }).node ("mix", "layer.mix").wire ("wave.out -> mix.in[0]");
    host::ExportOptions options { .file = "mixer.json", .program = "tactus", .compile = {}, .open = {} };
    options.compile.records.push_back ("mix.out");
    return host::exportGraph (s.graph, options);
}
}   // namespace

TEST_CASE ("exported graphs give the bits of the engine while parameters move", "[export]")
{
    // Sections with other rates, a mesh, a height map, a recording, a subgraph in several instances, a formula, shocks, noise.
    ExportedProgram program;
    std::vector<host::ExportedFolder> all;
    for (const auto* name : { "dry_wood", "vibraphone_bar", "two_fingers", "liver", "pebbled_leather", "bronze_bell", "machined_steel", "padded_bench" })
        require (program, all.emplace_back (test::exportedPreset (name)), name);
    for (unsigned seed = 1; seed <= 12; ++seed)
        require (program, all.emplace_back (test::exportedRandomGraph (seed, 12)), "random graph " + std::to_string (seed));
    require (program, exportedContacts(), "contacts");
    require (program, exportedPad(), "pad");
    require (program, exportedMixer(), "mixer");

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
    CHECK (right == 23);
    CHECK (wrong == 1);
    CHECK (linesWith (said, "moves before prepare()").empty());
    for (const auto* name : { "liver", "padded_bench", "pad" })   // a long text of a setting takes some
        CHECK (linesWith (said, std::string (name) + " takes memory from the heap").empty());
    for (auto& folder : all)
        checkMemory (said, folder.stem, folder.class_name, test::textOf (folder, "README.md"));
}

TEST_CASE ("a device that no node uses costs nothing in an export", "[export]")
{
    const std::string head = R"({ "format": "tactus-graph", "version": 2, "rate_hz": 1000, "devices": { "stylus": { "driver": "sim", "mass": "50 g" })";
    const std::string others = R"(, "left": { "driver": "sim", "mass": "80 g", "guard": { "max_force": "2 N" } }, "cushion": { "driver": "sim" })";
    const std::string nodes = R"( }, "nodes": { "hand": { "type": "device.position", "role": "stylus" }, "plate": { "type": "deform.plane" },
        "motor": { "type": "device.force", "role": "stylus" }, "spare": { "type": "device.position", "role": "cushion", "bypass": true } },
        "wires": ["hand.position -> plate.position", "plate.force -> motor.force"] })";
    const auto exported = [] (const std::string& text, host::ExportTarget target) {
        const auto read = readGraph (text);
        INFO (test::text (read.messages));
        REQUIRE_FALSE (hasErrors (read.messages));
        return host::exportGraph (read.graph, { .file = "plate.json", .program = "tactus", .compile = {}, .target = target, .open = {} });
    };
    for (const auto target : { host::ExportTarget::cpp, host::ExportTarget::c_api, host::ExportTarget::arduino, host::ExportTarget::fmu })
    {
        const auto without = exported (head + nodes, target), with = exported (head + others + nodes, target);
        INFO (test::text (with.messages));
        REQUIRE_FALSE (with.files.empty());
        CHECK (with.files == without.files);
    }
}

TEST_CASE ("a parameter of a unit for simulators has its unit, by the base units of the SI", "[export]")
{
    test::Sketch s;
    s.node ("hand", "device.position").node ("plate", "deform.plane").node ("scale", "signal.gain").node ("motor", "device.force");
    s.graph.root.nodes[0].role = s.graph.root.nodes[3].role = "stylus";
    s.wire ("hand.position -> plate.position").wire ("plate.force -> motor.force").wire ("plate.resistance -> scale.in");
    host::ExportOptions options { .file = "plate.json", .program = "tactus", .compile = { .records = { "scale.out" } }, .target = host::ExportTarget::fmu, .open = {} };
    auto folder = host::exportGraph (s.graph, options);
    INFO (test::text (folder.messages));
    REQUIRE_FALSE (folder.files.empty());
    const auto& xml = test::textOf (folder, "modelDescription.xml");
    INFO (xml);
    const auto unitOf = [&] (const std::string& variable) {
        const auto at = xml.find ("<ScalarVariable name=\"" + variable + "\""), end = xml.find ("</ScalarVariable>", at), unit = xml.find (" unit=\"", at);
        if (at == xml.npos || unit > end) return std::string ("none");
        return xml.substr (unit + 7, xml.find ('"', unit + 7) - unit - 7);
    };
    CHECK (unitOf ("in.stylus.position.x") == "m");
    CHECK (unitOf ("in.stylus.age") == "s");
    CHECK (unitOf ("out.stylus.force.z") == "N");
    CHECK (unitOf ("out.stylus.torque.z") == "N*m");
    CHECK (unitOf ("param.plate.stiffness") == "N/m");
    CHECK (unitOf ("record.scale.out") == "N");   // a generic node has the unit of its wire
    CHECK (unitOf ("limit.stylus.max_slew") == "N/s");
    CHECK (unitOf ("limit.stylus.max_angular_speed") == "rad/s");
    for (const auto* definition : { "\"N\"><BaseUnit kg=\"1\" m=\"1\" s=\"-2\"/>", "\"N/m\"><BaseUnit kg=\"1\" s=\"-2\"/>",
                                    "\"rad/s\"><BaseUnit s=\"-1\" rad=\"1\"/>", "\"m\"><BaseUnit m=\"1\"/>" })
        CHECK (xml.find (std::string ("<Unit name=") + definition) != xml.npos);
    CHECK (xml.find ("<UnitDefinitions>") < xml.find ("<DefaultExperiment"));   // the order that the schema asks for
    CHECK (xml.find ("</CoSimulation>") == xml.npos);
    CHECK (xml.find ("<CoSimulation") < xml.find ("<UnitDefinitions>"));
    for (std::size_t at = 0; (at = xml.find ("<Real unit=\"", at)) != xml.npos; ++at)
    {
        const auto unit = xml.substr (at + 12, xml.find ('"', at + 12) - at - 12);
        INFO (unit);
        CHECK (xml.find ("<Unit name=\"" + unit + "\"") != xml.npos);
    }
}

TEST_CASE ("all presets and many random graphs give the bits of the engine with each compiler", "[.export_all]")
{
    const auto* given = std::getenv ("TACTUS_EXPORT_COMPILERS");
    const auto* count = std::getenv ("TACTUS_EXPORT_GRAPHS");
    std::istringstream compilers (given != nullptr ? given : "g++");
    const unsigned graphs = count != nullptr ? static_cast<unsigned> (std::stoi (count)) : 100, graphs_per_program = 20;
    for (std::string compiler; compilers >> compiler;)
    {
        ExportedProgram presets;
        for (const auto& name : test::presetNames())
            require (presets, test::exportedPreset (name), name);
        const auto said = presets.run (compiler, "-O2");
        INFO (compiler << ", " << presets.graphCount() << " presets: " << said);
        CHECK (passes (said));
        if (compiler == "g++")
        {
            // As the Makefile of the folder does it on a new processor.
            const auto native = presets.run (compiler, "-O2 -march=native -mno-fma -mno-fma4 -mno-avx512f");
            INFO ("for this processor: " << native);
            CHECK (passes (native));
            CHECK (presets.instructions ("\\svfn?m(add|sub)").empty());
        }
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

TEST_CASE ("presets give the bits of the engine in WebAssembly, at most three times as slowly as natively", "[.export_wasm]")
{
    if (std::system ("command -v clang++-22 wasm-ld-22 node > /dev/null && [ -d /usr/lib/wasm32-wasi ]") != 0)
    {
        WARN ("skipped: needs clang-22 lld-22 libc++-22-dev-wasm32 libclang-rt-22-dev-wasm32 wasi-libc nodejs");
        return;
    }
    ExportedProgram program;
    for (const auto& name : test::presetNames())
        require (program, test::exportedPreset (name), name);
    const auto said = program.runInNode ("-O2");
    INFO (said);
    CHECK (passes (said));
    CHECK (static_cast<int> (linesWith (said, ", 0 differ").size()) == 4 * program.graphCount());   // both programs, twice
    std::map<std::string, std::pair<double, double>> shortest;
    for (const auto& line : linesWith (said, " ns"))
    {
        const double took = std::stod (line.substr (line.find (": ") + 2));
        auto& [native, node] = shortest.try_emplace (line.substr (0, line.find (' ')), inf, inf).first->second;
        auto& time = line.find (" natively: ") != line.npos ? native : node;
        time = std::min (time, took);
    }
    CHECK (static_cast<int> (shortest.size()) == program.graphCount());
    std::string table;
    double most = 0.0;
    for (const auto& [name, times] : shortest)
    {
        const double ratio = times.second / times.first;
        table += name + ": " + std::to_string (times.first) + " ns natively, " + std::to_string (times.second) + " ns in node, ratio "
                 + std::to_string (ratio) + "\n";
        most = std::max (most, ratio);
    }
    WARN (table);
    CHECK (most <= 3.0);
}

TEST_CASE ("presets give the bits of the engine on a Cortex-M7", "[.export_m7]")
{
    ExportedProgram program;
    for (const auto& name : test::presetNames())
        require (program, test::exportedPreset (name), name);
    const auto said = program.runOn (ExportedProgram::Board::m7, "-O2");
    WARN (said);
    CHECK (passes (said));
    const auto compared = linesWith (said, "values compared");
    CHECK (static_cast<int> (compared.size()) == program.graphCount());
    CHECK (linesWith (said, ", 0 differ") == compared);

    // The memory of a small board, minus some for the stack and everything else. See docs/export.md for those that do not fit.
    constexpr unsigned long memory = 512 * 1024 - 32 * 1024;
    int fitting = 0;
    for (const auto& line : linesWith (said, " bytes, "))
        fitting += std::stoul (line.substr (line.find (": ") + 2)) <= memory ? 1 : 0;
    CHECK (fitting >= program.graphCount() - 2);
}

TEST_CASE ("presets in single precision are close to the engine, and have the same bits on a Cortex-M4 without doubles", "[.export_m4]")
{
    ExportedProgram program;
    for (const auto& name : test::presetNames())
        require (program, test::exportedPreset (name, true), name);
    CHECK (program.callsOn (ExportedProgram::Board::m4, "__aeabi_(d|c?d|[a-z]+2d)|double|__[a-z]+df[0-9]") == "");
    const auto here = program.run ("g++", "-O2");
    WARN (here);
    CHECK (passes (here));
    const auto compared = linesWith (here, "values compared");
    CHECK (static_cast<int> (compared.size()) == 2 * program.graphCount());   // with and without AVX
    const auto there = program.runOn (ExportedProgram::Board::m4, "-O2");
    WARN (there);
    CHECK (passes (there));
    const auto once = linesWith (there, "values compared");
    auto twice = once;
    twice.insert (twice.end(), once.begin(), once.end());
    CHECK (twice == compared);
}

TEST_CASE ("random graphs in single precision have the same bits with each compiler and on a Cortex-M4", "[.export_m4]")
{
    // Their hands jump, so a rounding error may grow into any difference from double precision.
    ExportedProgram program;
    for (unsigned seed = 1; program.graphCount() < 12; ++seed)
        if (const auto exported = test::exportedRandomGraph (seed, 4 + static_cast<int> (seed % 25), true); ! exported.files.empty()) program.add (exported);
    const auto compared = linesWith (program.runOn (ExportedProgram::Board::m4, "-O1"), "values compared");
    CHECK (static_cast<int> (compared.size()) == program.graphCount());
    for (const auto* compiler : { "g++", "clang++-14" })
    {
        auto here = linesWith (program.run (compiler, "-O1"), "values compared");
        here.resize (compared.size());   // a second run follows if all values are right
        CHECK (here == compared);
    }
}

TEST_CASE ("in single precision, no source that a graph may need has a type of Eigen with doubles", "[export]")
{
    const std::regex type (R"(\b(Vector|Matrix|Array|Quaternion|AngleAxis|Affine)[0-9X]*d\b)");
    for (const auto& file : host::sourceFiles())
    {
        const auto text = host::inSinglePrecision (std::string (file.text));
        INFO (file.path);
        CHECK_FALSE (std::regex_search (text, type));
    }
}

TEST_CASE ("a graph in single precision has no doubles, and notices a fault", "[export]")
{
    ExportedProgram program;
    for (const auto* name : { "dry_wood", "nodule_under_skin", "two_fingers" })
        require (program, test::exportedPreset (name, true), name);
    auto broken = test::exportedPreset ("soft_pad", true);
    auto& source = test::textOf (broken, "soft_pad.cpp");
    const std::string call = "motor.effort()";
    REQUIRE (source.find (call) != std::string::npos);
    source.replace (source.find (call), call.size(), "tactus::Effort { .force = 1.01f * motor.effort().force }");
    program.add (broken);
    const auto said = program.run ("c++", "-O0");
    INFO (said);
    CHECK_FALSE (passes (said));
    const auto right = linesWith (said, ", 0 differ by more than 0.001 of the largest");
    REQUIRE (right.size() == 3);
    CHECK (right[0].starts_with ("dry_wood: "));
    CHECK (right[1].starts_with ("nodule_under_skin: "));
    CHECK (right[2].starts_with ("two_fingers: "));
    CHECK (linesWith (said, "values compared").size() == 4);
    CHECK (linesWith (said, "nodule_under_skin takes memory from the heap").empty());
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

TEST_CASE ("an exported graph has every limit of its guard", "[export]")
{
    GuardLimits limits;
    double value = 1.0;
    for (const auto& [key, limit] : guard_fields)
        limits.*limit = value *= 2.5;
    limits.dead_man_buttons = 5;
    test::Sketch s;
    s.node ("motor", "device.force");
    s.graph.root.nodes.front().role = "stylus";
    const auto open = [&] (const std::string& role, const graph::Graph& graph, const Plan& plan, Messages& messages) -> Run::RoleDevice {
        return { test::randomHands (1) (role, graph, plan, messages).device, limits };
    };
    for (const bool is_single : { false, true })
    {
        auto exported = host::exportGraph (s.graph, { .file = "limits.json", .program = "tactus", .compile = {}, .is_single = is_single, .open = open });
        INFO (test::text (exported.messages));
        REQUIRE_FALSE (exported.files.empty());
        const auto& header = test::textOf (exported, "limits.hpp");
        INFO (header);
        for (const auto& [key, limit] : guard_fields)
            CHECK (header.find ("." + std::string (key) + " = " + host::literal (limits.*limit) + (is_single ? "f" : "")) != std::string::npos);
        CHECK (header.find (".dead_man_buttons = 5u") != std::string::npos);
    }
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

TEST_CASE ("a name that looks like a mark of a template, or like XML, stays a name in everything that is exported", "[export]")
{
    CHECK (host::filled ("@A@ @B@ @AB@", { { "@A@", "@B@" }, { "@B@", "<&>" } }) == "@B@ <&> @AB@");

    test::Sketch s;
    s.graph.name = "@VARIABLES@ @STRUCTURE@ <a href=\"x\">& \xef\xbf\xbf";
    s.graph.about = "@GUID@ @S@";
    s.node ("z", "signal.lfo", { { "frequency", 30.0 } });
    host::ExportOptions options { .file = "marks.json", .program = "tactus", .compile = {}, .open = {} };
    options.target = host::ExportTarget::fmu;
    options.compile.records.push_back ("z.out");
    const auto folder = host::exportGraph (s.graph, options);
    INFO (test::text (folder.messages));
    const auto xml = std::ranges::find_if (folder.files, [] (const auto& file) { return file.first.ends_with ("modelDescription.xml"); });
    REQUIRE (xml != folder.files.end());
    const auto& text = xml->second;
    INFO (text);
    CHECK (text.find ("modelName=\"@VARIABLES@ @STRUCTURE@ &lt;a href=&quot;x&quot;&gt;&amp; \"") != std::string::npos);
    CHECK (text.find ("description=\"@GUID@ @S@\"") != std::string::npos);
    const auto count = [&] (const std::string& what) {
        int n = 0;
        for (auto at = text.find (what); at != std::string::npos; at = text.find (what, at + 1))
            ++n;
        return n;
    };
    CHECK (count ("<ModelVariables>") == 1);
    CHECK (count ("name=\"record.z.out\"") == 1);
    CHECK (count ("guid=\"{") == 1);
}
