// SPDX-License-Identifier: MIT
#include "node_costs.hpp"

#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tactus
{

namespace
{
/// The outermost section that encloses a node, which runs as one record; null if the node has its own records.
const plan::Section* sectionAround (const plan::Flat& flat, const plan::FlatNode& node)
{
    int section = node.section;
    while (section > 0 && flat.section (section).around > 0)
        section = flat.section (section).around;
    return section > 0 ? &flat.sections[static_cast<std::size_t> (section)] : nullptr;
}
}   // namespace

NodeCosts::NodeCosts (const TickClock& c) : clock (c) {}

void NodeCosts::begin() noexcept
{
    constexpr int rounds = 16, looks = 64;
    constexpr double first_looks = 1000;   // so that the first tick is measured: the graph may be so slow that there is no second tick
    look_s = 1.0;
    for (int r = 0; r < rounds; ++r)   // the smallest value counts: anything more is due to other programs
    {
        const double before = clock.now();
        double after = before;
        for (int i = 0; i < looks; ++i)
            after = clock.now();
        look_s = std::min (look_s, (after - before) / looks);
    }
    look_s = std::max (look_s, 1e-9);
    credit_s = first_looks * look_s;
    priced = none;
}

/// The time it takes to measure this many records.
double NodeCosts::priceOf (std::size_t records) const noexcept
{
    return static_cast<double> (static_cast<std::int64_t> (records + 1)) * look_s;   // signed numbers convert in one instruction
}

void NodeCosts::price (std::size_t records) noexcept
{
    priced = records;
    most_credit_s = 2.0 * priceOf (records);
    wanted_s = records > 0 ? patience * priceOf (std::min (records, fewest)) : std::numeric_limits<double>::infinity();
}

void NodeCosts::tick (Plan& plan) noexcept
{
    if (const auto n = plan.records().size(); n != priced) price (n);
    credit_s < wanted_s ? plan.tick() : measure (plan);
}

void NodeCosts::measure (Plan& plan) noexcept
{
    const auto n = plan.records().size();
    const auto first = next < n ? next : 0;
    const auto affordable = std::max (fewest, static_cast<std::size_t> (credit_s / look_s));
    const auto end = first + std::min (n - first, affordable);
    poll (plan, first, end);
    next = end;
    credit_s -= priceOf (end - first);
    patience = 0.5 + random.uniform();
    price (n);
}

void NodeCosts::poll (Plan& plan, std::size_t first, std::size_t end) noexcept
{
    double before = 0.0;
    plan.tick ([&] (std::size_t r, auto step) {
        if (r == first) before = clock.now();
        step();
        if (r < first || r >= end) return;
        const double now = clock.now();
        samples.put ({ plan.instances()[plan.owners()[r]].serial, std::max (0.0, now - before - look_s) });
        samples.commit();
        before = now;
    });
}

void NodeCosts::earn (double took_s) noexcept
{
    credit_s = std::min (credit_s + part * took_s, most_credit_s);   // the limit keeps slow ticks from being followed by many measured ticks in a row
}

void NodeCosts::Mean::add (double x) noexcept
{
    count = std::min (count + 1, most);
    value += (x - value) / count;
}

void NodeCosts::collect()
{
    samples.drain ([this] (std::span<const Sample> sample) { means[sample[0].serial].add (sample[0].took_s); });
}

std::vector<NodeCost> NodeCosts::of (const Plan& plan)
{
    collect();
    std::vector<int> records (plan.instances().size(), 0);
    for (const auto owner : plan.owners())
        ++records[owner];

    std::vector<NodeCost> costs;
    std::map<std::uint64_t, Mean> still_there;
    double all = 0.0;
    for (std::size_t i = 0; i < records.size(); ++i)
    {
        const auto mean = means.find (plan.instances()[i].serial);
        if (mean == means.end()) continue;
        still_there.insert (*mean);
        if (records[i] == 0) continue;   // the node is muted
        // Each sample times one of the node's records, and all its records are timed equally often.
        const double cost_s = mean->second.value * records[i];
        const auto* section = sectionAround (plan.flat(), plan.flat().nodes[i]);
        costs.push_back ({ section ? section->path : plan.flat().nodes[i].path, section ? "subgraph" : std::string (plan.flat().nodes[i].type->info.id),
                           cost_s, 0.0 });
        all += costs.back().mean_s;
    }
    means = std::move (still_there);
    for (auto& c : costs)
        c.share = all > 0.0 ? c.mean_s / all : 0.0;
    std::ranges::stable_sort (costs, std::ranges::greater {}, &NodeCost::mean_s);
    return costs;
}

std::string describe (const NodeCost& cost)
{
    return "'" + cost.node + "' (" + cost.type + ") takes " + numberText (std::round (100.0 * cost.share)) + " % of a tick";
}

}   // namespace tactus
