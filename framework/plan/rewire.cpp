// SPDX-License-Identifier: MIT
#include "rewire.hpp"
#include "build.hpp"
#include "build_parts.hpp"
#include "compile.hpp"
#include "device_of.hpp"
#include "grouped.hpp"
#include "keeps_units.hpp"
#include "wire_fit.hpp"

#include <tactus/graph/text.hpp>
#include <tactus/text/budget.hpp>

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <utility>

namespace tactus::plan
{

class Rewirer
{
public:
    Rewirer (const Plan& b, const graph::Graph& g) : before (b.parts), graph (g), background (before.background.get()) {}

    static PlanParts& partsOf (Plan& p) { return p.parts; }

    std::shared_ptr<Plan> run (const CompileOptions& options)
    {
        if (! isPossible (options)) return nullptr;
        const auto steps = graph.trail.wiresSince (before.version);
        if (! steps) return nullptr;
        copy();
        if (! changeWires (*steps) || ! keepsDevices() || ! std::ranges::all_of (ends_at, [this] (int n) { return rebuild (n); })) return nullptr;
        moveTaps();
        return followForces() ? std::move (plan) : nullptr;
    }

private:
    static constexpr int most_rewired = 256;   // the storage of each of these plans is kept
    static constexpr std::size_t most_wires = 16;

    const PlanParts& before;
    const graph::Graph& graph;
    const Background* background;
    std::shared_ptr<Plan> plan = std::make_shared<Plan>();
    PlanParts& parts = plan->parts;
    Flat& flat = parts.flat;
    std::vector<int> ends_at;           // the nodes where changed wires end
    std::vector<FlatWire> gone, come;   // the wires that were removed and added

    bool isPossible (const CompileOptions& options) const
    {
        if (background == nullptr || ! background->is_plain || before.rewired >= most_rewired) return false;
        if (options.withdrawn != nullptr || ! options.overrides.empty() || options.lanes != background->lanes || options.settles != background->settles)
            return false;
        const double rate = options.rate_hz > 0.0 ? options.rate_hz : graph.rate_hz;
        return rate == before.rate_hz && options.feeds == background->feeds && options.records == background->records && hasSameFiles (options.assets);
    }

    bool hasSameFiles (Assets* assets) const
    {
        if (background->files.empty()) return true;
        return assets != nullptr && std::ranges::all_of (background->files, [assets] (const auto& isSame) { return isSame (*assets); });
    }

    void copy()
    {
        parts.rate_hz = before.rate_hz;
        parts.number = before.number;
        parts.records = before.records;
        parts.owners = before.owners;
        parts.settled = before.settled;
        parts.roles = before.roles;
        parts.taps = before.taps;
        parts.feeds = before.feeds;
        parts.delays = before.delays;
        parts.storage = before.storage;
        flat = before.flat;
        parts.instances = before.instances;
        parts.lines = before.lines;
        parts.fed = before.fed;
        parts.bound = before.bound;
        parts.lanes = before.lanes;
        parts.exposed = before.exposed;
        parts.ramps.prepare (parts.instances, before.ramps.sharedIndex(), parts.rate_hz);
        parts.background = before.background;
        parts.wire_ends = before.wire_ends;
        parts.version = graph.trail.version();
        parts.rewired = before.rewired + 1;
    }

    //==============================================================================
    bool changeWires (const std::vector<graph::Trail::WireStep>& steps)
    {
        std::vector<graph::Trail::WireStep> last;   // of each wire
        for (const auto& step : steps)
        {
            std::erase_if (last, [&] (const auto& other) { return other.id == step.id; });
            last.push_back (step);
        }
        if (last.size() > most_wires) return false;
        for (const auto& step : last)
            if (! remove (step.id)) return false;
        return std::ranges::all_of (last, [this] (const auto& step) { return step.now == nullptr || add (*step.now); }) && keepsPeeks (gone)
               && keepsPeeks (come);
    }

    /// True if the nodes where these wires start peek as before: only those whose outputs something reads do.
    bool keepsPeeks (const std::vector<FlatWire>& wires) const
    {
        return std::ranges::all_of (wires, [this] (const FlatWire& w) {
            if (! w.from || binds (w.from->node)) return true;
            const int node = w.from->node;
            const auto peeks = [&] (const Record& r) { return r.step == flat.node (node).type->peek && r.self == parts.instances[at (node)].node.get(); };
            const auto starts = [node] (const auto& ends) { return ends.first == node; };
            const auto taps = [node] (const PortRef& port) { return port.role == Role::output && port.node == node; };
            return std::ranges::any_of (parts.records, peeks)
                   == (std::ranges::any_of (parts.wire_ends.ends, starts) || std::ranges::any_of (background->tapped, taps));
        });
    }

    bool remove (graph::Id id)
    {
        auto& [ids, ends] = parts.wire_ends;
        const auto found = std::ranges::find (ids, id);
        if (found == ids.end()) return true;   // it was disabled
        if (std::find (found + 1, ids.end(), id) != ids.end()) return false;
        const auto i = at (found - ids.begin()), last = ids.size() - 1;
        const auto w = flat.wires[i];   // a copy
        if (w.delay > 0 || w.crosses || w.identity.scope != 0 || flat.wires.back().delay > 0) return false;
        if (i != last) flat.wires.change (i) = flat.wires[last];
        flat.wires.drop();
        ids[i] = ids[last];
        ends[i] = ends[last];
        ids.pop_back();
        ends.pop_back();
        endsAt (w);
        gone.push_back (w);
        return keepsUnits (flat, parts.wire_ends, background->units, w) && staysInPlace (w);
    }

    bool add (const graph::Wire& wire)
    {
        if (wire.delay > 0 || ! wire.origin.empty()) return false;
        const auto from = find (wire.from, { Role::output }), to = find (wire.to, { Role::input, Role::param });
        if (! from || ! to || ! flat.node (*to).runs()) return false;
        FlatWire w { .from = from, .to = *to, .add = wire.add, .written = &wire, .identity = { 0, wire.id } };
        if (! readGain (wire, w, flat) || ! wireFits (w, flat)) return false;
        w.written = nullptr;
        const auto is_over = flat.spent.wires + static_cast<double> (flat.wires.size() + 1) > budgets().wires;
        if (! fitsUnits (flat, background->units, w) || ! isAlone (w) || is_over) return false;
        if (! wire.enabled.value_or (true)) return true;
        if (binds (w) && position (from->node) >= position (to->node)) return false;
        flat.wires.add (w);
        parts.wire_ends.add (w);
        endsAt (w);
        come.push_back (w);
        return true;
    }

    void endsAt (const FlatWire& w)
    {
        if (std::ranges::count (ends_at, w.to.node) == 0) ends_at.push_back (w.to.node);
    }

    /// The nodes that get other values. A wire that was replaced by an identical one changes nothing.
    std::vector<int> changedNodes() const
    {
        auto without = gone;
        std::vector<int> nodes;
        for (const auto& w : come)
        {
            const auto isLike = [&w] (const FlatWire& other) { return w.from == other.from && w.to == other.to && w.add == other.add && w.gain == other.gain; };
            if (const auto twin = std::ranges::find_if (without, isLike); twin != without.end())
                without.erase (twin);
            else
                nodes.push_back (w.to.node);
        }
        for (const auto& w : without)
            nodes.push_back (w.to.node);
        return nodes;
    }

    std::optional<PortRef> find (const graph::Endpoint& e, std::initializer_list<Role> roles) const
    {
        const auto name = graph::isId (e.node) ? background->names.find (e.node) : Names::none;
        const int node = name != Names::none ? background->nodes[name] : -1;
        if (node < 0) return {};
        for (const auto role : roles)
        {
            const auto& rows = flat.node (node).ports (role);
            const auto row = std::ranges::find (rows, e.port, &PortSheet::id);
            if (row == rows.end()) continue;
            const bool has_index = e.index < 0 || (row->list && e.index < flat.node (node).list_size);
            const bool has_component = e.component < 0 || row->width == 3;
            if (! has_index || ! has_component) return {};
            return PortRef { node, role, static_cast<int> (row - rows.begin()), e.index, e.component };
        }
        return {};
    }

    template <typename Visit>
    void forEachInto (int node, Visit visit) const
    {
        for (std::size_t i = 0; i < parts.wire_ends.ends.size(); ++i)
            if (parts.wire_ends.ends[i].second == node) visit (flat.wires[i]);
    }

    /// True if no other wire ends there, or if they may be summed.
    bool isAlone (const FlatWire& w) const
    {
        const auto quantity = background->units.found[at (background->units.number.in (flat, w.to))].quantity;
        if (w.add || (w.to.role == Role::input && (addsUp (quantity) || flat.sheet (w.to).unit.adds_up))) return true;
        bool alone = true;
        forEachInto (w.to.node, [&] (const FlatWire& other) {
            const auto &a = w.to, &b = other.to;
            const bool overlap = a.component < 0 || b.component < 0 || a.component == b.component;
            if (! other.add && a.role == b.role && a.port == b.port && a.index == b.index && overlap) alone = false;
        });
        return alone;
    }

    int position (int node) const { return background->position[at (node)]; }

    /// True if the end of the wire must wait for its start within a tick.
    bool binds (const FlatWire& w) const { return w.from && w.delay == 0 && binds (w.from->node); }
    bool binds (int start) const { return flat.node (start).type->peek == nullptr || flat.node (start).bypass; }

    /// True if the node where a removed wire ended still does not run before any node whose path comes later.
    bool staysInPlace (const FlatWire& removed) const
    {
        if (! binds (removed)) return true;
        const int node = removed.to.node;
        int ready = 0;
        forEachInto (node, [&] (const FlatWire& w) {
            if (binds (w)) ready = std::max (ready, position (w.from->node) + 1);
        });
        const auto &running = background->running, &rank = background->rank;
        return std::all_of (running.begin() + ready, running.begin() + position (node), [&] (int other) { return rank[at (other)] < rank[at (node)]; });
    }

    //==============================================================================
    /// True if all nodes that learn about a device still find the same one along their wires.
    bool keepsDevices() const
    {
        const auto learns = [this] (std::uint32_t n) { return flat.nodes[n].type->learn && ! flat.nodes[n].type->bind; };
        if (std::ranges::none_of (parts.bound, learns)) return true;
        auto found = flat;
        for (std::size_t n = 0; n < found.nodes.size(); ++n)
            if (found.nodes[n].type->learn && ! found.nodes[n].type->bind) found.nodes.change (n).role.clear();
        findDevices (found);
        for (std::size_t n = 0; n < found.nodes.size(); ++n)
            if (found.nodes[n].role != flat.nodes[n].role) return false;
        return true;
    }

    /// Connects a node again and puts its records in the place of its old ones.
    bool rebuild (int node)
    {
        if (! flat.node (node).runs() || flat.node (node).type->make == nullptr) return false;
        if (parts.instances[at (node)].lanes) return false;   // its record ticks other nodes, too
        if (background->settled[at (node)]) return false;     // it, and all that its outputs reach, may have to tick from now on
        Flat few;
        std::vector<int> numbers;   // of the few nodes
        std::vector<Instance> instances;
        const auto numberOf = [&] (int n) {
            const auto known = std::ranges::find (numbers, n) - numbers.begin();
            if (known == std::ssize (numbers))
            {
                numbers.push_back (n);
                instances.push_back (parts.instances[at (n)]);
                few.nodes.add ({ .path = {}, .type = flat.node (n).type, .bypass = flat.node (n).bypass, .list_size = flat.node (n).list_size });
            }
            return static_cast<int> (known);
        };
        numberOf (node);
        const auto& n = flat.node (node);
        for (const auto& row : n.type->params)
            for (int k = 0; k < n.slots (row); ++k)
                few.values.push_back (flat.values[n.values + few.values.size()]);

        bool is_plain = true;
        forEachInto (node, [&] (const FlatWire& w) {
            is_plain = is_plain && w.delay == 0 && ! w.crosses;
            auto& copied = few.wires.add (w);
            copied.to.node = 0;
            if (w.from) copied.from->node = numberOf (w.from->node);
        });
        if (! is_plain) return false;

        auto fed = parts.fed;
        for (auto& ports : fed)
        {
            std::erase_if (ports, [node] (const PortRef& r) { return r.node != node; });
            for (auto& port : ports)
                port.node = 0;
        }
        const auto made = buildNode (few, std::move (fed), instances, parts.feeds);
        release (at (node), made.instance);
        parts.instances.change (at (node)) = made.instance;
        parts.storage.push_back (made.storage);
        return replaceRecords (static_cast<std::uint32_t> (node), made);
    }

    /// A parameter that is no longer driven ramps back to its stored value.
    void release (std::size_t node, const Instance& now)
    {
        const auto& then = parts.instances[node];
        for (std::size_t k = 0; k < then.driven.size(); ++k)
            if (then.isDriven (k) && ! now.isDriven (k)) parts.takeover.releases.push_back ({ node, k });
    }

    bool replaceRecords (std::uint32_t node, const NodePart& made)
    {
        auto& records = parts.records;
        auto& owners = parts.owners;
        auto first = std::ranges::find (owners, node);
        for (const auto& peek : made.peeks)
        {
            if (first == owners.end()) return false;
            if (records[at (first - owners.begin())].step != peek.step) continue;   // nothing reads the outputs
            records[at (first - owners.begin())] = peek;
            first = std::find (first + 1, owners.end(), node);
        }
        const auto end = std::find_if (first, owners.end(), [node] (std::uint32_t owner) { return owner != node; });
        if (first == end) return false;
        const auto place = first - owners.begin();
        records.erase (records.begin() + place, records.begin() + (end - owners.begin()));
        records.insert (records.begin() + place, made.body.begin(), made.body.end());
        owners.erase (first, end);
        owners.insert (owners.begin() + place, made.body.size(), node);
        return true;
    }

    /// Taps at the inputs of rebuilt nodes read the new sources.
    void moveTaps()
    {
        for (std::size_t t = 0; t < parts.taps.size(); ++t)
        {
            const auto& port = background->tapped[t];
            if (port.role != Role::input || std::ranges::count (ends_at, port.node) == 0) continue;
            const auto& n = flat.node (port);
            int slot = std::max (port.index, 0) * flat.sheet (port).width + std::max (port.component, 0);
            for (int p = 0; p < port.port; ++p)
                slot += n.slots (n.type->inputs[at (p)]);
            parts.taps[t].value = parts.instances[at (port.node)].sources[slot];
        }
    }

    /// Finds the roles that the edit can reach, and the delays on the way to them. False if a delay may need a warning.
    bool followForces()
    {
        for (auto& role : parts.roles)
            role.untouched = true;
        auto changed = changedNodes();
        if (changed.empty() || std::ranges::all_of (parts.roles, [] (const RoleUse& r) { return r.sinks.empty(); })) return true;

        const auto reached = downstream (std::move (changed));
        bool any = false;
        for (auto& role : parts.roles)
        {
            role.untouched = std::ranges::none_of (role.sinks, [&] (const SinkUse& s) { return reached[s.instance]; });
            any = any || ! role.untouched;
        }
        if (! any) return true;
        const auto delays = nodeDelays (flat, parts.instances);
        for (std::size_t i = 0; i < delays.size(); ++i)
            if (delays[i] > 0 && flat.nodes[i].type->effort == nullptr) return false;
        if (! parts.lines.empty()) return false;
        parts.delays = pathDelays (flat, background->units, delays);
        return true;
    }

    /// By node: whether the edit can change its inputs.
    std::vector<bool> downstream (std::vector<int> open) const
    {
        const Grouped<int> next (flat.nodes.size(), [this] (auto visit) {
            for (const auto& [from, to] : parts.wire_ends.ends)
                if (from >= 0) visit (from, to);
        });
        std::vector<bool> reached (flat.nodes.size(), false);
        for (const int n : open)
            reached[at (n)] = true;
        while (! open.empty())
        {
            const int n = open.back();
            open.pop_back();
            for (const int m : next[at (n)])
                if (! reached[at (m)])
                {
                    reached[at (m)] = true;
                    open.push_back (m);
                }
        }
        return reached;
    }
};

std::shared_ptr<Plan> rewire (const graph::Graph& g, const Catalogue& catalogue, const CompileOptions& options)
{
    if (options.before == nullptr || options.before->flat().catalogue.begin() != catalogue.begin()) return nullptr;
    return Rewirer { *options.before, g }.run (options);
}

void remember (Background& background, Scope& top, Flat& flat, const CompileOptions& options)
{
    constexpr std::size_t most_origins = 64;   // a plan that follows copies them
    background.feeds = options.feeds;
    background.records = options.records;
    background.lanes = options.lanes;
    background.settles = options.settles;
    background.is_plain = options.overrides.empty() && flat.sections.size() == 1 && flat.made_types.empty() && flat.origins.size() <= most_origins;
    background.files = std::move (flat.files);
    background.names = std::move (top.names);
    background.nodes.reserve (top.members.size());
    for (const auto& member : top.members)
        background.nodes.push_back (member.node);
}

void finish (Plan& plan, Background& background, PortUnits units, graph::Id version, bool is_clean)
{
    background.is_plain = background.is_plain && is_clean;
    background.units = std::move (units);
    background.units.number.flat = nullptr;
    Rewirer::partsOf (plan).version = version;
}

}   // namespace tactus::plan
