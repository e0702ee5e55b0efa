// SPDX-License-Identifier: MIT
#include "plan_diff.hpp"
#include <tactus/plan/settings/same_settings.hpp>

#include <algorithm>
#include <compare>
#include <span>
#include <tuple>
#include <utility>

namespace tactus::plan
{

namespace
{
/// A wire or feed into a node.
struct Entry
{
    Role role {};
    int port = 0, index = 0, component = 0;
    std::uint64_t from = 0;   ///< serial number of the node where the wire starts, or complement of the feed's number; 0 for a placeholder
    int from_port = 0, from_index = 0, from_component = 0;
    std::uint64_t line = 0;        ///< serial number of the delay line; 0 without a delay
    std::uint64_t converter = 0;   ///< serial number of the first rate converter; 0 without one
    bool add = false;
    double gain = 1.0;

    auto operator<=> (const Entry&) const = default;
};

/// The entries of each node of a plan, sorted so that their order in the file does not matter.
class Entries
{
public:
    explicit Entries (const PlanParts& plan) : first (plan.flat.nodes.size() + 1, 0)
    {
        forEach (plan, [this] (int node, const Entry&) { ++first[at (node) + 1]; });
        for (std::size_t i = 1; i < first.size(); ++i)
            first[i] += first[i - 1];
        all.resize (first.back());
        auto next = first;
        forEach (plan, [&] (int node, const Entry& e) { all[next[at (node)]++] = e; });
        for (std::size_t i = 0; i + 1 < first.size(); ++i)
            std::sort (all.data() + first[i], all.data() + first[i + 1],
                       [] (const Entry& a, const Entry& b) { return (a <=> b) == std::partial_ordering::less; });
    }

    std::span<const Entry> operator[] (std::size_t node) const noexcept { return { all.data() + first[node], all.data() + first[node + 1] }; }

private:
    template <typename Visit>
    static void forEach (const PlanParts& plan, Visit visit)
    {
        const auto& wires = plan.flat.wires;
        auto line = plan.lines.begin();
        auto converter = plan.rate_converters.begin();
        const auto rateConverterOf = [&] (std::size_t wire, int component = 0) {
            const auto wanted = std::pair { wire, component };
            const auto here = [&] { return std::pair { at (converter->wire), converter->component }; };
            while (converter != plan.rate_converters.end() && here() < wanted)
                ++converter;
            return converter != plan.rate_converters.end() && here() == wanted ? converter->converter->serial : 0;
        };
        for (std::size_t i = 0; i < wires.size(); ++i)
        {
            const auto& w = wires[i];
            while (line != plan.lines.end() && at (line->wire) < i)
                ++line;
            Entry e { w.to.role, w.to.port, w.to.index, w.to.component, 0, 0, 0, 0, w.delay > 0 ? line->line->serial : 0, rateConverterOf (i), w.add, w.gain };
            if (w.from)
            {
                e.from = plan.instances[at (w.from->node)].serial;
                e.from_port = w.from->port;
                e.from_index = w.from->index;
                e.from_component = w.from->component;
            }
            visit (w.to.node, e);
        }
        for (std::size_t f = 0; f < plan.fed.size(); ++f)
            for (int k = 0; k < static_cast<int> (plan.fed[f].size()); ++k)
            {
                const auto& port = plan.fed[f][at (k)];
                visit (port.node, { port.role, port.port, port.index, port.component, ~f, 0, 0, 0, 0, rateConverterOf (wires.size() + f, k), false, 1.0 });
            }
    }

    std::vector<Entry> all;
    std::vector<std::size_t> first;   // index of the first entry of each node, then the end
};

bool sameShape (const NodeType& a, const NodeType& b)
{
    const auto alike = [] (const std::vector<PortSheet>& x, const std::vector<PortSheet>& y) {
        return std::ranges::equal (x, y, [] (const PortSheet& p, const PortSheet& q) {
            if (p.id != q.id) return false;
            return p.width == q.width && p.list == q.list && p.initial[0] == q.initial[0];
        });
    };
    return alike (a.inputs, b.inputs) && alike (a.params, b.params) && alike (a.outputs, b.outputs);
}

/// True if two nodes of the same type differ in a choice.
bool choosesOtherwise (const Flat& a, std::size_t i, const Flat& b, std::size_t j)
{
    const auto& params = a.nodes[i].type->params;
    for (std::size_t p = 0; p < params.size(); ++p)
        if (! params[p].choices.empty() && a.param (static_cast<int> (i), p)[0] != b.param (static_cast<int> (j), p)[0]) return true;
    return false;
}

/// The param of `old`, another build of the same type, whose value a param continues; null if there is none, or if the new range may
/// refuse the value.
const PortSheet* sameParam (const PortSheet& param, const NodeType& old)
{
    const auto fits = [&] (const PortSheet& p) {
        const auto &range = p.limits.hard, &new_range = param.limits.hard;
        return p.id == param.id && p.width == param.width && p.list == param.list && std::ranges::equal (p.choices, param.choices)
               && p.unit.unit.dimension == param.unit.unit.dimension && range.min >= new_range.min && range.max <= new_range.max;
    };
    const auto found = std::ranges::find_if (old.params, fits);
    return found == old.params.end() ? nullptr : &*found;
}

/// Lets the knobs of a node keep the values to which they were turned when the type of the node is built again, as after an edit of its
/// C++. A knob whose value in the file has changed does not keep its old value. The new type may have other params, so the node cannot
/// share the old knobs.
void keepTurned (Knobs& knobs, const Flat& flat, std::size_t i, const PlanParts& before, std::size_t old, Takeover& takeover)
{
    const auto &now = *flat.nodes[i].type, &then = *before.flat.nodes[old].type;
    const auto* turned = before.instances[old].knobs.get();
    if (turned == nullptr) return;
    const auto hold = [&] (auto& to, const auto& from) { takeover.held.push_back ({ &to, &from, sizeof from }); };
    takeover.rebuilt.push_back ({ i, turned });
    for (std::size_t p = 0; p < now.params.size(); ++p)
    {
        const auto* param = sameParam (now.params[p], then);
        if (param == nullptr) continue;
        const auto q = static_cast<std::size_t> (param - then.params.data());
        const auto values = flat.param (static_cast<int> (i), p), values_before = before.flat.param (static_cast<int> (old), q);
        for (std::size_t c = 0; c < std::min (values.size(), values_before.size()); ++c)
        {
            if (values[c] != values_before[c]) continue;
            auto& knob = knobs.all[Knobs::indexOf (now, p, c)];
            const auto& knob_before = turned->all[Knobs::indexOf (then, q, c)];
            hold (knob.left, knob_before.left);
            hold (knob.to, knob_before.to);
            hold (knob.value, knob_before.value);
        }
    }
}

std::vector<std::uint64_t> serialsOf (const RoleUse& role, const PlanParts& plan)
{
    std::vector<std::uint64_t> all;
    for (const auto& sink : role.sinks)
        all.push_back (plan.instances[sink.instance].serial);
    std::ranges::sort (all);
    return all;
}
}   // namespace

PlanDiff::PlanDiff (const Flat& f, const PlanParts* b, const PlanParts* w, double rate)
    : flat (f), before (b), withdrawn (w), rate_hz (rate), continuing (f.nodes.size(), false)
{
    if (withdrawn) matching_withdrawn = matchGraphs (flat, withdrawn->flat);
    if (before == nullptr)
    {
        matching = { std::vector<int> (flat.nodes.size(), -1), std::vector<int> (flat.wires.size(), -1) };
        return;
    }
    matching = matchGraphs (flat, before->flat);
    for (std::size_t i = 0; i < continuing.size(); ++i)
        continuing[i] = matching.nodes[i] >= 0 && isSame (i);
}

/// A node that did not tick must not resume from an old state, so it is replaced.
bool PlanDiff::isSame (std::size_t i) const
{
    const auto& now = flat.nodes[i];
    const auto& then = before->flat.nodes[at (matching.nodes[i])];
    if (now.type->make == nullptr) return then.type->make == nullptr && now.list_size == then.list_size && sameShape (*now.type, *then.type);
    const bool same_rate = rate_hz * flat.speed (now.section) == before->rate_hz * before->flat.speed (then.section);
    return now.type == then.type && same_rate && now.role == then.role && (then.runs() || ! now.runs()) && same (now.settings, then.settings);
}

const Instance* PlanDiff::predecessorOf (std::size_t i) const noexcept
{
    if (matching.nodes[i] < 0) return nullptr;
    const auto old = at (matching.nodes[i]);
    return continuing[i] || before->flat.nodes[old].type == flat.nodes[i].type ? &before->instances[old] : nullptr;
}

PlanDiff::Predecessor PlanDiff::knobsBefore (std::size_t i) const noexcept
{
    if (predecessorOf (i)) return { before, at (matching.nodes[i]) };
    if (withdrawn == nullptr || matching_withdrawn.nodes[i] < 0) return {};
    const auto node = at (matching_withdrawn.nodes[i]);
    return withdrawn->flat.nodes[node].type == flat.nodes[i].type ? Predecessor { withdrawn, node } : Predecessor {};
}

PlanDiff::Predecessor PlanDiff::rebuiltFrom (std::size_t i) const noexcept
{
    if (matching.nodes[i] < 0) return {};
    const auto old = at (matching.nodes[i]);
    const auto &now = *flat.nodes[i].type, &then = *before->flat.nodes[old].type;
    const bool is_rebuilt = now.make != nullptr && then.make != nullptr && &now != &then && now.info.id == then.info.id;
    return is_rebuilt ? Predecessor { before, old } : Predecessor {};
}

/// The number of turns of a knob before the edit that set this value. The withdrawn plan may contain the same edit already.
std::uint32_t PlanDiff::turnsBefore (const Knobs& knobs, std::size_t knob, double value) const noexcept
{
    if (withdrawn)
        for (const auto& change : withdrawn->takeover.changes)
            if (withdrawn->instances[change.instance].knobs.get() == &knobs && change.knob == knob && change.value == value) return change.turns;
    return knobs.all[knob].turns.load (std::memory_order_acquire);
}

const Instance* PlanDiff::heldFrom (std::size_t node) const
{
    const auto& n = flat.nodes[node];
    const auto* old = flat.rests (n.section) ? predecessorOf (node) : nullptr;
    if (old == nullptr) return nullptr;
    const auto& then = before->flat.nodes[at (matching.nodes[node])];
    return ! then.muted && then.bypass == n.bypass && then.list_size == n.list_size ? old : nullptr;
}

std::shared_ptr<Knobs> PlanDiff::knobsOf (std::size_t i, const std::shared_ptr<KnobBoard>& board, Takeover& takeover) const
{
    const auto& n = flat.nodes[i];
    if (n.type->make == nullptr || ! Knobs::areIn (*n.type)) return nullptr;

    const auto predecessor = knobsBefore (i);
    if (predecessor.plan == nullptr)
    {
        auto knobs = std::make_shared<Knobs> (*n.type, board);
        std::size_t k = 0;
        for (std::size_t p = 0; p < n.type->params.size(); ++p)
        {
            const auto values = flat.param (static_cast<int> (i), p);
            for (std::size_t c = 0; c < Knobs::roomOf (n.type->params[p]); ++c, ++k)
            {
                auto& knob = knobs->all[k];
                knob.value = c < values.size() ? values[c] : n.type->params[p].initial[0];
                knob.target.store (knob.value, std::memory_order_relaxed);
            }
        }
        if (const auto rebuilt = rebuiltFrom (i); rebuilt.plan) keepTurned (*knobs, flat, i, *rebuilt.plan, rebuilt.node, takeover);
        return knobs;
    }

    const auto& knobs = predecessor.plan->instances[predecessor.node].knobs;
    std::size_t first = 0;
    for (std::size_t p = 0; p < n.type->params.size(); first += Knobs::roomOf (n.type->params[p++]))
    {
        const auto values = flat.param (static_cast<int> (i), p), old = predecessor.plan->flat.param (static_cast<int> (predecessor.node), p);
        for (std::size_t c = 0; c < values.size(); ++c)
            if (const bool is_new = c >= old.size(); is_new || values[c] != old[c])
                takeover.changes.push_back ({ i, first + c, values[c], is_new, turnsBefore (*knobs, first + c, values[c]) });
    }
    return knobs;
}

void PlanDiff::noteSuccessor (std::size_t i, Takeover& takeover) const
{
    if (before == nullptr || flat.nodes[i].type->make == nullptr) return;
    const auto* old = predecessorOf (i);
    if (const auto rebuilt = rebuiltFrom (i); rebuilt.plan != nullptr)
    {
        const auto& then = before->flat.nodes[rebuilt.node];
        const bool adopts = then.runs() && flat.nodes[i].runs() && flat.nodes[i].type->sharesState (*then.type);
        takeover.successors.push_back ({ i, adopts ? flat.nodes[i].type->adopt : nullptr, before->instances[rebuilt.node].node.get() });
        return;
    }
    if (old == nullptr)
    {
        if (knobsBefore (i).plan) takeover.successors.push_back ({ i, nullptr, nullptr });
        return;
    }
    const bool ran = before->flat.nodes[at (matching.nodes[i])].runs() && flat.nodes[i].runs();
    takeover.successors.push_back ({ i, ran ? flat.nodes[i].type->adopt : nullptr, old->node.get() });
}

std::shared_ptr<Line> PlanDiff::lineOf (int wire, int component, int ticks, Takeover& takeover) const
{
    const Line* old = nullptr;
    if (const int wire_before = matching.wires[at (wire)]; wire_before >= 0)
    {
        const auto key = [] (const LineUse& use) { return std::pair { use.wire, use.component }; };
        const auto use = std::ranges::lower_bound (before->lines, std::pair { wire_before, component }, {}, key);
        if (use != before->lines.end() && key (*use) == std::pair { wire_before, component })
        {
            if (use->line->samples.size() == at (ticks)) return use->line;
            old = use->line.get();
        }
    }
    auto line = std::make_shared<Line>();
    line->serial = newSerial();
    line->samples.assign (at (ticks), 0.0);
    if (old) takeover.relays.push_back ({ line.get(), old });
    return line;
}

std::shared_ptr<RateConverter> PlanDiff::rateConverterOf (int wire, int component, int step, Conversion conversion, Takeover& takeover) const
{
    const auto wires = static_cast<int> (flat.wires.size());
    int wire_before = -1;
    if (wire < wires)
        wire_before = matching.wires[at (wire)];
    else if (before != nullptr)
        wire_before = static_cast<int> (before->flat.wires.size()) + wire - wires;

    const RateConverter* old = nullptr;
    if (wire_before >= 0)
    {
        using Key = std::tuple<int, int, int>;
        const auto key = [] (const RateConverterUse& use) { return Key { use.wire, use.component, use.step }; };
        const Key wanted { wire_before, component, step };
        const auto use = std::ranges::lower_bound (before->rate_converters, wanted, {}, key);
        if (use != before->rate_converters.end() && key (*use) == wanted)
        {
            if (use->conversion == conversion) return use->converter;
            old = use->converter.get();
        }
    }
    auto converter = std::make_shared<RateConverter>();
    converter->serial = newSerial();
    if (old) takeover.conversions.push_back ({ converter.get(), old });
    return converter;
}

std::vector<bool> PlanDiff::changed (const PlanParts& plan) const
{
    const Entries now (plan), then (*before);
    std::vector<bool> all (continuing.size(), true);
    for (std::size_t i = 0; i < continuing.size(); ++i)
    {
        if (! continuing[i]) continue;
        const auto old = at (matching.nodes[i]);
        const auto &n = plan.flat.nodes[i], &o = before->flat.nodes[old];
        all[i] = n.runs() != o.runs() || n.bypass != o.bypass || choosesOtherwise (plan.flat, i, before->flat, old) || ! std::ranges::equal (now[i], then[old]);
    }
    return all;
}

/// Marks everything downstream of the changed nodes, including along delayed wires.
void PlanDiff::spread (std::vector<bool>& dirty, const PlanParts& plan)
{
    std::vector<int> open;
    for (std::size_t i = 0; i < dirty.size(); ++i)
        if (dirty[i]) open.push_back (static_cast<int> (i));
    if (open.empty()) return;

    std::vector<std::pair<int, int>> pairs;   // of nodes: start and end of each wire
    pairs.reserve (plan.flat.wires.size());
    for (const auto& w : plan.flat.wires)
        if (w.from) pairs.emplace_back (w.from->node, w.to.node);
    std::ranges::sort (pairs);
    while (! open.empty())
    {
        const int from = open.back();
        open.pop_back();
        for (auto p = std::ranges::lower_bound (pairs, std::pair { from, 0 }); p != pairs.end() && p->first == from; ++p)
            if (! dirty[at (p->second)])
            {
                dirty[at (p->second)] = true;
                open.push_back (p->second);
            }
    }
}

void PlanDiff::compare (PlanParts& plan) const
{
    if (before == nullptr) return;

    auto dirty = changed (plan);
    std::vector<bool> fresh;
    for (const int old : matching.nodes)
        fresh.push_back (old < 0);   // not another build or setting of a node, which begins where the old one was
    spread (dirty, plan);
    spread (fresh, plan);

    for (auto& role : plan.roles)
    {
        const auto old = std::ranges::find (before->roles, role.name, &RoleUse::name);
        role.untouched = old != before->roles.end() && serialsOf (role, plan) == serialsOf (*old, *before)
                         && std::ranges::none_of (role.sinks, [&] (const SinkUse& s) { return dirty[s.instance]; });
        role.has_new_nodes = std::ranges::any_of (role.sinks, [&] (const SinkUse& s) { return fresh[s.instance]; });
    }

    for (std::size_t i = 0; i < continuing.size(); ++i)
        if (continuing[i])
        {
            const auto &now = plan.instances[i], &then = before->instances[at (matching.nodes[i])];
            for (std::size_t k = 0; k < then.driven.size(); ++k)
                if (then.isDriven (k) && ! now.isDriven (k)) plan.takeover.releases.push_back ({ i, k });
        }
}

}   // namespace tactus::plan
