// SPDX-License-Identifier: GPL-3.0-or-later
#include "self_test_code.hpp"

namespace tactus::host
{

namespace
{
/// @CLASS@, @STEM@, @TICKS@, @EVENTS@, @INPUTS@ and @CHECKS@ are filled in.
constexpr const char* program = R"(// SPDX-License-Identifier: MIT
// Runs the graph on recorded inputs and compares every output with what Tactus computed, bit for bit.
#include "@STEM@.hpp"
#include "@STEM@_self_test_data.hpp"

#include <bit>
#include <cstdio>
#include <cstdint>
#include <cstdlib>
#include <new>

#ifndef TACTUS_SELF_TEST_IS_INCLUDED
static std::size_t allocations = 0;

void* operator new (std::size_t size)
{
    ++allocations;
    if (void* memory = std::malloc (size > 0 ? size : 1)) return memory;
    std::abort();
}
void* operator new[] (std::size_t size) { return operator new (size); }
void operator delete (void* memory) noexcept { std::free (memory); }
void operator delete (void* memory, std::size_t) noexcept { std::free (memory); }
void operator delete[] (void* memory) noexcept { std::free (memory); }
void operator delete[] (void* memory, std::size_t) noexcept { std::free (memory); }
#endif

namespace @STEM@_self_test
{

struct Count
{
    unsigned long compared = 0, different = 0;
};

/// All NaN count as the same.
inline void check (Count& count, std::size_t tick, const char* name, double value, double expected)
{
    ++count.compared;
    if (std::bit_cast<std::uint64_t> (value) == std::bit_cast<std::uint64_t> (expected) || (value != value && expected != expected)) return;
    if (count.different++ < 10) std::printf ("@STEM@: tick %lu: %s is %.17g, expected %.17g\n", static_cast<unsigned long> (tick), name, value, expected);
}

inline void act (@CLASS@& graph, std::size_t tick)
{
    (void) graph;
    switch (tick)
    {
@EVENTS@    default:
        break;
    }
}

inline void read (@CLASS@::Inputs& in, std::size_t k)
{
    (void) in;
    (void) k;
@INPUTS@}

inline void compare (Count& count, const @CLASS@::Outputs& out, std::size_t k)
{
    (void) count;
    (void) out;
    (void) k;
@CHECKS@}

/// Compares all ticks. The graph must be prepared.
inline Count run (@CLASS@& graph)
{
    Count count;
    @CLASS@::Inputs in;
    @CLASS@::Outputs out;
    for (std::size_t k = 0; k < @TICKS@; ++k)
    {
        act (graph, k);
        read (in, k);
        graph.tick (in, out);
        compare (count, out, k);
    }
    return count;
}

/// Only ticks.
inline void repeat (@CLASS@& graph)
{
    @CLASS@::Inputs in;
    @CLASS@::Outputs out;
    for (std::size_t k = 0; k < @TICKS@; ++k)
    {
        read (in, k);
        graph.tick (in, out);
    }
}

inline int test()
{
    static @CLASS@ graph;
    graph.prepare();
    const auto first = run (graph);
    graph.prepare();   // as new, so the same again
    const auto again = run (graph);
    std::printf ("@STEM@: %lu values compared, %lu differ\n", first.compared + again.compared, first.different + again.different);
    return first.different + again.different == 0 && first.compared > 0 ? 0 : 1;
}

}   // namespace @STEM@_self_test

#ifndef TACTUS_SELF_TEST_IS_INCLUDED
/// With a number as argument, runs the recorded inputs that many times and checks nothing: `make instructions` counts what that takes.
int main (int count, char** arguments)
{
    static @CLASS@ graph;
    graph.prepare();
    if (count > 1)
    {
        for (int n = std::atoi (arguments[1]); n > 0; --n)
            @STEM@_self_test::repeat (graph);
        return 0;
    }
    const auto result = @STEM@_self_test::run (graph);
    const auto same = @STEM@_self_test::test();
    std::printf ("@STEM@: %lu bytes, of which prepare() uses %lu of %lu for tables; %lu allocations from the heap\n",
                 static_cast<unsigned long> (sizeof (@CLASS@)), static_cast<unsigned long> (graph.memoryUsed()),
                 static_cast<unsigned long> (graph.memory_size), static_cast<unsigned long> (allocations));
    return same == 0 && result.different == 0 && allocations == 0 ? 0 : 1;
}
#endif
)";

std::string arrayOf (const std::string& name, const std::vector<double>& values)
{
    constexpr std::size_t most_columns = 150;
    std::string text = "inline constexpr double " + name + "[] {", line;
    for (const double v : values)
    {
        const auto number = v != v ? std::string ("not_a_number") : literal (v);
        if (line.size() + number.size() > most_columns)
        {
            text += "\n   " + line;
            line.clear();
        }
        line += " " + number + ",";
    }
    return text + "\n   " + line + "\n};\n\n";
}

std::string events (const Exported& e, const SelfTest& test)
{
    std::string text;
    for (std::size_t i = 0; i < test.events.size(); ++i)
    {
        const auto& event = test.events[i];
        if (i == 0 || event.tick != test.events[i - 1].tick) text += "    case " + std::to_string (event.tick) + ":\n";
        using Event = SelfTestEvent::Kind;
        const auto what = event.kind == Event::param     ? "set (" + e.class_name + "::Param::" + e.parameters[event.number].enumerator
                          : event.kind == Event::control ? "set (" + e.class_name + "::Control::" + e.controls[event.number].enumerator
                                                         : "strike (" + e.class_name + "::Hit::" + e.hits[event.number];
        text += "        graph." + what + ", " + literal (event.value) + ");\n";
        if (i + 1 == test.events.size() || event.tick != test.events[i + 1].tick) text += "        break;\n";
    }
    return text;
}
}   // namespace

SelfTestFiles selfTestFiles (const Exported& e, const SelfTest& test)
{
    SelfTestFiles files;
    const auto space = e.stem + "_self_test";
    files.data = "// SPDX-License-Identifier: MIT\n// Inputs, and the outputs that Tactus computed from them.\n#pragma once\n\n#include <limits>\n\n"
                 "namespace "
                 + space
                 + "\n{\n\ninline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();\n\n";
    std::string inputs, checks;
    for (std::size_t i = 0; i < test.inputs.size(); ++i)
    {
        const auto name = "input_" + std::to_string (i);
        files.data += "// " + test.inputs[i].target + "\n" + arrayOf (name, test.inputs[i].values);
        inputs += "    " + filled (test.inputs[i].target, { { "@", name + "[k]" } }) + ";\n";
    }
    for (std::size_t i = 0; i < test.outputs.size(); ++i)
    {
        const auto name = "expected_" + std::to_string (i);
        files.data += "// " + test.outputs[i].target + "\n" + arrayOf (name, test.outputs[i].values);
        checks += "    check (count, k, \"" + test.outputs[i].target + "\", " + test.outputs[i].target + ", " + name + "[k]);\n";
    }
    files.data += "}   // namespace " + space + "\n";
    files.source = filled (program, { { "@EVENTS@", events (e, test) },
                                      { "@INPUTS@", inputs },
                                      { "@CHECKS@", checks },
                                      { "@CLASS@", e.class_name },
                                      { "@STEM@", e.stem },
                                      { "@TICKS@", std::to_string (test.ticks) } });
    return files;
}

}   // namespace tactus::host
