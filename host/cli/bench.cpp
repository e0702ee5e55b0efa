// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.hpp"
#include "report.hpp"

#include <framework/json.hpp>
#include <host/bench/bench.hpp>
#include <host/bench/instructions.hpp>

#include <juce_events/juce_events.h>

#include <cstdio>
#include <iostream>
#include <memory>

namespace tactus::host
{

namespace
{
using bench::Results;
using Counts = std::map<std::string, bench::Counted>;

struct Options
{
    bool json = false, quick = false, instructions = false, counted = false;
};

void printAgreements (const Results& results)
{
    for (const auto& [contest, found] : results.agreements)
    {
        std::printf ("%s and %s %s: %s, %zu numbers, ", contest.first.c_str(), contest.second.c_str(), found.agree ? "agree" : "DISAGREE", contest.about.c_str(), found.values);
        if (contest.tolerance > 0.0)
            std::printf ("within %.0e (seen %.0e)\n", contest.tolerance, found.worst);
        else
            std::printf (found.agree ? "bit for bit\n" : "apart by %.0e\n", found.worst);
    }
    std::printf ("\n");
    std::fflush (stdout);
}

std::string timeText (double seconds)
{
    const auto [factor, unit] = seconds < 1e-5 ? std::pair { 1e9, "ns" } : seconds < 1e-2 ? std::pair { 1e6, "us" }
                                                                                          : std::pair { 1e3, "ms" };
    char text[32];
    return { text, static_cast<std::size_t> (std::snprintf (text, sizeof text, "%.4g %s", seconds * factor, unit)) };
}

void printTable (const Results& results, const Counts& counts)
{
    std::printf ("\n%-30s %10s %10s   %8s  %s\n", "", "first", "second", "ratio", "95 % of the median");
    for (const auto& pair : results.pairs)
    {
        const auto ratio = pair->ratio();
        std::printf ("%-30s %10s %10s   %8.3f  %.3f to %.3f\n", pair->name.c_str(), timeText (bench::medianOf (pair->first_s)).c_str(), timeText (bench::medianOf (pair->second_s)).c_str(), ratio.median, ratio.low, ratio.high);
    }
    std::printf ("%-30s %.0f to tick, and %.0f to edit, for each node beyond its own struct\n", "bytes_per_node", results.memory.to_tick, results.memory.to_edit);
    if (! counts.empty()) std::printf ("\ninstructions a tick\n");
    for (const auto& [key, counted] : counts)
        std::printf ("%-30s %10.0f %10.0f   %8.3f\n", key.c_str(), counted.first, counted.second, counted.first / counted.second);
}

void printJson (const Results& results, const Counts& counts)
{
    auto ratios = Json::object(), instructions = Json::object();
    for (const auto& pair : results.pairs)
    {
        const auto ratio = pair->ratio();
        ratios[pair->name] = { { "median", ratio.median }, { "low", ratio.low }, { "high", ratio.high } };
    }
    for (const auto& [key, counted] : counts)
        instructions[key] = { counted.first, counted.second };

    Json all { { "ratios", ratios }, { "bytes_per_node", results.memory.to_tick }, { "bytes_per_node_to_edit", results.memory.to_edit }, { "agree", results.agree() } };
    if (! counts.empty()) all["instructions"] = instructions;
    std::cout << all.dump (2) << '\n';
}

void run (const Options& options)
{
    const juce::ScopedJuceInitialiser_GUI messages;
    if (options.counted) return bench::runToBeCounted();

    Results results;
    bench::agree (results);
    if (! options.json) printAgreements (results);
    bench::time (results, options.quick, options.json);

    Counts counts;
    if (options.instructions)
    {
        auto counted = bench::countInstructions();
        if (const auto* problem = std::get_if<std::string> (&counted)) fail ("bench/valgrind", "instructions could not be counted: " + *problem, "install valgrind, or leave --instructions out");
        counts = std::get<Counts> (std::move (counted));
    }
    options.json ? printJson (results, counts) : printTable (results, counts);
    if (! results.agree()) fail ("bench/disagree", "not all variants give the same outputs, so their times say nothing", "please report it with the machine and the compiler");
}
}   // namespace

void addBench (CLI::App& app)
{
    const auto options = std::make_shared<Options>();
    auto* command = app.add_subcommand ("bench", "Compare Tactus with hand-written code, JUCE and Faust on this machine");
    command->add_flag ("--json", options->json, "Ratios as JSON, for programs");
    command->add_flag ("--quick", options->quick, "Few rounds: to see that it works, not how fast");
    command->add_flag ("--instructions", options->instructions, "Count instructions, too; needs valgrind, takes a minute");
    command->add_flag (bench::counted_option, options->counted, "What --instructions runs under valgrind")->group ("");
    command->footer ("First it is checked that all give the same outputs; docs/bench.md says what is compared.\n\n"
                     "Examples:\n"
                     "  tactus bench\n"
                     "  tactus bench --json --instructions > bench.json");
    command->callback ([options]
                       { run (*options); });
}

}   // namespace tactus::host
