// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "variant.hpp"

#include <tactus/graph/graph.hpp>
#include <tactus/plan/compile.hpp>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace tactus::bench
{

// How two variants are compared: measure.cpp.

/// Two ways to compute the same thing. The second is the yardstick for the first.
struct Contest
{
    using Make = std::function<std::unique_ptr<Variant>()>;
    using Row = std::vector<double>;   ///< the inputs of one tick

    std::string key;             ///< as in the JSON: "juce/plan"
    std::string first, second;   ///< names that are shown to the user
    std::string about;           ///< what both compute
    Make make_first, make_second;
    std::vector<Row> inputs;
    double tolerance = 0.0;   ///< largest allowed difference between outputs; 0 means bit for bit
};

struct Agreement
{
    bool agree = false;
    double worst = 0.0;       ///< largest difference found
    std::size_t values = 0;   ///< number of values that were compared
};

Agreement compare (const Contest&);

/// The time of the first function of a pair divided by that of the second, over many rounds.
struct Ratio
{
    double median = 0.0, low = 0.0, high = 0.0;   ///< low to high: the 95 % confidence interval of the median
};

/// Uses order statistics, so it assumes nothing about the distribution. With fewer than six rounds, low and high are the smallest
/// and the largest ratio, which covers less than 95 %.
Ratio ratioOf (std::vector<double> rounds);

double medianOf (std::vector<double> values);

/// Two functions timed against each other. In each round one runs right after the other, and they take turns going first. Other
/// load on the machine then affects both equally, so their ratio is reliable even if their times are not.
struct Pair
{
    std::string name;   ///< such as "plan/hand": the name of the first, a slash, and the name of the second
    std::function<void (int round)> first, second;
    double first_work = 1.0, second_work = 1.0;   ///< work done in one round; the time is divided by it
    int rounds = 1;
    std::function<void (int round)> prepare {};   ///< runs before the first in each round, untimed

    std::vector<double> first_s {}, second_s {};   ///< time of each round in s, filled by measure()

    Ratio ratio() const;
};

/// Runs the pairs through Google Benchmark, which prints the times unless `quiet` is set.
void measure (std::vector<std::unique_ptr<Pair>>&, bool quiet);

// What several comparisons run: graphs.cpp.

/// A graph run by Tactus. The input is the tool position if the graph has a device, otherwise a feed.
class Planned : public Variant
{
public:
    /// Throws if the graph does not compile.
    explicit Planned (const graph::Graph&, const CompileOptions& = {}, const Catalogue& = catalogue());

    void tick (const double* in) noexcept override;
    const std::shared_ptr<Plan>& running() const noexcept { return plan; }
    std::vector<double> outputs() const override;   ///< the force on the device, or the recorded ports if there is no device

private:
    std::shared_ptr<Plan> plan;
    DeviceState* device = nullptr;
};

template <typename V>
std::unique_ptr<Variant> make()
{
    return std::make_unique<V>();
}

/// Makes a plan of this graph. A graph of one-poles is fed at p0.
Contest::Make planOf (graph::Graph);

/// The preset graphs/padded_bench.json, as it was at build time.
const graph::Graph& reference();

/// The tool position on each tick while the graph's simulated hand strokes. All variants get the same path.
std::vector<Contest::Row> strokeOver (const graph::Graph&);

/// One second of a tone that rises from 0 Hz to 1 kHz.
std::vector<Contest::Row> chirp();

/// Graphs of n filter.one_pole nodes called p0, p1, …, with cutoffs of 200, 210, … Hz that repeat after a hundred nodes.
graph::Graph chainOfOnePoles (int n);   ///< each one feeds the next
graph::Graph treeOfOnePoles (int n);    ///< each one feeds two others; p0 is the root

/// The same graph with its nodes in a random order, as after many edits. The order is the same every time.
graph::Graph shuffled (graph::Graph);

/// Feeds p0 of a graph of one-poles, and records the nodes that do not feed another node.
CompileOptions endsOf (const graph::Graph&);

// The comparisons, each in a file of its name. JUCE runs and edits graphs on the message thread only. [message thread]

std::vector<Contest> handContests();
std::vector<Contest> lightContests();
std::vector<Contest> dryWoodContests();
std::vector<Contest> juceContests();
std::vector<Contest> faustContests();

/// All of these. Contests of plans follow once more with the plan fused (docs/fusion.md), compiled without optimisation if `quick`. Without a
/// compiler, these are missing, and the reason is printed to stderr.
std::vector<Contest> contests (bool quick = false);

/// The time in which JUCE rebuilds what it runs after one edit.
Pair juceRebuild (bool quick);

/// Compiles a tree of one-poles in random order so many times.
std::function<void (int)> compiling (int nodes, int times);
std::vector<Pair> largeGraphs (bool quick);

/// The heap memory, in bytes, that a plan uses for each node in addition to the node's own struct. Includes the allocator's overhead.
struct Memory
{
    double to_tick = 0.0;   ///< memory that a tick reads and writes: outputs, records, pointers
    double to_edit = 0.0;   ///< memory for turning knobs and for compiling the next plan: the compiled graph, and the knobs
};

/// Measured on a chain of ten thousand one-poles.
Memory memoryPerNode();

// Counts of instructions: instructions.cpp.

/// Instructions per tick, for the first and the second variant of a contest.
struct Counted
{
    double first = 0.0, second = 0.0;
};

/// Runs this program again under valgrind and counts. No clock is involved, so the numbers are the same each time. Returns the
/// counts by contest key, or a sentence that says what went wrong. [message thread]
std::variant<std::map<std::string, Counted>, std::string> countInstructions();

/// The part that valgrind counts, in the program that it runs. [message thread]
void runToBeCounted();

/// The option that makes the program call runToBeCounted.
inline constexpr const char* counted_option = "--counted";

}   // namespace tactus::bench
