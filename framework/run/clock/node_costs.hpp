// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/run/tick_clock.hpp>

#include <tactus/kit/random.hpp>
#include <tactus/kit/threads/spsc_ring.hpp>
#include <tactus/plan/plan.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace tactus
{

/// The cost of a node, including the sums, delays and driven parameters before it. A subgraph with its own rate runs as a
/// whole, so it is one entry of type "subgraph".
struct NodeCost
{
    std::string node, type;   ///< "left/drag", "friction.elasto_plastic"
    double mean_s = 0.0;      ///< mean duration per tick
    double share = 0.0;       ///< share of the cost of all nodes, 0…1
};

/// Measures the cost of each node of a running plan. On some ticks it steps the records itself, in order, and reads the clock
/// between them (in a large plan, between some of them); the results are bit-identical to Plan::tick. Measuring takes a
/// fraction `part` of the tick time, for any plan. The measured ticks are random, so nodes that run only occasionally are
/// measured as often as they run. Time used by other programs is charged to the node that they interrupt.
class NodeCosts
{
public:
    static constexpr double part = 0.005;

    explicit NodeCosts (const TickClock&);

    /// Measures the time of one clock read. [tick thread, before the first tick]
    void begin() noexcept;

    void tick (Plan&) noexcept;           // [tick thread]
    void earn (double took_s) noexcept;   ///< allows time for measuring, in proportion to the duration of the tick   [tick thread]

    /// Collects the measurements, to make room for more; call it several times a second. [main thread]
    void collect();

    /// The measured nodes of a plan, the most expensive first. [main thread]
    std::vector<NodeCost> of (const Plan&);

private:
    struct Sample
    {
        std::uint64_t serial;   // serial number of the node
        double took_s;
    };

    /// The mean of about the latest `most` samples.
    struct Mean
    {
        static constexpr int most = 1000;

        double value = 0.0;
        int count = 0;

        void add (double x) noexcept;
    };

    double priceOf (std::size_t records) const noexcept;
    void price (std::size_t records) noexcept;
    void measure (Plan&) noexcept;
    void poll (Plan&, std::size_t first, std::size_t end) noexcept;

    static constexpr std::size_t capacity = 8192, fewest = 64;   // capacity in samples; fewest records measured at a time
    static constexpr std::size_t none = ~std::size_t {};

    const TickClock& clock;

    // Used by the tick thread.
    Random random;
    double look_s = 0.0, credit_s = 0.0, most_credit_s = 0.0, patience = 1.0;
    std::size_t next = 0;   // index of the next record to measure

    // Computed in advance from the number of records and from `patience`, so that a tick need not compute them.
    std::size_t priced = none;   // for how many records
    double wanted_s = 0.0;       // the credit that a tick needs before it measures

    SpscRing<Sample> samples { capacity };

    std::map<std::uint64_t, Mean> means;   // by serial   [main thread]
};

/// "'bar' (vibration.modal) takes 83 % of a tick"
std::string describe (const NodeCost&);

}   // namespace tactus
