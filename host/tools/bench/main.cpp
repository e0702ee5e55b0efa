// SPDX-License-Identifier: GPL-3.0-or-later
// tactus-bench, the program that `tactus bench` starts.
#include "bench.hpp"

#include <host/base/command_line/command.hpp>
#include <tactus/text/json.hpp>

#include <juce_events/juce_events.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <iostream>

namespace tactus::bench
{

namespace
{
using Counts = std::map<std::string, Counted>;

constexpr int fine = 0, failed = 1, wrong_usage = 2;   // as in host/cli/report.hpp

constexpr int block = 200;   // ticks per round: about 100 us, which is shorter than a time slice

std::function<void (int)> blocksOf (const Contest& contest, const Contest::Make& make)
{
    return [&inputs = contest.inputs, variant = std::shared_ptr<Variant> (make())] (int round) {
        auto at = static_cast<std::size_t> (round) * block % inputs.size();
        for (int k = 0; k < block; ++k)
        {
            variant->tick (inputs[at].data());
            if (++at == inputs.size()) at = 0;
        }
    };
}

struct Results
{
    struct Agreed
    {
        Contest contest;
        Agreement found;
    };

    std::vector<Agreed> agreements {};
    std::vector<std::unique_ptr<Pair>> pairs {};
    Memory memory {};

    bool agree() const
    {
        return std::ranges::all_of (agreements, [] (const Agreed& a) { return a.found.agree; });
    }
};

/// Compares the outputs of all variants. Runs before anything is timed.
void agree (Results& results, bool quick)
{
    for (auto& contest : contests (quick))
    {
        const auto found = compare (contest);
        results.agreements.push_back ({ std::move (contest), found });
    }
}

/// Times the variants (docs/bench.md). `quick` runs only a few rounds, enough to see that it works.
void time (Results& results, bool quick, bool quiet)
{
    const auto add = [&] (Pair pair) { results.pairs.push_back (std::make_unique<Pair> (std::move (pair))); };
    for (const auto& [contest, found] : results.agreements)
        add ({ contest.key, blocksOf (contest, contest.make_first), blocksOf (contest, contest.make_second), block, block, quick ? 40 : 4000 });
    add (juceRebuild (quick));
    for (auto& pair : largeGraphs (quick))
        add (std::move (pair));
    measure (results.pairs, quiet);
    results.memory = memoryPerNode();
}

struct Options
{
    bool json = false, quick = false, instructions = false, counted = false;
};

void printAgreements (const Results& results)
{
    for (const auto& [contest, found] : results.agreements)
    {
        const auto* verdict = found.agree ? "agree" : "DISAGREE";
        std::printf ("%s and %s %s: %s, %zu numbers, ", contest.first.c_str(), contest.second.c_str(), verdict, contest.about.c_str(), found.values);
        if (contest.tolerance > 0.0)
            std::printf ("within %.0e (seen %.0e)\n", contest.tolerance, found.worst);
        else
            std::printf (found.agree ? "bit for bit\n" : "different by %.0e\n", found.worst);
    }
    std::printf ("\n");
    std::fflush (stdout);
}

std::string timeText (double seconds)
{
    const auto in = [seconds] (double factor, const char* unit) {
        char text[32];
        return std::string (text, static_cast<std::size_t> (std::snprintf (text, sizeof text, "%.4g %s", seconds * factor, unit)));
    };
    if (seconds < 1e-5) return in (1e9, "ns");
    return seconds < 1e-2 ? in (1e6, "us") : in (1e3, "ms");
}

void printTable (const Results& results, const Counts& counts)
{
    std::printf ("\n%-30s %10s %10s   %8s  %s\n", "", "first", "second", "ratio", "95 % interval of the median");
    for (const auto& pair : results.pairs)
    {
        const auto ratio = pair->ratio();
        const auto first = timeText (medianOf (pair->first_s)), second = timeText (medianOf (pair->second_s));
        std::printf ("%-30s %10s %10s   %8.3f  %.3f to %.3f\n", pair->name.c_str(), first.c_str(), second.c_str(), ratio.median, ratio.low, ratio.high);
    }
    std::printf ("%-30s %.0f to tick, and %.0f to edit, for each node, in addition to its own struct\n",
                 "bytes_per_node", results.memory.to_tick, results.memory.to_edit);
    if (! counts.empty()) std::printf ("\ninstructions per tick\n");
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

    Json all { { "ratios", ratios },
               { "bytes_per_node", results.memory.to_tick },
               { "bytes_per_node_to_edit", results.memory.to_edit },
               { "agree", results.agree() } };
    if (! counts.empty()) all["instructions"] = instructions;
    std::cout << all.dump (2) << '\n';
}

int fail (const std::string& id, const std::string& what, const std::string& remedy)
{
    std::cerr << "error: " << what << "\n    " << remedy << " [" << id << "]\n";
    return failed;
}

int run (const Options& options)
{
    const juce::ScopedJuceInitialiser_GUI messages;
    if (options.counted)
    {
        runToBeCounted();
        return fine;
    }

    Results results;
    agree (results, options.quick);
    if (! options.json) printAgreements (results);
    time (results, options.quick, options.json);

    Counts counts;
    if (options.instructions)
    {
        auto counted = countInstructions();
        if (const auto* problem = std::get_if<std::string> (&counted))
            return fail ("bench/valgrind", "instructions could not be counted: " + *problem, "install valgrind, or leave out --instructions");
        counts = std::get<Counts> (std::move (counted));
    }
    options.json ? printJson (results, counts) : printTable (results, counts);
    if (! results.agree())
        return fail ("bench/disagree", "the variants do not all give the same outputs, so their times mean nothing",
                     "please report it, and include the machine and the compiler");
    if (! std::cout.flush()) return fail ("output/unwritable", "writing to the standard output failed",
                                          "check the disk, or the program that the output is piped into");
    return fine;
}

int main (int argc, char** argv)
{
    Options options;
    const host::Command app { "Compare Tactus with hand-written code, JUCE and Faust on this machine", "tactus bench" };
    app.addFlag ("--json", options.json, "Print the ratios as JSON, for use by programs");
    app.addFlag ("--quick", options.quick, "Run only a few rounds: shows that the benchmark works, not how fast anything is");
    app.addFlag ("--instructions", options.instructions, "Also count instructions; needs valgrind and takes a minute");
    app.addHiddenFlag (counted_option, options.counted);
    app.footer ("First checks that all variants give the same outputs. docs/bench.md describes what is compared.\n\n"
                "Examples:\n"
                "  tactus bench\n"
                "  tactus bench --json --instructions > bench.json");
    if (const auto status = app.parse (argc, argv)) return *status == 0 ? fine : wrong_usage;
    return run (options);
}
}   // namespace

}   // namespace tactus::bench

int main (int argc, char** argv)
{
    try
    {
        return tactus::bench::main (argc, argv);
    }
    catch (const std::exception& e)
    {
        std::fprintf (stderr, "tactus-bench: error: %s\n    this should not happen; please report it, and include the command\n", e.what());
        return 1;
    }
}
