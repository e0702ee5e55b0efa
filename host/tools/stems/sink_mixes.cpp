// SPDX-License-Identifier: GPL-3.0-or-later
#include "sink_mixes.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <utility>

namespace tactus::host
{

namespace
{
using Id = std::string_view;

constexpr std::array<std::pair<Id, Id>, 4> sink_inputs {
    { { "device.force", "force" }, { "device.force", "torque" }, { "device.effort", "effort" }, { "device.signal_out", "in" } }
};
constexpr std::array<Id, 4> adders { "signal.add", "signal.mix", "vector.add", "vector.join" };

Id typeOf (const plan::FlatNode& n) { return n.type == nullptr ? Id {} : n.type->info.id; }

class Walk
{
public:
    explicit Walk (const plan::Flat& flat) : f (flat), into (f.nodes.size()), leads_to (f.nodes.size()), carries (f.nodes.size())
    {
        for (std::size_t w = 0; w < f.wires.size(); ++w)
            into[at (f.wires[w].to.node)].push_back (w);
        for (const auto& w : f.wires)
            if (w.from && w.to.role == Role::input) leads_to[at (w.from->node)].push_back (w.to.node);
        std::vector<int> next;
        for (int n = 0; n < f.nodeCount(); ++n)
            if (isMix (n)) next.push_back (n);
        while (! next.empty())
        {
            const int n = next.back();
            next.pop_back();
            for (const int to : leads_to[at (n)])
                if (! f.node (to).muted && ! carries[at (to)])
                {
                    carries[at (to)] = true;
                    next.push_back (to);
                }
        }
    }

    SinkMix of (const plan::PortRef& input)
    {
        SinkMix found { .sink = input.node, .input = input, .name = f.nameOf (input) };
        seen.clear();
        for (const auto w : into[at (input.node)])
        {
            const auto& wire = f.wires[w];
            if (! isInto (wire, input)) continue;
            found.is_direct = found.is_direct || (wire.from && isMix (wire.from->node));
            follow (w, found);
        }
        for (auto& u : found.unmixed)
            u.through = between (f.wires[u.wire].to.node, input);
        std::ranges::sort (found.mixers);
        std::ranges::sort (found.unmixed, {}, &UnmixedWire::wire);
        return found;
    }

    bool hasWire (const plan::PortRef& input) const
    {
        return std::ranges::any_of (into[at (input.node)], [&] (std::size_t w) { return isInto (f.wires[w], input); });
    }

private:
    const plan::Flat& f;
    std::vector<std::vector<std::size_t>> into;   // by node: its wires
    std::vector<std::vector<int>> leads_to;       // by node: the nodes that its outputs are inputs of
    std::vector<bool> carries;                    // by node: a mix goes into it
    std::set<int> seen;

    /// True if a wire ends at an input, or at a component of it.
    static bool isInto (const plan::FlatWire& w, const plan::PortRef& input)
    {
        return w.to.role == input.role && w.to.port == input.port && w.to.index == input.index;
    }

    /// The nodes on all ways from one node, with it, to an input of another node.
    std::vector<int> between (int first, const plan::PortRef& input) const
    {
        std::vector<bool> leads (f.nodes.size()), comes (f.nodes.size());
        std::vector<int> next;
        const auto visit = [&] (std::vector<bool>& seen_there, int n) {
            if (n == input.node || f.node (n).muted || seen_there[at (n)]) return;
            seen_there[at (n)] = true;
            next.push_back (n);
        };
        for (const auto w : into[at (input.node)])
            if (f.wires[w].from && isInto (f.wires[w], input)) visit (leads, f.wires[w].from->node);
        while (! next.empty())
        {
            const int n = next.back();
            next.pop_back();
            for (const auto w : into[at (n)])
                if (f.wires[w].from && f.wires[w].to.role == Role::input) visit (leads, f.wires[w].from->node);
        }
        visit (comes, first);
        while (! next.empty())
        {
            const int n = next.back();
            next.pop_back();
            for (const int to : leads_to[at (n)])
                visit (comes, to);
        }
        std::vector<int> all;
        for (int n = 0; n < f.nodeCount(); ++n)
            if (leads[at (n)] && comes[at (n)]) all.push_back (n);
        return all;
    }

    bool isMix (int node) const { return isLayerMixer (f.node (node)) && f.node (node).runs(); }

    void follow (std::size_t w, SinkMix& found)
    {
        const auto& from = f.wires[w].from;
        if (from && f.node (*from).muted) return;
        if (from && isMix (from->node))
        {
            if (std::ranges::count (found.mixers, from->node) == 0) found.mixers.push_back (from->node);
            return;
        }
        if (! from || ! carries[at (from->node)]) return found.unmixed.push_back ({ w, from ? f.nameOf (*from) : std::string() });
        if (! seen.insert (from->node).second) return;
        const bool adds = std::ranges::count (adders, typeOf (f.node (*from))) > 0;
        const auto& wires = into[at (from->node)];
        for (const auto v : wires)
        {
            const auto isWithMix = [&] (std::size_t u) {
                const auto& other = f.wires[u];
                return isInto (other, f.wires[v].to) && other.from && (isMix (other.from->node) || carries[at (other.from->node)]);
            };
            if (f.wires[v].to.role == Role::input && (adds || std::ranges::any_of (wires, isWithMix))) follow (v, found);
        }
    }
};
}   // namespace

bool isLayerMixer (const plan::FlatNode& n) { return typeOf (n) == "layer.mix" || typeOf (n) == "layer.mix_vectors"; }

std::vector<SinkMix> sinkMixes (const plan::Flat& flat)
{
    Walk walk (flat);
    std::vector<SinkMix> all;
    for (int n = 0; n < flat.nodeCount(); ++n)
    {
        const auto& node = flat.node (n);
        if (node.type == nullptr || ! node.runs()) continue;
        for (std::size_t p = 0; p < node.type->inputs.size(); ++p)
        {
            const plan::PortRef input { .node = n, .role = Role::input, .port = static_cast<int> (p) };
            const std::pair<Id, Id> named { typeOf (node), node.type->inputs[p].id };
            if (std::ranges::count (sink_inputs, named) > 0 && walk.hasWire (input)) all.push_back (walk.of (input));
        }
    }
    return all;
}

}   // namespace tactus::host
