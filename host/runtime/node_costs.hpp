// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ring_index.hpp"
#include "tick_clock.hpp"

#include <framework/plan/plan.hpp>
#include <framework/random.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace tactus::host
{

/// What a node costs, with the sums, delays and driven parameters before it. Of a subgraph with a rate of its own, which runs
/// as a whole, all of it: its type is "subgraph".
struct NodeCost
{
    std::string node, type;   ///< "left/drag", "friction.elasto_plastic"
    double mean_s = 0.0;      ///< per tick
    double share = 0.0;       ///< of all nodes together, 0…1
};

/// Finds out what each node of a running plan costs. On some ticks it steps the records itself, in their order, and
/// looks at the clock between them, or of a large plan between a part of them: the same bits as Plan::tick. Looking takes
/// `part` of the time that ticks take, whatever the plan; when it looks is left to chance, so that nodes that work only
/// now and then are met as often as they work. Other programs of the machine count for the node that they interrupt.
class NodeCosts
{
public:
    static constexpr double part = 0.005;

    explicit NodeCosts (const TickClock&);

    /// Learns what a look at the clock takes. [tick thread, before the first tick]
    void begin() noexcept;

    void tick (Plan&) noexcept;           // [tick thread]
    void earn (double took_s) noexcept;   ///< what the tick took as a whole   [tick thread]

    /// Takes in what was measured, so that there is room for more; to be called some times a second. [main thread]
    void collect();

    /// Of the nodes of a plan that were met, the costliest first. [main thread]
    std::vector<NodeCost> of (const Plan&);

private:
    struct Sample
    {
        std::uint64_t serial;   // of the node
        double took_s;
    };

    /// The mean of the latest samples, `most` or so.
    struct Mean
    {
        static constexpr int most = 1000;

        double value = 0.0;
        int count = 0;

        void add (double x) noexcept;
    };

    void look (Plan&, std::size_t first, std::size_t end) noexcept;

    static constexpr std::size_t capacity = 8192, fewest = 64;   // samples; records at a time

    const TickClock& clock;

    // Of the tick thread.
    Random random;
    double look_s = 0.0, credit_s = 0.0, most_credit_s = 0.0, patience = 1.0;
    std::size_t next = 0;   // record

    RingIndex index { capacity };
    std::vector<Sample> samples = std::vector<Sample> (capacity);

    std::map<std::uint64_t, Mean> means;   // by serial   [main thread]
};

/// "'bar' (vibration.modal) takes 83 % of a tick"
std::string describe (const NodeCost&);

}   // namespace tactus::host
