// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench.hpp"

#include <host/base/platform/private_folder.hpp>

#include <juce_core/juce_core.h>

#include <charconv>
#include <cstdio>
#include <fstream>

extern "C"
{
    // Callgrind finds these by name: it counts within `tactus_bench_counted` and dumps its counts after each `tactus_bench_dump`.
    [[gnu::noinline]] void tactus_bench_counted (tactus::bench::Variant& variant, const std::vector<tactus::bench::Contest::Row>& inputs) noexcept
    {
        for (const auto& row : inputs)
            variant.tick (row.data());
    }

    [[gnu::noinline]] void tactus_bench_dump() noexcept { asm volatile(""); }
}

namespace tactus::bench
{

namespace
{
struct Folder
{
    ~Folder() { path.deleteRecursively(); }

    const juce::File path { host::privateFolder ("tactus-bench-").string() };
};

/// The total of one callgrind dump.
std::optional<double> totalOf (const juce::File& dump)
{
    std::ifstream file (dump.getFullPathName().toStdString());
    constexpr std::string_view key = "summary: ";
    for (std::string line; std::getline (file, line);)
        if (line.starts_with (key))
        {
            double total = 0.0;
            std::from_chars (line.data() + key.size(), line.data() + line.size(), total);
            return total;
        }
    return {};
}
}   // namespace

void runToBeCounted()
{
    for (const auto& contest : contests())
        for (const auto& make : { contest.make_first, contest.make_second })
        {
            tactus_bench_counted (*make(), contest.inputs);
            tactus_bench_dump();
        }
}

std::variant<std::map<std::string, Counted>, std::string> countInstructions()
{
    const Folder folder;
    if (! folder.path.isDirectory()) return "no temporary folder can be made";
    const auto out = folder.path.getChildFile ("out");
    juce::ChildProcess valgrind;
    const bool started = valgrind.start ({ "valgrind", "--tool=callgrind", "--toggle-collect=tactus_bench_counted", "--dump-after=tactus_bench_dump",
                                           "--callgrind-out-file=" + out.getFullPathName(),
                                           juce::File::getSpecialLocation (juce::File::currentExecutableFile).getFullPathName(), counted_option });
    const auto printed = started ? valgrind.readAllProcessOutput() : juce::String();

    std::map<std::string, Counted> all;
    int dump = 0;
    for (const auto& contest : contests())
    {
        const auto first = totalOf (folder.path.getChildFile ("out." + juce::String (++dump)));
        const auto second = totalOf (folder.path.getChildFile ("out." + juce::String (++dump)));
        if (! first || ! second) return printed.isEmpty() ? "valgrind could not be run; is it installed?" : printed.toStdString();
        const auto ticks = static_cast<double> (contest.inputs.size());
        all[contest.key] = { *first / ticks, *second / ticks };
    }
    return all;
}

}   // namespace tactus::bench
