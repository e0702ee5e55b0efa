// SPDX-License-Identifier: MIT
#include "folder_code.hpp"
#include "object_size.hpp"

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
            text += "| `" + c.enumerator + "` | " + numberText (c.value) + " | " + listText (names) + " |\n";
        }
        text += "\n";
    }
    if (e.parameters.empty()) return text;
    text += "## Parameters\n\n| parameter | value in the patch | unit | meaning |\n|---|---|---|---|\n";
    for (const auto& p : e.parameters)
    {
        const auto value = p.sheet->choices.empty() ? numberText (p.value) : std::string (p.sheet->choices[static_cast<std::size_t> (p.value)]);
        text += "| `" + p.enumerator + "` | " + value + " | " + p.unit + " | "
                + cell (std::string (p.sheet->about)) + " |\n";
    }
    return text + "\n";
}
}   // namespace

std::string cmakeFile (const Exported& e, const std::set<std::string>& sources)
{
    return filled (R"(# SPDX-License-Identifier: MIT
cmake_minimum_required (VERSION 3.16)
project (@STEM@ LANGUAGES CXX)
find_package (Eigen3 3.4 REQUIRED NO_MODULE)

if (NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set (CMAKE_BUILD_TYPE Release)
endif ()

add_library (@STEM@ STATIC@SOURCES@)
target_compile_features (@STEM@ PUBLIC cxx_std_20)
target_include_directories (@STEM@ PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})
target_link_libraries (@STEM@ PUBLIC Eigen3::Eigen)
# Without these flags, the bits may differ from those of Tactus.
target_compile_options (@STEM@ PUBLIC -ffp-contract=off -fno-math-errno -fno-trapping-math)
if (CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64|i[3-6]86)$")
    target_compile_options (@STEM@ PUBLIC -mno-fma -mno-fma4 -mno-avx512f)
endif ()

enable_testing ()
add_executable (@STEM@_self_test @STEM@_self_test.cpp)
target_link_libraries (@STEM@_self_test PRIVATE @STEM@)
add_test (NAME @STEM@ COMMAND @STEM@_self_test)
)",
                   { { "@SOURCES@", compiled (e, sources, "\n    ") }, { "@STEM@", e.stem } });
}

std::string makeFile (const Exported& e, const std::set<std::string>& sources)
{
    return filled (R"(# SPDX-License-Identifier: MIT
# make test: builds and runs the self-test. EIGEN is the folder of Eigen's headers.
EIGEN ?= /usr/include/eigen3
CXXFLAGS ?= -O2 -Wall -Wextra@WARNINGS@
NO_FMA := $(if $(filter x86_64-% amd64-% i386-% i486-% i586-% i686-%,$(shell $(CXX) -dumpmachine)),-mno-fma -mno-fma4 -mno-avx512f)
FLAGS = -std=c++20 -I. -isystem $(EIGEN) -ffp-contract=off -fno-math-errno -fno-trapping-math $(NO_FMA) -fno-exceptions -fno-rtti

sources =@SOURCES@
objects = $(sources:.cpp=.o)

lib@STEM@.a: $(objects)
	$(AR) rcs $@ $^

%.o: %.cpp
	$(CXX) $(CXXFLAGS) $(FLAGS) -c -o $@ $<

@STEM@_self_test: @STEM@_self_test.o lib@STEM@.a
	$(CXX) $(LDFLAGS) -o $@ $^

test: @STEM@_self_test
	./@STEM@_self_test

clean:
	rm -f $(objects) @STEM@_self_test.o @STEM@_self_test lib@STEM@.a

# Instructions per tick, counted by valgrind: what 1200 ticks more take.
instructions: @STEM@_self_test
	@for n in 1 2; do valgrind --tool=callgrind --callgrind-out-file=/dev/null ./@STEM@_self_test $$n 2>&1 | sed -n 's/.*Collected : //p'; done \
	    | awk 'NR == 1 { before = $$1 } END { printf "%.0f instructions per tick\n", ($$1 - before) / 1200 }'

# What the object, the code and the stack take with this compiler. GCC says how much stack each function takes by itself.
TOOL = $(if $(filter %g++,$(CXX)),$(patsubst %g++,%$(1),$(CXX)),$(1))
memory: lib@STEM@.a
	@printf '#include "@STEM@.hpp"\n@C@ graph;\n@C@::Inputs in;\n@C@::Outputs out;\n' > memory_object.cpp
	@$(CXX) $(CXXFLAGS) $(FLAGS) -c -o memory_object.o memory_object.cpp
	@for name in graph in out; do \
	    size=$$($(call TOOL,nm) -S memory_object.o | sed -n "s/^[0-9a-f]* \([0-9a-f]*\) [A-Z] $$name$$/\1/p"); \
	    echo "$$name: $$((0x$$size)) bytes of RAM"; done
	@echo "code and tables, if all of it is used:" && $(call TOOL,size) -t lib@STEM@.a | tail -n 1
	@-$(CXX) $(CXXFLAGS) $(FLAGS) -fstack-usage -c -o memory_code.o @STEM@.cpp && echo "stack:" && grep -h "::tick\|::prepare" memory_code.su
	@rm -f memory_object.cpp memory_object.o memory_code.o memory_code.su

.PHONY: test clean instructions memory
)",
                   { { "@C@", e.class_name },
                     { "@SOURCES@", compiled (e, sources, " \\\n    ") },
                     { "@STEM@", e.stem },
                     { "@WARNINGS@", e.is_single ? " -Wdouble-promotion" : "" } });
}

namespace
{
/// The text about how to build what is in the folder.
std::string buildOf (const Exported& e, ExportTarget target)
{
    if (target == ExportTarget::arduino)
        return "This is an Arduino library. Copy the folder into `libraries/`, install the library Eigen, and open the example `Board`. The core of the "
               "board\nmust compile C++20 (`-std=gnu++20`), and must not use `-ffast-math`. The board plays the graph until Tactus speaks to it. From then on\n"
               "Tactus drives it, and when Tactus stops, the board rests until its arm button (pin 2 to ground) is pressed or it is reset. `extras/` has\n"
               "a self-test for a computer:\n\n"
               "    g++ -std=c++20 -O2 -ffp-contract=off -fno-math-errno -fno-trapping-math -Isrc -isystem /usr/include/eigen3 \\\n"
               "        extras/*.cpp $(find src -name '*.cpp') -o self_test && ./self_test\n";
    std::string text = filled (R"(    cmake -B build && cmake --build build && ctest --test-dir build
    make test

Either command builds the self-test and runs it. It compares every output of a recorded run with what Tactus computed, @HOW@. It
also prints how many bytes the graph takes. `make memory` says more, and `make instructions` counts the instructions of a tick (it needs valgrind).
)",
                               { { "@HOW@", e.is_single ? "in double precision" : "bit for bit" } });
    if (target == ExportTarget::c_api)
        text += filled ("\n`@S@.h` is the same class for C99: create, prepare, tick, set, destroy. `@S@_example.c` shows how to use it; link it with\n"
                        "`lib@S@.a` and the C++ library.\n",
                        { { "@S@", e.stem } });
    if (target == ExportTarget::wasm)
        text += filled (R"(
`make wasm` builds `@S@.wasm`, which needs no imports: no threads, no exceptions, no memory from a heap. It needs clang 22 with its libraries for
WebAssembly. `make wasm_test` runs the self-test in node. `index.html` is a page that plays the graph: the pointer moves the tool, and the force becomes
sound. With `package.json`, the folder is a package for npm and bundlers. Without either, copy `@S@.wasm` and all files that end in `.js` to your server
(in Node.js, import `@S@_node.js`). `.d.ts` are types for TypeScript.

```js
import { @C@ } from './@S@.js';   // in Node.js: './@S@_node.js'

const graph = await @C@.load();   // or new @C@ (module), of a WebAssembly.Module
graph.tick();                     // about.rate_hz times per second: reads graph.inputs, and writes graph.outputs
```
)",
                        { { "@C@", e.class_name }, { "@S@", e.stem } });
    if (target == ExportTarget::fmu)
        text += filled (R"(
`make fmu` builds `@S@.fmu`, a unit for co-simulation by the Functional Mock-up Interface 2.0, for 64-bit Linux. It runs at the rate
of the patch: a step of h seconds runs all ticks that begin within it, on the inputs that are set. Its state can be saved and set again
in the same unit; it cannot be serialised.
)",
                        { { "@S@", e.stem } });
    return text;
}

/// The text about how exact the values are.
std::string bitsOf (const Exported& e)
{
    if (! e.is_single)
        return "- The bits are those of Tactus if the code is compiled without contraction into fused multiply-adds (see `CMakeLists.txt`). No function\n";
    return "- All numbers are floats, and nothing here needs a unit for doubles. Positions, which are inputs of type `tactus::Position`, are sums of two\n"
           "  floats, because a float at 0.1 m has steps of 7.5 nm. `tactus::Extended::steps (count, step)` makes one from an encoder. The self-test\n"
           "  compares with double precision and prints the largest difference.\n"
           "- The bits are the same on all machines if the code is compiled without contraction into fused multiply-adds (see `CMakeLists.txt`). No function\n";
}

/// The text about the memory, as far as it is known without a compiler.
std::string memoryOf (const Exported& e)
{
    const auto size = objectSize (e);
    if (e.memory.nodes == 0) return "`make memory` measures what the object, the code and the stack take.\n";   // under sanitizers
    return filled (R"(| RAM, in bytes | on a 64-bit computer, at most |
|---|---|
| the object, `static @C@ graph` | **@ALL@** |
| - the nodes | @NODES@ |
| - reserved for what `prepare` computes | @PREPARED@ |
| - roles: a guard and a reading each | @ROLES@ |
| - parameters and their ramps | @PARAMETERS@ |
| - the rest | @OTHERS@ |
| `@C@::Inputs`, which you keep | @INPUTS@ |
| `@C@::Outputs`, which you keep | @OUTPUTS@ |

There are no other variables but one pointer. A board with 4-byte pointers takes less@FLOATS@. How much the code and the
constant tables take in flash, and a tick on the stack, depends on the compiler and is not known here: @MEASURE@
)",
                   { { "@C@", e.class_name },
                     { "@ALL@", std::to_string (size.all()) },
                     { "@NODES@", std::to_string (size.nodes) },
                     { "@PREPARED@", std::to_string (size.prepared) },
                     { "@ROLES@", std::to_string (size.roles) },
                     { "@PARAMETERS@", std::to_string (size.parameters) },
                     { "@OTHERS@", std::to_string (size.others) },
                     { "@INPUTS@", std::to_string (size.inputs) },
                     { "@OUTPUTS@", std::to_string (size.outputs) },
                     { "@FLOATS@", e.is_single ? ", and so do floats: the numbers above are those of doubles" : "" },
                     { "@MEASURE@", e.has_makefile ? "`make memory` measures\nall of it, also with the compiler of a board: `make memory CXX=arm-none-eabi-g++ "
                                                     "CXXFLAGS='-Os -mcpu=cortex-m7'`."
                                                   : "the\nArduino IDE prints the flash when it builds a sketch." } });
}
}   // namespace

std::string readmeFile (const Exported& e, ExportTarget target, const std::vector<std::string>& limits)
{
    bool has_limits = true;
    for (const auto& role : e.roles)
        has_limits = has_limits && role.limits != GuardLimits {};
    std::string more;
    for (const auto& l : limits)
        more += "- " + comment (l) + "\n";
    return filled (R"(# @TITLE@

@ABOUT@A graph of Tactus as C++20. `@PROGRAM@ export` wrote this folder from `@FILE@`. It needs only Eigen 3.4 (headers) and the
standard library, and is under the MIT licence@BUT@.

@BUILD@
## Use it

@EXAMPLE@`@STEM@.hpp` declares the class, and `@STEM@.cpp` computes a tick: one statement per node, in running order. The laws of the
nodes are in `tactus/nodes/`, one file per node type.

- All values are in SI units. x points right, y away from the person, z up.
- Nothing here uses a heap, throws or locks. Tables and meshes are constant data.
- `prepare` accepts rates up to @RATE@ Hz. For a higher rate, export with `--rate`, because some nodes need more memory then.
- All functions are for one thread.
- Each role has a guard, which limits its effort and brings it to zero on bad readings. @LIMITS@ Before `prepare`, set the
  `layout` of each role to that of your device, and `tighten` its limits to those of your motors. Nothing loosens them.
@BITS@  of `libm` is called, so its version does not matter.
@MORE@
## Memory

@MEMORY@
@TABLES@)",
                   { { "@BITS@", bitsOf (e) },
                     { "@BUILD@", buildOf (e, target) },
                     { "@BUT@", e.has_plugins ? ", except for the headers in `plugins/`, which keep their own" : "" },
                     { "@MEMORY@", memoryOf (e) },
                     { "@RATE@", numberText (e.wiring.plan.rateHz()) },
                     { "@TITLE@", comment (e.graph.name.empty() ? e.stem : e.graph.name) },
                     { "@ABOUT@", e.graph.about.empty() ? "" : comment (e.graph.about) + "\n\n" },
                     { "@LIMITS@", has_limits ? "Its limits are those of the patch." : "**The patch does not set limits for every role.**" },
                     { "@EXAMPLE@", example (e) },
                     { "@MORE@", more },
                     { "@TABLES@", tables (e) },
                     { "@PROGRAM@", e.program },
                     { "@FILE@", comment (e.file) },
                     { "@STEM@", e.stem } });
}

}   // namespace tactus::host
