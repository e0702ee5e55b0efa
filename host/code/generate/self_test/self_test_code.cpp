// SPDX-License-Identifier: MIT
#include "self_test_code.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace tactus::host
{

namespace
{
/// How values are compared bit for bit.
constexpr const char* same_bits = R"(struct Count
{
    unsigned long compared = 0, different = 0;

    void print() const { std::printf ("@STEM@: %lu values compared, %lu differ\n", compared, different); }
    bool isRight() const { return different == 0 && compared > 0; }
};

/// All NaN count as the same.
inline void check (Count& count, std::size_t tick, const char* name, double value, const double* all_expected)
{
    const double expected = all_expected[tick];
    ++count.compared;
    if (std::bit_cast<std::uint64_t> (value) == std::bit_cast<std::uint64_t> (expected) || (value != value && expected != expected)) return;
    if (count.different++ < 10) std::printf ("@STEM@: tick %lu: %s is %.17g, expected %.17g\n", static_cast<unsigned long> (tick), name, value, expected);
}
)";

/// How values in single precision are compared with those in double precision.
constexpr const char* nearly = R"(constexpr double tolerance = 1e-3;   // of the largest value

struct Count
{
    unsigned long compared = 0, different = 0;
    double largest = 0.0;   // difference
    std::uint32_t bits = 0;

    void print() const
    {
        std::printf ("@STEM@: %lu values compared, %lu differ by more than %g of the largest; largest difference %.2g, bits %08lx\n", compared, different,
                     tolerance, largest, static_cast<unsigned long> (bits));
    }
    bool isRight() const { return 1000 * different <= compared && compared > 0; }
};

/// Compares a value with the one in double precision; with those of the ticks before and after it too, because an event such as a slip may
/// come a tick earlier or later. `size`: the largest value of this output.
template <typename Number>
void check (Count& count, std::size_t tick, const char* name, const Number& number, const double* expected, double size)
{
    ++count.compared;
    const auto value = static_cast<double> (number);
    count.bits = 31 * count.bits + (value == value ? std::bit_cast<std::uint32_t> (static_cast<float> (number)) : 0u);   // the same on all machines
    const std::size_t first = tick > 0 ? tick - 1 : 0, last = tick + 1 < @TICKS@ ? tick + 1 : tick;
    double error = value != value && expected[tick] != expected[tick] ? 0.0 : std::abs (value - expected[tick]) / size;
    for (std::size_t k = first; k < last; ++k)
        if ((value >= expected[k] && value <= expected[k + 1]) || (value <= expected[k] && value >= expected[k + 1])) error = 0.0;
    for (std::size_t k = first; k <= last; ++k)
        if (const double other = std::abs (value - expected[k]) / size; other < error) error = other;
    if (error != error) error = std::numeric_limits<double>::infinity();
    if (error > count.largest) count.largest = error;
    if (error > tolerance && count.different++ < 10)
        std::printf ("@STEM@: tick %lu: %s is %.9g, expected %.9g\n", static_cast<unsigned long> (tick), name, value, expected[tick]);
}
)";

/// @CLASS@, @STEM@, @TICKS@, @EVENTS@, @INPUTS@ and @CHECKS@ are filled in.
constexpr const char* program = R"(// SPDX-License-Identifier: MIT
// Runs the graph on recorded inputs and compares every output with what Tactus computed, @HOW@.
#include "@STEM@.hpp"
#include "@STEM@_self_test_data.hpp"

#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdint>
#include <cstdlib>
#include <limits>
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

@COMPARE@
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
inline void run (@CLASS@& graph, Count& count)
{
    @CLASS@::Inputs in;
    @CLASS@::Outputs out;
    for (std::size_t k = 0; k < @TICKS@; ++k)
    {
        act (graph, k);
        read (in, k);
        graph.tick (in, out);
        compare (count, out, k);
    }
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
    Count count;
    graph.prepare();
    run (graph, count);
    graph.prepare();   // as new, so the same again
    run (graph, count);
    count.print();
    return count.isRight() ? 0 : 1;
}

}   // namespace @STEM@_self_test

#ifndef TACTUS_SELF_TEST_IS_INCLUDED
/// With a number as argument, runs the recorded inputs that many times and checks nothing: `make instructions` counts what that takes.
int main (int argument_count, char** arguments)
{
    static @CLASS@ graph;
    graph.prepare();
    if (argument_count > 1)
    {
        for (int n = std::atoi (arguments[1]); n > 0; --n)
            @STEM@_self_test::repeat (graph);
        return 0;
    }
    @STEM@_self_test::Count count;
    @STEM@_self_test::run (graph, count);
    const auto same = @STEM@_self_test::test();
    std::printf ("@STEM@: %lu bytes, of which prepare() uses %lu of %lu for tables; %lu allocations from the heap\n",
                 static_cast<unsigned long> (sizeof (@CLASS@)), static_cast<unsigned long> (graph.memoryUsed()),
                 static_cast<unsigned long> (graph.memory_size), static_cast<unsigned long> (allocations));
    return same == 0 && count.isRight() && allocations == 0 ? 0 : 1;
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

/// The output that a column is a component of: "out.stylus.force" for "out.stylus.force.x()", "out.motor_force" for "out.motor_force_x".
std::string vectorOf (const std::string& target)
{
    constexpr std::string_view endings[] { ".x()", ".y()", ".z()", "_x", "_y", "_z" };
    for (const auto& ending : endings)
        if (target.ends_with (ending)) return target.substr (0, target.size() - ending.size());
    return target;
}

/// The largest value of each output, for its error. An output that is almost 0 counts as a thousandth of the largest one.
std::map<std::string, double> sizesOf (const SelfTest& test)
{
    std::map<std::string, double> all;
    double largest = 0.0;
    for (const auto& column : test.outputs)
    {
        auto& size = all[vectorOf (column.target)];
        for (const double v : column.values)
            if (std::isfinite (v)) size = std::max (size, std::abs (v));
        largest = std::max (largest, size);
    }
    if (largest == 0.0) largest = 1.0;
    for (auto& [name, size] : all)
        size = std::max (size, 1e-3 * largest);
    return all;
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
    const auto sizes = sizesOf (test);
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
        const auto size = e.is_single ? ", " + literal (sizes.at (vectorOf (test.outputs[i].target))) : "";
        checks += "    check (count, k, \"" + test.outputs[i].target + "\", " + test.outputs[i].target + ", " + name + size + ");\n";
    }
    files.data += "}   // namespace " + space + "\n";
    const std::vector<std::pair<std::string, std::string>> names { { "@STEM@", e.stem }, { "@TICKS@", std::to_string (test.ticks) } };
    files.source = filled (program, { { "@COMPARE@", filled (e.is_single ? nearly : same_bits, names) },
                                      { "@HOW@", e.is_single ? "in double precision" : "bit for bit" },
                                      { "@EVENTS@", events (e, test) },
                                      { "@INPUTS@", inputs },
                                      { "@CHECKS@", checks },
                                      { "@CLASS@", e.class_name },
                                      { "@STEM@", e.stem },
                                      { "@TICKS@", std::to_string (test.ticks) } });
    return files;
}

}   // namespace tactus::host
