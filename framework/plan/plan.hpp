// SPDX-License-Identifier: MIT
#pragma once

#include "sum.hpp"
#include <tactus/plan/flat/flat.hpp>
#include <tactus/plan/rules/order.hpp>
#include <tactus/plan/steps/fused_tick.hpp>
#include <tactus/plan/steps/ramps.hpp>
#include <tactus/plan/swap/takeover.hpp>

#include <tactus/node/catalogue.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tactus
{

/// One step of a tick: a function and the pointers it works on, all resolved (docs/decisions/flat_plan.md).
struct Record
{
    void (*step) (void* self, const double* const* sources, void* outputs) noexcept;
    void* self;
    const double* const* sources;
    void* outputs;
};

/// One recorded component: its name, what it carries, and where to find it after each tick.
struct Tap
{
    std::string name;   ///< "motor.force.x"
    Quantity quantity = Quantity::any;
    std::string unit;   ///< SI symbol, "" if unknown
    const double* value = nullptr;
    int per_tick = 1;                  ///< number of samples per tick; more than one inside a `times` section
    const double* samples = nullptr;   ///< all samples of the tick, if there are several; the last one is the value

    /// The sample at the end of the i-th of n equal parts of the tick.
    double sample (int i, int n) const noexcept { return samples ? samples[((i + 1) * per_tick + n - 1) / n - 1] : *value; }
};

namespace plan
{

/// A sink node of a role.
struct SinkUse
{
    std::function<Effort (const void* node)> effort;
    const void* node;
    std::size_t instance;   ///< number of the node's Instance
};

/// A role as a plan uses it. The role remains after its last node is removed, so that the output of its device can still go to zero.
struct RoleUse
{
    std::string name;
    std::shared_ptr<DeviceState> state;   ///< the engine writes it before each tick; nodes of all plans point to it
    std::vector<SinkUse> sinks;
    bool untouched = false;       ///< same sinks as in the previous plan, and nothing upstream of them has changed
    bool has_new_nodes = false;   ///< a sink, or a node upstream of one, was not in the previous plan
};

/// One component of a delayed wire.
struct LineUse
{
    int wire, component;
    std::shared_ptr<Line> line;
};

/// One component of a wire at the point where it enters or leaves a section. Feeds are numbered after the wires.
struct RateConverterUse
{
    int wire, component;
    int step;   ///< how many sections the wire has entered or left before this one
    Conversion conversion;
    std::shared_ptr<RateConverter> converter;
};

/// Everything a plan consists of. Public while PlanBuilder assembles it, then private to the Plan.
struct PlanParts
{
    double rate_hz = 0.0;
    std::uint64_t number = 0;   ///< number of the next tick, counted across all plans
    std::vector<Record> records;
    std::vector<Record> settled;                  ///< steps that need not run on every tick; see settled_nodes.hpp
    std::vector<std::uint32_t> owners;            ///< by record: the node it belongs to, as in flat.nodes; for a wire, the node where it ends
    std::vector<std::uint64_t> rests;             ///< periods, in ticks, of the sections that do not run on every tick; in rising order
    std::vector<RoleUse> roles;                   ///< sorted by name
    std::vector<Tap> taps;                        ///< as in CompileOptions::records, in order
    std::span<double> feeds;                      ///< current values, in the order of CompileOptions::feeds; in the storage
    std::vector<PathDelay> delays;                ///< between the sources and the sinks of devices
    std::vector<std::shared_ptr<void>> storage;   ///< outputs, wires, constants: what all pointers point into.

    // For the next plan, and for turning knobs.
    Flat flat;                                       ///< what the plan was built from
    std::vector<Instance> instances;                 ///< numbered as in flat.nodes
    std::vector<LineUse> lines;                      ///< by wire, then component
    std::vector<RateConverterUse> rate_converters;   ///< by wire, then component, then step
    std::vector<std::vector<PortRef>> fed;           ///< by feed: the ports it drives
    std::vector<std::uint32_t> bound;                ///< the nodes that run and whose type has one of the hooks bind and learn
    std::shared_ptr<const std::map<std::string, std::vector<PortRef>>> exposed = std::make_shared<std::map<std::string, std::vector<PortRef>>>();
    Ramps ramps;
    Takeover takeover;
};

class PlanBuilder;

}   // namespace plan

/// The result of compiling a graph: contiguous records in running order, and the storage they point into. Its shape never
/// changes; only the values of its nodes, wires and feeds do. One thread ticks it. A plan compiled to follow another one
/// shares the unchanged nodes with it; once it has taken over, only the new plan may tick.
class Plan
{
public:
    using SinkUse = plan::SinkUse;
    using RoleUse = plan::RoleUse;

    /// Makes a plan without nodes. Its taps read values that the caller stores elsewhere.
    explicit Plan (std::vector<Tap> taps = {}) { parts.taps = std::move (taps); }

    // Instances hold pointers into the plan, so it must not be moved or copied.
    Plan (const Plan&) = delete;
    Plan& operator= (const Plan&) = delete;

    /// Takes over the state of the plan that this one was compiled to follow. Called before the first tick. [tick thread]
    void takeOver (const Plan& before, Journal* journal = nullptr) noexcept
    {
        if (parts.feeds.size() == before.parts.feeds.size()) setFeeds (before.parts.feeds);
        parts.takeover.carryOut (parts.instances, parts.ramps, before.parts.ramps, journal);
    }

    /// Starts moving to the targets that were set since the last call, and passes hits on to their inputs. [tick thread]
    void applyTurns (Journal* journal) noexcept { parts.ramps.poll (journal); }

    /// Until now, targets applied immediately; from now on, each new target starts a ramp. Call it right before the first tick.
    /// [tick thread]
    void startRamping() noexcept { parts.ramps.startAll(); }

    /// Sets the number of the next tick, counted across all plans, and moves all ramps by one tick. [tick thread]
    void beginTick (std::uint64_t number) noexcept
    {
        parts.number = number;
        parts.ramps.step();
    }

    /// Runs all records once, or the code that replaces them (see fuse). If a parameter was written, settled nodes run first. [tick thread]
    void tick() noexcept
    {
        if (parts.ramps.hasWritten()) settle();
        if (const auto* code = fused_now.load (std::memory_order_acquire))
        {
            code->tick (code->objects.data());
            ++parts.number;
        }
        else
            tickRecords();
    }

    /// From the next tick on, tick() calls this code in place of the records; null: the records again. The plan keeps all code that it has
    /// been given, because a tick may be running it. A plan that takes over from this one starts with its own records. [main thread]
    void fuse (std::shared_ptr<const FusedTick>);

    /// True if tick() calls compiled code. [any thread]
    bool isFused() const noexcept { return fused_now.load (std::memory_order_relaxed) != nullptr; }

    /// Runs the same tick with bit-identical results, by its records, for measuring: calls `around (i, step)` for each record in running order,
    /// and `around` calls `step()` exactly once. [tick thread]
    template <typename Around>
    void tick (Around&& around) noexcept
    {
        if (parts.ramps.hasWritten()) settle();
        for (std::size_t i = 0; i < parts.records.size(); ++i)
        {
            const auto& r = parts.records[i];
            around (i, [&r]() noexcept { r.step (r.self, r.sources, r.outputs); });
        }
        ++parts.number;
    }

    /// One value per CompileOptions::feeds, to be set before each tick. [tick thread]
    std::span<double> feeds() noexcept { return parts.feeds; }
    std::span<const double> feeds() const noexcept { return parts.feeds; }

    /// As many values as there are feeds. [tick thread]
    void setFeeds (std::span<const double> values) noexcept
    {
        std::ranges::copy (values.first (std::min (values.size(), parts.feeds.size())), parts.feeds.begin());
    }

    std::uint64_t serial() const noexcept { return own_serial; }       ///< unique in the process; a later plan has a higher one
    double rateHz() const noexcept { return parts.rate_hz; }           ///< tick rate
    std::uint64_t nextTick() const noexcept { return parts.number; }   ///< number of the next tick

    const std::vector<Record>& records() const noexcept { return parts.records; }
    const std::vector<Record>& settled() const noexcept { return parts.settled; }          ///< they run only after a parameter was written
    const std::vector<RoleUse>& roles() const noexcept { return parts.roles; }             ///< sorted by name
    const std::vector<Tap>& taps() const noexcept { return parts.taps; }                   ///< as in CompileOptions::records, in order
    const std::vector<plan::PathDelay>& delays() const noexcept { return parts.delays; }   ///< between the sources and the sinks of devices

    /// By record: the number of the node it belongs to; for a wire, the node where it ends.
    const std::vector<std::uint32_t>& owners() const noexcept { return parts.owners; }

    /// The periods, in ticks, of the sections that do not run on every tick; in rising order.
    const std::vector<std::uint64_t>& rests() const noexcept { return parts.rests; }

    const plan::Flat& flat() const noexcept { return parts.flat; }                              ///< what it was built from
    const std::vector<plan::Instance>& instances() const noexcept { return parts.instances; }   ///< numbered as in flat().nodes

    /// The numbers of the nodes that run and belong to a role: those whose type has one of the hooks bind and learn.
    const std::vector<std::uint32_t>& bound() const noexcept { return parts.bound; }

    /// Params and inputs by the names under which subgraphs expose them.
    const std::map<std::string, std::vector<plan::PortRef>>& exposed() const noexcept { return *parts.exposed; }

    /// The use of a role, or null. [any thread]
    const RoleUse* findRole (std::string_view name) const noexcept
    {
        const auto role = std::ranges::find (parts.roles, name, &RoleUse::name);
        return role == parts.roles.end() ? nullptr : &*role;
    }

    /// Saves or restores what the next ticks depend on: the state of its nodes, their parameters with their ramps, what is under way on wires, and all
    /// values. All targets must have been applied (applyTurns). [tick thread]
    void serialize (StateArchive&);

    /// Frees everything that only edits need. The plan still ticks, but no other plan can follow it, and its knobs can no
    /// longer be turned.
    void forgetGraph();

private:
    friend class plan::PlanBuilder;

    void tickRecords() noexcept;
    void settle() noexcept;

    std::uint64_t own_serial = plan::newSerial();
    plan::PlanParts parts;
    std::vector<std::shared_ptr<const FusedTick>> fused_kept;   // [main thread]
    std::atomic<const FusedTick*> fused_now = nullptr;
};

}   // namespace tactus
