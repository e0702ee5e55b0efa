// SPDX-License-Identifier: GPL-3.0-or-later
#include "folder_code.hpp"

#include <tactus/text/number_text.hpp>

namespace tactus::host
{

namespace
{
/// The files to compile, each after `before`.
std::string compiled (const Exported& e, const std::set<std::string>& sources, const std::string& before)
{
    std::string text = before + e.stem + ".cpp";
    for (const auto& path : sources)
        if (path.ends_with (".cpp")) text += before + path;
    return text;
}

std::string cell (std::string text)
{
    for (std::size_t at = 0; (at = text.find ('|', at)) != text.npos; at += 2)
        text.insert (at, 1, '\\');
    return comment (text);
}

std::string example (const Exported& e)
{
    std::string text = "```cpp\n#include \"" + e.stem + ".hpp\"\n\nstatic " + e.class_name + " graph;\n" + e.class_name + "::Inputs in;\n" + e.class_name
                       + "::Outputs out;\n\ngraph.prepare (" + numberText (e.wiring.plan.rateHz()) + ");\nfor (;;)   // on every tick\n{\n";
    for (const auto& role : e.wiring.role_ports)
        text += "    in." + role + ".position = { 0.0, 0.0, 0.0 };   // what the device reports, in m\n";
    text += "    graph.tick (in, out);\n";
    for (const auto& role : e.wiring.role_ports)
        text += "    // out." + role + ".force is for the motors, in N\n";
    text += "}\n";
    if (! e.controls.empty()) text += "graph.set (" + e.class_name + "::Control::" + e.controls[0].enumerator + ", 0.7);\n";
    if (! e.parameters.empty())
        text += "graph.set (" + e.class_name + "::Param::" + e.parameters[0].enumerator + ", " + literal (e.parameters[0].value) + ");\n";
    return text + "```\n\n";
}

std::string tables (const Exported& e)
{
    std::string text;
    if (! e.controls.empty())
    {
        text += "## Controls\n\n| control | value in the patch | moves |\n|---|---|---|\n";
        for (const auto& c : e.controls)
        {
            std::vector<std::string> names;
            for (const auto& to : c.to)
                names.push_back ("`" + e.parameters[to.parameter].name + "`");
            text += "| `" + c.enumerator + "` | " + numberText (c.value) + " | " + listed (names) + " |\n";
        }
        text += "\n";
    }
    if (e.parameters.empty()) return text;
    text += "## Parameters\n\n| parameter | value in the patch | unit | meaning |\n|---|---|---|---|\n";
    for (const auto& p : e.parameters)
    {
        const bool is_fixed = p.sheet->unit.kind == UnitRule::Kind::fixed;
        const auto value = p.sheet->choices.empty() ? numberText (p.value) : std::string (p.sheet->choices[static_cast<std::size_t> (p.value)]);
        text += "| `" + p.enumerator + "` | " + value + " | " + (is_fixed ? std::string (p.sheet->unit.unit.symbol) : "") + " | "
                + cell (std::string (p.sheet->about)) + " |\n";
    }
    return text + "\n";
}
}   // namespace

std::string cmakeFile (const Exported& e, const std::set<std::string>& sources)
{
    return "# SPDX-License-Identifier: MIT\ncmake_minimum_required (VERSION 3.16)\nproject (" + e.stem
           + " LANGUAGES CXX)\nfind_package (Eigen3 3.4 REQUIRED NO_MODULE)\n\nif (NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)\n"
             "    set (CMAKE_BUILD_TYPE Release)\nendif ()\n\nadd_library ("
           + e.stem + " STATIC" + compiled (e, sources, "\n    ") + ")\ntarget_compile_features (" + e.stem + " PUBLIC cxx_std_20)\ntarget_include_directories ("
           + e.stem + " PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})\ntarget_link_libraries (" + e.stem
           + " PUBLIC Eigen3::Eigen)\n# Without these flags, the bits may differ from those of Tactus.\ntarget_compile_options (" + e.stem
           + " PUBLIC -ffp-contract=off -fno-math-errno -fno-trapping-math)\n\nenable_testing ()\nadd_executable (" + e.stem + "_self_test " + e.stem
           + "_self_test.cpp)\ntarget_link_libraries (" + e.stem + "_self_test PRIVATE " + e.stem + ")\nadd_test (NAME " + e.stem + " COMMAND " + e.stem
           + "_self_test)\n";
}

std::string makeFile (const Exported& e, const std::set<std::string>& sources)
{
    return "# SPDX-License-Identifier: MIT\n# make test: builds and runs the self-test. EIGEN is the folder of Eigen's headers.\nEIGEN ?= /usr/include/eigen3\n"
           "CXXFLAGS ?= -O2 -Wall -Wextra\nFLAGS = -std=c++20 -I. -isystem $(EIGEN) -ffp-contract=off -fno-math-errno -fno-trapping-math -fno-exceptions -fno-rtti\n\n"
           "sources ="
           + compiled (e, sources, " \\\n    ") + "\nobjects = $(sources:.cpp=.o)\n\nlib" + e.stem
           + ".a: $(objects)\n\t$(AR) rcs $@ $^\n\n%.o: %.cpp\n\t$(CXX) $(CXXFLAGS) $(FLAGS) -c -o $@ $<\n\n" + e.stem + "_self_test: " + e.stem + "_self_test.o lib"
           + e.stem + ".a\n\t$(CXX) $(LDFLAGS) -o $@ $^\n\ntest: " + e.stem + "_self_test\n\t./" + e.stem + "_self_test\n\nclean:\n\trm -f $(objects) " + e.stem
           + "_self_test.o " + e.stem + "_self_test lib" + e.stem + ".a\n\n.PHONY: test clean\n";
}

std::string readmeFile (const Exported& e, const std::vector<std::string>& limits)
{
    std::string text = "# " + comment (e.graph.name.empty() ? e.stem : e.graph.name) + "\n\n";
    if (! e.graph.about.empty()) text += comment (e.graph.about) + "\n\n";
    text += "A graph of Tactus as C++20. `" + e.program + " export` wrote this folder from `" + comment (e.file)
            + "`. It needs only Eigen 3.4 (headers) and the standard library, and is under the MIT licence.\n\n    cmake -B build && cmake --build build && ctest "
              "--test-dir build\n    make test\n\nBoth build the self-test and run it. It compares every output of a recorded run with what Tactus computed, bit "
              "for bit. It also prints how many bytes the graph takes, and how many `prepare` allocates.\n\n## Use it\n\n"
            + example (e)
            + "`" + e.stem + ".hpp` declares the class, and `" + e.stem + ".cpp` computes a tick: one statement per node, in running order. The laws of the nodes are in "
              "`tactus/nodes/`, in the files of the patch's node types.\n\n"
              "- All values are in SI units. x points right, y away from the person, z up.\n"
              "- `tick` allocates nothing, throws nothing and locks nothing. `prepare` allocates what tables and meshes need, once.\n"
              "- All functions are for one thread.\n"
              "- Each role has a guard, which limits its effort and brings it to zero on bad readings. ";
    bool has_limits = true;
    for (const auto& role : e.roles)
        has_limits = has_limits && role.limits != GuardLimits {};
    text += has_limits ? "Its limits are those of the patch. Set `limits` and `layout` of a role to those of your device before `prepare`.\n"
                       : "**The patch sets no limits for every role.** Set `limits` and `layout` of each role to those of your device before `prepare`.\n";
    text += "- The bits are those of Tactus if the code is compiled without contraction into fused multiply-adds (see `CMakeLists.txt`) and linked to the same "
            "`libm`. Other versions of `libm` may differ in the last bits of `sin`, `exp` and the like.\n";
    if (! limits.empty())
    {
        text += "\n## Limits\n\n";
        for (const auto& l : limits)
            text += "- " + comment (l) + "\n";
    }
    return text + "\n" + tables (e);
}

}   // namespace tactus::host
