// SPDX-License-Identifier: MIT
// Counts late ticks of a large graph that is edited while it runs:
//
//     late_ticks [SECONDS [NODES [RATE]]]
//
// It runs in turns without edits, with one compilation per 200 ms whose plan is thrown away, and with one edit per 200 ms, so that all three
// have the same share of what else the machine does. SECONDS is the time for each of the three.

#include <tactus/graph/endpoint_text.hpp>
#include <tactus/graph/history.hpp>
#include <tactus/plan/compile.hpp>
#include <tactus/run/run.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <utility>

using namespace tactus;

namespace
{
enum class Work
{
    none,
    compiling,
    edits
};

struct Total
{
    const char* name;
    std::uint64_t ticks = 0, late = 0, edits = 0;
    double late_s = 0.0, longest_late_s = 0.0, tick_s = 0.0, longest_tick_s = 0.0;   // without `longest`: the worst 99.9 % quantile of all turns
};

/// A tree of filters: each one feeds two others.
graph::Graph tree (int nodes, double rate)
{
    graph::Graph g;
    g.rate_hz = rate;
    for (int i = 0; i < nodes; ++i)
    {
        graph::Node node;
        node.name = "p" + std::to_string (i);
        node.type = "filter.one_pole";
        g.root.nodes.push_back (std::move (node));
        if (i > 0) g.root.wires.push_back (*graph::parseWire ("p" + std::to_string ((i - 1) / 2) + ".out -> p" + std::to_string (i) + ".in"));
    }
    return g;
}

/// Removes the last wire of the graph, or restores it.
void editOnce (graph::History& history, const graph::Wire& last, bool removes)
{
    if (removes)
        (void)history.perform (graph::RemoveWire { "", last.id }, graph::Step::joined);
    else
        (void)history.perform (graph::AddWire { "", last }, graph::Step::joined);
}

void take (Run& run, graph::History& history, Work work)
{
    if (work == Work::compiling) (void)run.check (history.graph());
    if (work != Work::edits) return;
    auto edit = run.edit (history.graph());
    if (edit.plan() == nullptr) std::abort();
    edit.commit();
}

void play (Work work, double seconds, int nodes, double rate, Total& total)
{
    using namespace std::chrono;
    graph::History history (tree (nodes, rate), nullptr);
    const auto last = history.graph().root.wires.back();
    Run run (catalogue(), {});
    if (hasErrors (run.load (history.graph()))) std::abort();
    AbsoluteTimer clock (1.0 / rate);
    const auto refused = run.start (clock);
    static bool is_first = true;
    if (std::exchange (is_first, false))
        for (const auto& sentence : refused)
            std::printf ("%s\n", sentence.c_str());

    const auto begin = steady_clock::now();
    for (int i = 0; steady_clock::now() - begin < duration<double> (seconds); ++i)
    {
        if (i % 10 == 9)
        {
            if (work == Work::edits) editOnce (history, last, i / 10 % 2 == 0);
            take (run, history, work);
            total.edits += work == Work::none ? 0 : 1;
        }
        run.poll();
        std::this_thread::sleep_for (20ms);
    }
    const auto& account = run.live().account();
    total.ticks += account.ticks();
    total.late += account.misses();
    total.late_s = std::max (total.late_s, account.lateness().quantile (0.999));
    total.longest_late_s = std::max (total.longest_late_s, account.lateness().longest());
    total.tick_s = std::max (total.tick_s, account.computing().quantile (0.999));
    total.longest_tick_s = std::max (total.longest_tick_s, account.computing().longest());
    run.end();
}
}   // namespace

int main (int argc, char** argv)
{
    const auto argument = [&] (int i, double otherwise) { return argc > i ? std::atof (argv[i]) : otherwise; };
    const double seconds = argument (1, 60.0), rate = argument (3, 4000.0), turn_s = std::min (seconds, 5.0);
    const int nodes = static_cast<int> (argument (2, 10000.0));

    std::array totals { Total { "no edits" }, Total { "compiled, not taken over" }, Total { "edits" } };
    for (double played = 0.0; played < seconds; played += turn_s)
        for (const auto work : { Work::none, Work::compiling, Work::edits })
            play (work, turn_s, nodes, rate, totals[static_cast<std::size_t> (work)]);

    std::printf ("%-26s %8s %6s %6s   %s\n", "", "ticks", "edits", "late", "99.9 % and longest: late by, ticks take");
    const auto whole = [] (auto n) { return static_cast<unsigned long long> (n); };
    for (const auto& t : totals)
    {
        std::printf ("%-26s %8llu %6llu %6llu", t.name, whole (t.ticks), whole (t.edits), whole (t.late));
        std::printf ("   %.0f and %.0f us, %.0f and %.0f us\n", 1e6 * t.late_s, 1e6 * t.longest_late_s, 1e6 * t.tick_s, 1e6 * t.longest_tick_s);
    }
    return 0;
}
