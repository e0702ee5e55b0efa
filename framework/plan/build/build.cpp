// SPDX-License-Identifier: MIT
#include "build.hpp"
#include "build_parts.hpp"
#include "rate_conversions.hpp"
#include "slots.hpp"
#include "storage.hpp"
#include "taps.hpp"
#include <tactus/plan/compile.hpp>
#include <tactus/plan/find_param.hpp>
#include <tactus/plan/flat/bypass.hpp>
#include <tactus/plan/flat/grouped.hpp>
#include <tactus/plan/flat/make_node.hpp>
#include <tactus/plan/rules/lateness.hpp>
#include <tactus/plan/swap/owned_records.hpp>
#include <tactus/plan/swap/plan_diff.hpp>
#include <tactus/plan/swap/settled_nodes.hpp>

#include <algorithm>
#include <cstring>
#include <limits>

namespace tactus::plan
{

namespace
{
/// By node: whether a wire or a record reads any of its outputs. Always true in a section with its own rate: there, outputs may
/// keep their values until the section runs again, and a later plan may read them.
std::vector<bool> readNodes (const Flat& flat, const Outside& outside)
{
    std::vector<bool> all (flat.nodes.size());
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = flat.nodes[i].section != 0;
    for (const auto& w : flat.wires)
        if (w.from) all[at (w.from->node)] = true;
    for (const auto& read : outside.records)
        if (read.port && read.port->role == Role::output) all[at (read.port->node)] = true;
    return all;
}
}   // namespace

class PlanBuilder
{
public:
    PlanBuilder (Flat& f, const PortUnits& u, const Order& o, Outside out, const Setup& s, const CompileOptions& options)
        : flat (f), units (u), order (o), outside (std::move (out)), setup (s), kept (options.kept), settles (options.settles),
          before (partsOf (options.before)), diff (f, before, partsOf (options.withdrawn), s.rate_hz), in_order (inOrder (f, o)), slots (f, in_order),
          steps (f.sections.size())
    {
    }

    std::shared_ptr<Plan> run()
    {
        layOut();
        parts.exposed = std::make_shared<std::map<std::string, std::vector<PortRef>>> (std::move (outside.exposed));
        parts.rate_hz = setup.rate_hz;
        storage->feeds.assign (outside.feeds.size(), 0.0);
        parts.feeds = storage->feeds;
        parts.fed = outside.feeds;
        makeNodes();
        connectDrivers();
        is_read = readNodes (flat, outside);
        is_settled = settles ? settledNodes (flat, outside) : std::vector<bool> (flat.nodes.size());
        auto all = recordsOf (0);
        parts.records = std::move (all.records);
        parts.owners = std::move (all.owners);
        parts.settled = std::move (settled.records);
        parts.rests = flat.restPeriods();
        Taps taps { flat, units, *storage, parts.taps, [this] (const PortRef& r) { return valueOf (r); } };
        for (const auto& read : outside.records)
            taps.add (read);
        const auto delays = nodeDelays (flat, parts.instances);
        parts.delays = pathDelays (flat, units, delays);
        warnOfDelays (flat, units, delays);
        parts.storage = { storage };
        keepFlat (flat, parts);
        diff.compare (parts);
        dropKept (parts, kept);
        return std::move (plan);
    }

private:
    static constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

    Flat& flat;
    const PortUnits& units;
    const Order& order;
    Outside outside;
    const Setup& setup;
    const std::vector<std::string>& kept;
    const bool settles;
    const PlanParts* before;
    PlanDiff diff;
    const std::vector<int> in_order;   // the nodes in running order
    Slots slots;

    std::shared_ptr<Plan> plan = std::make_shared<Plan>();
    PlanParts& parts = plan->parts;
    std::shared_ptr<Storage> storage;
    std::shared_ptr<KnobBoard> board = std::make_shared<KnobBoard>();
    std::optional<Grouped<Driver>> drivers;   // by slot; within a slot, first the wires, then the feeds
    std::vector<SectionSteps> steps;          // by section
    std::vector<bool> is_read, is_settled;    // by node: only those that are read need to peek
    OwnedRecords settled;                     // of settled nodes

    static const PlanParts* partsOf (const Plan* other) { return other ? &other->parts : nullptr; }
    void* outputsOf (int n) { return parts.instances[at (n)].outputs; }
    const double** sourcesOf (int n) { return storage->sources.data() + slots.firstInput (n); }
    SectionSteps& stepsOf (int n) { return steps[at (flat.node (n).section)]; }
    OwnedRecords& bodyOf (int n) { return is_settled[at (n)] ? settled : stepsOf (n).body; }
    void* nodeOf (int n) { return parts.instances[at (n)].node.get(); }

    /// The outputs and inputs of nodes lie side by side in running order.
    void layOut()
    {
        std::size_t size = 0;
        const auto output_at = outputOffsets (flat, in_order, size);
        storage = std::make_shared<Storage> (size);
        makeRoomForInputs();
        parts.instances.resize (flat.nodes.size());
        for (int i = 0; i < flat.nodeCount(); ++i)
        {
            auto& instance = parts.instances[at (i)];
            instance.outputs = storage->outputs.bytes + output_at[at (i)];
            instance.sources = sourcesOf (i);
        }
        layOutSections();
    }

    void makeRoomForInputs()
    {
        storage->defaults.resize (slots.inputCount());
        storage->sources.resize (slots.inputCount());
    }

    void layOutSections()
    {
        storage->sections.resize (flat.sections.size());
        for (int s = 1; s < flat.sectionCount(); ++s)
        {
            const int around = flat.section (s).around;
            auto& running = storage->sections[at (s)];
            running.around = around == 0 ? &parts.number : &storage->sections[at (around)].number;
            running.factor = static_cast<std::uint64_t> (flat.section (s).factor);
        }
    }

    /// The records of a section, in order: delayed wires and peeking nodes deliver their outputs, nodes run, delayed wires read
    /// their inputs.
    OwnedRecords recordsOf (int section)
    {
        auto& [peeks, body, writes] = steps[at (section)];
        body.records.reserve (order[at (section)].size());
        for (const auto& step : order[at (section)])
            if (step.section >= 0)
                addSection (step.section, body);
            else if (const auto& node = flat.node (step.node); ! node.muted)
            {
                connectInputs (step.node);
                node.bypass ? addBypass (step.node) : addNode (step.node);
            }
        if (peeks.records.empty() && writes.records.empty()) return std::move (body);
        peeks.append (body);
        peeks.append (writes);
        return std::move (peeks);
    }

    /// The owner of a section's record is the first node that runs in it.
    void addSection (int section, OwnedRecords& around)
    {
        auto& running = storage->sections[at (section)];
        auto inside = recordsOf (section);
        if (inside.records.empty()) return;
        running.records = std::move (inside.records);
        around.add ({ flat.section (section).kind == Section::Kind::every ? &RunningSection::every : &RunningSection::times, &running, nullptr, nullptr },
                    static_cast<int> (inside.owners.front()));
    }

    void makeNodes()
    {
        if (before)
            for (const auto& role : before->roles)
                parts.roles.push_back ({ role.name, role.state, {} });
        for (const int i : in_order)   // nodes that run one after another are made one after another, so that they lie close together
            makeNode (i);
        for (const int i : in_order)
            parts.instances[at (i)].knobs = diff.knobsOf (at (i), board, parts.takeover);
        for (int i = 0; i < flat.nodeCount(); ++i)
            begin (i);
        std::ranges::sort (parts.roles, {}, &RoleUse::name);
        parts.ramps.prepare (parts.instances, std::make_shared<KnobIndex> (parts.instances), setup.rate_hz);
    }

    void makeNode (int i)
    {
        auto& instance = parts.instances[at (i)];
        if (diff.continues (at (i)))
        {
            const auto& old = *diff.predecessorOf (at (i));
            instance.serial = old.serial;
            instance.node = old.node;
            instance.delay = old.delay;
        }
        else
        {
            instance.serial = newSerial();
            instance.node = plan::makeNode (flat, i);
        }
    }

    void begin (int i)
    {
        const auto& n = flat.node (i);
        const bool is_shared = diff.continues (at (i));
        keepOutputs (i);
        if (! parts.instances[at (i)].node)
        {
            std::memset (outputsOf (i), 0, n.type->outputs_size);
            return;
        }
        n.type->initialiseOutputs (outputsOf (i));
        if ((n.type->bind || n.type->learn) && n.runs()) parts.bound.push_back (static_cast<std::uint32_t> (i));
        if (n.type->bind && n.runs()) use (i, is_shared);
        if (! is_shared) prepare (i);
    }

    void prepare (int i)
    {
        const auto& n = flat.node (i);
        auto& instance = parts.instances[at (i)];
        if (n.type->learn)
            if (const auto role = std::ranges::find (parts.roles, n.role, &RoleUse::name); role != parts.roles.end())
                n.type->learn (instance.node.get(), role->state->layout.mechanics);
        auto own = setup;
        own.rate_hz *= flat.speed (n.section);
        if (n.type->prepare) n.type->prepare (instance.node.get(), own);
        if (n.type->update) n.type->update (instance.node.get());
        if (n.type->delay) instance.delay = n.type->delay (instance.node.get());
        diff.noteSuccessor (at (i), parts.takeover);
    }

    void keepOutputs (int i)
    {
        const auto* old = diff.heldFrom (at (i));
        if (old == nullptr) return;
        parts.takeover.held.push_back ({ outputsOf (i), old->outputs, flat.node (i).type->outputs_size });
    }

    /// Keeps the previous values of the sums and strikes at the inputs of a node until the node runs; meanwhile, only a tap can
    /// see them. The node's sums begin at `first_sum`, its strikes at `first_strike`.
    void keepSums (int i, std::size_t first_sum, std::size_t first_strike)
    {
        const bool any = first_sum < storage->sums.size() || first_strike < storage->strikes.size();
        const auto* old = any ? diff.heldFrom (at (i)) : nullptr;
        if (old == nullptr) return;
        const auto begin = slots.firstInput (i), end = begin + Slots::inputsOf (flat.node (i));
        for (auto slot = begin; slot < end; ++slot)
        {
            const auto keep = [&] (double& out) {
                if (storage->sources[slot] == &out) parts.takeover.held.push_back ({ &out, old->sources[slot - begin], sizeof (double) });
            };
            for (auto s = first_sum; s < storage->sums.size(); ++s)
                keep (storage->sums[s].out);
            for (auto s = first_strike; s < storage->strikes.size(); ++s)
                keep (storage->strikes[s].out);
        }
    }

    void use (int i, bool is_bound)
    {
        const auto& n = flat.node (i);
        auto role = std::ranges::find (parts.roles, n.role, &RoleUse::name);
        if (role == parts.roles.end())
        {
            parts.roles.push_back ({ n.role, std::make_shared<DeviceState>(), {} });
            role = std::prev (parts.roles.end());
        }
        if (! is_bound) bindFirst (*n.type, nodeOf (i), *role->state);
        if (n.type->effort) role->sinks.push_back ({ n.type->effort, nodeOf (i), at (i) });
    }

    double* param (int i, std::size_t p, std::size_t k)
    {
        const auto& type = *flat.node (i).type;
        return reinterpret_cast<double*> (static_cast<std::byte*> (type.paramsOf (nodeOf (i))) + type.params[p].offset) + k;
    }

    const double* output (const PortRef& r, int component)
    {
        const auto& sheet = flat.sheet (r);
        return parts.instances[at (r.node)].output (sheet.offset + sizeof (double) * at (slotWithin (r, component, sheet.width)));
    }

    void connectDrivers()
    {
        RateConversions conversions { flat, diff, parts, storage->sections };
        std::vector<std::pair<std::size_t, Driver>> all;   // each driver with the slot that it drives
        all.reserve (flat.wires.size() + outside.feeds.size());
        for (int i = 0; i < static_cast<int> (flat.wires.size()); ++i)
        {
            const auto& w = flat.wires[at (i)];
            const int width = flat.widthOf (w.to);
            for (int c = 0; c < width; ++c)
            {
                const int from_component = w.from && w.from->component >= 0 ? w.from->component : c;
                const int to_component = w.to.component >= 0 ? w.to.component : c;
                const double* from = w.from ? output (*w.from, from_component) : &Storage::zero;
                ConvertedValue value { i, c, w.crosses ? carriedBy (flat, units, w) : SignalKind::signal };
                if (w.from && w.crosses) from = conversions.leave (from, flat.node (*w.from).section, w.section, value);
                if (w.delay > 0) from = delayed (from, i, c);
                if (w.crosses) from = conversions.enter (from, w.section, flat.node (w.to).section, value);
                all.push_back ({ slots (w.to, to_component), { w.add ? Driver::Kind::add : Driver::Kind::replace, { from, w.gain } } });
            }
        }
        for (std::size_t f = 0; f < outside.feeds.size(); ++f)
            for (int k = 0; k < static_cast<int> (outside.feeds[f].size()); ++k)
            {
                const auto& port = outside.feeds[f][at (k)];
                const int section = flat.node (port).section;
                ConvertedValue value { static_cast<int> (flat.wires.size() + f), k, section != 0 ? carriedBy (flat, units, port) : SignalKind::signal };
                const double* from = conversions.enter (&parts.feeds[f], 0, section, value);
                all.push_back ({ slots (port, port.component), { Driver::Kind::feed, { from, 1.0 } } });
            }
        drivers.emplace (slots.count(), [&] (auto visit) {
            for (const auto& [slot, driver] : all)
                visit (slot, driver);
        });
    }

    const double* delayed (const double* from, int wire, int component)
    {
        const auto& w = flat.wires[at (wire)];
        auto line = diff.lineOf (wire, component, w.delay, parts.takeover);
        auto& d = storage->delays.emplace_back (DelayLine { from, line.get() });
        parts.lines.push_back ({ wire, component, std::move (line) });
        auto& section = steps[at (w.section)];
        section.peeks.add ({ &DelayLine::read, &d, nullptr, nullptr }, w.to.node);
        section.writes.add ({ &DelayLine::write, &d, nullptr, nullptr }, w.to.node);
        return &d.line->out;
    }

    /// The address of the value of all drivers of a kind: that of the driver if there is only one and it has no gain, otherwise from a sum. Null if
    /// there are no drivers.
    const double* joined (std::span<const Driver> all, Driver::Kind kind, int node)
    {
        const auto is_meant = [kind] (const Driver& d) { return d.kind == kind; };
        const auto first = std::ranges::find_if (all, is_meant);
        if (first == all.end()) return nullptr;
        if (first->term.gain == 1.0 && std::none_of (first + 1, all.end(), is_meant)) return first->term.from;
        auto& s = storage->sums.emplace_back();
        for (const auto& d : all)
            if (is_meant (d)) s.terms.push_back (d.term);
        for (std::size_t i = 0; i < s.terms.size(); ++i)
            s.sorted.push_back ({ 0.0, static_cast<std::uint32_t> (i) });
        bodyOf (node).addSum (s, node, storage->vector_sums);
        return &s.out;
    }

    static const double* feedAmong (std::span<const Driver> all)
    {
        return ! all.empty() && all.back().kind == Driver::Kind::feed ? all.back().term.from : nullptr;
    }

    /// Here a wire becomes a pointer: each input of a node gets the address of what drives it.
    void connectInputs (int i)
    {
        const auto& n = flat.node (i);
        auto slot = slots.firstInput (i);
        const auto first_sum = storage->sums.size(), first_strike = storage->strikes.size();
        for (const auto& row : n.type->inputs)
            for (int k = 0; k < n.slots (row); ++k, ++slot)
            {
                storage->defaults[slot] = row.initial[row.list ? 0 : k];
                storage->sources[slot] = &storage->defaults[slot];
                if (const auto all = (*drivers)[slot]; ! all.empty())
                {
                    const auto* feed = feedAmong (all);
                    storage->sources[slot] = feed ? feed : joined (all, Driver::Kind::replace, i);
                }
                if (takesHits (row) && parts.instances[at (i)].knobs)
                    storage->sources[slot] = struck (i, storage->sources[slot], storage->strikes.size() - first_strike);
            }
        keepSums (i, first_sum, first_strike);
    }

    /// The value at the n-th hit input of a node, including hits from outside.
    const double* struck (int i, const double* from, std::size_t n)
    {
        auto& instance = parts.instances[at (i)];
        instance.is_struck = true;
        auto& s = storage->strikes.emplace_back (Strike { from, &instance.knobs->pulses[n] });
        stepsOf (i).body.add ({ &Strike::step, &s, nullptr, nullptr }, i);
        return &s.out;
    }

    void addNode (int i)
    {
        const auto& n = flat.node (i);
        const double* const* sources = sourcesOf (i);
        if (n.type->peek && is_read[at (i)]) stepsOf (i).peeks.add ({ n.type->peek, nodeOf (i), sources, outputsOf (i) }, i);

        auto drives = drivesOf (i);
        if (drives.empty())
        {
            bodyOf (i).add ({ n.type->tick, nodeOf (i), sources, outputsOf (i) }, i);
            return;
        }
        auto& d = storage->driven.emplace_back();
        d.type = n.type;
        d.node = nodeOf (i);
        d.drives = std::move (drives);
        d.faulted.assign (Slots::inputsOf (n), &not_a_number);
        if (n.type->tickStored) d.params.resize (n.type->params_size);
        stepsOf (i).body.add ({ &DrivenNode::step, &d, sources, outputsOf (i) }, i);
    }

    std::vector<DrivenNode::Drive> drivesOf (int i)
    {
        const auto& n = flat.node (i);
        std::vector<DrivenNode::Drive> drives;
        auto slot = slots.firstParam (i);
        for (std::size_t p = 0; p < n.type->params.size(); ++p)
            for (std::size_t k = 0; k < at (n.slots (n.type->params[p])); ++k, ++slot)
            {
                const auto all = (*drivers)[slot];
                if (all.empty()) continue;
                const auto* feed = feedAmong (all);
                const auto knob = Knobs::indexOf (*n.type, p, k);
                auto& instance = parts.instances[at (i)];
                instance.driven.resize (instance.knobs->all.size());
                instance.driven[knob] = true;
                drives.push_back ({ param (i, p, k), &instance.knobs->all[knob].value, feed ? feed : joined (all, Driver::Kind::replace, i),
                                    feed ? nullptr : joined (all, Driver::Kind::add, i), n.type->params[p].limits.hard });
            }
        return drives;
    }

    void addBypass (int i)
    {
        const auto is_driven = [&] (std::size_t input) { return ! (*drivers)[slots.firstInput (i) + input].empty(); };
        auto& bypass = storage->bypasses.emplace_back (bypassOf (flat.node (i), static_cast<std::byte*> (outputsOf (i)), is_driven));
        stepsOf (i).body.add ({ &Bypass::step, &bypass, sourcesOf (i), nullptr }, i);
    }

    /// The address at which a tap reads one component of a port.
    const double* valueOf (const PortRef& r)
    {
        const auto& n = flat.node (r);
        if (r.role == Role::output) return output (r, r.component);
        if (r.role == Role::param) return n.type->make ? param (r.node, at (r.port), at (slotWithin (r, r.component, flat.sheet (r).width))) : &Storage::zero;
        return n.muted ? &Storage::zero : storage->sources[slots (r, r.component)];
    }
};

std::shared_ptr<Plan> build (Flat& flat, const PortUnits& units, const Order& order, Outside outside, const Setup& setup,
                             const CompileOptions& options)
{
    return PlanBuilder { flat, units, order, std::move (outside), setup, options }.run();
}

}   // namespace tactus::plan
