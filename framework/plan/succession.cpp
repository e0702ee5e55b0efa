// SPDX-License-Identifier: MIT
#include "succession.hpp"
#include "same_settings.hpp"

#include <algorithm>
#include <compare>
#include <span>
#include <tuple>
#include <utility>

namespace tactus::plan
{

namespace
{
std::size_t at (int i) { return static_cast<std::size_t> (i); }

/// Something that enters a node.
struct Entry
{
    Role role {};
    int port = 0, index = 0, component = 0;
    std::uint64_t from = 0;   ///< serial of the node, or a feed; 0 for nothing
    int from_port = 0, from_index = 0, from_component = 0;
    std::uint64_t line = 0;      ///< serial, if there is a delay
    std::uint64_t passage = 0;   ///< serial of the first, if it enters or leaves sections
    bool add = false;
    double gain = 1.0;

    auto operator<=> (const Entry&) const = default;
};

/// What enters each node of a plan, whatever the order it was written in.
class Entries
{
public:
    explicit Entries (const Plan& plan) : first (plan.flat.nodes.size() + 1, 0)
    {
        forEach (plan, [this] (int node, const Entry&)
                 { ++first[at (node) + 1]; });
        for (std::size_t i = 1; i < first.size(); ++i)
            first[i] += first[i - 1];
        all.resize (first.back());
        auto next = first;
        forEach (plan, [&] (int node, const Entry& e)
                 { all[next[at (node)]++] = e; });
        for (std::size_t i = 0; i + 1 < first.size(); ++i)
            std::sort (all.begin() + static_cast<std::ptrdiff_t> (first[i]), all.begin() + static_cast<std::ptrdiff_t> (first[i + 1]), [] (const Entry& a, const Entry& b)
                       { return (a <=> b) == std::partial_ordering::less; });
    }

    std::span<const Entry> operator[] (std::size_t node) const noexcept { return { all.data() + first[node], all.data() + first[node + 1] }; }

private:
    template <typename Visit>
    static void forEach (const Plan& plan, Visit visit)
    {
        const auto& wires = plan.flat.wires;
        auto line = plan.lines.begin();
        auto passage = plan.passages.begin();
        const auto passageOf = [&] (std::size_t wire, int component = 0)
        {
            const auto wanted = std::pair { wire, component };
            const auto here = [&]
            { return std::pair { at (passage->wire), passage->component }; };
            while (passage != plan.passages.end() && here() < wanted)
                ++passage;
            return passage != plan.passages.end() && here() == wanted ? passage->passage->serial : 0;
        };
        for (std::size_t i = 0; i < wires.size(); ++i)
        {
            const auto& w = wires[i];
            while (line != plan.lines.end() && at (line->wire) < i)
                ++line;
            Entry e { w.to.role, w.to.port, w.to.index, w.to.component, 0, 0, 0, 0, w.delay > 0 ? line->line->serial : 0, passageOf (i), w.add, w.gain };
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
                visit (port.node, { port.role, port.port, port.index, port.component, ~f, 0, 0, 0, 0, passageOf (wires.size() + f, k), false, 1.0 });
            }
    }

    std::vector<Entry> all;
    std::vector<std::size_t> first;   // of each node
};

bool sameShape (const NodeType& a, const NodeType& b)
{
    const auto alike = [] (const std::vector<PortSheet>& x, const std::vector<PortSheet>& y)
    {
        return std::ranges::equal (x, y, [] (const PortSheet& p, const PortSheet& q)
                                   { return p.id == q.id && p.width == q.width && p.list == q.list && p.initial[0] == q.initial[0]; });
    };
    return alike (a.inputs, b.inputs) && alike (a.params, b.params) && alike (a.outputs, b.outputs);
}

/// Of two nodes of a type.
bool choosesOtherwise (const Flat& a, std::size_t i, const Flat& b, std::size_t j)
{
    const auto& params = a.nodes[i].type->params;
    for (std::size_t p = 0; p < params.size(); ++p)
        if (! params[p].choices.empty() && a.param (static_cast<int> (i), p)[0] != b.param (static_cast<int> (j), p)[0]) return true;
    return false;
}

std::vector<std::uint64_t> serialsOf (const Plan::RoleUse& role, const Plan& plan)
{
    std::vector<std::uint64_t> all;
    for (const auto& sink : role.sinks)
        all.push_back (plan.instances[sink.instance].serial);
    std::ranges::sort (all);
    return all;
}
}   // namespace

Succession::Succession (const Flat& f, const Plan* b, const Plan* w, double rate) : flat (f), before (b), withdrawn (w), rate_hz (rate), going (f.nodes.size(), false)
{
    if (withdrawn) heirs_of_withdrawn = findHeirs (flat, withdrawn->flat);
    if (before == nullptr)
    {
        heirs = { std::vector<int> (flat.nodes.size(), -1), std::vector<int> (flat.wires.size(), -1) };
        return;
    }
    heirs = findHeirs (flat, before->flat);
    for (std::size_t i = 0; i < going.size(); ++i)
        going[i] = heirs.nodes[i] >= 0 && isSame (i);
}

/// A node that did not tick may not go on where it stopped some time ago: it starts afresh.
bool Succession::isSame (std::size_t i) const
{
    const auto& now = flat.nodes[i];
    const auto& then = before->flat.nodes[at (heirs.nodes[i])];
    if (now.type->make == nullptr) return then.type->make == nullptr && now.list_size == then.list_size && sameShape (*now.type, *then.type);
    return now.type == then.type && rate_hz * flat.speed (now.section) == before->rate_hz * before->flat.speed (then.section) && now.role == then.role && (then.runs() || ! now.runs()) && same (now.settings, then.settings);
}

const Instance* Succession::heritageOf (std::size_t i) const noexcept
{
    if (heirs.nodes[i] < 0) return nullptr;
    const auto heir = at (heirs.nodes[i]);
    return going[i] || before->flat.nodes[heir].type == flat.nodes[i].type ? &before->instances[heir] : nullptr;
}

Succession::Forebear Succession::knobsBefore (std::size_t i) const noexcept
{
    if (heritageOf (i)) return { before, at (heirs.nodes[i]) };
    if (withdrawn == nullptr || heirs_of_withdrawn.nodes[i] < 0) return {};
    const auto node = at (heirs_of_withdrawn.nodes[i]);
    return withdrawn->flat.nodes[node].type == flat.nodes[i].type ? Forebear { withdrawn, node } : Forebear {};
}

/// Those before the edit that brought the value, which may be the one of the withdrawn plan.
std::uint32_t Succession::turnsBefore (const Knobs& knobs, std::size_t knob, double value) const noexcept
{
    if (withdrawn)
        for (const auto& change : withdrawn->takeover.changes)
            if (withdrawn->instances[change.instance].knobs.get() == &knobs && change.knob == knob && change.value == value) return change.turns;
    return knobs.all[knob].turns.load (std::memory_order_acquire);
}

std::shared_ptr<Knobs> Succession::knobsOf (std::size_t i, Takeover& takeover) const
{
    const auto& n = flat.nodes[i];
    if (n.type->make == nullptr || ! Knobs::areIn (*n.type)) return nullptr;

    const auto forebear = knobsBefore (i);
    if (forebear.plan == nullptr)
    {
        auto knobs = std::make_shared<Knobs> (*n.type);
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
        return knobs;
    }

    const auto& knobs = forebear.plan->instances[forebear.node].knobs;
    std::size_t first = 0;
    for (std::size_t p = 0; p < n.type->params.size(); first += Knobs::roomOf (n.type->params[p++]))
    {
        const auto values = flat.param (static_cast<int> (i), p), old = forebear.plan->flat.param (static_cast<int> (forebear.node), p);
        for (std::size_t c = 0; c < values.size(); ++c)
            if (const bool fresh = c >= old.size(); fresh || values[c] != old[c]) takeover.changes.push_back ({ i, first + c, values[c], fresh, turnsBefore (*knobs, first + c, values[c]) });
    }
    return knobs;
}

void Succession::succeed (std::size_t i, Takeover& takeover) const
{
    if (flat.nodes[i].type->make == nullptr) return;
    const auto* heritage = heritageOf (i);
    if (heritage == nullptr)
    {
        if (knobsBefore (i).plan) takeover.successors.push_back ({ i, nullptr, nullptr });
        return;
    }
    const bool ran = before->flat.nodes[at (heirs.nodes[i])].runs() && flat.nodes[i].runs();
    takeover.successors.push_back ({ i, ran ? flat.nodes[i].type->adopt : nullptr, heritage->node.get() });
}

std::shared_ptr<Line> Succession::lineOf (int wire, int component, int ticks, Takeover& takeover) const
{
    const Line* old = nullptr;
    if (const int heir = heirs.wires[at (wire)]; heir >= 0)
    {
        const auto key = [] (const Plan::LineUse& use)
        { return std::pair { use.wire, use.component }; };
        const auto use = std::ranges::lower_bound (before->lines, std::pair { heir, component }, {}, key);
        if (use != before->lines.end() && key (*use) == std::pair { heir, component })
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

std::shared_ptr<Passage> Succession::passageOf (int wire, int component, int step, Way way, Takeover& takeover) const
{
    const auto wires = static_cast<int> (flat.wires.size());
    int heir = -1;
    if (wire < wires)
        heir = heirs.wires[at (wire)];
    else if (before != nullptr)
        heir = static_cast<int> (before->flat.wires.size()) + wire - wires;

    const Passage* old = nullptr;
    if (heir >= 0)
    {
        using Key = std::tuple<int, int, int>;
        const auto key = [] (const Plan::PassageUse& use)
        { return Key { use.wire, use.component, use.step }; };
        const Key wanted { heir, component, step };
        const auto use = std::ranges::lower_bound (before->passages, wanted, {}, key);
        if (use != before->passages.end() && key (*use) == wanted)
        {
            if (use->way == way) return use->passage;
            old = use->passage.get();
        }
    }
    auto passage = std::make_shared<Passage>();
    passage->serial = newSerial();
    if (old) takeover.passings.push_back ({ passage.get(), old });
    return passage;
}

std::vector<bool> Succession::changed (const Plan& plan) const
{
    const Entries now (plan), then (*before);
    std::vector<bool> all (going.size(), true);
    for (std::size_t i = 0; i < going.size(); ++i)
    {
        if (! going[i]) continue;
        const auto heir = at (heirs.nodes[i]);
        const auto &n = plan.flat.nodes[i], &o = before->flat.nodes[heir];
        all[i] = n.runs() != o.runs() || n.bypass != o.bypass || choosesOtherwise (plan.flat, i, before->flat, heir) || ! std::ranges::equal (now[i], then[heir]);
    }
    return all;
}

/// Along all wires, late ones too.
void Succession::spread (const std::vector<bool>& dirty, Plan& plan)
{
    std::vector<int> open;
    for (std::size_t i = 0; i < dirty.size(); ++i)
        if (! dirty[i])
            plan.instances[i].dirty = false;
        else
            open.push_back (static_cast<int> (i));
    if (open.empty()) return;

    std::vector<std::pair<int, int>> ways;   // from, to
    ways.reserve (plan.flat.wires.size());
    for (const auto& w : plan.flat.wires)
        if (w.from) ways.emplace_back (w.from->node, w.to.node);
    std::ranges::sort (ways);
    while (! open.empty())
    {
        const int from = open.back();
        open.pop_back();
        for (auto way = std::ranges::lower_bound (ways, std::pair { from, 0 }); way != ways.end() && way->first == from; ++way)
            if (! std::exchange (plan.instances[at (way->second)].dirty, true)) open.push_back (way->second);
    }
}

void Succession::compare (Plan& plan) const
{
    if (before == nullptr) return;

    spread (changed (plan), plan);

    for (auto& role : plan.roles)
    {
        const auto old = std::ranges::find (before->roles, role.name, &Plan::RoleUse::name);
        role.untouched = old != before->roles.end() && serialsOf (role, plan) == serialsOf (*old, *before)
                         && std::ranges::none_of (role.sinks, [&] (const Plan::SinkUse& s)
                                                  { return plan.instances[s.instance].dirty; });
    }

    for (std::size_t i = 0; i < going.size(); ++i)
        if (going[i])
        {
            const auto &now = plan.instances[i], &then = before->instances[at (heirs.nodes[i])];
            for (std::size_t k = 0; k < then.driven.size(); ++k)
                if (then.isDriven (k) && ! now.isDriven (k)) plan.takeover.releases.push_back ({ i, k });
        }
}

}   // namespace tactus::plan
