// SPDX-License-Identifier: GPL-3.0-or-later
#include "node_costs.hpp"

#include <framework/number_text.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::host
{

namespace
{
/// The outermost section that a node runs in with others, as one record; null if it runs by itself.
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
    constexpr double first_looks = 1000;   // a graph may be so heavy that there is no second tick to look at
    look_s = 1.0;
    for (int r = 0; r < rounds; ++r)   // the least counts: the rest is other programs
    {
        const double before = clock.now();
        double after = before;
        for (int i = 0; i < looks; ++i)
            after = clock.now();
        look_s = std::min (look_s, (after - before) / looks);
    }
    look_s = std::max (look_s, 1e-9);
    credit_s = first_looks * look_s;
}

void NodeCosts::tick (Plan& plan) noexcept
{
    const auto n = plan.records.size();
    const auto price_s = [this] (std::size_t records)
    { return static_cast<double> (records + 1) * look_s; };
    most_credit_s = 2.0 * price_s (n);
    if (n == 0 || credit_s < patience * price_s (std::min (n, fewest)))
    {
        plan.tick();
        return;
    }
    const auto first = next < n ? next : 0;
    const auto affordable = std::max (fewest, static_cast<std::size_t> (credit_s / look_s));
    const auto end = first + std::min (n - first, affordable);
    look (plan, first, end);
    next = end;
    credit_s -= price_s (end - first);
    patience = 0.5 + random.uniform();
}

void NodeCosts::look (Plan& plan, std::size_t first, std::size_t end) noexcept
{
    const auto step = [&] (std::size_t r)
    {
        const auto& record = plan.records[r];
        record.step (record.self, record.sources, record.outputs);
    };
    for (std::size_t r = 0; r < first; ++r)
        step (r);
    double before = clock.now();
    for (std::size_t r = first; r < end; ++r)
    {
        step (r);
        const double now = clock.now();
        if (const auto slot = index.next())
        {
            samples[*slot] = { plan.instances[plan.owners[r]].serial, std::max (0.0, now - before - look_s) };
            index.push();
        }
        before = now;
    }
    for (std::size_t r = end; r < plan.records.size(); ++r)
        step (r);
    ++plan.number;
}

void NodeCosts::earn (double took_s) noexcept
{
    credit_s = std::min (credit_s + part * took_s, most_credit_s);   // heavy ticks are not followed by a run of looks
}

void NodeCosts::Mean::add (double x) noexcept
{
    count = std::min (count + 1, most);
    value += (x - value) / count;
}

void NodeCosts::collect()
{
    index.drain ([this] (std::size_t slot)
                 { means[samples[slot].serial].add (samples[slot].took_s); });
}

std::vector<NodeCost> NodeCosts::of (const Plan& plan)
{
    collect();
    std::vector<int> records (plan.instances.size(), 0);
    for (const auto owner : plan.owners)
        ++records[owner];

    std::vector<NodeCost> costs;
    std::map<std::uint64_t, Mean> still_there;
    double all = 0.0;
    for (std::size_t i = 0; i < records.size(); ++i)
    {
        const auto mean = means.find (plan.instances[i].serial);
        if (mean == means.end()) continue;
        still_there.insert (*mean);
        if (records[i] == 0) continue;   // muted
        // A sample is of any of its records, each as often as the others.
        const auto* section = sectionAround (plan.flat, plan.flat.nodes[i]);
        costs.push_back ({ section ? section->path : plan.flat.nodes[i].path, section ? "subgraph" : std::string (plan.flat.nodes[i].type->info.id), mean->second.value * records[i], 0.0 });
        all += costs.back().mean_s;
    }
    means = std::move (still_there);
    for (auto& c : costs)
        c.share = all > 0.0 ? c.mean_s / all : 0.0;
    std::ranges::stable_sort (costs, std::ranges::greater {}, &NodeCost::mean_s);
    return costs;
}

std::string describe (const NodeCost& cost) { return "'" + cost.node + "' (" + cost.type + ") takes " + numberText (std::round (100.0 * cost.share)) + " % of a tick"; }

}   // namespace tactus::host
