// SPDX-License-Identifier: MIT
#include "sections.hpp"

#include <tactus/text/budget.hpp>
#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <queue>
#include <set>
#include <string>
#include <vector>

namespace tactus::plan
{

namespace
{
int readFactor (const Json& value, const char* key, const std::string& path, Origin here, Flat& flat)
{
    constexpr double most = 1e6;
    const double n = value.is_number() ? value.get<double>() : 0.0;
    if (n >= 1.0 && n <= most && n == std::floor (n)) return static_cast<int> (n);
    flat.error ("rate/value", flat.at (here, key),
                "`" + std::string (key) + "` of '" + path + "' is " + value.dump() + ", but it must be a whole number from 1 to 1000000",
                "write 2 or more, or remove the key");
    return 1;
}

bool isWithin (const Flat& flat, int section, int outer)
{
    while (section > outer)
        section = flat.section (section).around;
    return section == outer;
}

/// Finds the nodes that have a path to a sink that acts on a hand.
class Downstream
{
public:
    explicit Downstream (const Flat& f) : flat (f), out (f.nodes.size()), leads (f.nodes.size(), false)
    {
        std::vector<std::vector<int>> into (flat.nodes.size());
        for (const auto& w : flat.wires)
            if (w.from)
            {
                out[at (w.from->node)].push_back (&w);
                into[at (w.to.node)].push_back (w.from->node);
            }
        std::vector<int> open;
        const auto reach = [&] (int n) {
            if (leads[at (n)]) return;
            leads[at (n)] = true;
            open.push_back (n);
        };
        for (int n = 0; n < flat.nodeCount(); ++n)
            if (acts (n)) reach (n);
        while (! open.empty())
        {
            const int n = open.back();
            open.pop_back();
            std::ranges::for_each (into[at (n)], reach);
        }
    }

    bool leadsToTheHand (int node) const { return leads[at (node)]; }

    /// Describes the shortest path from a section to a sink that acts on a hand. There must be such a path.
    std::string pathFrom (int section) const
    {
        std::vector<const FlatWire*> by (flat.nodes.size(), nullptr);   // by node: the wire that reached it; null inside the section
        std::vector<bool> seen (flat.nodes.size(), false);
        std::queue<int> open;
        const auto reach = [&] (int n, const FlatWire* w) {
            if (seen[at (n)]) return;
            seen[at (n)] = true;
            by[at (n)] = w;
            open.push (n);
        };
        for (int n = 0; n < flat.nodeCount(); ++n)
            if (isWithin (flat, flat.node (n).section, section)) reach (n, nullptr);
        for (; ! acts (open.front()); open.pop())
            for (const auto* w : out[at (open.front())])
                reach (w->to.node, w);

        const int sink = open.front();
        if (by[at (sink)] == nullptr) return "'" + flat.node (sink).path + "' is inside this subgraph";
        std::string text;
        for (int n = sink; by[at (n)] != nullptr; n = by[at (n)]->from->node)
            text = flat.nameOf (*by[at (n)]->from) + " -> " + flat.nameOf (by[at (n)]->to) + (text.empty() ? "" : ", then " + text);
        return text;
    }

private:
    const Flat& flat;
    std::vector<std::vector<const FlatWire*>> out;
    std::vector<bool> leads;

    bool acts (int n) const { return flat.node (n).type->effort != nullptr && flat.node (n).runs(); }
};
}   // namespace

int openSection (const graph::Node& node, int around, const std::string& path, Origin here, Flat& flat)
{
    const bool every = node.extra.contains ("every"), times = node.extra.contains ("times");
    if (node.extra.contains ("hold") && ! every)
        flat.warn ("rate/hold_alone", flat.at (here, "hold"), "'" + path + "' has a `hold`, but no `every`, so there is nothing to hold",
                   "remove `hold`, or add \"every\"");
    if (const auto hold = node.extra.value ("hold", Json ("latch")); hold != "latch" && hold != "linear")
        flat.error ("rate/value", flat.at (here, "hold"), "`hold` of '" + path + "' is " + hold.dump() + ", but it must be \"latch\" or \"linear\"",
                    "write \"latch\", or remove the key");
    if (every && times)
        flat.error ("rate/both", flat.at (here, "times"), "'" + path + "' has both `every` and `times`, but it cannot run both less often and more often",
                    "remove one of them");
    if (every == times) return around;

    const auto* key = every ? "every" : "times";
    const int factor = readFactor (node.extra.at (key), key, path, here, flat);
    if (factor == 1) return around;
    flat.sections.push_back ({ .around = around,
                               .kind = every ? Section::Kind::every : Section::Kind::times,
                               .factor = factor,
                               .linear = every && node.extra.value ("hold", Json()) == "linear",
                               .path = path,
                               .origin = flat.at (here, key) });
    return flat.sectionCount() - 1;
}

void refuseSection (const graph::Node& node, const std::string& prefix, Origin here, Flat& flat)
{
    if (node.extra.empty()) return;
    for (const auto* key : { "every", "times", "hold" })
        if (node.extra.contains (key))
            flat.error ("rate/no_subgraph", flat.at (here, key),
                        "'" + prefix + node.name + "' (" + node.type + ") has a `" + key + "`, but only subgraphs run at their own rate",
                        "collapse it into a subgraph, and set the rate there");
}

namespace
{
/// A tick with too many runs takes seconds or hours, in which nothing can end the run.
void checkRuns (Flat& flat)
{
    std::vector<double> speeds;   // by section
    for (int s = 0; s < flat.sectionCount(); ++s)
        speeds.push_back (flat.speed (s));
    double runs = 0.0;
    for (int n = 0; n < flat.nodeCount(); ++n)
        runs += speeds[at (flat.node (n).section)];
    if (runs <= budgets().runs) return;
    const auto fastest = static_cast<int> (std::ranges::max_element (speeds) - speeds.begin());
    auto over = overBudget ("graph/too_large", &Budgets::runs, "in one tick, the graph", runs, "use smaller `times`, or fewer nodes in these sections");
    flat.error (std::move (over.id), flat.section (fastest).origin, std::move (over.text), std::move (over.remedy));
}
}   // namespace

void checkSections (Flat& flat, double rate_hz)
{
    if (flat.sections.size() == 1) return;
    constexpr double lowest = 1.0, highest = 1e6;
    constexpr int none = -1;
    std::vector<int> fast (flat.sections.size(), none);   // by section: the outermost `times` section that encloses it
    for (int s = 1; s < flat.sectionCount(); ++s)
    {
        const auto section = flat.section (s);
        const double rate = rate_hz * flat.speed (s);
        if (rate < lowest || rate > highest)
            flat.error ("rate/value", section.origin, "'" + section.path + "' would run at " + numberText (rate) + " Hz",
                        "change `every` or `times`: sections run at 1 Hz to 1 MHz, and the graph runs at " + numberText (rate_hz) + " Hz");

        fast[at (s)] = fast[at (section.around)];
        if (fast[at (s)] == none && section.kind == Section::Kind::times) fast[at (s)] = s;
    }
    if (std::ranges::count (fast, none) == std::ssize (fast)) return;
    checkRuns (flat);

    const Downstream downstream { flat };
    std::set<int> reported;
    for (int n = 0; n < flat.nodeCount(); ++n)
    {
        const int s = fast[at (flat.node (n).section)];
        if (s == none || ! downstream.leadsToTheHand (n) || flat.isFull() || ! reported.insert (s).second) continue;
        const auto section = flat.section (s);
        flat.error ("rate/to_the_hand", section.origin,
                    "'" + section.path + "' runs " + std::to_string (section.factor)
                        + " times a tick, on interpolated inputs that are already in the past, but its outputs return to the hand: " + downstream.pathFrom (s),
                    "leave out `times`; compute what the hand feels once per tick, from its current position");
    }
}

}   // namespace tactus::plan
