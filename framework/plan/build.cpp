// SPDX-License-Identifier: MIT
#include "build.hpp"
#include "crossings.hpp"
#include "grouped.hpp"
#include "lateness.hpp"
#include "ops.hpp"
#include "slots.hpp"
#include "succession.hpp"

#include <algorithm>
#include <cstring>
#include <deque>
#include <limits>
#include <new>
#include <set>

namespace tactus::plan
{

namespace
{
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double zero = 0.0;

std::size_t at (int i) { return static_cast<std::size_t> (i); }

/// Everything a plan's records point into. Nothing in it moves once the plan runs.
struct Storage
{
    struct Arena
    {
        static constexpr std::align_val_t alignment { 64 };

        explicit Arena (std::size_t size) : bytes (static_cast<std::byte*> (::operator new (std::max (size, std::size_t { 1 }), alignment))) {}
        ~Arena() { ::operator delete (bytes, alignment); }
        Arena (const Arena&) = delete;
        Arena& operator= (const Arena&) = delete;

        std::byte* bytes;
    };

    explicit Storage (std::size_t outputs_size) : outputs (outputs_size) {}

    Arena outputs;
    std::vector<double> defaults;   // of unconnected input components, one per source
    std::vector<const double*> sources;
    std::deque<Sum> sums;
    std::deque<Strike> strikes;
    std::deque<DelayLine> delays;
    std::deque<DrivenNode> driven;
    std::deque<Bypass> bypasses;
    std::vector<RunningSection> sections;   // as in the flat graph; the first, which is the plan, is empty
    std::deque<std::vector<double>> samples;
};

/// Records in running order, each with the node it works for.
struct Owned
{
    std::vector<Record> records;
    std::vector<std::uint32_t> owners;

    void add (const Record& r, int node)
    {
        records.push_back (r);
        owners.push_back (static_cast<std::uint32_t> (node));
    }

    void append (const Owned& more)
    {
        records.insert (records.end(), more.records.begin(), more.records.end());
        owners.insert (owners.end(), more.owners.begin(), more.owners.end());
    }
};

/// Something that drives one component of an input or parameter.
struct Driver
{
    enum class Kind
    {
        replace,
        add,
        feed   ///< has the last word
    };

    Kind kind;
    Sum::Term term;
};

class Builder
{
public:
    Builder (Flat& f, const PortUnits& u, const Order& o, const Outside& out, const Setup& s, const Plan* b, const Plan* withdrawn)
        : flat (f), units (u), order (o), outside (out), setup (s), before (b), succession (f, b, withdrawn, s.rate_hz), slots (f), steps (f.sections.size())
    {
    }

    std::shared_ptr<Plan> run()
    {
        layOut();
        plan->rate_hz = setup.rate_hz;
        plan->feeds.assign (outside.feeds.size(), 0.0);
        plan->fed = outside.feeds;
        makeNodes();
        connectDrivers();
        auto all = recordsOf (0);
        plan->records = std::move (all.records);
        plan->owners = std::move (all.owners);
        std::set<int> rests;
        for (int s = 1; s < static_cast<int> (flat.sections.size()); ++s)
            if (flat.rests (s)) rests.insert (flat.ticksOf (s));
        plan->rests.assign (rests.begin(), rests.end());
        addTaps();
        const auto delays = nodeDelays();
        plan->delays = pathDelays (flat, units, delays);
        warnOfDelays (flat, units, delays);
        plan->storage = storage;
        keepFlat();
        succession.compare (*plan);
        return std::move (plan);
    }

private:
    struct Steps
    {
        Owned peeks, body, writes;
    };

    Flat& flat;
    const PortUnits& units;
    const Order& order;
    const Outside& outside;
    const Setup& setup;
    const Plan* before;
    Succession succession;
    Slots slots;

    std::shared_ptr<Plan> plan = std::make_shared<Plan>();
    std::shared_ptr<Storage> storage;
    std::vector<std::size_t> output_at;       // of each node: into the arena
    std::optional<Grouped<Driver>> drivers;   // by slot; of each slot in the order of the wires, then of the feeds
    std::vector<Steps> steps;                 // by section
    std::set<std::string> tap_names;

    std::byte* outputsOf (int n) { return storage->outputs.bytes + output_at[at (n)]; }
    const double** sourcesOf (int n) { return storage->sources.data() + slots.firstInput (n); }
    Steps& stepsOf (int n) { return steps[at (flat.nodes[at (n)].section)]; }
    void* nodeOf (int n) { return plan->instances[at (n)].node.get(); }

    void layOut()
    {
        std::size_t size = 0;
        output_at.reserve (flat.nodes.size());
        for (const auto& n : flat.nodes)
        {
            const auto align = n.type->outputs_align;
            size = (size + align - 1) / align * align;
            output_at.push_back (size);
            size += n.type->outputs_size;
        }
        storage = std::make_shared<Storage> (size);
        storage->defaults.resize (slots.inputCount());
        storage->sources.resize (slots.inputCount());
        storage->sections.resize (flat.sections.size());
        for (int s = 1; s < static_cast<int> (flat.sections.size()); ++s)
        {
            const int around = flat.section (s).around;
            auto& running = storage->sections[at (s)];
            running.around = around == 0 ? &plan->number : &storage->sections[at (around)].number;
            running.factor = static_cast<std::uint64_t> (flat.section (s).factor);
        }
    }

    /// What a section runs, in order: delayed wires and peeking nodes give what they have, nodes run, delayed wires take
    /// what they get.
    Owned recordsOf (int section)
    {
        auto& [peeks, body, writes] = steps[at (section)];
        body.records.reserve (order[at (section)].size());
        for (const auto& step : order[at (section)])
            if (step.section >= 0)
                addSection (step.section, body);
            else if (const auto& node = flat.nodes[at (step.node)]; ! node.muted)
            {
                connectInputs (step.node);
                node.bypass ? addBypass (step.node) : addNode (step.node);
            }
        if (peeks.records.empty() && writes.records.empty()) return std::move (body);
        peeks.append (body);
        peeks.append (writes);
        return std::move (peeks);
    }

    /// The record of a section belongs to the first node that runs in it.
    void addSection (int section, Owned& around)
    {
        auto& running = storage->sections[at (section)];
        auto inside = recordsOf (section);
        if (inside.records.empty()) return;
        running.records = std::move (inside.records);
        around.add ({ flat.section (section).kind == Section::Kind::every ? &RunningSection::every : &RunningSection::times, &running, nullptr, nullptr }, static_cast<int> (inside.owners.front()));
    }

    void makeNodes()
    {
        if (before)
            for (const auto& role : before->roles)
                plan->roles.push_back ({ role.name, role.state, {} });
        plan->instances.resize (flat.nodes.size());
        for (int i = 0; i < static_cast<int> (flat.nodes.size()); ++i)
            makeNode (i);
        std::ranges::sort (plan->roles, {}, &Plan::RoleUse::name);
        plan->ramps.prepare (plan->instances, setup.rate_hz);
    }

    void makeNode (int i)
    {
        const auto& n = flat.nodes[at (i)];
        auto& instance = plan->instances[at (i)];
        instance.outputs = outputsOf (i);
        instance.sources = sourcesOf (i);
        const bool goes_on = succession.goesOn (at (i));
        if (goes_on)
        {
            const auto& old = *succession.heritageOf (at (i));
            instance.serial = old.serial;
            instance.node = old.node;
            instance.delay = old.delay;
        }
        else
        {
            instance.serial = newSerial();
            instance.node = plan::makeNode (flat, i);
        }
        instance.knobs = succession.knobsOf (at (i), plan->takeover);
        keepOutputs (i);

        if (! instance.node)
        {
            std::memset (outputsOf (i), 0, n.type->outputs_size);
            return;
        }
        n.type->initialiseOutputs (outputsOf (i));
        if (n.type->bind && n.runs()) use (i, goes_on);
        if (! goes_on) prepare (i);
    }

    void prepare (int i)
    {
        const auto& n = flat.nodes[at (i)];
        auto& instance = plan->instances[at (i)];
        auto own = setup;
        own.rate_hz *= flat.speed (n.section);
        if (n.type->prepare) n.type->prepare (instance.node.get(), own);
        if (n.type->update) n.type->update (instance.node.get());
        if (n.type->delay) instance.delay = n.type->delay (instance.node.get());
        succession.succeed (at (i), plan->takeover);
    }

    /// The node before whose values stand until this one runs, if its section rests; null if there is none.
    const Instance* standsFor (int i) const
    {
        const auto& n = flat.nodes[at (i)];
        const auto* old = flat.rests (n.section) ? succession.heritageOf (at (i)) : nullptr;
        if (old == nullptr) return nullptr;
        const auto& then = before->flat.nodes[static_cast<std::size_t> (old - before->instances.data())];
        return ! then.muted && then.bypass == n.bypass && then.list_size == n.list_size ? old : nullptr;
    }

    void keepOutputs (int i)
    {
        if (const auto* old = standsFor (i)) plan->takeover.standing.push_back ({ outputsOf (i), old->outputs, flat.nodes[at (i)].type->outputs_size });
    }

    /// Of sums at the inputs of a node, from these on; nobody but a tap sees them before it runs.
    void keepSums (int i, std::size_t first_sum, std::size_t first_strike)
    {
        const bool any = first_sum < storage->sums.size() || first_strike < storage->strikes.size();
        const auto* old = any ? standsFor (i) : nullptr;
        if (old == nullptr) return;
        const auto begin = slots.firstInput (i), end = slots.firstInput (i + 1);
        for (auto slot = begin; slot < end; ++slot)
        {
            const auto keep = [&] (double& out)
            {
                if (storage->sources[slot] == &out) plan->takeover.standing.push_back ({ &out, old->sources[slot - begin], sizeof (double) });
            };
            for (auto s = first_sum; s < storage->sums.size(); ++s)
                keep (storage->sums[s].out);
            for (auto s = first_strike; s < storage->strikes.size(); ++s)
                keep (storage->strikes[s].out);
        }
    }

    void use (int i, bool is_bound)
    {
        const auto& n = flat.nodes[at (i)];
        auto role = std::ranges::find (plan->roles, n.role, &Plan::RoleUse::name);
        if (role == plan->roles.end())
        {
            plan->roles.push_back ({ n.role, std::make_shared<DeviceState>(), {} });
            role = std::prev (plan->roles.end());
        }
        if (! is_bound) n.type->bind (nodeOf (i), *role->state);
        if (n.type->effort) role->sinks.push_back ({ n.type->effort, nodeOf (i), at (i) });
    }

    double* param (int i, std::size_t p, std::size_t k)
    {
        const auto& type = *flat.nodes[at (i)].type;
        return reinterpret_cast<double*> (static_cast<std::byte*> (type.paramsOf (nodeOf (i))) + type.params[p].offset) + k;
    }

    const double* output (const PortRef& r, int component)
    {
        return reinterpret_cast<const double*> (outputsOf (r.node) + flat.sheet (r).offset) + slotWithin (r, component, flat.sheet (r).width);
    }

    void connectDrivers()
    {
        Crossings crossings { flat, succession, *plan, storage->sections };
        std::vector<std::pair<std::size_t, Driver>> all;   // with their slots
        all.reserve (flat.wires.size() + outside.feeds.size());
        for (int i = 0; i < static_cast<int> (flat.wires.size()); ++i)
        {
            const auto& w = flat.wires[at (i)];
            const int width = flat.widthOf (w.to);
            for (int c = 0; c < width; ++c)
            {
                const int from_component = w.from && w.from->component >= 0 ? w.from->component : c;
                const int to_component = w.to.component >= 0 ? w.to.component : c;
                const double* from = w.from ? output (*w.from, from_component) : &zero;
                Traveller traveller { i, c, w.crosses ? carriedBy (flat, units, w) : Carries::signal };
                if (w.from && w.crosses) from = crossings.leave (from, flat.node (*w.from).section, w.section, traveller);
                if (w.delay > 0) from = delayed (from, i, c);
                if (w.crosses) from = crossings.enter (from, w.section, flat.node (w.to).section, traveller);
                all.push_back ({ slots (w.to, to_component), { w.add ? Driver::Kind::add : Driver::Kind::replace, { from, w.gain } } });
            }
        }
        for (std::size_t f = 0; f < outside.feeds.size(); ++f)
            for (int k = 0; k < static_cast<int> (outside.feeds[f].size()); ++k)
            {
                const auto& port = outside.feeds[f][at (k)];
                Traveller traveller { static_cast<int> (flat.wires.size() + f), k, carriedBy (flat, units, port) };
                all.push_back ({ slots (port, port.component), { Driver::Kind::feed, { crossings.enter (&plan->feeds[f], 0, flat.node (port).section, traveller), 1.0 } } });
            }
        drivers.emplace (slots.count(), [&] (auto visit)
                         {
                             for (const auto& [slot, driver] : all)
                                 visit (slot, driver); });
    }

    const double* delayed (const double* from, int wire, int component)
    {
        const auto& w = flat.wires[at (wire)];
        auto line = succession.lineOf (wire, component, w.delay, plan->takeover);
        auto& d = storage->delays.emplace_back (DelayLine { from, line.get() });
        plan->lines.push_back ({ wire, component, std::move (line) });
        auto& section = steps[at (w.section)];
        section.peeks.add ({ &DelayLine::read, &d, nullptr, nullptr }, w.to.node);
        section.writes.add ({ &DelayLine::write, &d, nullptr, nullptr }, w.to.node);
        return &d.line->out;
    }

    /// One value for the drivers of a kind, to a node: the wire itself where there is one without gain, else a sum; null for none.
    const double* joined (std::span<const Driver> all, Driver::Kind kind, int node)
    {
        const auto is_meant = [kind] (const Driver& d)
        { return d.kind == kind; };
        const auto first = std::ranges::find_if (all, is_meant);
        if (first == all.end()) return nullptr;
        if (first->term.gain == 1.0 && std::none_of (first + 1, all.end(), is_meant)) return first->term.from;
        auto& s = storage->sums.emplace_back();
        for (const auto& d : all)
            if (is_meant (d)) s.terms.push_back (d.term);
        s.scratch.resize (s.terms.size());
        stepsOf (node).body.add ({ &Sum::step, &s, nullptr, nullptr }, node);
        return &s.out;
    }

    static const double* feedAmong (std::span<const Driver> all) { return ! all.empty() && all.back().kind == Driver::Kind::feed ? all.back().term.from : nullptr; }

    void connectInputs (int i)
    {
        const auto& n = flat.nodes[at (i)];
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
                if (takesHits (row) && plan->instances[at (i)].knobs) storage->sources[slot] = struck (i, storage->sources[slot], storage->strikes.size() - first_strike);
            }
        keepSums (i, first_sum, first_strike);
    }

    /// What stands at the n-th input for hits of a node.
    const double* struck (int i, const double* from, std::size_t n)
    {
        auto& instance = plan->instances[at (i)];
        instance.is_struck = true;
        auto& s = storage->strikes.emplace_back (Strike { from, &instance.knobs->pulses[n] });
        stepsOf (i).body.add ({ &Strike::step, &s, nullptr, nullptr }, i);
        return &s.out;
    }

    void addNode (int i)
    {
        const auto& n = flat.nodes[at (i)];
        const double* const* sources = sourcesOf (i);
        if (n.type->peek) stepsOf (i).peeks.add ({ n.type->peek, nodeOf (i), sources, outputsOf (i) }, i);

        auto drives = drivesOf (i);
        if (drives.empty())
        {
            stepsOf (i).body.add ({ n.type->tick, nodeOf (i), sources, outputsOf (i) }, i);
            return;
        }
        auto& d = storage->driven.emplace_back();
        d.type = n.type;
        d.node = nodeOf (i);
        d.drives = std::move (drives);
        d.faulted.assign (slots.firstInput (i + 1) - slots.firstInput (i), &not_a_number);
        stepsOf (i).body.add ({ &DrivenNode::step, &d, sources, outputsOf (i) }, i);
    }

    std::vector<DrivenNode::Drive> drivesOf (int i)
    {
        const auto& n = flat.nodes[at (i)];
        auto& instance = plan->instances[at (i)];
        std::vector<DrivenNode::Drive> drives;
        auto slot = slots.firstParam (i);
        for (std::size_t p = 0; p < n.type->params.size(); ++p)
            for (std::size_t k = 0; k < at (n.slots (n.type->params[p])); ++k, ++slot)
            {
                const auto all = (*drivers)[slot];
                if (all.empty()) continue;
                const auto* feed = feedAmong (all);
                const auto knob = Knobs::indexOf (*n.type, p, k);
                instance.driven.resize (instance.knobs->all.size());
                instance.driven[knob] = true;
                drives.push_back ({ param (i, p, k), &instance.knobs->all[knob].value, feed ? feed : joined (all, Driver::Kind::replace, i), feed ? nullptr : joined (all, Driver::Kind::add, i), n.type->params[p].limits.hard });
            }
        return drives;
    }

    void addBypass (int i)
    {
        const auto& n = flat.nodes[at (i)];
        auto& bypass = storage->bypasses.emplace_back();
        std::memset (outputsOf (i), 0, n.type->outputs_size);
        for (const auto& out : n.type->outputs)
        {
            auto* to = reinterpret_cast<double*> (outputsOf (i) + out.offset);
            std::size_t first = 0;
            for (const auto& in : n.type->inputs)
            {
                if (in.width == out.width && ! out.list && (in.id == out.id || (in.id == "in" && out.id == "out")))
                    for (int c = 0; c < out.width; ++c)
                        bypass.copies.push_back ({ to + c, passedOn (i, static_cast<int> (&in - n.type->inputs.data()), c, first) });
                first += at (n.slots (in));
            }
            const bool is_factor = out.width == 1 && out.unit.kind == UnitRule::Kind::fixed && out.unit.unit.quantity == Quantity::gain;   // a vector in 1 is a direction
            if (is_factor) *to = 1.0;
        }
        stepsOf (i).body.add ({ &Bypass::step, &bypass, sourcesOf (i), nullptr }, i);
    }

    /// The sources that make up one component of what a bypassed input passes on.
    std::vector<std::size_t> passedOn (int i, int port, int component, std::size_t first)
    {
        const auto& n = flat.nodes[at (i)];
        const auto& in = n.type->inputs[at (port)];
        std::vector<std::size_t> passed;
        for (int k = component; k < n.slots (in); k += in.width)
            if (! in.list || ! (*drivers)[slots.firstInput (i) + first + at (k)].empty()) passed.push_back (first + at (k));
        return passed;
    }

    void addTaps()
    {
        for (const auto& [name, port] : outside.records)
        {
            if (! port)
            {
                addTap (name, Quantity::any, "", &zero, 0);
                continue;
            }
            const auto& row = flat.sheet (*port);
            const bool every_entry = row.list && port->index < 0;
            for (int i = every_entry ? 0 : port->index; i <= (every_entry ? flat.node (*port).list_size - 1 : port->index); ++i)
            {
                const auto entry = every_entry ? name + "[" + std::to_string (i) + "]" : name;
                const bool every_component = row.width == 3 && port->component < 0;
                for (int c = every_component ? 0 : port->component; c <= (every_component ? 2 : port->component); ++c)
                {
                    const PortRef one { port->node, port->role, port->port, i, c };
                    addTap (every_component ? entry + "." + "xyz"[c] : entry, units (one).quantity, units.symbol (one), valueOf (one), flat.node (one).section);
                }
            }
        }
    }

    /// Nobody wants a column twice.
    void addTap (const std::string& name, Quantity quantity, std::string symbol, const double* value, int section)
    {
        if (! tap_names.insert (name).second) return;
        plan->taps.push_back ({ name, quantity, std::move (symbol), value });
        const double speed = flat.rests (section) ? 1.0 : flat.speed (section);
        if (speed == 1.0) return;
        auto& samples = storage->samples.emplace_back (static_cast<std::size_t> (speed));
        storage->sections[at (section)].samples.push_back ({ value, samples.data(), samples.size() });
        plan->taps.back().per_tick = static_cast<int> (samples.size());
        plan->taps.back().samples = samples.data();
    }

    const double* valueOf (const PortRef& r)
    {
        const auto& n = flat.node (r);
        if (r.role == Role::output) return output (r, r.component);
        if (r.role == Role::param) return n.type->make ? param (r.node, at (r.port), at (slotWithin (r, r.component, flat.sheet (r).width))) : &zero;
        return n.muted ? &zero : storage->sources[slots (r, r.component)];
    }

    /// For the plan after this one; without what only messages were in need of.
    void keepFlat()
    {
        plan->flat = std::move (flat);
        plan->flat.assignments = {};
        plan->flat.places = {};
        for (auto& n : plan->flat.nodes)
            n.origin = {};
        for (auto& w : plan->flat.wires)
        {
            w.origin = {};
            w.written = {};
        }
        for (auto& s : plan->flat.sections)
            s.origin = {};
    }

    std::vector<int> nodeDelays()
    {
        std::vector<int> delays;
        for (int i = 0; i < static_cast<int> (flat.nodes.size()); ++i)
        {
            const auto& n = flat.nodes[at (i)];
            const bool source = n.type->bind && ! n.type->effort;
            const bool waits = n.type->peek && ! n.bypass && ! source;
            delays.push_back (waits ? plan->instances[at (i)].delay : 0);
        }
        return delays;
    }
};
}   // namespace

std::shared_ptr<void> makeNode (const Flat& flat, int number)
{
    const auto& n = flat.nodes[at (number)];
    if (! n.type->make) return nullptr;
    auto node = n.type->make();
    for (std::size_t p = 0; p < n.type->params.size(); ++p)
    {
        const auto values = flat.param (number, p);
        auto* target = static_cast<std::byte*> (n.type->paramsOf (node.get())) + n.type->params[p].offset;
        if (n.type->params[p].choices.empty())
            std::ranges::copy (values, reinterpret_cast<double*> (target));
        else
        {
            const int chosen = static_cast<int> (values[0]);
            std::memcpy (target, &chosen, sizeof chosen);
        }
    }
    for (std::size_t i = 0; i < n.settings.size(); ++i)
        n.type->settings[i].set (node.get(), n.settings[i]);
    return node;
}

std::shared_ptr<Plan> build (Flat& flat, const PortUnits& units, const Order& order, const Outside& outside, const Setup& setup, const Plan* before, const Plan* withdrawn)
{
    return Builder { flat, units, order, outside, setup, before, withdrawn }.run();
}

}   // namespace tactus::plan
